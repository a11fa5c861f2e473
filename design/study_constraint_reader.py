"""Reads a study's constraints, and refuses those that contradict one another on paper."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.keys import Key
from fluxbore.design.performance import FIGURES
from fluxbore.design.study import Constraint, Variable
from fluxbore.design.study_fields import allow, known_figure, loose, numeric_key, read_value
from fluxbore.design.units import DIMENSIONS

_FACTOR = re.compile(r"^(?:([0-9.eE+-]+)\s*x\s*)?start$")


def read_constraint(raw: Mapping[str, Any], where: str, known: Mapping[str, Key]) -> Constraint:
    """One table of ``study.constraints``."""
    allow(raw, where, ("figure", "key", "upper", "lower"))
    if ("figure" in raw) == ("key" in raw):
        raise SpecError(f"{where} must hold exactly one of figure and key; got {', '.join(raw) or 'none'}.")
    if "figure" in raw:
        name = known_figure(raw["figure"], f"{where}.figure")
        dimension = FIGURES[name].dimension
        key = Key(name, "", "quantity" if dimension in DIMENSIONS else "number", dimension)
    else:
        key = numeric_key(raw, where, known, integers=True)
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
            _refuse_near_factor(raw[bound], f"{where}.{bound}")
            limits[bound] = read_value(raw[bound], loose(key), f"{where}.{bound}")
        relative.append(match is not None)
    if len(set(relative)) > 1:
        raise SpecError(f'{where}: upper and lower must both be quantities or both be relative to "start".')
    lower, upper = limits["lower"], limits["upper"]
    if lower is not None and upper is not None and lower > upper:
        show = (lambda limit: f"{limit:g} x start") if relative[0] else loose(key).show
        raise SpecError(
            f"{where} cannot be met: {key.name} would have to be at least {show(lower)} and at most {show(upper)}."
        )
    if upper is not None and upper < 0 and key.name in FIGURES and not FIGURES[key.name].signed:
        raise SpecError(f"{where}.upper must be at least zero, for {key.name} always is; got {key.show(upper)}.")
    return Constraint(key.name, upper, lower, relative[0])


def _refuse_near_factor(raw: object, where: str) -> None:
    """A text that speaks of the start in another form than ours is told the form."""
    if isinstance(raw, str) and re.search(r"\bstart\b", raw):
        raise SpecError(f'{where} must be a quantity, "start" or a multiple such as "1.1 x start"; got {shown(raw)}.')


def _factor(text: str | None, where: str) -> float:
    try:
        factor = float(text) if text else 1.0
    except ValueError:
        factor = math.nan
    if not (math.isfinite(factor) and factor > 0):
        raise SpecError(f'{where} must be a quantity, "start" or "1.1 x start"; got the factor "{text}".')
    return factor


def check_constraints(
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
