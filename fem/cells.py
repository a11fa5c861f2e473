"""The cells of a mapped mesh: rectangles in the chart, all of one shape.

Derivatives at the quadrature points are one matrix times the nodes' values, for all cells at once.
"""

from __future__ import annotations

from functools import cached_property, lru_cache

import numpy as np

from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.tensor_product import square


class Cells:
    """The cells of a grid, row by row.

    nodes : (m, n), in the order of `tensor_product.Square`. width, height : (m, 1) in s (m²) and in z (m).
    widths, heights : (columns,) and (rows,) of them. share : (points,) of the width at each quadrature point.
    weight : (m, points), ds dz (m³). region : (m,).
    """

    def __init__(self, grid: MappedMesh) -> None:
        self.grid = grid
        self.square = square(grid.order)
        self.shape = grid.shape
        self.nodes = cell_nodes(*self.shape, grid.order)
        self.widths, self.heights = np.diff(grid.r_nodes[:: grid.order]), np.diff(grid.z_lines)
        self.width = np.tile(self.widths, self.shape[0])[:, None]
        self.height = np.repeat(self.heights, self.shape[1])[:, None]
        self.share = self.square.share
        self.weight = self.width * self.height * self.square.weights
        self.region = grid.region.ravel()

    @cached_property
    def metric(self) -> Floats:
        """(m, points) 1/r² (1/m²)."""
        start = self.grid.r_nodes[: -1 : self.grid.order]
        of_columns = 0.5 / (start[:, None] + self.widths[:, None] * self.share)
        return np.tile(of_columns, (self.shape[0], 1))

    @property
    def inverse_radius_of_columns(self) -> Floats:
        """(columns, order + 1) 1/r (1/m) at the points along s."""
        return self.inverse_radius[: self.shape[1], : self.square.order + 1]

    @cached_property
    def inverse_radius(self) -> Floats:
        """(m, points) 1/r (1/m)."""
        return np.sqrt(self.metric)

    def fields(self, values: Floats, chosen: Ints | slice = slice(None)) -> tuple[Floats, Floats]:
        """What is B of ψ, of nodal values: (m, points) ∂/∂s and 1/r ∂/∂z of all or of some cells."""
        found = values[self.nodes[chosen]]
        across, along = found @ self.square.across, found @ self.square.along
        return across / self.width[chosen], along * (self.inverse_radius[chosen] / self.height[chosen])

    def pull_across(self, factors: Floats, chosen: Ints | slice = slice(None)) -> Floats:
        """(m, n) by a field's values at the nodes of the sum over points of factors (m, points) times its ∂/∂s."""
        return np.asarray((factors / self.width[chosen]) @ self.square.across.T)

    def pull_along(self, factors: Floats, chosen: Ints | slice = slice(None)) -> Floats:
        """(m, n) the same of its 1/r ∂/∂z."""
        return np.asarray((factors * (self.inverse_radius[chosen] / self.height[chosen])) @ self.square.along.T)

    def start_and_end(
        self, stretch: Floats, lever: Floats, share: Floats, chosen: Ints | slice = slice(None)
    ) -> Floats:
        """(2, m, ...) by s of the lines where cells start and end.

        stretch : (m, ...) times ∂_s V_s. lever, share : (m, ...) of what is times V_s the whole, and times `share`.
        """
        end = stretch / self.width[chosen].reshape(-1, *(1,) * (stretch.ndim - 1)) + share
        return np.stack((lever - end, end))

    def on_lines(self, by_s: Floats, by_z: Floats) -> tuple[Floats, Floats]:
        """(lines,) twice, from (2, m) by s of the lines where cells start and end, and (m,) times ∂_z V_z."""
        start, end = by_s.reshape(2, *self.shape).sum(axis=1)
        return self._gathered((start, end), by_z.reshape(self.shape).sum(axis=1))

    def on_lines_of(self, by_s: Floats, by_z: Floats, fields: Floats) -> tuple[Floats, Floats]:
        """(lines, k) twice: the same for what is linear in each of k nodal fields.

        by_s, by_z : (2, m, n) and (m, n) by the field's values at the cells' nodes.
        """
        rows, columns = self.shape
        n = self.square.nodes
        values = fields[self.nodes].reshape(rows, columns, n, -1)
        k = values.shape[-1]
        sides = by_s.reshape(2, rows, columns, n).transpose(2, 0, 1, 3).reshape(columns, 2, -1)
        of_columns = sides @ values.transpose(1, 0, 2, 3).reshape(columns, -1, k)
        of_rows = by_z.reshape(rows, 1, -1) @ values.reshape(rows, -1, k)
        return self._gathered((of_columns[:, 0], of_columns[:, 1]), of_rows[:, 0])

    def _gathered(self, columns: tuple[Floats, Floats], rows: Floats) -> tuple[Floats, Floats]:
        """(lines, ...) twice from (columns, ...) by the near and the far line, and (rows, ...) times ∂_z V_z."""
        near, far = columns
        s = np.zeros((near.shape[0] + 1, *near.shape[1:]))
        s[:-1] += near
        s[1:] += far
        rise = (rows.T / self.heights).T
        z = np.zeros((rise.shape[0] + 1, *rise.shape[1:]))
        z[1:] += rise
        z[:-1] -= rise
        return s, z


@lru_cache(maxsize=16)
def cell_nodes(rows: int, columns: int, order: int) -> Ints:
    """(m, n) nodes of the cells of a lattice."""
    shape = square(order)
    i, j = np.indices((rows, columns)).reshape(2, -1, 1)
    return np.asarray((order * i + shape.rows) * (order * columns + 1) + order * j + shape.columns)
