"""The air cylinder: forces from gauge pressure, chamber volumes.

The catalogue's bore counts: with the drawing's 16.1 mm the published 121 and 90 N would be 122 and 92 N.
"""

from __future__ import annotations

import math

from fluxbore.design.hybrid import HybridActuator


def piston_area(actuator: HybridActuator) -> float:
    """Area that the cap-end chamber's pressure acts on (m^2): the whole bore."""
    return math.pi / 4 * actuator.cylinder.catalogue_bore**2


def rod_side_area(actuator: HybridActuator) -> float:
    """Area that the rod-end chamber's pressure acts on (m^2): the bore less the shaft, which leaves at that end."""
    return piston_area(actuator) - math.pi / 4 * actuator.shaft.outer_diameter**2


def advance_force(actuator: HybridActuator, pressure: float) -> float:
    """Thrust in +z (N) of a gauge pressure (Pa) at the cap end, the other end at the atmosphere; without friction."""
    return pressure * piston_area(actuator)


def retract_force(actuator: HybridActuator, pressure: float) -> float:
    """Pull in -z (N, positive) of a gauge pressure (Pa) at the rod end, the other at the atmosphere; no friction."""
    return pressure * rod_side_area(actuator)


def chamber_volumes(actuator: HybridActuator, position: float) -> tuple[float, float]:
    """Volumes of the cap-end and the rod-end chamber (m^3), without ports and hoses.

    position : z of the magnet array's cap-side end face (m). At the stroke's ends one of the two is zero.
    """
    low, high = actuator.chamber
    cap = position - actuator.piston.length - low
    rod = high - (position + actuator.array_length + actuator.piston.length)
    return piston_area(actuator) * cap, rod_side_area(actuator) * rod
