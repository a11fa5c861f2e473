"""From straight triangles to quadratic elements that follow arcs, and that are sound on the axis.

An element whose six nodes are those of a straight triangle in (r, z) is that triangle exactly in the chart as well,
since s = r²/2 is a quadratic function. Only edges that touch the axis are laid straight in the chart instead: with the
node at half of s, B_z = ∂ψ/∂s keeps its order down to the axis, where a node at half of r would lose one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, shape_derivatives
from fluxbore.fem.field import CORNERS_AND_MIDDLES
from fluxbore.fem.linear import near_numbering
from fluxbore.fem.mesh import Floats, Ints, in_chart
from fluxbore.fem.outline import Outline
from fluxbore.fem.triangulation import Triangulation


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
    middles = _at_axis(triangulation.points[ends], straight, outline)
    slanted = on_curve[[outline.curves[c].turn == 0 for c in triangulation.curve]]
    middles[slanted] = np.where(_level(triangulation.points[ends[slanted]]), middles[slanted], straight[slanted])
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


def _level(ends: Floats) -> Floats:
    """(k, 1) whether an edge runs along z or along r, so that it is straight in both charts."""
    rise = np.abs(ends[:, 1] - ends[:, 0])
    return np.asarray(rise.min(axis=1) <= 1e-9 * rise.max(axis=1))[:, None]


def _at_axis(ends: Floats, straight: Floats, outline: Outline) -> Floats:
    """(k, 2) middles, those of edges that touch the axis at the mean of s instead of r."""
    if outline.chart == "planar":
        return straight.copy()
    touching = np.any(ends[..., 0] == 0, axis=1)
    r = np.sqrt(np.mean(ends[..., 0] ** 2, axis=1))
    return np.column_stack((np.where(touching, r, straight[:, 0]), straight[:, 1]))


def _onto_arcs(middles: Floats, triangulation: Triangulation, on_curve: Ints, outline: Outline) -> None:
    """Move the middles of edges on arcs to their circles: halfway along, or halfway in z beside the axis."""
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
            touching = (a[:, 0] == 0) | (b[:, 0] == 0)
            z = (a[:, 1] + b[:, 1]) / 2
            r = np.sqrt(np.maximum(radius**2 - (z - centre[1]) ** 2, 0.0))
            middle = np.where(touching[:, None], np.column_stack((r, z)), middle)
        middles[on_curve[mine]] = middle


def _smallest_jacobian(nodes: Floats, elements: Ints) -> Floats:
    """(m,) the least Jacobian determinant of each element over its nodes' middles and quadrature points."""
    points = np.concatenate((QUADRATURE_POINTS, CORNERS_AND_MIDDLES[3:]))
    jacobian = np.einsum("mnk,qnd->mqkd", nodes[elements], shape_derivatives(points), optimize=True)
    return np.asarray(
        (jacobian[..., 0, 0] * jacobian[..., 1, 1] - jacobian[..., 0, 1] * jacobian[..., 1, 0]).min(axis=1)
    )
