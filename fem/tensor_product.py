"""Polynomials of one order along either side of a rectangle: shape functions, their slopes, Gauss points.

Nodes are at even steps. On the unit square the shape function of the node in row i and column j is L_i(z) L_j(s), with
Lagrange's polynomials L along a side.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from fluxbore.fem.mesh import Floats, Ints


@dataclass(frozen=True, eq=False)
class Side:
    """Lagrange's polynomials of an order on the unit interval.

    coefficients : (order + 1, order + 1) of the powers of t, a column for each polynomial.
    """

    order: int
    coefficients: Floats

    def values(self, t: Floats) -> Floats:
        """(..., order + 1) of all polynomials at t (...)."""
        return np.asarray(t[..., None] ** np.arange(self.order + 1) @ self.coefficients)

    def slopes(self, t: Floats) -> Floats:
        """(..., order + 1) of their derivatives at t (...)."""
        powers = np.arange(1, self.order + 1)
        return np.asarray(t[..., None] ** (powers - 1) @ (powers[:, None] * self.coefficients[1:]))

    @cached_property
    def gauss(self) -> tuple[Floats, Floats]:
        """(order + 1,) points and weights on the unit interval: exact for the square of a polynomial of the order."""
        points, weights = np.polynomial.legendre.leggauss(self.order + 1)
        return np.asarray((points + 1) / 2), np.asarray(weights / 2)


@lru_cache(maxsize=8)
def side(order: int) -> Side:
    """The polynomials of this order; made once."""
    nodes = np.arange(order + 1) / order
    powers: Floats = nodes[:, None] ** np.arange(order + 1)
    return Side(order, np.asarray(np.linalg.inv(powers), dtype=float))


@dataclass(frozen=True, slots=True, eq=False)
class Square:
    """The unit square with its nodes and quadrature points.

    rows, columns : (nodes,) place of each node; those on the square's edge come first, those inside last.
    edge : how many nodes are on the edge. values, across, along : (nodes, points) shape functions and their slopes by
    s and by z.
    weights : (points,), summing to one. share : (points,) of the width, at each point.
    """

    order: int
    rows: Ints
    columns: Ints
    edge: int
    values: Floats
    across: Floats
    along: Floats
    weights: Floats
    share: Floats

    @property
    def points(self) -> int:
        return int(self.weights.size)

    @property
    def nodes(self) -> int:
        return int(self.rows.size)


@lru_cache(maxsize=8)
def square(order: int) -> Square:
    """The square of this order; made once."""
    line = side(order)
    points, weights = line.gauss
    value, slope = line.values(points), line.slopes(points)
    row, column = np.divmod(np.arange((order + 1) ** 2), order + 1)
    is_inner = (row % order > 0) & (column % order > 0)
    first = np.argsort(is_inner, kind="stable")
    row, column = row[first], column[first]

    def products(along_z: Floats, along_s: Floats) -> Floats:
        return np.ascontiguousarray(np.einsum("pn,qn->npq", along_z[:, row], along_s[:, column]).reshape(row.size, -1))

    return Square(
        order,
        row,
        column,
        int(np.count_nonzero(~is_inner)),
        products(value, value),
        products(value, slope),
        products(slope, value),
        np.outer(weights, weights).ravel(),
        np.tile(points, order + 1),
    )
