"""What the benchmark of the force refuses, each in one sentence with key, limit and value."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from rotlin_stand import ROTLIN

from fluxbore.design.dynamics.estimation_run import run_plant
from fluxbore.design.dynamics.estimation_trials import detect, pressing, to_and_fro
from fluxbore.design.dynamics.force_benchmark import simulate
from fluxbore.design.dynamics.force_limits import check
from fluxbore.design.dynamics.force_stand import controller_of, stand_of
from fluxbore.design.dynamics.force_step import simulate_step
from fluxbore.design.dynamics.screw_hold import holds, lost
from fluxbore.design.errors import DesignError, SpecError


def test_the_paper_s_own_are_not_refused():
    check(ROTLIN)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            {"third_peak": 190.0},
            "third_peak must be below the largest force of (17) less the guides' friction, 185.77",
        ),
        ({"first_peak": 185.8}, "first_peak must be below the largest force of (17)"),
        ({"lower_peak": 250.0}, "lower_peak must be below the largest force of (17)"),
        (
            {"load_stiffness": 2000.0},
            "third_peak must press the load no further than the way over which all poles are engaged, 74.7143 mm; "
            "got 165 N, which takes 82.5 mm.",
        ),
        (
            {"first_step": 186.0},
            "first_step must be below what the screw holds less its friction, 185.779 N; got 18",
        ),
        ({"second_step": 185.0, "smooth_friction": 10.0}, "second_step must be below what the screw holds less its"),
        ({"second_loop": 192.0}, "second_loop must be below the stall force, 192 N; got 192 N."),
        ({"second_step": 50.0}, "second_step must be another than benchmark.force.first_step, 50 N; got 50 N."),
        ({"first_loop": 165.0}, "second_loop must be another than benchmark.force.first_loop, 165 N; got 165 N."),
        ({"duration": 0.05}, "duration must be at least 1000 control periods, 0.1 s; got 0.05 s."),
        ({"frequency": 0.04}, "frequency must be at least that of half a movement in a run, 0.05 Hz; got 0.04 Hz."),
        ({"xi": 3001.0}, "xi must be at most benchmark.force.psi, 3000 1/m; got 3001 1/m."),
        ({"third_peak": float("nan")}, "third_peak must be below the largest force"),
    ],
)
def test_what_the_screw_cannot_do_is_refused(changes, sentence):
    with pytest.raises(SpecError, match=re.escape(f"benchmark.force.{sentence}")) as caught:
        check(replace(ROTLIN, **changes))
    assert str(caught.value).count(". ") == 0


def test_runs_that_never_end_are_refused_before_they_begin():
    """Catches an array of a billion samples that is made before anybody asks."""
    with pytest.raises(DesignError, match=r"at most 5000000 steps in time; got 2e\+09, 2 in each control period"):
        pressing(replace(ROTLIN, duration=1e5), 45.0, 1e5)
    with pytest.raises(DesignError, match="at most 5000000 steps in time"):
        to_and_fro(ROTLIN, 1e-6)
    with pytest.raises(DesignError, match="at most 5000000 steps in time"):
        pressing(replace(ROTLIN, mass=1e-12), 45.0, 10.0)


def test_the_run_that_cannot_be_is_named():
    """Catches a slip of which nobody knows where."""
    with pytest.raises(
        DesignError, match=r"^benchmark\.force cannot be run as it is given, in the unloaded runs: A run must"
    ):
        simulate(replace(ROTLIN, detection_speed=1e-6), 1)


def test_a_short_way_tells_the_line_too():
    """Catches the way to the start of the unloaded runs taken for one of them: a stiff load leaves them 7 mm."""
    short = replace(ROTLIN, load_stiffness=22.5e3)
    line = detect(short).distortion
    angle = np.linspace(0.0, line.last, 2000)
    apart = line(angle) - short.zero_force_line(angle, short.transfer_ratio * angle)
    assert float(np.sqrt(np.mean(apart**2))) < 0.5e-6


def test_a_screw_that_slips_is_told():
    """A rotor that runs away from a heavy mover, by more than half of the pitch."""
    with pytest.raises(DesignError, match=r"The screw slips: after 0\.\d+ s .* further apart than half of the pitch"):
        run_plant(replace(ROTLIN, mass=1000.0), np.linspace(0, 200, 4000))


@pytest.mark.parametrize(
    ("angle", "displacement", "sentence"),
    [
        (0.0, 2.6e-3, "The screw slips: after 0.2 s rotor and mover are further apart than half of the pitch, 2.5 mm."),
        (0.0, -2.6e-3, "The screw slips"),
        (0.0, math.nan, "The screw slips"),
        (
            2e6,
            0.0,
            "The control does not hold the rotor at a period of 0.0001 s: it turns by more than 1e+06 rad within",
        ),
        (math.nan, math.nan, "The control does not hold the rotor"),
    ],
)
def test_what_is_lost_is_told(angle, displacement, sentence):
    """Catches numbers that are none, which compare as neither too large nor too small."""
    assert holds(0.0, 2.4e-3, 2.5e-3)
    assert not holds(angle, displacement, 2.5e-3)
    assert str(lost(angle, 2.5e-3, 1e-4, 2000)).startswith(sentence)


@pytest.mark.parametrize("changes", [{"position_gain": 1e6}, {"speed_gain": 1e4}, {"control_period": 0.02}])
def test_a_control_that_shakes_the_rotor_off_is_told(changes):
    """Catches numbers that grow beyond what sines and counters take, and end in a traceback."""
    wild = replace(ROTLIN, **changes)
    with pytest.raises(DesignError, match=r"^The screw slips: after"):
        simulate_step(stand_of(wild), controller_of(wild), 50.0, 1.0)
    with pytest.raises(DesignError, match=r"^The screw slips: after"):
        run_plant(wild, pressing(wild, 165.0, 10.0))


@pytest.mark.parametrize(
    "change", [{"friction": 0.0}, {"position_count": 0.0, "angle_count": 0.0}, {"distortion": 0.0}]
)
def test_an_ideal_stand_runs_too(change):
    """Catches a division by what a specification may set to zero."""
    ideal = replace(ROTLIN, **change)
    run = run_plant(ideal, pressing(ideal, 45.0, 10.0)[:1000])
    assert np.all(np.isfinite(run.load))
    step = simulate_step(stand_of(ideal), controller_of(ideal), 50.0, 0.1)
    assert np.all(np.isfinite(step.force))


def test_another_exponent_of_the_hysteresis_runs_too():
    """Its memory goes by another rule than that of eta = 1; near it the force must be the same."""
    short = pressing(replace(ROTLIN, frequency=2.0), 45.0, 1.0)[:2000]
    plain, near = (run_plant(replace(ROTLIN, eta=eta), short).load for eta in (1.0, 1.0 + 1e-9))
    assert np.abs(near - plain).max() < 1e-3
