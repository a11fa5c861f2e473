"""The sampled observer against what it observes, and its two forms against one another."""

import math

import numpy as np
import pytest

from fluxbore.design.dynamics.disturbance_observer import DisturbanceObserver, observed, streamed
from fluxbore.design.errors import DesignError

OBSERVER = DisturbanceObserver(0.0387, 7.68e-5, 1000.0)


def test_stream_and_log_agree_to_rounding():
    random = np.random.default_rng(1)
    current, speed = random.normal(size=300), random.normal(size=300)
    step = streamed(OBSERVER, 1e-4)
    one_by_one = [step(i, omega) for i, omega in zip(current.tolist(), speed.tolist(), strict=True)]
    assert observed(OBSERVER, current, speed, 1e-4) == pytest.approx(np.array(one_by_one), rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("period", [1e-5, 1e-4, 3e-3])
def test_a_constant_load_is_seen_through_the_filter(period):
    """A rotor that speeds up under a load D and a current: d = D (1 - e^{-g t}) at any period, exactly."""
    load, current = 5e-3, 0.4
    time = period * np.arange(200)
    speed = (OBSERVER.torque_constant * current - load) / OBSERVER.inertia * time
    held = np.where(time > 0, current, 0.0)
    found = observed(OBSERVER, held, speed, period)
    assert found == pytest.approx(load * -np.expm1(-OBSERVER.cutoff * time), rel=1e-9, abs=1e-12)


def test_another_inertia_is_seen_as_a_load():
    """An observer that takes the rotor for lighter than it is sees the rest of its inertia."""
    lighter = DisturbanceObserver(0.0387, 0.5 * OBSERVER.inertia, 1000.0)
    acceleration = 100.0
    time = 1e-4 * np.arange(400)
    current = np.full(400, OBSERVER.inertia * acceleration / OBSERVER.torque_constant)
    assert observed(OBSERVER, current, acceleration * time, 1e-4)[-1] == pytest.approx(0.0, abs=1e-12)
    assert observed(lighter, current, acceleration * time, 1e-4)[-1] == pytest.approx(
        0.5 * OBSERVER.inertia * acceleration, rel=1e-9
    )


@pytest.mark.parametrize("values", [(0.0, 1e-5, 1e3), (0.04, -1e-5, 1e3), (0.04, 1e-5, math.inf)])
def test_values_that_no_observer_has_are_told(values):
    with pytest.raises(DesignError, match=r"The observer's .* must be finite and above 0"):
        DisturbanceObserver(*values)
