"""Derivatives in preferred units, against the difference of two texts that the file's own reader gives."""

import pytest

from fluxbore.design.hybrid_keys import HYBRID_KEYS
from fluxbore.design.performance import FIGURES
from fluxbore.design.rates import handy_step, measure, measure_of_figure, measure_of_key, show_rate
from fluxbore.design.units import DIMENSIONS

KEYS = {key.name: key for key in HYBRID_KEYS}
RING, HEAT = KEYS["actuator.mover.ring_width"], KEYS["operating_point.magnet_temperature"]


@pytest.mark.parametrize("key", [key for key in HYBRID_KEYS if key.kind == "quantity"], ids=lambda key: key.name)
def test_a_step_in_the_preferred_unit_is_what_the_reader_makes_of_it(key):
    """Catches a temperature's step of 1 degC that is 274 K."""
    step = key.difference
    assert measure_of_key(key).factor == pytest.approx(step.read(f"1 {DIMENSIONS[step.dimension].preferred}"))


def test_rates_say_both_units():
    assert show_rate("force_constant", RING, -302.1) == "-0.3021 N/A per mm"
    assert show_rate("stray_field", RING, 0.2) == "+0.2 mT per mm"
    assert show_rate("yoke_flux_density", RING, 150.0) == "+0.15 T per mm"
    assert show_rate("total_mass", RING, 2.5) == "+2.5 g per mm"
    assert show_rate("demagnetised_fraction", HEAT, 0.02) == "+2 % per K"
    assert show_rate("copper_loss", KEYS["operating_point.current"], 16.0) == "+16 W per A"
    assert show_rate("turns", KEYS["actuator.mover.magnet_permeability"], 0.0) == "+0 per unit"


def test_every_figure_has_a_unit_for_its_differences():
    """Catches a new dimension of figures whose rates would be printed as bare SI numbers."""
    bare = {name for name in FIGURES if measure_of_figure(name).unit == ""}
    assert bare == {name for name, figure in FIGURES.items() if figure.dimension not in DIMENSIONS} - {
        name for name, figure in FIGURES.items() if figure.dimension in ("fraction", "power")
    }


def test_handy_steps_are_tenths_or_less():
    length = measure("length")
    assert handy_step(0.027, length) == pytest.approx(1e-3)
    assert handy_step(0.0005, length) == pytest.approx(1e-5)
    assert handy_step(0.001, length) == pytest.approx(1e-4)
    assert handy_step(-4.2e-4, measure("flux density", 4.2e-4)) == pytest.approx(1e-5)
    assert handy_step(0.0, length) == 1e-3
    assert length.show(1e-5) == "0.01 mm"
