"""Convex polygons in the unrolled plane (θ, z) around an axis: a straight line there is a helix, a ring or a generator.

A point (θ + 2π, z) is the same place as (θ, z); polygons may go round several times. θ in rad, z in m, areas in rad m.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

Corner = tuple[float, float]
"""(θ, z)."""

Outline = tuple[Corner, ...]
"""A closed convex polygon, counter-clockwise, its last corner joined to its first."""

TURN = 2 * math.pi

FLAT = 1e-12
"""rad. Corners closer than this in θ stand above one another."""


def area(outline: Outline) -> float:
    """rad m, positive where the corners run counter-clockwise."""
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in sides(outline)) / 2


def centre(outline: Outline) -> tuple[float, float, float]:
    """Means of cos θ, sin θ and z (m) over the polygon, by Green's theorem, in closed form.

    ∬ cos θ dθ dz = ∮ sin θ dz and so on; along a straight side sin θ has the mean sin(middle) sin(δ)/δ, with δ half
    of the angle that the side spans.
    """
    first = outline[0]
    cosine = sine = height = 0.0
    for (theta, z), (onwards, above) in sides(outline):
        half, middle = (onwards - theta) / 2, (onwards + theta) / 2
        share = math.sin(half) / half if half else 1.0
        cosine += (above - z) * math.sin(middle) * share
        sine -= (above - z) * math.cos(middle) * share
        low, high = z - first[1], above - first[1]
        height -= half * (low * low + low * high + high * high) / 3
    whole = area(outline)
    return cosine / whole, sine / whole, first[1] + height / whole


def is_convex(outline: Outline) -> bool:
    """Whether the corners are finite and run counter-clockwise around a convex area, without folding back."""
    if len(outline) < 3 or not all(math.isfinite(value) for corner in outline for value in corner):
        return False
    steps = [(b[0] - a[0], b[1] - a[1]) for a, b in sides(outline)]
    turned = 0.0
    for (dx, dz), (ex, ez) in pairwise((*steps, steps[0])):
        across = dx * ez - dz * ex
        if across <= 0:
            return False
        turned += math.atan2(across, dx * ex + dz * ez)
    return abs(turned - TURN) < 1.0


def sides(outline: Outline) -> Iterator[tuple[Corner, Corner]]:
    """Each corner with the next."""
    return pairwise((*outline, outline[0]))


def chains(outline: Outline) -> tuple[tuple[Corner, ...], tuple[Corner, ...]]:
    """The lower and the upper edge, each by increasing θ."""
    start = min(range(len(outline)), key=outline.__getitem__)
    corners = [*outline[start:], *outline[:start]]
    last = max(range(len(corners)), key=lambda i: (corners[i][0], -corners[i][1]))
    upper = [*reversed(corners[last:])]
    if abs(corners[-1][0] - corners[0][0]) > FLAT:
        upper = [corners[0], *upper]
    if len(corners) > last + 1 and abs(corners[last + 1][0] - corners[last][0]) <= FLAT:
        upper = upper[:-1]
    return tuple(corners[: last + 1]), tuple(upper)


def reach(outline: Outline) -> tuple[float, float]:
    """From which θ to which (rad)."""
    angles = [theta for theta, _ in outline]
    return min(angles), max(angles)


def heights(outline: Outline) -> tuple[float, float]:
    """From which z to which (m)."""
    along = [z for _, z in outline]
    return min(along), max(along)


def moved(outline: Outline, angle: float, way: float) -> Outline:
    """The polygon turned (rad) and shifted along the axis (m)."""
    return tuple((theta + angle, z + way) for theta, z in outline)


def spans(outline: Outline, angle: float) -> list[tuple[float, float]]:
    """Where a generator at this angle (rad) and all its whole turns onwards lies in the polygon: from z to z (m).

    At an end face the polygon that begins there has the generator, not the one that ends.
    """
    low, high = reach(outline)
    lower, upper = chains(outline)
    first = math.ceil((low - angle) / TURN - FLAT)
    found = []
    for turn in range(first, math.ceil((high - angle) / TURN - FLAT)):
        theta = angle + turn * TURN
        span = at(lower, theta), at(upper, theta)
        if span[1] > span[0]:
            found.append(span)
    return found


def at(chain: tuple[Corner, ...], theta: float) -> float:
    """z (m) of an edge at an angle, that of its end where the angle is beyond it."""
    for (a, low), (b, high) in pairwise(chain):
        if theta <= b:
            return low + (high - low) * min(max((theta - a) / (b - a), 0.0), 1.0)
    return chain[-1][1]


def between(outline: Outline, low: float, high: float) -> Outline:
    """What lies between two angles (rad); empty where nothing does."""
    box = ((1.0, 0.0, low), (-1.0, 0.0, -high))
    for across, along, limit in box:
        outline = _beyond(outline, across, along, limit)
    return outline


def shared(first: Outline, second: Outline) -> Outline:
    """What two polygons have in common, as they lie, whole turns left out of account."""
    for (a, z), (b, above) in sides(second):
        first = _beyond(first, z - above, b - a, (z - above) * a + (b - a) * z)
    return first


def _beyond(outline: Outline, across: float, along: float, limit: float) -> Outline:
    """The part of a convex polygon where across · θ + along · z >= limit (Sutherland and Hodgman 1974)."""
    kept: list[Corner] = []
    for a, b in sides(outline) if outline else ():
        height, onwards = across * a[0] + along * a[1] - limit, across * b[0] + along * b[1] - limit
        if height >= 0:
            kept.append(a)
        if (height > 0 > onwards) or (height < 0 < onwards):
            share = height / (height - onwards)
            cut = (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
            kept.append((limit / across, cut[1]) if along == 0.0 else cut)
    return tuple(kept)
