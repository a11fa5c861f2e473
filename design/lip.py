"""The sealing fin as an elastic lip: a thin cone, clamped at its root, with its tip on the bore.

The interference pushes the tip in; the chamber's pressure, which the cone opens to, presses all of it out. Along the
meridian coordinate s, from the root (s = 0) to the tip (s = L), with the displacement w across the wall, outwards:

    D w'''' + k w = p,    D = E t^3 / 12 (1 - nu^2),    k = E t cos^2(phi) / R^2
    w(0) = w'(0) = 0,     w''(L) = 0,                   w(L) = -delta / cos(phi)
    q = D w'''(L),        F = pi D_c' q / cos(phi)

a beam on the elastic foundation that the hoops are (Hetenyi, Beams on Elastic Foundation, 1946, chapter on cylindrical
tubes; Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, 1959, chapter 15), of the cylinder of the cone's
mean radius of curvature R/cos(phi) (Geckeler's approximation). F is the radial force of tip on bore, linear in the
interference and in the pressure: F = stiffness x delta + area x p. Formulas from memory of these works; checked
against finite elements of the whole conical shell in tests/design/test_lip.py: forces within 3 %, stresses within 7 %
in the range below.

Valid for a thin wall (t/R below 0.1), a slender cone (phi below 20 deg), small strains, no friction at the tip, and
while the tip alone touches: `touches` says where pressure has bulged the lip against the bore behind its tip too.
Neither creep nor the modulus' fall with temperature is in it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

THICKEST = 0.1
"""t/R; beyond it the wall is no thin shell."""

STEEPEST = math.radians(20.0)
"""rad; a steeper cone pushes along its meridian, which is left out."""

STATIONS = 65
"""Places along the meridian where the stress is read: the largest is missed by less than 0.2 %."""


@dataclass(frozen=True, slots=True)
class Lip:
    """One fin with its bore: diameters, axial length and wall (m), modulus (Pa), Poisson's ratio."""

    bore: float  # D_c'
    outer_diameter: float  # D_f
    inner_diameter: float  # d
    length: float  # l
    thickness: float  # t
    young_modulus: float  # E
    poisson_ratio: float  # nu

    @property
    def angle(self) -> float:
        """phi (rad), of the cone's wall to its axis."""
        return math.atan2((self.outer_diameter - self.inner_diameter) / 2, self.length)

    @property
    def meridian(self) -> float:
        """L (m), from root to tip along the wall."""
        return math.hypot(self.length, (self.outer_diameter - self.inner_diameter) / 2)

    @property
    def radius(self) -> float:
        """R (m), the mean of root and tip."""
        return (self.outer_diameter + self.inner_diameter) / 4

    @property
    def bending_stiffness(self) -> float:
        """D (N m)."""
        return self.young_modulus * self.thickness**3 / (12 * (1 - self.poisson_ratio**2))

    @property
    def foundation(self) -> float:
        """k (Pa/m), what the hoops hold against a displacement."""
        return self.young_modulus * self.thickness * (math.cos(self.angle) / self.radius) ** 2

    @property
    def decay(self) -> float:
        """lambda (1/m): a disturbance of the edge has died down by exp(-lambda s)."""
        return math.sqrt(math.sqrt(self.foundation / (4 * self.bending_stiffness)))


def contact_force(lip: Lip, interference: float, pressure: float) -> float:
    """F (N), radial, all around, of one lip: interference in m on the radius, pressure in Pa gauge."""
    return stiffness(lip) * interference + pressure_area(lip) * pressure


def stiffness(lip: Lip) -> float:
    """N of radial force per m of radial interference."""
    return _tip_force(lip, 1.0, 0.0)


def pressure_area(lip: Lip) -> float:
    """N of radial force per Pa of chamber pressure (m^2), to be compared with s of Nakata and Noda's equation (5)."""
    return _tip_force(lip, 0.0, 1.0)


def stress(lip: Lip, interference: float, pressure: float) -> float:
    """The largest equivalent (von Mises) stress (Pa) in the lip, at either face, root and tip included.

    Bending along the meridian with its share across, and the hoop's w cos(phi)/r E. It bends over where the largest
    of one place gives way to that of another, and is smooth elsewhere.
    """
    along = np.linspace(0.0, 1.0, STATIONS)
    shape = _shape(lip, interference, pressure)
    w, curvature = _deflection(lip, shape, pressure, along), _derivative(lip, shape, along, 2)
    r = lip.inner_diameter / 2 + along * (lip.outer_diameter - lip.inner_diameter) / 2
    bending = 6 * lip.bending_stiffness * curvature / lip.thickness**2
    hoop = lip.young_modulus * w * math.cos(lip.angle) / r
    faces = np.stack([bending, -bending])
    around = hoop + lip.poisson_ratio * faces
    return float(np.sqrt(np.max(faces**2 - faces * around + around**2)))


def worst_stress(lip: Lip, interferences: tuple[float, float], pressure: float) -> float:
    """The largest `stress` (Pa) between two interferences (m) and between no pressure and this one (Pa gauge).

    Stresses are linear in both, and von Mises' is convex: the largest stands in a corner.
    """
    return max(stress(lip, interference, load) for interference in interferences for load in (0.0, pressure))


def touches(lip: Lip, interference: float, pressure: float) -> bool:
    """Whether the lip reaches the bore behind its tip, so that a band and not a line presses."""
    along = np.linspace(0.0, 1.0, STATIONS)[:-1]
    w = _deflection(lip, _shape(lip, interference, pressure), pressure, along)
    # The tip's own place, of this interference, is the bore.
    bore = lip.outer_diameter / 2 - interference
    r = lip.inner_diameter / 2 + along * (lip.outer_diameter - lip.inner_diameter) / 2
    return bool(np.any(r + w * math.cos(lip.angle) > bore))


def in_range(lip: Lip) -> bool:
    """Whether the wall is thin and the cone slender enough."""
    return lip.thickness / lip.radius < THICKEST and lip.angle < STEEPEST


def _tip_force(lip: Lip, interference: float, pressure: float) -> float:
    shape = _shape(lip, interference, pressure)
    shear = lip.bending_stiffness * float(_derivative(lip, shape, np.array([1.0]), 3)[0])
    return math.pi * lip.bore * shear / math.cos(lip.angle)


def _shape(lip: Lip, interference: float, pressure: float) -> Floats:
    """The four coefficients of w - p/k in the functions of `_functions`, from the four conditions at root and tip."""
    free = pressure / lip.foundation
    root, tip = np.array([0.0]), np.array([1.0])
    conditions = np.concatenate(
        [_functions(lip, root, 0), _functions(lip, root, 1), _functions(lip, tip, 2), _functions(lip, tip, 0)]
    )
    values = np.array([-free, 0.0, 0.0, -interference / math.cos(lip.angle) - free])
    return np.linalg.solve(conditions, values)


def _functions(lip: Lip, along: Floats, order: int) -> Floats:
    """(n, 4): cosine and sine that die down from the root and from the tip, derived by lambda s, at s/L (n,)."""
    length = lip.decay * lip.meridian
    kappa = 1 - 1j
    from_root = (-kappa) ** order * np.exp(-kappa * length * along)
    from_tip = kappa**order * np.exp(-kappa * length * (1 - along))
    return np.stack([from_root.real, -from_root.imag, from_tip.real, -from_tip.imag], axis=1)


def _derivative(lip: Lip, shape: Floats, along: Floats, order: int) -> Floats:
    """The derivative of w by s of this order, one or more."""
    return lip.decay**order * (_functions(lip, along, order) @ shape)


def _deflection(lip: Lip, shape: Floats, pressure: float, along: Floats) -> Floats:
    return pressure / lip.foundation + _functions(lip, along, 0) @ shape
