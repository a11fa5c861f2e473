"""Rounds the optimum to what a workshop makes, and looks again.

The step next to the optimum need not be the best one, nor feasible: where a limit runs slantwise through the steps, the
best design of the workshop's is often some steps along it. So the nearest steps are evaluated first, then those that
quadratic models of all designs seen so far expect to be better. Where designs bring derivatives, a few of them are
enough for such models, and these order the steps from the first one on.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce
from itertools import product

from fluxbore.design.study import Variable
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.gradient_search import View
from fluxbore.optimize.models import fit
from fluxbore.optimize.outcome import Candidate, Limit
from fluxbore.optimize.problem import Merit, Point, better
from fluxbore.optimize.slopes import Slopes

MOST_COMBINED = 4
"""Variables whose steps below and above are all combined; with more, each goes to its nearest step."""

MOST_ORDERED = 10
"""The same where derivatives put the combinations in order: 1024 are ordered, a few are evaluated."""

MOST_FURTHER = 5000
"""Combinations of further steps, ordered where a start on the steps is better than all that is expected of the nearest
and none of these is feasible."""

FURTHER_ROUNDS = 3
AT_ONCE = 2
"""Further designs: so many rounds of so many side by side."""

_REACH = {1: 40, 2: 20, 3: 7, 4: 3}
_SLACK = 1e-6


def reserve(variables: Sequence[Variable], slopes: Slopes | None = None) -> int:
    """The designs that a search keeps back from its budget for the rounding; 0 without a resolution."""
    near = _nearest_count(variables)
    if slopes is not None:
        near = min(near or 1, AT_ONCE * FURTHER_ROUNDS) if _stepped(variables) else 0
    return near + AT_ONCE if near else 0


def round_off(
    archive: Archive,
    variables: Sequence[Variable],
    merit: Merit,
    held: Sequence[Limit],
    tolerance: float,
    slopes: Slopes | None = None,
) -> Candidate | None:
    """The best design at the workshop's steps, evaluated; None without a resolution or without a feasible design.

    variables : the continuous ones. slopes : of designs that bring derivatives, else None.
    It may violate a limit where all that were tried do: its checks tell. ``tolerance`` is the relative gain that is
    worth another design. Stays within the archive's budget.
    """
    best = archive.best
    if best is None or not _stepped(variables):
        return None
    if slopes is not None and slopes.known(best) and len(_stepped(variables)) <= MOST_ORDERED:
        count = len(_stepped(variables))
        reach = _REACH.get(count, 0)
        around = _designs(archive, variables, best, reach, combined=True)
        for _ in range(1 + FURTHER_ROUNDS):
            expected = _ordered(archive, variables, around, slopes, tolerance)
            while not expected and (2 * reach + 4) ** count <= MOST_FURTHER and not _any_feasible(archive, around):
                reach += 1
                around = _designs(archive, variables, best, reach, combined=True)
                expected = _ordered(archive, variables, around, slopes, tolerance)
            if not expected or not archive.left:
                break
            archive.evaluate(expected[: archive.left])
        return _best_step(archive, variables)
    archive.evaluate(_designs(archive, variables, best, 0)[: min(_nearest_count(variables), archive.left)])
    if _combined(variables):
        around = _designs(archive, variables, best, _REACH[len(_stepped(variables))])
        for _ in range(FURTHER_ROUNDS):
            expected = _expected(archive, variables, around, merit, held, tolerance)
            if not expected or not archive.left:
                break
            archive.evaluate(expected[: archive.left])
    return _best_step(archive, variables)


def _ordered(
    archive: Archive,
    variables: Sequence[Variable],
    designs: Sequence[dict[str, float]],
    slopes: Slopes,
    tolerance: float,
) -> list[dict[str, float]]:
    """The designs not yet seen of which models by derivatives expect the most, the feasible ones first."""
    models = fit(archive, slopes.merit, slopes.held, share=4, slopes=slopes)
    points = [archive.box.point(values) for values in designs]
    if models is None:
        best = archive.best
        assert best is not None
        view, centre = slopes.own_view(best), archive.box.point(best.values)
        assert view is not None
        rows = [predicted(centre, view, point) for point in points]
    else:
        rows = models.predict(points)
    known = _best_step(archive, variables)
    bar = slopes.merit.loss(known) if known is not None and known.feasible else None
    ranked = []
    for i, (loss, *misses) in enumerate(rows):
        worst = max([0.0, *misses])
        if not archive.knows(points[i]) and (bar is None or (worst <= 0 and loss < bar - tolerance)):
            ranked.append((float(worst), float(loss), i))
    return [designs[i] for _, _, i in sorted(ranked)[:AT_ONCE]]


def _any_feasible(archive: Archive, designs: Sequence[dict[str, float]]) -> bool:
    """Whether any of these is known and feasible."""
    points = [archive.box.point(values) for values in designs]
    return any(archive.knows(point) and archive.at(point).feasible for point in points)


def predicted(centre: Point, view: View, point: Point) -> list[float]:
    """Loss and misses at a scaled point, to first order from the view at ``centre``."""
    step = [x - c for x, c in zip(point, centre, strict=True)]
    values = zip((view.loss, *view.misses), (view.slope, *view.miss_slopes), strict=True)
    return [value + sum(a * b for a, b in zip(slopes, step, strict=True)) for value, slopes in values]


def _expected(
    archive: Archive,
    variables: Sequence[Variable],
    designs: Sequence[dict[str, float]],
    merit: Merit,
    held: Sequence[Limit],
    tolerance: float,
) -> list[dict[str, float]]:
    """The designs not yet seen of which the models expect the most, if they expect more of them than what is known."""
    models = fit(archive, merit, held, share=4)
    if models is None:
        return []
    points = [archive.box.point(values) for values in designs]
    predicted = models.predict(points)
    known = _best_step(archive, variables)
    bar = merit.loss(known) if known is not None and known.feasible else None
    ranked = sorted(
        (float(row[0]), i)
        for i, row in enumerate(predicted)
        if all(miss <= 0 for miss in row[1:]) and (bar is None or row[0] < bar - tolerance)
    )
    return [designs[i] for _, i in ranked if not archive.knows(points[i])][:AT_ONCE]


def _best_step(archive: Archive, variables: Sequence[Variable]) -> Candidate | None:
    """The best of all designs seen, the start among them, that the workshop can make."""
    made = [
        design
        for _, design in archive.points
        if archive.box.contains(design.values) and all(_on_step(v, design.values[v.key]) for v in _stepped(variables))
    ]
    return reduce(lambda one, other: other if better(other, one, archive.objective) else one, made) if made else None


def _designs(
    archive: Archive, variables: Sequence[Variable], best: Candidate, reach: int, combined: bool | None = None
) -> list[dict[str, float]]:
    """The workshop's designs around ``best``, up to ``reach`` steps beyond the steps next to it, the nearest first."""
    choices = []
    combined = _combined(variables) if combined is None else combined
    for variable in variables:
        index = archive.box.keys.index(variable.key)
        bounds = archive.box.lower[index], archive.box.upper[index]
        steps = _steps(variable, best.values[variable.key], reach, *bounds)
        choices.append(steps if combined else steps[:1])
    keys = [variable.key for variable in variables]

    def distance(values: Sequence[float]) -> float:
        return math.hypot(
            *(
                (value - best.values[variable.key]) / variable.resolution
                for variable, value in zip(variables, values, strict=True)
                if variable.resolution is not None
            )
        )

    return [dict(zip(keys, values, strict=True)) for values in sorted(product(*choices), key=distance)]


def _steps(variable: Variable, value: float, reach: int, low: float, high: float) -> list[float]:
    """The multiples of the resolution around ``value`` within the bounds, the nearest first; else the value itself."""
    if variable.resolution is None:
        return [value]
    below = math.floor(value / variable.resolution + _SLACK) - reach
    above = math.ceil(value / variable.resolution - _SLACK) + reach
    # 12 digits: 29 steps of 0.05 mm are the 1.45 mm that a person would type.
    steps = [float(f"{count * variable.resolution:.12g}") for count in range(below, above + 1)]
    slack = 1e-9 * variable.resolution
    within = [min(max(step, low), high) for step in steps if low - slack <= step <= high + slack]
    return sorted(within, key=lambda step: (abs(step - value), step)) or [value]


def _on_step(variable: Variable, value: float) -> bool:
    count = value / (variable.resolution or 1.0)
    return abs(count - round(count)) < _SLACK


def _stepped(variables: Sequence[Variable]) -> list[Variable]:
    return [variable for variable in variables if variable.resolution is not None]


def _combined(variables: Sequence[Variable]) -> bool:
    return len(_stepped(variables)) <= MOST_COMBINED


def _nearest_count(variables: Sequence[Variable]) -> int:
    stepped = len(_stepped(variables))
    return 0 if not stepped else 2**stepped if _combined(variables) else 1
