"""Air through roughness: the flow against integration along the gap, the gap against the law it inverts."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from fluxbore.design.seal_leakage import AIR_VISCOSITY, GAMMA, gap, leakage, wear_rate

ATMOSPHERE = 101_325.0

ROUGH = (0.4e-6, 0.1e-3)


def test_the_flow_is_that_of_the_pressure_gradient_along_the_gap() -> None:
    """Parallel plates, mass flow constant, density as pressure: integrated from the chamber to the atmosphere."""
    bore, band, opening, chamber = 16.1e-3, 0.41e-3, 0.5e-6, 0.6e6 + ATMOSPHERE
    found = leakage(bore, band, opening, 0.6e6)

    def gradient(z: float, p: list[float]) -> list[float]:
        volume = found * ATMOSPHERE / p[0]
        return [-12 * AIR_VISCOSITY * volume / (math.pi * bore * opening**3)]

    path = solve_ivp(gradient, (0, band), [chamber], rtol=1e-10, atol=1e-6)
    assert path.y[0, -1] == pytest.approx(ATMOSPHERE, rel=1e-6)


def test_a_slight_pressure_drives_as_it_does_a_liquid() -> None:
    expected = math.pi * 16.1e-3 * (1e-6) ** 3 * 10.0 / (12 * AIR_VISCOSITY * 0.4e-3)
    assert leakage(16.1e-3, 0.4e-3, 1e-6, 10.0) == pytest.approx(expected, rel=1e-4)


@given(pressure=st.floats(1e3, 1e5))
def test_the_gap_keeps_the_exponential_law(pressure: float) -> None:
    """p = beta E* exp(-u/u_0), far below beta E*: at most p / (beta E*) beside it."""
    height, wavelength = ROUGH
    effective = 0.6e9 / (1 - 0.46**2)
    prefactor = math.pi * height / wavelength * effective
    u = gap(height, wavelength, pressure, 0.6e9, 0.46)
    assert prefactor * math.exp(-u / (GAMMA * height)) == pytest.approx(pressure, rel=1.1 * pressure / prefactor)


@given(pressure=st.floats(1.0, 1e9), more=st.floats(1.01, 10))
def test_pressure_closes_the_gap_and_roughness_opens_it(pressure: float, more: float) -> None:
    height, wavelength = ROUGH
    u = gap(height, wavelength, pressure, 0.6e9, 0.46)
    assert 0 < gap(height, wavelength, more * pressure, 0.6e9, 0.46) < u
    assert gap(more * height, wavelength, pressure, 0.6e9, 0.46) > u


def test_what_the_prefactor_is_worth() -> None:
    """The statement of the docstring: twice the prefactor, a third of the roughness more gap."""
    height, wavelength = ROUGH
    shift = gap(height, wavelength / 2, 1e4, 0.6e9, 0.46) - gap(height, wavelength, 1e4, 0.6e9, 0.46)
    assert shift == pytest.approx(height / 3, rel=0.01)


def test_wear_is_volume_over_force_and_distance() -> None:
    """10 N over 20 mm^2, 1e-7 mm^3/(N m): 1 mm^3 in 1000 km of it, 0.05 um off per kilometre."""
    assert wear_rate(1e-16, 10 / 20e-6) == pytest.approx(0.05e-6 / 1e3)
