"""The magnetic cross-section of a lead screw: layers in r, helical magnets in ζ = z − h θ, as plain numbers.

All of it repeats along ζ, so that radii, one period and the lead tell the whole screw, ends left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import isfinite, pi
from typing import Literal

from fluxbore.design.bh_curve import BHCurve
from fluxbore.design.errors import DesignError
from fluxbore.geometry.helical_bands import Profile

Boundary = Literal["iron", "closed"]
"""What lies beyond the innermost or outermost radius: infinitely permeable iron, which the field meets at a right
angle, or something no flux enters, such as air far from the magnets."""


@dataclass(frozen=True, slots=True)
class Layer:
    """A tube of one material.

    outer_radius : m. permeability : relative, of all that has no curve; a magnet's recoil permeability.
    curve : a soft iron's. magnets : radial remanence over the period, of a layer of magnets.
    """

    name: str
    outer_radius: float
    permeability: float = 1.0
    curve: BHCurve | None = None
    magnets: Profile | None = None

    @property
    def air(self) -> bool:
        return self.curve is None and self.magnets is None and self.permeability == 1.0


@dataclass(frozen=True, slots=True)
class HelicalSection:
    """Layers from the inside out, and the displacement between the two members on either side of one of them.

    inner_radius : m, where the first layer begins; zero for the axis. gap : number of the layer of air between the
    members. period : m along the axis from a north band to the next. lead : m along the axis in one turn: the period
    times the number of starts, zero for rings, negative for a left-hand screw.
    displacement : m along ζ, of the outer member relative to the inner one; where both profiles agree, zero is the
    stable position.

    Raises DesignError for radii that do not increase, a gap that is not air or lies on a rim, and a period that is not
    a length.
    """

    inner_radius: float
    layers: tuple[Layer, ...]
    gap: int
    period: float
    lead: float
    displacement: float = 0.0
    inside: Boundary = "closed"
    outside: Boundary = "closed"

    def __post_init__(self) -> None:
        if not (isfinite(self.inner_radius) and self.inner_radius >= 0):
            raise DesignError(f"The inner radius must be a length or zero; got {self.inner_radius * 1e3:.6g} mm.")
        radii = self.radii
        for layer, (inner, outer) in zip(self.layers, pairwise(radii), strict=True):
            if not (isfinite(outer) and outer > inner):
                raise DesignError(
                    f'The layer "{layer.name}" must end beyond {inner * 1e3:.6g} mm, where it begins; '
                    f"got {outer * 1e3:.6g} mm."
                )
            if not (isfinite(layer.permeability) and layer.permeability > 0):
                raise DesignError(
                    f'The relative permeability of "{layer.name}" must be above zero; got {layer.permeability:.6g}.'
                )
        if not 0 < self.gap < len(self.layers) - 1:
            raise DesignError(
                f"The gap must lie between two layers of {len(self.layers)}, so its number must be from 1 to "
                f"{len(self.layers) - 2}; got {self.gap}."
            )
        if not self.layers[self.gap].air:
            raise DesignError(f'The gap must be air; the layer "{self.layers[self.gap].name}" is not.')
        if not (isfinite(self.period) and self.period > 0):
            raise DesignError(f"The period must be above zero; got {self.period * 1e3:.6g} mm.")
        if self.inner_radius == 0 and self.inside == "iron":
            raise DesignError("Beyond an inner radius of zero there is no iron: give it a layer of its own.")

    @property
    def radii(self) -> tuple[float, ...]:
        """m, one more than there are layers."""
        return (self.inner_radius, *(layer.outer_radius for layer in self.layers))

    @property
    def transfer_ratio(self) -> float:
        """h = lead/2π (m/rad)."""
        return self.lead / (2 * pi)

    @property
    def gap_radii(self) -> tuple[float, float]:
        """m, of the gap's inner and outer face."""
        radii = self.radii
        return radii[self.gap], radii[self.gap + 1]
