"""A mapped mesh's field on small straight triangles, for drawing.

A cell's polynomials hold more than a picture of its nodes would show, so that each cell is cut into parts of about the
same size everywhere near the machine.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from fluxbore.fem.field import FluxMap
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.tensor_product import side
from fluxbore.fem.tubular import TubularSolution

ACROSS_RADIUS = 40
"""Parts from the axis to the machine's outer radius."""

FEWEST, MOST = 2, 12
"""Parts along a cell's side."""


def flux_map(tubular: TubularSolution) -> FluxMap:
    """ψ at the corners of all parts, and B in their middles."""
    grid, psi = tubular.grid, tubular.solution.psi
    field = psi.reshape(grid.z_nodes.size, grid.r_nodes.size)
    size = max(part.r[1] for part in tubular.section.rectangles) / ACROSS_RADIUS
    r, z = _parted(grid.r_lines, size), _parted(grid.z_lines, size)
    along_r, along_z = _Sampler(grid.r_lines, grid.order, True), _Sampler(grid.z_lines, grid.order, False)
    triangles, middle_r, middle_z = _triangles(r, z)
    flux = along_z.values(z) @ field @ along_r.values(r).T
    column = np.searchsorted(grid.r_lines, middle_r, side="right") - 1
    row = np.searchsorted(grid.z_lines, middle_z, side="right") - 1
    of_cell = np.arange(grid.order + 1)
    own = field[(grid.order * row[:, None] + of_cell)[:, :, None], (grid.order * column[:, None] + of_cell)[:, None, :]]
    value_r, slope_r = along_r.local(middle_r, column)
    value_z, slope_z = along_z.local(middle_z, row)
    b_z = np.einsum("mi,mij,mj->m", value_z, own, slope_r, optimize=True)
    b_r = -np.einsum("mi,mij,mj->m", slope_z, own, value_r, optimize=True) / middle_r
    all_z, all_r = np.meshgrid(z, r, indexing="ij")
    return FluxMap(
        all_r.ravel(),
        all_z.ravel(),
        triangles,
        flux.ravel(),
        np.hypot(b_r, b_z),
        grid.region[row, column],
        np.column_stack((b_r, b_z)),
    )


def _parted(lines: Floats, size: float) -> Floats:
    """The lines, with even parts of about a size (m) between them."""
    pieces = [
        np.linspace(start, end, int(np.clip(np.ceil((end - start) / size), FEWEST, MOST)), endpoint=False)
        for start, end in pairwise(lines)
    ]
    return np.append(np.concatenate(pieces), lines[-1])


class _Sampler:
    """Polynomials along one coordinate, at places between its lines."""

    def __init__(self, lines: Floats, order: int, squared: bool) -> None:
        """squared : along r (m), where cells are even in s = r²/2."""
        self._lines, self._squared, self._side = lines, squared, side(order)

    def _chart(self, x: Floats) -> Floats:
        return x**2 / 2 if self._squared else x

    def local(self, places: Floats, cells: Ints) -> tuple[Floats, Floats]:
        """(m, order + 1) twice: the polynomials of the cells that places (m,) lie in, and their slopes in the chart."""
        edges = self._chart(self._lines)
        width = np.diff(edges)[cells]
        share = (self._chart(places) - edges[cells]) / width
        return self._side.values(share), self._side.slopes(share) / width[:, None]

    def values(self, places: Floats) -> Floats:
        """(m, nodes) of all nodes' polynomials at places (m,)."""
        order, cells = self._side.order, self._lines.size - 1
        cell = np.clip(np.searchsorted(self._lines, places, side="right") - 1, 0, cells - 1)
        found = np.zeros((places.size, order * cells + 1))
        found[np.arange(places.size)[:, None], order * cell[:, None] + np.arange(order + 1)] = self.local(places, cell)[
            0
        ]
        return found


def _triangles(r: Floats, z: Floats) -> tuple[Ints, Floats, Floats]:
    """Two triangles (m, 3) in each part, diagonals alternating, and their middles' r and z."""
    i, j = np.indices((z.size - 1, r.size - 1)).reshape(2, -1)
    a = i * r.size + j
    b, c, d = a + 1, a + r.size + 1, a + r.size
    even = ((i + j) % 2 == 0)[:, None]
    one = np.where(even, np.column_stack((a, b, c)), np.column_stack((a, b, d)))
    other = np.where(even, np.column_stack((a, c, d)), np.column_stack((b, c, d)))
    triangles = np.stack((one, other), axis=1).reshape(-1, 3)
    row, column = np.divmod(triangles, r.size)
    return triangles, r[column].mean(axis=1), z[row].mean(axis=1)
