"""The load's force from the spring's: balance, filters, friction, and one sample at a time."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from fluxbore.design.dynamics.load_observer import LoadObserver, SmoothedCoulomb, at_rest, observe, observe_record
from fluxbore.design.errors import DesignError

Floats = NDArray[np.float64]

TABLE_II = LoadObserver(1e-4)
NO_FRICTION = SmoothedCoulomb(0.0, 1.0, 0.0)


def test_a_steady_acceleration_is_taken_off_the_spring_s_force() -> None:
    """M x'' = F_s - F_l - F_f: 20 N on 2.55 kg at 3 m/s^2 against 0.85 N leave 11.5 N for the load."""
    time = np.arange(5000) * 1e-4
    load = observe_record(TABLE_II, np.full(5000, 20.0), 1.5 * time**2)
    assert load[-1] == pytest.approx(20.0 - 2.55 * 3.0 - 0.85, abs=1e-3)


def test_at_a_steady_speed_the_friction_is_taken_off() -> None:
    """(29) at 5 mm/s, either way: gamma_2 keeps it below its level."""
    time = np.arange(5000) * 1e-4
    for speed in (5e-3, -5e-3):
        friction = math.copysign(0.8 * math.tanh(1.0) + 0.05, speed)
        assert observe_record(TABLE_II, np.full(5000, 20.0), speed * time)[-1] == pytest.approx(20.0 - friction)


def test_at_rest_the_load_is_the_spring_s_force_through_the_filter() -> None:
    """(27) with x = 0: gain and phase of g_L/(s + g_L) at 50, 200 and 800 rad/s."""
    for angular in (50.0, 200.0, 800.0):
        time = np.arange(6000) * 1e-4
        load = observe_record(TABLE_II, np.sin(angular * time), np.zeros(6000))
        gain = 200.0 / (200.0 + 1j * angular)
        expected = np.imag(gain * np.exp(1j * angular * time))
        assert load[3000:] == pytest.approx(expected[3000:], abs=1e-3)


def test_the_filter_is_exact_for_straight_signals_at_any_period() -> None:
    """Corners of the force on a coarse grid; a filter that holds its input would lag by half of it."""
    corners = np.random.default_rng(2).normal(0.0, 10.0, 60)
    fine = np.interp(np.arange(59 * 50 + 1) / 50, np.arange(60), corners)
    coarse_load = observe_record(LoadObserver(5e-3), corners, np.zeros(60))
    fine_load = observe_record(LoadObserver(1e-4), fine, np.zeros(len(fine)))
    assert coarse_load == pytest.approx(fine_load[::50], abs=1e-10)


def test_sample_by_sample_is_the_record() -> None:
    """Random forces and positions on encoder counts."""
    generator = np.random.default_rng(7)
    force = np.cumsum(generator.normal(0.0, 1.0, 3000))
    position = 0.01 + np.round(np.cumsum(generator.normal(0.0, 2.0, 3000))) * 1e-6
    state = at_rest(float(force[0]), float(position[0]))
    stepped = [float(force[0])]
    for f, x in zip(force[1:].tolist(), position[1:].tolist(), strict=True):
        state, load = observe(TABLE_II, state, f, x)
        stepped.append(load)
    record = observe_record(TABLE_II, force, position)
    assert record == pytest.approx(np.array(stepped), abs=1e-10 * float(np.max(np.abs(record))))


def test_an_empty_record() -> None:
    assert observe_record(TABLE_II, [], []).tolist() == []


@pytest.mark.parametrize("name", ["period", "mass", "cutoff", "speed_cutoff"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan])
def test_what_is_no_observer_is_refused(name: str, value: float) -> None:
    values = {"period": 1e-4, name: value}
    with pytest.raises(DesignError, match=f"{name} of a load observer must be finite and above 0; got"):
        LoadObserver(**values)
