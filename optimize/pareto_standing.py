"""How the points of a front stand to each other, and how much the front dominates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from fluxbore.optimize.pareto_result import FrontPoint, Standing
from fluxbore.optimize.pareto_scalar import Scale

JUMP = 2.0
"""How much steeper or flatter than its slopes the front may run between two points without a second look."""

Losses = tuple[float, float]


def with_standing(points: Sequence[FrontPoint], scale: Scale, tolerance: float) -> tuple[FrontPoint, ...]:
    """The points, those that another one dominates marked "dominated" and copies of an earlier one "repeated".

    tolerance : of the scaled losses; what differs by less counts as equal, for the searches find no more.
    """
    losses = [None if point.design is None else _losses(point, scale) for point in points]
    marked = []
    for index, (point, own) in enumerate(zip(points, losses, strict=True)):
        if own is None:
            marked.append(point)
            continue
        others = [other for other in losses if other is not None]
        earlier = [other for other in losses[:index] if other is not None]
        standing: Standing = "front"
        if any(_dominates(other, own, tolerance) for other in others):
            standing = "dominated"
        elif any(max(abs(a - b) for a, b in zip(other, own, strict=True)) <= tolerance for other in earlier):
            standing = "repeated"
        marked.append(replace(point, standing=standing))
    return tuple(marked)


def jumps(points: Sequence[FrontPoint]) -> list[tuple[float, float]]:
    """Neighbours on the front (their positions) between which it does not run as its slopes at both of them say.

    Along a piece of the front the secant is between both slopes, or near them where the front bends twice. Where it is
    far steeper or flatter, the front has a gap, or one of the two sits in another valley than the front there.
    """
    front = [point for point in points if point.standing == "front"]
    found = []
    for one, other in pairwise(front):
        if None in (one.slope, other.slope, one.first, one.second, other.first, other.second):
            continue
        slopes = abs(one.slope or 0.0), abs(other.slope or 0.0)
        run = abs((one.second or 0.0) - (other.second or 0.0))
        rise = abs((one.first or 0.0) - (other.first or 0.0))
        if rise > JUMP * max(slopes) * run or JUMP * rise < min(slopes) * run:
            found.append((one.position, other.position))
    return found


def hypervolume(points: Sequence[FrontPoint], scale: Scale) -> float:
    """The share of the rectangle between the ends, 0 <= u, v <= 1, that the points dominate (Zitzler and Thiele 1999).

    The reference point is u = v = 1. Which points are dominated themselves does not matter.
    """
    inside = [pair for point in points if point.design is not None and max(pair := _losses(point, scale)) <= 1]
    area, lowest = 0.0, 1.0
    for u, v in sorted(inside):
        if v < lowest:
            area += (1.0 - u) * (lowest - v)
            lowest = v
    return area


def _losses(point: FrontPoint, scale: Scale) -> Losses:
    assert point.first is not None
    assert point.second is not None
    return scale.scaled((point.first, point.second))


def _dominates(one: Losses, other: Losses, tolerance: float) -> bool:
    """Whether the first is better in one loss by more than the tolerance and in the other one no worse."""
    gains = [b - a for a, b in zip(one, other, strict=True)]
    return max(gains) > tolerance and min(gains) >= 0


def summary(points: Sequence[FrontPoint]) -> str:
    """How many points the front has, and what became of the others, in a sentence."""
    standings: list[str] = [point.standing for point in points]
    said = {"dominated": "dominated by others", "repeated": "found twice", "failed": "without a feasible design"}
    counts = {what: standings.count(name) for name, what in said.items() if name in standings}
    words = [f"{count} {'is' if count == 1 else 'are'} {what}" for what, count in counts.items()]
    text = f"The front has {standings.count('front')} of the {len(standings)} points asked for"
    return f"{text}; {', '.join(words)}." if words else f"{text}."
