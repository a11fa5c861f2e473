"""Friction of the mover's linear guides, for a simulation that goes step by step.

The bristles (LuGre) of `design.bristle` for one contact whose level F_C nothing changes, without Stribeck's rise:
with u the way gone in one direction

    dz/du = sgn u - b z,  b = sigma_0/F_C:     z' = z e^{-b|u|} + sgn u (1 - e^{-b|u|})/b
    F = sigma_0 z + sigma_1 dz/dt

exact for any step, at any stiffness. The work that goes in is never less than what the bristles store while
|v| <= 4 F_C/sigma_1.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from fluxbore.design.errors import DesignError


@dataclass(frozen=True, slots=True)
class Guides:
    """level : F_C (N), zero for no friction. stiffness : sigma_0 (N/m). damping : sigma_1 (N s/m).

    Raises DesignError for a level or damping below zero, or a stiffness that is not above zero.
    """

    level: float = 0.0
    stiffness: float = 1.0
    damping: float = 0.0

    def __post_init__(self) -> None:
        for name, value, good, limit in (
            ("friction", self.level, self.level >= 0, "0 N or above"),
            ("stiffness", self.stiffness, self.stiffness > 0, "above 0 N/m"),
            ("damping", self.damping, self.damping >= 0, "0 N s/m or above"),
        ):
            if not (math.isfinite(value) and good):
                raise DesignError(f"The {name} of the guides must be finite and {limit}; got {value:g}.")


def rubbing_of(guides: Guides) -> Callable[[float, float], float]:
    """Guides at rest: called step by step with the way moved (m) and the velocity at its end (m/s), it gives the
    friction (N) there, with the sign of the motion."""
    if guides.level == 0.0:
        return lambda moved, velocity: 0.0
    bristle, damping, expm1 = guides.stiffness, guides.damping, math.expm1
    rate = bristle / guides.level
    deflection = 0.0

    def step(moved: float, velocity: float) -> float:
        nonlocal deflection
        deflection -= expm1(-rate * abs(moved)) * (math.copysign(1 / rate, moved) - deflection)
        return bristle * deflection + damping * (velocity - rate * abs(velocity) * deflection)

    return step
