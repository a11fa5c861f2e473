"""Thin ball bearings: the table, and what stands for one that is not chosen."""

import pytest

from fluxbore.design.rolling_bearings import BEARINGS, in_proportion

MM = 1e-3


def test_the_table_is_that_of_the_series() -> None:
    """Bore codes of ISO 15 (from 04 on the bore is five times the code), sizes that grow with it."""
    assert len(BEARINGS) == 21
    for name, bearing in BEARINGS.items():
        code = int(name[3:])
        if code >= 4:
            assert bearing.bore == pytest.approx(5 * code * MM)
        assert bearing.bore < bearing.outer_diameter
        assert bearing.width < (bearing.outer_diameter - bearing.bore)
    sizes = [(bearing.bore, bearing.outer_diameter, bearing.width) for bearing in BEARINGS.values()]
    assert sizes == sorted(sizes)
    assert [size[2] for size in sizes] == sorted(size[2] for size in sizes)


def test_one_that_is_not_chosen_is_like_its_neighbours() -> None:
    for bearing in BEARINGS.values():
        if bearing.bore >= 20 * MM:
            like = in_proportion(bearing.bore)
            assert like.outer_diameter == pytest.approx(bearing.outer_diameter, rel=0.25)
            assert like.width == pytest.approx(bearing.width, rel=0.6)
