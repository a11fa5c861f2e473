"""The views of one part with all its dimensions, in mm of the paper at a scale, about the middle of its lower end.

A turned part: its section, lengths in rows below and above it, diameters in columns at both ends, chamfers, and where
it has drillings beside the axis or at several angles, the view from the left on the right (first-angle projection).
What follows a helix: the section of its envelope, turned so that the plane passes its middle.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from fluxbore.geometry import unrolled
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.part import Body, Hole, Part
from fluxbore.geometry.part_dimensions import (
    ALIKE,
    Chamfer,
    Diameter,
    HoleGroup,
    chamfers,
    diameters,
    fit_of,
    fit_text,
    hole_groups,
    levels,
)
from fluxbore.geometry.sheet import Circle, Dimension, Item, Place, Stroke, Text, bounds, moved
from fluxbore.geometry.sheet_dimension import LAYER, ROW, Station, apart, linear, number, running
from fluxbore.geometry.sheet_text import LARGE, SMALL
from fluxbore.geometry.sheet_view import MM, Section, left_view, section_of, section_view

FEW = 3
"""Lengths that stand between arrows; more are told in a row from the datum."""

CHAMFER_ROW = 4.4
"""mm between the words of two chamfers, which stand above the part, below all lengths."""

CLEAR = 10.0
"""mm between two views."""


def standing(part: Body) -> Body:
    """The part with its lower end at z = 0; what follows a helix has its middle at angle 0."""
    low = min(z for _, z in part.profile)
    if isinstance(part, HelicalPart):
        left, right = unrolled.reach(part.outline)
        return replace(part, outline=unrolled.moved(part.outline, -(left + right) / 2, -low))
    return replace(
        part,
        profile=tuple((r, z - low) for r, z in part.profile),
        holes=tuple(replace(hole, z=hole.z - low) for hole in part.holes),
        axial_holes=tuple(replace(hole, start=hole.start - low, end=hole.end - low) for hole in part.axial_holes),
    )


def alone(part: Body) -> Section:
    """What the plane shows of the part by itself."""
    return section_of(Assembly(part.name, (part,), 0.0))


def part_views(part: Body, section: Section, scale: float) -> list[Item]:
    """All of it. part : `standing`; section : of it `alone`."""
    if isinstance(part, HelicalPart):
        return apart(_helical_view(part, section, scale))
    groups = hole_groups(part)
    items = [*section_view(section, scale), *_lengths(part, groups, scale), *_chamfers(part, scale)]
    items += _diameters(part, diameters(part), bounds(items), scale)
    if part.axial_holes or len({round(hole.angle, 9) for hole in part.holes}) > 1:
        beside = [*left_view(part, scale), *_letters(part, groups, scale)]
        items += _to_the_right(items, beside)
    return apart(items)


def _to_the_right(items: Sequence[Item], view: Sequence[Item]) -> list[Item]:
    """Another view on the same height, beside all that is drawn."""
    x = bounds(items)[2] + CLEAR - bounds(view)[0]
    return [moved(item, (x, 0.0)) for item in view]


def _lengths(part: Part, groups: Sequence[HoleGroup], scale: float) -> list[Item]:
    """What is seen from outside in rows below, what only from within and drillings above."""
    factor = MM * scale
    reach = max(r for r, _ in part.profile) * factor
    below: list[Station] = []
    above: list[Station] = []
    for count, level in enumerate(levels(part), 1):
        side = above if level.inner else below
        sign = 1 if level.inner else -1
        side.append(
            Station(
                f"length {count}",
                (level.z * factor, sign * level.r * factor),
                level.z * MM,
                _length_fit(part, level.z),
            )
        )
    for group in groups:
        z, letter = _height(group), group.letter
        row, place = _told(z, above, below)
        if place is not None:
            row[place] = replace(row[place], after=f"{row[place].after}, {letter}".lstrip(", "))
        elif isinstance(group.first, Hole):
            above.append(Station(f"place of {letter}", (z * factor, reach), z * MM, letter))
        elif z > ALIKE:
            above.append(Station(f"end of {letter}", (z * factor, group.first.radius * factor), z * MM, letter))
    left = min(r for r, z in part.profile if z < ALIKE) * factor
    over = reach + 3 + CHAMFER_ROW * len(chamfers(part))
    return [
        *_row(below, (0.0, -max(r for r, z in part.profile if z < ALIKE) * factor), -reach - 3),
        *_row(above, (0.0, left), over),
    ]


def _told(z: float, *rows: list[Station]) -> tuple[list[Station], int | None]:
    """The row and the place in it where this height (m) is told already; None where it is not."""
    for row in rows:
        for place, station in enumerate(row):
            if abs(station.value - z * MM) < ALIKE * MM:
                return row, place
    return rows[0], None


def _height(group: HoleGroup) -> float:
    """Where a drilling is told to be: its axis, or the flat end within the part (m)."""
    first = group.first
    if isinstance(first, Hole):
        return first.z
    return first.end if first.start < ALIKE else first.start


def _row(stations: Sequence[Station], datum: Place, edge: float) -> list[Item]:
    """From the datum, between arrows where there are few and none has words, else in a row of numbers."""
    if not stations:
        return []
    if len(stations) > FEW or any(station.after and not station.after[0].isupper() for station in stations):
        return running(stations, datum, edge)
    way = 1 if edge > 0 else -1
    return [
        linear(
            station.name,
            datum,
            station.point,
            edge + way * (1 + ROW * row),
            station.value,
            label=f"<> {station.after}" if station.after else "<>",
        )
        for row, station in enumerate(sorted(stations, key=lambda station: station.value))
    ]


def _diameters(
    part: Part, found: Sequence[Diameter], around: tuple[float, float, float, float], scale: float
) -> list[Item]:
    """In columns, each at the end to which its cylinder is nearer, the smallest nearest to the part."""
    factor = MM * scale
    high = max(z for _, z in part.profile)
    sides: dict[int, list[Diameter]] = {-1: [], 1: []}
    for item in found:
        middle = (item.low + item.high) / 2 - high / 2
        fewer = -1 if len(sides[-1]) <= len(sides[1]) else 1
        sides[fewer if abs(middle) < 0.05 * high else (-1 if middle < 0 else 1)].append(item)
    while abs(len(sides[-1]) - len(sides[1])) > 2:  # both ends share the work
        many = -1 if len(sides[-1]) > len(sides[1]) else 1
        moving = min(sides[many], key=lambda item: -many * (item.low + item.high))
        sides[many].remove(moving)
        sides[-many].append(moving)
    names = {item.r: f"diameter {count}" for count, item in enumerate(found, 1)}
    items: list[Item] = []
    for side, members in sides.items():
        edge = 0.0 if side < 0 else high * factor
        for row, item in enumerate(sorted(members, key=lambda item: item.r), 1):
            z = item.low if side < 0 else item.high
            items.append(_diameter(part, names[item.r], item.r, z * factor, edge + side * (3 + ROW * row), factor))
    return items


def _diameter(part: Part, name: str, radius: float, x: float, line: float, factor: float) -> Dimension:
    size, r = 2 * radius, radius * factor
    words = _fit(part, size) or _thread(part, size)
    label = f"Ø<> {words}" if words else "Ø<>"
    return linear(name, (x, -r), (x, r), line, size * MM, across=True, label=label)


def _fit(part: Part, size: float) -> str:
    """The tolerance of a size (m) in words, "" where the general one holds."""
    fit = fit_of(part, size)
    return fit_text(fit) if fit is not None else ""


def _thread(part: Part, size: float) -> str:
    """What is cut on a cylinder of this diameter (m), "" where nothing is."""
    return next((f"thread {cut.thread}" for cut in part.axis_threads if abs(cut.diameter - size) < ALIKE), "")


def _length_fit(part: Part, size: float) -> str:
    """The same of a length, where no diameter has that size: fits are of diameters as a rule."""
    return "" if any(abs(2 * item.r - size) < ALIKE for item in diameters(part)) else _fit(part, size)


def _chamfers(part: Part, scale: float) -> list[Item]:
    """A leader from one of each size to above the part, with how many of them there are."""
    factor = MM * scale
    reach = max(r for r, _ in part.profile) * factor
    return [
        _chamfer(f"chamfer {row + 1}", item, factor, reach + 3 + CHAMFER_ROW * row)
        for row, item in enumerate(chamfers(part))
    ]


def _chamfer(name: str, item: Chamfer, factor: float, height: float) -> Dimension:
    (r0, z0), (r1, z1) = item.cylinder, item.face
    start = ((z0 + z1) / 2 * factor, (r0 + r1) / 2 * factor)
    way = 1 if z0 > z1 else -1  # towards the middle of the cylinder
    knee = start[0] + way * 4, height + SMALL / 2
    label = f"{item.count} × <>×45°" if item.count > 1 else "<>×45°"
    foot, anchor = (knee[0] + way * 0.8, height), "left" if way > 0 else "right"
    shown = Text(label.replace("<>", number(item.size * MM)), foot, SMALL, anchor, 0, LAYER)
    ends = ((z0 * factor, r0 * factor), (z1 * factor, r0 * factor))
    leader = Stroke(LAYER, (start, knee))
    return Dimension(name, "along", ends, knee[1], label, shown, (leader,))


def _letters(part: Part, groups: Sequence[HoleGroup], scale: float) -> list[Item]:
    """In the view from the left: around the part, at the angle of the first drilling of each group."""
    around = max(r for r, _ in part.profile) * MM * scale + 5.5
    places: dict[float, list[str]] = {}
    for group in groups:
        places.setdefault(round(group.first.angle, 6), []).append(group.letter)
    return [
        Text(
            ", ".join(letters),
            (math.sin(angle) * around, math.cos(angle) * around - LARGE / 2),
            LARGE,
            "right" if math.sin(angle) < -0.1 else "left",
        )
        for angle, letters in places.items()
    ]


def _helical_view(part: HelicalPart, section: Section, scale: float) -> list[Item]:
    """Envelope and section with both diameters, the length and, of a short piece, the width in its middle."""
    factor = MM * scale
    (_, low), (_, _), (_, high), _ = part.profile
    inner, outer = part.inner_radius * factor, part.outer_radius * factor
    start, end = low * factor, high * factor
    items = section_view(section, scale)
    for side in (1, -1):
        corners = ((start, side * inner), (end, side * inner), (end, side * outer), (start, side * outer))
        items.append(Stroke("EDGES", corners, closed=True))
    items.append(linear("length", (start, -outer), (end, -outer), -outer - ROW, (high - low) * MM))
    for row, (radius, name) in enumerate(
        ((part.inner_radius, "inner diameter"), (part.outer_radius, "outer diameter")), 1
    ):
        r = radius * factor
        line = start - 3 - ROW * row
        items.append(linear(name, (start, -r), (start, r), line, 2 * radius * MM, across=True, label="Ø<>"))
    cut = unrolled.spans(part.outline, 0.0)
    if cut:
        bottom, top = max(cut, key=lambda span: span[1] - span[0])
        ends = ((bottom * factor, outer), (top * factor, outer))
        items.append(linear("width", *ends, outer + ROW, (top - bottom) * MM))
    if part.angle < math.tau:
        items += _to_the_right(items, _sector(part, scale))
    return items


def _sector(part: HelicalPart, scale: float) -> list[Item]:
    """An arc seen along the axis."""
    half, steps = part.angle / 2, 48
    angles = [half * (2 * step / steps - 1) for step in range(steps + 1)]
    inner, outer = part.inner_radius * MM * scale, part.outer_radius * MM * scale
    points = [(outer * math.sin(angle), outer * math.cos(angle)) for angle in angles]
    points += [(inner * math.sin(angle), inner * math.cos(angle)) for angle in reversed(angles)]
    rays: list[Item] = [
        Stroke("CENTRE", ((0.0, 0.0), ((outer + 4) * math.sin(angle), (outer + 4) * math.cos(angle))))
        for angle in (-half, half)
    ]
    told = Text(f"{math.degrees(part.angle):.4g}°", (0.0, 0.35 * inner), SMALL, "middle", 0, "DIMENSIONS")
    return [Stroke("OUTLINE", tuple(points), closed=True), *rays, Circle("CENTRE", (0.0, 0.0), 1.0), told]
