"""The estimate of the force: its parts, and the same sample by sample as over a log."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from fluxbore.design.dynamics.bouc_wen import BoucWen
from fluxbore.design.dynamics.force_estimation import (
    ForceEstimator,
    displacements,
    estimate,
    estimate_log,
    estimate_record,
    first_estimate,
)
from fluxbore.design.dynamics.load_observer import LoadObserver
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring, force_record
from fluxbore.design.dynamics.magnetic_spring import LinearSpring, PolynomialSpring, SineSpring
from fluxbore.design.dynamics.motion_log import MotionLog
from fluxbore.design.dynamics.pole_distortion import PoleDistortion
from fluxbore.design.errors import DesignError, MeasurementError

Floats = NDArray[np.float64]

H = 36e-3 / 7 / math.tau
SINE = SineSpring(192.0, H)
MEMORY = HysteresisSpring(SINE, 0.96, BoucWen())
GRID = np.arange(129) * math.tau / 64
LINE = PoleDistortion(0.0, math.tau / 64, 25e-6 * np.sin(GRID))
OBSERVER = LoadObserver(1e-4)
PROPOSED = ForceEstimator(MEMORY, H, OBSERVER, LINE)


def motion(counts: bool = True) -> tuple[Floats, Floats]:
    """Half a second, two turns to and fro with 100 N at the height of it."""
    time = np.arange(5000) * 1e-4
    angle = 5.0 * (1 - np.cos(4 * math.pi * time))
    position = H * angle - SINE.displacement(100.0) * np.sin(2 * math.pi * time) - LINE(angle)
    if counts:
        angle, position = np.round(angle / 1e-3) * 1e-3, np.round(position / 1e-6) * 1e-6
    return angle, position


@pytest.mark.parametrize(
    "estimator",
    [
        PROPOSED,
        replace(PROPOSED, play=1e-6),
        replace(PROPOSED, spring=SINE),
        ForceEstimator(LinearSpring(220e3), H, OBSERVER),
        ForceEstimator(PolynomialSpring((234e3, -5e10)), H, OBSERVER, LINE),
    ],
)
def test_sample_by_sample_is_the_record(estimator: ForceEstimator) -> None:
    """To rounding, for every law, on encoder counts, from a memory in the middle of a loop."""
    angle, position = (signal[:2500] for signal in motion())
    record = estimate_record(estimator, angle, position, memory=1e-4)
    now = first_estimate(estimator, float(angle[0]), float(position[0]), memory=1e-4)
    forces = [(now.spring_force, now.load_force)]
    for theta, x in zip(angle[1:].tolist(), position[1:].tolist(), strict=True):
        now = estimate(estimator, now, theta, x)
        forces.append((now.spring_force, now.load_force))
    stepped = np.array(forces).T
    assert record.spring_force == pytest.approx(stepped[0], abs=1e-9)
    assert record.load_force == pytest.approx(stepped[1], abs=1e-8)


def test_the_distortion_is_taken_off_the_displacement() -> None:
    """(20): what is left is the stretch of the spring itself."""
    angle, position = motion(counts=False)
    stretch = SINE.displacement(100.0) * np.sin(2 * math.pi * np.arange(5000) * 1e-4)
    assert displacements(PROPOSED, angle, position) == pytest.approx(stretch, abs=1e-15)
    without = displacements(replace(PROPOSED, distortion=None), angle, position)
    assert float(np.max(np.abs(without - stretch))) == pytest.approx(25e-6, rel=0.01)
    expected = force_record(MEMORY, stretch)
    assert estimate_record(PROPOSED, angle, position).spring_force == pytest.approx(expected, abs=1e-9)


def test_a_log_of_another_period_or_of_unknown_angles_is_refused() -> None:
    angle, position = motion()
    log = MotionLog(1e-4, angle, position, source="log.csv")
    assert estimate_log(PROPOSED, log).load_force == pytest.approx(
        estimate_record(PROPOSED, angle, position).load_force
    )
    with pytest.raises(MeasurementError, match=r"log\.csv must have the observer's period of 0\.0001 s; got 0\.0002 s"):
        estimate_log(PROPOSED, replace(log, period=2e-4))
    with pytest.raises(MeasurementError, match=r"angle must be from 0 rad to 12\.57 rad, where the distortion"):
        estimate_log(PROPOSED, replace(log, angle=angle + 5.0))
    estimate_log(replace(PROPOSED, distortion=None), replace(log, angle=angle + 5.0))


def test_play_of_a_count_keeps_the_counts_out_of_the_memory() -> None:
    """Over seconds of trembling counts the paper's memory fades; a truth without counts shows by how much."""
    true_angle, true_position = (np.tile(signal, 4) for signal in motion(counts=False))
    angle, position = (np.tile(signal, 4) for signal in motion())
    true = estimate_record(PROPOSED, true_angle, true_position).spring_force

    def error(play: float) -> float:
        found = estimate_record(replace(PROPOSED, play=play), angle, position).spring_force
        return float(np.sqrt(np.mean((found - true) ** 2)))

    assert error(1e-6) < 0.6 * error(0.0)


def test_a_play_below_zero_is_refused() -> None:
    for play in (-1e-6, math.nan, math.inf):
        with pytest.raises(DesignError, match="play of a force estimator must be finite and 0 mm or above; got"):
            replace(PROPOSED, play=play)
