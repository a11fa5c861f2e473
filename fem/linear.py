"""Sparse symmetric positive definite systems behind one small interface.

Three methods take a pattern's values: banded Cholesky, SuperLU, and `multigrid` for the largest matrices. Newton's
matrices are near to one another, so that the factor of one also serves to solve with the next.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any, Literal

import numpy as np

from fluxbore.fem.conjugate_gradients import conjugate_gradients
from fluxbore.fem.factors import BandedCholesky, Factor, SingularMatrixError, SuperLU
from fluxbore.fem.pattern import Floats, Pattern
from fluxbore.fem.refined import lengths

Method = Literal["auto", "banded", "superlu", "multigrid"]

LARGE = 100_000
"""Unknowns from which multigrid is the default: from no field to saturation it takes 10 s at 179,000 unknowns, where
SuperLU takes 9 s at 83,000 (docs/validation/scaling.md). Below, SuperLU's many right sides are worth more than that."""

LARGEST_FACTOR = 400_000
"""Unknowns up to which SuperLU steps in where multigrid fails; there a factor takes 14 s, by the law in `choose`."""


MOST_REFINEMENTS = 6
"""A neighbour that is worth refining with gains two digits or more each time."""


def choose(pattern: Pattern) -> Method:
    """The fastest method for a pattern.

    A band of half width b costs n·b² operations at some 2e10 a second, SuperLU 5.5e-8 s times n^1.5 on a square of
    triangles (both measured): they meet at b = 33 n^0.25.
    """
    if pattern.bandwidth < 33 * pattern.unknowns**0.25:
        return "banded"
    return "superlu" if pattern.unknowns < LARGE else "multigrid"


def check_finite(values: Floats) -> None:
    """Raises SingularMatrixError."""
    if not np.all(np.isfinite(values)):
        raise SingularMatrixError("a value of the matrix is not finite")


def factorise(pattern: Pattern, values: Floats, method: Method = "banded") -> Factor:
    """Factorise the symmetric positive definite matrix with these values.

    values : (nnz,) in the pattern's order.

    Raises SingularMatrixError where there is no factorisation.
    """
    check_finite(values)
    chosen = choose(pattern) if method == "auto" else method
    if chosen == "banded":
        return BandedCholesky(pattern, values)
    if chosen == "superlu":
        return SuperLU(pattern, values)
    from fluxbore.fem.multigrid import Multigrid

    return Multigrid(pattern, values, rescue=method == "auto" and pattern.unknowns <= LARGEST_FACTOR)


class Corrected:
    """A matrix solved with the factor of a neighbour: conjugate gradients preconditioned by that factor.

    After Newton's last step the factor at hand belongs to a field that differs by next to nothing, so two or three
    iterations give full accuracy for a tenth of a factorisation.
    """

    TOLERANCE = 1e-13

    def __init__(self, pattern: Pattern, values: Floats, neighbour: Factor, method: Method) -> None:
        from fluxbore.fem.multigrid import Multigrid

        self._pattern, self._values, self._method = pattern, values, method
        # A factor takes as long as 15 iterations at 10,000 unknowns and 40 at 200,000; for all right sides together.
        self._affordable = max(12, round(0.1 * pattern.unknowns**0.5))
        self._own = False
        nearest = neighbour.nearest if isinstance(neighbour, Corrected) else neighbour
        self.nearest: Factor = nearest.renewed(values) if isinstance(nearest, Multigrid) else nearest
        """The neighbour's factor, or this matrix's own once the neighbour has turned out to be too far away."""

    @cached_property
    def _matrix(self) -> Any:
        return self._pattern.matrix(self._values)

    def solve(self, right: Floats) -> Floats:
        """x with A x = right; right is (n,) or (n, k). Raises SingularMatrixError."""
        return self.within(right, 0.0)

    def within(self, right: Floats, tolerance: float) -> Floats:
        """x with |right − A x| <= tolerance |right|, or as well as `solve`; right is (n,) or (n, k)."""
        from fluxbore.fem.multigrid import Multigrid

        if isinstance(self.nearest, Multigrid):
            return self.nearest.within(right, tolerance)
        if self._own:
            return self.nearest.solve(right)
        if right.ndim == 2:
            refined = self._refined(right, max(tolerance, self.TOLERANCE))
            if refined is not None:
                return refined
            return np.column_stack([self.within(column, tolerance) for column in right.T])
        found = conjugate_gradients(
            lambda x: np.asarray(self._matrix @ x),
            self.nearest.solve,
            right,
            max(tolerance, self.TOLERANCE),
            self._affordable,
            prospects=True,
        )
        self._affordable -= found.iterations
        if found.reached:
            return found.x
        self.nearest, self._own = factorise(self._pattern, self._values, self._method), True
        return self.nearest.solve(right)

    def _refined(self, right: Floats, tolerance: float) -> Floats | None:
        """Iterative refinement of many right sides (n, k) at once; None where the neighbour is too far for it.

        What corrects a first solution needs few digits of its own, so that single precision does, unless the matrix
        is so ill-conditioned that it gains less than a digit.
        """
        size = lengths(right)
        goal = tolerance * size
        x = self.nearest.solve(right)
        correct = self.nearest.solve_roughly if isinstance(self.nearest, BandedCholesky) else self.nearest.solve
        for sweep in range(1, MOST_REFINEMENTS + 1):
            rest = right - self._matrix @ x
            before, size = size, lengths(rest)
            far = np.flatnonzero(size > goal)
            if not far.size:
                return x
            if np.any(size[far] > 0.1 * before[far]):
                correct = self.nearest.solve
            if sweep < MOST_REFINEMENTS:
                x[:, far] += correct(rest[:, far])
        return None


class Tangents:
    """Factors of matrices of one pattern, each near to the last: Newton's.

    A narrow band is factorised faster than neighbours are corrected, so there each matrix gets a factor of its own.
    """

    def __init__(self, pattern: Pattern, values: Callable[[Floats], Floats], method: Method) -> None:
        """values : the matrix (nnz,) at a point (n,)."""
        self._pattern, self._values, self._method = pattern, values, method
        self._banded = (choose(pattern) if method == "auto" else method) == "banded"
        self._last: Factor | None = None

    def __call__(self, x: Floats) -> Factor:
        """The matrix at x, ready to solve with. Raises SingularMatrixError where there is no factorisation."""
        values = self._values(x)
        if self._last is None or self._banded:
            self._last = factorise(self._pattern, values, self._method)
        else:
            check_finite(values)
            self._last = Corrected(self._pattern, values, self._last, self._method)
        return self._last
