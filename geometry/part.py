"""Parts: solids of revolution with drillings, as a workshop sees them: fits, threads, and whether they are bought.

Volumes and centres are arithmetic on the profile, closed or by quadrature; what follows a helix is a `HelicalPart`.
Lengths are in metres, angles in radians.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fluxbore.design.errors import DesignError
from fluxbore.geometry import helical_part
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.outline import Profile, at, crossed, is_simple, overlap, rectangle, turned

Colour = tuple[float, float, float]
"""Red, green and blue, sRGB, 0 to 1."""

_NODES, _WEIGHTS = (column.tolist() for column in np.polynomial.legendre.leggauss(24))


@dataclass(frozen=True, slots=True)
class Hole:
    """A radial drilling from the part's outside towards the axis, with a flat bottom.

    z : its axis (m). diameter (m). angle : about z, from +x towards +y (rad).
    bottom : distance of the flat bottom from the axis of the part (m); 0 drills just to the axis.
    thread : cut into it, as drawings write it ("M5 x 6"); it is drawn with `diameter`, its core's.
    """

    z: float
    diameter: float
    angle: float = 0.0
    bottom: float = 0.0
    thread: str = ""


@dataclass(frozen=True, slots=True)
class AxialHole:
    """A drilling along z beside the axis, all of it within the part's material, clear of every radial one.

    radius : of the pitch circle on which it lies (m). angle : about z, from +x towards +y (rad). diameter (m).
    start, end : between which heights it takes material away (m), flat at both. thread : as in `Hole`.
    """

    radius: float
    diameter: float
    start: float
    end: float
    angle: float = 0.0
    thread: str = ""


@dataclass(frozen=True, slots=True)
class AxisThread:
    """A thread about the part's axis, on the cylinder of the profile that has this diameter (m).

    thread : as in `Hole`.
    """

    diameter: float
    thread: str


@dataclass(frozen=True, slots=True)
class Fit:
    """A toleranced size: what it is ("bore"), its nominal (m) and its tolerance class of ISO 286-2 ("H8", "f7")."""

    feature: str
    nominal: float
    tolerance: str


@dataclass(frozen=True, slots=True)
class Part:
    """A solid of revolution about z with drillings across and along it, which must not run into one another; radial
    ones on one axis may, as a thread above a narrower bore.

    group : "stator" or "mover". role : what it is, the same word for all alike ("coil").
    profile : counter-clockwise, r >= 0 (m). note : what a name does not say, such as the direction of magnetisation.
    material : its name; none ("") where only the envelope is known. fill : share of the volume that is the material; a
    coil is drawn as its whole window. fits : its toleranced sizes. bought : what to order ("DIN 471 - 8 x 0.8");
    what is made has none. axis_threads : what is cut on cylinders of the profile itself.
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
    axial_holes: tuple[AxialHole, ...] = ()
    fits: tuple[Fit, ...] = ()
    bought: str = ""
    axis_threads: tuple[AxisThread, ...] = ()

    def __post_init__(self) -> None:
        if not is_simple(self.profile):
            raise DesignError(f"The outline of the {self.name} must enclose one area without crossing itself.")
        for hole in self.axial_holes:
            if not _holds(self.profile, hole):
                raise DesignError(
                    f"A hole of {hole.diameter * 1e3:.6g} mm along the axis of the {self.name} must lie in its "
                    f"material; at {hole.radius * 1e3:.6g} mm from the axis it does not."
                )


Body = Part | HelicalPart
"""Whatever can be in an assembly; its ``profile`` is its own, or the envelope of one that follows a helix."""


def volume(part: Body) -> float:
    """Volume (m^3): Pappus on the polygon, less the quadrature of each hole; closed for what follows a helix."""
    if isinstance(part, HelicalPart):
        return helical_part.volume(part)
    drilled = sum(_taken(part, hole)[0] for hole in part.holes)
    return turned(part.profile)[0] - drilled - sum(_axial_volume(hole) for hole in part.axial_holes)


def mass(part: Body, density: float) -> float:
    """Mass (kg) of the part's material at this density (kg/m^3)."""
    return density * part.fill * volume(part)


def centre_of_mass(part: Body) -> tuple[float, float, float]:
    """(x, y, z) of a homogeneous part (m)."""
    if isinstance(part, HelicalPart):
        return helical_part.centre_of_mass(part)
    whole, along = turned(part.profile)
    across = [0.0, 0.0]
    for hole in part.holes:
        gone, radial, axial = _taken(part, hole)
        whole -= gone
        along -= axial
        across[0] -= radial * math.cos(hole.angle)
        across[1] -= radial * math.sin(hole.angle)
    for beside in part.axial_holes:
        gone = _axial_volume(beside)
        whole -= gone
        along -= gone * (beside.start + beside.end) / 2
        across[0] -= gone * beside.radius * math.cos(beside.angle)
        across[1] -= gone * beside.radius * math.sin(beside.angle)
    return across[0] / whole, across[1] / whole, along / whole


def _taken(part: Part, hole: Hole) -> tuple[float, float, float]:
    """What `_drilled` gives, less what a wider drilling on the same axis takes away already."""
    gone = _drilled(part.profile, hole.z, hole.diameter, hole.bottom)
    wider = [
        other.bottom
        for other in part.holes
        if other.diameter > hole.diameter and (other.z, other.angle) == (hole.z, hole.angle)
    ]
    if not wider:
        return gone
    shared = _drilled(part.profile, hole.z, hole.diameter, max(min(wider), hole.bottom))
    return gone[0] - shared[0], gone[1] - shared[1], gone[2] - shared[2]


def _axial_volume(hole: AxialHole) -> float:
    """m^3."""
    return math.pi * hole.diameter**2 / 4 * (hole.end - hole.start)


def _holds(profile: Profile, hole: AxialHole) -> bool:
    """Whether all of the hole lies within the turned outline: the ring that it sweeps does."""
    inner, outer = hole.radius - hole.diameter / 2, hole.radius + hole.diameter / 2
    if not (0 < inner < outer and hole.start < hole.end):
        return False
    return _holds_ring(profile, rectangle(inner, outer, hole.start, hole.end))


@lru_cache(maxsize=256)  # holes on one pitch circle share it
def _holds_ring(profile: Profile, ring: Profile) -> bool:
    whole = turned(ring)[0]
    return abs(overlap(profile, ring) - whole) <= 1e-9 * whole


@lru_cache(maxsize=256)  # holes around a part differ by their angle alone
def _drilled(profile: Profile, centre: float, diameter: float, bottom: float) -> tuple[float, float, float]:
    """What a hole about z = `centre` takes away: ∫ dV, ∫ x dV along its axis and ∫ z dV (m^3, m^4, m^4).

    Across the hole (y, from -h to h) the integrals of the chord are closed; along z, Gauss-Legendre runs between the
    heights at which the profile has a vertex, in an angle that takes away the square root at the hole's rim.
    """
    radius = diameter / 2
    above = [edge for edge in crossed(profile, centre) if max(edge[0][0], edge[1][0]) > bottom]
    if all(a[0] == b[0] for a, b in above) and not any(r > bottom and abs(z - centre) < radius for r, z in profile):
        # Cylinders alone; what there is below the bottom, material or not, stays as it is.
        radii = [0.0] * (len(above) % 2) + [a[0] for a, _ in above]
        solids = [_from_cylinder(r, radius, bottom) for r in radii]
        whole, radial = (sum(one[i] for one in solids[1::2]) - sum(one[i] for one in solids[::2]) for i in (0, 1))
        return whole, radial, whole * centre
    # Halves as well: the profile need not be symmetric, and shorter stretches cost little.
    inside = {math.asin((z - centre) / radius) for _, z in profile if abs(z - centre) < radius}
    stations = sorted({-math.pi / 2, 0.0, math.pi / 2, *inside})
    whole = radial = axial = 0.0
    for low, high in itertools.pairwise(stations):
        # No vertex lies between two stations, so that the same edges are crossed all the way.
        passed = crossed(profile, centre + radius * math.sin((low + high) / 2))
        for node, weight in zip(_NODES, _WEIGHTS, strict=True):
            angle = (low + high) / 2 + node * (high - low) / 2
            half, z = radius * math.cos(angle), centre + radius * math.sin(angle)
            step = weight * (high - low) / 2 * half  # dz = radius cos(angle) d(angle)
            for count, edge in enumerate(passed):
                sign = 1 if count % 2 else -1
                chord, moment = _chord(at(edge, z), half, bottom)
                whole += sign * step * chord
                radial += sign * step * moment
                axial += sign * step * chord * z
    return whole, radial, axial


@lru_cache(maxsize=1024)  # few designs of a search move the radii at a hole
def _from_cylinder(r: float, radius: float, bottom: float) -> tuple[float, float]:
    """The first two integrals of `_drilled` for a hole into a solid cylinder; one half is the other's mirror image."""
    whole = radial = 0.0
    for node, weight in zip(_NODES, _WEIGHTS, strict=True):
        half = radius * math.cos((1 + node) * math.pi / 4)
        chord, moment = _chord(r, half, bottom)
        whole += weight * math.pi / 2 * half * chord
        radial += weight * math.pi / 2 * half * moment
    return whole, radial


def _chord(r: float, half: float, bottom: float) -> tuple[float, float]:
    """∫ x dy and ∫ x²/2 dy over |y| < half, where x is the circle of radius r or, if farther out, the bottom."""
    reach = min(half, math.sqrt(max(r * r - bottom * bottom, 0.0)))
    circle = reach * math.sqrt(max(r * r - reach * reach, 0.0)) + r * r * math.asin(min(reach / r, 1.0)) if r else 0.0
    rest = half - reach
    return circle + 2 * rest * bottom, r * r * reach - reach**3 / 3 + rest * bottom**2
