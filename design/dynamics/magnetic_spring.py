"""Force laws of the spring that a magnetic lead screw is: linear (1), sinusoidal (14) and polynomial, without memory.

Equations of the paper on the RotLin actuator. x_d = h theta - x (2) is the displacement (m) between rotor and
translator, F_s (N) drives the mover forward. With memory: `magnetic_hysteresis`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity

Floats = NDArray[np.float64]


class SpringLaw(Protocol):
    """A force that follows from the displacement alone, and its slope."""

    def force(self, displacement: ArrayLike) -> Floats:
        """F_s (N) at displacements (m); shapes are kept."""
        ...

    def stiffness(self, displacement: ArrayLike) -> Floats:
        """dF_s/dx_d (N/m) there."""
        ...


@dataclass(frozen=True, slots=True)
class LinearSpring:
    """F_s = K_s x_d (1): fair to some half of the stall force, where the sine is 5 % below its tangent.

    spring_constant : K_s (N/m). Raises DesignError where it is not above zero.
    """

    spring_constant: float

    def __post_init__(self) -> None:
        _check_positive("The spring constant", self.spring_constant, "stiffness")

    def force(self, displacement: ArrayLike) -> Floats:
        return self.spring_constant * np.asarray(displacement, dtype=np.float64)

    def stiffness(self, displacement: ArrayLike) -> Floats:
        return np.full(np.shape(displacement), self.spring_constant)


@dataclass(frozen=True, slots=True)
class SineSpring:
    """F_s = F_stall sin(x_d/h) (14): the fundamental of the field alone.

    stall_force : F_stall (N). transfer_ratio : h = l_p/2 pi (m/rad) (3), l_p a whole period. Beyond a quarter of l_p
    the screw slips to its next pole; the law goes on, periodic. Raises DesignError where one is not above zero.
    """

    stall_force: float
    transfer_ratio: float

    def __post_init__(self) -> None:
        _check_positive("The stall force", self.stall_force, "force")
        _check_positive("The transfer ratio", self.transfer_ratio, "length")

    @property
    def spring_constant(self) -> float:
        """F_stall/h (N/m): the stiffness at no force."""
        return self.stall_force / self.transfer_ratio

    def force(self, displacement: ArrayLike) -> Floats:
        return self.stall_force * np.sin(np.asarray(displacement, dtype=np.float64) / self.transfer_ratio)

    def stiffness(self, displacement: ArrayLike) -> Floats:
        """K_l* of (32)."""
        return self.spring_constant * np.cos(np.asarray(displacement, dtype=np.float64) / self.transfer_ratio)

    def displacement(self, force: float) -> float:
        """x_d (m) that holds a force (N), on the stable branch. Raises DesignError beyond the stall force."""
        if not abs(force) <= self.stall_force:
            raise DesignError(
                f"A force must be at most the stall force, {format_quantity(self.stall_force, 'force', 6)}, in size; "
                f"got {format_quantity(force, 'force', 6)}."
            )
        return self.transfer_ratio * math.asin(force / self.stall_force)


@dataclass(frozen=True, slots=True)
class PolynomialSpring:
    """F_s = k_1 x_d + k_3 x_d^3 + k_5 x_d^5 + ...: odd, as the force of a screw without preferred direction is.

    coefficients : k_1, k_3, k_5, ... (N/m, N/m^3, ...), one or more. It holds no further than it was fitted. Raises
    DesignError without coefficients, or for one that is not finite.
    """

    coefficients: tuple[float, ...]

    def __post_init__(self) -> None:
        if not self.coefficients or not all(math.isfinite(k) for k in self.coefficients):
            raise DesignError(
                f"A polynomial spring must have one finite coefficient or more; got {_listed(self.coefficients)}."
            )

    def force(self, displacement: ArrayLike) -> Floats:
        x = np.asarray(displacement, dtype=np.float64)
        return np.asarray(x * _horner(self.coefficients, x * x))

    def stiffness(self, displacement: ArrayLike) -> Floats:
        x = np.asarray(displacement, dtype=np.float64)
        return _horner([(2 * j + 1) * k for j, k in enumerate(self.coefficients)], x * x)


def _horner(coefficients: Sequence[float], x: Floats) -> Floats:
    total = np.zeros_like(x)
    for k in reversed(coefficients):
        total = total * x + k
    return total


def _check_positive(what: str, value: float, dimension: str) -> None:
    if not (math.isfinite(value) and value > 0):
        least, got = (format_quantity(each, dimension, 6) for each in (0.0, value))
        raise DesignError(f"{what} must be finite and above {least}; got {got}.")


def _listed(values: Sequence[float]) -> str:
    return ", ".join(f"{value:g}" for value in values) or "none"
