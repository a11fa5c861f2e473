"""Limits of size by ISO 286-1:2010: standard tolerances IT1 to IT16 and fundamental deviations up to 500 mm.

A class such as "H7" is a letter, where the tolerance lies, and a grade, how wide it is. Capitals are holes, small
letters shafts. The tables are those of the standard (its Tables 1 to 5), in micrometres; of holes only what does not
follow from the shafts of the same letter:

    D E F G H   EI = -es of the shaft                 JS js   ± IT/2
    K M N P     ES = -ei of the shaft + Delta,        Delta = IT_n - IT_(n-1) up to IT8 (P: up to IT7), else 0

Lengths are in metres outside this file's tables.
"""

from __future__ import annotations

import re
from bisect import bisect_left

from fluxbore.design.errors import DesignError, shown
from fluxbore.design.units import format_quantity

LARGEST = 0.5
"""m; nominal sizes beyond follow other tables."""

MICROMETRE = 1e-6

_STEPS = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
"""mm, the upper ends of the ranges of nominal sizes, each of which belongs to its range."""

_FINE_STEPS = (3, 6, 10, 18, 30, 50, 65, 80, 100, 120, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400, 450, 500)
"""The same for r and s."""

_GRADES: tuple[tuple[float, ...], ...] = (
    (0.8, 1, 1, 1.2, 1.5, 1.5, 2, 2.5, 3.5, 4.5, 6, 7, 8),
    (1.2, 1.5, 1.5, 2, 2.5, 2.5, 3, 4, 5, 7, 8, 9, 10),
    (2, 2.5, 2.5, 3, 4, 4, 5, 6, 8, 10, 12, 13, 15),
    (3, 4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20),
    (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
    (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155),
    (40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250),
    (60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400),
    (100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570, 630),
    (140, 180, 220, 270, 330, 390, 460, 540, 630, 720, 810, 890, 970),
    (250, 300, 360, 430, 520, 620, 740, 870, 1000, 1150, 1300, 1400, 1550),
    (400, 480, 580, 700, 840, 1000, 1200, 1400, 1600, 1850, 2100, 2300, 2500),
    (600, 750, 900, 1100, 1300, 1600, 1900, 2200, 2500, 2900, 3200, 3600, 4000),
)
"""IT1 to IT16."""

_UPPER = {
    "d": (-20, -30, -40, -50, -65, -80, -100, -120, -145, -170, -190, -210, -230),
    "e": (-14, -20, -25, -32, -40, -50, -60, -72, -85, -100, -110, -125, -135),
    "f": (-6, -10, -13, -16, -20, -25, -30, -36, -43, -50, -56, -62, -68),
    "g": (-2, -4, -5, -6, -7, -9, -10, -12, -14, -15, -17, -18, -20),
    "h": (0,) * 13,
}
"""es of shafts below the zero line."""

_LOWER = {
    "k": (0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5),
    "m": (2, 4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21, 23),
    "n": (4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37, 40),
    "p": (6, 12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62, 68),
}
"""ei of shafts above it; k in grades 4 to 7, else 0."""

_LOWER_FINE = {
    "r": (10, 15, 19, 23, 28, 34, 41, 43, 51, 54, 63, 65, 68, 77, 80, 84, 94, 98, 108, 114, 126, 132),
    "s": (14, 19, 23, 28, 35, 43, 53, 59, 71, 79, 92, 100, 108, 122, 130, 140, 158, 170, 190, 208, 232, 252),
}

_J_SHAFT = {
    5: (-2, -2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20),
    6: (-2, -2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20),
    7: (-4, -4, -5, -6, -8, -10, -12, -15, -18, -21, -26, -28, -32),
}
"""ei by grade."""

_J_HOLE = {
    6: (2, 5, 5, 6, 8, 10, 13, 16, 18, 22, 25, 29, 33),
    7: (4, 6, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39, 43),
    8: (6, 10, 12, 15, 20, 24, 28, 34, 41, 47, 55, 60, 66),
}
"""ES by grade."""

HOLES = ("D", "E", "F", "G", "H", "J", "JS", "K", "M", "N", "P")
SHAFTS = ("d", "e", "f", "g", "h", "j", "js", "k", "m", "n", "p", "r", "s")

_CLASS = re.compile(r"([A-Za-z]{1,2})([0-9]{1,2})")


def limits(nominal: float, tolerance: str) -> tuple[float, float]:
    """(lower, upper) deviation (m) from a nominal size (m) in a class such as "H8".

    Raises DesignError where there is no such class, or none for this size.
    """
    letter, grade = _split(tolerance)
    if not 0 < nominal <= LARGEST * (1 + 1e-12):
        raise DesignError(
            f"A size with the tolerance {tolerance} must be above 0 mm and at most 500 mm; "
            f"got {format_quantity(nominal, 'length', 6)}."
        )
    place = _place(nominal, _STEPS)
    width = _GRADES[grade - 1][place]
    if letter in ("JS", "js"):
        return -width / 2 * MICROMETRE, width / 2 * MICROMETRE
    if letter in HOLES:
        lower, upper = _hole(letter, grade, nominal, place)
    else:
        lower, upper = _shaft(letter, grade, nominal, place)
    if lower is None:
        assert upper is not None
        lower = upper - width
    return lower * MICROMETRE, (lower + width if upper is None else upper) * MICROMETRE


def standard_tolerance(nominal: float, grade: int) -> float:
    """IT (m) of a grade from 1 to 16 at a nominal size (m) up to 500 mm."""
    return _GRADES[grade - 1][_place(nominal, _STEPS)] * MICROMETRE


def _split(tolerance: str) -> tuple[str, int]:
    """Letter and grade of a class. Raises DesignError for another word."""
    found = _CLASS.fullmatch(tolerance)
    letter, grade = (found.group(1), int(found.group(2))) if found else ("", 0)
    if letter not in HOLES + SHAFTS or not 1 <= grade <= len(_GRADES):
        raise DesignError(
            f"A tolerance class must be a letter of {', '.join(HOLES)} (holes) or {', '.join(SHAFTS)} (shafts) and a "
            f"grade from 1 to {len(_GRADES)}; got {shown(tolerance)}."
        )
    grades = {"J": _J_HOLE, "j": _J_SHAFT}.get(letter)
    if grades is not None and grade not in grades:
        words = ", ".join(f"{letter}{number}" for number in grades)
        raise DesignError(f"A tolerance class with the letter {letter} must be one of {words}; got {shown(tolerance)}.")
    return letter, grade


def _place(nominal: float, steps: tuple[int, ...]) -> int:
    """The range that a nominal size (m) is in; rounding does not lift 18 mm into the next."""
    return bisect_left(steps, nominal * 1e3 * (1 - 1e-12))


def _shaft(letter: str, grade: int, nominal: float, place: int) -> tuple[float | None, float | None]:
    """(ei, es) in µm, the one that follows from the other None."""
    if letter in _UPPER:
        return None, _UPPER[letter][place]
    if letter == "j":
        return _J_SHAFT[grade][place], None
    if letter == "k" and not 4 <= grade <= 7:
        return 0, None
    return _ei(letter, nominal, place), None


def _ei(letter: str, nominal: float, place: int) -> float:
    if letter in _LOWER_FINE:
        return _LOWER_FINE[letter][_place(nominal, _FINE_STEPS)]
    return _LOWER[letter][place]


def _hole(letter: str, grade: int, nominal: float, place: int) -> tuple[float | None, float | None]:
    """(EI, ES) in µm, the one that follows from the other None."""
    small = letter.lower()
    if small in _UPPER:
        return -_UPPER[small][place], None
    if letter == "J":
        return None, _J_HOLE[grade][place]
    coarse = grade > (7 if letter == "P" else 8)
    if coarse and letter == "K":
        return None, 0
    if coarse and letter == "N" and place > 0:
        return None, 0
    if (letter, grade, place) == ("M", 6, 10):  # the standard's one exception, 250 to 315 mm
        return None, -9
    shift = 0.0 if coarse or place == 0 or grade == 1 else _GRADES[grade - 1][place] - _GRADES[grade - 2][place]
    return None, -_ei(small, nominal, place) + shift
