"""Multipliers at a point of a front: how well it meets the optimality conditions, and what one objective costs."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.optimize.optimality import multipliers
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.pareto_scalar import Scalarisation, Scale
from fluxbore.optimize.pareto_sight import Sight
from fluxbore.optimize.slopes import NoSlopesError

_STEEPEST = 1e-6
"""Where the first objective has less than this share of the weight, the front is upright there."""


@dataclass(frozen=True, slots=True)
class Conditions:
    """The Karush-Kuhn-Tucker conditions at one design.

    residual : of `fluxbore.optimize.optimality.residual`, in ranges of an objective along the front per range of a
    variable. weights : of u and v in the stationarity condition, the loss's own and the rows' multipliers together.
    """

    residual: float
    weights: tuple[float, float]

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
    found, residual = multipliers(problem.view(seen, slack), (*sight.box.point(design.values), *slack))
    rows = list(zip(problem.rows, found, strict=False))
    return Conditions(
        residual,
        (
            float(problem.loss.first + sum(row.first * price for row, price in rows)),
            float(problem.loss.second + sum(row.second * price for row, price in rows)),
        ),
    )
