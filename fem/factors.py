"""Factorisations of sparse symmetric positive definite matrices.

Banded Cholesky (LAPACK) suits meshes numbered across a long thin domain, SuperLU in its symmetric mode any mesh.
What a pattern says to lie inside of cells is condensed out of the band first.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any, Protocol

import numpy as np

from fluxbore.fem.pattern import Floats, Pattern


class SingularMatrixError(ArithmeticError):
    """The matrix has no factorisation: it is not positive definite, or a value in it is not finite."""


REFINED = 1e-14
"""Residual of a refined solution, relative to the right side: below what the right sides themselves are exact to."""

ROUNDING = 1e-12
"""Residual that may be left where sweeps gain no more."""

ENOUGH = 1e-9
"""Of the residual: a sweep costs a tenth of a factor, so that Newton's steps are never solved for less."""

MOST_SWEEPS = 8

WORTH = 0.1
"""A sweep that leaves more of the residual than this says that the matrix is too ill-conditioned for its factor."""


class Factor(Protocol):
    """A factorised matrix."""

    def solve(self, right: Floats) -> Floats:
        """x with A x = right; right is (n,) or (n, k)."""
        ...


class _Band:
    """LAPACK's banded Cholesky of one array, in its own precision.

    band : (n, b + 1) lower triangle by columns from the diagonal down; overwritten.
    """

    def __init__(self, band: Any) -> None:
        from scipy.linalg import get_lapack_funcs

        # The transpose is Fortran-ordered, so LAPACK overwrites it without a copy.
        factor, self._solver = get_lapack_funcs(("pbtrf", "pbtrs"), (band,))
        self.factor, status = factor(band.T, lower=1, overwrite_ab=1)
        if status != 0:
            raise SingularMatrixError(f"the matrix is not positive definite at unknown {status}")

    def solve(self, right: Floats) -> Floats:
        if self.factor.dtype == np.float64:
            solution, status = self._solver(self.factor, right, lower=1)
        else:
            scale = np.abs(right).max(axis=0, initial=1e-300)  # within what single precision can hold
            solution, status = self._solver(self.factor, (right / scale).astype(np.float32), lower=1)
            solution = solution.astype(float) * scale
        if status != 0:
            raise SingularMatrixError(f"LAPACK pbtrs refused argument {-status}")
        return np.asarray(solution)


class BandedCholesky:
    """LAPACK's banded Cholesky: time n·b², memory n·b for n unknowns of half bandwidth b.

    Where the pattern has a `condensation`, the n unknowns are those that are left, and the factor is in single
    precision: half of the time and of the memory. It gains four or five digits at each sweep, and each solution is
    refined with the matrix itself, in double precision, to what is asked for. Where a matrix is too ill-conditioned
    for that, a factor in double precision takes over.
    """

    def __init__(self, pattern: Pattern, values: Floats) -> None:
        self._pattern, self._values = pattern, values
        self._condensed = None if pattern.condensation is None else pattern.condensation.condensed(values)
        if self._condensed is None:
            band = np.zeros((pattern.unknowns, pattern.bandwidth + 1))
            band[pattern.columns, pattern.rows - pattern.columns] = values
            self._band = _Band(band)
            return
        if not self._condensed.definite:
            raise SingularMatrixError("the matrix is not positive definite inside of a cell")
        try:
            self._band = _Band(self._condensed.band(np.float32))
        except SingularMatrixError:
            self._band = _Band(self._condensed.band(np.float64))

    @property
    def exact(self) -> bool:
        """Whether the factor is in double precision."""
        return bool(self._band.factor.dtype == np.float64)

    def solve(self, right: Floats) -> Floats:
        return self.within(right, REFINED)

    def within(self, right: Floats, tolerance: float) -> Floats:
        """x with |right − A x| <= tolerance |right|, or as well as the factor in double precision solves it."""
        if self.exact:
            return self.once(right)
        goal = min(max(tolerance, REFINED), ENOUGH) * _lengths(right)
        x = self.once(right)
        size: Floats | None = None
        for _ in range(MOST_SWEEPS):
            rest = right - np.asarray(self._matrix @ x)
            before, size = size, _lengths(rest)
            if np.all(size <= goal):
                return x
            if before is not None and np.any((size > goal) & (size > WORTH * before)):
                break
            x = x + self.once(rest)
        assert self._condensed is not None
        if size is not None and np.all(size <= ROUNDING * _lengths(right)):
            return x  # no factor does better
        self._band = _Band(self._condensed.band(np.float64))
        return self.once(right)

    def once(self, right: Floats) -> Floats:
        """What the factor gives in one sweep: exact but for rounding, or to some five digits."""
        return self._band.solve(right) if self._condensed is None else self._condensed.solve(right, self._band.solve)

    @cached_property
    def _matrix(self) -> Any:
        return self._pattern.matrix(self._values)

    @cached_property
    def _single(self) -> tuple[Any, Any]:
        """The factor in single precision, and its solver."""
        from scipy.linalg import get_lapack_funcs

        band = self._band.factor.astype(np.float32)
        return band, *get_lapack_funcs(("pbtrs",), (band,))

    def solve_roughly(self, right: Floats) -> Floats:
        """`solve` to some five digits, in two thirds of the time or less; right is (n, k)."""
        if not self.exact:
            return self.once(right)
        if self._condensed is None:
            return self._solve_roughly(right)
        return self._condensed.solve(right, self._solve_roughly)

    def _solve_roughly(self, right: Floats) -> Floats:
        band, solver = self._single
        scale = np.abs(right).max(axis=0, initial=1e-300)  # within what single precision can hold
        solution, status = solver(band, right / scale, lower=1)
        if status != 0:
            raise SingularMatrixError(f"LAPACK pbtrs refused argument {-status}")
        return np.asarray(solution * scale)


def _lengths(columns: Floats) -> Floats:
    """() or (k,) Euclidean, of (n,) or of columns (n, k)."""
    return np.asarray(np.sqrt(np.einsum("n...,n...->...", columns, columns)))


class SuperLU:
    """SuperLU with symmetric ordering and no pivoting, three times faster than its defaults on these matrices."""

    def __init__(self, pattern: Pattern, values: Floats) -> None:
        from scipy.sparse.linalg import splu

        try:
            self._factor = splu(
                pattern.matrix(values),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise SingularMatrixError(str(error)) from error

    def solve(self, right: Floats) -> Floats:
        return np.asarray(self._factor.solve(right))
