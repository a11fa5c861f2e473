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
while the tip alone touches: `Response.touches` says where pressure has bulged the lip against the bore behind its tip
too. Neither creep nor the modulus' fall with temperature is in it.
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


@dataclass(frozen=True, slots=True)
class Response:
    """What a lip does, linear in the interference (m) and in the pressure (Pa).

    stiffness : N of radial force, all around, per m of radial interference. pressure_area : the same per Pa of chamber
    pressure (m^2), to be compared with s of Nakata and Noda's equation (5). deflection, bending : (stations, 2), w (m)
    and the bending stress along the meridian at the outer face (Pa), per m and per Pa.
    """

    lip: Lip
    stiffness: float
    pressure_area: float
    deflection: Floats
    bending: Floats

    def contact_force(self, interference: float, pressure: float) -> float:
        """F (N), radial, all around, of one lip."""
        return self.stiffness * interference + self.pressure_area * pressure

    def stress(self, interference: float, pressure: float) -> float:
        """The largest equivalent (von Mises) stress (Pa) in the lip, at either face, root and tip included.

        Bending along the meridian with its share across, and the hoop's w cos(phi)/r E. It bends over where the largest
        of one place gives way to that of another, and is smooth elsewhere.
        """
        load = np.array([interference, pressure])
        bending = self.bending @ load
        hoop = self.lip.young_modulus * (self.deflection @ load) * math.cos(self.lip.angle) / _radii(self.lip)
        faces = np.stack([bending, -bending])
        around = hoop + self.lip.poisson_ratio * faces
        return float(np.sqrt(np.max(faces**2 - faces * around + around**2)))

    def worst_stress(self, interferences: tuple[float, float], pressure: float) -> float:
        """The largest `stress` (Pa) between two interferences (m) and between no pressure and this one (Pa gauge).

        Stresses are linear in both, and von Mises' is convex: the largest stands in a corner.
        """
        return max(self.stress(interference, load) for interference in interferences for load in (0.0, pressure))

    def touches(self, interference: float, pressure: float) -> bool:
        """Whether the lip reaches the bore behind its tip, so that a band and not a line presses."""
        w = self.deflection @ np.array([interference, pressure])
        # The tip's own place, of this interference, is the bore.
        bore = self.lip.outer_diameter / 2 - interference
        return bool(np.any((_radii(self.lip) + w * math.cos(self.lip.angle))[:-1] > bore))


def response(lip: Lip) -> Response:
    """The boundary-value problem, solved for a unit of interference and one of pressure; a quarter of a millisecond."""
    free = np.array([0.0, 1 / lip.foundation])
    pushed = np.array([-1 / math.cos(lip.angle), 0.0])
    ends = np.array([0.0, 1.0])
    value, slope, curvature, jerk = (_functions(lip, ends, order) for order in range(4))
    conditions = np.stack([value[0], slope[0], curvature[1], value[1]])
    nothing = np.zeros(2)
    shape = np.linalg.solve(conditions, np.stack([-free, nothing, nothing, pushed - free]))
    force = math.pi * lip.bore / math.cos(lip.angle) * lip.bending_stiffness * lip.decay**3 * (jerk[1] @ shape)
    along = np.linspace(0.0, 1.0, STATIONS)
    return Response(
        lip,
        float(force[0]),
        float(force[1]),
        free + _functions(lip, along, 0) @ shape,
        6 * lip.bending_stiffness / lip.thickness**2 * lip.decay**2 * (_functions(lip, along, 2) @ shape),
    )


def in_range(lip: Lip) -> bool:
    """Whether the wall is thin and the cone slender enough."""
    return lip.thickness / lip.radius < THICKEST and lip.angle < STEEPEST


def _radii(lip: Lip) -> Floats:
    """Of the stations (m), before anything presses."""
    return np.linspace(lip.inner_diameter / 2, lip.outer_diameter / 2, STATIONS)


def _functions(lip: Lip, along: Floats, order: int) -> Floats:
    """(n, 4): cosine and sine that die down from the root and from the tip, derived by lambda s, at s/L (n,)."""
    length = lip.decay * lip.meridian
    kappa = 1 - 1j
    from_root = (-kappa) ** order * np.exp(-kappa * length * along)
    from_tip = kappa**order * np.exp(-kappa * length * (1 - along))
    return np.stack([from_root.real, -from_root.imag, from_tip.real, -from_tip.imag], axis=1)
