"""Mass, centre of gravity and inertia tensor of parts and of what is put together of them.

Of a body of even density ρ the tensor about its centre is ρ (tr(S) 1 − S), with the second moments S_ij = ∫ x_i x_j dV.
Those of a turned profile are closed, of a drilling closed across and by quadrature along z, of what follows a helix
closed: its outline's moments around the axis and along it are integrals along straight lines of the unrolled plane.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from fluxbore.geometry import unrolled
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.outline import Profile, at, crossed, edges
from fluxbore.geometry.part import AxialHole, Body, Hole, Part, centre_of_mass, volume

Tensor = npt.NDArray[np.float64]
"""(3, 3), along x, y and z."""

_NODES, _WEIGHTS = (column.tolist() for column in np.polynomial.legendre.leggauss(24))


@dataclass(frozen=True, slots=True, eq=False)
class Inertia:
    """mass : kg. centre : (3,) m. tensor : (3, 3) about the centre (kg m^2), products negative off its diagonal."""

    mass: float
    centre: npt.NDArray[np.float64]
    tensor: Tensor

    def about(self, point: npt.ArrayLike) -> Tensor:
        """The tensor about another point (m): Steiner's theorem (kg m^2)."""
        return self.tensor + self.mass * _turned_round(self.centre - np.asarray(point))


def inertia(part: Body, density: float) -> Inertia:
    """Of the part's material at this density (kg/m^3), spread evenly over its volume."""
    centre = np.array(centre_of_mass(part))
    whole = volume(part)
    moments = second_moments(part) - whole * np.outer(centre, centre)
    rho = density * part.fill
    return Inertia(rho * whole, centre, rho * (np.trace(moments) * np.eye(3) - moments))


def of_mass(part: Body, mass: float) -> Inertia:
    """Of a piece of this mass (kg), which may be none, spread evenly over its volume."""
    return inertia(part, mass / (part.fill * volume(part)))


def combined(bodies: Iterable[Inertia]) -> Inertia:
    """Of all of them together; without mass about the origin."""
    parts = [body for body in bodies if body.mass]
    mass = math.fsum(body.mass for body in parts)
    if not parts:
        return Inertia(0.0, np.zeros(3), np.zeros((3, 3)))
    centre = np.sum([body.mass * body.centre for body in parts], axis=0) / mass
    return Inertia(mass, centre, np.sum([body.about(centre) for body in parts], axis=0))


def second_moments(part: Body) -> Tensor:
    """S (m^5) about the origin."""
    if isinstance(part, HelicalPart):
        return _helical(part)
    found = _profile(part.profile)
    for hole in part.holes:
        found -= _around(_taken(part, hole), hole.angle)
    for beside in part.axial_holes:
        found -= _axial(beside)
    return found


def _turned_round(arm: npt.NDArray[np.float64]) -> Tensor:
    """What a unit mass at the arm's end adds (m^2)."""
    return np.asarray(arm @ arm * np.eye(3) - np.outer(arm, arm))


def _profile(profile: Profile) -> Tensor:
    """π/4 ∮ r⁴ dz across and π ∮ r² z² dz along; three points of Gauss are exact for both along an edge."""
    across = along = 0.0
    for (r0, z0), (r1, z1) in edges(profile):
        for place, weight in ((-math.sqrt(0.6), 5 / 18), (0.0, 8 / 18), (math.sqrt(0.6), 5 / 18)):
            r, z = (r0 + r1 + place * (r1 - r0)) / 2, (z0 + z1 + place * (z1 - z0)) / 2
            across += weight * (z1 - z0) * r**4 / 4
            along += weight * (z1 - z0) * r * r * z * z
    return math.pi * np.diag([across, across, along])


def _taken(part: Part, hole: Hole) -> Tensor:
    """What a hole takes away, x along it, less what a wider drilling on the same axis takes away already."""
    gone = _tensor(_drilled(part.profile, hole.z, hole.diameter, hole.bottom))
    wider = [
        other.bottom
        for other in part.holes
        if other.diameter > hole.diameter and (other.z, other.angle) == (hole.z, hole.angle)
    ]
    if not wider:
        return gone
    return gone - _tensor(_drilled(part.profile, hole.z, hole.diameter, max(min(wider), hole.bottom)))


@lru_cache(maxsize=256)  # holes around a part differ by their angle alone
def _drilled(profile: Profile, axis: float, diameter: float, bottom: float) -> tuple[float, float, float, float]:
    """xx, yy, zz and xz of a hole about z = `axis`, integrated as `fluxbore.geometry.part` does its volume."""
    radius = diameter / 2
    inside = {math.asin((z - axis) / radius) for _, z in profile if abs(z - axis) < radius}
    second = across = along = skew = 0.0
    for low, high in itertools.pairwise(sorted({-math.pi / 2, 0.0, math.pi / 2, *inside})):
        passed = crossed(profile, axis + radius * math.sin((low + high) / 2))
        for node, weight in zip(_NODES, _WEIGHTS, strict=True):
            angle = (low + high) / 2 + node * (high - low) / 2
            half, z = radius * math.cos(angle), axis + radius * math.sin(angle)
            step = weight * (high - low) / 2 * half
            for count, edge in enumerate(passed):
                area, first, cube, square = _chord(at(edge, z), half, bottom)
                sign = step if count % 2 else -step
                second += sign * cube
                across += sign * square
                along += sign * z * z * area
                skew += sign * z * first
    return second, across, along, skew


def _tensor(moments: tuple[float, float, float, float]) -> Tensor:
    xx, yy, zz, xz = moments
    return np.array([[xx, 0.0, xz], [0.0, yy, 0.0], [xz, 0.0, zz]])


def _chord(r: float, half: float, bottom: float) -> tuple[float, float, float, float]:
    """∫ x dy, ∫ x²/2 dy, ∫ x³/3 dy and ∫ x y² dy over |y| < half, x the circle of radius r, or the bottom beyond it."""
    a = min(half, math.sqrt(max(r * r - bottom * bottom, 0.0)))
    x = math.sqrt(max(r * r - a * a, 0.0))
    sector = math.asin(min(a / r, 1.0)) if r else 0.0
    rest, cubes = 2 * (half - a), 2 * (half**3 - a**3) / 3
    return (
        a * x + r * r * sector + rest * bottom,
        r * r * a - a**3 / 3 + rest * bottom**2 / 2,
        (a * x * (5 * r * r - 2 * a * a) + 3 * r**4 * sector) / 12 + rest * bottom**3 / 3,
        (a * x * (2 * a * a - r * r) + r**4 * sector) / 4 + cubes * bottom,
    )


def _axial(hole: AxialHole) -> Tensor:
    """A cylinder beside the axis: its own moments and those of its centre."""
    radius, length = hole.diameter / 2, hole.end - hole.start
    whole = math.pi * radius**2 * length
    centre = np.array([hole.radius * math.cos(hole.angle), hole.radius * math.sin(hole.angle), hole.start + length / 2])
    own = np.diag([radius**2 / 4, radius**2 / 4, length**2 / 12])
    return np.asarray(whole * (own + np.outer(centre, centre)))


def _around(moments: Tensor, angle: float) -> Tensor:
    """Turned about z (rad)."""
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(turn @ moments @ turn.T)


def _helical(part: HelicalPart) -> Tensor:
    """∫ r^n dr times the outline's moments: of cos² θ and so on across, of z cos θ, and of z²."""
    inner, outer = part.inner_radius, part.outer_radius
    plane, third, fourth = ((outer**n - inner**n) / n for n in (2, 3, 4))
    base = part.outline[0][1]
    area = unrolled.area(part.outline)
    mean_cosine, mean_sine, _ = unrolled.centre(part.outline)
    double_cosine = double_sine = cosine = sine = height = square = 0.0
    for (theta, low), (onwards, high) in unrolled.sides(part.outline):
        half, middle = (onwards - theta) / 2, (onwards + theta) / 2
        z, rise = (low + high) / 2 - base, (high - low) / 2
        share, slant = math.sin(half) / half if half else 1.0, _slant(half)
        # Green's theorem: ∬ cos 2θ = ∮ sin 2θ/2 dz, ∬ z cos θ = ∮ z sin θ dz, ∬ z² = −∮ z³/3 dθ.
        twice = math.cos(half) * share
        double_cosine += rise * math.sin(2 * middle) * twice
        double_sine -= rise * math.cos(2 * middle) * twice
        cosine += 2 * rise * (z * math.sin(middle) * share + rise * math.cos(middle) * slant)
        sine -= 2 * rise * (z * math.cos(middle) * share - rise * math.sin(middle) * slant)
        height -= half * (z * z + rise * rise / 3)
        square -= 2 * half * (z**3 + z * rise * rise) / 3
    xz, yz = third * (cosine + base * area * mean_cosine), third * (sine + base * area * mean_sine)
    xx, yy, xy = fourth * (area + double_cosine) / 2, fourth * (area - double_cosine) / 2, fourth * double_sine / 2
    zz = plane * (square + 2 * base * height + base * base * area)
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _slant(half: float) -> float:
    """∫ s sin(s δ) ds/2 over |s| < 1: (sin δ − δ cos δ)/δ², and its series where that loses its digits."""
    if abs(half) < 1e-2:
        return half / 3 * (1 - half**2 / 10 * (1 - half**2 / 28))
    return (math.sin(half) - half * math.cos(half)) / half**2
