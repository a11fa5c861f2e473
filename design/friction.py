"""Kinetic friction of the piston's sealing fins, which chamber pressure presses against the bore.

Nakata and Noda (2023), equation (6) with Table IV, after Canudas de Wit et al. (1995); s is the seal's contact area:

    f_k = (mu_C + (mu_S - mu_C) exp(-(v/v_s)^2)) (s P + F_0) sgn v + sigma_2 v          (6)

Identified on the prototype between 0.6 and 8 mm/s, at 0 to 0.6 MPa in the cap-end chamber alone and with silicone
grease; another seal, grease or speed needs parameters of its own. Above v_s the law is a constant but for sigma_2,
and the paper's sigma_2 of zero says no more than that none was seen up to 8 mm/s.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SealFriction:
    """Table IV: coefficients, contact force at the atmosphere (N), Stribeck speed (m/s), viscous part (N s/m)."""

    static_coefficient: float  # mu_S
    coulomb_coefficient: float  # mu_C
    contact_force: float  # F_0
    stribeck_speed: float  # v_s
    viscous_coefficient: float  # sigma_2


def kinetic_friction(law: SealFriction, area: float, pressure: float, speed: float) -> float:
    """f_k (N) of equation (6) against a speed of zero or more (m/s), at a gauge pressure (Pa).

    area : s (m^2). At rest it is the force to break away. A vacuum relieves the fin, and the contact force may then
    come out below zero where (6) no longer holds.
    """
    normal = area * pressure + law.contact_force
    share = math.exp(-((speed / law.stribeck_speed) ** 2))
    coefficient = law.coulomb_coefficient + (law.static_coefficient - law.coulomb_coefficient) * share
    return coefficient * normal + law.viscous_coefficient * speed
