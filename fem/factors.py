"""Factorisations of sparse symmetric positive definite matrices.

Banded Cholesky (LAPACK) suits meshes numbered across a long thin domain, SuperLU in its symmetric mode any mesh.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any, Protocol

import numpy as np

from fluxbore.fem.lapack import routine
from fluxbore.fem.pattern import Floats, Pattern


class SingularMatrixError(ArithmeticError):
    """The matrix has no factorisation: it is not positive definite, or a value in it is not finite."""


class Factor(Protocol):
    """A factorised matrix."""

    def solve(self, right: Floats) -> Floats:
        """x with A x = right; right is (n,) or (n, k)."""
        ...


class Band:
    """LAPACK's banded Cholesky: time n·b², memory n·b for n unknowns of half bandwidth b.

    band : (n, b + 1) lower triangle by columns from the diagonal down; overwritten.
    """

    def __init__(self, band: Floats) -> None:
        self._solver = routine("pbtrs", band.dtype)
        # The transpose is Fortran-ordered, so LAPACK overwrites it without a copy.
        self.factor, status = routine("pbtrf", band.dtype)(band.T, lower=1, overwrite_ab=1)
        if status != 0:
            raise SingularMatrixError(f"the matrix is not positive definite at unknown {status}")

    def solve(self, right: Floats) -> Floats:
        """x with A x = right; right is (n,) or (n, k)."""
        solution, status = self._solver(self.factor, right, lower=1)
        if status != 0:
            raise SingularMatrixError(f"LAPACK pbtrs refused argument {-status}")
        return np.asarray(solution)


class BandedCholesky:
    """`Band` of a pattern's values, and its copy in single precision for what needs few digits."""

    def __init__(self, pattern: Pattern, values: Floats) -> None:
        band = np.zeros((pattern.unknowns, pattern.bandwidth + 1))
        band[pattern.columns, pattern.rows - pattern.columns] = values
        self._band = Band(band)

    def solve(self, right: Floats) -> Floats:
        return self._band.solve(right)

    @cached_property
    def _single(self) -> tuple[Any, Any]:
        """The factor in single precision, and its solver."""
        band = self._band.factor.astype(np.float32)
        return band, routine("pbtrs", band.dtype)

    def solve_roughly(self, right: Floats) -> Floats:
        """`solve` to some five digits, in two thirds of the time or less; right is (n, k)."""
        band, solver = self._single
        scale = np.abs(right).max(axis=0, initial=1e-300)  # within what single precision can hold
        solution, status = solver(band, right / scale, lower=1)
        if status != 0:
            raise SingularMatrixError(f"LAPACK pbtrs refused argument {-status}")
        return np.asarray(solution * scale)


class SuperLU:
    """`symmetric_superlu` of a pattern's values."""

    def __init__(self, pattern: Pattern, values: Floats) -> None:
        self._factor = symmetric_superlu(pattern.matrix(values))

    def solve(self, right: Floats) -> Floats:
        return np.asarray(self._factor.solve(right))


def symmetric_superlu(matrix: Any) -> Any:
    """SuperLU of scipy's compressed columns with symmetric ordering and no pivoting, three times faster than its
    defaults on these matrices; raises SingularMatrixError."""
    from scipy.sparse.linalg import splu

    try:
        return splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    except RuntimeError as error:
        raise SingularMatrixError(str(error)) from error
