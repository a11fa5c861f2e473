"""Mapped meshes of a helical section over one period, folded along ζ.

Each member has its own lines along ζ, with its magnets' edges among them, and keeps them when it is displaced. The
same number of lines crosses both members; whole cells of displacement change which line meets which, and what is left,
half a cell at most, shears the cells of the gap. So the field's equations keep one pattern at any displacement, and
the derivative of the coenergy by displacement comes from the gap's cells alone.

Where south bands mirror north bands the field changes its sign after half a period, and half of one is enough.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fluxbore.fem.mapped import Subdivision
from fluxbore.fem.mesh import Floats, Ints, Mesh, Topology
from fluxbore.geometry.helical_section import HelicalSection, Layer

MAGNET = Subdivision(8, 1.6)
GAP = Subdivision(8, 1.3)
OTHER = Subdivision(7, 1.6, "start")
"""Of layers that have the gap on one side only: the field decays away from it."""

PERIOD_CELLS = 32
"""Along ζ."""

SMALLEST = 1e-9
"""Of the period: edges closer than this are one."""

SEGMENT_GROWTH = 1.15
"""Of cells along ζ, away from the edges of a magnet: fields have a logarithm there."""


@dataclass(frozen=True, slots=True, eq=False)
class HelicalMesh:
    """Quadratic triangles in (r, ζ) in m; the chart is planar, for r is a weight here and no more.

    copies : how often the mesh fits into a period, 1 or 2.
    layer : (m,) number of each element's layer. gap : numbers of the gap's elements. weight : (n,) share of the outer
    member's displacement with which each node moves: zero inside the gap, one outside.
    """

    mesh: Mesh
    copies: int
    layer: Ints
    gap: Ints
    weight: Floats


def helical_mesh(section: HelicalSection, refinement: int = 1, cut: int = 0) -> HelicalMesh:
    """Mesh one period of a section.

    refinement : every cell of the first mesh is cut into this many, along r and along ζ. cut : number of the inner
    member's line that the period is cut along; no figure depends on it.
    """
    r_lines, r_layer = _radial_lines(section, refinement)
    r_nodes = _with_middles(r_lines)
    mirrored = all(layer.magnets.antisymmetric for layer in section.layers if layer.magnets)
    copies = 2 if mirrored else 1
    inner = member_lines(section.layers[: section.gap], refinement, copies)
    outer = member_lines(section.layers[section.gap + 1 :], refinement, copies)
    count = inner.size - 1
    displacement = section.displacement / section.period
    # Means are over the whole mesh, so that the lines of both members match as well as they can.
    apart = displacement + float(np.mean(outer[:-1]) - np.mean(inner[:-1]))
    turned = round(count * copies * apart)
    lines = np.arange(count + 1) + cut
    inner_lines = section.period * _continued(inner, lines)
    outer_lines = section.period * (_continued(outer, lines - turned) + displacement)
    first, last = section.gap_radii
    share = np.clip((r_nodes - first) / (last - first), 0.0, 1.0)
    zeta = (1 - share) * _with_middles(inner_lines)[:, None] + share * _with_middles(outer_lines)[:, None]
    nodes = np.column_stack((np.tile(r_nodes, zeta.shape[0]), zeta.ravel()))
    topology, column = _folded_topology(
        count,
        r_lines.size - 1,
        (section.inside == "iron", section.outside == "iron"),
        section.inner_radius == 0 and section.lead != 0,
        copies == 2,
        cut % 2,
    )
    layer = r_layer[column]
    mesh = Mesh("planar", nodes, layer, topology)
    return HelicalMesh(mesh, copies, layer, np.flatnonzero(layer == section.gap), np.tile(share, zeta.shape[0]))


def member_lines(layers: tuple[Layer, ...], refinement: int, copies: int) -> Floats:
    """(cells + 1,) lines of a member along ζ, of the period, with the edges of all its magnets among them."""
    whole = 1 / copies
    found = [edge % whole for layer in layers if layer.magnets for edge in layer.magnets.breaks]
    breaks: list[float] = []
    for edge in sorted(found):
        if not breaks or (edge - breaks[-1] > SMALLEST and edge - breaks[0] < whole - SMALLEST):
            breaks.append(edge)
    start = breaks or [0.0]
    edges = np.array([*start, start[0] + whole])
    cells = _shared_out(np.diff(edges), PERIOD_CELLS // copies)
    pieces = [
        a + (b - a) * Subdivision(n, SEGMENT_GROWTH).fractions(refinement)[:-1]
        for a, b, n in zip(edges[:-1], edges[1:], cells, strict=True)
    ]
    return np.concatenate((*pieces, edges[-1:]))


def _shared_out(lengths: Floats, cells: int) -> list[int]:
    """Cells of each piece, in proportion to its length, two at least, and as many in all as asked for."""
    spare = cells - 2 * lengths.size
    share = lengths / lengths.sum() * spare
    found = np.floor(share + 1e-9).astype(int)
    rest = spare - int(found.sum())
    # The rounding keeps equal pieces in their order, however the last digits of their lengths fall.
    for piece in np.argsort(-np.round(share - found, 9), kind="stable")[:rest]:
        found[piece] += 1
    return [2 + int(n) for n in found]


def _continued(lines: Floats, index: Ints) -> Floats:
    """Lines at any index, before the first and beyond the last."""
    count = lines.size - 1
    return np.asarray(lines[index % count] + (lines[-1] - lines[0]) * (index // count))


def _with_middles(lines: Floats) -> Floats:
    nodes = np.empty(2 * lines.size - 1)
    nodes[::2], nodes[1::2] = lines, (lines[1:] + lines[:-1]) / 2
    return nodes


def _radial_lines(section: HelicalSection, refinement: int) -> tuple[Floats, Ints]:
    """Mesh lines in r (m), and the layer of every cell between them."""
    radii = section.radii
    pieces, layers = [np.array(radii[:1])], []
    for number, layer in enumerate(section.layers):
        if number == section.gap:
            cut = GAP
        elif layer.magnets is not None:
            cut = MAGNET
        else:
            cut = OTHER if number > section.gap else Subdivision(OTHER.cells, OTHER.growth, "end")
        a, b = radii[number], radii[number + 1]
        piece = a + (b - a) * cut.fractions(refinement)[1:]
        piece[-1] = b
        pieces.append(piece)
        layers.append(np.full(piece.size, number))
    return np.concatenate(pieces), np.concatenate(layers)


@lru_cache(maxsize=16)
def _folded_topology(
    nz: int, nr: int, iron: tuple[bool, bool], axis: bool, mirrored: bool, parity: int
) -> tuple[Topology, Ints]:
    """Two triangles in each of nz × nr cells, diagonals alternating, and the column of each element's cell.

    Nodes stand in 2 nz + 1 rows of 2 nr + 1; the last row shares the unknowns of the first. Unknowns are numbered
    along ζ first, which is the shorter way round. iron : whether the potential is zero on the innermost and outermost
    column. axis : whether the innermost column is the axis of a helix, where the potential is one number, or else it
    would have no gradient there. mirrored : whether the last row has the potential of the first with its sign changed.
    parity : which diagonal comes first, so that it stays with the member.
    """
    width = 2 * nr + 1
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(nz), np.arange(nr), indexing="ij"))

    def node(di: int, dj: int) -> Ints:
        return np.asarray((2 * i + di) * width + 2 * j + dj)

    a, b, c, d = node(0, 0), node(0, 2), node(2, 2), node(2, 0)
    ab, bc, cd, da, middle = node(0, 1), node(1, 2), node(2, 1), node(1, 0), node(1, 1)
    rising = np.stack((np.column_stack((a, b, c, ab, bc, middle)), np.column_stack((a, c, d, middle, cd, da))), axis=1)
    falling = np.stack((np.column_stack((a, b, d, ab, middle, da)), np.column_stack((b, c, d, bc, cd, middle))), axis=1)
    even = ((i + j + parity) % 2 == 0)[:, None, None]
    elements = np.where(even, rising, falling).reshape(-1, 6)
    row, column = np.divmod(np.arange((2 * nz + 1) * width), width)
    sign = np.where(row == 2 * nz, -1, 1) if mirrored else None
    row = row % (2 * nz)
    mate = row * width + column
    fixed = (iron[0] & (column == 0)) | (iron[1] & (column == width - 1))
    if axis and mirrored:
        fixed |= column == 0
    elif axis:
        mate[column == 0] = 0
    if not (any(iron) or mirrored):  # a potential is known up to a number: it is zero at one node
        fixed = mate == mate[-1]
    # Rank of each node that stands for itself, along ζ first.
    stands = (mate == np.arange(mate.size)) & ~fixed
    key = column * (2 * nz) + row
    order = np.flatnonzero(stands)[np.argsort(key[stands], kind="stable")]
    number = np.full(mate.size, -1)
    number[order] = np.arange(order.size)
    freedom = np.where(fixed, -1, number[mate])
    return Topology(elements, freedom, sign, mate), np.repeat(j, 2)
