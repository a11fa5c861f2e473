"""Kinetic friction of the piston's sealing fins, which chamber pressure presses against the bore.

Canudas de Wit et al. (1995) for a contact that nothing changes, and Nakata and Noda (2023), equation (6) with Table
IV, for one that pressure presses; s is the seal's contact area:

    f_k = (F_C + (F_S - F_C) exp(-(v/v_s)^2)) sgn v + sigma_2 v                         (3)
    f_k = (mu_C + (mu_S - mu_C) exp(-(v/v_s)^2)) (s P + F_0) sgn v + sigma_2 v          (6)

(6) is (3) with F_C = mu_C (s P + F_0) and F_S = mu_S (s P + F_0).

Identified on the prototype between 0.6 and 8 mm/s, at 0 to 0.6 MPa in the cap-end chamber alone and with silicone
grease; another seal, grease or speed needs parameters of its own. Above v_s the law is a constant but for sigma_2,
and the paper's sigma_2 of zero says no more than that none was seen up to 8 mm/s. A chamber below the atmosphere does
not press the fin: see `check_pressure`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SealFriction:
    """Table IV: coefficients, contact force at the atmosphere (N), Stribeck speed (m/s), viscous part (N s/m).

    Raises DesignError for a value that is not finite, below zero, or a Stribeck speed of zero.
    """

    static_coefficient: float  # mu_S
    coulomb_coefficient: float  # mu_C
    contact_force: float  # F_0
    stribeck_speed: float  # v_s
    viscous_coefficient: float  # sigma_2

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            positive = field.name == "stribeck_speed"
            if not (math.isfinite(value) and (value > 0 if positive else value >= 0)):
                limit = "above 0" if positive else "0 or above"
                raise DesignError(f"actuator.seal.{field.name} must be finite and {limit}; got {value:g}.")


def check_pressure(pressure: ArrayLike, name: str) -> None:
    """Raises DesignError where a pressure (Pa gauge) of this name is below the atmosphere's, or is no number.

    Suction does not press the fin against the bore, and lifts it at last: (6) says nothing of it.
    """
    least = float(np.min(pressure, initial=np.inf))
    if not least >= 0:
        raise DesignError(
            f"{name} must be 0 MPa gauge or above for the friction of a seal that pressure presses; "
            f"got {format_quantity(least, 'pressure')}."
        )


def stribeck_level(coulomb: ArrayLike, static: ArrayLike, stribeck_speed: float, velocity: ArrayLike) -> Floats:
    """F_C + (F_S - F_C) exp(-(v/v_s)^2) of (3), in the unit of F_C and F_S: what sliding takes but for viscosity.

    All broadcast against one another; v (m/s) of either sign. At rest it is F_S, the force to break away.
    """
    with np.errstate(over="ignore"):  # a Stribeck speed next to nothing leaves Coulomb's force alone
        share = np.exp(-np.square(np.asarray(velocity, dtype=np.float64) / stribeck_speed))
    sliding = np.asarray(coulomb, dtype=np.float64)
    return sliding + (np.asarray(static, dtype=np.float64) - sliding) * share


def stribeck_friction(
    coulomb: ArrayLike, static: ArrayLike, stribeck_speed: float, viscous: float, velocity: ArrayLike
) -> Floats:
    """f_k (N) of (3), with the sign of the velocity (m/s): at rest it is zero, as sgn 0 is."""
    v = np.asarray(velocity, dtype=np.float64)
    return np.sign(v) * stribeck_level(coulomb, static, stribeck_speed, v) + viscous * v


def contact_force(law: SealFriction, area: float, pressure: ArrayLike) -> Floats:
    """s P + F_0 (N) at a gauge pressure (Pa), with s (m^2); no less than zero, where suction has lifted the fin."""
    return np.maximum(area * np.asarray(pressure, dtype=np.float64) + law.contact_force, 0.0)


def sliding_level(law: SealFriction, area: float, pressure: ArrayLike, velocity: ArrayLike) -> Floats:
    """The size of f_k of (6) without its viscous part (N): g(v, P) of the bristle's law, and at rest that of breaking
    away."""
    coefficient = stribeck_level(law.coulomb_coefficient, law.static_coefficient, law.stribeck_speed, velocity)
    return coefficient * contact_force(law, area, pressure)


def seal_friction(law: SealFriction, area: float, pressure: ArrayLike, velocity: ArrayLike) -> Floats:
    """f_k (N) of (6), with the sign of the velocity (m/s); pressure (Pa gauge) and velocity broadcast.

    area : s (m^2). The mover pushes against its load with that much less while it advances, and takes it as well while
    it is pushed back.
    """
    v = np.asarray(velocity, dtype=np.float64)
    return np.sign(v) * sliding_level(law, area, pressure, v) + law.viscous_coefficient * v


def kinetic_friction(law: SealFriction, area: float, pressure: float, speed: float) -> float:
    """The size of f_k (N) of (6) at a speed of zero or more (m/s) and a gauge pressure (Pa).

    area : s (m^2). At rest it is the force to break away.
    """
    return float(sliding_level(law, area, pressure, speed)) + law.viscous_coefficient * speed
