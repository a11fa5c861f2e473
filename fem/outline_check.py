"""From an outline to pieces that meet in their ends only: curves are cut at the points on them, copies are dropped."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely
from scipy.spatial import cKDTree

from fluxbore.design.errors import MeshError
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.outline import Curve, Outline

MOST_CURVES = 20_000
NEAREST = 1e-6
"""Least size of a drawing over its distance from the origin, where rounding is 1e-10 of the size."""
LEAST = 4e-6
"""Least distance between two features as a share of the drawing's diagonal. netgen joins points closer than 2.3e-6."""


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """points : (n, 2) m, the outline's first. ends : (k, 2) node numbers. curve : (k,). t : (k, 2) fractions of it.

    partner : (k,) the piece that shares this one's unknowns, −1 for none. mirrored : (k,) 1 if it runs the other way.
    """

    points: Floats
    ends: Ints
    curve: Ints
    t: Floats
    partner: Ints
    mirrored: Ints


def place(outline: Outline, at: Floats) -> str:
    """A point as the drawing's author knows it: "(1.5, 20) mm"."""
    x, y = (0.0 + round(float(v) / outline.unit, 9) for v in at)
    return f"({x:.6g}, {y:.6g}) {outline.unit_name}"


def distance(outline: Outline, length: float) -> str:
    return f"{length / outline.unit:.3g} {outline.unit_name}"


def diagonal(outline: Outline) -> float:
    """Of the bounding box of all points (m)."""
    return float(np.hypot(*np.ptp(outline.points, axis=0)))


def cleaned(outline: Outline) -> Outline:
    """The outline with points on the axis put exactly there; raises MeshError for what can be no drawing."""
    points = np.asarray(outline.points, dtype=float).reshape(-1, 2)
    if len(outline.curves) > MOST_CURVES:
        raise MeshError(f"the drawing has {len(outline.curves)} lines and arcs; at most {MOST_CURVES} can be meshed")
    if len(points) > 3 * MOST_CURVES:
        raise MeshError(f"the drawing has {len(points)} points; at most {3 * MOST_CURVES} can be meshed")
    if len(outline.curves) < 2 or len(points) < 2:
        raise MeshError("the drawing encloses no area: it needs at least two lines or arcs")
    seeds = np.array([s.position for s in outline.seeds], dtype=float).reshape(-1, 2)
    if not np.isfinite(points).all() or not np.isfinite(seeds).all() or np.abs(points).max() > 1e9:
        raise MeshError("the drawing has a coordinate that is not a number, or beyond 1e9 m")
    outline = replace(outline, points=points)
    size = diagonal(outline)
    if size < 1e-12:
        raise MeshError(f"the drawing's points all lie at {place(outline, points[0])}")
    if size < NEAREST * np.abs(points).max():
        raise MeshError(
            f"the drawing is {distance(outline, size)} large and as far from the origin as {place(outline, points[0])};"
            " its coordinates are too coarse there"
        )
    for curve in outline.curves:
        _check_curve(outline, curve)
    if outline.chart == "axisymmetric":
        points = np.where((np.abs(points) < 1e-9 * size) & [True, False], 0.0, points)
        outline = replace(outline, points=points)
        _check_half_plane(outline)
    close = cKDTree(points).query_pairs(LEAST * size, output_type="ndarray")
    if len(close):
        a, b = points[close[0][0]], points[close[0][1]]
        raise MeshError(
            f"two points at {place(outline, a)} are {distance(outline, float(np.hypot(*(a - b))))} apart;"
            f" in a drawing of this size points must be {distance(outline, LEAST * size)} apart, or be one"
        )
    return outline


def _check_curve(outline: Outline, curve: Curve) -> None:
    count = len(outline.points)
    if not (0 <= curve.start < count and 0 <= curve.end < count):
        raise MeshError(f"a line or arc names point {max(curve.start, curve.end)}; the drawing has {count} points")
    if curve.start == curve.end:
        raise MeshError(f"a line or arc starts and ends in the point {place(outline, outline.points[curve.start])}")
    if not 0 <= curve.turn <= np.pi * (1 + 1e-9):
        raise MeshError(f"an arc at {place(outline, outline.points[curve.start])} must turn by at most 180 degrees")


def _check_half_plane(outline: Outline) -> None:
    edge = -1e-9 * diagonal(outline)
    used = np.unique([[c.start, c.end] for c in outline.curves])
    for p in outline.points[used]:
        if p[0] < edge:
            raise MeshError(f"the point {place(outline, p)} lies at r < 0, where an axisymmetric drawing cannot go")
    for curve in outline.curves:
        if curve.turn:
            arc = outline.along(curve, np.linspace(0, 1, 65))
            low = arc[arc[:, 0].argmin()]
            if low[0] < edge:
                raise MeshError(
                    f"the arc through {place(outline, low)} lies at r < 0, where an axisymmetric drawing cannot go"
                )


def pieces(outline: Outline) -> Pieces:
    """The curves of a `cleaned` outline, cut at every point that lies on them; of several alike one is kept."""
    _check_pairs(outline)
    points, cuts = _cuts(outline)
    ends, owner, t = [], [], []
    for number, curve in enumerate(outline.curves):
        stops = [(0.0, curve.start), *sorted(cuts.get(number, [])), (1.0, curve.end)]
        for (t0, a), (t1, b) in pairwise(stops):
            ends.append((a, b))
            owner.append(number)
            t.append((t0, t1))
    whole = Pieces(
        points, np.array(ends), np.array(owner), np.array(t), np.full(len(ends), -1), np.zeros(len(ends), dtype=int)
    )
    return _paired(outline, _distinct(outline, whole))


def _cuts(outline: Outline) -> tuple[Floats, dict[int, list[tuple[float, int]]]]:
    """Points on the interiors of curves as (fraction, point) of each curve, and the points with those a pair adds."""
    points, tolerance = outline.points, LEAST * diagonal(outline)
    lines = [shapely.LineString(outline.along(c, np.linspace(0, 1, 2 if c.turn == 0 else 65))) for c in outline.curves]
    # The polyline of an arc leaves its circle by the sagitta of 1/64 of its turn.
    reach = [tolerance + (outline.length(c) * c.turn / 64**2 / 8 * 1.1 if c.turn else 0.0) for c in outline.curves]
    found = shapely.STRtree(shapely.points(points)).query(lines, predicate="dwithin", distance=reach)
    cuts: dict[int, list[tuple[float, int]]] = {}
    for number, node in found.T.tolist():
        curve = outline.curves[number]
        if node in (curve.start, curve.end):
            continue
        t, off = _foot(outline, curve, points[node])
        if off <= tolerance and 0 < t < 1:
            cuts.setdefault(number, []).append((t, node))
    extra: list[Floats] = []
    for pair in outline.pairs:
        for here, there in ((pair.first, pair.second), (pair.second, pair.first)):
            for t, _ in list(cuts.get(here, [])):
                image = 1 - t if pair.reverse else t
                length = outline.length(outline.curves[there])
                if all(abs(image - s) * length > 4 * tolerance for s, _ in cuts.get(there, [])):
                    cuts.setdefault(there, []).append((image, len(points) + len(extra)))
                    extra.append(outline.along(outline.curves[there], np.array(image)))
    return (np.vstack([points, *extra]) if extra else points), cuts


def _foot(outline: Outline, curve: Curve, p: Floats) -> tuple[float, float]:
    """Fraction of the curve nearest to p, and p's distance from the curve's line or circle (m)."""
    a, b = outline.points[curve.start], outline.points[curve.end]
    if curve.turn == 0:
        along = b - a
        t = float((p - a) @ along / (along @ along))
        return t, float(np.hypot(*(a + t * along - p)))
    centre = outline.centre(curve)
    arm, to = a - centre, p - centre
    angle = float(np.arctan2(arm[0] * to[1] - arm[1] * to[0], arm @ to)) % (2 * np.pi)
    return angle / curve.turn, abs(float(np.hypot(*to)) - float(np.hypot(*arm)))


def _distinct(outline: Outline, whole: Pieces) -> Pieces:
    """Without the copies. One of a pair, or with a condition, outlives one without."""
    tied = {n for pair in outline.pairs for n in (pair.first, pair.second)}
    middle = np.array(
        [outline.along(outline.curves[c], np.array(m)) for c, m in zip(whole.curve, whole.t.mean(axis=1), strict=True)]
    )
    tolerance = 4 * LEAST * diagonal(outline)
    best: dict[tuple[int, int], list[int]] = {}
    rank = [(n not in tied, outline.curves[n].condition is None) for n in whole.curve.tolist()]
    for k in sorted(range(len(rank)), key=lambda k: rank[k]):
        a, b = whole.ends[k].tolist()
        same = best.setdefault((min(a, b), max(a, b)), [])
        if all(np.abs(middle[k] - middle[j]).max() > tolerance for j in same):
            same.append(k)
    keep = np.sort([k for same in best.values() for k in same])
    return Pieces(
        whole.points, whole.ends[keep], whole.curve[keep], whole.t[keep], whole.partner[keep], whole.mirrored[keep]
    )


def _check_pairs(outline: Outline) -> None:
    for pair in outline.pairs:
        a, b = outline.curves[pair.first], outline.curves[pair.second]
        la, lb = outline.length(a), outline.length(b)
        where = f"from {place(outline, outline.points[a.start])} and from {place(outline, outline.points[b.start])}"
        if pair.first == pair.second:
            raise MeshError(f"the curve {place(outline, outline.points[a.start])} is periodic with itself")
        # Arcs of one angle are alike whatever their radius: the rims of a Kelvin exterior may differ in size.
        unlike = a.turn == 0 and abs(la - lb) > 1e-5 * max(la, lb)
        if abs(a.turn - b.turn) > 1e-5 or unlike:
            raise MeshError(
                f"the periodic sides {where} differ: they are {distance(outline, la)} and {distance(outline, lb)}"
                f" long and turn by {np.degrees(a.turn):.6g} and {np.degrees(b.turn):.6g} degrees"
            )


def _paired(outline: Outline, distinct: Pieces) -> Pieces:
    partner, mirrored = distinct.partner.copy(), distinct.mirrored.copy()
    for pair in outline.pairs:
        first = np.flatnonzero(distinct.curve == pair.first)
        second = np.flatnonzero(distinct.curve == pair.second)
        if pair.reverse:
            second = second[::-1]
        at = place(outline, outline.points[outline.curves[pair.first].start])
        if len(first) != len(second) or (partner[first] >= 0).any() or (partner[second] >= 0).any():
            raise MeshError(f"the periodic side from {at} overlaps another line or has two partners")
        partner[first], partner[second] = second, first
        mirrored[first] = mirrored[second] = int(pair.reverse)
    return replace(distinct, partner=partner, mirrored=mirrored)
