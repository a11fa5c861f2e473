"""The field on a mesh line of constant radius, from the cells on one side of it."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.tensor_product import side


class LineField:
    """B at a line's nodes as a linear function of ψ, and its derivatives.

    Across the line B_z is the slope of the polynomial in the cells of one side. Along it B_r is that of the cell a node
    lies in, and between two cells the mean of theirs.
    """

    def __init__(self, grid: MappedMesh, radius: float, outside: bool = True) -> None:
        """radius : of a mesh line (m). outside : whether cells just outside the line are asked, or those inside."""
        order = grid.order
        line = grid.line(radius)
        self._grid, self._line, self._radius = grid, line, float(grid.r_lines[line])
        self._column = line if outside else line - 1
        one = side(order)
        self._width = float(grid.r_nodes[order * (self._column + 1)] - grid.r_nodes[order * self._column])
        rows = np.arange(grid.z_nodes.size)
        self._across = grid.node(rows[:, None], order * self._column + np.arange(order + 1))
        self._slope = one.slopes(np.array(0.0 if outside else 1.0)) / self._width
        cells = grid.z_lines.size - 1
        self._rows: Ints = order * np.arange(cells)[:, None] + np.arange(order + 1)
        self._along = grid.node(self._rows, order * line)
        self._rise = one.slopes(np.arange(order + 1) / order)
        self._height = np.diff(grid.z_lines)
        # Of the two cells that meet in a node each counts half.
        share = np.ones(self._rows.shape)
        share[1:, 0] = share[:-1, -1] = 0.5
        self._share = -share / self._radius

    def field(self, psi: Floats) -> Floats:
        """(rows, 2) B_r and B_z (T) of nodal ψ (n,)."""
        parts = self._parts(psi)
        b_r = np.bincount(self._rows.ravel(), parts.ravel(), self._across.shape[0])
        return np.column_stack((b_r, psi[self._across] @ self._slope))

    def _parts(self, psi: Floats) -> Floats:
        """(cells, order + 1) what each cell gives to B_r at its nodes on the line."""
        return np.asarray(self._share * (psi[self._along] @ self._rise.T) / self._height[:, None])

    def by_psi(self, pull: Floats) -> Floats:
        """(n,) derivative of Σ pull · B, pull (rows, 2), by the nodal ψ."""
        count = self._grid.mesh.nodes.shape[0]
        found = np.bincount(self._across.ravel(), (pull[:, 1:] * self._slope).ravel(), count)
        along = (pull[self._rows, 0] * self._share / self._height[:, None]) @ self._rise
        return np.asarray(found + np.bincount(self._along.ravel(), along.ravel(), count))

    def by_lines(self, psi: Floats, pull: Floats) -> tuple[Floats, Floats]:
        """(lines,) twice, the same by the s and the z of the grid's lines, ψ staying at its nodes."""
        s, z = np.zeros(self._grid.r_lines.size), np.zeros(self._grid.z_lines.size)
        field = self.field(psi)
        by_width = -float(pull[:, 1] @ field[:, 1]) / self._width
        s[self._column + 1] += by_width
        s[self._column] -= by_width
        s[self._line] -= float(pull[:, 0] @ field[:, 0]) / self._radius**2  # ds = r dr
        by_height = -np.sum(pull[self._rows, 0] * self._parts(psi), axis=1) / self._height
        z[1:] += by_height
        z[:-1] -= by_height
        return s, z


def along_radius(grid: MappedMesh, psi: Floats, radius: float, outside: bool = True) -> tuple[Floats, Floats]:
    """B along a mesh line of constant radius (m): z (k,) in m and B (k, 2) in (r, z), tesla; see `LineField`."""
    return grid.z_nodes, LineField(grid, radius, outside).field(psi)
