"""Friction of a hydraulic cylinder's O-ring: equations (1) and (2) of the paper on the PREHydrA, Table I.

    F_f = (F_C + F_S0 e^(-c |v|)) sgn v + f_v v,     F_C = F_preload + f_C p                             (1), (2)

Identified up to 0.45 m/s and 26 bar gauge on one cylinder of 14.3 mm bore; the same in both directions and all along
the stroke (Sec. V). Between -v_0 and v_0 the sign is v/v_0, as the paper has it (v_0 = 0.1 mm/s): friction is then one
value of the speed, and never drives.

Table I gives a least friction of 10.3 N, not the 7 N of the text.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from fluxbore.design.errors import DesignError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]

# Specifications are read with this module: numpy is imported when arrays are asked for.


@dataclass(frozen=True, slots=True)
class CylinderFriction:
    """Table I, SI units. Raises DesignError for a value that is not finite or below zero, or a v_0 of zero."""

    preload: float  # F_preload (N)
    pressure_coefficient: float  # f_C (N/Pa)
    stribeck_force: float  # F_S0 (N)
    stribeck_decay: float  # c (s/m)
    viscous_coefficient: float  # f_v (N s/m)
    linear_speed: float = 1e-4  # v_0 (m/s)

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            positive = field.name == "linear_speed"
            if not (math.isfinite(value) and (value > 0 if positive else value >= 0)):
                limit = "above 0" if positive else "0 or above"
                raise DesignError(f"actuator.friction.{field.name} must be finite and {limit}; got {value:g}.")


PUBLISHED = CylinderFriction(8.1, 4.2e-6, 15.3, 118.5, 59.5)
"""Table I."""


def cylinder_friction(law: CylinderFriction, velocity: ArrayLike, pressure: ArrayLike) -> Floats:
    """F_f (N), with the sign of the velocity (m/s); pressure in Pa gauge, no less than zero counts. Both broadcast."""
    import numpy as np

    v = np.asarray(velocity, dtype=np.float64)
    coulomb = law.preload + law.pressure_coefficient * np.maximum(np.asarray(pressure, dtype=np.float64), 0.0)
    sign = np.clip(v / law.linear_speed, -1.0, 1.0)
    return (coulomb + law.stribeck_force * np.exp(-law.stribeck_decay * np.abs(v))) * sign + (
        law.viscous_coefficient * v
    )


def least_friction(law: CylinderFriction, pressure: float = 0.0) -> tuple[float, float]:
    """The speed (m/s) at which sliding takes the least force, and that force (N), at a gauge pressure (Pa).

    Where viscous friction does not grow to the Stribeck effect's slope at rest, it is at rest; without viscous friction
    it is the Coulomb force itself, at no end of speed.
    """
    coulomb = law.preload + law.pressure_coefficient * max(pressure, 0.0)
    fall = law.stribeck_force * law.stribeck_decay
    if law.viscous_coefficient == 0:
        return (math.inf, coulomb) if fall > 0 else (0.0, coulomb + law.stribeck_force)
    speed = math.log(fall / law.viscous_coefficient) / law.stribeck_decay if fall > law.viscous_coefficient else 0.0
    force = coulomb + law.stribeck_force * math.exp(-law.stribeck_decay * speed) + law.viscous_coefficient * speed
    return speed, force
