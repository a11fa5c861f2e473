"""The O-ring of a reciprocating piston in its groove: stretch, squeeze and fill, against a standard's limits.

    stretch  X = (d_groove - d_1)/d_1
    section  W' = W (1 - Y/100),  Y = 0.56 + 0.59 X - 0.0046 X^2 (3 to 25 %),
                                  Y = -0.005 + 1.19 X - 0.19 X^2 - 0.001 X^3 + 0.008 X^4 (below 3 %), X and Y in %
    squeeze  S = (W' - h)/W',     h = (D_bore - d_groove)/2
    fill     pi W'^2/4 / (b h)

The section's loss by stretching is the Parker O-Ring Handbook's (ORD 5700); so are the limits of a dynamic seal:
squeeze from 10 % up to 16 %, for thin rings up to 25 % (as quoted in Kutz, Mechanical Engineers' Handbook, chapter on
seal technology), stretch up to 5 % in place, and up to 85 % of the groove filled, which leaves room to swell and
expand. Glands of ISO 3601-2 for reciprocating hydraulic seals follow the same three rules. Valid for round sections of
1 to 7 mm at nominal sizes; a production drawing is held against the standard's own tables, with tolerances.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.errors import DesignError

LEAST_SQUEEZE, LARGEST_SQUEEZE, LARGEST_THIN = 0.10, 0.16, 0.25
THIN = 2e-3
"""m; rings of this section and below are squeezed by up to `LARGEST_THIN`."""
LARGEST_STRETCH = 0.05
LARGEST_FILL = 0.85


@dataclass(frozen=True, slots=True)
class SealGland:
    """Lengths in m.

    bore : of the cylinder. groove_diameter : of the groove's floor. groove_width : b, axial. ring_inner_diameter,
    ring_section : d_1 and W of the free ring.
    """

    bore: float
    groove_diameter: float
    groove_width: float
    ring_inner_diameter: float
    ring_section: float

    def __post_init__(self) -> None:
        for name in ("bore", "groove_diameter", "groove_width", "ring_inner_diameter", "ring_section"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise DesignError(f"actuator.seal.{name} must be finite and above 0 mm; got {value * 1e3:g} mm.")
        if not self.groove_diameter < self.bore:
            raise DesignError(
                f"actuator.seal.groove_diameter must be below the bore, {self.bore * 1e3:.6g} mm; "
                f"got {self.groove_diameter * 1e3:.6g} mm."
            )


@dataclass(frozen=True, slots=True)
class GlandFigures:
    """Shares, not per cent; section : W' of the ring in place (m)."""

    stretch: float
    section: float
    squeeze: float
    fill: float


def gland_figures(gland: SealGland) -> GlandFigures:
    """At the nominal sizes."""
    stretch = (gland.groove_diameter - gland.ring_inner_diameter) / gland.ring_inner_diameter
    section = gland.ring_section * (1 - section_loss(stretch))
    depth = (gland.bore - gland.groove_diameter) / 2
    squeeze = (section - depth) / section
    fill = math.pi / 4 * section**2 / (gland.groove_width * depth)
    return GlandFigures(stretch, section, squeeze, fill)


def section_loss(stretch: float) -> float:
    """Share of its section's diameter that a ring loses by a stretch; that of constant volume, 1 - 1/sqrt(1 + X),
    where it is compressed, and beyond the handbook's 25 %."""
    percent = stretch * 100
    if 0.03 <= stretch <= 0.25:
        return (0.56 + 0.59 * percent - 0.0046 * percent**2) / 100
    if 0 <= stretch < 0.03:
        loss = -0.005 + 1.19 * percent - 0.19 * percent**2 - 0.001 * percent**3 + 0.008 * percent**4
        return max(loss, 0.0) / 100
    return 1 - 1 / math.sqrt(1 + stretch)


def check_gland(gland: SealGland) -> GlandFigures:
    """The figures; raises DesignError, one sentence, for the first limit that they break."""
    found = gland_figures(gland)
    most = LARGEST_THIN if gland.ring_section <= THIN else LARGEST_SQUEEZE
    if not LEAST_SQUEEZE <= found.squeeze <= most:
        raise DesignError(
            f"actuator.seal.groove_diameter must squeeze the ring by {LEAST_SQUEEZE:.0%} to {most:.0%} of "
            f"its section; got {found.squeeze:.1%}."
        )
    if not 0 <= found.stretch <= LARGEST_STRETCH:
        raise DesignError(
            f"actuator.seal.ring_inner_diameter must be stretched by 0% to {LARGEST_STRETCH:.0%} in its groove; "
            f"got {found.stretch:.1%}."
        )
    if not found.fill <= LARGEST_FILL:
        raise DesignError(
            f"actuator.seal.groove_width must leave the groove filled by {LARGEST_FILL:.0%} or less; "
            f"got {found.fill:.1%}."
        )
    return found


def designed_gland(bore: float, section: float, *, squeeze: float = 0.14, stretch: float = 0.02) -> SealGland:
    """A gland for a bore and a ring's section (m), with a squeeze and a stretch, and a groove filled to 75 %."""
    placed = section * (1 - section_loss(stretch))
    depth = placed * (1 - squeeze)
    groove = bore - 2 * depth
    if not groove > 0:
        raise DesignError(
            f"actuator.seal.ring_section must leave a groove's floor in a bore of {bore * 1e3:.6g} mm; "
            f"got {section * 1e3:.6g} mm."
        )
    width = math.pi / 4 * placed**2 / (0.75 * depth)
    return SealGland(bore, groove, width, groove / (1 + stretch), section)


def designed_rod_gland(rod: float, section: float, *, squeeze: float = 0.14, stretch: float = 0.02) -> SealGland:
    """The same around a rod (m), its groove in what surrounds the rod: the ring lies stretched on the rod as it would
    on a groove's floor, so that `groove_diameter` is the rod's and `bore` that of the groove's floor."""
    deep = designed_gland(100 * section, section, squeeze=squeeze, stretch=stretch)
    depth = (deep.bore - deep.groove_diameter) / 2
    return SealGland(rod + 2 * depth, rod, deep.groove_width, rod / (1 + stretch), section)
