"""Writes specifications: a design found by a study as a file of its own, and the commented templates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.keys import Key, Value, toml_string
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec
from fluxbore.design.study import Axis, Constraint, Objective, Production, Study
from fluxbore.design.study_fields import figure_key
from fluxbore.design.study_production_reader import PRODUCTION_KEYS
from fluxbore.design.study_search_reader import PARETO_KEYS, SEARCH_KEYS

_ATTRIBUTES = {"yield": "target_yield"}
"""Where a key's name is no name of Python's."""

_TEMPLATES = Path(__file__).parent / "data" / "templates"


def template_names() -> tuple[str, ...]:
    """The templates that `template` knows."""
    return tuple(sorted(path.stem for path in _TEMPLATES.glob("*.toml")))


def template(name: str) -> str:
    """A commented specification to start from. Raises SpecError where there is none of that name."""
    if name not in template_names():
        raise SpecError(f"There is a template for {', '.join(template_names())}; got {shown(name)}.")
    return (_TEMPLATES / f"{name}.toml").read_text(encoding="utf-8")


def to_toml(spec: Spec, comment: str = "") -> str:
    """The specification as a file, every value exact: reading it gives the same floats back.

    comment : lines for the head of the file, without the hash signs.
    """
    notes = {note.key: note for note in spec.notes}
    lines = [f"# {line}".rstrip() for line in comment.splitlines()]
    sections: dict[str, list[str]] = {"actuator": [f'kind = "{spec.kind.name}"']}
    for key in spec.kind.keys:
        if key.name not in spec.given:
            continue
        text = _write(key, spec.given[key.name])
        note = notes.get(key.name)
        if note is not None:
            text = f"{{ value = {text}, {note.status} = {toml_string(note.reason)} }}"
        unit = f"  # {key.symbol}" if key.symbol else ""
        sections.setdefault(key.section, []).append(f"{key.leaf} = {text}{unit}")
    for section, content in sections.items():
        lines += ["", f"[{section}]", *content]
    for name, table in _materials(spec).items():
        lines += ["", f"[materials.{toml_string(name)}]", *(f"{key} = {_plain(value)}" for key, value in table.items())]
    lines += _study_lines(spec.study, {key.name: key for key in spec.kind.keys})
    return "\n".join(lines).lstrip("\n") + "\n"


def _materials(spec: Spec) -> dict[str, dict[str, Any]]:
    """The specification's own materials; a B-H table that came from a file is written in full, to travel along."""
    tables = {}
    for name, table in spec.own_materials.items():
        curve = spec.materials[name].curve
        if "bh_file" in table and curve is not None:
            pairs = [list(pair) for pair in zip(curve.b, curve.h, strict=True)]
            table = {**{key: value for key, value in table.items() if key != "bh_file"}, "bh": pairs}
        tables[name] = dict(table)
    return tables


def _plain(value: Any) -> str:
    """A TOML value from a plain Python one."""
    if isinstance(value, str):
        return toml_string(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_plain(item) for item in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_plain(item)}" for key, item in value.items()) + " }"
    return repr(value)


def _study_lines(study: Study, keys: Mapping[str, Key]) -> list[str]:
    lines = ["", "[study]"]
    if study.objective is not None:
        lines.append(f"objective = {_objective(study.objective)}")
    if study.hold:
        lines.append(f"hold = {_plain(study.hold)}")
    for variable in study.variables:
        key = keys[variable.key]
        lines += ["", "[[study.variables]]", f'key = "{key.name}"']
        lines += [f"lower = {_write(key, variable.lower)}", f"upper = {_write(key, variable.upper)}"]
        if variable.resolution is not None:
            lines.append(f"resolution = {key.difference.write(variable.resolution)}")
    for constraint in study.constraints:
        lines += _constraint_lines(constraint, keys)
    for sweep in study.sweeps:
        lines += ["", "[[study.sweeps]]", f"name = {toml_string(sweep.name)}"]
        if sweep.reference is not None:
            lines.append(f"published_optimum = {_limit(keys[sweep.axes[0].key], sweep.reference)}")
        if sweep.published and study.objective is not None:
            x, y = keys[sweep.axes[0].key], figure_key(study.objective.figure)
            pairs = ", ".join(f"[{_limit(x, at)}, {y.write(value)}]" for at, value in sweep.published)
            lines.append(f"published = [{pairs}]")
        if sweep.reference_source:
            lines.append(f"source = {toml_string(sweep.reference_source)}")
        lines.append("axes = [" + ", ".join(_axis(axis, keys[axis.key]) for axis in sweep.axes) + "]")
    lines += ["", "[study.search]", *_settings(study.search, SEARCH_KEYS)]
    if study.pareto is not None:
        against = _objective(study.pareto.against)
        lines += ["", "[study.pareto]", f"against = {against}", *_settings(study.pareto, PARETO_KEYS)]
    if study.production is not None:
        lines += _production_lines(study.production, keys)
    return lines


def _objective(objective: Objective) -> str:
    return f'"{"maximise" if objective.maximise else "minimise"} {objective.figure}"'


def _settings(settings: object, keys: Sequence[Key]) -> list[str]:
    """The lines of a table that is read by these keys; what is None is left out."""
    values = ((key, getattr(settings, _ATTRIBUTES.get(key.leaf, key.leaf))) for key in keys)
    return [f"{key.leaf} = {key.write(value)}" for key, value in values if value is not None]


def _production_lines(production: Production, keys: Mapping[str, Key]) -> list[str]:
    lines = ["", "[study.production]", *_settings(production, PRODUCTION_KEYS)]
    for tolerance in production.tolerances:
        step = keys[tolerance.key].difference
        lines += ["", "[[study.production.tolerances]]", f'key = "{tolerance.key}"']
        if tolerance.plus == -tolerance.minus:
            lines.append(f"tolerance = {step.write(tolerance.plus)}")
        else:
            lines += [f"plus = {step.write(tolerance.plus)}", f"minus = {step.write(abs(tolerance.minus))}"]
        lines.append(f'distribution = "{tolerance.distribution}"')
    return lines


def _constraint_lines(constraint: Constraint, keys: Mapping[str, Key]) -> list[str]:
    if constraint.subject in FIGURES:
        key = figure_key(constraint.subject)
        lines = ["", "[[study.constraints]]", f'figure = "{constraint.subject}"']
    else:
        key = keys[constraint.subject]
        lines = ["", "[[study.constraints]]", f'key = "{constraint.subject}"']
    for bound, value in (("upper", constraint.upper), ("lower", constraint.lower)):
        if value is not None:
            lines.append(
                f"{bound} = " + (f'"{value!r} x start"' if constraint.relative_to_start else _limit(key, value))
            )
    return lines


def _write(key: Key, value: Value) -> str:
    """A value that the reader takes; the count that a search or a grid keeps as a float is a whole number again."""
    return key.write(int(value) if key.kind == "integer" else value)


def _limit(key: Key, value: float) -> str:
    """A limit of a count is a plain number, which may be a fraction."""
    return repr(value) if key.kind == "integer" else key.write(value)


def _axis(axis: Axis, key: Key) -> str:
    return f'{{ key = "{axis.key}", values = [{", ".join(_write(key, value) for value in axis.values)}] }}'
