"""Reads the study section of a specification into the frozen types of `fluxbore.design.study`."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.keys import Alternatives, Key, Values
from fluxbore.design.performance import FIGURES
from fluxbore.design.study import ALGORITHMS, Axis, Constraint, Objective, Search, Study, Sweep, Variable
from fluxbore.design.units import DIMENSIONS

LARGEST_GRID = 1_000_000
"""Designs in one sweep; a slip in ``step`` asks for more than this."""

_SIGNED = ("pneumatic_force_advance", "pneumatic_force_retract")
"""The figures that can be negative: under a vacuum the air pulls."""

_FACTOR = re.compile(r"^(?:([0-9.eE+-]+)\s*x\s*)?start$")


def read_study(
    raw: Mapping[str, Any], keys: Sequence[Key], alternatives: Sequence[Alternatives], values: Values
) -> Study:
    """The study that the raw section describes. ``values`` are the start design's, every key resolved.

    Raises SpecError with the study's key, the limit and the value.
    """
    known = {key.name: key for key in keys}
    _allow(raw, "study", ("objective", "hold", "variables", "constraints", "sweeps", "search"))
    variables = tuple(
        _variable(item, f"study.variables.{i}", known, values) for i, item in enumerate(_items(raw, "variables"))
    )
    repeated = {v.key for v in variables if sum(other.key == v.key for other in variables) > 1}
    if repeated:
        raise SpecError(f"study.variables must name each key once; got {min(repeated)} twice.")
    constraints = tuple(
        _constraint(item, f"study.constraints.{i}", known) for i, item in enumerate(_items(raw, "constraints"))
    )
    _check_constraints(constraints, variables, known)
    sweeps = tuple(_sweep(item, f"study.sweeps.{i}", known) for i, item in enumerate(_items(raw, "sweeps")))
    for i, sweep in enumerate(sweeps):
        if sweep.name in (other.name for other in sweeps[:i]):
            raise SpecError(f"study.sweeps.{i}.name must differ from the other sweeps' names; got {shown(sweep.name)}.")
    return Study(
        objective=_objective(raw.get("objective")),
        variables=variables,
        constraints=constraints,
        sweeps=sweeps,
        hold=_hold(raw.get("hold", []), alternatives, variables),
        search=_search(raw.get("search", {})),
    )


def _items(raw: Mapping[str, Any], name: str) -> list[dict[str, Any]]:
    items = raw.get(name, [])
    if not isinstance(items, list) or not all(isinstance(item, dict) for item in items):
        raise SpecError(f"study.{name} must be a list of tables, each headed [[study.{name}]]; got {shown(items)}.")
    return items


def _allow(raw: object, where: str, allowed: Sequence[str]) -> None:
    if not isinstance(raw, Mapping):
        raise SpecError(f"{where} must be a section of keys; got {shown(raw)}.")
    for key in raw:
        if key not in allowed:
            raise SpecError(f"{where}.{key} is not a key of this specification; {where} has {', '.join(allowed)}.")


def _objective(raw: object) -> Objective | None:
    if raw is None:
        return None
    words = raw.split() if isinstance(raw, str) else []
    if len(words) != 2 or words[0] not in ("maximise", "minimise"):
        raise SpecError(
            'study.objective must be "maximise FIGURE" or "minimise FIGURE", such as "maximise force_constant"; '
            f"got {shown(raw)}."
        )
    _figure(words[1], "study.objective")
    return Objective(words[1], words[0] == "maximise")


def _figure(name: object, where: str) -> str:
    if not isinstance(name, str) or name not in FIGURES:
        raise SpecError(f"{where} must name a figure, one of {', '.join(FIGURES)}; got {shown(name)}.")
    return name


def _numeric_key(raw: Mapping[str, Any], where: str, known: Mapping[str, Key], *, integers: bool) -> Key:
    name = raw.get("key")
    key = known.get(name) if isinstance(name, str) else None
    if key is None:
        raise SpecError(f"{where}.key must be a dotted key of this specification; got {shown(name)}.")
    if key.kind == "word" or (key.kind == "integer" and not integers) or key.section == "solver":
        kinds = "a dimension, a number or a count" if integers else "a continuous quantity"
        raise SpecError(f"{where}.key must name {kinds}; got {key.name}, which is {_kind_word(key)}.")
    return key


def _kind_word(key: Key) -> str:
    if key.section == "solver":
        return "a setting of the solver"
    return {"word": "a word", "integer": "a count"}.get(key.kind, "a quantity")


def _value(raw: object, key: Key, where: str) -> float:
    """A number of ``key``'s dimension that stands at ``where`` in the file; the key's limits do not apply."""
    value = Key(where, key.doc, key.kind, key.dimension).read(raw)
    return float(value)


def _variable(raw: Mapping[str, Any], where: str, known: Mapping[str, Key], values: Values) -> Variable:
    _allow(raw, where, ("key", "lower", "upper", "resolution"))
    key = _numeric_key(raw, where, known, integers=False)
    for bound in ("lower", "upper"):
        if bound not in raw:
            raise SpecError(
                f"{where}.{bound} is missing: the variable {key.name} needs both a lower and an upper bound."
            )
    lower, upper = (_value(raw[bound], key, f"{where}.{bound}") for bound in ("lower", "upper"))
    if not lower < upper:
        raise SpecError(f"{where}.upper must exceed {where}.lower {key.show(lower)}; got {key.show(upper)}.")
    for bound, number in (("lower", lower), ("upper", upper)):
        _check_at(key, number, f"{where}.{bound}")
    resolution = None
    if "resolution" in raw:
        step = key.difference
        resolution = _value(raw["resolution"], step, f"{where}.resolution")
        if not 0 < resolution <= upper - lower:
            raise SpecError(
                f"{where}.resolution must be above zero and at most the range {step.show(upper - lower)}; "
                f"got {step.show(resolution)}."
            )
    if key.name not in values:
        raise SpecError(f"{where}.key must have a start value in the specification; {key.name} has none.")
    return Variable(key.name, lower, upper, resolution)


def _check_at(key: Key, value: float, where: str) -> None:
    """Hold a value of the study against its key's own limits."""
    try:
        key.check(value)
    except SpecError as error:
        raise SpecError(f"{where}: {error}") from error


def _constraint(raw: Mapping[str, Any], where: str, known: Mapping[str, Key]) -> Constraint:
    _allow(raw, where, ("figure", "key", "upper", "lower"))
    if ("figure" in raw) == ("key" in raw):
        raise SpecError(f"{where} must hold exactly one of figure and key; got {', '.join(raw) or 'none'}.")
    if "figure" in raw:
        name = _figure(raw["figure"], f"{where}.figure")
        dimension = FIGURES[name].dimension
        key = Key(name, "", "quantity" if dimension in DIMENSIONS else "number", dimension)
    else:
        key = _numeric_key(raw, where, known, integers=True)
    if "upper" not in raw and "lower" not in raw:
        raise SpecError(f"{where} must hold upper or lower for {key.name}; got neither.")
    limits: dict[str, float | None] = {"upper": None, "lower": None}
    relative = []
    for bound in ("upper", "lower"):
        if bound not in raw:
            continue
        match = _FACTOR.match(raw[bound].strip()) if isinstance(raw[bound], str) else None
        if match:
            limits[bound] = _factor(match.group(1), f"{where}.{bound}")
        else:
            limits[bound] = _value(raw[bound], _loose(key), f"{where}.{bound}")
        relative.append(match is not None)
    if len(set(relative)) > 1:
        raise SpecError(f'{where}: upper and lower must both be quantities or both be relative to "start".')
    lower, upper = limits["lower"], limits["upper"]
    if lower is not None and upper is not None and lower > upper:
        show = (lambda limit: f"{limit:g} x start") if relative[0] else _loose(key).show
        raise SpecError(
            f"{where} cannot be met: {key.name} would have to be at least {show(lower)} and at most {show(upper)}."
        )
    if upper is not None and upper < 0 and key.name in FIGURES and key.name not in _SIGNED:
        raise SpecError(f"{where}.upper must be at least zero, for {key.name} always is; got {key.show(upper)}.")
    return Constraint(key.name, upper, lower, relative[0])


def _loose(key: Key) -> Key:
    """A count's limit may be a fraction; the limit of a quantity keeps its dimension."""
    return Key(key.name, key.doc, "number" if key.kind == "integer" else key.kind, key.dimension)


def _factor(text: str | None, where: str) -> float:
    try:
        factor = float(text) if text else 1.0
    except ValueError:
        factor = math.nan
    if not (math.isfinite(factor) and factor > 0):
        raise SpecError(f'{where} must be a quantity, "start" or "1.1 x start"; got the factor "{text}".')
    return factor


def _check_constraints(
    constraints: Sequence[Constraint], variables: Sequence[Variable], known: Mapping[str, Key]
) -> None:
    """What contradicts itself on paper is refused before anything is computed."""
    floors: dict[str, float] = {}
    ceilings: dict[str, float] = {}
    for constraint in constraints:
        if constraint.relative_to_start:
            continue
        if constraint.lower is not None:
            floors[constraint.subject] = max(constraint.lower, floors.get(constraint.subject, -math.inf))
        if constraint.upper is not None:
            ceilings[constraint.subject] = min(constraint.upper, ceilings.get(constraint.subject, math.inf))
    for subject in floors.keys() | ceilings.keys():
        low, high = floors.get(subject, -math.inf), ceilings.get(subject, math.inf)
        show = known[subject].show if subject in known else (lambda value, digits=6: f"{value:.{digits}g}")
        if low > high:
            raise SpecError(
                f"study.constraints cannot be met: {subject} would have to be at least {show(low)} "
                f"and at most {show(high)}."
            )
        for variable in variables:
            if variable.key == subject and (low > variable.upper or high < variable.lower):
                limit = f"at least {show(low)}" if low > variable.upper else f"at most {show(high)}"
                raise SpecError(
                    f"study.constraints cannot be met: {subject} would have to be {limit}, but its bounds are "
                    f"{show(variable.lower)} to {show(variable.upper)}."
                )


def _sweep(raw: Mapping[str, Any], where: str, known: Mapping[str, Key]) -> Sweep:
    _allow(raw, where, ("name", "axes", "published_optimum", "source"))
    axes_raw = raw.get("axes")
    if not isinstance(axes_raw, list) or not axes_raw:
        raise SpecError(f"{where}.axes must be a list of at least one table; got {shown(axes_raw)}.")
    axes = tuple(_axis(item, f"{where}.axes.{i}", known) for i, item in enumerate(axes_raw))
    names = [axis.key for axis in axes]
    if len(set(names)) < len(names):
        raise SpecError(f"{where}.axes must name each key once; got {', '.join(names)}.")
    reference = None
    if "published_optimum" in raw:
        if len(axes) != 1:
            raise SpecError(f"{where}.published_optimum needs exactly one axis; got {len(axes)}.")
        reference = _value(raw["published_optimum"], _loose(known[names[0]]), f"{where}.published_optimum")
    name, source = (
        str(Key(f"{where}.{word}", "", "word").read(raw[word])) if word in raw else default
        for word, default in (("name", " x ".join(names)), ("source", ""))
    )
    sweep = Sweep(name, axes, reference, source)
    if sweep.size > LARGEST_GRID:
        raise SpecError(f"{where} must have at most {LARGEST_GRID} designs; got {sweep.size}.")
    return sweep


def _axis(raw: object, where: str, known: Mapping[str, Key]) -> Axis:
    _allow(raw, where, ("key", "from", "to", "step", "values"))
    assert isinstance(raw, Mapping)
    key = _numeric_key(raw, where, known, integers=True)
    if "values" in raw:
        if len(raw) != 2:
            raise SpecError(
                f"{where} must hold key with values = [...], or with from, to and step; got {', '.join(raw)}."
            )
        items = raw["values"]
        if not isinstance(items, list) or not items:
            raise SpecError(f"{where}.values must be a list of at least one value; got {shown(items)}.")
        values = tuple(_value(item, key, f"{where}.values.{i}") for i, item in enumerate(items))
        for i, value in enumerate(values):
            _check_at(key, value, f"{where}.values.{i}")
        return Axis(key.name, values)
    for name in ("from", "to", "step"):
        if name not in raw:
            raise SpecError(f"{where}.{name} is missing: an axis needs from, to and step, or values.")
    first, last = (_value(raw[name], key, f"{where}.{name}") for name in ("from", "to"))
    for name, value in (("from", first), ("to", last)):
        _check_at(key, value, f"{where}.{name}")
    step = _value(raw["step"], key.difference, f"{where}.step")
    got = key.difference.show(step)
    if step == 0 or (last - first) / step < 0:
        raise SpecError(f"{where}.step must lead from {key.show(first)} to {key.show(last)}; got {got}.")
    intervals = (last - first) / step
    if intervals > LARGEST_GRID:
        raise SpecError(f"{where} must have at most {LARGEST_GRID} points; got {intervals:.3g}.")
    if abs(intervals - round(intervals)) > 1e-6:
        raise SpecError(
            f"{where}.step must divide the range from {key.show(first)} to {key.show(last)} evenly; got {got}."
        )
    # Rounded to 12 digits so that 0.0005 * 3 is the 0.0015 that a person would type.
    return Axis(key.name, tuple(float(f"{first + step * i:.12g}") for i in range(round(intervals) + 1)))


def _hold(raw: object, alternatives: Sequence[Alternatives], variables: Sequence[Variable]) -> tuple[str, ...]:
    eligible = [key for group in alternatives for key in group.keys]
    if not isinstance(raw, list) or not all(isinstance(item, str) for item in raw):
        raise SpecError(f"study.hold must be a list of dotted keys in quotes; got {shown(raw)}.")
    for i, name in enumerate(raw):
        if name not in eligible:
            raise SpecError(
                f"study.hold.{i} must be a key that has alternatives, one of {', '.join(eligible)}; got {shown(name)}."
            )
        if any(variable.key == name for variable in variables):
            raise SpecError(f"study.hold.{i} must not be a variable of the study as well; got {name}.")
    return tuple(raw)


def _search(raw: object) -> Search:
    _allow(raw, "study.search", ("algorithm", "max_evaluations", "relative_tolerance", "seed"))
    assert isinstance(raw, Mapping)
    default = Search()
    keys = {
        "algorithm": Key("study.search.algorithm", "", "word", choices=ALGORITHMS, default=default.algorithm),
        "max_evaluations": Key(
            "study.search.max_evaluations", "", "integer", minimum=1, maximum=1_000_000, default=default.max_evaluations
        ),
        "relative_tolerance": Key(
            "study.search.relative_tolerance", "", "number", above=0.0, maximum=0.5, default=default.relative_tolerance
        ),
        "seed": Key("study.search.seed", "", "integer", minimum=0, maximum=2**31 - 1, default=default.seed),
    }
    values = {name: key.read(raw[name]) if name in raw else key.default for name, key in keys.items()}
    return Search(
        algorithm=str(values["algorithm"]),
        max_evaluations=int(values["max_evaluations"] or 0),
        relative_tolerance=float(values["relative_tolerance"] or 0.0),
        seed=int(values["seed"] or 0),
    )
