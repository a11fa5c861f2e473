"""The rod as a column and as a tie: buckling of its free length when extended, and axial stress.

Slender rods buckle at Euler's load, stocky ones at Johnson's, which meets it with the same slope (Shigley, Mechanical
Engineering Design, chapter on columns, central loading):

    F = pi^2 E I / (K L)^2                                      lambda >= lambda_c
    F = A sigma_y (1 - sigma_y lambda^2 / (4 pi^2 E))           lambda <  lambda_c
    lambda = K L / (d/4),   lambda_c = pi sqrt(2 E / sigma_y)

for a round rod of diameter d. K L is the length between inflections: K = 2 for a rod that a cap holds and nothing
guides at its end, down to 1/2 where both ends are held. Theoretical K; loads are taken as central, and a rod with an
offset load or a bend yields earlier, so that a factor of safety of 3 to 5 is usual for actuator rods.
"""

from __future__ import annotations

import math

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Material

END_CONDITIONS = {"fixed-free": 2.0, "pinned-pinned": 1.0, "fixed-pinned": 0.699156, "fixed-fixed": 0.5}
"""K of each way to hold a column; of fixed-pinned it is pi over the first root of tan x = x."""


def free_length(actuator: HybridActuator) -> float:
    """Rod beyond the rod-end cap's outer face when fully extended (m); zero where it does not reach out."""
    extended = actuator.mid_stroke + actuator.mover.stroke / 2 - actuator.piston.length + actuator.shaft.length
    return max(extended - actuator.rod_face, 0.0)


def section(diameter: float) -> tuple[float, float]:
    """Area (m^2) and second moment of area (m^4) of a round rod (m)."""
    return math.pi / 4 * diameter**2, math.pi / 64 * diameter**4


def buckling_force(
    diameter: float, effective_length: float, young_modulus: float, yield_stress: float | None
) -> float | None:
    """Critical axial load (N) of a round rod; lengths in m, modulus and stress in Pa.

    effective_length : K L. yield_stress : None leaves Euler's load alone, which is then too high for a stocky rod.
    None where there is neither length nor yield stress to limit the load.
    """
    area, moment = section(diameter)
    slenderness = 4 * effective_length / diameter
    if yield_stress is not None and slenderness < math.pi * math.sqrt(2 * young_modulus / yield_stress):
        return area * yield_stress * (1 - yield_stress * slenderness**2 / (4 * math.pi**2 * young_modulus))
    return math.pi**2 * young_modulus * moment / effective_length**2 if effective_length > 0 else None


def critical_force(actuator: HybridActuator, material: Material, ends: str) -> float | None:
    """Critical load (N) of the shaft's free length; ``ends`` is one of `END_CONDITIONS`.

    None where the material has no Young's modulus.
    """
    if material.young_modulus is None:
        return None
    length = END_CONDITIONS[ends] * free_length(actuator)
    return buckling_force(actuator.shaft.outer_diameter, length, material.young_modulus, material.yield_stress)


def axial_stress(actuator: HybridActuator, force: float) -> float:
    """Of the shaft's full section under an axial force (Pa); threads and shoulders are left out."""
    return force / section(actuator.shaft.outer_diameter)[0]
