"""A part's size in words, as a parts list has it: diameters and length of its envelope; of a helix how it winds."""

from __future__ import annotations

import math

from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.outline import box
from fluxbore.geometry.part import Body

DIAMETER = "\N{LATIN CAPITAL LETTER O WITH STROKE}"
"""The sign as fonts have it; of the one that Unicode gives drawings, few know a shape."""


def size_text(part: Body) -> str:
    """ "Ø27 / Ø25 × 224 mm": outer and inner diameter and length."""
    inner, outer, low, high = box(part.profile)
    bore = f" / {DIAMETER}{2e3 * inner:.5g}" if inner > 0 else ""
    ring = f"{DIAMETER}{2e3 * outer:.5g}{bore} \N{MULTIPLICATION SIGN} {(high - low) * 1e3:.5g} mm"
    return f"{ring}, {winding_text(part)}" if isinstance(part, HelicalPart) else ring


def winding_text(part: HelicalPart) -> str:
    """How far it reaches around the axis, and of a helix its width and lead."""
    around = f"{math.degrees(part.angle):.4g}°" if part.angle <= math.tau else f"{part.angle / math.tau:.4g} turns"
    if part.lead == 0.0:
        return around
    return f"{around} of a helix {part.width * 1e3:.5g} mm wide, lead {part.lead * 1e3:.5g} mm"
