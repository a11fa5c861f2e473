"""Multipliers at a point of a front: how well it meets the optimality conditions, and what one objective costs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from fluxbore.optimize.gradient_search import View
from fluxbore.optimize.optimality import residual
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.pareto_scalar import Scalarisation, Scale
from fluxbore.optimize.pareto_sight import Sight
from fluxbore.optimize.problem import Point
from fluxbore.optimize.slopes import NoSlopesError

RESIDUAL = 10.0
"""The residual that is good enough, in tolerances."""

_SMALL = 1e-6
"""Weight of the multipliers' own size against the conditions."""

_STEEPEST = 1e-6
"""Where the first objective has less than this share of the weight, the front is upright there."""


@dataclass(frozen=True, slots=True)
class Conditions:
    """The Karush-Kuhn-Tucker conditions at one design.

    residual : of `fluxbore.optimize.optimality.residual`, in ranges of an objective along the front per range of a
    variable. weights : of u and v in the stationarity condition, the loss's own and the rows' multipliers together.
    spare : what using up the room that is left to rows and limits would gain, in ranges of the objective.
    """

    residual: float
    weights: tuple[float, float]
    spare: float = 0.0

    def settled(self, tolerance: float) -> bool:
        """Whether a further search would gain less than the tolerance; it is squared in what the residual promises."""
        return self.residual <= RESIDUAL * tolerance and self.spare <= tolerance

    def slope(self, scale: Scale) -> float | None:
        """d first/d second (SI) along the front: du/dv = -w_v/w_u; None where the first objective has no weight."""
        w_u, w_v = self.weights
        if w_u <= _STEEPEST * abs(w_v):
            return None
        (s_u, s_v), (r_u, r_v) = scale.signs, scale.span
        return -w_v / w_u * (r_u / s_u) / (r_v / s_v)


def met_at(problem: Scalarisation, sight: Sight, design: Candidate) -> Conditions | None:
    """How well the design meets the conditions of the problem, the slack being its best; None without gradients.

    A figure with a norm has the norm's gradient and the maximum's value. The room that a search leaves to the limits
    is no part of the problem.
    """
    if not sight.gradients:
        return None
    try:
        seen = sight.see(design, sight.kappas(design))
    except NoSlopesError:
        return None
    if seen is None:
        return None
    slack = problem.begin(seen)
    view, point = problem.view(seen, slack), (*sight.box.point(design.values), *slack)
    found = least_multipliers(view, point)
    rows = list(zip(problem.rows, found, strict=False))
    return Conditions(
        residual(view, point, found),
        (
            float(problem.loss.first + sum(row.first * price for row, price in rows)),
            float(problem.loss.second + sum(row.second * price for row, price in rows)),
        ),
        float(sum(price * abs(miss) for price, miss in zip(found, view.misses, strict=False))),
    )


def least_multipliers(view: View, point: Point) -> Any:
    """Of the non-negative multipliers of misses, lower and upper bounds that fit best the smallest ones, (k + 2n,).

    As `fluxbore.optimize.optimality.multipliers`, but unique: at an end of the front that lies in a corner of the box,
    any larger price of the one objective can be made good by one of the bound. The smallest is the slope of the front
    that leads away from there.
    """
    import numpy as np
    from scipy.optimize import nnls

    size, count = len(point), len(view.misses)
    sides = np.vstack([np.reshape(view.miss_slopes, (count, size)), -np.eye(size), np.eye(size)])
    room = np.concatenate([np.abs(view.misses), np.asarray(point), 1 - np.asarray(point)])
    matrix = np.vstack([sides.T, np.diag(room), _SMALL * np.eye(len(room))])
    found, _ = nnls(matrix, np.concatenate([-np.asarray(view.slope), np.zeros(2 * len(room))]))
    return found
