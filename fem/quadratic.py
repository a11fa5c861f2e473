"""From straight triangles to quadratic elements that follow arcs, and that are sound on the axis.

Edges are straight in the chart, with the node at half of s = r²/2: B_z = ∂ψ/∂s then keeps its order down to the axis.
A node at half of r would bend the elements around the axis by as much as they are long, and lose an order there. The
drawing's sloping lines are the exception: the chart turns them into parabolas, which three nodes at even steps of r
follow exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.fem.element import QUADRATURE_POINTS, shape_derivatives
from fluxbore.fem.field import CORNERS_AND_MIDDLES
from fluxbore.fem.mesh import Floats, Ints, in_chart
from fluxbore.fem.outline import Outline
from fluxbore.fem.pattern import near_numbering
from fluxbore.fem.triangulation import Triangulation

Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class QuadraticNodes:
    """The nodes of a triangulation's quadratic elements.

    nodes : (n, 2) in the chart. elements : (m, 6).
    edges : (k, 3) start, end and middle node of each of the triangulation's edges on curves.
    vertex : (p,) node of each of the outline's points, −1 where it touches no region.
    """

    nodes: Floats
    elements: Ints
    edges: Ints
    vertex: Ints


def quadratic_nodes(triangulation: Triangulation, outline: Outline) -> QuadraticNodes:
    """Give every edge its middle node; those of arcs lie on their circles.

    Where an arc bends so much that an element would turn inside out, its edges are left straight.
    """
    corners = triangulation.triangles
    count = triangulation.points.shape[0]
    pairs = np.sort(np.stack((corners, np.roll(corners, -1, axis=1)), axis=-1).reshape(-1, 2), axis=1)
    codes, place = np.unique(pairs[:, 0] * count + pairs[:, 1], return_inverse=True)
    ends = np.column_stack((codes // count, codes % count))
    elements = np.column_stack((corners, count + place.reshape(-1, 3)))

    wanted = np.sort(triangulation.edges, axis=1)
    on_curve = np.searchsorted(codes, wanted[:, 0] * count + wanted[:, 1])
    straight = triangulation.points[ends].mean(axis=1)
    middles = straight.copy()
    if outline.chart == "axisymmetric":
        middles[:, 0] = np.sqrt(np.mean(triangulation.points[ends][..., 0] ** 2, axis=1))
        lines = on_curve[[outline.curves[c].turn == 0 for c in triangulation.curve]]
        sloping = lines[_sloping(triangulation.points[ends[lines]])]
        middles[sloping] = straight[sloping]
    _onto_arcs(middles, triangulation, on_curve, outline)

    nodes = in_chart(outline.chart, np.concatenate((triangulation.points, middles)))
    plain = in_chart(outline.chart, straight)
    for _ in range(4):
        inverted = np.flatnonzero(_smallest_jacobian(nodes, elements) <= 0)
        if not inverted.size:
            break
        edges = np.unique(elements[inverted, 3:])
        nodes[edges] = plain[edges - count]
    edges = np.column_stack((triangulation.edges, count + on_curve))
    # Neighbours near in number: a narrow band for thin domains, and fewer cache misses for all.
    place = near_numbering(elements, nodes.shape[0])
    numbered = np.empty_like(nodes)
    numbered[place] = nodes
    return QuadraticNodes(
        numbered, place[elements], place[edges], np.where(triangulation.vertex < 0, -1, place[triangulation.vertex])
    )


def _sloping(ends: Floats) -> Flags:
    """(k,) whether an edge runs neither along r nor along z, so that it is not straight in both charts."""
    rise = np.abs(ends[:, 1] - ends[:, 0])
    return np.asarray(rise.min(axis=1) > 1e-9 * rise.max(axis=1))


def _onto_arcs(middles: Floats, triangulation: Triangulation, on_curve: Ints, outline: Outline) -> None:
    """Move the middles of edges on arcs to their circles: halfway along, or in z where the centre is on the axis."""
    for number, curve in enumerate(outline.curves):
        if curve.turn == 0:
            continue
        mine = np.flatnonzero(triangulation.curve == number)
        centre = outline.centre(curve)
        radius = float(np.hypot(*(outline.points[curve.start] - centre)))
        a, b = triangulation.points[triangulation.edges[mine]].transpose(1, 0, 2)
        chord = (a + b) / 2 - centre
        size = np.hypot(chord[:, 0], chord[:, 1])
        middle = centre + chord * np.divide(radius, size, out=np.ones_like(size), where=size > 0)[:, None]
        if outline.chart == "axisymmetric" and abs(centre[0]) < 1e-9 * radius:
            # A sphere is a parabola in the chart: with the node at half of its z, exactly.
            z = (a[:, 1] + b[:, 1]) / 2
            r = np.sqrt(np.maximum(radius**2 - (z - centre[1]) ** 2, 0.0))
            middle = np.column_stack((r, z))
        middles[on_curve[mine]] = middle


def _smallest_jacobian(nodes: Floats, elements: Ints) -> Floats:
    """(m,) the least Jacobian determinant of each element over its nodes' middles and quadrature points."""
    points = np.concatenate((QUADRATURE_POINTS, CORNERS_AND_MIDDLES[3:]))
    jacobian = np.einsum("mnk,qnd->mqkd", nodes[elements], shape_derivatives(points), optimize=True)
    return np.asarray(
        (jacobian[..., 0, 0] * jacobian[..., 1, 1] - jacobian[..., 0, 1] * jacobian[..., 1, 0]).min(axis=1)
    )
