"""The O-ring as it lies squeezed between the floor of its groove and the bore: a stadium of the ring's own area.

The ring is flattened to the groove's depth h and gets wider by what the flattening takes away,

    A = pi W'^2/4 = h (w - h) + (area of a circle of h),

so that the drawn ring fills the groove by exactly the share that `fluxbore.design.seal_gland` computes. Rubber is
incompressible and the ring's middle stays where it is, which makes that fair; how it bulges is not computed.
"""

from __future__ import annotations

import math

from fluxbore.design.seal_gland import SealGland, gland_figures
from fluxbore.geometry.outline import Profile

CHORDS = 12
"""Of each rounded end; even."""


def ring_size(gland: SealGland) -> tuple[float, float]:
    """Height h and width w (m) of the ring in place. A ring that the groove does not squeeze stays nearly round."""
    section = gland_figures(gland).section
    height = min((gland.bore - gland.groove_diameter) / 2, section)
    rounded = height**2 / 4 * CHORDS * math.sin(math.pi / CHORDS)  # both ends, as the chords have them
    return height, height + (math.pi / 4 * section**2 - rounded) / height


def ring_profile(gland: SealGland, middle: float) -> Profile:
    """The squeezed ring on the floor of its groove, with its middle at this height z (m), counter-clockwise."""
    height, width = ring_size(gland)
    radius, straight = height / 2, (width - height) / 2
    centre = gland.groove_diameter / 2 + radius
    points = []
    for end in (1, -1):  # from the outside over the upper end inwards, then over the lower one back
        for step in range(CHORDS + 1):
            angle = math.pi * step / CHORDS
            points.append(
                (centre + end * radius * math.cos(angle), middle + end * (straight + radius * math.sin(angle)))
            )
    return tuple(points)
