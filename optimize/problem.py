"""A study as an optimisation problem in plain numbers: limits, bounds, the objective, all of them scaled."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.keys import Value
from fluxbore.design.performance import FIGURES, Performance, show_figure
from fluxbore.design.pressure_vessel import UNLOADED
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import Candidate, Check, Limit

FEASIBILITY = 1e-9
"""A limit counts as held down to this relative margin: the room that rounding errors need, and no more."""

ACTIVE = 1e-3
"""A limit with a smaller relative margin decides the design."""

NEXT_TO_ZERO = 1e-4
"""Of the start's value: a smaller limit says nothing of how large a miss is."""

_USUAL = {"length": 1e-3}
"""Dimension -> a size (SI) for limits of zero on what is zero or unknown at the start; 1 where none stands here."""

_LOADS = {
    "cylinder_safety": "hoop_stress",
    "cap_safety": "hoop_stress",
    "shaft_safety": "shaft_stress",
    "buckling_safety": "shaft_stress",
}
"""Factor of safety -> the stress (Pa) that it is held against."""

Point = tuple[float, ...]
"""The variables scaled to their bounds, 0 to 1, in the order of the study."""

_DIGITS = 9


def resolve_limits(spec: Spec, start: Evaluation) -> tuple[Limit, ...]:
    """The study's constraints as limits with numbers.

    start : the start design's evaluation, to which relative constraints refer. Where the route of ``start`` is the
    network and it cannot give the figure, the limit is left out; where the FEM cannot, DesignError.

    "1.1 x start" lies above the start and "0.9 x start" below it, by a tenth of its size, whatever its sign. A limit of
    zero has no size of its own: what it leaves is measured in the start's value, see `Limit.scale`.
    """
    limits = []
    for constraint in spec.study.constraints:
        value = _subject(constraint.subject, spec.values, start.performance)
        if constraint.relative_to_start and value is None:
            if start.fidelity == "network":
                continue
            why = " ".join(start.reasons) or "the finite elements do not give it"
            raise DesignError(
                f"study.constraints cannot be held: {constraint.subject} of the start design is not known. "
                f"{why[:1].upper()}{why[1:]}{'' if why.endswith('.') else '.'}"
            )
        for sense, given in ((">=", constraint.lower), ("<=", constraint.upper)):
            if given is not None:
                number = given if not constraint.relative_to_start or value is None else _times(given, value)
                limits.append(Limit(constraint.subject, sense, number, _scale(spec, constraint.subject, number, value)))
    return tuple(limits)


def _times(factor: float, start: float) -> float:
    return factor * start if start >= 0 else (2 - factor) * start


def _scale(spec: Spec, subject: str, limit: float, start: float | None) -> float | None:
    """What a limit next to zero is measured in: the start's value, where it has one that is not zero itself."""
    if start is not None and abs(limit) <= NEXT_TO_ZERO * abs(start):
        return abs(start) or _usual(spec, subject)
    return None if limit else _usual(spec, subject)


def _usual(spec: Spec, subject: str) -> float:
    return _USUAL.get(_dimension(spec, subject), 1.0)


def _dimension(spec: Spec, subject: str) -> str:
    key = spec.kind.key(subject)
    return FIGURES[subject].dimension if subject in FIGURES else key.dimension if key is not None else ""


def show_miss(spec: Spec, item: Check) -> str:
    """By how much a limit with a margin is missed: of its size, or in its unit where that says nothing."""
    assert item.margin is not None
    miss = max(-item.margin, 0.0)
    if item.limit.scale is None or _dimension(spec, item.limit.subject) == "temperature":
        return f"{miss:.2%}"
    return show_limit(spec, replace(item.limit, limit=miss * item.limit.scale))


def show_limit(spec: Spec, limit: Limit) -> str:
    """The limit's number with its unit."""
    if limit.subject in FIGURES:
        return show_figure(limit.subject, limit.limit)
    key = spec.kind.key(limit.subject)
    return key.show(limit.limit) if key is not None else f"{limit.limit:.6g}"


def check(
    limits: Sequence[Limit], values: Mapping[str, Value], performance: Performance, fidelity: str = "fem"
) -> tuple[Check, ...]:
    """Each limit held against a design.

    values : all of the design's keys (`Spec.values`). A figure that the network cannot give does not count against the
    design; one that the finite elements should give and did not, does.
    """
    return tuple(_check(limit, values, performance, fidelity) for limit in limits)


def _check(limit: Limit, values: Mapping[str, Value], performance: Performance, fidelity: str) -> Check:
    value = _subject(limit.subject, values, performance)
    if value is None and limit.sense == ">=" and _unloaded(limit.subject, performance):
        return Check(limit, None, 1.0, True, False)
    if value is None:
        return Check(limit, None, None, fidelity == "network", False)
    room = limit.limit - value if limit.sense == "<=" else value - limit.limit
    margin = room / limit.size
    return Check(limit, value, margin, margin >= -FEASIBILITY, abs(margin) <= ACTIVE)


def _unloaded(figure: str, performance: Performance) -> bool:
    """Whether this is a factor of safety of a part that bears no load, so that it is above any limit.

    A rod that is pulled cannot buckle.
    """
    if figure not in _LOADS:
        return False
    stress = getattr(performance, _LOADS[figure])
    if stress is None:
        return False
    return bool((stress if figure == "buckling_safety" else abs(stress)) <= UNLOADED)


def _subject(name: str, values: Mapping[str, Value], performance: Performance) -> float | None:
    value = getattr(performance, name) if name in FIGURES else values.get(name)
    return None if value is None or isinstance(value, str) or not math.isfinite(value) else float(value)


def candidate(
    spec: Spec, objective: Objective, limits: Sequence[Limit], keys: Sequence[str], evaluation: Evaluation
) -> Candidate:
    """The evaluated design ``spec`` as the study sees it; ``keys`` are those whose values it carries."""
    return Candidate(
        values=numbers({key: spec.values[key] for key in keys}),
        evaluation=evaluation,
        objective=getattr(evaluation.performance, objective.figure) if evaluation.ok else None,
        checks=check(limits, spec.values, evaluation.performance, evaluation.fidelity),
    )


def numbers(values: Mapping[str, Value]) -> dict[str, float]:
    """The values as numbers; a count stays a whole number."""
    return {key: value if isinstance(value, int) else float(value) for key, value in values.items()}


def violation(design: Candidate) -> float:
    """How far the worst limit is missed, relative to its size; 0 where all hold, infinite where that is not known."""
    if not design.evaluation.ok or design.objective is None:
        return math.inf
    misses = [math.inf if item.margin is None else -item.margin for item in design.checks if not item.satisfied]
    return max(misses, default=0.0)


def better(one: Candidate, other: Candidate, objective: Objective) -> bool:
    """Whether ``one`` is the better design: what violates less first, then the objective."""
    miss, other_miss = violation(one), violation(other)
    if miss != other_miss:
        return miss < other_miss
    if one.objective is None or other.objective is None:
        return False
    return one.objective > other.objective if objective.maximise else one.objective < other.objective


@dataclass(frozen=True, slots=True)
class Box:
    """The continuous variables and their bounds (SI), with limits on the variables themselves in the bounds."""

    keys: tuple[str, ...]
    lower: tuple[float, ...]
    upper: tuple[float, ...]

    def point(self, values: Mapping[str, float]) -> Point:
        """The scaled point of these values, clipped into the bounds."""
        return self.tidy([(values[key] - low) / span for key, low, span in self._spans()])

    def values(self, point: Point) -> dict[str, float]:
        """The values (SI) at a scaled point, never outside the bounds."""
        moved = zip(self._spans(), self.upper, point, strict=True)
        return {key: min(max(low + x * span, low), high) for (key, low, span), high, x in moved}

    def tidy(self, point: Sequence[float]) -> Point:
        """The point within the bounds, cut to 9 digits: what differs by rounding errors only is one design."""
        return tuple(min(max(round(float(x), _DIGITS), 0.0), 1.0) for x in point)

    def contains(self, values: Mapping[str, float]) -> bool:
        bounds = zip(self._spans(), self.upper, strict=True)
        return all(low - 1e-12 * span <= values[key] <= high + 1e-12 * span for (key, low, span), high in bounds)

    def _spans(self) -> list[tuple[str, float, float]]:
        return [
            (key, low, (high - low) or 1.0) for key, low, high in zip(self.keys, self.lower, self.upper, strict=True)
        ]


def box(spec: Spec, limits: Sequence[Limit]) -> Box:
    """The study's continuous variables within bounds and limits. SpecError where nothing is left between them."""
    lower, upper = [], []
    variables = [variable for variable in spec.study.variables if not variable.integer]
    for variable in variables:
        own = [limit for limit in limits if limit.subject == variable.key]
        low = max([variable.lower, *(limit.limit for limit in own if limit.sense == ">=")])
        high = min([variable.upper, *(limit.limit for limit in own if limit.sense == "<=")])
        if low > high:
            key = spec.kind.key(variable.key)
            shown = [key.show(value) if key is not None else f"{value:g}" for value in (low, high)]
            raise SpecError(
                f"study.constraints cannot be met: {variable.key} would have to be at least {shown[0]} and at most "
                f"{shown[1]}."
            )
        lower.append(low)
        upper.append(high)
    return Box(tuple(variable.key for variable in variables), tuple(lower), tuple(upper))


@dataclass(frozen=True, slots=True)
class Merit:
    """What NLopt sees of a design: an objective to minimise and misses to bring below zero, all near 1 in size.

    scale : the objective's size, from the start design.
    """

    objective: Objective
    scale: float

    def loss(self, design: Candidate) -> float | None:
        """The objective, smaller is better; None for a design without it."""
        if design.objective is None or not math.isfinite(design.objective):
            return None
        return (-design.objective if self.objective.maximise else design.objective) / self.scale

    def misses(self, design: Candidate, held: Sequence[Limit]) -> tuple[float, ...]:
        """For each of the held limits minus its relative margin; 1 where the design does not give the figure."""
        margins = {item.limit: item.margin for item in design.checks}
        return tuple(-margin if (margin := margins.get(limit)) is not None else 1.0 for limit in held)
