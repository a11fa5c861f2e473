"""Refinement of a triangulation by newest-vertex bisection, true to the outline's arcs and periodic pairs.

Triangles keep the order (a, b, newest): the edge a–b, opposite the newest vertex, is the next to be halved (Mitchell
1989), so that a triangle's descendants fall into four similarity classes and no angle ever becomes small (Binev, Dahmen
and DeVore 2004). Every edge of a marked triangle is halved; closure halves the a–b edge of each triangle that has any
halved edge, and the mate of each halved edge on a periodic curve, until nothing changes (Funken, Praetorius and
Wissgott 2011).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.outline import Outline
from fluxbore.fem.triangulation import Triangulation

Flags = NDArray[np.bool_]

_LEAST_SHARE = 0.1
"""A node goes onto its arc only as far as each triangle keeps this share of the area that straight halving gives it."""


@dataclass(frozen=True, slots=True, eq=False)
class Refined:
    """A finer triangulation, and where it came from.

    parents : (n, 2) the two old nodes that each node lies between; an old node, which keeps its number, itself twice.
    origin : (m,) the old triangle that each triangle is a part of.
    """

    triangulation: Triangulation
    parents: Ints
    origin: Ints


def prepare(triangulation: Triangulation) -> Triangulation:
    """The same triangles, each beginning with its longest edge: what the first `refine` of a fresh mesh needs."""
    corners = triangulation.points[triangulation.triangles]
    length = np.hypot(*np.moveaxis(np.roll(corners, -1, axis=1) - corners, -1, 0))
    turn = (np.argmax(length, axis=1)[:, None] + np.arange(3)) % 3
    return _with_triangles(triangulation, np.take_along_axis(triangulation.triangles, turn, axis=1))


def refine(triangulation: Triangulation, outline: Outline, marked: Flags, mates: Ints | None = None) -> Refined:
    """Halve every edge of the marked triangles, and what conformity asks for besides.

    marked : (m,) triangles. mates : (p, 2) numbers of curve edges to be halved together, `mates_of` the outline's
    pairs if None.
    """
    edges = _Edges.of(triangulation)
    halved = np.zeros(edges.nodes.shape[0], dtype=bool)
    halved[edges.of_triangle[marked]] = True
    if mates is None:
        mates = mates_of(triangulation, outline)
    first, second = edges.of_curve[mates].T
    reference, others = edges.of_triangle[:, 0], edges.of_triangle[:, 1:]
    count = -1
    while count != (count := int(np.count_nonzero(halved))):
        halved[reference[np.any(halved[others], axis=1)]] = True
        halved[first[halved[second]]] = True
        halved[second[halved[first]]] = True
    middle = _number(halved, triangulation.points.shape[0])
    triangles, origin = _bisected(triangulation.triangles, middle[edges.of_triangle])
    return _finish(triangulation, outline, edges, middle, triangles, origin)


def refine_all(triangulation: Triangulation, outline: Outline) -> Refined:
    """Cut every triangle into four that are similar to it where no arc bends them: for studies of convergence."""
    edges = _Edges.of(triangulation)
    middle = _number(np.ones(edges.nodes.shape[0], dtype=bool), triangulation.points.shape[0])
    (a, b, c), (ab, bc, ca) = triangulation.triangles.T, middle[edges.of_triangle].T
    # Each begins with the edge that is parallel to a–b.
    four = np.stack((a, ab, ca, ab, b, bc, ca, bc, c, bc, ca, ab), axis=1)
    origin = np.repeat(np.arange(a.size), 4)
    return _finish(triangulation, outline, edges, middle, four.reshape(-1, 3), origin)


def mates_of(triangulation: Triangulation, outline: Outline) -> Ints:
    """(p, 2) numbers of the curve edges that lie on each other's image, of every pair of the outline.

    ValueError if the two sides of a pair are not cut alike, which is a mesher's fault.
    """
    found = [np.empty((0, 2), dtype=np.int_)]
    for pair in outline.pairs:
        first, second = (_in_order(triangulation, outline, number) for number in (pair.first, pair.second))
        if first.size != second.size:
            raise ValueError(f"paired curves {pair.first} and {pair.second} have {first.size} and {second.size} edges")
        found.append(np.column_stack((first, second[::-1] if pair.reverse else second)))
    return np.concatenate(found)


def _in_order(triangulation: Triangulation, outline: Outline, number: int) -> Ints:
    """Numbers of a curve's edges from its start to its end: in the order of their shadows on its chord."""
    curve = outline.curves[number]
    edges = np.flatnonzero(triangulation.curve == number)
    chord = outline.points[curve.end] - outline.points[curve.start]
    return np.asarray(edges[np.argsort(triangulation.points[triangulation.edges[edges]].sum(axis=1) @ chord)])


def signed_area(points: Floats, triangles: Ints) -> Floats:
    """(m,) m², positive for counter-clockwise triangles."""
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    u, v = b - a, c - a
    return np.asarray((u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2)


@dataclass(frozen=True, slots=True, eq=False)
class _Edges:
    """nodes : (e, 2) sorted. of_triangle : (m, 3) edges ab, bc, ca. of_curve : (k,) the edge of each curve edge."""

    nodes: Ints
    of_triangle: Ints
    of_curve: Ints

    @classmethod
    def of(cls, triangulation: Triangulation) -> _Edges:
        count = triangulation.points.shape[0]
        t = triangulation.triangles
        ends = np.stack((t, np.roll(t, -1, axis=1)), axis=-1)
        code, place = np.unique(_code(ends.reshape(-1, 2), count), return_inverse=True)
        on_curves = _code(triangulation.edges, count)
        of_curve = np.minimum(np.searchsorted(code, on_curves), code.size - 1)
        if not np.array_equal(code[of_curve], on_curves):
            raise ValueError("an edge of a curve is no edge of a triangle")
        return cls(np.column_stack(np.divmod(code, count)), place.reshape(-1, 3), of_curve)


def _code(ends: Ints, count: int) -> Ints:
    return np.asarray(ends.min(axis=1) * count + ends.max(axis=1))


def _number(halved: Flags, nodes: int) -> Ints:
    """The new node in the middle of each edge, −1 where there is none."""
    return np.where(halved, nodes - 1 + np.cumsum(halved), -1)


def _bisected(triangles: Ints, middle: Ints) -> tuple[Ints, Ints]:
    """The children in the order of their parents, and each one's parent."""
    (a, b, c), (ab, bc, ca) = triangles.T, middle.T
    split = middle >= 0
    children = 1 + np.count_nonzero(split, axis=1)
    start = np.cumsum(children) - children
    new = np.empty((int(children.sum()), 3), dtype=triangles.dtype)

    def put(which: Flags, rows: Ints, *corners: Ints) -> None:
        new[rows[which]] = np.column_stack(corners)[which]

    # Halving a–b gives (c, a, ab) and (b, c, ab); halving those, their own first edges.
    halved, left, right = split[:, 0], start, start + 1 + split[:, 2]
    put(~halved, start, a, b, c)
    put(halved & ~split[:, 2], left, c, a, ab)
    put(split[:, 2], left, ab, c, ca)
    put(split[:, 2], left + 1, a, ab, ca)
    put(halved & ~split[:, 1], right, b, c, ab)
    put(split[:, 1], right, ab, b, bc)
    put(split[:, 1], right + 1, c, ab, bc)
    return new, np.repeat(np.arange(triangles.shape[0]), children)


def _finish(
    old: Triangulation, outline: Outline, edges: _Edges, middle: Ints, triangles: Ints, origin: Ints
) -> Refined:
    itself = np.arange(old.points.shape[0])
    parents = np.concatenate((np.column_stack((itself, itself)), edges.nodes[middle >= 0]))
    straight = np.concatenate((old.points, old.points[parents[itself.size :]].mean(axis=1)))
    between = middle[edges.of_curve]
    points = _onto_arcs(straight, triangles, outline, old.edges, old.curve, between)
    cut = between >= 0
    pieces = 1 + cut
    last = np.cumsum(pieces) - 1
    curve_edges = np.repeat(old.edges, pieces, axis=0)
    curve_edges[last[cut] - 1, 1] = between[cut]
    curve_edges[last[cut], 0] = between[cut]
    region, curve = old.region[origin], np.repeat(old.curve, pieces)
    return Refined(Triangulation(points, triangles, region, curve_edges, curve, old.vertex), parents, origin)


def _onto_arcs(straight: Floats, triangles: Ints, outline: Outline, edges: Ints, curve: Ints, between: Ints) -> Floats:
    """The points with the new ones on arcs moved from the middle of their chord to the middle of its arc."""
    turn = np.array([c.turn for c in outline.curves])[curve]
    cut = (between >= 0) & (turn > 0)
    if not cut.any():
        return straight
    radius = np.array([outline.length(c) / c.turn if c.turn > 0 else 0.0 for c in outline.curves])[curve[cut]]
    chord = straight[edges[cut, 1]] - straight[edges[cut, 0]]
    half = np.hypot(*chord.T) / 2
    # An arc runs counter-clockwise, so it bulges to the right of its chord. Written without the circle's centre, which
    # would cost digits where the radius is many chords, and coincides with the middle where the arc is half a circle.
    rise = half**2 / (radius + np.sqrt(np.maximum(radius**2 - half**2, 0.0)))
    target = straight.copy()
    target[between[cut]] += (rise / (2 * half))[:, None] * np.column_stack((chord[:, 1], -chord[:, 0]))
    return _as_far_as_possible(straight, target, triangles)


def _as_far_as_possible(straight: Floats, target: Floats, triangles: Ints) -> Floats:
    """Each point moved to its target, or half of the way and so on where a triangle would lose its area.

    That happens to nodes so close to an arc that its coarse chord has the wrong side of them. Cutting more triangles
    would not save them, since the corners of one that turns over stay where they are.
    """
    moves = np.any(target != straight, axis=1)
    touched = triangles[np.any(moves[triangles], axis=1)]
    least = _LEAST_SHARE * signed_area(straight, touched)
    share = np.ones(straight.shape[0])
    points = target
    while np.any(spoilt := signed_area(points, touched) < least):
        nodes = np.unique(touched[spoilt])
        nodes = nodes[share[nodes] > 0]
        if nodes.size == 0:
            break
        share[nodes] = np.where(share[nodes] > 0.1, share[nodes] / 2, 0.0)
        points = np.where(share[:, None] == 1, target, straight + share[:, None] * (target - straight))
    return points


def _with_triangles(old: Triangulation, triangles: Ints) -> Triangulation:
    return Triangulation(old.points, triangles, old.region, old.edges, old.curve, old.vertex)
