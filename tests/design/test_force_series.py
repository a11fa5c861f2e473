"""The sum of harmonics as a spring: force, stiffness and energy belong together, and so do peak and rest."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.force_series import ForceSeries

PITCH = 36e-3 / 7

series = st.builds(
    lambda first, second, third, orders: ForceSeries(first * np.array([1.0, second, third]), PITCH, orders),
    st.floats(1, 1e4),
    st.floats(0, 0.3),
    st.floats(0, 0.1),
    st.sampled_from([None, (1, 3, 2)]),
)


@given(spring=series, place=st.floats(-2, 2))
def test_force_is_the_slope_of_the_energy_and_stiffness_that_of_the_force(spring: ForceSeries, place: float) -> None:
    x, step = place * PITCH, 1e-5 * PITCH
    scale = float(np.sum(spring.amplitude))
    slope = (spring.energy(x + step) - spring.energy(x - step)) / (2 * step)
    assert float(slope) == pytest.approx(float(spring.force(x)), abs=1e-6 * scale)
    slope = (spring.force(x + step) - spring.force(x - step)) / (2 * step)
    assert float(slope) == pytest.approx(float(spring.stiffness(x)), abs=1e-6 * scale * spring.wave[-1])
    slope = (spring.stiffness(x + step) - spring.stiffness(x - step)) / (2 * step)
    assert float(slope) == pytest.approx(spring.curvature(x), abs=1e-6 * scale * spring.wave[-1] ** 2)


@given(spring=series)
def test_no_force_exceeds_the_peak(spring: ForceSeries) -> None:
    """With harmonics so large that the top falls in and two tops stand beside it."""
    top, force = spring.peak
    assert 0 < top <= PITCH / (4 if spring.orders is None else 2)
    least = 1 - 1e-9 if spring.orders is None else 1 - 1e-3
    assert force >= np.max(spring.force(np.linspace(0, PITCH, 5001))) * least
    assert abs(spring.stiffness(top)) < 1e-6 * np.sum(spring.amplitude) * spring.wave[-1]
    assert float(spring.force(top)) == force


@given(spring=series, share=st.floats(-1, 1))
def test_rest_bears_the_load_and_is_stable(spring: ForceSeries, share: float) -> None:
    load = share * spring.peak[1]
    rest = spring.rest(load)
    assert rest is not None
    assert float(spring.force(rest)) == pytest.approx(load, rel=1e-9, abs=1e-9 * spring.peak[1])
    assert abs(rest) <= spring.peak[0]
    assert float(spring.stiffness(rest)) >= -1e-6 * spring.peak[1] * spring.wave[0]


def test_load_beyond_the_peak_has_no_rest() -> None:
    spring = ForceSeries(np.array([100.0]), PITCH)
    assert spring.rest(100.1) is None
    assert spring.rest(-100.1) is None
    assert spring.rest(0.0) == 0.0


def test_one_harmonic_is_the_sinusoidal_model() -> None:
    """Equation (14): peak at a quarter of the pitch (12), stiffness F_stall/h, barrier 2 F_stall h."""
    h, x = PITCH / (2 * np.pi), np.linspace(-PITCH, PITCH, 101).reshape(1, 101)
    spring = ForceSeries(np.array([192.0]), PITCH)
    assert spring.force(x) == pytest.approx(192 * np.sin(x / h), abs=1e-10)
    assert spring.peak == (pytest.approx(PITCH / 4), pytest.approx(192.0))
    assert float(spring.stiffness(0.0)) == pytest.approx(192 / h)
    assert spring.barrier == pytest.approx(2 * 192 * h)
    assert float(spring.energy(1e-9)) == pytest.approx(192 / h * 1e-18 / 2, rel=1e-9)
