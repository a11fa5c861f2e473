"""A system of coaxial coils in free space as frozen parameters: solid windings of rectangular cross-section.

Each winding carries an evenly spread current density along +phi (positive) or against it. Superconducting energy
stores, laboratory magnets and field coils are of this kind; nothing here is magnetic, so that the field is exact
(`fluxbore.design.coils_field`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations

from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity

THINNEST = 1e-6
"""m; a thinner winding or bore is a slip of the unit."""


@dataclass(frozen=True, slots=True)
class Coil:
    """One winding. Lengths in metres, z from lower to upper; current density in A/m^2 along +phi."""

    name: str
    inner_radius: float
    outer_radius: float
    lower: float
    upper: float
    current_density: float

    @property
    def volume(self) -> float:
        """pi (r_o^2 - r_i^2) h (m^3), of the whole winding."""
        return math.pi * (self.outer_radius**2 - self.inner_radius**2) * (self.upper - self.lower)


@dataclass(frozen=True, slots=True)
class CoilSystem:
    """All windings. fill : share of a winding's cross-section that is conductor."""

    name: str
    conductor: str
    fill: float
    coils: tuple[Coil, ...]

    def check(self) -> None:
        """Raise DesignError with one sentence where a winding has no bore or no section, or two of them overlap."""
        for coil in self.coils:
            key = f"actuator.{coil.name}"
            if coil.inner_radius < THINNEST:
                raise DesignError(
                    f"{key}.thickness must leave a bore around the axis, at most "
                    f"{_mm(coil.inner_radius + coil.outer_radius)}; got {_mm(coil.outer_radius - coil.inner_radius)}."
                )
            if coil.outer_radius - coil.inner_radius < THINNEST:
                raise DesignError(
                    f"{key}.radius must exceed {key}.inner_radius {_mm(coil.inner_radius)}; "
                    f"got {_mm((coil.inner_radius + coil.outer_radius) / 2)}."
                )
            if coil.upper - coil.lower < 2 * THINNEST:
                raise DesignError(
                    f"{key}.half_height must be at least {_mm(THINNEST)}; got {_mm((coil.upper - coil.lower) / 2)}."
                )
        for one, other in combinations(self.coils, 2):
            radial = min(one.outer_radius, other.outer_radius) - max(one.inner_radius, other.inner_radius)
            axial = min(one.upper, other.upper) - max(one.lower, other.lower)
            if min(radial, axial) > THINNEST:
                raise DesignError(
                    f"actuator.{other.name} must not overlap actuator.{one.name}; got a common section of "
                    f"{_mm(radial)} by {_mm(axial)}."
                )


def _mm(length: float) -> str:
    return format_quantity(length, "length", 6)
