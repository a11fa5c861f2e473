"""The cylinder as a thick-walled tube under pressure: stresses and the displacement of its bore.

Lame (1852) for an isotropic, linearly elastic tube of inner radius a and outer radius b, far from its ends, with p
inside and p_o outside:

    sigma_r     = A - B/r^2,   sigma_theta = A + B/r^2
    A = (p a^2 - p_o b^2) / (b^2 - a^2),   B = (p - p_o) a^2 b^2 / (b^2 - a^2)
    sigma_z     = A where the ends are closed (the tube holds its own caps), 0 where tie rods hold them
    u(r)        = r/E (sigma_theta - nu (sigma_r + sigma_z))

(Timoshenko and Goodier, Theory of Elasticity, 3rd ed., section 28.) Exact for any wall; the winding on the outside is
left out, which errs to the safe side. Within about sqrt(b (b - a)) of a cap the wall is stiffer than this.

Pressure inside moves the bore outwards and so opens the clearance between mover and bore; pressure outside, or vacuum
inside (a negative gauge pressure), moves it inwards and closes the clearance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.hybrid import Cylinder
from fluxbore.design.materials import Material

UNLOADED = 1e-6
"""Pa; a smaller stress is no load, against which there is no factor of safety."""


@dataclass(frozen=True, slots=True)
class WallStress:
    """Principal stresses at one radius (Pa), tension positive."""

    radial: float
    hoop: float
    axial: float

    @property
    def equivalent(self) -> float:
        """By von Mises (Pa), never negative."""
        r, t, z = self.radial, self.hoop, self.axial
        return math.sqrt(((t - r) ** 2 + (r - z) ** 2 + (z - t) ** 2) / 2)


def wall_stress(
    radius: float, inner: float, outer: float, pressure: float, *, outside: float = 0.0, closed: bool = True
) -> WallStress:
    """Stresses at a radius between the inner and the outer one (m), under gauge pressures inside and outside (Pa)."""
    span = outer**2 - inner**2
    mean = (pressure * inner**2 - outside * outer**2) / span
    swing = (pressure - outside) * (inner * outer / radius) ** 2 / span
    return WallStress(mean - swing, mean + swing, mean if closed else 0.0)


def displacement(
    radius: float,
    inner: float,
    outer: float,
    pressure: float,
    young_modulus: float,
    poisson_ratio: float,
    *,
    outside: float = 0.0,
    closed: bool = True,
) -> float:
    """Radial displacement u (m) at a radius (m), outwards positive; moduli in Pa and as a plain number."""
    stress = wall_stress(radius, inner, outer, pressure, outside=outside, closed=closed)
    return radius / young_modulus * (stress.hoop - poisson_ratio * (stress.radial + stress.axial))


@dataclass(frozen=True, slots=True)
class Vessel:
    """The cylinder under a pressure. None stands for what the material's data do not tell.

    hoop_stress : at the bore (Pa), where it is largest. safety : yield stress over the equivalent stress there; None
    without pressure too. dilation : of the bore (m), radial, outwards positive.
    """

    hoop_stress: float
    safety: float | None
    dilation: float | None


def vessel(cylinder: Cylinder, material: Material, pressure: float, *, closed: bool = True) -> Vessel:
    """The cylinder's tube as drawn (bore D_c', outside D_c) under a gauge pressure inside (Pa)."""
    inner, outer = cylinder.inner_diameter / 2, cylinder.outer_diameter / 2
    stress = wall_stress(inner, inner, outer, pressure, closed=closed)
    elastic = material.young_modulus is not None and material.poisson_ratio is not None
    return Vessel(
        stress.hoop,
        material.yield_stress / stress.equivalent
        if material.yield_stress is not None and stress.equivalent > UNLOADED
        else None,
        displacement(
            inner, inner, outer, pressure, material.young_modulus or 1.0, material.poisson_ratio or 0.0, closed=closed
        )
        if elastic
        else None,
    )
