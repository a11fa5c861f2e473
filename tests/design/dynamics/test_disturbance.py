"""The disturbance against its differential equation, integrated numerically."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fluxbore.design.dynamics.disturbance import LoadActuator, followed, triangle

STROKE = 1.05e-3


def test_the_command_goes_back_by_the_stroke_and_returns():
    time = np.array([0.0, 0.125, 0.25, 0.5, 0.75, 1.0]) / 0.5  # quarters of a round trip at 0.5 Hz, and one eighth
    assert triangle(time, STROKE, 0.5) == pytest.approx(
        [0.0, -STROKE / 4, -STROKE / 2, -STROKE, -STROKE / 2, 0.0], abs=1e-12
    )


@pytest.mark.parametrize("frequency, damping", [(3.6, 0.7), (1.0, 0.7), (3.0, 0.05), (3.6, 0.99)])
def test_closed_form_is_the_equations_solution(frequency, damping):
    """A wrong state after a corner shows in every ramp behind it."""
    load = LoadActuator(40.0, damping)
    ramp, angular = 0.5 / frequency, 2 * math.pi * 40.0
    state = [0.0, 0.0]
    for segment in range(3):
        since = np.linspace(0.0, ramp, 40)

        def rate(time, state, segment=segment):
            command = triangle(np.array([segment * ramp + min(max(time, 1e-12), ramp - 1e-12)]), STROKE, frequency)[0]
            return [state[1], angular**2 * (command - state[0]) - 2 * damping * angular * state[1]]

        solved = solve_ivp(rate, (0.0, ramp), state, t_eval=since, rtol=1e-10, atol=1e-14, max_step=2e-3)
        inside = since[1:-1]
        motion = followed(load, segment * ramp + inside, STROKE, frequency)
        assert motion.position == pytest.approx(solved.y[0, 1:-1], abs=1e-10)
        assert motion.velocity == pytest.approx(solved.y[1, 1:-1], abs=1e-8)
        command = triangle(segment * ramp + inside, STROKE, frequency)
        balance = angular**2 * (command - motion.position) - 2 * damping * angular * motion.velocity
        assert motion.acceleration == pytest.approx(balance, abs=1e-8)
        state = solved.y[:, -1]


def test_the_way_is_the_integral_of_the_velocity_at_every_corner():
    time = np.arange(0.0, 10 / 3.6, 1e-5)
    motion = followed(LoadActuator(40.0, 0.7), time, STROKE, 3.6)
    moved = np.cumsum((motion.velocity[1:] + motion.velocity[:-1]) / 2) * 1e-5
    assert np.max(np.abs(moved - motion.position[1:])) < 1e-9


def test_a_stiff_load_actuator_carries_out_the_command():
    time = np.linspace(0.0, 2.0, 1001)
    motion = followed(LoadActuator(1e4, 0.7), time, STROKE, 1.0)
    assert motion.position == pytest.approx(triangle(time, STROKE, 1.0), abs=1e-7)
