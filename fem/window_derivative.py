"""How the load and the linkage of coil windows change with the mesh, the windows and the turns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fluxbore.fem.linkage import Cut, cuts
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats
from fluxbore.geometry.cross_section import CoilWindow


@dataclass(frozen=True, slots=True, eq=False)
class WindowDerivative:
    """Of Σ density · v. s, z : (lines, k) by the s and z of the grid's lines. windows : (coils, 4, k) by r from and to,
    z from and to (m). turns : (coils, k)."""

    s: Floats
    z: Floats
    windows: Floats
    turns: Floats


class Windows:
    """The coils of one mesh, prepared for derivatives of Σ over circuits of density · v.

    At a point of space v changes by −V·∇v where the mesh moves by V, and a window that is stretched by W adds W·∇v;
    what W does to the window's area is taken back by the turns per area. The integrals are of the exact change, by the
    rule that gives the densities. V and W are linear: of either there are two parts in s and two in z, by the lines
    around a cell and by the limits of a window.
    """

    def __init__(self, grid: MappedMesh, coils: Sequence[CoilWindow], made: Sequence[Cut] | None = None) -> None:
        """made : the coils' `cuts`, where known."""
        self._grid, self._coils = grid, coils
        self._cuts = tuple(cuts(grid.mesh, coils) if made is None else made)
        self._parts = [self._part(cut) for cut in self._cuts]

    def _part(self, cut: Cut) -> Floats:
        """(p, 9, 6) by v at the elements' nodes: turns per area times v's change by the cell's inner and outer line,
        by the window's r from and to, by the lower and upper line, by the window's z from and to; and ∫ v per area."""
        clip, grid = cut.clip, self._grid
        area = np.array([coil.area for coil in self._coils])[cut.coil]
        weight = clip.weight * (np.array([coil.turns for coil in self._coils])[cut.coil] / area)[:, None]
        (inner, outer), windows = self._coils[cut.coil[0]].r, np.array([coil.z for coil in self._coils])
        low, high = windows[cut.coil].T[..., None]
        row, column = np.divmod(clip.element // 2, grid.r_lines.size - 1)
        s_lines, z_lines = grid.r_nodes[::2], grid.z_lines
        s = _share(clip.r**2 / 2, s_lines[column][:, None], s_lines[column + 1][:, None])
        z = _share(clip.z, z_lines[row][:, None], z_lines[row + 1][:, None])
        across, along = _share(clip.r, inner, outer), _share(clip.z, low, high)
        moves = np.stack((s - 1, -s, clip.r * (1 - across), clip.r * across, z - 1, -z, 1 - along, along), axis=1)
        moves *= weight[:, None]
        # ∇v is linear in an element: of its points there are needed no more than three moments.
        moments = (moves @ clip.barycentric).reshape(-1, 2, 4, 3, 1)
        slopes = _barycentric_slopes(clip.triangle).transpose(0, 2, 1)[:, :, None, None, :]
        changes = (moments * slopes).reshape(-1, 9) @ _SHAPE_BY_BARYCENTRIC
        return np.concatenate((changes.reshape(-1, 8, 6), (cut.integral / area[:, None])[:, None]), axis=1)

    def derivative(self, fields: Mapping[str, Floats]) -> WindowDerivative:
        """Of the sum over circuits of density · v with the nodal fields v, (n,) or (n, k), by the circuit's name."""
        shaped = {name: field.reshape(field.shape[0], -1) for name, field in fields.items()}
        columns = next(iter(shaped.values())).shape[1]
        grid, count = self._grid, len(self._coils)
        s, z = np.zeros((grid.r_lines.size, columns)), np.zeros((grid.z_lines.size, columns))
        windows, turns = np.zeros((count, 4, columns)), np.zeros((count, columns))
        stacked = np.stack([shaped[item.circuit] for item in self._coils])
        for cut, part in zip(self._cuts, self._parts, strict=True):
            element = cut.clip.element
            found = part @ stacked[cut.coil[:, None], grid.mesh.elements[element]]
            row, column = np.divmod(element // 2, grid.r_lines.size - 1)
            np.add.at(s, column, found[:, 0])
            np.add.at(s, column + 1, found[:, 1])
            np.add.at(z, row, found[:, 4])
            np.add.at(z, row + 1, found[:, 5])
            np.add.at(windows, cut.coil, found[:, [2, 3, 6, 7]])
            np.add.at(turns, cut.coil, found[:, 8])
        return WindowDerivative(s, z, windows, turns)


def _share(x: Floats, start: Floats | float, end: Floats | float) -> Floats:
    return (x - start) / (end - start)


def _barycentric_slopes(triangle: Floats) -> Floats:
    """(p, 3, 2) derivative of the three barycentric coordinates by the chart's coordinates, of triangles (p, 3, 2)."""
    following, last = np.roll(triangle, -1, axis=1), np.roll(triangle, -2, axis=1)
    edge = last - following
    area = edge[:, 0, 0] * edge[:, 1, 1] - edge[:, 0, 1] * edge[:, 1, 0]
    return np.asarray(np.stack((-edge[..., 1], edge[..., 0]), axis=-1) / area[:, None, None])


def _shape_by_barycentric() -> Floats:
    """(9, 6) derivative of the shape functions at each corner by each of the three barycentric coordinates."""
    found = np.zeros((3, 3, 6))
    for corner in range(3):
        for k in range(3):
            found[corner, k, k] = 4 * (corner == k) - 1
        for place, (i, j) in enumerate(((0, 1), (1, 2), (2, 0)), start=3):
            found[corner, i, place], found[corner, j, place] = 4 * (corner == j), 4 * (corner == i)
    return found.reshape(9, 6)


_SHAPE_BY_BARYCENTRIC = _shape_by_barycentric()
