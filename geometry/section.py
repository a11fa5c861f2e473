"""The longitudinal section of an assembly: what the plane through the axis cuts, and the edges seen behind it.

The plane holds the axis z and the direction x, and is drawn with z to the right and y' = x upwards. Behind the plane
nothing is seen but through what it leaves open: looking into a gap at the distance |y'| from the axis one meets the
first surface farther out, so that an edge shows where the outer border of a gap jumps or bends along z. Lengths in m.
"""

from __future__ import annotations

import math
from itertools import pairwise, product
from typing import TYPE_CHECKING, Any, NamedTuple

from fluxbore.geometry import unrolled
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.outline import Point
from fluxbore.geometry.part import Body, Hole, Part

if TYPE_CHECKING:
    import shapely

NEAR = 1e-7
"""m beside a step at which the two sides of it are looked at."""

LEAST = 1e-5
"""m; shorter edges are not drawn."""

BEND = 0.3
"""rad between two straight lines of an outline that makes an edge; less is an arc in chords."""

IN_PLANE = 1e-9
"""Sine of the angle between a drilling and the plane."""

STEPS = 24
"""Chords of a drilling's rim."""

Line = tuple[Point, ...]
"""Points (z, y') of an open line (m)."""


class Gap(NamedTuple):
    """Radii between which there is nothing at a height (m), and the outer border's angle to the axis (rad)."""

    inner: float
    outer: float
    angle: float


class Rim(NamedTuple):
    """A drilling out of the plane, as an ellipse about (z, y') with half axes along z and across (m)."""

    centre: Point
    along: float
    across: float


def face(part: Body) -> shapely.Geometry:
    """What the plane cuts out of a part: polygons in (z, y') (m), both halves, with its drillings left open."""
    import shapely

    return shapely.union_all([*_half(part, 0.0), *_half(part, math.pi)])


def _half(part: Body, angle: float) -> list[Any]:
    """The polygons of the half plane at an angle (0 or pi)."""
    import shapely

    side = 1 if angle == 0 else -1
    if isinstance(part, HelicalPart):
        low, high = sorted((side * part.inner_radius, side * part.outer_radius))
        return [shapely.box(start, low, end, high) for start, end in unrolled.spans(part.outline, angle)]
    whole = shapely.Polygon([(z, side * r) for r, z in part.profile])
    beyond = 2 * max(r for r, _ in part.profile)
    for hole in part.holes:
        if _in_plane(hole) and (math.cos(hole.angle) > 0) == (side > 0):
            low, high = sorted((side * hole.bottom, side * beyond))
            whole = whole.difference(shapely.box(hole.z - hole.diameter / 2, low, hole.z + hole.diameter / 2, high))
    for beside in part.axial_holes:
        if abs(math.sin(beside.angle)) < IN_PLANE and (math.cos(beside.angle) > 0) == (side > 0):
            inner, outer = beside.radius - beside.diameter / 2, beside.radius + beside.diameter / 2
            low, high = sorted((side * inner, side * outer))
            whole = whole.difference(shapely.box(beside.start, low, beside.end, high))
    return [whole]


def seen_behind(assembly: Assembly) -> list[Line]:
    """The edges of revolution that show behind the plane, and the rims of drillings in it."""
    turned = [part for part in assembly.parts if isinstance(part, Part)]
    lines: list[Line] = []
    stations: list[float] = []
    for z in sorted({z for part in assembly.parts for _, z in part.profile}):
        if not stations or z - stations[-1] > 4 * NEAR:
            stations.append(z)
    for z in stations:
        for below, above in product(_gaps(assembly, z - NEAR), _gaps(assembly, z + NEAR)):
            low, high = max(below.inner, above.inner), min(below.outer, above.outer)
            differ = abs(below.outer - above.outer) > LEAST or abs(below.angle - above.angle) > BEND
            if differ and high - low > LEAST:
                lines += [((z, -high), (z, high))] if low == 0 else [((z, s * low), (z, s * high)) for s in (1, -1)]
    for part in turned:
        for hole in part.holes:
            if _in_plane(hole):
                lines += _rims(part, hole)
    return lines


def rims_beside(assembly: Assembly) -> list[Rim]:
    """The drillings that the plane does not pass, seen along it."""
    return [
        Rim(
            (hole.z, max(crossing[1] for crossing in _crossings(part, hole.z)) * math.cos(hole.angle)),
            hole.diameter / 2,
            hole.diameter / 2 * abs(math.sin(hole.angle)),
        )
        for part in assembly.parts
        if isinstance(part, Part)
        for hole in part.holes
        if not _in_plane(hole)
    ]


def _in_plane(hole: Hole) -> bool:
    return abs(math.sin(hole.angle)) < IN_PLANE


def _rims(part: Part, hole: Hole) -> list[Line]:
    """Where the far half of a drilling in the plane meets the surfaces that it passes: y'^2 = r^2 - x^2, with
    x^2 = R^2 - (z - z_0)^2 the depth behind the plane."""
    radius, side = hole.diameter / 2, 1 if math.cos(hole.angle) > 0 else -1
    wider = [
        other.bottom
        for other in part.holes
        if other.diameter > hole.diameter and (other.z, other.angle) == (hole.z, hole.angle)
    ]
    top = min(wider, default=math.inf)
    places = [hole.z - radius * math.cos(math.pi * step / STEPS) for step in range(STEPS + 1)]
    rows: list[list[Point]] = []
    for z in places:
        depth = max(radius**2 - (z - hole.z) ** 2, 0.0)
        radii = [r for _, r, _ in _crossings(part, z) if hole.bottom < r < top and r * r > depth]
        for number, r in enumerate(radii):
            while len(rows) <= number:
                rows.append([])
            rows[number].append((z, side * math.sqrt(r * r - depth)))
    return [tuple(row) for row in rows if len(row) == len(places)]


def _gaps(assembly: Assembly, z: float) -> list[Gap]:
    """What the parts leave open at a height, from the axis outwards; not the open air around them."""
    found: list[Gap] = []
    reached = 0.0
    spans = []
    for part in assembly.parts:
        crossings = _crossings(part, z)
        spans += [(inner[1], outer[1], inner[2]) for inner, outer in zip(crossings[::2], crossings[1::2], strict=True)]
    for inner, outer, angle in sorted(spans):
        if inner - reached > LEAST / 10:
            found.append(Gap(reached, inner, angle))
        reached = max(reached, outer)
    return found


def _crossings(part: Body, z: float) -> list[tuple[int, float, float]]:
    """Where a part's outline passes a height, from the axis outwards: (way, r, angle to the axis, rad)."""
    found = []
    for (r0, z0), (r1, z1) in pairwise((*part.profile, part.profile[0])):
        if min(z0, z1) < z < max(z0, z1):
            slope = (r1 - r0) / (z1 - z0)
            found.append((1 if z1 > z0 else -1, r0 + slope * (z - z0), math.atan(slope)))
    return sorted(found, key=lambda crossing: (crossing[1], crossing[0]))
