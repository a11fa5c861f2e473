"""An actuator as a list of parts: turned profiles with radial cross-holes, their volumes, clearances and overlaps.

Everything here is arithmetic on polygons in the (r, z) half plane, so that masses and clearances need no CAD kernel and
can check one; what follows a helix is a `HelicalPart`, whose polygons lie in (θ, z). Lengths are in metres, angles in
radians.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fluxbore.design.errors import DesignError
from fluxbore.geometry import helical_part
from fluxbore.geometry.helical_clearance import overlap as helical_overlap
from fluxbore.geometry.helical_part import RESOLUTION, HelicalPart
from fluxbore.geometry.measure import Detail, Measure

Point = tuple[float, float]
"""(r, z) in metres."""

Profile = tuple[Point, ...]
"""A closed polygon, its last vertex joined to its first."""

Edge = tuple[Point, Point]

Colour = tuple[float, float, float]
"""Red, green and blue, sRGB, 0 to 1."""

_NODES, _WEIGHTS = (column.tolist() for column in np.polynomial.legendre.leggauss(24))


@dataclass(frozen=True, slots=True)
class Hole:
    """A radial drilling from the part's outside towards the axis, with a flat bottom.

    z : its axis (m). diameter (m). angle : about z, from +x towards +y (rad).
    bottom : distance of the flat bottom from the axis of the part (m); 0 drills just to the axis.
    """

    z: float
    diameter: float
    angle: float = 0.0
    bottom: float = 0.0


@dataclass(frozen=True, slots=True)
class Part:
    """A solid of revolution about z with cross-holes, which must not run into one another.

    group : "stator" or "mover". role : what it is, the same word for all alike ("coil").
    profile : counter-clockwise, r >= 0 (m). note : what a name does not say, such as the direction of magnetisation.
    material : its name; none ("") where only the envelope is known. fill : share of the volume that is the material; a
    coil is drawn as its whole window.
    """

    name: str
    role: str
    group: str
    material: str
    colour: Colour
    profile: Profile
    holes: tuple[Hole, ...] = ()
    note: str = ""
    fill: float = 1.0

    def __post_init__(self) -> None:
        if not is_simple(self.profile):
            raise DesignError(f"The outline of the {self.name} must enclose one area without crossing itself.")


Body = Part | HelicalPart
"""Whatever can be in an assembly; its ``profile`` is its own, or the envelope of one that follows a helix."""


@dataclass(frozen=True, slots=True)
class Assembly:
    """Parts where they stand at one position of the mover (m).

    squeezes : pairs of part names that are drawn overlapping on purpose, because one of them yields.
    outside : the group that pictures cut open. carried_mass : kg, of what moves with the mover and is not drawn.
    measures : what a drawing is dimensioned by; none stands for the sizes of every kind of part. details : what it
    shows again, larger.
    """

    name: str
    parts: tuple[Body, ...]
    position: float
    squeezes: tuple[tuple[str, str], ...] = ()
    outside: str = "stator"
    carried_mass: float = 0.0
    measures: tuple[Measure, ...] = ()
    details: tuple[Detail, ...] = ()

    def part(self, name: str) -> Body:
        return next(part for part in self.parts if part.name == name)


@dataclass(frozen=True, slots=True)
class Interference:
    """Two parts that share a volume (m^3); ``designed`` where the assembly says that one of them yields."""

    first: str
    second: str
    volume: float
    designed: bool


def rectangle(inner_radius: float, outer_radius: float, start: float, end: float) -> Profile:
    """The profile of a ring or, with inner radius 0, of a rod (m)."""
    return (inner_radius, start), (outer_radius, start), (outer_radius, end), (inner_radius, end)


def volume(part: Body) -> float:
    """Volume (m^3): Pappus on the polygon, less the quadrature of each hole; closed for what follows a helix."""
    if isinstance(part, HelicalPart):
        return helical_part.volume(part)
    return _turned(part.profile)[0] - sum(_drilled(part.profile, hole)[0] for hole in part.holes)


def mass(part: Body, density: float) -> float:
    """Mass (kg) of the part's material at this density (kg/m^3)."""
    return density * part.fill * volume(part)


def centre_of_mass(part: Body) -> tuple[float, float, float]:
    """(x, y, z) of a homogeneous part (m)."""
    if isinstance(part, HelicalPart):
        return helical_part.centre_of_mass(part)
    whole, along = _turned(part.profile)
    across = [0.0, 0.0]
    for hole in part.holes:
        gone, radial, axial = _drilled(part.profile, hole)
        whole -= gone
        along -= axial
        across[0] -= radial * math.cos(hole.angle)
        across[1] -= radial * math.sin(hole.angle)
    return across[0] / whole, across[1] / whole, along / whole


def _edges(profile: Profile) -> Iterator[Edge]:
    return itertools.pairwise((*profile, profile[0]))


def _turned(profile: Profile) -> tuple[float, float]:
    """∫ dV = π ∮ r² dz and ∫ z dV = π ∮ r² z dz (m^3, m^4); Simpson's rule is exact for both along an edge."""
    whole = along = 0.0
    for (r0, z0), (r1, z1) in _edges(profile):
        r, z, dz = (r0 + r1) / 2, (z0 + z1) / 2, z1 - z0
        whole += dz * (r0 * r0 + 4 * r * r + r1 * r1) / 6
        along += dz * (r0 * r0 * z0 + 4 * r * r * z + r1 * r1 * z1) / 6
    return math.pi * whole, math.pi * along


@lru_cache(maxsize=256)
def _drilled(profile: Profile, hole: Hole) -> tuple[float, float, float]:
    """What a hole takes away: ∫ dV, ∫ x dV along the hole's axis and ∫ z dV (m^3, m^4, m^4).

    Across the hole (y, from -h to h) the integrals of the chord are closed; along z, Gauss-Legendre runs between the
    heights at which the profile has a vertex, in an angle that takes away the square root at the hole's rim.
    """
    radius = hole.diameter / 2
    inside = {math.asin((z - hole.z) / radius) for _, z in profile if abs(z - hole.z) < radius}
    # Halves as well: the profile need not be symmetric, and shorter stretches cost little.
    stations = sorted({-math.pi / 2, 0.0, math.pi / 2, *inside})
    whole = radial = axial = 0.0
    for low, high in itertools.pairwise(stations):
        # No vertex lies between two stations, so that the same edges are crossed all the way.
        crossed = _crossed(profile, hole.z + radius * math.sin((low + high) / 2))
        for node, weight in zip(_NODES, _WEIGHTS, strict=True):
            angle = (low + high) / 2 + node * (high - low) / 2
            half, z = radius * math.cos(angle), hole.z + radius * math.sin(angle)
            step = weight * (high - low) / 2 * half  # dz = radius cos(angle) d(angle)
            for count, edge in enumerate(crossed):
                sign = 1 if count % 2 else -1
                chord, moment = _chord(_at(edge, z), half, hole.bottom)
                whole += sign * step * chord
                radial += sign * step * moment
                axial += sign * step * chord * z
    return whole, radial, axial


def _chord(r: float, half: float, bottom: float) -> tuple[float, float]:
    """∫ x dy and ∫ x²/2 dy over |y| < half, where x is the circle of radius r or, if farther out, the bottom."""
    reach = min(half, math.sqrt(max(r * r - bottom * bottom, 0.0)))
    circle = reach * math.sqrt(max(r * r - reach * reach, 0.0)) + r * r * math.asin(min(reach / r, 1.0)) if r else 0.0
    rest = half - reach
    return circle + 2 * rest * bottom, r * r * reach - reach**3 / 3 + rest * bottom**2


def _spans(profile: Profile, z: float) -> list[tuple[Edge, Edge]]:
    """The stretches of material at height z, from the axis outwards, each between two edges."""
    crossed = _crossed(profile, z)
    return list(zip(crossed[::2], crossed[1::2], strict=True))


def _crossed(profile: Profile, z: float) -> list[Edge]:
    """The edges that pass the height z, from the axis outwards."""
    passing = [(a, b) for a, b in _edges(profile) if min(a[1], b[1]) < z < max(a[1], b[1])]
    return sorted(passing, key=lambda edge: _at(edge, z))


def _at(edge: Edge, z: float) -> float:
    """r of the straight line through an edge at height z."""
    (r0, z0), (r1, z1) = edge
    return r0 + (r1 - r0) * (z - z0) / (z1 - z0)


def overlap(first: Profile, second: Profile) -> float:
    """Volume (m^3) that two profiles share when turned, exactly.

    Cut at every vertex and every crossing, the plane falls into slabs in which no two edges cross: there the shared
    area is a row of trapezoids, whose volume of revolution Simpson's rule gives without error.
    """
    (r0, r1, z0, z1), (r2, r3, z2, z3) = _box(first), _box(second)
    low, high = max(z0, z2), min(z1, z3)
    if high - low < RESOLUTION or min(r1, r3) - max(r0, r2) < RESOLUTION:
        return 0.0
    cuts = {low, high} | {z for _, z in (*first, *second) if low < z < high}
    for a, b in itertools.product(_edges(first), _edges(second)):
        crossing = _crossing(a, b)
        if crossing is not None and low < crossing < high:
            cuts.add(crossing)
    shared = 0.0
    for bottom, top in itertools.pairwise(sorted(cuts)):
        if top - bottom < RESOLUTION:
            continue
        middle = (bottom + top) / 2
        for (a_in, a_out), (b_in, b_out) in itertools.product(_spans(first, middle), _spans(second, middle)):
            inner = a_in if _at(a_in, middle) > _at(b_in, middle) else b_in
            outer = a_out if _at(a_out, middle) < _at(b_out, middle) else b_out
            if _at(outer, middle) - _at(inner, middle) > RESOLUTION:
                squares = [_at(outer, z) ** 2 - _at(inner, z) ** 2 for z in (bottom, middle, top)]
                shared += math.pi * (top - bottom) * (squares[0] + 4 * squares[1] + squares[2]) / 6
    return shared


def interferences(assembly: Assembly) -> tuple[Interference, ...]:
    """Every pair of parts that share a volume. Cross-holes are left out of account, so that the answer errs safely.

    Beside a turned part one that follows a helix counts with its envelope; two of them are held against each other.
    """
    allowed = {frozenset(pair) for pair in assembly.squeezes}
    return tuple(
        Interference(a.name, b.name, shared, frozenset((a.name, b.name)) in allowed)
        for a, b in _near(assembly.parts)
        if (shared := _shared(a, b)) > 0
    )


def _near(parts: tuple[Body, ...]) -> Iterator[tuple[Body, Body]]:
    """The pairs whose envelopes meet, all at once for each part: of hundreds of magnets few are neighbours."""
    if not parts:
        return
    inner, outer, low, high = np.array([_box(part.profile) for part in parts]).T
    for i, part in enumerate(parts):
        later = slice(i + 1, None)
        meet = (inner[later] < outer[i]) & (outer[later] > inner[i]) & (low[later] < high[i]) & (high[later] > low[i])
        for j in np.flatnonzero(meet):
            yield part, parts[i + 1 + int(j)]


def _shared(first: Body, second: Body) -> float:
    if isinstance(first, HelicalPart) and isinstance(second, HelicalPart):
        return helical_overlap(first, second)
    return overlap(first.profile, second.profile)


def clearance(first: Body, second: Body) -> float:
    """Shortest distance between two parts (m); 0 where they touch or overlap. Cross-holes are left out of account.

    What follows a helix counts with its envelope; `fluxbore.geometry.helical_clearance` has the gaps between two.
    """
    if overlap(first.profile, second.profile) > 0:
        return 0.0
    gap = min(
        _distance(point, edge)
        for mine, theirs in ((first.profile, second.profile), (second.profile, first.profile))
        for point in mine
        for edge in _edges(theirs)
    )
    return 0.0 if gap < RESOLUTION else gap


@lru_cache(maxsize=1024)  # designs of a search share most of their parts
def is_simple(profile: Profile) -> bool:
    """Whether the polygon is counter-clockwise, on the right of the axis, and neither crosses nor touches itself."""
    if len(profile) < 3 or not all(math.isfinite(r) and math.isfinite(z) and r >= 0 for r, z in profile):
        return False
    if _is_rectangle(profile):  # most parts are rings, and there are dozens of them in each design of a search
        return True
    edges = list(_edges(profile))
    if any(math.dist(a, b) < RESOLUTION for a, b in edges) or _turned(profile)[0] <= 0:
        return False
    for i, j in itertools.combinations(range(len(edges)), 2):
        if j - i == 1 or (i == 0 and j == len(edges) - 1):
            continue
        pairs = [(point, edges[j]) for point in edges[i]] + [(point, edges[i]) for point in edges[j]]
        if _crossing(edges[i], edges[j]) is not None or any(_distance(*pair) < RESOLUTION for pair in pairs):
            return False
    return True


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


def _box(profile: Profile) -> tuple[float, float, float, float]:
    radii, heights = [r for r, _ in profile], [z for _, z in profile]
    return min(radii), max(radii), min(heights), max(heights)
