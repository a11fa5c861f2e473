"""The conditions of Karush, Kuhn and Tucker at a design, by exact derivatives: residual and multipliers.

For a problem  min f(x), g_i(x) <= 0, 0 <= x <= 1  in scaled numbers they are (Nocedal and Wright, Numerical
Optimization, 2nd ed. 2006, theorem 12.1)

    grad f + sum_i lambda_i grad g_i + sum_j nu_j (±e_j) = 0,    lambda, nu >= 0,    lambda_i g_i = 0,

and nu_j times the distance to its bound is 0. The multipliers are those that come nearest to all of it.
"""

from __future__ import annotations

from typing import Any

from fluxbore.optimize.gradient_search import View
from fluxbore.optimize.outcome import Candidate, Limit, Multiplier, Optimality
from fluxbore.optimize.problem import Box, Merit, Point
from fluxbore.optimize.slopes import Slopes

NEAR = 1e-2
"""Of a limit's size or a variable's range: what is farther away has no part in the optimum."""

NEGLIGIBLE = 1e-6
"""A share below this is rounding, not a price."""


def multipliers(view: View, x: Point) -> tuple[Any, float]:
    """Non-negative multipliers of misses, lower bounds and upper bounds, (k + 2n,), and the `residual` they leave.

    Stationarity and complementarity are one least-squares problem (Lawson and Hanson 1974, NNLS) over what is within
    `NEAR`: the multiplier of a limit costs what the limit has to spare.
    """
    import numpy as np
    from scipy.optimize import nnls

    sides, room = _sides(view, x)
    near = np.flatnonzero(room <= NEAR)
    matrix = np.vstack([sides[near].T, np.diag(room[near])])
    found = np.zeros(len(room))
    if len(near):
        found[near], _ = nnls(matrix, np.concatenate([-np.asarray(view.slope), np.zeros(len(near))]))
    return found, residual(view, x, found)


def residual(view: View, x: Point, found: Any) -> float:
    """The largest of |grad f + sum lambda grad g + sum nu (±e)| by component, of lambda_i |g_i| and nu_j x room.

    Numbers are scaled: f is relative to the objective's size, g to the limit's, x to the variable's range. So 1e-3
    means that a walk across the whole range of one variable promises about a thousandth of the objective, or that a
    limit with a price is missed or spared by as much. A miss itself counts too, priced or not.
    """
    import numpy as np

    sides, room = _sides(view, x)
    stationarity = np.abs(np.asarray(view.slope) + sides.T @ np.asarray(found))
    return float(max(stationarity.max(initial=0.0), (room * found).max(initial=0.0), *view.misses, 0.0))


def _sides(view: View, x: Point) -> tuple[Any, Any]:
    """Gradients (k + 2n, n) of misses, lower and upper bounds, and how far from each the point is (k + 2n,)."""
    import numpy as np

    size, count = len(x), len(view.misses)
    sides = np.vstack([np.reshape(view.miss_slopes, (count, size)), -np.eye(size), np.eye(size)])
    return sides, np.concatenate([np.abs(view.misses), np.asarray(x), 1 - np.asarray(x)])


def optimality(slopes: Slopes, made: Candidate, beside: Candidate | None = None) -> Optimality | None:
    """How nearly the design is a local optimum, and what its limits cost; None where it lacks figures or derivatives.

    A figure with a norm has the norm's direction of steepest ascent and the maximum's value.
    beside : a neighbour whose derivatives stand in for the design's own.
    """
    view = slopes.own_view(made, beside)
    if view is None or not slopes.box.keys:
        return None
    point = slopes.box.point(made.values)
    found, left = multipliers(view, point)
    held, size = len(slopes.held), len(point)
    prices = [
        _price(slopes.merit, limit, made, share)
        for limit, share in zip(slopes.held, found, strict=False)
        if share > NEGLIGIBLE
    ]
    for j in range(size):
        prices.append(_bound(slopes, made, j, ">=", found[held + j]))
        prices.append(_bound(slopes, made, j, "<=", found[held + size + j]))
    return Optimality(left, tuple(sorted((p for p in prices if p.share > NEGLIGIBLE), key=lambda p: -p.share)))


def _price(merit: Merit, limit: Limit, made: Candidate, share: float) -> Multiplier:
    value = next(item.value for item in made.checks if item.limit == limit)
    assert value is not None
    per_unit = _gain(merit, limit.sense) * share / limit.size
    return Multiplier(limit.subject, limit.sense, limit.limit, value, float(per_unit), float(share))


def _bound(slopes: Slopes, made: Candidate, j: int, sense: str, share: float) -> Multiplier:
    box: Box = slopes.box
    key, limit = box.keys[j], (box.lower if sense == ">=" else box.upper)[j]
    per_unit = _gain(slopes.merit, sense) * share / ((box.upper[j] - box.lower[j]) or 1.0)
    return Multiplier(key, sense, limit, made.values[key], float(per_unit), float(share), bound=True)


def _gain(merit: Merit, sense: str) -> float:
    """d objective for a limit raised by its size at a share of 1: raising "<=" betters it, raising ">=" worsens it."""
    better = merit.scale if merit.objective.maximise else -merit.scale
    return better if sense == "<=" else -better
