"""Kinetic friction of the piston's sealing fins, which chamber pressure presses against the bore.

Nakata and Noda (2023), equations (4) to (6) with Table III and Table IV, after Canudas de Wit et al. (1995):

    dl  = (D_f - D_c')/(D_f - d) sqrt(l^2 + ((D_f - d)/2)^2)                            (4)
    s   = pi D_c' dl                                                                    (5)
    f_k = (mu_C + (mu_S - mu_C) exp(-(v/v_s)^2)) (s P + F_0) sgn v + sigma_2 v          (6)

(4) holds with the bore D_c' as drawn: the paper writes D_c, which would give a negative length. Table III's rounded
inputs give dl = 0.412 mm where the paper prints 0.407 mm.

Identified on the prototype between 0.6 and 8 mm/s, at 0 to 0.6 MPa in the cap-end chamber alone and with silicone
grease; another seal, grease or speed needs parameters of its own. Above v_s the law is a constant but for sigma_2,
and the paper's sigma_2 of zero says no more than that none was seen up to 8 mm/s.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.hybrid import HybridActuator


@dataclass(frozen=True, slots=True)
class SealFriction:
    """Table IV: coefficients, contact force at the atmosphere (N), Stribeck speed (m/s), viscous part (N s/m)."""

    static_coefficient: float  # mu_S
    coulomb_coefficient: float  # mu_C
    contact_force: float  # F_0
    stribeck_speed: float  # v_s
    viscous_coefficient: float  # sigma_2


def deformed_length(actuator: HybridActuator) -> float:
    """Axial length of the fin that the bore bends (m): equation (4)."""
    fin, bore = actuator.piston, actuator.cylinder.inner_diameter
    taper = fin.fin_outer_diameter - fin.fin_inner_diameter
    return (fin.fin_outer_diameter - bore) / taper * math.hypot(fin.fin_length, taper / 2)


def contact_area(actuator: HybridActuator) -> float:
    """Of the fin on the pressurised side with the bore (m^2): equation (5)."""
    return math.pi * actuator.cylinder.inner_diameter * deformed_length(actuator)


def kinetic_friction(law: SealFriction, area: float, pressure: float, speed: float) -> float:
    """f_k (N) of equation (6) against a speed of zero or more (m/s), at a gauge pressure (Pa).

    area : s (m^2). At rest it is the force to break away. A vacuum relieves the fin, and the contact force may then
    come out below zero where (6) no longer holds.
    """
    normal = area * pressure + law.contact_force
    share = math.exp(-((speed / law.stribeck_speed) ** 2))
    coefficient = law.coulomb_coefficient + (law.static_coefficient - law.coulomb_coefficient) * share
    return coefficient * normal + law.viscous_coefficient * speed
