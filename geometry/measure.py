"""What a drawing of an assembly is dimensioned by: distances in the plane of its section."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fluxbore.geometry.helical_part import HelicalPart

if TYPE_CHECKING:
    from fluxbore.geometry.outline import Point
    from fluxbore.geometry.part import Body

FEW = 6
"""Parts that are measured one by one; of more only stator, mover and the whole, since parts have their own sheets."""


@dataclass(frozen=True, slots=True)
class Measure:
    """A distance between two points of the section's plane, (z, y') in m.

    name : what it is, for whoever reads the file. across : measured across the axis; else along it. place : where its
    line stands, z (m) of one across; of one along the axis the row below the drawing, from 1, or above it, from -1.
    sign : before the number, as DXF writes it.
    """

    name: str
    start: Point
    end: Point
    across: bool = False
    place: float = 1.0
    sign: str = ""

    @property
    def length(self) -> float:
        """m."""
        i = 1 if self.across else 0
        return abs(self.end[i] - self.start[i])


@dataclass(frozen=True, slots=True)
class Detail:
    """What is shown again, larger: a circle of the section about (z, y') with a radius `reach` (m).

    measures : with the places of their lines in m, z of one across the axis and y' of one along it.
    """

    name: str
    centre: Point
    reach: float
    measures: tuple[Measure, ...] = ()


def along(name: str, low: float, high: float, radius: float, row: int) -> Measure:
    """From z to z (m), measured at the lower half of a part of this radius (m)."""
    return Measure(name, (low, -radius), (high, -radius), place=row)


def diameter(name: str, radius: float, at: float, place: float) -> Measure:
    """Of what has this radius at the height z = `at` (m)."""
    return Measure(name, (at, -radius), (at, radius), across=True, place=place, sign="%%c")


def overall(parts: Sequence[Body], gap: float) -> tuple[Measure, ...]:
    """Length and diameter of every part (m), or of the groups of many, for an assembly that says nothing of its own.

    gap : between two lines across, to the left of the drawing (m). What is as long at the same place, or as wide, is
    measured once. What follows a helix has a diameter, but a length only where there is nothing else: the plane need
    not pass its ends.
    """
    groups: dict[str, list[Body]] = {}
    for part in parts:
        groups.setdefault(part.name if len(parts) <= FEW else part.group, []).append(part)
    if len(parts) > FEW:
        groups["over all"] = list(parts)
    turned = any(not isinstance(part, HelicalPart) for part in parts)
    spans: dict[tuple[float, float], tuple[str, float, float]] = {}
    circles: dict[float, float] = {}
    for name, members in groups.items():
        long = [part for part in members if not turned or not isinstance(part, HelicalPart)]
        outer, at = max(point for part in members for point in part.profile)
        if long:
            points = [(z, r) for part in long for r, z in part.profile]
            (low, _), (high, _) = min(points), max(points)
            first, last = (max(r for z, r in points if z == end) for end in (low, high))
            spans.setdefault((low, high), (f"length, {name}", first, last))
        circles.setdefault(outer, at)
    left = min(z for part in parts for _, z in part.profile)
    by_length = sorted(spans.items(), key=lambda item: item[0][1] - item[0][0])
    return (
        *(
            Measure(name, (low, -first), (high, -last), place=row)
            for row, ((low, high), (name, first, last)) in enumerate(by_length, 1)
        ),
        *(diameter("diameter", r, circles[r], left - gap * place) for place, r in enumerate(sorted(circles), 1)),
    )
