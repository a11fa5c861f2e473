"""How wire fills the window."""

from dataclasses import replace

import pytest

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.manufacture import winding_layers, winding_room


def test_the_prototypes_coil(table_ii: HybridActuator) -> None:
    """73 turns of 0.44 mm in 8 mm: 18.2 a layer, four layers of 1.77 mm in a window of 2.1 mm."""
    assert winding_layers(table_ii, 0.44e-3) == pytest.approx(4.015)
    assert winding_room(table_ii, 0.44e-3) == pytest.approx(2.1e-3 - 4.015 * 0.44e-3)
    assert winding_room(table_ii, 0.5e-3) < 0


def test_stacked_wires_fill_their_squares(table_ii: HybridActuator) -> None:
    """Catches a layer counted across the wrong side: turns x d^2 is layers x height x width whatever the coil."""
    wide = replace(table_ii, mover=replace(table_ii.mover, pole_pitch=0.03))
    for actuator in (table_ii, wide):
        height = winding_layers(actuator, 0.44e-3) * 0.44e-3
        assert height * actuator.coil_width == pytest.approx(actuator.turns_per_coil * 0.44e-3**2)
