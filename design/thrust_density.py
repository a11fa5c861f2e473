"""Force per volume, and the volume that it is of.

Nakata and Noda (2023), Sec. V, give 241 kN/m^3 with the pneumatic force and 15 kN/(A m^3) of the linear motor without
saying of which volume. Both follow from one of 535 cm^3, inferred: (121 N + 8.02 N)/535 cm^3 and 8.02 N/A over the
same, with the measured force constant at 1 A. The back yoke's envelope, 27 mm by 205 mm, is 117 cm^3 and gives 1100 and
68; with the pneumatic force alone, 1031.
"""

from __future__ import annotations

import math

from fluxbore.design.hybrid import HybridActuator


def envelope(actuator: HybridActuator) -> float:
    """m^3 of the cylinder around the back yoke: pi D^2 L / 4."""
    return math.pi / 4 * actuator.back_yoke.outer_diameter**2 * (actuator.yoke_end - actuator.yoke_start)


def force_constant_density(force_constant: float, volume: float) -> float:
    """N/(A m^3)."""
    return force_constant / volume


def thrust_density(pneumatic_force: float, force_constant: float, current: float, volume: float) -> float:
    """N/m^3 of the pneumatic and the electromagnetic force together, at a current's amplitude (A)."""
    return (pneumatic_force + force_constant * current) / volume
