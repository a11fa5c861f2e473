"""Sparse symmetric positive definite systems behind one small interface.

A `Pattern` knows where element matrices land and is shared by all Newton steps, positions and designs of one mesh
topology. Two factorisations take its values: banded Cholesky (LAPACK), which suits meshes numbered across a long thin
domain, and SuperLU in its symmetric mode, which suits any mesh.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int_]
Method = Literal["banded", "superlu"]


class SingularMatrixError(ArithmeticError):
    """The matrix has no factorisation: it is not positive definite, or a value in it is not finite."""


class Factor(Protocol):
    """A factorised matrix."""

    def solve(self, right: Floats) -> Floats:
        """x with A x = right; right is (n,) or (n, k)."""
        ...


@dataclass(frozen=True, eq=False)
class Pattern:
    """The lower triangle's nonzero positions, and how entries of element matrices are summed into them.

    rows, columns : (nnz,) of the lower triangle, sorted by column, then by row.
    sources : (k,) flat index into all element matrices (m, 6, 6) of the entries that count.
    targets : (k,) index into (nnz,) for each source.
    owners : (k,) the element of each source. block : entries of one element's matrix.
    """

    unknowns: int
    rows: Ints
    columns: Ints
    sources: Ints
    targets: Ints
    owners: Ints
    block: int

    @classmethod
    def of_elements(cls, freedom: Ints, unknowns: int) -> Pattern:
        """freedom : (m, k) unknown of each element's node, -1 where there is none."""
        k = freedom.shape[1]
        row = np.repeat(freedom, k, axis=1).ravel()
        column = np.tile(freedom, (1, k)).ravel()
        kept = np.flatnonzero((column >= 0) & (row >= column))
        code = column[kept] * unknowns + row[kept]
        unique, targets = np.unique(code, return_inverse=True)
        return cls(unknowns, unique % unknowns, unique // unknowns, kept, targets.ravel(), kept // (k * k), k * k)

    @property
    def nonzeros(self) -> int:
        return self.rows.size

    def assemble(self, matrices: Floats) -> Floats:
        """(nnz,) values of the global matrix from all element matrices (m, k, k)."""
        return np.asarray(np.bincount(self.targets, matrices.ravel()[self.sources], self.nonzeros))

    def subset(self, elements: Ints) -> tuple[Ints, Ints]:
        """Sources and targets of some elements only, for matrices (len(elements), k, k) of just these."""
        size = int(self.owners.max()) + 1 if self.owners.size else 0
        place = np.full(max(size, int(elements.max(initial=-1)) + 1), -1)
        place[elements] = np.arange(elements.size)
        chosen = np.flatnonzero(place[self.owners] >= 0)
        block = self.sources[chosen] % self.block
        return place[self.owners[chosen]] * self.block + block, self.targets[chosen]

    @cached_property
    def bandwidth(self) -> int:
        return int((self.rows - self.columns).max(initial=0))

    @cached_property
    def symmetric(self) -> tuple[Ints, Ints, Ints]:
        """(indices, indptr, order): the full matrix in compressed columns; order picks its values from (nnz,)."""
        lower = np.arange(self.nonzeros)
        off = self.rows != self.columns
        row = np.concatenate((self.rows, self.columns[off]))
        column = np.concatenate((self.columns, self.rows[off]))
        value = np.concatenate((lower, lower[off]))
        order = np.lexsort((row, column))
        start = np.concatenate(([0], np.cumsum(np.bincount(column, minlength=self.unknowns))))
        return row[order], start, value[order]

    def multiply(self, values: Floats, vector: Floats) -> Floats:
        """A x for the symmetric matrix of these values."""
        return np.asarray(self._full(values) @ vector)

    def _full(self, values: Floats) -> Any:
        from scipy.sparse import csc_matrix

        indices, start, order = self.symmetric
        return csc_matrix((values[order], indices, start), shape=(self.unknowns, self.unknowns))


def factorise(pattern: Pattern, values: Floats, method: Method = "banded") -> Factor:
    """Factorise the symmetric positive definite matrix with these values.

    values : (nnz,) in the pattern's order.

    Raises SingularMatrixError where there is no factorisation.
    """
    if not np.all(np.isfinite(values)):
        raise SingularMatrixError("a value of the matrix is not finite")
    return BandedCholesky(pattern, values) if method == "banded" else SuperLU(pattern, values)


class Corrected:
    """A matrix solved with the factor of a neighbour: conjugate gradients preconditioned by that factor.

    After Newton's last step the factor at hand belongs to a field that differs by next to nothing, so two or three
    iterations give full accuracy for a tenth of a factorisation.
    """

    LIMIT = 12
    """Iterations after which a factorisation of its own is cheaper."""

    def __init__(self, pattern: Pattern, values: Floats, neighbour: Factor, method: Method) -> None:
        self._pattern, self._values, self._factor, self._method = pattern, values, neighbour, method

    def solve(self, right: Floats) -> Floats:
        if right.ndim == 2:
            return np.column_stack([self.solve(column) for column in right.T])
        x = np.zeros_like(right)
        r = right
        goal = 1e-13 * float(np.linalg.norm(right))
        direction, before = x, 1.0
        for iteration in range(self.LIMIT):
            if float(np.linalg.norm(r)) <= goal:
                return x
            z = self._factor.solve(r)
            now = float(r @ z)
            direction = z if iteration == 0 else z + (now / before) * direction
            image = self._pattern.multiply(self._values, direction)
            step = now / float(direction @ image)
            x, r, before = x + step * direction, r - step * image, now
        self._factor = factorise(self._pattern, self._values, self._method)
        return self._factor.solve(right)


class BandedCholesky:
    """LAPACK's banded Cholesky: time n·b², memory n·b for n unknowns of half bandwidth b."""

    def __init__(self, pattern: Pattern, values: Floats) -> None:
        from scipy.linalg import get_lapack_funcs

        band = np.zeros((pattern.unknowns, pattern.bandwidth + 1))
        band[pattern.columns, pattern.rows - pattern.columns] = values
        # The transpose is Fortran-ordered, so LAPACK overwrites it without a copy.
        factor, self._solver = get_lapack_funcs(("pbtrf", "pbtrs"), (band,))
        self._band, status = factor(band.T, lower=1, overwrite_ab=1)
        if status != 0:
            raise SingularMatrixError(f"the matrix is not positive definite at unknown {status}")

    def solve(self, right: Floats) -> Floats:
        solution, status = self._solver(self._band, right, lower=1)
        if status != 0:
            raise SingularMatrixError(f"LAPACK pbtrs refused argument {-status}")
        return np.asarray(solution)


class SuperLU:
    """SuperLU with symmetric ordering and no pivoting, three times faster than its defaults on these matrices."""

    def __init__(self, pattern: Pattern, values: Floats) -> None:
        from scipy.sparse.linalg import splu

        try:
            self._factor = splu(
                pattern._full(values),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise SingularMatrixError(str(error)) from error

    def solve(self, right: Floats) -> Floats:
        return np.asarray(self._factor.solve(right))
