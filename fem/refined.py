"""A matrix solved with a factor of few digits, or with that of a neighbour: iterative refinement.

A factor in single precision gains four or five digits at each sweep. After Newton's last step the factor at hand
belongs to a field that differs by next to nothing, which gains as many; so neither costs anything in the end.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from fluxbore.fem.factors import Factor
from fluxbore.fem.mesh import Floats

TOLERANCE = 1e-11
"""Residual of a solution, relative to the right side, where nothing else is asked for."""

FINEST = 1e-12
"""What sweeps can reach for sure."""

ROUNDING = 1e-9
"""Residual that may be left where sweeps gain no more."""

MOST_SWEEPS = 6

CERTAIN = 0.01
"""Of the tolerance, where a sweep's gain is foretold by the last one's."""

WORTH = 0.1
"""A sweep that leaves more of the residual than this costs more than a better factor in the end."""


def lengths(columns: Floats) -> Floats:
    """(k,) Euclidean, of columns (n, k)."""
    return np.sqrt([float(column @ column) for column in columns.T])


class Refined:
    """x with A x = b for right sides (n,) or (n, k)."""

    def __init__(self, multiply: Callable[[Floats], Floats], rough: Factor, exact: Callable[[], Factor]) -> None:
        """multiply : A times columns (n, k). rough : a factor to begin with. exact : makes A's own, to all digits."""
        self._multiply, self._exact = multiply, exact
        self.factor = rough
        self._is_exact = False

    def solve(self, right: Floats) -> Floats:
        return self.within(right, TOLERANCE)

    def within(self, right: Floats, tolerance: float) -> Floats:
        """x with |b − A x| <= tolerance |b| for each right side, or as well as A's exact factor solves it; where sweeps
        gain no more, `ROUNDING` will do."""
        shaped = right.reshape(right.shape[0], -1)
        found = None if self._is_exact else self._swept(shaped, max(tolerance, FINEST))
        if found is None:
            if not self._is_exact:
                self.factor, self._is_exact = self._exact(), True
            found = self.factor.solve(shaped)
        return found.reshape(right.shape)

    def _swept(self, right: Floats, tolerance: float) -> Floats | None:
        """None where the factor is too rough."""
        scale = lengths(right)
        size, goal = scale, tolerance * scale
        x = self.factor.solve(right)
        for _ in range(MOST_SWEEPS):
            rest = right - self._multiply(x)
            before, size = size, lengths(rest)
            far = np.flatnonzero(~(size <= goal))
            if not far.size:
                return x
            gain = size[far] / before[far]
            if not np.all(gain <= WORTH):
                return x if np.all(size <= ROUNDING * scale) else None
            x[:, far] += self.factor.solve(rest[:, far])
            # Sweeps gain the same each time: one that is sure to be the last need not be looked at.
            if np.all(size[far] * gain <= CERTAIN * goal[far]):
                return x
        return None
