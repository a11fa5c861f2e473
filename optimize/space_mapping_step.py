"""One step of the mapping: the surrogate's optimum under all limits, within the trust region."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.optimize.gradient_search import View, minimise
from fluxbore.optimize.problem import Box, Point
from fluxbore.optimize.space_mapping_response import Array
from fluxbore.optimize.space_mapping_surrogate import Surrogate

LARGEST_PENALTY = 1e6
GROWTH = 10.0
SOLVED = 1e-6
"""A smaller miss is SLSQP's own, and no reason for a larger penalty."""

RUNS = 3
CALLS = 120
"""Of the surrogate in one run of SLSQP."""


@dataclass(frozen=True, slots=True)
class Step:
    """Where the surrogate is best: x (n,), cut to the archive's digits; its merit there; what it expects (1 + m,).

    penalty : the merit's, raised where the limits asked for it.
    """

    x: Array
    expected: Array
    penalty: float


def merit_value(values: Array, penalty: float, room: float) -> float:
    """Loss + penalty times the worst miss, ``room`` to be left to each limit: an exact penalty (Fletcher 1987)."""
    return float(values[0] + penalty * worst_miss(values, room))


def worst_miss(values: Array, room: float) -> float:
    """The worst of the misses; 0 where every limit holds with ``room`` to spare, or where there is none."""
    return float(np.max(values[1:] + room, initial=0.0))


def best_step(model: Surrogate, box: Box, radius: float, penalty: float, room: float) -> Step:
    """Minimise loss + penalty t with miss_i + room <= t, t >= 0, over the box and |d_i| <= radius.

    With t the problem has a feasible point whatever the limits; where t stays above zero the penalty grows until it no
    longer helps, so that a region that cannot be feasible comes as near as it can.
    """
    step = _solve(model, box, radius, penalty, room)
    while (missed := _missed(step, room)) > 0 and penalty < LARGEST_PENALTY:
        penalty *= GROWTH
        again = _solve(model, box, radius, penalty, room)
        if _missed(again, room) > 0.9 * missed:
            break
        step = again
    return step


def _missed(step: Step, room: float) -> float:
    worst = worst_miss(step.expected, room)
    return worst if worst > SOLVED else 0.0


def _solve(model: Surrogate, box: Box, radius: float, penalty: float, room: float) -> Step:
    """Runs of SLSQP, each from the best point so far; that point counts, whatever SLSQP says of its end.

    A run that ends where it began may have failed in its line search, which a region of its own size mends.
    """
    centre, here = model.centre.x, model.centre.fine.values
    best = _Best(merit_value(here, penalty, room), centre, here)
    start, reach = best.size, radius
    for _ in range(RUNS):
        before = best.size
        low = np.maximum(np.maximum(centre - radius, best.x - reach), 0.0)
        high = np.minimum(np.minimum(centre + radius, best.x + reach), 1.0)
        _run(model, box, best, (low, high), penalty, room)
        if before - best.size > 0.01 * (start - best.size):
            continue
        if best.size < start:
            break
        reach /= 8
    return Step(best.x, best.values, penalty)


@dataclass(slots=True)
class _Best:
    """The best point of the surrogate so far: its merit, where it is (n,), and what is expected there (1 + m,)."""

    size: float
    x: Array
    values: Array


def _run(model: Surrogate, box: Box, best: _Best, region: tuple[Array, Array], penalty: float, room: float) -> None:
    """Let SLSQP look for something better within the region, in coordinates of its size and with t as the last."""
    low, high = region
    span, limits, size = high - low, len(model.a) - 1, low.size
    scale = float(span.max(initial=0.0)) or 1.0  # the smaller the region, the smaller its gains and misses
    origin, slack = best.values[0], worst_miss(best.values, room) / scale

    def view(u: Point) -> View | None:
        x = low + np.array(u[:size]) * span
        point = np.array(box.tidy(x))
        values, there = model.at(x), model.at(point)
        if values is None:
            return None
        if there is not None and (merit := merit_value(there, penalty, room)) < best.size:
            best.size, best.x, best.values = merit, point, there
        slopes = model.slopes_at(x) * (span / scale)
        loss = float(values[0] - origin) / scale
        if not limits:
            return View(loss, (), tuple(slopes[0]), ())
        misses = (values[1:] + room) / scale - u[-1]
        rows = tuple((*row, -1.0) for row in slopes[1:])
        return View(loss + penalty * u[-1], tuple(misses), (*slopes[0], penalty), rows)

    extra = 1 if limits else 0
    begin = np.divide(best.x - low, span, out=np.zeros(size), where=span > 0)
    ending = minimise(
        view,
        [*begin, *([slack] * extra)],
        [0.0] * (size + extra),
        [*(span > 0).astype(float), *([2 * slack + 10.0] * extra)],
        objective_tolerance=1e-10,
        variable_tolerance=1e-9,
        calls=CALLS,
    )
    if ending.stopped_by is not None:
        raise ending.stopped_by
