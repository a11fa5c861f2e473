"""Matrices of a mapped mesh's cells, and what is inside of each condensed onto its edge.

The nodes inside of a cell meet the cell's own nodes only. Of a cell's matrix

    | K  C | |x|   |a|                         (K − C D⁻¹ Cᵀ) x = a − C D⁻¹ b ,
    | Cᵀ D | |y| = |b|                         y = D⁻¹ b − D⁻¹ Cᵀ x ,

so that nine of the 25 unknowns of a cell of fourth order never meet the others (static condensation, Wilson 1974).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from fluxbore.fem.cells import Cells
from fluxbore.fem.factors import SingularMatrixError
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.tensor_product import Square, square

Precision = type[np.float32] | type[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Condensed:
    """Cells without what is inside of them; in single or in double precision.

    edge : (m, e, e) K − C D⁻¹ Cᵀ. inverse : (m, i, i) D⁻¹. coupling : (m, i, e) D⁻¹ Cᵀ.
    """

    edge: Any
    inverse: Any
    coupling: Any

    def rounded(self, precision: Precision) -> Condensed:
        """To a precision."""
        return Condensed(*(part.astype(precision, copy=False) for part in (self.edge, self.inverse, self.coupling)))


def condensed(shape: Square, matrices: Any) -> Condensed:
    """Of cells' matrices (m, n, n), in their precision; raises SingularMatrixError where one is not definite inside."""
    e = shape.edge
    across = matrices[:, e:, :e]
    inverse = inverted(matrices[:, e:, e:])
    coupling = inverse @ across
    return Condensed(matrices[:, :e, :e] - across.transpose(0, 2, 1) @ coupling, inverse, coupling)


def inverted(matrices: Any) -> Any:
    """(m, i, i) of symmetric positive definite matrices (m, i, i), all at once by Gauss and Jordan's elimination.

    Without exchanges, which definite matrices do not need; raises SingularMatrixError where a pivot is not positive.
    """
    # Matrices last: each operation is on long rows.
    a = np.ascontiguousarray(matrices.transpose(1, 2, 0))
    pivots = np.empty_like(a[0])
    with np.errstate(all="ignore"):  # what is not definite is told by its pivots
        for k in range(a.shape[0]):
            pivots[k] = a[k, k]
            pivot = pivots[k]
            row = a[k] / pivot
            column = a[:, k].copy()
            a -= column[:, None] * row
            a[k] = row
            a[:, k] = -column / pivot
            a[k, k] = 1 / pivot
    if not np.all(pivots > 0):
        raise SingularMatrixError("the matrix is not positive definite inside of a cell")
    return np.ascontiguousarray(a.transpose(2, 0, 1))


@cache
def slope_products(order: int, single: bool = False) -> Any:
    """(3 points, n²) of the shape functions' slopes at each point: ∂_s ∂_s, ∂_s ∂_z + ∂_z ∂_s, ∂_z ∂_z."""
    shape = square(order)
    across, along = shape.across.T, shape.along.T
    mixed = across[:, :, None] * along[:, None, :]
    parts = (
        across[:, :, None] * across[:, None, :],
        mixed + mixed.transpose(0, 2, 1),
        along[:, :, None] * along[:, None, :],
    )
    return np.concatenate([part.reshape(shape.points, -1) for part in parts]).astype(
        np.float32 if single else np.float64
    )


def cell_matrices(
    cells: Cells, chosen: Ints, across: Floats, mixed: Floats, along: Floats, precision: Precision = np.float64
) -> Any:
    """(m, n, n) of chosen cells, ∫ a b_s b_sᵀ + c (b_s b_rᵀ + b_r b_sᵀ) + d b_r b_rᵀ with b_s = ∂_s φ, b_r = 1/r ∂_z φ.

    across, mixed, along : (m, points) a, c and d (m/H), times the quadrature weights.
    """
    width, steep = cells.width[chosen], cells.inverse_radius[chosen] / cells.height[chosen]
    factors = np.concatenate((across / width**2, mixed * steep / width, along * steep**2), axis=1)
    products = slope_products(cells.square.order, precision is np.float32)
    return (factors.astype(precision, copy=False) @ products).reshape(-1, cells.square.nodes, cells.square.nodes)
