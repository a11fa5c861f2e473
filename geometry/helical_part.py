"""A part that follows a helix: a piece of a tube over a polygon in the unrolled plane (θ, z).

Its long sides are helicoids, or planes where there is no lead; ends may be generators, as of an arc, or flat. Volume
and centre are closed: r dr dθ dz integrates to (r_2² − r_1²)/2 times the polygon's area, whatever the lead.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fluxbore.design.errors import DesignError
from fluxbore.geometry import unrolled
from fluxbore.geometry.outline import RESOLUTION, Profile
from fluxbore.geometry.unrolled import Outline

if TYPE_CHECKING:
    from fluxbore.geometry.part import Colour


@dataclass(frozen=True, slots=True)
class HelicalPart:
    """A helical band or arc about z; the fields that it shares with `Part` mean the same.

    inner_radius, outer_radius : m. outline : convex, counter-clockwise in (θ, z), rad and m. lead : m per turn of its
    long sides, 0 for a ring's sector; only words depend on it.

    Raises DesignError where there is no such body, or where it runs into itself a turn farther on.
    """

    name: str
    role: str
    group: str
    material: str
    colour: Colour
    inner_radius: float
    outer_radius: float
    outline: Outline
    lead: float = 0.0
    note: str = ""
    fill: float = 1.0
    bought: str = ""

    def __post_init__(self) -> None:
        if not 0 < self.inner_radius < self.outer_radius < math.inf:
            raise DesignError(
                f"The {self.name} must have an outer radius beyond its inner one and both off the axis; got "
                f"{self.inner_radius * 1e3:g} and {self.outer_radius * 1e3:g} mm."
            )
        if not unrolled.is_convex(self.outline):
            raise DesignError(f"The outline of the {self.name} around the axis must be convex and counter-clockwise.")
        # A convex polygon that meets any whole turn of itself meets the first.
        if overlapping(unrolled.shared(self.outline, unrolled.moved(self.outline, unrolled.TURN, 0.0)), self):
            raise DesignError(f"The {self.name} must not run into itself after a turn.")

    @property
    def profile(self) -> Profile:
        """The ring that just holds it: its envelope in the half plane (r, z), where nothing else may be (m)."""
        low, high = unrolled.heights(self.outline)
        inner, outer = self.inner_radius, self.outer_radius
        return (inner, low), (outer, low), (outer, high), (inner, high)

    @property
    def angle(self) -> float:
        """How far it reaches around the axis (rad), whole turns counted."""
        low, high = unrolled.reach(self.outline)
        return high - low

    @property
    def width(self) -> float:
        """Along the axis at its middle (m)."""
        low, high = unrolled.reach(self.outline)
        return max(top - bottom for bottom, top in unrolled.spans(self.outline, (low + high) / 2))


def volume(part: HelicalPart) -> float:
    """m^3, exact."""
    return (part.outer_radius**2 - part.inner_radius**2) / 2 * unrolled.area(part.outline)


def centre_of_mass(part: HelicalPart) -> tuple[float, float, float]:
    """(x, y, z) of the homogeneous part (m), exact."""
    inner, outer = part.inner_radius, part.outer_radius
    cosine, sine, height = unrolled.centre(part.outline)
    radius = 2 / 3 * (outer**2 + outer * inner + inner**2) / (outer + inner)
    return radius * cosine, radius * sine, height


def overlapping(common: Outline, part: HelicalPart) -> bool:
    """Whether what a part's outline has in common with another is more than touching sides or corners."""
    if len(common) < 3:
        return False
    (left, right), (low, high) = unrolled.reach(common), unrolled.heights(common)
    around = (right - left) * part.inner_radius
    if min(around, high - low) < RESOLUTION:
        return False
    return part.inner_radius * unrolled.area(common) > RESOLUTION * (around + high - low)
