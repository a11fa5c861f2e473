"""Mapped meshes of fixed topology on a cross-section of rectangles: quadrilaterals of second or fourth order.

Every interval between two breakpoints gets a number of cells that depends on its name alone, never on its length, and
nodes move linearly with the breakpoints. Figures are therefore smooth functions of the design, which a search needs;
remeshing would put noise of its own size on them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fluxbore.fem.mesh import Floats, Ints, Mesh, Topology
from fluxbore.geometry.cross_section import Breakpoints, CrossSection


@dataclass(frozen=True, slots=True)
class Subdivision:
    """How an interval is cut: number of cells, and the ratio of neighbouring cells' lengths.

    growth : above 1 the cells grow away from the fine end(s). fine : "both", "start" or "end".
    """

    cells: int
    growth: float = 1.0
    fine: str = "both"

    def fractions(self, refinement: int) -> Floats:
        """(cells * refinement + 1,) from 0 to 1; not to be written to.

        A refined mesh cuts every cell of the default mesh into equal parts, so that meshes are nested and their
        results converge at a rate.
        """
        return _fractions(self, refinement)

    def steps(self) -> Floats:
        """(cells,) lengths of the default mesh's cells, to any measure."""
        if self.fine == "both":
            half = np.minimum(np.arange(self.cells), np.arange(self.cells)[::-1])
            return np.asarray(self.growth**half)
        steps = self.growth ** np.arange(self.cells, dtype=float)
        return steps[::-1] if self.fine == "end" else steps


@lru_cache(maxsize=256)
def _fractions(division: Subdivision, refinement: int) -> Floats:
    steps = division.steps()
    lines = np.concatenate(([0.0], np.cumsum(steps) / np.sum(steps)))
    coarse = np.arange(division.cells + 1)
    return np.interp(np.arange(division.cells * refinement + 1) / refinement, coarse, lines)


@dataclass(frozen=True, slots=True, eq=False)
class MappedMesh:
    """Rectangular cells in rows and columns, on a lattice of nodes.

    order : of the polynomials in a cell, which has this many intervals between nodes along either side.
    r_lines, z_lines : the mesh lines in space (m), where cells meet.
    r_nodes, z_nodes : the lattice (chart, m² and m), evenly between two lines. Node (i, j) of row i in z and j in s
    has the number i * len(r_nodes) + j.
    region : (rows, columns) index of each cell's region.
    mesh : quadratic triangles on the same nodes, for pictures and for what is read off the field.
    """

    mesh: Mesh
    r_lines: Floats
    z_lines: Floats
    r_nodes: Floats
    z_nodes: Floats
    region: Ints
    order: int = 2

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of cells."""
        return self.z_lines.size - 1, self.r_lines.size - 1

    @property
    def topology(self) -> Topology:
        """What designs and positions share: two grids of one topology have the same nodes in the same places."""
        return self.mesh.topology

    def node(self, i: Ints | int, j: Ints | int) -> Ints:
        """Number of the node in z row i and s column j."""
        return np.asarray(np.asarray(i) * self.r_nodes.size + np.asarray(j))

    def column(self, radius: float) -> int:
        """Number of the node column on the mesh line nearest to a radius (m)."""
        return self.order * self.line(radius)

    def line(self, radius: float) -> int:
        """Number of the mesh line nearest to a radius (m)."""
        return int(np.argmin(np.abs(self.r_lines - radius)))


def mapped_mesh(
    section: CrossSection,
    r_cells: Mapping[str, Subdivision],
    z_cells: Mapping[str, Subdivision],
    refinement: int = 1,
    open_rim: bool = False,
    order: int = 2,
) -> MappedMesh:
    """Mesh the cross-section; the cells of each interval follow from its name.

    open_rim : whether ψ is unknown on the far edges, for a condition that opens them; it is zero there otherwise.
    order : of the polynomials in a cell, 2 or 4.
    """
    assert order % 2 == 0  # triangles have a node at half of their sides
    r_lines, r_interval = _lines(section.r, r_cells, refinement)
    z_lines, z_interval = _lines(section.z, z_cells, refinement)
    s_nodes, z_nodes = lattice(r_lines**2 / 2, order), lattice(z_lines, order)
    split = order // 2
    topology, patch_of_element = _grid_topology(split * (z_lines.size - 1), split * (r_lines.size - 1), open_rim)
    s, z = np.meshgrid(s_nodes, z_nodes)
    region = section.cells[np.ix_(z_interval, r_interval)]
    patches = region.repeat(split, axis=0).repeat(split, axis=1).ravel()
    mesh = Mesh("axisymmetric", np.column_stack((s.ravel(), z.ravel())), patches[patch_of_element], topology)
    return MappedMesh(mesh, r_lines, z_lines, s_nodes, z_nodes, region, order)


def _lines(points: Breakpoints, cells: Mapping[str, Subdivision], refinement: int) -> tuple[Floats, Ints]:
    """All mesh lines, and the interval of every cell between them."""
    lines, interval = [np.array(points.values[:1])], []
    for k, name in enumerate(points.intervals):
        a, b = points.values[k], points.values[k + 1]
        piece = a + (b - a) * cells[name].fractions(refinement)[1:]
        piece[-1] = b
        lines.append(piece)
        interval.append(np.full(piece.size, k))
    return np.concatenate(lines), np.concatenate(interval)


def lattice(lines: Floats, order: int) -> Floats:
    """The lines, and between each two of them order − 1 nodes at even steps."""
    share = np.arange(order) / order
    between = lines[:-1, None] + np.diff(lines)[:, None] * share
    return np.append(between.ravel(), lines[-1])


@lru_cache(maxsize=16)
def _grid_topology(nz: int, nr: int, open_rim: bool) -> tuple[Topology, Ints]:
    """Two triangles in each of nz x nr patches of three by three nodes, in alternating ways: no direction is favoured.

    Every node of the triangles is a node of the (2 nz + 1) x (2 nr + 1) grid. Nodes are numbered along r first: the
    domain is long in z, so the matrix has a narrow band. The axis carries ψ = 0, and so do the far edges, which no flux
    crosses then, unless they are open.
    """
    width = 2 * nr + 1
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(nz), np.arange(nr), indexing="ij"))

    def node(di: int, dj: int) -> Ints:
        return np.asarray((2 * i + di) * width + 2 * j + dj)

    a, b, c, d = node(0, 0), node(0, 2), node(2, 2), node(2, 0)
    ab, bc, cd, da, middle = node(0, 1), node(1, 2), node(2, 1), node(1, 0), node(1, 1)
    rising = np.stack((np.column_stack((a, b, c, ab, bc, middle)), np.column_stack((a, c, d, middle, cd, da))), axis=1)
    falling = np.stack((np.column_stack((a, b, d, ab, middle, da)), np.column_stack((b, c, d, bc, cd, middle))), axis=1)
    even = ((i + j) % 2 == 0)[:, None, None]
    elements = np.where(even, rising, falling).reshape(-1, 6)
    rows, columns = np.divmod(np.arange((2 * nz + 1) * width), width)
    inside = columns > 0
    if not open_rim:
        inside &= (rows > 0) & (rows < 2 * nz) & (columns < width - 1)
    freedom = np.where(inside, np.cumsum(inside) - 1, -1)
    return Topology(elements, freedom), np.repeat(np.arange(nz * nr), 2)


def breakpoint_derivative(grid: MappedMesh, section: CrossSection, s: Floats, z: Floats) -> tuple[Floats, Floats]:
    """(k, c) and (l, c) derivatives of c scalars by the section's breakpoints in r and z.

    s, z : (lines, c) by the s and z of the grid's lines, with which its nodes move.
    """
    # s = r²/2
    return _from_lines(section.r, grid.r_lines, s * grid.r_lines[:, None]), _from_lines(section.z, grid.z_lines, z)


def by_lines(nodes: Floats, order: int) -> Floats:
    """(lines, ...) by a grid's lines, from (nodes, ...) by its rows or columns of nodes."""
    lines = nodes[::order].copy()
    for k in range(1, order):
        lines[:-1] += (1 - k / order) * nodes[k::order]
        lines[1:] += k / order * nodes[k::order]
    return lines


def _from_lines(points: Breakpoints, lines: Floats, by_line: Floats) -> Floats:
    """(breakpoints, c): a line between two breakpoints moves with both, in proportion to where it lies."""
    values = np.array(points.values)
    interval = np.clip(np.searchsorted(values, lines, side="right") - 1, 0, values.size - 2)
    share = ((lines - values[interval]) / (values[interval + 1] - values[interval]))[:, None]
    found = np.zeros((values.size, by_line.shape[1]))
    np.add.at(found, interval, (1 - share) * by_line)
    np.add.at(found, interval + 1, share * by_line)
    return found
