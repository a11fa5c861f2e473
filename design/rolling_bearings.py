"""Deep groove ball bearings of ISO 15's dimension series 18, the thin ones that a rotor's journal takes."""

from __future__ import annotations

from dataclasses import dataclass

MM = 1e-3

_SERIES_18 = """
61800 10 19 5     61801 12 21 5     61802 15 24 5     61803 17 26 5     61804 20 32 7     61805 25 37 7
61806 30 42 7     61807 35 47 7     61808 40 52 7     61809 45 58 7     61810 50 65 7     61811 55 72 9
61812 60 78 10    61813 65 85 10    61814 70 90 10    61815 75 95 10    61816 80 100 10   61817 85 110 13
61818 90 115 13   61819 95 120 13   61820 100 125 13
"""
"""Designation, bore, outside diameter and width in mm; boundary dimensions by ISO 15, designations as makers share."""


@dataclass(frozen=True, slots=True)
class Bearing:
    """designation : what to order; none ("") of one that is not chosen yet. bore, outer_diameter, width (m)."""

    designation: str
    bore: float
    outer_diameter: float
    width: float


def _table() -> dict[str, Bearing]:
    words = _SERIES_18.split()
    rows = (words[i : i + 4] for i in range(0, len(words), 4))
    return {name: Bearing(name, *(float(size) * MM for size in sizes)) for name, *sizes in rows}


BEARINGS: dict[str, Bearing] = _table()
"""By designation."""

OUTSIDE, WIDTH = 1.29, 0.16
"""Of the bore, of one that is not chosen: about those of the series in its middle, 61808 to 61811."""


def in_proportion(bore: float) -> Bearing:
    """One like the series', of any bore (m)."""
    return Bearing("", bore, OUTSIDE * bore, WIDTH * bore)
