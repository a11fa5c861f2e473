"""Matrices of a mapped mesh's cells, and what is inside of each condensed onto its edge.

The nodes inside of a cell meet the cell's own nodes only. Of a cell's matrix

    | K  C | |x|   |a|                         (K − C D⁻¹ Cᵀ) x = a − C D⁻¹ b ,
    | Cᵀ D | |y| = |b|                         y = D⁻¹ b − D⁻¹ Cᵀ x ,

so that nine of the 25 unknowns of a cell of fourth order never meet the others (static condensation, Wilson 1974).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache
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
def _products(order: int, single: bool = False) -> Any:
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
    n = cells.square.nodes
    return (factors.astype(precision, copy=False) @ _products(cells.square.order, precision is np.float32)).reshape(
        -1, n, n
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Columns:
    """The matrices of rectangles of unit width and height, by column; see `linear_condensed`.

    along : (columns, n, n) B. modes : (columns, i, i) V with Vᵀ A_ii V = 1 and Vᵀ B_ii V = Λ. rates : (columns, i) Λ.
    """

    along: Floats
    modes: Floats
    rates: Floats


@lru_cache(maxsize=4)
def _columns(order: int, lines: bytes) -> _Columns:
    """Of lines in s; one design's positions share them."""
    shape = square(order)
    s = np.frombuffer(lines)
    at = s[:-1, None] + np.diff(s)[:, None] * shape.share
    pairs = _products(order)
    along = ((shape.weights / (2 * at)) @ pairs[-shape.points :]).reshape(-1, shape.nodes, shape.nodes)
    inner = slice(shape.edge, None)
    root = np.linalg.inv(np.linalg.cholesky(_across(order)[inner, inner]))
    rates, turned = np.linalg.eigh(root @ along[:, inner, inner] @ root.T)
    return _Columns(along, root.T @ turned, rates)


@lru_cache(maxsize=4)
def _across(order: int) -> Floats:
    """(n, n) ∫ ∂_s φ ∂_s φᵀ on the unit square."""
    shape = square(order)
    return np.asarray((shape.weights @ _products(order)[: shape.points]).reshape(shape.nodes, -1))


def linear_condensed(
    cells: Cells, chosen: Ints, nu_r: Floats, nu_z: Floats, precision: Precision = np.float64
) -> Condensed:
    """Of chosen cells with the reluctivities (m,) along r and along z (m/H).

    A rectangle of width w in s and height h in z has the matrix

        ν_z h/w A + ν_r w/h B ,   A = ∫ ∂_s φ ∂_s φᵀ ,   B = ∫ (1/2s) ∂_z φ ∂_z φᵀ   (on the unit square),

    where A is the same for all and B differs by column only. In the modes of the pencil (A, B) inside of a cell the
    inverse is diagonal: one eigenvalue problem for each column serves all rows and positions.
    """
    shape = cells.square
    order, e = shape.order, shape.edge
    of_columns = _columns(order, cells.grid.r_nodes[::order].tobytes())
    first, kind = _kinds(cells, chosen, nu_r, nu_z)
    column = chosen[first] % cells.shape[1]
    aspect = cells.height[chosen[first], 0] / cells.width[chosen[first], 0]
    a, b = (nu_z[first] * aspect)[:, None, None], (nu_r[first] / aspect)[:, None, None]
    rates = a + b * of_columns.rates[column][:, None, :]
    if not np.all(rates > 0):
        raise SingularMatrixError("the matrix is not positive definite inside of a cell")
    modes, whole_a, whole_b = of_columns.modes[column], _across(order), of_columns.along[column]
    inverse = (modes / rates) @ modes.transpose(0, 2, 1)
    across = a * whole_a[e:, :e] + b * whole_b[:, e:, :e]
    coupling = inverse @ across
    edge = a * whole_a[:e, :e] + b * whole_b[:, :e, :e] - across.transpose(0, 2, 1) @ coupling
    # Rounded at the end only: digits lost on the way would cost a sweep of refinement more.
    return Condensed(*(part.astype(precision, copy=False)[kind] for part in (edge, inverse, coupling)))


def _kinds(cells: Cells, chosen: Ints, nu_r: Floats, nu_z: Floats) -> tuple[Ints, Ints]:
    """The first cell of each kind, and the kind of each of the chosen: many rows, such as magnets', are of one height.

    Heights that differ by less than a few parts in 10¹³ differ by rounding.
    """
    columns = cells.shape[1]
    heights = cells.height[::columns, 0]
    exponent = np.frexp(heights)[1]
    _, of_row = np.unique(np.ldexp(np.rint(np.ldexp(heights, 43 - exponent)), exponent - 43), return_inverse=True)
    _, of_r = np.unique(nu_r, return_inverse=True)
    _, of_z = np.unique(nu_z, return_inverse=True)
    code = ((of_row.ravel()[chosen // columns] * columns + chosen % columns) * chosen.size + of_r) * chosen.size + of_z
    _, first, kind = np.unique(code, return_index=True, return_inverse=True)
    return first, kind.ravel()
