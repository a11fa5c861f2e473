"""What pushes the output piston back: a linear spring, a constant force, or a cord of rubber.

    linear     F = F_0 + k x
    constant   F = F_0 (a spring motor or a weight; Buerger and Hogan's choice)
    cord       F = 2 A (lambda - lambda^-2)(C_1 + C_2/lambda),  lambda = lambda_0 + x/L    for n cords together

x : extension from the retracted end (m), F : what the piston works against (N). The cord is Mooney's rubber (1940) in
simple tension, of unstrained section A and length L, and stretched to lambda_0 when retracted; valid to stretches of
about 3 for natural rubber, without hysteresis. All of them are elastic: `energy` is the integral of `force`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

from fluxbore.design.errors import DesignError

LARGEST_STRETCH = 3.0
"""Of a cord; beyond it the rubber's chains are at their ends, which C_1 and C_2 do not know."""


class ReturnElement(Protocol):
    """force (N), stiffness (N/m) and stored energy (J, from x = 0) at an extension (m)."""

    def force(self, extension: float) -> float: ...

    def stiffness(self, extension: float) -> float: ...

    def energy(self, extension: float) -> float: ...


@dataclass(frozen=True, slots=True)
class LinearReturn:
    """rate : k (N/m). preload : F_0 (N). mass (kg), all springs together."""

    rate: float
    preload: float = 0.0
    mass: float = 0.0

    def __post_init__(self) -> None:
        _positive("actuator.return_spring.rate", self.rate, "N/m")

    def force(self, extension: float) -> float:
        return self.preload + self.rate * extension

    def stiffness(self, extension: float) -> float:
        return self.rate

    def energy(self, extension: float) -> float:
        return (self.preload + self.rate * extension / 2) * extension


@dataclass(frozen=True, slots=True)
class ConstantReturn:
    """preload : F_0 (N). mass (kg)."""

    preload: float
    mass: float = 0.0

    def __post_init__(self) -> None:
        _positive("actuator.return_spring.preload", self.preload, "N")

    def force(self, extension: float) -> float:
        return self.preload

    def stiffness(self, extension: float) -> float:
        return 0.0

    def energy(self, extension: float) -> float:
        return self.preload * extension


@dataclass(frozen=True, slots=True)
class CordReturn:
    """length : L (m). area : A of all cords together (m^2). stretch : lambda_0. first, second : C_1, C_2 (Pa)."""

    length: float
    area: float
    stretch: float
    first: float
    second: float
    mass: float = 0.0

    def __post_init__(self) -> None:
        _positive("actuator.return_spring.cord_length", self.length, "m")
        _positive("actuator.return_spring.cord_area", self.area, "m^2")
        _positive("actuator.return_spring.cord_first", self.first, "Pa")
        if not 1 <= self.stretch < LARGEST_STRETCH:
            raise DesignError(
                f"actuator.return_spring.cord_stretch must be from 1 to below {LARGEST_STRETCH:g}; "
                f"got {self.stretch:g}."
            )

    def force(self, extension: float) -> float:
        stretch = self._at(extension)
        return 2 * self.area * (stretch - stretch**-2) * (self.first + self.second / stretch)

    def stiffness(self, extension: float) -> float:
        stretch = self._at(extension)
        slope = (1 + 2 * stretch**-3) * (self.first + self.second / stretch)
        return 2 * self.area / self.length * (slope - (stretch - stretch**-2) * self.second / stretch**2)

    def energy(self, extension: float) -> float:
        return self.area * self.length * (self._density(self._at(extension)) - self._density(self.stretch))

    def _at(self, extension: float) -> float:
        stretch = self.stretch + extension / self.length
        if not 0 < stretch <= LARGEST_STRETCH:
            raise DesignError(
                f"actuator.return_spring.cord_length must keep the cord's stretch at {LARGEST_STRETCH:g} or below; "
                f"got {stretch:g} at an extension of {extension * 1e3:g} mm."
            )
        return stretch

    def _density(self, stretch: float) -> float:
        """W (J/m^3) of Mooney's rubber."""
        return self.first * (stretch**2 + 2 / stretch - 3) + self.second * (2 * stretch + stretch**-2 - 3)


def _positive(key: str, value: float, unit: str) -> None:
    if not (math.isfinite(value) and value > 0):
        raise DesignError(f"{key} must be finite and above 0 {unit}; got {value:g} {unit}.")
