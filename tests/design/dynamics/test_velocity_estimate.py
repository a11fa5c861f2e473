"""The controller's velocity."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.dynamics.velocity_estimate import VelocityEstimate

COUNT, PERIOD = 5.4e-6, 1e-3


@given(st.floats(-20e-3, 20e-3), st.floats(0, 1, exclude_max=True))
def test_a_constant_speed_comes_out_in_the_mean(speed, phase):
    """Whatever the phase: a filter of no unit gain, or counts that are lost, would show."""
    time = PERIOD * np.arange(20001)
    found = VelocityEstimate(COUNT, PERIOD, 0.031)(speed * time, phase)
    assert np.mean(found[10001:]) == pytest.approx(speed, abs=2 * COUNT / (10000 * PERIOD) + 1e-3 * abs(speed))


def test_without_a_filter_it_is_counts_per_period():
    position = COUNT * np.array([0.0, 0.4, 0.6, 1.7, -0.6])
    found = VelocityEstimate(COUNT, PERIOD, 0.0)(position, 0.5)
    assert found == pytest.approx(np.array([0.0, 0.0, 1.0, 1.0, -3.0]) * COUNT / PERIOD)


def test_the_filter_lets_a_reversal_through_after_its_time_constant():
    """v (1 - 2 exp(-t/T)) after a reversal: the sign turns at T ln 2."""
    time = PERIOD * np.arange(4001)
    position = 20e-3 * np.where(time < 2.0, time, 4.0 - time)
    found = VelocityEstimate(1e-9, PERIOD, 0.05)(position, 0.0)
    turned = time[np.flatnonzero((found < 0) & (time > 2.0))[0]] - 2.0
    assert turned == pytest.approx(0.05 * np.log(2), abs=1.5 * PERIOD)
