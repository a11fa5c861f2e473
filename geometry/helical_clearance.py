"""Gaps and overlaps of helical parts, on their outlines in the unrolled plane: no kernel is asked.

Booleans between helical solids may be wrong without a word; polygons of straight lines are not.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import combinations
from typing import NamedTuple

from fluxbore.geometry import unrolled
from fluxbore.geometry.helical_part import HelicalPart, overlapping
from fluxbore.geometry.outline import RESOLUTION
from fluxbore.geometry.unrolled import TURN, Outline


class Gaps(NamedTuple):
    """The narrowest of an assembly's helical parts; infinite where there is none of a kind.

    radial : m, between members. axial : m, between parts of one member that have an angle in common. angular : rad,
    between those that have none, at heights that both have.
    """

    radial: float
    axial: float
    angular: float


def narrowest(parts: Iterable[HelicalPart]) -> Gaps:
    """Gaps of all pairs; parts of the same radii are of one member. 0 where any two touch or overlap."""
    members: dict[tuple[float, float], list[HelicalPart]] = {}
    for part in parts:
        members.setdefault((part.inner_radius, part.outer_radius), []).append(part)
    radial = min((radial_gap(a[0], b[0]) for a, b in combinations(members.values(), 2)), default=math.inf)
    axial = angular = math.inf
    for member in members.values():
        rising = sorted((*unrolled.heights(part.outline), i) for i, part in enumerate(member))
        for place, (_, top, i) in enumerate(rising):
            for low, _, j in rising[place + 1 :]:
                if low - top > axial:
                    break  # and so are all that begin higher
                found = axial_gap(member[i], member[j])
                axial = min(axial, found)
                if math.isinf(found):
                    angular = min(angular, angular_gap(member[i], member[j]))
    return Gaps(0.0 if abs(radial) < RESOLUTION else radial, axial, angular)


def radial_gap(first: HelicalPart, second: HelicalPart) -> float:
    """Between the farther one's inside and the nearer one's outside (m); negative where the radii overlap."""
    return max(first.inner_radius - second.outer_radius, second.inner_radius - first.outer_radius)


def overlap(first: HelicalPart, second: HelicalPart) -> float:
    """Volume (m^3) that two parts share: what their outlines share, whole turns tried, times (r_2² − r_1²)/2."""
    inner = max(first.inner_radius, second.inner_radius)
    outer = min(first.outer_radius, second.outer_radius)
    if outer - inner < RESOLUTION:
        return 0.0
    common = (unrolled.shared(first.outline, other) for other in _turns(first, second, 0.0))
    return (outer**2 - inner**2) / 2 * sum(unrolled.area(part) for part in common if overlapping(part, first))


def axial_gap(first: HelicalPart, second: HelicalPart) -> float:
    """Shortest way along the axis from one to the other (m), at angles that both have; infinite where there are none.

    0 where they touch or overlap, whatever their radii. Exact: between straight edges the way is shortest at a corner.
    """
    gap = math.inf
    for other in _turns(first, second, math.inf):
        low = max(unrolled.reach(first.outline)[0], unrolled.reach(other)[0])
        high = min(unrolled.reach(first.outline)[1], unrolled.reach(other)[1])
        if high - low <= unrolled.FLAT:
            continue  # they only share the plane of an end
        for angle in {low, high, *(theta for theta, _ in (*first.outline, *other) if low < theta < high)}:
            (bottom, top), (beneath, above) = _span(first.outline, angle), _span(other, angle)
            gap = min(gap, max(beneath - top, bottom - above))
    return 0.0 if gap < RESOLUTION else gap


def angular_gap(first: HelicalPart, second: HelicalPart) -> float:
    """Smallest angle from one to the other (rad), at heights that both have; infinite where there are none.

    0 where they touch or overlap, whatever their radii.
    """
    turned = [tuple((z, theta) for theta, z in outline) for outline in (first.outline, second.outline)]
    low = max(min(z for z, _ in outline) for outline in turned)
    high = min(max(z for z, _ in outline) for outline in turned)
    if high - low <= RESOLUTION:
        return math.inf
    gap = math.inf
    for height in {low, high, *(z for outline in turned for z, _ in outline if low < z < high)}:
        (left, right), (start, end) = (_span(_reversed(outline), height) for outline in turned)
        # The nearest whole turn of the other on either side.
        nearest = round(((left + right) - (start + end)) / 2 / TURN)
        for turn in (nearest - 1, nearest, nearest + 1):
            gap = min(gap, max(start + turn * TURN - right, left - end - turn * TURN))
    return 0.0 if gap < RESOLUTION / first.outer_radius else gap


def _turns(first: HelicalPart, second: HelicalPart, margin: float) -> Iterator[Outline]:
    """The second outline, turned by all whole turns that may meet the first; margin : m along the axis between them."""
    (low, high), (start, end) = unrolled.reach(first.outline), unrolled.reach(second.outline)
    (bottom, top), (beneath, above) = unrolled.heights(first.outline), unrolled.heights(second.outline)
    if max(beneath - top, bottom - above) > margin:
        return
    for turn in range(math.ceil((low - end) / TURN), math.floor((high - start) / TURN) + 1):
        yield unrolled.moved(second.outline, turn * TURN, 0.0)


def _reversed(outline: Outline) -> Outline:
    """A polygon whose axes were swapped runs the other way."""
    return outline[::-1]


def _span(outline: Outline, place: float) -> tuple[float, float]:
    """From where to where a convex polygon reaches at one value of its first coordinate, ends included."""
    crossed = []
    for (a, low), (b, high) in unrolled.sides(outline):
        if min(a, b) <= place <= max(a, b):
            crossed += [low, high] if a == b else [low + (high - low) * (place - a) / (b - a)]
    return min(crossed), max(crossed)
