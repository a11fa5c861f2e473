"""The estimates' parts in experiment 3, what the unloaded runs tell, and the calibration."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from rotlin_stand import ROTLIN

from fluxbore.design.dynamics.estimation_run import PlantRun
from fluxbore.design.dynamics.estimation_trials import (
    TARGET,
    Estimators,
    calibrated,
    detect,
    estimation_rmse,
    estimators,
    experiment,
    fitted_polynomial,
)

PEAK = 165.0
"""N, of experiment 3. What the three experiments come to is tested with the command, in test_force_benchmark.py."""


@pytest.fixture(scope="module")
def known() -> Estimators:
    return estimators(ROTLIN, detect(ROTLIN))


@pytest.fixture(scope="module")
def run() -> PlantRun:
    return experiment(ROTLIN, PEAK)


def test_the_load_reaches_its_peak(run: PlantRun) -> None:
    assert float(np.max(run.load)) == pytest.approx(PEAK, abs=0.5)


@pytest.mark.full
def test_the_calibration_comes_to_the_example_s_value_from_elsewhere() -> None:
    """Catches an example whose distortion is not what experiment 1's polynomial estimate gives."""
    found = calibrated(replace(ROTLIN, distortion=24e-6), rounds=2)
    assert found.distortion == pytest.approx(ROTLIN.distortion, rel=2e-3)
    by_name = estimators(found, detect(found)).by_name
    assert estimation_rmse(experiment(found, 45.0), by_name)["polynomial"] == pytest.approx(TARGET, rel=3e-3)


def test_each_part_of_the_proposed_estimate_has_its_share(known: Estimators, run: PlantRun) -> None:
    """Without x_d0 it is no better than the polynomial, without memory worse than with; play takes most of the rest."""
    proposed = known.by_name["proposed"]
    spring = proposed.spring.law  # type: ignore[union-attr]
    found = estimation_rmse(
        run,
        {
            "proposed": proposed,
            "no memory": replace(proposed, spring=spring),
            "no line": replace(proposed, distortion=None),
            "play": replace(proposed, play=1e-6),
        },
    )
    assert found["no line"] > 4.0
    assert found["no memory"] > 2 * found["proposed"]
    assert found["play"] < 0.4 * found["proposed"]


def test_the_unloaded_runs_tell_the_line_and_the_friction(known: Estimators) -> None:
    """The friction of 0.85 N, and up to 1/w of it, since the memory fades under ripple."""
    line = known.detection.distortion
    angle = np.linspace(line.first, line.last, 20_000)
    apart = line(angle) - ROTLIN.zero_force_line(angle, ROTLIN.transfer_ratio * angle)
    assert float(np.sqrt(np.mean(apart**2))) < 0.5e-6
    assert 0.85 * 0.99 < known.detection.friction(ROTLIN.spring.law) < 0.85 / ROTLIN.elastic_share * 1.01


def test_the_line_covers_the_experiments(known: Estimators, run: PlantRun) -> None:
    assert np.all(known.detection.distortion.covers(run.log.angle))


def test_the_polynomial_is_fitted_to_the_plant_s_static_loop() -> None:
    """Close to the sine's own series, the stiffness between the sine's with and without memory."""
    plant = ROTLIN
    k_1, k_3, k_5 = fitted_polynomial(plant).coefficients
    h, force = plant.transfer_ratio, plant.stall_force
    assert plant.elastic_share < k_1 * h / force < 1.0
    assert k_3 == pytest.approx(-force / (6 * h**3), rel=0.2)
    assert k_5 > 0
