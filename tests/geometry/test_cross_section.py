"""Cross-sections as stacks of rectangles."""

import pytest

from fluxbore.geometry.cross_section import AIR, Breakpoints, CoilWindow, Rectangle, Region, breakpoints, paint

R = Breakpoints((0.0, 1.0, 2.0, 3.0), ("a", "b", "c"))
Z = Breakpoints((-1.0, 0.0, 2.0), ("d", "e"))


def test_breakpoints_must_be_sorted_and_named() -> None:
    """Catches an interval of no or negative length, and one without a name."""
    for values, names in (((0.0, 0.0), ("a",)), ((1.0, 0.0), ("a",)), ((0.0, 1.0), ())):
        with pytest.raises(AssertionError):
            Breakpoints(values, names)


def test_neighbours_that_are_one_leave_no_interval() -> None:
    """Catches a vanished ring that leaves its name to its neighbour."""
    points = breakpoints([0.0, 1.0, 1.0 + 1e-12, 2.0, 2.0], ["shaft", "ring", "magnet", "gap"], 1e-9)
    assert points.values == (0.0, 1.0, 2.0)
    assert points.intervals == ("shaft", "magnet")


def test_paint_fills_exactly_the_rectangle() -> None:
    """Catches exchanged axes and a cell too many or too few."""
    iron = Region("iron", None)
    regions, cells = paint(R, Z, [Rectangle(iron, (1.0, 3.0), (-1.0, 0.0))])
    assert regions == (AIR, iron)
    assert cells.tolist() == [[0, 1, 1], [0, 0, 0]]


def test_later_rectangles_cover_earlier_ones() -> None:
    """Catches painting from the top down."""
    under, over = Region("under", None), Region("over", None)
    regions, cells = paint(R, Z, [Rectangle(under, (0.0, 3.0), (-1.0, 2.0)), Rectangle(over, (1.0, 2.0), (0.0, 2.0))])
    assert [regions[i].name for i in cells[1]] == ["under", "over", "under"]


def test_parts_of_one_region_share_its_number() -> None:
    """Catches a ring that becomes a region of its own in each of its places."""
    ring = Region("ring", None)
    regions, cells = paint(R, Z, [Rectangle(ring, (0.0, 1.0), (-1.0, 0.0)), Rectangle(ring, (2.0, 3.0), (0.0, 2.0))])
    assert len(regions) == 2
    assert cells.tolist() == [[1, 0, 0], [0, 0, 1]]


def test_coil_area() -> None:
    """Catches a diameter for a radius."""
    assert CoilWindow("U", 73, (0.010, 0.0121), (-0.004, 0.004)).area == pytest.approx(16.8e-6)
