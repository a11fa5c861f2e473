"""Steps of force in simulated time: their end, speed and error, the step's size, and the linear theory."""

import math
from dataclasses import replace

import numpy as np
import pytest
from rotlin_stand import ROTLIN

from fluxbore.design.dynamics.bouc_wen import states
from fluxbore.design.dynamics.force_control import NO_FRICTION, force_loop
from fluxbore.design.dynamics.force_stand import controller_of, stand_of
from fluxbore.design.dynamics.force_step import simulate_step
from fluxbore.design.dynamics.force_step_figures import dominant_pole, step_figures
from fluxbore.design.dynamics.guides import Guides
from fluxbore.design.dynamics.linearised import FILTERED, UNFILTERED, force_transfer
from fluxbore.design.dynamics.magnetic_spring import LinearSpring
from fluxbore.design.errors import DesignError
from fluxbore.design.poles import poles

PARAMETERS = ROTLIN
STAND = stand_of(PARAMETERS, distorted=False)
CONTROLLER = controller_of(PARAMETERS)
EXACT = replace(STAND, angle_count=0.0, position_count=0.0)
FREE = replace(EXACT, guides=Guides())
KNOWING_NONE = replace(CONTROLLER, friction=NO_FRICTION)
FORCES = [50.0, 100.0]

STIFFER = replace(FREE, environment=replace(STAND.environment, stiffness=20e3))
SETTLED = 2.0
"""s, in which a force on the stiffer load is at its end: what is left at rest is no matter of the load."""


def hysteresis_share(run):
    """What (17) gives less than the sine at the end of a run's own way (N): (1 - w) of two sines, with x_s along the
    record as a whole."""
    p, h = PARAMETERS, PARAMETERS.transfer_ratio
    state = states(STAND.spring.memory, h * run.angle - run.position)[-1]
    return (1 - p.elastic_share) * (p.stall_force * math.sin(state / h) - run.reference)


@pytest.mark.parametrize("force", FORCES)
def test_the_prototype_reaches_its_force(force):
    """The accepted figures of the issue, with friction and encoders: time, error and overshoot."""
    found = step_figures(simulate_step(STAND, CONTROLLER, force, 8.0))
    pole = dominant_pole(STAND.plant, STAND.environment, CONTROLLER, force)
    assert found.t63 == pytest.approx(-1 / pole.real, rel=0.08)
    assert -0.04 * force < found.error < 0
    assert found.overshoot < 0.01


@pytest.mark.parametrize("force", FORCES)
def test_the_error_is_the_hysteresis_that_the_controller_does_not_know(force):
    """Without it nothing is left; with it the law along the way gone says how much; and the guides' friction,
    which holds the mover from behind, comes on top."""
    plain = step_figures(simulate_step(replace(STIFFER, spring=STAND.spring.law), KNOWING_NONE, force, SETTLED))
    assert plain.error == pytest.approx(0.0, abs=1e-3)
    run = simulate_step(STIFFER, KNOWING_NONE, force, SETTLED)
    remembering = step_figures(run)
    assert remembering.error < -0.01 * force
    assert remembering.error == pytest.approx(hysteresis_share(run), abs=1e-3)
    rubbing = step_figures(simulate_step(replace(STIFFER, guides=STAND.guides), CONTROLLER, force, SETTLED))
    held = PARAMETERS.friction
    assert -1.02 * held < rubbing.error - remembering.error < -0.9 * held


@pytest.mark.parametrize("stand, controller", [(FREE, KNOWING_NONE), (EXACT, CONTROLLER)])
def test_the_size_of_the_step_does_not_matter(stand, controller):
    """5 us to 50 us, and the control period itself, to a hundredth of a newton of every force."""
    finest = simulate_step(stand, controller, 100.0, 0.3, 5e-6)
    assert np.ptp(finest.spring_force) > 30
    for step in (10e-6, 25e-6, 50e-6, 100e-6):
        found = simulate_step(stand, controller, 100.0, 0.3, step)
        assert np.abs(found.force - finest.force).max() < 0.01
        assert np.abs(found.spring_force - finest.spring_force).max() < 0.01


@pytest.mark.parametrize("observer_speed", [UNFILTERED, FILTERED])
def test_a_fast_controller_is_the_linear_theory(observer_speed):
    """With a linear spring the derived transfer function tells every force of the run, the closer the shorter the
    control period: two routes that share nothing but the parameters."""
    p = PARAMETERS
    linear = replace(FREE, spring=LinearSpring(p.stall_force / p.transfer_ratio))
    reference = 0.1  # small: the arcsine is a line
    ratio = force_transfer(force_loop(STAND.plant, STAND.environment, CONTROLLER), observer_speed)
    at = poles(ratio.denominator, 100.0)
    steepness = np.polynomial.polynomial.polyval(at, np.polynomial.polynomial.polyder(ratio.denominator))
    residues = np.polynomial.polynomial.polyval(at, ratio.numerator) / steepness / at

    def missed(period):
        controller = replace(KNOWING_NONE, observer_speed=observer_speed, period=period)
        run = simulate_step(linear, controller, reference, 0.2)
        expected = reference * (1 + (residues * np.exp(np.outer(run.time, at))).sum(axis=1).real)
        return np.abs(run.force - expected).max() / reference

    coarse, fine = missed(40e-6), missed(20e-6)
    assert fine < 2e-4
    assert coarse / fine == pytest.approx(2, rel=0.1)


@pytest.mark.parametrize("observer_speed, stable", [(UNFILTERED, True), (FILTERED, False)])
def test_a_stiff_wall_makes_the_filtered_observer_ring_up(observer_speed, stable):
    """The ringing pole's real part, read off the sampled loop and carried to a period of zero, is the linear one."""
    p = PARAMETERS
    wall = replace(
        FREE,
        environment=replace(STAND.environment, stiffness=5e6),
        spring=LinearSpring(p.stall_force / p.transfer_ratio),
    )

    def growth(period):
        controller = replace(KNOWING_NONE, observer_speed=observer_speed, period=period)
        run = simulate_step(wall, controller, 1.0, 4.0)
        early, late = (np.ptp(run.force[(run.time > start) & (run.time < start + 0.2)]) for start in (0.8, 3.6))
        return math.log(late / early) / 2.8

    coarse, fine = growth(100e-6), growth(50e-6)
    pole = dominant_pole(wall.plant, wall.environment, CONTROLLER, observer_speed=observer_speed)
    assert (coarse < 0) == (fine < 0) == (pole.real < 0) == stable
    assert 2 * fine - coarse == pytest.approx(pole.real, abs=0.01)


def test_pushing_and_pulling_are_alike():
    forward, backward = (simulate_step(EXACT, CONTROLLER, force, 0.5) for force in (80.0, -80.0))
    assert -backward.force == pytest.approx(forward.force, rel=1e-9, abs=1e-9)


def test_a_distortion_that_is_known_does_not_matter_at_the_end():
    """(31) with x_d0 takes away what the poles' distortion puts in, and without it does not."""

    def wavy(angle):
        return 2e-5 * (math.sin(angle + 1.0) - math.sin(1.0))

    bent = replace(STIFFER, distortion=lambda angle, position: wavy(angle))
    even, blind = (step_figures(simulate_step(stand, KNOWING_NONE, 50.0, SETTLED)) for stand in (STIFFER, bent))
    knowing = step_figures(simulate_step(bent, replace(KNOWING_NONE, distortion=wavy), 50.0, SETTLED))
    assert abs(blind.error - even.error) > 1.0
    assert knowing.error == pytest.approx(even.error, abs=0.05)


def test_guides_hold_what_they_can():
    """A force below the guides' level moves the mover by its bristles alone."""
    held = replace(EXACT, guides=Guides(5.0, 85e3, 30.0))
    run = simulate_step(held, KNOWING_NONE, 2.0, 3.0)
    assert run.position[-1] < 2.0 / 85e3 * 1.5
    assert run.spring_force[-1] == pytest.approx(2.0, abs=0.1)


def test_runs_that_cannot_be_are_told():
    for step in (30e-6, 0.0, -1e-5, math.nan, 200e-6):
        with pytest.raises(DesignError, match=r"a whole share of the control period 0\.0001 s; got"):
            simulate_step(STAND, CONTROLLER, 50.0, 1.0, step)
    with pytest.raises(DesignError, match="duration of a run must be finite and above 0 s; got 0 s"):
        simulate_step(STAND, CONTROLLER, 50.0, 0.0)
    with pytest.raises(DesignError, match="at most the stall force less the friction"):
        simulate_step(STAND, CONTROLLER, 192.0, 1.0)
