"""The specification: the only reader of spec files.

A file becomes a `Spec`: the flat table of SI values at dotted keys, the study, and notes on what was assumed. Designs
of a study are the same `Spec` with other values, so that everything downstream has one way in.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from fluxbore.design import materials
from fluxbore.design.errors import MaterialError, SpecError, shown
from fluxbore.design.keys import Key, Value
from fluxbore.design.performance import FIGURES
from fluxbore.design.specification import KINDS, Kind, Note, Spec, suggestion
from fluxbore.design.study import Study
from fluxbore.design.study_reader import read_study

__all__ = ["DEEPEST", "KINDS", "LARGEST_FILE", "Kind", "Note", "Spec", "load", "loads"]

LARGEST_FILE = 4_000_000
"""Bytes; a specification is a page, so more than this is some other file."""


DEEPEST = 20
"""Levels of tables and lists; a specification has six."""


def load(path: Path | str, overrides: Mapping[str, str] | None = None) -> Spec:
    """Read a specification file.

    overrides : dotted key -> text, as ``--set`` takes them; an empty text removes the key.

    Raises SpecError, DesignError or MaterialError with one sentence.
    """
    path = Path(path)
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except OSError as error:
        found = path / "design.toml"  # what a finished run leaves
        hint = f"; the design in it is {found}" if isinstance(error, IsADirectoryError) and found.is_file() else ""
        raise SpecError(f"{path} cannot be read: {error.strerror or error}{hint}.") from error
    if len(content) > LARGEST_FILE:
        raise SpecError(f"{path} must be a specification of at most {LARGEST_FILE} bytes; it is larger.")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SpecError(f"{path} must be a UTF-8 text; byte {error.start} is not.") from error
    return loads(text, overrides, source=str(path), base=path.parent)


def loads(
    text: str, overrides: Mapping[str, str] | None = None, source: str = "the specification", base: Path | None = None
) -> Spec:
    """Read a specification from a text; ``base`` is the folder that file names in it are relative to."""
    try:
        raw = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise SpecError(f"{source} is not valid TOML: {str(error).rstrip('.')}.") from error
    except RecursionError as error:
        raise SpecError(f"{source} must be nested at most {DEEPEST} levels deep; it is deeper.") from error
    except ValueError as error:  # Python's own limit on the digits of a whole number
        raise SpecError(f"{source} is not valid TOML: a number in it has too many digits.") from error
    _check_tree(raw, source)
    kind = _kind(raw, source)
    for key, value in (overrides or {}).items():
        _override(raw, key, value, kind)
    _check_tree(raw, "--set")
    kind = _kind(raw, source)
    return _read(raw, kind, base or Path())


def _check_tree(raw: object, source: str) -> None:
    """Refuse what TOML forbids and Python lets pass, before anything stumbles over it."""
    level: list[object] = [raw]
    for _ in range(DEEPEST):
        below: list[object] = []
        for item in level:
            if isinstance(item, dict):
                below += [*item, *item.values()]
            elif isinstance(item, list):
                below += item
            elif isinstance(item, int) and not -(2**63) <= item < 2**63:
                raise SpecError(
                    f"{source} must hold whole numbers of at most 64 bits; got one of {len(str(item))} digits."
                )
            elif isinstance(item, str) and any(c == "\0" or "\ud800" <= c <= "\udfff" for c in item):
                raise SpecError(f"{source} must hold text without null characters and broken bytes; got {shown(item)}.")
        level = below
        if not level:
            return
    raise SpecError(f"{source} must be nested at most {DEEPEST} levels deep; it is deeper.")


def _kind(raw: Mapping[str, Any], source: str) -> Kind:
    actuator = raw.get("actuator")
    if actuator is not None and not isinstance(actuator, dict):
        raise SpecError(f"actuator must be a section of keys, [actuator]; got {shown(actuator)}.")
    name = actuator.get("kind") if isinstance(actuator, dict) else None
    known = ", ".join(f'"{kind}"' for kind in KINDS)
    if name is None:
        raise SpecError(f"{source} must hold actuator.kind, one of {known}; got none.")
    if not isinstance(name, str) or name not in KINDS:
        raise SpecError(f"actuator.kind must be one of {known}; got {shown(name)}.")
    return KINDS[name]


def _read(raw: Mapping[str, Any], kind: Kind, base: Path) -> Spec:
    sections = {"actuator", "operating_point", "solver", "benchmark", "drawing", "study", "materials"}
    for section, content in raw.items():
        if section not in sections:
            hint = suggestion(section, [key.section for key in kind.keys])
            raise SpecError(
                f"{section} is not a section of a specification, which has {', '.join(sorted(sections))}{hint}."
            )
        if not isinstance(content, dict):
            raise SpecError(f"{section} must be a section of keys, [{section}]; got {shown(content)}.")
    own = raw.get("materials", {})
    library = dict(materials.standard())
    for name, table in own.items():
        if not isinstance(table, dict):
            raise SpecError(f"materials.{name} must be a section of keys; got {shown(table)}.")
        library[name] = materials.from_table(name, table, f"materials.{name}", base)
    given: dict[str, Value] = {}
    notes: list[Note] = []
    known = {key.name: key for key in kind.keys}
    for section in ("actuator", "operating_point", "solver", "benchmark", "drawing"):
        _flatten(raw.get(section, {}), section, known, given, notes)
    for group in kind.alternatives:
        group.check(given)
    excluded = {key for group in kind.alternatives for key in group.keys}
    for key in kind.keys:
        if key.name in given or key.name in excluded or key.optional:
            continue
        if key.default is None:
            raise SpecError(f"{key.name} ({key.doc}) is missing.")
        given[key.name] = key.default
    order = {key.name: place for place, key in enumerate(kind.keys)}
    notes.sort(key=lambda note: order[note.key])  # as a written file has them
    spec = Spec(kind, given, Study(), tuple(notes), library, own)
    _check_materials(spec)
    if kind.check is not None:
        kind.check(spec.values)
    study = read_study(raw.get("study", {}), kind.keys, kind.alternatives, spec.values)
    spec = replace(spec, study=study)
    _check_study(spec)
    return spec


def _check_study(spec: Spec) -> None:
    """What only the whole specification tells of a study: who moves what, and what then stays as it is."""
    base = spec.for_study()
    for sweep in spec.study.sweeps:
        base.pinned(axis.key for axis in sweep.axes)
    if spec.study.production is not None:
        base.pinned(tolerance.key for tolerance in spec.study.production.tolerances)
    _check_temperatures(spec)
    moving = {variable.key for variable in spec.study.variables}
    for i, constraint in enumerate(spec.study.constraints if moving else ()):
        name = constraint.subject
        if constraint.relative_to_start or name in moving or name not in base.given:
            continue
        value, show = base.number(name), spec.kind.known(name).show
        for limit, word, missed in (
            (constraint.lower, "at least", constraint.lower is not None and value < constraint.lower),
            (constraint.upper, "at most", constraint.upper is not None and value > constraint.upper),
        ):
            if missed and limit is not None:
                raise SpecError(
                    f"study.constraints.{i} cannot be met: {name} would have to be {word} {show(limit)}, "
                    f"but no variable moves it from {show(value)}."
                )


def _check_temperatures(spec: Spec) -> None:
    """Nothing that only makes heat is colder than the air around it; such a limit is mostly a rise, as in 110 K."""
    key = spec.kind.key("operating_point.ambient_temperature")
    if key is None or key.name not in spec.values:
        return
    moved = next((variable for variable in spec.study.variables if variable.key == key.name), None)
    ambient = float(spec.values[key.name]) if moved is None else moved.lower
    for i, limit in enumerate(spec.study.constraints):
        figure = FIGURES.get(limit.subject)
        if figure is None or figure.dimension != key.dimension or limit.relative_to_start or limit.upper is None:
            continue
        if limit.upper < ambient:
            raise SpecError(
                f"study.constraints.{i}.upper must be at least the {key.name} {key.show(ambient)}, for "
                f"{limit.subject} is a temperature and not a rise; got {key.show(limit.upper)}."
            )


def _flatten(
    table: Mapping[str, Any], prefix: str, known: Mapping[str, Key], given: dict[str, Value], notes: list[Note]
) -> None:
    for leaf, raw in table.items():
        name = f"{prefix}.{leaf}"
        if name == "actuator.kind":
            continue
        key = known.get(name)
        if key is None:
            if any(other.startswith(name + ".") for other in known):
                if not isinstance(raw, dict):
                    raise SpecError(f"{name} must be a section of keys, [{name}]; got {shown(raw)}.")
                _flatten(raw, name, known, given, notes)
                continue
            section = isinstance(raw, dict) and "value" not in raw  # else a value with the reason why it was assumed
            names = {key.section for key in known.values()} if section else known
            raise SpecError(f"{name} is not a key of this specification{suggestion(name, names)}.")
        if isinstance(raw, dict):
            raw = _annotated(name, raw, notes)
        given[name] = key.read(raw)


def _annotated(name: str, raw: Mapping[str, Any], notes: list[Note]) -> Any:
    """The value of ``{ value = ..., assumed = "why" }``, with its note kept."""
    status = [word for word in ("assumed", "calibrated") if word in raw]
    if "value" not in raw or len(status) != 1 or len(raw) != 2 or not isinstance(raw[status[0]], str):
        raise SpecError(
            f'{name} must be a value or {{ value = ..., assumed = "reason" }} (or calibrated = "reason"); '
            f"got {shown(raw)}."
        )
    notes.append(Note(name, status[0], raw[status[0]]))
    return raw["value"]


def _check_materials(spec: Spec) -> None:
    for key, role in spec.kind.materials.items():
        found = materials.lookup(spec.word(key), key, spec.materials, role)
        if role is materials.Material and isinstance(found, materials.PermanentMagnet):
            raise MaterialError(
                f"{key} must name a material without magnetisation of its own; "
                f"got {shown(found.name)}, a permanent magnet."
            )
        if key in spec.kind.non_magnetic and found.curve is not None:
            raise MaterialError(
                f"{key} must name a non-magnetic material, as the field model takes it for air; "
                f"got {shown(found.name)}, a soft iron."
            )


def _override(raw: dict[str, Any], key: str, text: str, kind: Kind) -> None:
    """Put ``text`` at the dotted ``key`` of the raw tree; list items go by their number, from 0."""
    *path, leaf = key.split(".")
    if not all(key.split(".")):
        raise SpecError(f"--set needs a dotted key, such as actuator.mover.ring_width; got {shown(key)}.")
    table: Any = raw
    for step in path:
        if isinstance(table, list):
            table = _item(table, step, key)
        elif isinstance(table, dict):
            table = table.setdefault(step, {})
        if not isinstance(table, (dict, list)):
            raise SpecError(f"{key} is not a key of this specification: {step} holds a value, not a section.")
    known = kind.key(key)
    if isinstance(table, list):
        _item(table, leaf, key)
        if text == "":
            del table[int(leaf)]
        else:
            table[int(leaf)] = _literal(text)
    elif text == "":
        if leaf not in table and known is None:
            raise SpecError(f"{key} cannot be dropped: the specification does not hold it.")
        table.pop(leaf, None)
    elif known is not None and known.kind == "word":
        table[leaf] = text.strip("\"'")
    else:
        table[leaf] = _literal(text)


def _item(table: list[Any], step: str, key: str) -> Any:
    if not (step.isascii() and step.isdigit() and len(step) < 10 and int(step) < len(table)):
        raise SpecError(f"{key} must number an item of a list of {len(table)}, counted from 0; got {shown(step)}.")
    return table[int(step)]


def _literal(text: str) -> Any:
    """A TOML value where the text is one (4, 1.05, [..]), else the text itself (27 mm)."""
    try:
        tree = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return text
    return tree["value"] if len(tree) == 1 and "\n" not in text else text
