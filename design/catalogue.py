"""Sizes in which tubes, shafts, wire and hose are sold, each table with the standard or the trade that it is from.

They are facts for choosing, not an offer: not every maker has every size in every metal. Lengths in m.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

MM = 1e-3
INCH = 25.4e-3


@dataclass(frozen=True, slots=True)
class Size:
    """One that can be ordered. designation : how. lengths : what it measures, by name (m)."""

    designation: str
    lengths: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Catalogue:
    """name : what is sold. source : whose sizes they are. sizes : all of them."""

    name: str
    source: str
    sizes: tuple[Size, ...]


def _size(designation: str, **lengths: float) -> Size:
    return Size(designation, MappingProxyType(lengths))


def _mm(length: float) -> float:
    """From millimetres, rounded so that 6.3 mm is the float that a specification reads."""
    return round(length * MM, 9)


_SHAFTS_MM = (3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20, 25, 30, 35, 40, 50, 60)
_SHAFTS_INCH = {"1/8": 1 / 8, "3/16": 3 / 16, "1/4": 1 / 4, "5/16": 5 / 16, "3/8": 3 / 8, "1/2": 1 / 2}

SHAFTS = Catalogue(
    "precision shaft",
    "diameters of shafts for linear bearings, metric and in inches; ground to h6",
    (
        *(_size(f"precision shaft {d} h6", outer=_mm(d)) for d in _SHAFTS_MM),
        *(_size(f"precision shaft {name} in h6", outer=_mm(d * INCH / MM)) for name, d in _SHAFTS_INCH.items()),
    ),
)

_TUBES = (4, 5, 6, 8, 10, 12, 14, 15, 16, 18, 20, 22, 25, 28, 30, 32, 35, 38, 40, 42, 45, 48, 50, 55, 60, 70, 80)
_WALLS = (0.5, 0.8, 1, 1.2, 1.5, 1.8, 2, 2.2, 2.5, 2.8, 3, 3.5, 4, 4.5, 5)
_TUBES_INCH = {
    "1/4": 1 / 4,
    "5/16": 5 / 16,
    "3/8": 3 / 8,
    "7/16": 7 / 16,
    "1/2": 1 / 2,
    "9/16": 9 / 16,
    "5/8": 5 / 8,
    "3/4": 3 / 4,
    "7/8": 7 / 8,
    "1": 1.0,
}
_WALLS_INCH = (0.028, 0.032, 0.035, 0.049, 0.065)

THICKEST = 0.25
"""Of the outer diameter: thicker walls are not drawn as tubes."""


def _tube(name: str, outer: float, wall: float) -> Size:
    """Of an outer diameter and a wall in mm."""
    return _size(f"drawn tube {name}", outer=_mm(outer), inner=_mm(outer - 2 * wall), wall=_mm(wall))


TUBES = Catalogue(
    "drawn tube",
    "outer diameters and walls of EN 10305-1 (cold-drawn precision steel tube), in which aluminium and brass are drawn "
    "too, and inch tubes of the trade",
    (
        *(_tube(f"{d} x {w:g}", d, w) for d in _TUBES for w in _WALLS if w <= THICKEST * d),
        *(
            _tube(f"{name} in x {w:g} in", d * INCH / MM, w * INCH / MM)
            for name, d in _TUBES_INCH.items()
            for w in _WALLS_INCH
            if w <= THICKEST * d
        ),
    ),
)

_WIRES = {
    0.1: 0.117,
    0.112: 0.130,
    0.125: 0.144,
    0.14: 0.160,
    0.16: 0.182,
    0.18: 0.204,
    0.2: 0.226,
    0.224: 0.252,
    0.25: 0.281,
    0.28: 0.312,
    0.315: 0.349,
    0.355: 0.392,
    0.4: 0.439,
    0.45: 0.491,
    0.5: 0.544,
    0.56: 0.606,
    0.63: 0.679,
    0.71: 0.762,
    0.8: 0.855,
    0.9: 0.959,
    1.0: 1.062,
    1.12: 1.184,
    1.25: 1.316,
    1.4: 1.468,
    1.6: 1.670,
}

WIRES = Catalogue(
    "enamelled wire",
    "IEC 60317-0-1: nominal diameters of the conductor and largest overall diameters of grade 1",
    tuple(_size(f"enamelled wire {d:g}, grade 1", bare=_mm(d), insulated=_mm(over)) for d, over in _WIRES.items()),
)

_HOSES = (3.2, 4, 5, 6.3, 8, 10, 12.5, 16, 20, 25)

HOSES = Catalogue(
    "hose", "nominal bores of ISO 1307", tuple(_size(f"hose of {d:g} mm bore", inner=_mm(d)) for d in _HOSES)
)
