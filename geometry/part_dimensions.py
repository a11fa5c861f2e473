"""What a turned part must be dimensioned by: every diameter and every length of its outline once, chamfers, drillings.

Lengths are told from one datum, the part's lower end. A chamfer at 45 degrees between a face and a cylinder is told by
its size alone; diameter and length of its own corners follow from it. All in metres and radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from string import ascii_uppercase

from fluxbore.design.iso286 import limits
from fluxbore.geometry.outline import Point, Profile, at, edges
from fluxbore.geometry.part import AxialHole, Fit, Hole, Part

ALIKE = 1e-9
"""m; nearer coordinates are one."""

LARGEST_CHAMFER = 3e-3
"""m; a larger cone is told by its ends."""


@dataclass(frozen=True, slots=True)
class Level:
    """A face or corner at a height z, seen at a radius r; inner : from within the part only."""

    z: float
    r: float
    inner: bool


@dataclass(frozen=True, slots=True)
class Diameter:
    """A cylinder, or a corner of a cone, of this radius from z = low to high."""

    r: float
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Chamfer:
    """The first of `count` chamfers of one size, between a corner on a cylinder and one on a face."""

    size: float
    cylinder: Point
    face: Point
    count: int = 1


@dataclass(frozen=True, slots=True)
class HoleGroup:
    """Drillings that differ by their angle alone, under one letter.

    bore : radius (m) of the part's own where they are across. through : whether those along the axis leave the part at
    both ends; else face is where they begin, in words.
    """

    letter: str
    holes: tuple[Hole | AxialHole, ...]
    bore: float = 0.0
    through: bool = False
    face: str = ""

    @property
    def first(self) -> Hole | AxialHole:
        return self.holes[0]

    @property
    def angles(self) -> str:
        """Degrees from +x, evenly spaced ones in short."""
        found = sorted(math.degrees(hole.angle) % 360 for hole in self.holes)
        if len(found) < 3:
            return ", ".join(f"{angle:.4g}°" for angle in found)
        steps = [(b - a) % 360 for a, b in zip(found, found[1:] + found[:1], strict=True)]
        if max(steps) - min(steps) < 1e-6:
            return f"every {steps[0]:.4g}° from {found[0]:.4g}°"
        return ", ".join(f"{angle:.4g}°" for angle in found)


def levels(part: Part) -> list[Level]:
    """Heights above the part's lower end that must be told, from below."""
    profile = part.profile
    low = min(z for _, z in profile)
    told = [point for point in profile if not _on_cylinder(profile, point)]
    found: list[Level] = []
    for z in distinct(z for _, z in told):
        if z - low < ALIKE:
            continue
        here = [point for point in profile if abs(point[1] - z) < ALIKE]
        outside = [r for r, _ in here if r > _outermost(profile, z) - 100 * ALIKE]
        found.append(Level(z, max(outside) if outside else max(r for r, _ in here), not outside))
    return found


def diameters(part: Part) -> list[Diameter]:
    """Of every cylinder and cone's end that must be told, the smallest first."""
    profile = part.profile
    told = [point for point in profile if point[0] > 0 and not _on_face(profile, point)]
    found: list[Diameter] = []
    for r in distinct(r for r, _ in told):
        walls = [sorted((a[1], b[1])) for a, b in edges(profile) if abs(a[0] - r) < ALIKE > abs(b[0] - r)] or [
            [z, z] for radius, z in told if abs(radius - r) < ALIKE
        ]
        low, high = max(walls, key=lambda wall: wall[1] - wall[0])
        found.append(Diameter(r, low, high))
    return found


def chamfers(part: Part) -> list[Chamfer]:
    """One of each size, with their number."""
    sizes: dict[int, list[tuple[Point, Point]]] = {}
    for cylinder, face in _chamfered(part.profile):
        sizes.setdefault(round(abs(cylinder[1] - face[1]) / ALIKE), []).append((cylinder, face))
    return [
        Chamfer(abs(pairs[0][0][1] - pairs[0][1][1]), *max(pairs, key=lambda pair: pair[0][0]), len(pairs))
        for pairs in sizes.values()
    ]


def hole_groups(part: Part) -> list[HoleGroup]:
    """Alike drillings under letters: across the axis first, in the order of the part."""
    groups: dict[tuple[float | str | int, ...], list[Hole | AxialHole]] = {}

    def nm(*lengths: float) -> tuple[int, ...]:
        return tuple(round(length / ALIKE) for length in lengths)

    for hole in part.holes:
        groups.setdefault(("across", *nm(hole.z, hole.diameter, hole.bottom), hole.thread), []).append(hole)
    for beside in part.axial_holes:
        key = nm(beside.radius, beside.diameter, beside.start, beside.end)
        groups.setdefault(("along", *key, beside.thread), []).append(beside)
    return [_group(part.profile, _letter(number), holes) for number, holes in enumerate(groups.values())]


def _group(profile: Profile, letter: str, holes: list[Hole | AxialHole]) -> HoleGroup:
    first = holes[0]
    if isinstance(first, Hole):
        return HoleGroup(letter, tuple(holes), _bore(profile, first))
    low, high = (any(abs(z - end) < ALIKE for _, z in profile) for end in (first.start, first.end))
    face = "" if low == high else (", from the left" if low else ", from the right")
    return HoleGroup(letter, tuple(holes), through=low and high, face=face)


def fit_text(fit: Fit) -> str:
    """ "H8 (+0.027/0)", in mm. Raises DesignError for a class that ISO 286 does not have."""
    lower, upper = (_signed(value * 1e3) for value in limits(fit.nominal, fit.tolerance))
    return f"{fit.tolerance} ({upper}/{lower})"


def fit_of(part: Part, size: float) -> Fit | None:
    """The tolerance of a size (m), where it has one."""
    return next((fit for fit in part.fits if abs(fit.nominal - size) < ALIKE), None)


def distinct(values: Iterable[float]) -> list[float]:
    """In order, those nearer than `ALIKE` once."""
    found: list[float] = []
    for value in sorted(values):
        if not found or value - found[-1] > ALIKE:
            found.append(value)
    return found


def _signed(value: float) -> str:
    text = f"{value:+.4f}".rstrip("0").rstrip(".")
    return "0" if text in ("+0", "-0") else text


def _letter(number: int) -> str:
    """A, B, ..., Z, AA, AB, ..."""
    head, tail = divmod(number, len(ascii_uppercase))
    return (ascii_uppercase[head - 1] if head else "") + ascii_uppercase[tail]


def _chamfered(profile: Profile) -> list[tuple[Point, Point]]:
    """(corner on the cylinder, corner on the face) of every chamfer."""
    count, found = len(profile), []
    for i in range(count):
        before, a, b, after = (profile[(i + step) % count] for step in (-1, 0, 1, 2))
        size = abs(a[1] - b[1])
        if abs(abs(a[0] - b[0]) - size) > ALIKE or not ALIKE < size <= LARGEST_CHAMFER:
            continue
        if _along(before, a) and _across(b, after):
            found.append((a, b))
        elif _across(before, a) and _along(b, after):
            found.append((b, a))
    return found


def _along(a: Point, b: Point) -> bool:
    return abs(a[0] - b[0]) < ALIKE and a[0] > ALIKE


def _across(a: Point, b: Point) -> bool:
    return abs(a[1] - b[1]) < ALIKE


def _on_cylinder(profile: Profile, point: Point) -> bool:
    """Whether it is a chamfer's corner on a cylinder: its height follows from the face."""
    return any(point == cylinder for cylinder, _ in _chamfered(profile))


def _on_face(profile: Profile, point: Point) -> bool:
    """Whether it is a chamfer's corner on a face: its radius follows from the cylinder."""
    return any(point == face for _, face in _chamfered(profile))


def _outermost(profile: Profile, z: float) -> float:
    """The least of the outer radii just below and just above a height, which is seen from outside there; of an end the
    radius on the side where there is something."""
    reach: list[float] = []
    for beside in (z - 10 * ALIKE, z + 10 * ALIKE):
        radii = [at(edge, beside) for edge in edges(profile) if _spans(edge, beside)]
        if radii:
            reach.append(max(radii))
    return min(reach)


def _spans(edge: tuple[Point, Point], z: float) -> bool:
    return min(edge[0][1], edge[1][1]) < z < max(edge[0][1], edge[1][1])


def _bore(profile: Profile, hole: Hole) -> float:
    """Radius of the bore at a drilling across the axis (m); 0 where the part is solid there."""
    radii = [at(edge, hole.z + 1e-7) for edge in edges(profile) if _spans(edge, hole.z + 1e-7)]
    return min(radii, default=0.0)
