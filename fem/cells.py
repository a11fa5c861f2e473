"""The cells of a mapped mesh, all of one shape: rectangles in the chart, each cut into two triangles along a diagonal.

On the unit square with nodes in three rows of three

    6 7 8
    3 4 5    cut from 0 to 8,
    0 1 2

derivatives at the triangles' quadrature points are one matrix times the nodes' values, for all cells at once. Where a
mesh cuts the other way the cell is taken as its mirror image: its nodes run against s, from its far line to its near
one, and its width is negative.
"""

from __future__ import annotations

from functools import cached_property, lru_cache

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, QUADRATURE_WEIGHTS, shape_derivatives
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Ints

POINTS = 2 * QUADRATURE_WEIGHTS.size
"""Quadrature points of a cell."""

WEIGHTS = np.tile(QUADRATURE_WEIGHTS, 2) / 2

# Nodes of either triangle, and the derivatives along the square by the second and the third barycentric coordinate.
_TRIANGLES = (
    ([0, 2, 8, 1, 5, 4], np.array([[1.0, -1.0], [0.0, 1.0]])),
    ([0, 8, 6, 4, 7, 3], np.array([[1.0, 0.0], [-1.0, 1.0]])),
)


def _unit_square() -> tuple[Floats, Floats, Floats]:
    """(9, points) twice, the nodes' values to the derivatives across and along, and (points,) the share across."""
    slopes = np.zeros((2, 9, POINTS))
    count = QUADRATURE_WEIGHTS.size
    for k, (nodes, turn) in enumerate(_TRIANGLES):
        by_square = shape_derivatives(QUADRATURE_POINTS) @ turn
        slopes[:, nodes, k * count : (k + 1) * count] = by_square.transpose(2, 1, 0)
    corners = np.array([0.0, 1.0, 1.0]), np.array([0.0, 1.0, 0.0])
    return slopes[0], slopes[1], np.concatenate([QUADRATURE_POINTS @ across for across in corners])


ACROSS, ALONG, SHARE = _unit_square()


class Cells:
    """The cells of a grid, row by row.

    nodes : (m, 9). width, height : (m, 1) in s (m²), negative where mirrored, and in z (m). share : (points,) of the
    width at each quadrature point. weight : (m, points), ds dz (m³). region : (m,).
    """

    def __init__(self, grid: MappedMesh) -> None:
        self.grid = grid
        self.shape = grid.z_lines.size - 1, grid.r_lines.size - 1
        self.nodes, self._mirrored = chequered(*self.shape)
        lines = grid.r_nodes[::2]
        self._widths, self._heights = np.diff(lines), np.diff(grid.z_lines)
        count = self.nodes.shape[0]
        width = np.broadcast_to(self._widths, self.shape)
        self.width = np.where(self._mirrored, -width, width).reshape(count, 1)
        self.height = np.repeat(self._heights, self.shape[1])[:, None]
        self.share = SHARE
        self.weight = np.abs(self.width) * self.height * WEIGHTS
        self.region = grid.mesh.region[::2]

    @cached_property
    def metric(self) -> Floats:
        """(m, points) 1/r² (1/m²)."""
        lines = self.grid.r_nodes[::2]
        start = np.where(self._mirrored, lines[1:], lines[:-1]).reshape(-1, 1)
        return np.asarray(0.5 / (start + self.width * SHARE))

    @cached_property
    def inverse_radius(self) -> Floats:
        """(m, points) 1/r (1/m)."""
        return np.sqrt(self.metric)

    def fields(self, values: Floats) -> tuple[Floats, Floats]:
        """What is B of ψ, of a nodal field (n,): (m, points) ∂/∂s and 1/r ∂/∂z."""
        found = values[self.nodes]
        return found @ ACROSS / self.width, found @ ALONG * (self.inverse_radius / self.height)

    def pull_across(self, factors: Floats, chosen: Ints | slice = slice(None)) -> Floats:
        """(m, 9) by a field's values at the nodes of the sum over points of factors (m, points) times its ∂/∂s."""
        return np.asarray((factors / self.width[chosen]) @ ACROSS.T)

    def pull_along(self, factors: Floats, chosen: Ints | slice = slice(None)) -> Floats:
        """(m, 9) the same of its 1/r ∂/∂z."""
        return np.asarray((factors * (self.inverse_radius[chosen] / self.height[chosen])) @ ALONG.T)

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
        near, far = self._sides(by_s)
        columns = near.sum(axis=0), far.sum(axis=0)
        return self._gathered(columns, by_z.reshape(self.shape).sum(axis=1))

    def on_lines_of(self, by_s: Floats, by_z: Floats, fields: Floats) -> tuple[Floats, Floats]:
        """(lines, k) twice: the same for what is linear in each of k nodal fields (n, k).

        by_s, by_z : (2, m, 9) and (m, 9) by the field's values at the cells' nodes.
        """
        rows, columns = self.shape
        values = fields[self.nodes].reshape(rows, columns, 9, -1)
        k = values.shape[-1]
        sides = np.stack(self._sides(by_s)).transpose(2, 0, 1, 3).reshape(columns, 2, -1)
        of_columns = sides @ values.transpose(1, 0, 2, 3).reshape(columns, -1, k)
        of_rows = by_z.reshape(rows, 1, -1) @ values.reshape(rows, -1, k)
        return self._gathered((of_columns[:, 0], of_columns[:, 1]), of_rows[:, 0])

    def _sides(self, by_s: Floats) -> tuple[Floats, Floats]:
        """(rows, columns, ...) twice, by the near and the far line, from (2, m, ...) by start and end."""
        start, end = by_s.reshape(2, *self.shape, *by_s.shape[2:])
        mirrored = self._mirrored.reshape(*self.shape, *(1,) * (start.ndim - 2))
        return np.where(mirrored, end, start), np.where(mirrored, start, end)

    def _gathered(self, columns: tuple[Floats, Floats], rows: Floats) -> tuple[Floats, Floats]:
        """(lines, ...) twice from (columns, ...) by the near and the far line, and (rows, ...) times ∂_z V_z."""
        near, far = columns
        s = np.zeros((near.shape[0] + 1, *near.shape[1:]))
        s[:-1] += near
        s[1:] += far
        rise = (rows.T / self._heights).T
        z = np.zeros((rise.shape[0] + 1, *rise.shape[1:]))
        z[1:] += rise
        z[:-1] -= rise
        return s, z


@lru_cache(maxsize=16)
def chequered(rows: int, columns: int) -> tuple[Ints, Ints]:
    """(m, 9) nodes of the cells, and (rows, columns) which are mirrored: every other one, see `mapped_mesh`."""
    i, j = np.indices((rows, columns))
    mirrored = (i + j) % 2 == 1
    across = np.where(mirrored[..., None], [2, 1, 0], [0, 1, 2])
    row = 2 * i[..., None] + np.arange(3)
    nodes = row[..., :, None] * (2 * columns + 1) + (2 * j[..., None] + across)[..., None, :]
    return nodes.reshape(-1, 9), mirrored
