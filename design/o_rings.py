"""O-rings as they are ordered: sizes of AS568, which ISO 3601-1 has taken over, and which of them suits a groove."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.seal_gland import LARGEST_STRETCH, SealGland
from fluxbore.design.units import format_quantity

MM = 1e-3

SAME = 5e-6
"""m, within which a size is a standard's."""

_SIZES = {
    1.78: (
        4,
        "1.78 2.57 2.90 3.68 4.47 5.28 6.07 7.65 9.25 10.82 12.42 14.00 15.60 17.17 18.77 20.35 21.95 23.52 25.12 "
        "26.70 28.30 29.87 31.47 33.05 34.65 37.82 41.00 44.17 47.35 50.52 53.70 56.87 60.05 63.22 66.40 69.57 72.75 "
        "75.92 82.27 88.62 94.97 101.32 107.67 114.02 120.37 126.72 133.07",
    ),
    2.62: (
        102,
        "1.24 2.06 2.84 3.63 4.42 5.23 6.02 7.59 9.19 10.77 12.37 13.94 15.54 17.12 18.72 20.29 21.89 23.47 25.07 "
        "26.64 28.24 29.82 31.42 32.99 34.59 36.17 37.77",
    ),
    3.53: (
        201,
        "4.34 5.94 7.52 9.12 10.69 12.29 13.87 15.47 17.04 18.64 20.22 21.82 23.39 24.99 26.57 28.17 29.74 31.34 32.92 "
        "34.52 36.09 37.69",
    ),
}
"""Section (mm) -> the first dash number, and inner diameters (mm) from it on."""


@dataclass(frozen=True, slots=True)
class ORing:
    """number : AS568's dash number. inner_diameter, section (m)."""

    number: int
    inner_diameter: float
    section: float


O_RINGS: tuple[ORing, ...] = tuple(
    ORing(first + i, float(inner) * MM, section * MM)
    for section, (first, sizes) in _SIZES.items()
    for i, inner in enumerate(sizes.split())
)
"""By section, then by size."""


def fitting(gland: SealGland) -> ORing | None:
    """The largest ring of the gland's section that its groove stretches, by no more than the handbook's 5 %."""
    return next(
        (
            ring
            for ring in reversed(O_RINGS)
            if abs(ring.section - gland.ring_section) < SAME
            and 0 <= gland.groove_diameter / ring.inner_diameter - 1 <= LARGEST_STRETCH
        ),
        None,
    )


def designation(gland: SealGland) -> str:
    """What to order for a gland: a standard's ring, with its stretch where the drawing has another, or its sizes."""
    ring = fitting(gland)
    if ring is None:
        return f"O-ring {_mm(gland.ring_inner_diameter)} x {_mm(gland.ring_section)}"
    name = f"O-ring AS568-{ring.number:03d}, {_mm(ring.inner_diameter)} x {_mm(ring.section)}"
    if abs(ring.inner_diameter - gland.ring_inner_diameter) < SAME:
        return name
    return f"{name} (stretched by {gland.groove_diameter / ring.inner_diameter - 1:.1%})"


def _mm(length: float) -> str:
    return format_quantity(length, "length", 4)
