"""The paper's experiments 1 to 3 on the stand-in plant: one number calibrated, the rest predicted, beside Table III."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.dynamics.estimation_plant import RotLinPlant
from fluxbore.design.dynamics.estimation_run import PlantRun
from fluxbore.design.dynamics.estimation_trials import (
    EXPERIMENTS,
    TARGET,
    Estimators,
    calibrated,
    detect,
    estimation_rmse,
    estimators,
    experiment,
    fitted_polynomial,
)

PAGE = Path(__file__).parents[3] / "docs" / "validation" / "force_estimation.md"
POLYNOMIAL = {1: 4.68, 2: 4.65, 3: 4.14}
"""N, Table III."""
MOST = {1: 0.25, 2: 0.30, 3: 0.45}
"""Of the proposed estimate's error over the polynomial's; the paper has 0.19, 0.21 and 0.39."""


@pytest.fixture(scope="module")
def plant() -> RotLinPlant:
    """Calibrated from another amplitude, on experiment 1's polynomial alone."""
    return calibrated(RotLinPlant(distortion=24e-6), rounds=1)


@pytest.fixture(scope="module")
def known(plant: RotLinPlant) -> Estimators:
    return estimators(plant, detect(plant))


@pytest.fixture(scope="module")
def runs(plant: RotLinPlant) -> Mapping[int, PlantRun]:
    return {number: experiment(plant, peak) for number, peak in EXPERIMENTS.items()}


@pytest.fixture(scope="module")
def errors(known: Estimators, runs: Mapping[int, PlantRun]) -> Mapping[int, Mapping[str, float]]:
    return {number: estimation_rmse(run, known.by_name) for number, run in runs.items()}


def test_the_calibration_meets_its_target_and_gives_the_plant_s_own_value(
    plant: RotLinPlant, errors: Mapping[int, Mapping[str, float]]
) -> None:
    assert errors[1]["polynomial"] == pytest.approx(TARGET, rel=0.01)
    assert RotLinPlant().distortion == pytest.approx(plant.distortion, rel=0.01)


@pytest.mark.parametrize("number", EXPERIMENTS)
def test_the_loads_reach_their_peaks(runs: Mapping[int, PlantRun], number: int) -> None:
    assert float(np.max(runs[number].load)) == pytest.approx(EXPERIMENTS[number], abs=0.5)


@pytest.mark.parametrize("number", EXPERIMENTS)
def test_the_polynomial_s_error_is_near_table_iii(errors: Mapping[int, Mapping[str, float]], number: int) -> None:
    """Within 15 %, the second and third predicted."""
    assert errors[number]["polynomial"] == pytest.approx(POLYNOMIAL[number], rel=0.15)


@pytest.mark.parametrize("number", EXPERIMENTS)
def test_the_proposed_estimate_is_as_much_better(errors: Mapping[int, Mapping[str, float]], number: int) -> None:
    ratio = errors[number]["proposed"] / errors[number]["polynomial"]
    assert 0.02 < ratio <= MOST[number]


def test_the_line_does_as_well_as_the_polynomial_below_100_n_and_fails_above(
    errors: Mapping[int, Mapping[str, float]],
) -> None:
    for number in (1, 2):
        assert errors[number]["linear"] == pytest.approx(errors[number]["polynomial"], rel=0.1)
    assert errors[3]["linear"] > 1.4 * errors[3]["polynomial"]


def test_each_part_of_the_proposed_estimate_has_its_share(known: Estimators, runs: Mapping[int, PlantRun]) -> None:
    """Without x_d0 it is no better than the polynomial, without memory worse than with; play takes most of the rest."""
    proposed = known.by_name["proposed"]
    spring = proposed.spring.law  # type: ignore[union-attr]
    found = estimation_rmse(
        runs[3],
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


def test_the_unloaded_runs_tell_the_line_and_the_friction(plant: RotLinPlant, known: Estimators) -> None:
    """The friction of 0.85 N, and up to 1/w of it, since the memory fades under ripple."""
    line = known.detection.distortion
    angle = np.linspace(line.first, line.last, 20_000)
    apart = line(angle) - plant.zero_force_line(angle, plant.transfer_ratio * angle)
    assert float(np.sqrt(np.mean(apart**2))) < 0.5e-6
    assert 0.85 * 0.99 < known.detection.friction(plant.spring.law) < 0.85 / plant.weight * 1.01


def test_the_lines_cover_every_experiment(known: Estimators, runs: Mapping[int, PlantRun]) -> None:
    for run in runs.values():
        assert np.all(known.detection.distortion.covers(run.log.angle))


def test_the_polynomial_is_fitted_to_the_plant_s_static_loop() -> None:
    """Close to the sine's own series, the stiffness between the sine's with and without memory."""
    plant = RotLinPlant()
    k_1, k_3, k_5 = fitted_polynomial(plant).coefficients
    h, force = plant.transfer_ratio, plant.stall_force
    assert plant.weight < k_1 * h / force < 1.0
    assert k_3 == pytest.approx(-force / (6 * h**3), rel=0.2)
    assert k_5 > 0


def test_the_page_has_these_numbers(errors: Mapping[int, Mapping[str, float]]) -> None:
    """The proposed one is small, and where its encoders' counts fall changes with any rounding: by some 3 %."""
    rows = re.findall(r"^\| (\d), \d+ N \| (.*) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert [int(number) for number, _ in rows] == [1, 2, 3]
    for number, cells in rows:
        told = [float(cell.split(" ")[0]) for cell in cells.split(" | ")[:3]]
        computed = [errors[int(number)][name] for name in ("linear", "polynomial", "proposed")]
        assert told[:2] == pytest.approx(computed[:2], rel=0.02)
        assert told[2] == pytest.approx(computed[2], rel=0.08)
