"""Parts as they look on paper: the section through the axis, what is seen behind it, and the view from the left.

A view is a list of items about its own origin, the model's (0, 0), in mm of the paper at the view's scale; whoever
composes a sheet moves it to its place. z is to the right and x upwards; seen from the left y is to the right.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.outline import Point
from fluxbore.geometry.part import Body, Part
from fluxbore.geometry.section import Rim, face, rims_beside, seen_behind
from fluxbore.geometry.sheet import Circle, Ellipse, Hatch, Item, Place, Stroke

MM = 1e3
"""Millimetres in a metre."""

NARROW = 4.0
"""mm² of the paper; smaller sections are filled, not hatched."""

SPACING = 2.2
"""mm between a hatch's lines, of the closest one."""

OVERHANG = 4.0
"""mm of a centre line beyond what it is the middle of."""


def on_paper(points: Iterable[Sequence[float]], scale: float) -> tuple[Place, ...]:
    """Points (m) about the view's origin."""
    return tuple((z * MM * scale, y * MM * scale) for z, y in points)


def is_bar(part: Body) -> bool:
    """Whether the part is solid all along its axis, which ISO 128-3 leaves unhatched."""
    if not isinstance(part, Part) or part.holes or part.axial_holes:
        return False
    heights = [z for _, z in part.profile]
    on_axis = [z for r, z in part.profile if r == 0]
    return on_axis.count(min(heights)) == on_axis.count(max(heights)) == 1 and len(on_axis) == 2


@dataclass(frozen=True, slots=True)
class Section:
    """What the plane through the axis shows of some parts (m), found once for all scales.

    faces : of each part. behind : edges. rims : drillings beside the plane.
    """

    parts: tuple[Body, ...]
    faces: tuple[Any, ...]
    behind: tuple[tuple[Point, ...], ...]
    rims: tuple[Rim, ...]


def section_of(assembly: Assembly) -> Section:
    """Look at an assembly."""
    faces = tuple(face(part) for part in assembly.parts)
    return Section(assembly.parts, faces, tuple(seen_behind(assembly)), tuple(rims_beside(assembly)))


def section_view(section: Section, scale: float) -> list[Item]:
    """All parts cut, with hatches and edges; neighbours' hatches lean to opposite sides."""
    items: list[Item] = []
    for number, (part, found) in enumerate(zip(section.parts, section.faces, strict=True)):
        for polygon in polygons(found):
            items += cut(part, number, polygon, scale)
    for line in section.behind:
        items.append(Stroke("EDGES", on_paper(line, scale)))
    for rim in section.rims:
        (centre,) = on_paper([rim.centre], scale)
        items.append(Ellipse("HIDDEN", centre, rim.along * MM * scale, rim.across * MM * scale))
    low, high = heights_of(section.parts)
    start, end = low * MM * scale - OVERHANG, high * MM * scale + OVERHANG
    return [*items, Stroke("CENTRE", ((start, 0.0), (end, 0.0)))]


def cut(part: Body, number: int, polygon: Any, scale: float) -> list[Item]:
    """The outline of a cut face (m) and its hatch; of a solid bar instead the edges around it."""
    rings = [polygon.exterior, *polygon.interiors]
    outlines = tuple(on_paper(ring.coords[:-1], scale) for ring in rings)
    strokes: list[Item] = [Stroke("OUTLINE", ring, closed=True) for ring in outlines]
    if is_bar(part):
        return strokes + [Stroke("EDGES", on_paper(line, scale)) for line in _steps(part)]
    return [_hatch(part, number, outlines, polygon.area * (MM * scale) ** 2), *strokes]


def _hatch(part: Body, number: int, outlines: tuple[tuple[Place, ...], ...], area: float) -> Hatch:
    if area < NARROW:
        return Hatch(outlines, 0.0)
    lean = (number + (part.group == "mover")) % 2  # what slides differs from what it slides in, as a rule
    return Hatch(outlines, SPACING * (1 + 0.2 * (number % 3)), 45.0 + 90 * lean)


def _steps(part: Body) -> list[tuple[Point, Point]]:
    """The circles around a bar, seen from aside, at every corner of its outline but its ends, which are drawn."""
    low, high = heights_of((part,))
    radii: dict[float, float] = {}
    for r, z in part.profile:
        if low < z < high:
            radii[z] = max(r, radii.get(z, 0.0))
    return [((z, -r), (z, r)) for z, r in radii.items()]


def polygons(shape: Any) -> list[Any]:
    """The polygons in a shape of shapely's."""
    found = getattr(shape, "geoms", (shape,))
    return [piece for piece in found if piece.geom_type == "Polygon" and not piece.is_empty]


def left_view(part: Part, scale: float) -> list[Item]:
    """What somebody sees who looks along the axis from its lower end; drillings across it are hidden."""
    radii = sorted({r for r, _ in part.profile if r > 0})
    facing = _visible_from_below(part)
    items: list[Item] = [
        Circle("OUTLINE" if r in facing else "HIDDEN", (0.0, 0.0), r * MM * scale)
        for r in radii
        if r in facing or len(radii) < 12
    ]
    reach = max(radii) * MM * scale + OVERHANG
    items += [Stroke("CENTRE", ((-reach, 0.0), (reach, 0.0))), Stroke("CENTRE", ((0.0, -reach), (0.0, reach)))]
    for radius in sorted({hole.radius for hole in part.axial_holes}):
        items.append(Circle("CENTRE", (0.0, 0.0), radius * MM * scale))
    low = min(z for _, z in part.profile)
    for beside in part.axial_holes:
        x, y = math.sin(beside.angle) * beside.radius * MM * scale, math.cos(beside.angle) * beside.radius * MM * scale
        layer = "OUTLINE" if beside.start <= low + 1e-9 else "HIDDEN"
        items.append(Circle(layer, (x, y), beside.diameter / 2 * MM * scale))
    for hole in part.holes:
        outside = max(r for r, _ in part.profile)
        for side in (-1, 1):
            line = [(radius, side * hole.diameter / 2) for radius in (hole.bottom, outside)]
            items.append(Stroke("HIDDEN", tuple(_turned(point, hole.angle, scale) for point in line)))
    return items


def _turned(point: Point, angle: float, scale: float) -> Place:
    """A point at a distance along a direction and aside of it (m), seen from the left: x is upwards, y to the right."""
    along, aside = (value * MM * scale for value in point)
    return (
        along * math.sin(angle) + aside * math.cos(angle),
        along * math.cos(angle) - aside * math.sin(angle),
    )


def _visible_from_below(part: Part) -> set[float]:
    """Radii of the circles that nothing nearer hides: from the lower end up, each corner counts once it is the
    outermost or the innermost so far, and steps of a bore that get narrower farther up."""
    corners = sorted(part.profile, key=lambda point: point[1])
    outermost = max(r for r, _ in corners)
    faces = [r for r, z in corners if z - corners[0][1] < 1e-9]
    low, high = min(faces), max(faces)
    seen = {r for r in (low, high) if r > 0}
    for r, _ in corners:
        if r > high:
            high = r
            seen.add(r)
        elif 0 < r < low:
            low = r
            seen.add(r)
    return seen | {outermost}


def heights_of(parts: Sequence[Body]) -> tuple[float, float]:
    """Lowest and highest z (m)."""
    heights = [z for part in parts for _, z in part.profile]
    return min(heights), max(heights)
