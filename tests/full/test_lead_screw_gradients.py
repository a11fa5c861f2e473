"""Exact gradients of lead screws with iron that saturates, arcs and several starts: minutes, so only when asked for."""

import pytest
from lead_screw_gradients import ARCS, SATURATED, check_every_figure, rotlin

pytestmark = pytest.mark.full

SAMPLED = ("demagnetised_fraction", "translator_iron_flux_density", "rotor_iron_flux_density", "force_ripple")
"""Counts, and of the closed form maxima over samples, which have a kink where the sample changes."""


@pytest.mark.parametrize("changes", [{}, SATURATED, ARCS])
def test_by_finite_elements(changes: dict[str, str]) -> None:
    """Catches a term that linear materials and touching magnets do not show."""
    check_every_figure("fem", rotlin(changes), 1e-6)


@pytest.mark.parametrize("changes", [{}, SATURATED, ARCS])
def test_by_the_closed_form(changes: dict[str, str]) -> None:
    """Catches a key that the closed form loses."""
    check_every_figure("network", rotlin(changes), 1e-6, SAMPLED)
