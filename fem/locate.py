"""Which element of a mesh of curved triangles holds a point, and where in it.

Boxes around the elements, four to a box of the next level and so on, leave a few candidates for each point. Newton's
method inverts their quadratic maps.
"""

from __future__ import annotations

import numpy as np

from fluxbore.fem.element import shape, shape_derivatives
from fluxbore.fem.mesh import Floats, Ints, Mesh, in_chart

_POINTS_AT_ONCE = 20_000
"""Bounds the memory of a search, to some tens of megabytes."""

_STEPS = 60
"""Enough for Newton's method where it converges only linearly: a map without slope on an element's edge."""

_FINE = 1e-9
"""A step this small is the last: the next would be of the order of its square."""

_SKEW = 4.0
"""A point beside an element is moved to a place on its rim that is not quite the nearest: this much farther at most."""


class Locator:
    """Finds points in a mesh; made once for any number of points.

    snap : a point this far from an element, as a share of the mesh's diagonal, still counts as held by it.
    """

    def __init__(self, mesh: Mesh, snap: float = 1e-9) -> None:
        self._mesh = mesh
        nodes = mesh.nodes[mesh.elements]
        low, high = mesh.positions.min(axis=0), mesh.positions.max(axis=0)
        self._size = float(np.hypot(*(high - low)))
        self._snap = snap
        # Where rounding alone would put an element's points: of weight near the axis, where s is small beside its box.
        self._rounding = 1e-14 * np.abs(nodes).max(axis=1)
        corners, bend = nodes[:, :3], nodes[:, 3:] - (nodes[:, :3] + np.roll(nodes[:, :3], -1, axis=1)) / 2
        # A quadratic triangle lies within its Bézier points (Farin 1986): its corners and, for each edge, this one.
        beyond = nodes[:, 3:] + bend
        self._boxes = _Boxes(
            np.minimum(corners.min(axis=1), beyond.min(axis=1)) - self._rounding,
            np.maximum(corners.max(axis=1), beyond.max(axis=1)) + self._rounding,
        )
        # (m, 2, 2) from a step in the chart to one in b and c, and how far (m,) the curved map strays from the straight
        # one in those: Σ 4 a b bend ≤ 4/3 max |bend|. Corners in a line, as in half a circle, say nothing.
        self._origin = corners[:, 0]
        (p, u), (q, v) = np.moveaxis(corners[:, 1:] - corners[:, :1], (1, 2), (1, 0))
        determinant = p * v - q * u
        flat = np.abs(determinant) <= 1e-14 * (np.abs(p * v) + np.abs(q * u))
        inverse = np.array([[v, -u], [-q, p]]) / np.where(flat, np.inf, determinant)
        self._to_place = np.moveaxis(inverse, 2, 0)
        stray = 4 / 3 * np.abs(np.einsum("mij,mkj->mki", self._to_place, bend)).max(axis=(1, 2))
        self._stray = np.where(flat, np.inf, stray)

    def find(self, points: Floats, reach: float = 0.0) -> tuple[Ints, Floats]:
        """The element (k,) that holds each point (k, 2), in space in metres, and the barycentric place (k, 3) in it.

        −1 outside the mesh, with a place of NaN. Of several elements that hold a point the lowest in number is given;
        places are never outside their element. reach : a point that no element holds is moved to about the nearest
        place within this share of the mesh's diagonal, for points between an arc and the parabolas that stand for it.
        """
        points = np.asarray(points, dtype=float)
        element = np.full(points.shape[0], -1)
        barycentric = np.full((points.shape[0], 3), np.nan)
        for snap in (self._snap, reach)[: 1 + (reach > self._snap)]:
            lost = np.flatnonzero(element < 0)
            for some in np.array_split(lost, 1 + lost.size // _POINTS_AT_ONCE):
                point, holder, place, miss = self._holders(points[some], snap)
                order = np.lexsort((holder, miss if snap > self._snap else holder, point))
                first = order[np.flatnonzero(np.diff(point[order], prepend=-1))]
                element[some[point[first]]] = holder[first]
                barycentric[some[point[first]]] = place[first]
        return element, barycentric

    def find_all(self, point: Floats) -> list[tuple[int, Floats]]:
        """Every element that holds a point (2,), lowest number first, with its barycentric place (3,).

        For means over the elements that meet at a corner, an edge or an interface; empty outside the mesh.
        """
        _, holder, place, _ = self._holders(np.asarray(point, dtype=float).reshape(1, 2), self._snap)
        order = np.argsort(holder)
        return list(zip(holder[order].tolist(), place[order], strict=True))

    def _holders(self, points: Floats, snap: float) -> tuple[Ints, Ints, Floats, Floats]:
        """Pairs of a point and an element that holds it: their numbers, the places (n, 3), the misses (n,) in snaps."""
        chart, slack = self._in_chart(points, snap * self._size)
        point, element = self._boxes.around(chart - slack, chart + slack)
        point, element, start = self._possible(chart, slack, point, element)
        nodes = self._mesh.nodes[self._mesh.elements[element]]
        place = _inverse(nodes, chart[point], start, self._rounding[element] / 10)
        miss = np.abs(np.einsum("nk,nkd->nd", shape(place), nodes) - chart[point])
        allowed = slack[point] + self._rounding[element]
        share = np.hypot(*(miss / np.where(allowed > 0, allowed, 1.0)).T)
        held = np.all(miss <= _SKEW * slack[point] + self._rounding[element], axis=1)
        return point[held], element[held], place[held], share[held]

    def _possible(self, chart: Floats, slack: Floats, point: Ints, element: Ints) -> tuple[Ints, Ints, Floats]:
        """The pairs that the elements' bends leave possible, and b and c (n, 2) in the straight triangle of each."""
        to_place = self._to_place[element]
        start = np.einsum("nij,nj->ni", to_place, chart[point] - self._origin[element])
        margin = self._stray[element, None] + np.einsum(
            "nij,nj->ni", np.abs(to_place), slack[point] + self._rounding[element]
        )
        kept = np.all(start >= -margin, axis=1) & (start.sum(axis=1) <= 1 + margin.sum(axis=1))
        return point[kept], element[kept], start[kept]

    def _in_chart(self, points: Floats, snap: float) -> tuple[Floats, Floats]:
        """Points (k, 2) in the chart, NaN where none can be, and how far (k, 2) each may be moved there."""
        points = np.where(np.isfinite(points), points, np.nan)
        slack = np.full(points.shape, snap)
        if self._mesh.chart == "axisymmetric":
            r = np.where(points[:, 0] < -snap, np.nan, np.maximum(points[:, 0], 0.0))
            points = np.column_stack((r, points[:, 1]))
            slack[:, 0] = snap * (r + snap / 2)
        with np.errstate(over="ignore"):
            return in_chart(self._mesh.chart, points), slack


class _Boxes:
    """A tree of boxes, four to one, over elements sorted along a curve that keeps neighbours together."""

    def __init__(self, low: Floats, high: Floats) -> None:
        self._order = np.argsort(_along_curve((low + high) / 2))
        self._levels = [(low[self._order], high[self._order])]
        while self._levels[-1][0].shape[0] > 1:
            low, high = self._levels[-1]
            starts = np.arange(0, low.shape[0], 4)
            self._levels.append((np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)))

    def around(self, low: Floats, high: Floats) -> tuple[Ints, Ints]:
        """Pairs of the number of an asked box (k, 2), from low to high, and of a box of ours that it touches."""
        asked, box = np.arange(low.shape[0]), np.zeros(low.shape[0], dtype=np.int_)
        for level, (ours_low, ours_high) in enumerate(reversed(self._levels)):
            if level:
                asked, box = np.repeat(asked, 4), (4 * box[:, None] + np.arange(4)).ravel()
                there = box < ours_low.shape[0]
                asked, box = asked[there], box[there]
            meet = np.all((ours_low[box] <= high[asked]) & (ours_high[box] >= low[asked]), axis=1)
            asked, box = asked[meet], box[meet]
        return asked, self._order[box]


def _along_curve(centres: Floats) -> Ints:
    """(m,) codes of the centres along Morton's curve (1966), of their ranks, so that graded meshes are cut evenly."""
    code = np.zeros(centres.shape[0], dtype=np.int_)
    for axis in (0, 1):
        rank = np.empty(centres.shape[0], dtype=np.int_)
        rank[np.argsort(centres[:, axis], kind="stable")] = np.arange(centres.shape[0])
        for bit in range(31):
            code |= ((rank >> bit) & 1) << (2 * bit + axis)
    return code


def _inverse(nodes: Floats, points: Floats, start: Floats, close: Floats) -> Floats:
    """Barycentric coordinates (n, 3) of the points (n, 2) in the elements with nodes (n, 6, 2), or of a place near.

    start : (n, 2) first guess of the second and third. close : (n, 2) distance that is as good as none.
    A point that the element does not hold gets some place on its rim: what comes back is always inside, and whether it
    maps to the point is for the caller to see.
    """
    bc = start.copy()
    active = np.arange(points.shape[0])
    for step in range(_STEPS):
        here = np.clip(bc[active], -0.5, 1.5) if step != _STEPS // 2 else np.full((active.size, 2), 1 / 3)
        place = np.column_stack((1 - here.sum(axis=1), here))
        own = nodes[active]
        miss = points[active] - np.einsum("nk,nkd->nd", shape(place), own)
        far = np.any(np.abs(miss) > close[active], axis=1)
        bc[active] = here
        active, here, place, own, miss = active[far], here[far], place[far], own[far], miss[far]
        slope = np.einsum("nkb,nkd->nbd", shape_derivatives(place), own)
        # Where the map has no slope, as on the axis of some elements: towards the middle, away from such an edge.
        change = np.clip(_solved(slope, miss, 1 / 3 - here), -0.5, 0.5)
        bc[active] = here + change
        active = active[np.abs(change).max(axis=1, initial=0.0) > _FINE]
        if active.size == 0:
            break
    inside = np.maximum(np.column_stack((1 - bc.sum(axis=1), bc)), 0.0)
    return np.asarray(inside / inside.sum(axis=1, keepdims=True))


def _solved(rows: Floats, right: Floats, otherwise: Floats) -> Floats:
    """(n, 2) x with x @ rows = right for rows (n, 2, 2), or the other value where rows are singular."""
    (p, q), (u, v) = np.moveaxis(rows[:, 0], -1, 0), np.moveaxis(rows[:, 1], -1, 0)
    determinant = p * v - q * u
    size = np.abs(p * v) + np.abs(q * u)
    good = np.abs(determinant) > 1e-14 * size
    safe = np.where(good, determinant, 1.0)
    x, y = right.T
    solution = np.column_stack((x * v - y * u, y * p - x * q)) / safe[:, None]
    return np.where(good[:, None], solution, otherwise)
