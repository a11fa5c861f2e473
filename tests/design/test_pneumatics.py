"""Chamber forces against the paper, and against the work that the compressed volumes give."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.pneumatics import advance_force, chamber_volumes, retract_force


def test_published_forces_at_six_bar_gauge(table_ii: HybridActuator) -> None:
    """Catches the drawing's bore (122 and 92 N), absolute pressure, and a shaft on both sides."""
    assert advance_force(table_ii, 0.6e6) == pytest.approx(120.64, abs=0.01)
    assert retract_force(table_ii, 0.6e6) == pytest.approx(90.48, abs=0.01)
    drawing = replace(table_ii, cylinder=replace(table_ii.cylinder, inner_diameter=16.2e-3))
    assert advance_force(drawing, 0.6e6) == advance_force(table_ii, 0.6e6)


@given(offset=st.floats(-40e-3, 40e-3), pressure=st.floats(1e4, 1e6))
def test_force_is_the_work_of_the_volume(table_ii: HybridActuator, offset: float, pressure: float) -> None:
    """Catches an area or a direction in which force and volume disagree: F = p dV/dz, by central differences."""
    z, step = table_ii.mid_stroke + offset, 1e-4
    (cap_0, rod_0), (cap_1, rod_1) = chamber_volumes(table_ii, z - step), chamber_volumes(table_ii, z + step)
    assert pressure * (cap_1 - cap_0) / (2 * step) == pytest.approx(advance_force(table_ii, pressure), rel=1e-9)
    assert pressure * (rod_0 - rod_1) / (2 * step) == pytest.approx(retract_force(table_ii, pressure), rel=1e-9)


def test_chambers_vanish_at_the_ends_of_the_stroke(table_ii: HybridActuator) -> None:
    """Catches a stroke that is counted from the wrong face or without the pistons."""
    half = table_ii.mover.stroke / 2
    cap, rod = chamber_volumes(table_ii, table_ii.mid_stroke - half)
    assert cap == pytest.approx(0.0, abs=1e-18)
    assert rod == pytest.approx(table_ii.mover.stroke * 150.80e-6, rel=1e-4)
    cap, rod = chamber_volumes(table_ii, table_ii.mid_stroke + half)
    assert rod == pytest.approx(0.0, abs=1e-18)
    assert cap == pytest.approx(table_ii.mover.stroke * 201.06e-6, rel=1e-4)
