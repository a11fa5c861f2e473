"""The chamber against its mass balance, integrated numerically, and at its limits."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fluxbore.design.dynamics.chamber import ATMOSPHERE, Chamber, pressures, swelling

AREA = math.pi / 4 * 0.016**2


def moved(time):
    """Position (m) and its rate (m/s)."""
    return 1e-3 * np.sin(20 * time), 20e-3 * np.cos(20 * time)


def wanted(time):
    return 2e5 + 1e4 * np.sin(9 * time)


@pytest.mark.parametrize("volume", [30e-6, 1e-6])
def test_pressure_follows_the_mass_balance(volume):
    chamber = Chamber(volume, AREA, 1.4, 0.14)

    def rate(time, pressure):
        position, speed = moved(time)
        swept = AREA * speed / (volume + AREA * position)
        return (wanted(time) - pressure) / 0.14 - 1.4 * (pressure + ATMOSPHERE) * swept

    time = np.linspace(0.0, 1.0, 10001)
    exact = solve_ivp(rate, (0.0, 1.0), [2e5], t_eval=time, rtol=1e-10, atol=1e-6).y[0]
    between = wanted((time[1:] + time[:-1]) / 2)
    found = pressures(chamber, between, swelling(chamber, moved(time)[0]), 1e-4, 2e5)
    assert np.ptp(exact) > 1e3
    assert found == pytest.approx(exact, abs=1e-4 * np.ptp(exact))


def test_a_shut_valve_leaves_the_polytrope():
    chamber = Chamber(5e-6, AREA, 1.3, 1e9)
    position = np.linspace(0.0, -10e-3, 101)
    found = pressures(chamber, np.full(100, 1e5), swelling(chamber, position), 1e-3, 1e5)
    volume = 5e-6 + AREA * position
    assert found + ATMOSPHERE == pytest.approx((1e5 + ATMOSPHERE) * (5e-6 / volume) ** 1.3, rel=1e-9)


def test_a_piston_at_rest_leaves_the_lag():
    chamber = Chamber(5e-6, AREA, 1.4, 0.1)
    found = pressures(chamber, np.full(200, 3e5), np.ones(201), 1e-3, 1e5)
    assert found == pytest.approx(3e5 - 2e5 * np.exp(-1e-3 * np.arange(201) / 0.1))
