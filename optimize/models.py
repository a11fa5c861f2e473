"""Quadratic models of a search's loss and misses, fitted to the designs that it has seen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import Any

from fluxbore.optimize.archive import Archive
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.problem import Merit, Point, violation
from fluxbore.optimize.slopes import Slopes

NEAR = 0.02
"""The models are trusted at least this far from their centre, of each variable's range."""


@dataclass(frozen=True, slots=True)
class Models:
    """Loss and misses as quadratic polynomials of (x - centre)/radius, x scaled to the bounds.

    coefficients : (monomials, 1 + misses). loss : the centre's own.
    """

    centre: Point
    radius: float
    loss: float
    coefficients: Any

    def predict(self, points: Sequence[Point]) -> Any:
        """(points, 1 + misses): the loss and the misses that the models expect."""
        return _monomials(self._local(points)) @ self.coefficients

    def _local(self, points: Sequence[Point]) -> Any:
        import numpy as np

        return (np.asarray(points) - np.asarray(self.centre)) / self.radius


def fit(
    archive: Archive, merit: Merit, held: Sequence[Limit], share: int, slopes: Slopes | None = None
) -> Models | None:
    """Least squares through the designs nearest to the incumbent (or, without one, to the least infeasible design).

    share : designs for each coefficient. slopes : of designs that bring derivatives, which count as n further numbers
    of each design. None where there are not as many sound numbers as coefficients.
    """
    import numpy as np

    seen = [
        (point, loss, merit.misses(made, held))
        for point, made in archive.points
        if (loss := merit.loss(made)) is not None and not math.isinf(violation(made))
    ]
    if not seen:
        return None
    best = archive.best
    centre, loss, _ = (
        min(seen, key=lambda item: (max(item[2], default=0.0), item[1]))
        if best is None
        else next(item for item in seen if item[0] == archive.box.point(best.values))
    )
    size, views = len(centre), {}
    if slopes is not None:
        views = {point: view for point, made in archive.points if (view := slopes.own_view(made)) is not None}
        seen = [item for item in seen if item[0] in views]
    each, terms = (1 + size if views else 1), (size + 1) * (size + 2) // 2
    near = sorted(seen, key=lambda item: distance(item[0], centre))[: share * math.ceil(terms / each)]
    if len(near) * each < terms:
        return None
    models = Models(centre, max(distance(near[-1][0], centre), NEAR), loss, None)
    # Far designs say less about the curvature here than near ones.
    weights = np.array([1 / (1 + (3 * distance(point, centre) / models.radius) ** 2) for point, _, _ in near])[:, None]
    local = models._local([point for point, _, _ in near])
    basis, targets = _monomials(local), np.array([[loss, *misses] for _, loss, misses in near])
    if views:
        rows = [np.vstack([views[point].slope, *views[point].miss_slopes]) for point, _, _ in near]
        basis = np.vstack([basis, *(_monomial_slopes(local, k) for k in range(size))])
        targets = np.vstack([targets, *([row[:, k] * models.radius for row in rows] for k in range(size))])
        weights = np.vstack([weights] * each)
    coefficients, *_ = np.linalg.lstsq(basis * weights, targets * weights, rcond=1e-8)
    return Models(centre, models.radius, loss, coefficients)


def distance(one: Point, other: Point) -> float:
    """The largest difference of a variable, of its range."""
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


def _monomials(x: Any) -> Any:
    """1, x_i and x_i x_j of the rows of ``x``: (m, n) -> (m, (n + 1)(n + 2)/2)."""
    import numpy as np

    count, size = x.shape
    pairs = [x[:, i] * x[:, j] for i, j in combinations_with_replacement(range(size), 2)]
    return np.column_stack([np.ones(count), x, *pairs])


def _monomial_slopes(x: Any, k: int) -> Any:
    """Derivatives of `_monomials` by the variable number ``k``, in the same shape."""
    import numpy as np

    count, size = x.shape
    linear = np.zeros((count, size))
    linear[:, k] = 1.0
    pairs = [(i == k) * x[:, j] + (j == k) * x[:, i] for i, j in combinations_with_replacement(range(size), 2)]
    return np.column_stack([np.zeros(count), linear, *pairs])
