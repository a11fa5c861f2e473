"""Unknowns inside of cells, taken out of a matrix before it is factorised.

The node in the middle of a mapped mesh's cell meets the cell's own nodes only. Of the matrix

    | K  C | |x|   |a|                         (K − C D⁻¹ Cᵀ) x = a − C D⁻¹ b ,
    | Cᵀ D | |y| = |b|   with D diagonal:      y = D⁻¹ (b − Cᵀ x) ,

so that a quarter of the unknowns and of the band's width cost next to nothing (static condensation, Wilson 1974).
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from fluxbore.fem.pattern import Pattern

Floats = NDArray[np.float64]
Ints = NDArray[np.int_]


class Condensation:
    """Where a pattern's values land in the band of K − C D⁻¹ Cᵀ; made once for all matrices of the pattern.

    kept, inner : the unknowns of x and of y. bandwidth : of what is left, below the diagonal.
    """

    def __init__(self, pattern: Pattern, inner: Ints) -> None:
        """inner : unknowns of which no two meet in an element."""
        is_inner = np.zeros(pattern.unknowns, dtype=bool)
        is_inner[inner] = True
        self.inner, self.kept = np.flatnonzero(is_inner), np.flatnonzero(~is_inner)
        number = np.where(is_inner, np.cumsum(is_inner), np.cumsum(~is_inner)) - 1
        row_inner, column_inner = is_inner[pattern.rows], is_inner[pattern.columns]
        on_diagonal = pattern.rows == pattern.columns
        assert not np.any(row_inner & column_inner & ~on_diagonal)
        self._diagonal = np.flatnonzero(row_inner & on_diagonal)
        self._couplings(pattern, number, row_inner, column_inner)
        self._places(pattern, number, np.flatnonzero(~row_inner & ~column_inner))

    def _couplings(self, pattern: Pattern, number: Ints, row_inner: Any, column_inner: Any) -> None:
        """C by its columns: which of the pattern's values, and in which rows."""
        mixed = np.flatnonzero(row_inner != column_inner)
        upper = row_inner[mixed]
        inside = number[np.where(upper, pattern.rows[mixed], pattern.columns[mixed])]
        outside = number[np.where(upper, pattern.columns[mixed], pattern.rows[mixed])]
        order = np.lexsort((outside, inside))
        self._values, self._rows = mixed[order], outside[order]
        self._starts = np.concatenate(([0], np.cumsum(np.bincount(inside, minlength=self.inner.size))))

    def _places(self, pattern: Pattern, number: Ints, own: Ints) -> None:
        """Of K's values and of the products of C's, by pairs in each column, the place in the band."""
        count = np.diff(self._starts)
        widest = int(count.max(initial=0))
        # Columns as rows of equal length; those that are shorter point at a zero after the last value.
        slot = np.arange(widest)
        filled = slot < count[:, None]
        entry = np.where(filled, self._starts[:-1, None] + slot, 0)
        self._padded = np.where(filled, self._values[entry], pattern.nonzeros)
        first, second = np.tril_indices(widest)
        self._pairs = first, second
        real = (filled[:, first] & filled[:, second]).ravel()
        rows, columns = (self._rows[entry][:, index].ravel()[real] for index in (first, second))
        self._own, self._real = own, np.flatnonzero(real)
        own_rows, own_columns = number[pattern.rows[own]], number[pattern.columns[own]]
        self.bandwidth = int(max((own_rows - own_columns).max(initial=0), (rows - columns).max(initial=0)))
        places = np.concatenate((own_columns, columns)) * (self.bandwidth + 1)
        places += np.concatenate((own_rows - own_columns, rows - columns))
        self._place, self._target = np.unique(places, return_inverse=True)

    @cached_property
    def size(self) -> int:
        return int(self.kept.size)

    def condensed(self, values: Floats) -> Condensed:
        """Of the matrix with these values (nnz,) of the pattern."""
        return Condensed(self, values)

    def inverse_diagonal(self, values: Floats) -> Floats:
        """(inner,) of D; zero where D is not positive."""
        diagonal = values[self._diagonal]
        return np.divide(1.0, diagonal, out=np.zeros_like(diagonal), where=diagonal > 0)

    def band(self, values: Floats, inverse: Floats, precision: type[np.floating[Any]]) -> Any:
        """(kept, bandwidth + 1) the lower triangle of K − C D⁻¹ Cᵀ, by columns from the diagonal down."""
        columns = np.append(values, 0.0)[self._padded]
        first, second = self._pairs
        products = (columns[:, first] * (columns * -inverse[:, None])[:, second]).ravel()[self._real]
        entries = np.bincount(self._target, np.concatenate((values[self._own], products)), self._place.size)
        band = np.zeros((self.size, self.bandwidth + 1), dtype=precision)
        band.ravel()[self._place] = entries
        return band

    def coupling(self, values: Floats) -> Any:
        """C (kept, inner), sparse."""
        from scipy.sparse import csc_array

        return csc_array((values[self._values], self._rows, self._starts), shape=(self.size, self.inner.size))


class Condensed:
    """One matrix, condensed. definite : whether D is positive; K − C D⁻¹ Cᵀ then tells of the rest."""

    def __init__(self, places: Condensation, values: Floats) -> None:
        self._places = places
        self._inverse = places.inverse_diagonal(values)
        self.definite = bool(np.all(self._inverse > 0))
        self._coupling = places.coupling(values)
        self._transposed = self._coupling.T
        self._values = values

    def band(self, precision: type[np.floating[Any]]) -> Any:
        """`Condensation.band`, of this precision."""
        return self._places.band(self._values, self._inverse, precision)

    def solve(self, right: Floats, solver: Any) -> Floats:
        """(x, y) of a right side (n,) or (n, k). solver : solves with the band, for (kept,) or (kept, k)."""
        places = self._places
        inverse = self._inverse if right.ndim == 1 else self._inverse[:, None]
        inside = inverse * right[places.inner]
        found = np.empty_like(right)
        outside = solver(right[places.kept] - self._coupling @ inside)
        found[places.kept] = outside
        found[places.inner] = inside - inverse * (self._transposed @ outside)
        return found
