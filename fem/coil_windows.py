"""Coils as windows over a mapped mesh, integrated exactly whether or not their ends are mesh lines.

Mover and coils slide past one another, so coil ends cannot be mesh lines without the topology changing on the way.
Magnetically a coil is air; only its load and its linkage, one and the same integral, need its outline. Over a window
the integral of a node's shape function L_i(z) L_j(s) is a product,

    ∫ L_i dz ∫ L_j dr ,

of integrals along one side each, over what the window cuts out of every cell.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.problem import Circuit
from fluxbore.fem.tensor_product import side
from fluxbore.geometry.cross_section import CoilWindow


class _Cut:
    """What windows (k, 2) cut out of the cells between lines, along one coordinate.

    whole : (windows, nodes) ∫ L_i.
    """

    def __init__(self, lines: Floats, windows: Floats, order: int, squared: bool = False) -> None:
        """squared : along r (m), where the nodes of a cell are even in s = r²/2."""
        self._side, self._windows, self._cells = side(order), windows, lines.size - 1
        self._lines, self._squared = lines, squared
        start, end = np.clip(lines[:-1], *windows.T[..., None]), np.clip(lines[1:], *windows.T[..., None])
        self._window, self._cell = np.nonzero(end > start)
        start, end = (edge[self._window, self._cell, None] for edge in (start, end))
        # The chart is of second order in r.
        points, weights = _gauss(order + 1 if squared else order // 2 + 1)
        self._weight = (end - start) * weights
        self._share = self._shares(start + (end - start) * points, self._cell[:, None])
        inside = np.einsum("pq,pqi->pi", self._weight, self._side.values(self._share))
        place = (self._window * self._nodes + order * self._cell)[:, None] + np.arange(order + 1)
        flat = np.bincount(place.ravel(), inside.ravel(), windows.shape[0] * self._nodes)
        self.whole = np.asarray(flat.reshape(-1, self._nodes), dtype=float)

    @property
    def _nodes(self) -> int:
        return self._side.order * self._cells + 1

    def _chart(self, x: Floats) -> Floats:
        return x**2 / 2 if self._squared else x

    @cached_property
    def _width(self) -> Floats:
        return np.diff(self._chart(self._lines))

    def _shares(self, places: Floats, cells: Ints) -> Floats:
        """Of the width of a cell, where places lie in it."""
        return (self._chart(places) - self._chart(self._lines)[cells]) / self._width[cells]

    @cached_property
    def by_lines(self) -> tuple[Floats, Floats]:
        """(windows, cells, order + 1) twice: ∫ L_i by the lines where a cell starts and ends."""
        steep = self._weight[..., None] * self._side.slopes(self._share) / self._width[self._cell, None, None]
        found = np.zeros((2, self._windows.shape[0], self._cells, self._side.order + 1))
        for k, move in enumerate((self._share - 1, -self._share)):
            found[k, self._window, self._cell] = np.einsum("pq,pqi->pi", move, steep)
        return found[0], found[1]

    @cached_property
    def limits(self) -> tuple[Floats, Floats]:
        """(windows, nodes) twice: L_i where a window begins and where it ends."""
        found = np.zeros((2, self._windows.shape[0], self._nodes))
        for k, limit in enumerate(self._windows.T):
            cell = np.clip(np.searchsorted(self._lines, limit, side="right") - 1, 0, self._cells - 1)
            nodes = self._side.order * cell[:, None] + np.arange(self._side.order + 1)
            found[k, np.arange(limit.size)[:, None], nodes] = self._side.values(self._shares(limit, cell))
        return found[0], found[1]


@lru_cache(maxsize=8)
def _gauss(count: int) -> tuple[Floats, Floats]:
    """Points and weights on the unit interval."""
    points, weights = np.polynomial.legendre.leggauss(count)
    return (points + 1) / 2, weights / 2


@lru_cache(maxsize=4)
def _radial_cut(lines: bytes, windows: bytes, order: int) -> _Cut:
    """Along r, which is the same at all positions of a design."""
    return _Cut(np.frombuffer(lines), np.frombuffer(windows).reshape(-1, 2), order, squared=True)


@dataclass(frozen=True, slots=True, eq=False)
class WindowDerivative:
    """Of Σ density · v. s, z : (lines, k) by the s and z of the grid's lines. windows : (coils, 4, k) by r from and to,
    z from and to (m). turns : (coils, k)."""

    s: Floats
    z: Floats
    windows: Floats
    turns: Floats


class Windows:
    """The coils of one mesh: their circuits' densities, and how Σ over circuits of density · v changes.

    At a point of space v changes by −V·∇v where the mesh moves by V, and a limit that moves adds what lies on it; what
    it does to the window's area is taken back by the turns per area.
    """

    def __init__(self, grid: MappedMesh, coils: Sequence[CoilWindow]) -> None:
        self._grid, self._coils = grid, coils
        self._radii = list(dict.fromkeys(coil.r for coil in coils))
        self._own = np.array([self._radii.index(coil.r) for coil in coils])
        self._per_area = np.array([coil.turns / coil.area for coil in coils])
        self._r = _radial_cut(grid.r_lines.tobytes(), np.array(self._radii, dtype=float).tobytes(), grid.order)
        self._z = _Cut(grid.z_lines, np.array([coil.z for coil in coils]).reshape(-1, 2), grid.order)

    def circuits(self) -> tuple[Circuit, ...]:
        """One for each name among the coils, in order of appearance."""
        found = []
        for name in dict.fromkeys(coil.circuit for coil in self._coils):
            mine = np.array([coil.circuit == name for coil in self._coils])
            density = np.zeros((self._grid.z_nodes.size, self._grid.r_nodes.size))
            for number in range(len(self._radii)):
                chosen = np.flatnonzero(mine & (self._own == number))
                density += np.outer(self._per_area[chosen] @ self._z.whole[chosen], self._r.whole[number])
            found.append(Circuit(name, density.ravel()))
        return tuple(found)

    def derivative(self, fields: Mapping[str, Floats]) -> WindowDerivative:
        """Of the sum over circuits of density · v with the nodal fields v, (n,) or (n, k), by the circuit's name."""
        grid, coils = self._grid, self._coils
        shaped = {name: field.reshape(grid.z_nodes.size, grid.r_nodes.size, -1) for name, field in fields.items()}
        columns = next(iter(shaped.values())).shape[2]
        s, z = np.zeros((grid.r_lines.size, columns)), np.zeros((grid.z_lines.size, columns))
        windows, turns = np.zeros((len(coils), 4, columns)), np.zeros((len(coils), columns))
        for name, field in shaped.items():
            for number in range(len(self._radii)):
                alike = [coil.circuit == name and own == number for coil, own in zip(coils, self._own, strict=True)]
                chosen = np.flatnonzero(alike)
                if not chosen.size:
                    continue
                per_area = self._per_area[chosen][:, None]
                area = np.array([coils[int(k)].area for k in chosen])[:, None]
                along_z = np.einsum("zrk,r->zk", field, self._r.whole[number])
                along_r = np.einsum("wz,zrk->wrk", self._z.whole[chosen], field)
                total = self._z.whole[chosen] @ along_z
                turns[chosen] = total / area
                for k, sign in enumerate((-1.0, 1.0)):
                    at_r, at_z = self._r.limits[k][number], self._z.limits[k][chosen]
                    width, height = (np.array([[b - a] for a, b in spans]) for spans in self._spans(chosen))
                    windows[chosen, k] = sign * per_area * (np.einsum("wrk,r->wk", along_r, at_r) - total / width)
                    windows[chosen, 2 + k] = sign * per_area * (at_z @ along_z - total / height)
                of_cells = _of_cells(along_z, grid.order)
                z[:-1] += np.einsum("wci,cik->ck", per_area[..., None] * self._z.by_lines[0][chosen], of_cells)
                z[1:] += np.einsum("wci,cik->ck", per_area[..., None] * self._z.by_lines[1][chosen], of_cells)
                of_cells = _of_cells(np.einsum("wo,wrk->rk", per_area, along_r), grid.order)
                s[:-1] += np.einsum("ci,cik->ck", self._r.by_lines[0][number], of_cells)
                s[1:] += np.einsum("ci,cik->ck", self._r.by_lines[1][number], of_cells)
        return WindowDerivative(s, z, windows, turns)

    def _spans(self, chosen: Ints) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
        """r and z from and to of some coils."""
        coils = [self._coils[int(k)] for k in chosen]
        return [coil.r for coil in coils], [coil.z for coil in coils]


def _of_cells(nodal: Floats, order: int) -> Floats:
    """(cells, order + 1, k) of values along a row of nodes (nodes, k)."""
    cells = (nodal.shape[0] - 1) // order
    return nodal[order * np.arange(cells)[:, None] + np.arange(order + 1)]


def circuits(grid: MappedMesh, coils: Sequence[CoilWindow]) -> tuple[Circuit, ...]:
    """`Windows.circuits` of coils over a mesh."""
    return Windows(grid, coils).circuits()
