"""Conjugate gradients with a multigrid preconditioner, for matrices too large for a factorisation.

Algebraic multigrid by smoothed aggregation: the iterations hardly depend on the size, so time and memory are in
proportion to the unknowns. The matrix tells all: jumps between iron and air, stretched elements and signs of
antiperiodic pairs need no care.

Two grids of one mesh (quadratic and linear triangles, aggregation below) are twice as fast where triangles are sound,
but need more than 200 iterations on the stretched cells of mapped meshes, where this needs 35.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from fluxbore.fem.aggregation import v_cycle
from fluxbore.fem.conjugate_gradients import Iterated, conjugate_gradients
from fluxbore.fem.factors import Factor, SingularMatrixError, SuperLU
from fluxbore.fem.pattern import Floats, Pattern

STRENGTH = 0.08
"""θ. At 0, quadratic triangles take twice the iterations, growing with the mesh; at 0.25 the coarse grids fail.
Stretched cells of mapped meshes take 26 iterations at 0.08 to 0.15 and 88 at 0.05."""


class Multigrid:
    """The hierarchy for one matrix; each right side costs some 25 iterations.

    rescue : whether SuperLU steps in where the iteration fails. neighbour : whose hierarchy is tried first.
    iterations : of the last right side.
    """

    TOLERANCE = 1e-11
    """Of the residual relative to the right side: Newton's tolerance and a margin."""

    LIMIT = 150
    """Iterations; four times as many as the most stretched meshes need."""

    BORROWED_LIMIT = 25
    """Iterations on a neighbour's hierarchy after which one of its own is cheaper."""

    def __init__(
        self, pattern: Pattern, values: Floats, rescue: bool = False, neighbour: Multigrid | None = None
    ) -> None:
        self._pattern, self._values, self._rescue = pattern, values, rescue
        self._matrix = _rows(pattern, values)
        self._cycle: Any = _aggregates(self._matrix) if neighbour is None else neighbour._cycle
        self._borrowed = neighbour is not None
        self._direct: Factor | None = None
        self.iterations = 0

    def renewed(self, values: Floats) -> Multigrid:
        """For a neighbouring matrix, with this one's hierarchy for as long as it serves."""
        return Multigrid(self._pattern, values, self._rescue, self)

    def solve(self, right: Floats) -> Floats:
        """x with A x = right; right is (n,) or (n, k).

        Raises SingularMatrixError where the iteration does not converge and nothing steps in.
        """
        return self.within(right, self.TOLERANCE)

    def within(self, right: Floats, tolerance: float) -> Floats:
        """x with |right − A x| <= tolerance |right|, tolerance at least `TOLERANCE`; right is (n,) or (n, k).

        Raises SingularMatrixError as `solve` does.
        """
        if right.ndim == 2:
            return np.column_stack([self.within(column, tolerance) for column in right.T])
        tolerance = max(tolerance, self.TOLERANCE)
        if self._direct is not None:
            return self._direct.solve(right)
        x = np.zeros(right.size)
        self.iterations = 0
        if self._borrowed:
            found = self._iterate(right, tolerance, self.BORROWED_LIMIT, prospects=True)
            if found.reached:
                return found.x
            self._cycle, self._borrowed = _aggregates(self._matrix), False
            if found.definite:
                size = float(np.linalg.norm(found.residual))
                x, tolerance = found.x, min(tolerance * float(np.linalg.norm(right)) / size, 1.0)
                right = found.residual
        found = self._iterate(right, tolerance, self.LIMIT)
        if found.reached:
            return x + found.x
        if self._rescue:
            self._direct = SuperLU(self._pattern, self._values)
            return x + self._direct.solve(right)
        if not found.definite:
            raise SingularMatrixError("the matrix is not positive definite")
        raise SingularMatrixError(f"multigrid did not converge in {self.LIMIT} iterations")

    def _iterate(self, right: Floats, tolerance: float, limit: int, prospects: bool = False) -> Iterated:
        found = conjugate_gradients(
            lambda x: np.asarray(self._matrix @ x),
            lambda r: np.asarray(self._cycle @ r),
            right,
            tolerance,
            limit,
            prospects,
        )
        self.iterations += found.iterations
        return found


def _rows(pattern: Pattern, values: Floats) -> Any:
    """The full matrix in compressed rows.

    Raises SingularMatrixError for a diagonal that is not positive.
    """
    from scipy.sparse import csr_array

    indices, start, order = pattern.symmetric
    diagonal = values[pattern.rows == pattern.columns]
    if diagonal.size < pattern.unknowns or not np.all(diagonal > 0):
        raise SingularMatrixError("the matrix is not positive definite: its diagonal is not positive")
    return csr_array((values[order], indices, start), shape=(pattern.unknowns, pattern.unknowns))


def _aggregates(matrix: Any) -> Any:
    """One symmetric V-cycle as a linear operator. Raises SingularMatrixError."""
    try:
        return v_cycle(matrix, STRENGTH)
    except RuntimeError as error:
        raise SingularMatrixError(str(error)) from error
