"""Numbers and words as the page shows them."""

from __future__ import annotations

import math

import pytest

from fluxbore.reports.content import ReportContent
from fluxbore.reports.wording import DASH, change, duration, figure_scale, key_range, key_scale, listing, significant


@pytest.mark.parametrize(
    ("figure", "value", "shown"),
    [
        ("stray_field", 0.02131, "21.31\u00a0mT"),
        ("yoke_flux_density", 1.6204, "1.620\u00a0T"),
        ("moving_mass", 0.17312, "173.1\u00a0g"),
        ("winding_resistance", 5.5534, "5.553\u00a0Ω"),
        ("motor_constant", 3.0041, "3.004\u00a0N/√W"),
        ("demagnetised_fraction", 0.0123, "1.23\u00a0%"),
        ("turns", 584.0, "584"),
        ("electric_loading", 7546.0, "7.546\u00a0kA/m"),
        ("thrust_density", 241.71e3, "241.7\u00a0kN/m³"),
        ("force_constant_density", 16.2154e3, "16.22\u00a0kN/(A m³)"),
        ("seal_wear", 0.14742e-9, "0.1474\u00a0µm/km"),
        ("fin_contact_area", 20.855e-6, "20.86\u00a0mm²"),
        ("cogging_force", -0.0, "0.0\u00a0N"),
        ("force_constant", None, DASH),
        ("force_constant", math.nan, DASH),
    ],
)
def test_figures_stand_in_the_unit_of_an_engineer(figure: str, value: float | None, shown: str) -> None:
    """Catches SI on the page, digits that nobody measured, minus zero and nan."""
    assert figure_scale(figure, [value]).quantity(value) == shown


def test_one_row_has_one_unit_and_digits_for_its_smallest() -> None:
    """Catches a row in which 10.66 takes a digit from 8.670."""
    scale = figure_scale("force_constant", [8.6704, 10.659])
    assert [scale.number(value) for value in (8.6704, 10.659)] == ["8.670", "10.659"]


def test_keys_keep_the_decimals_they_need(content: ReportContent) -> None:
    """Catches 0.62 mm shown as 0.6 mm because its neighbour needs one decimal only."""
    ring = "actuator.mover.ring_width"
    assert key_scale(content.spec, ring, [0.00062]).quantity(0.00062) == "0.62\u00a0mm"
    assert key_range(content.spec, ring, 0.5e-3, 6e-3) == "0.5 to 6\u00a0mm"
    assert key_scale(content.spec, ring, [1e-3 / 3]).number(1e-3 / 3) == "0.333"


def test_changes_are_signed() -> None:
    """Catches a loss that reads as a gain, and a per cent of nothing."""
    assert change(8.0, 9.0) == "+12.5\u00a0%"
    assert change(8.0, 7.96) == "−0.50\u00a0%"
    assert change(8.0, 8.0) == "±0\u00a0%"
    assert change(0.0, 1.0) == change(None, 1.0) == change(1.0, math.inf) == ""


def test_small_words() -> None:
    """Catches slips in the rest of the vocabulary."""
    assert significant(2.1e-11, 2) == "2.1·10⁻¹¹"
    assert significant(5.4e7, 3) == "5.40·10⁷"
    assert duration(125.4) == "2 min 5 s"
    assert listing(["a", "b", "c"]) == "a, b and c"
