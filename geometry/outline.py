"""Polygons in the (r, z) half plane: what a turned part is made of, and how two of them lie to one another.

Arithmetic alone, so that masses and clearances need no CAD kernel and can check one. Lengths are in metres.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from functools import lru_cache

Point = tuple[float, float]
"""(r, z) in metres."""

Profile = tuple[Point, ...]
"""A closed polygon, its last vertex joined to its first."""

Edge = tuple[Point, Point]

RESOLUTION = 1e-10
"""m. Shorter overlaps are the rounding of coordinates that were meant to be equal."""


def rectangle(inner_radius: float, outer_radius: float, start: float, end: float) -> Profile:
    """The profile of a ring or, with inner radius 0, of a rod (m)."""
    return (inner_radius, start), (outer_radius, start), (outer_radius, end), (inner_radius, end)


def edges(profile: Profile) -> Iterator[Edge]:
    return itertools.pairwise((*profile, profile[0]))


def turned(profile: Profile) -> tuple[float, float]:
    """∫ dV = π ∮ r² dz and ∫ z dV = π ∮ r² z dz (m^3, m^4); Simpson's rule is exact for both along an edge."""
    whole = along = 0.0
    for (r0, z0), (r1, z1) in edges(profile):
        r, z, dz = (r0 + r1) / 2, (z0 + z1) / 2, z1 - z0
        whole += dz * (r0 * r0 + 4 * r * r + r1 * r1) / 6
        along += dz * (r0 * r0 * z0 + 4 * r * r * z + r1 * r1 * z1) / 6
    return math.pi * whole, math.pi * along


def spans(profile: Profile, z: float) -> list[tuple[Edge, Edge]]:
    """The stretches of material at height z, from the axis outwards, each between two edges."""
    passed = crossed(profile, z)
    return list(zip(passed[::2], passed[1::2], strict=True))


def crossed(profile: Profile, z: float) -> list[Edge]:
    """The edges that pass the height z, from the axis outwards."""
    passing = [(a, b) for a, b in edges(profile) if min(a[1], b[1]) < z < max(a[1], b[1])]
    return sorted(passing, key=lambda edge: at(edge, z))


def at(edge: Edge, z: float) -> float:
    """r of the straight line through an edge at height z."""
    (r0, z0), (r1, z1) = edge
    return r0 + (r1 - r0) * (z - z0) / (z1 - z0)


def overlap(first: Profile, second: Profile) -> float:
    """Volume (m^3) that two profiles share when turned, exactly.

    Cut at every vertex and every crossing, the plane falls into slabs in which no two edges cross: there the shared
    area is a row of trapezoids, whose volume of revolution Simpson's rule gives without error.
    """
    (r0, r1, z0, z1), (r2, r3, z2, z3) = box(first), box(second)
    low, high = max(z0, z2), min(z1, z3)
    if high - low < RESOLUTION or min(r1, r3) - max(r0, r2) < RESOLUTION:
        return 0.0
    cuts = {low, high} | {z for _, z in (*first, *second) if low < z < high}
    for a, b in itertools.product(edges(first), edges(second)):
        crossing = _crossing(a, b)
        if crossing is not None and low < crossing < high:
            cuts.add(crossing)
    shared = 0.0
    for bottom, top in itertools.pairwise(sorted(cuts)):
        if top - bottom < RESOLUTION:
            continue
        middle = (bottom + top) / 2
        for (a_in, a_out), (b_in, b_out) in itertools.product(spans(first, middle), spans(second, middle)):
            inner = a_in if at(a_in, middle) > at(b_in, middle) else b_in
            outer = a_out if at(a_out, middle) < at(b_out, middle) else b_out
            if at(outer, middle) - at(inner, middle) > RESOLUTION:
                squares = [at(outer, z) ** 2 - at(inner, z) ** 2 for z in (bottom, middle, top)]
                shared += math.pi * (top - bottom) * (squares[0] + 4 * squares[1] + squares[2]) / 6
    return shared


def distance(first: Profile, second: Profile) -> float:
    """Shortest distance between two profiles (m); 0 where they touch or overlap."""
    if overlap(first, second) > 0:
        return 0.0
    gap = min(
        _distance(point, edge)
        for mine, theirs in ((first, second), (second, first))
        for point in mine
        for edge in edges(theirs)
    )
    return 0.0 if gap < RESOLUTION else gap


@lru_cache(maxsize=1024)  # designs of a search share most of their parts
def is_simple(profile: Profile) -> bool:
    """Whether the polygon is counter-clockwise, on the right of the axis, and neither crosses nor touches itself."""
    if len(profile) < 3 or not all(math.isfinite(r) and math.isfinite(z) and r >= 0 for r, z in profile):
        return False
    if _is_rectangle(profile):  # most parts are rings, and there are dozens of them in each design of a search
        return True
    sides = list(edges(profile))
    if any(math.dist(a, b) < RESOLUTION for a, b in sides) or turned(profile)[0] <= 0:
        return False
    if _is_convex(sides):
        return True
    for i, j in itertools.combinations(range(len(sides)), 2):
        if j - i == 1 or (i == 0 and j == len(sides) - 1) or _apart(sides[i], sides[j]):
            continue
        pairs = [(point, sides[j]) for point in sides[i]] + [(point, sides[i]) for point in sides[j]]
        if _crossing(sides[i], sides[j]) is not None or any(_distance(*pair) < RESOLUTION for pair in pairs):
            return False
    return True


def _apart(a: Edge, b: Edge) -> bool:
    """Whether a gap of some width lies between two edges, across or along the axis; most pairs of an outline's are."""
    (r0, z0), (r1, z1) = a
    (r2, z2), (r3, z3) = b
    low, high = (z0, z1) if z0 < z1 else (z1, z0)
    if (z2 > high + RESOLUTION and z3 > high + RESOLUTION) or (z2 < low - RESOLUTION and z3 < low - RESOLUTION):
        return True
    low, high = (r0, r1) if r0 < r1 else (r1, r0)
    return (r2 > high + RESOLUTION and r3 > high + RESOLUTION) or (r2 < low - RESOLUTION and r3 < low - RESOLUTION)


def _is_convex(sides: list[Edge]) -> bool:
    """Whether an outline turns left at every vertex, and once around in all, as a ring of round section does."""
    steps = [(r1 - r0, z1 - z0) for (r0, z0), (r1, z1) in sides]
    turns = itertools.pairwise((*steps, steps[0]))
    if not all(dr0 * dz1 - dz0 * dr1 > 0 for (dr0, dz0), (dr1, dz1) in turns):
        return False
    rising = [dz > 0 or (dz == 0 and dr < 0) for dr, dz in steps]
    return sum(before != after for before, after in itertools.pairwise((*rising, rising[0]))) == 2


def _is_rectangle(profile: Profile) -> bool:
    """Whether the polygon is one that `rectangle` makes, with sides of a length."""
    if len(profile) != 4:
        return False
    (r0, z0), (r1, z1) = profile[0], profile[2]
    return profile == rectangle(r0, r1, z0, z1) and r1 - r0 >= RESOLUTION and z1 - z0 >= RESOLUTION


def _crossing(a: Edge, b: Edge) -> float | None:
    """The height z at which two edges cross; None where they do not or are parallel."""
    (r0, z0), (r1, z1) = a
    (r2, z2), (r3, z3) = b
    across = (r1 - r0) * (z3 - z2) - (z1 - z0) * (r3 - r2)
    if across == 0:
        return None
    s = ((r2 - r0) * (z3 - z2) - (z2 - z0) * (r3 - r2)) / across
    t = ((r2 - r0) * (z1 - z0) - (z2 - z0) * (r1 - r0)) / across
    return z0 + s * (z1 - z0) if 0 <= s <= 1 and 0 <= t <= 1 else None


def _distance(point: Point, edge: Edge) -> float:
    (r, z), ((r0, z0), (r1, z1)) = point, edge
    length = (r1 - r0) ** 2 + (z1 - z0) ** 2
    t = min(max(((r - r0) * (r1 - r0) + (z - z0) * (z1 - z0)) / length, 0.0), 1.0)
    return math.hypot(r - r0 - t * (r1 - r0), z - z0 - t * (z1 - z0))


def box(profile: Profile) -> tuple[float, float, float, float]:
    radii, heights = [r for r, _ in profile], [z for _, z in profile]
    return min(radii), max(radii), min(heights), max(heights)
