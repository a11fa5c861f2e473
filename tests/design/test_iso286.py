"""Limits of size against the tables of ISO 286-2 (a workshop's table, in micrometres)."""

import itertools

import pytest

from fluxbore.design.errors import DesignError
from fluxbore.design.iso286 import HOLES, SHAFTS, limits, standard_tolerance

MM, UM = 1e-3, 1e-6

PUBLISHED = """
10 H7 0 15      18 H7 0 18      18.001 H7 0 21  30 H7 0 21      50 H7 0 25      80 H7 0 30     120 H7 0 35
16 H8 0 27      6 H8 0 18       3 H8 0 14       400 H7 0 57     500 H7 0 63     25 H11 0 130   40 H9 0 62
20 F7 20 41     25 F8 20 53     12 G7 6 24      60 D10 100 220  16 E9 32 75     50 G6 9 25
20 f7 -41 -20   16 f7 -34 -16   8 f8 -35 -13    50 f7 -50 -25   20 g6 -20 -7    10 g6 -14 -5   8 h9 -36 0
16 h6 -11 0     25 h11 -130 0   40 d9 -142 -80  30 e8 -73 -40   60 h7 -30 0
50 js9 -31 31   10 js6 -4.5 4.5 25 JS7 -10.5 10.5
25 k6 2 15      10 k6 1 10      3 k6 0 6        40 k5 2 13      40 k8 0 39      100 k6 3 25
30 m6 8 21      16 m6 7 18      25 n6 15 28     30 p6 22 35     50 p6 26 42     8 p6 15 24     120 p7 37 72
30 r6 28 41     60 r6 41 60     70 r6 43 62     30 s6 35 48     60 s6 53 72     130 s6 92 117  500 r6 132 172
25 j6 -4 9      50 j7 -10 15    8 j5 -2 4       20 J7 -9 12     16 J8 -12 15    10 J6 -4 5
20 K7 -15 6     10 K7 -10 5     40 K6 -13 3     25 K8 -23 10    3 K7 -10 0
16 M7 -18 0     25 M6 -17 -4    30 M8 -29 4     300 M6 -41 -9   300 M7 -52 0    3 M7 -12 -2    60 M9 -85 -11
25 N7 -28 -7    10 N7 -19 -4    50 N9 -62 0     3 N9 -29 -4     8 N8 -25 -3
6 P7 -20 -8     30 P7 -35 -14   25 P6 -31 -18   20 P9 -74 -22   3 P7 -16 -6
"""


def test_classes_have_the_published_limits() -> None:
    words = PUBLISHED.split()
    rows = list(zip(*(words[i::4] for i in range(4)), strict=True))
    assert len(rows) == 83
    for nominal, tolerance, lower, upper in rows:
        found = limits(float(nominal) * MM, tolerance)
        assert found == pytest.approx((float(lower) * UM, float(upper) * UM), abs=1e-12), (nominal, tolerance)


@pytest.mark.parametrize("size", [0.5, 3, 3.1, 7, 18, 24, 50, 65, 66, 140, 250, 251, 355, 500])
def test_a_class_is_as_wide_as_its_grade_says(size: float) -> None:
    """Whatever the letter; and holes D to H mirror the shafts."""
    for letter in HOLES + SHAFTS:
        for grade in range(6, 8 if letter in "Jj" else 17):
            lower, upper = limits(size * MM, f"{letter}{grade}")
            assert upper - lower == pytest.approx(standard_tolerance(size * MM, grade), rel=1e-9)
    for letter in "defgh":
        lower, upper = limits(size * MM, f"{letter}7")
        assert limits(size * MM, f"{letter.upper()}7") == pytest.approx((-upper, -lower), abs=1e-15)


def test_grades_widen_with_number_and_size() -> None:
    sizes = [1, 4, 8, 14, 24, 40, 65, 100, 150, 200, 280, 350, 450]
    table = [[standard_tolerance(size * MM, grade) for size in sizes] for grade in range(1, 17)]
    assert all(fine < coarse for a, b in itertools.pairwise(table) for fine, coarse in zip(a, b, strict=True))
    assert all(row == sorted(row) for row in table)
    # From IT6 on each fifth grade is ten times as wide, but for rounding (ISO 286-1, 4.2.3): IT7 to IT12 exactly.
    assert table[11] == pytest.approx([10 * value for value in table[6]])


@pytest.mark.parametrize("word", ["H", "H0", "H17", "q7", "7H", "H7 ", "", "ZZ9", "j9", "J5", "h٣"])
def test_other_classes_are_refused_in_a_sentence(word: str) -> None:
    with pytest.raises(DesignError, match=r"^A tolerance class .*; got \".*\"\.$"):
        limits(10 * MM, word)


@pytest.mark.parametrize("size", [0.0, -1.0, 500.1, float("nan"), float("inf")])
def test_sizes_beyond_the_tables_are_refused(size: float) -> None:
    with pytest.raises(DesignError, match="at most 500 mm"):
        limits(size * MM, "H7")
