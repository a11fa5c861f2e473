"""How the load and the linkage of coil windows change with the mesh, the windows and the turns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import shape
from fluxbore.fem.functionals import on_lines
from fluxbore.fem.linkage import Clip, clips
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.geometry.cross_section import CoilWindow


@dataclass(frozen=True, slots=True, eq=False)
class WindowDerivative:
    """Of Σ density · v. s, z : (lines, k) by the s and z of the grid's lines. windows : (coils, 4, k) by r from and to,
    z from and to (m). turns : (coils, k)."""

    s: Floats
    z: Floats
    windows: Floats
    turns: Floats


@dataclass(frozen=True, slots=True, eq=False)
class _Part:
    """One `Clip` of coils with equal radii, with the integrals that derivatives by its coils are made of.

    moved : (p, 6, 2, 6) of a shape function's derivative by s, z times a shape function. stretched : (p, 4, 6) of what
    a limit of the window moves. inside : (p, 6) of the shape functions, per area. All but the last with turns per area.
    """

    coil: Ints
    nodes: Ints
    moved: Floats
    stretched: Floats
    inside: Floats


class Windows:
    """The coils of one mesh, prepared for derivatives of Σ over circuits of density · v.

    At a point of space v changes by −V·∇v where the mesh moves by V, and a window that is stretched by W adds W·∇v;
    what W does to the window's area is taken back by the turns per area. The integrals are of the exact change, by the
    rule that gives the densities.
    """

    def __init__(self, grid: MappedMesh, coils: Sequence[CoilWindow]) -> None:
        self._grid, self._coils = grid, coils
        self._parts = []
        for radii in {coil.r for coil in coils}:
            alike = np.array([i for i, coil in enumerate(coils) if coil.r == radii])
            limits = np.array([coils[i].z for i in alike])
            self._parts += [self._part(clip, alike, limits, radii) for clip in clips(grid.mesh, radii, limits)]

    def _part(self, clip: Clip, alike: Ints, limits: Floats, radii: tuple[float, float]) -> _Part:
        coil = alike[clip.window]
        area = np.array([item.area for item in self._coils])[coil]
        turns = np.array([item.turns for item in self._coils])[coil]
        count = clip.element.size
        phi = shape(clip.barycentric).reshape(count, -1, 6)
        slopes = _shape_by_corner(clip.barycentric.reshape(count, -1, 3)) @ _corner_slopes(clip.triangle)[:, None]
        weight = (clip.weight * (turns / area)[:, None, None]).reshape(count, -1)
        weighted = weight[..., None] * phi
        moved = np.stack([-weighted.transpose(0, 2, 1) @ slopes[..., i] for i in range(2)], axis=2)
        inner, outer = radii
        low, high = limits[clip.window].T
        r, z = clip.r.reshape(count, -1), clip.z.reshape(count, -1)
        across, along = (r - inner) / (outer - inner), (z - low[:, None]) / (high - low)[:, None]
        shares = np.stack((r * (1 - across), r * across, 1 - along, along), axis=1) * weight[:, None]
        stretched = np.concatenate((shares[:, :2] @ slopes[..., 0], shares[:, 2:] @ slopes[..., 1]), axis=1)
        inside = (clip.weight.reshape(count, 1, -1) @ phi)[:, 0] / area[:, None]
        return _Part(coil, self._grid.mesh.elements[clip.element], moved, stretched, inside)

    def derivative(self, fields: Mapping[str, Floats]) -> WindowDerivative:
        """Of the sum over circuits of density · v with the nodal fields v, (n,) or (n, k), by the circuit's name."""
        shaped = {name: field.reshape(field.shape[0], -1) for name, field in fields.items()}
        columns = next(iter(shaped.values())).shape[1]
        nodal = np.zeros((self._grid.mesh.nodes.shape[0], 2, columns))
        windows, turns = np.zeros((len(self._coils), 4, columns)), np.zeros((len(self._coils), columns))
        stacked = np.stack([shaped[item.circuit] for item in self._coils])
        for part in self._parts:
            values = stacked[part.coil[:, None], part.nodes]
            moved = part.moved.reshape(part.coil.size, 12, 6) @ values
            np.add.at(nodal, part.nodes, moved.reshape(part.coil.size, 6, 2, columns))
            np.add.at(windows, part.coil, part.stretched @ values)
            np.add.at(turns, part.coil, np.einsum("pn,pnc->pc", part.inside, values))
        return WindowDerivative(*on_lines(self._grid, nodal), windows, turns)


def _corner_slopes(triangle: Floats) -> Floats:
    """(p, 3, 2) derivative of the three barycentric coordinates by the chart's coordinates, of triangles (p, 3, 2)."""
    following, last = np.roll(triangle, -1, axis=1), np.roll(triangle, -2, axis=1)
    edge = last - following
    area = edge[:, 0, 0] * edge[:, 1, 1] - edge[:, 0, 1] * edge[:, 1, 0]
    return np.asarray(np.stack((-edge[..., 1], edge[..., 0]), axis=-1) / area[:, None, None])


def _shape_by_corner(barycentric: Floats) -> Floats:
    """(..., 6, 3) derivative of the shape functions by each of the three barycentric coordinates (..., 3)."""
    a, b, c = np.moveaxis(barycentric, -1, 0)
    found = np.zeros((*a.shape, 6, 3))
    for k, own in enumerate((a, b, c)):
        found[..., k, k] = 4 * own - 1
    for place, (i, j) in enumerate(((0, 1), (1, 2), (2, 0)), start=3):
        found[..., place, i], found[..., place, j] = 4 * (a, b, c)[j], 4 * (a, b, c)[i]
    return found
