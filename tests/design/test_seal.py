"""The sealing fin in the bore: the paper's numbers."""

import pytest

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.seal import band_area, contact_area, deformed_length


def test_the_fin_of_table_iii(table_ii: HybridActuator) -> None:
    """Equation (4) with D_c': 0.412 mm of the rounded inputs, where the paper prints 0.407 mm; equation (5)."""
    assert deformed_length(table_ii) == pytest.approx(0.4123e-3, abs=5e-8)
    assert contact_area(table_ii) == pytest.approx(20.6e-6 * 0.4123 / 0.407, rel=2e-3)


def test_the_published_length_gives_the_published_area(table_ii: HybridActuator) -> None:
    """So the discrepancy is in equation (4)'s inputs, not in the area: 20.59 mm^2."""
    assert band_area(table_ii.cylinder.inner_diameter, 0.407e-3) == pytest.approx(20.59e-6, abs=5e-9)
