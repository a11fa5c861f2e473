"""Reads what a study moves, and what it holds while it does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from fluxbore.design.errors import SpecError, shown
from fluxbore.design.keys import Alternatives, Key, Values
from fluxbore.design.study import Variable
from fluxbore.design.study_fields import allow, check_at, numeric_key, read_value, tables


def movable(key: Key) -> bool:
    """Whether a search may move the key: a quantity, a number, or a count of the actuator's own parts."""
    if key.kind == "word" or not key.of_design:
        return False
    return key.kind != "integer" or key.name.startswith("actuator.")


def read_variables(raw: Mapping[str, Any], known: Mapping[str, Key], values: Values) -> tuple[Variable, ...]:
    """``study.variables`` of the raw section. ``values`` are the start design's, every key resolved."""
    variables = tuple(
        _variable(item, f"study.variables.{i}", known, values) for i, item in enumerate(tables(raw, "variables"))
    )
    repeated = {v.key for v in variables if sum(other.key == v.key for other in variables) > 1}
    if repeated:
        raise SpecError(f"study.variables must name each key once; got {min(repeated)} twice.")
    return variables


def _variable(raw: Mapping[str, Any], where: str, known: Mapping[str, Key], values: Values) -> Variable:
    allow(raw, where, ("key", "lower", "upper", "resolution"))
    key = numeric_key(raw, where, known, integers=True)
    if not movable(key):
        raise SpecError(
            f"{where}.key must name a quantity, a number or a count of the actuator's parts; got {key.name}, which is "
            "a count of the evaluation's."
        )
    for bound in ("lower", "upper"):
        if bound not in raw:
            raise SpecError(
                f"{where}.{bound} is missing: the variable {key.name} needs both a lower and an upper bound."
            )
    lower, upper = (read_value(raw[bound], key, f"{where}.{bound}") for bound in ("lower", "upper"))
    if not lower < upper:
        raise SpecError(f"{where}.upper must exceed {where}.lower {key.show(lower)}; got {key.show(upper)}.")
    for bound, number in (("lower", lower), ("upper", upper)):
        check_at(key, number, f"{where}.{bound}")
    if key.name not in values:
        raise SpecError(f"{where}.key must have a start value in the specification; {key.name} has none.")
    if key.kind == "integer":
        if "resolution" in raw:
            raise SpecError(
                f"{where}.resolution must be left out, for {key.name} is a count, which moves by 1; "
                f"got {shown(raw['resolution'])}."
            )
        return Variable(key.name, lower, upper, integer=True)
    resolution = None
    if "resolution" in raw:
        step = key.difference
        resolution = read_value(raw["resolution"], step, f"{where}.resolution")
        if not 0 < resolution <= upper - lower:
            raise SpecError(
                f"{where}.resolution must be above zero and at most the range {step.show(upper - lower)}; "
                f"got {step.show(resolution)}."
            )
    return Variable(key.name, lower, upper, resolution)


def read_hold(raw: object, alternatives: Sequence[Alternatives], variables: Sequence[Variable]) -> tuple[str, ...]:
    """``study.hold``: keys that have alternatives and are no variables."""
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
