"""The stand-in plant in simulated time: balance, friction, distortion, and no trace of the step."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from rotlin_stand import ROTLIN

from fluxbore.design.dynamics.estimation_run import PlantRun, run_plant
from fluxbore.design.dynamics.estimation_trials import experiment, farthest_angle, to_and_fro
from fluxbore.design.dynamics.force_parameters import ForceParameters
from fluxbore.design.dynamics.magnetic_hysteresis import force_record

Floats = NDArray[np.float64]

PLANT = ROTLIN
FINE = replace(PLANT, position_count=0.0, angle_count=0.0)
QUICK = replace(FINE, frequency=1.0)
"""Experiment 3 in a second."""


@pytest.fixture(scope="module")
def pressed() -> PlantRun:
    return experiment(QUICK, 165.0, 1.0)


def spring_force(plant: ForceParameters, run: PlantRun) -> Floats:
    """By the records of `magnetic_hysteresis`, which the simulation does not use."""
    x_dn = plant.transfer_ratio * run.angle - run.position - plant.zero_force_line(run.angle, run.position)
    return force_record(plant.spring, x_dn)


def test_the_forces_on_the_mover_balance(pressed: PlantRun) -> None:
    """M x'' = F_s - F_l - F_f, at a speed where friction is at its level; F_s by another program."""
    acceleration = np.gradient(pressed.speed, QUICK.control_period)
    friction = QUICK.friction * np.sign(pressed.speed)
    left = spring_force(QUICK, pressed) - pressed.load - friction - QUICK.mass * acceleration
    fast = np.abs(pressed.speed) > 0.05
    assert np.count_nonzero(fast) > 5000
    assert float(np.sqrt(np.mean(left[fast] ** 2))) < 0.01
    assert float(np.max(pressed.load)) == pytest.approx(165.0, abs=2.0)


def test_the_load_is_the_foam_s(pressed: PlantRun) -> None:
    assert pressed.load == pytest.approx(2250.0 * pressed.position + 0.1 * pressed.speed, abs=1e-9)
    assert pressed.log.force is not None
    assert pressed.log.force.tolist() == pressed.load.tolist()


@pytest.mark.parametrize("plant", [QUICK, replace(PLANT, frequency=1.0)])
def test_steps_of_five_and_of_fifty_microseconds_agree(plant: ForceParameters) -> None:
    """Within 0.01 N all along, with the encoders' counts and without; the pace is ten times the experiment's."""
    coarse, fine = (experiment(plant, 165.0, 0.4, steps=steps).load for steps in (2, 20))
    assert float(np.max(np.abs(coarse - fine))) < 0.01


def test_encoders_count_to_the_nearest(pressed: PlantRun) -> None:
    run = run_plant(PLANT, np.linspace(0.0, 2.0, 2000))
    assert np.abs(run.log.position - run.position) == pytest.approx(np.zeros(2000), abs=0.5001e-6)
    assert run.log.position / 1e-6 == pytest.approx(np.round(run.log.position / 1e-6), abs=1e-6)
    assert np.abs(run.log.angle - run.angle) == pytest.approx(np.zeros(2000), abs=0.5001 * PLANT.angle_count)
    assert pressed.log.position.tolist() == pressed.position.tolist()


def test_without_load_and_friction_the_mover_follows_the_zero_force_line() -> None:
    """x_d = x_d0 but for the mover's inertia: the plant is distorted as it says."""
    free = replace(FINE, friction=1e-6, bristle_stiffness=1.0, bristle_damping=0.0)
    run = run_plant(free, to_and_fro(free, 5e-3)[:16_000], loaded=False)
    x_d = free.transfer_ratio * run.angle - run.position
    apart = x_d - free.zero_force_line(run.angle, run.position)
    assert float(np.max(np.abs(x_d))) > 10e-6
    assert float(np.sqrt(np.mean(apart**2))) < 0.5e-6


def test_held_in_one_place_it_rests_there() -> None:
    """The rotor at its reference under a steady load, to the controller's dead band of none; nothing hums."""
    run = run_plant(FINE, np.concatenate((np.linspace(0.0, 20.0, 5000), np.full(8000, 20.0))))
    assert run.angle[-1] == pytest.approx(20.0, abs=1e-3)
    assert float(np.ptp(run.load[-1000:])) < 0.02


def test_the_unloaded_runs_go_at_the_speed_asked_for() -> None:
    """With ramps that leave no jump of speed."""
    way = to_and_fro(PLANT, 20e-3) * PLANT.transfer_ratio
    speed = np.diff(way) / PLANT.control_period
    assert float(np.max(speed)) == pytest.approx(20e-3, rel=5e-3)
    assert float(np.min(speed)) == pytest.approx(-20e-3, rel=5e-3)
    assert float(np.max(np.abs(np.diff(speed)))) < 20e-3 * math.pi / 2 / 4000 * 1.1
    assert way[0] == pytest.approx(0.0, abs=1e-6)
    farthest = farthest_angle(PLANT, 165.0) * PLANT.transfer_ratio
    assert farthest + 2e-3 < float(np.max(way)) < farthest + 10e-3
