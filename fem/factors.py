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


class Factor(Protocol):
    """A factorised matrix."""

    def solve(self, right: Floats) -> Floats:
        """x with A x = right; right is (n,) or (n, k)."""
        ...


class BandedCholesky:
    """LAPACK's banded Cholesky: time n·b², memory n·b for n unknowns of half bandwidth b.

    The n unknowns are those that are left where the pattern has a `condensation`.
    """

    def __init__(self, pattern: Pattern, values: Floats) -> None:
        from scipy.linalg import get_lapack_funcs

        places = pattern.condensation
        self._condensed = None if places is None else places.condensed(values)
        if self._condensed is not None:
            if not self._condensed.definite:
                raise SingularMatrixError("the matrix is not positive definite inside of a cell")
            band = self._condensed.take_band()
        else:
            band = np.zeros((pattern.unknowns, pattern.bandwidth + 1))
            band[pattern.columns, pattern.rows - pattern.columns] = values
        # The transpose is Fortran-ordered, so LAPACK overwrites it without a copy.
        factor, self._solver = get_lapack_funcs(("pbtrf", "pbtrs"), (band,))
        self._band, status = factor(band.T, lower=1, overwrite_ab=1)
        if status != 0:
            raise SingularMatrixError(f"the matrix is not positive definite at unknown {status}")

    def solve(self, right: Floats) -> Floats:
        return self._solve(right) if self._condensed is None else self._condensed.solve(right, self._solve)

    def _solve(self, right: Floats) -> Floats:
        """With the band alone."""
        solution, status = self._solver(self._band, right, lower=1)
        if status != 0:
            raise SingularMatrixError(f"LAPACK pbtrs refused argument {-status}")
        return np.asarray(solution)

    @cached_property
    def _single(self) -> tuple[Any, Any]:
        """The factor in single precision, and its solver."""
        from scipy.linalg import get_lapack_funcs

        band = self._band.astype(np.float32)
        return band, *get_lapack_funcs(("pbtrs",), (band,))

    def solve_roughly(self, right: Floats) -> Floats:
        """`solve` to some five digits, in two thirds of the time; right is (n, k)."""
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
