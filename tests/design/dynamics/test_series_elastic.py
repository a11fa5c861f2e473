"""The plant's exact step against laws that hold for any step, and its equations against numerical integration."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fluxbore.design.dynamics.series_elastic import Environment, SeriesElastic, energy, exact_step, rates
from fluxbore.design.errors import DesignError

PLANT = SeriesElastic(7.68e-5, 2.55, 8.185e-4)
FOAM = Environment(2250.0, 0.1)
STIFFNESS = 234e3


def test_the_step_is_the_equations_of_motion():
    """(2)-(6) and (34) written out anew, with inputs on a line: catches a wrong sign or ratio in A or B."""
    step, before, after = 2e-3, np.array([0.02, 3.0, -1.0]), np.array([0.02, 5.0, 2.0])
    start = np.array([0.3, 2.0, 2e-4, 0.05])
    h = PLANT.transfer_ratio

    def motion(time, state):
        angle, speed, position, velocity = state
        # Over the step the rest and the friction go on as they came: from `after` on.
        torque, rest, friction = after + (after - before) * time / step
        spring = STIFFNESS * (h * angle - position) + rest
        load = FOAM.stiffness * position + FOAM.damping * velocity
        return [speed, (torque - h * spring) / PLANT.inertia, velocity, (spring - load - friction) / PLANT.mass]

    integrated = solve_ivp(motion, (0.0, step), start, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    exact = exact_step(PLANT, FOAM, STIFFNESS, step)
    found = exact.kept @ start + exact.held @ after + exact.sloped @ (after - before)
    assert found == pytest.approx(integrated, rel=1e-9)


def test_two_half_steps_are_one():
    half, whole = (exact_step(PLANT, FOAM, STIFFNESS, step) for step in (50e-6, 100e-6))
    assert half.kept @ half.kept == pytest.approx(whole.kept, rel=1e-12, abs=1e-15)
    assert half.kept @ half.held + half.held == pytest.approx(whole.held, rel=1e-10, abs=1e-16)


@pytest.mark.parametrize("step", [5e-6, 1e-2])
def test_without_damping_energy_stays(step):
    """At any length of step: the springs set no limit."""
    free = Environment(2250.0, 0.0)
    exact = exact_step(PLANT, free, STIFFNESS, step)
    states = [np.array([0.1, -3.0, 1e-4, 0.2])]
    for _ in range(500):
        states.append(exact.kept @ states[-1])
    kept = energy(PLANT, free, STIFFNESS, np.array(states))
    assert kept == pytest.approx(np.full(501, kept[0]), rel=1e-10)
    assert np.ptp(np.array(states)[:, 3]) > 1e-3


def test_natural_frequency_of_mover_on_the_magnetic_spring():
    """The rotor held: sqrt(K/M), 48 Hz, which the paper's own runs ring with."""
    heavy = SeriesElastic(1e6, PLANT.mass, PLANT.transfer_ratio)
    a, _ = rates(heavy, Environment(0.0, 0.0), STIFFNESS)
    assert np.abs(np.linalg.eigvals(a)).max() == pytest.approx(math.sqrt(STIFFNESS / PLANT.mass), rel=1e-6)


def test_values_that_no_plant_has_are_told():
    with pytest.raises(DesignError, match=r"rotor's inertia must be finite and above 0 kg m\^2; got 0"):
        SeriesElastic(0.0, 2.55, 8e-4)
    with pytest.raises(DesignError, match="environment's stiffness must be finite and 0 N/m or above; got -1 N/m"):
        Environment(-1.0, 0.0)
    with pytest.raises(DesignError, match="damping"):
        Environment(1.0, math.nan)
