"""The contact-force benchmark at the example's step on the finite elements' field (-m full)."""

import numpy as np
import pytest
from mcfc_cases import EXAMPLE, SECTION

from fluxbore.design.dynamics.contact_force import COUNTED, simulate
from fluxbore.design.spec import load
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.hybrid_force_map import force_map_of, map_values

pytestmark = pytest.mark.full

SEEDS = (1, 2, 3, 4, 5)


@pytest.fixture(scope="module")
def run():
    spec = load(EXAMPLE)
    evaluation = evaluate(spec.with_values(map_values(spec)))
    force_map, mass = force_map_of(evaluation), evaluation.performance.moving_mass

    def simulated(seed, **changes):
        values = {**spec.values, **{SECTION + name: value for name, value in changes.items()}}
        return simulate(spec.actuator, values, force_map, seed, moving_mass=mass)

    return simulated


@pytest.fixture(scope="module")
def found(run):
    return {seed: run(seed).figures for seed in SEEDS}


@pytest.mark.parametrize("seed", SEEDS)
def test_medians_and_cells_are_the_papers(found, seed):
    figures = found[seed]
    assert figures["median_rmse"]["P-N"] == pytest.approx(3.13, abs=0.15)
    assert figures["median_rmse"]["P-P"] == pytest.approx(2.94, abs=0.2)
    assert figures["median_rmse"]["P-E"] == pytest.approx(1.26, abs=0.2)
    assert figures["cells"] == 36
    assert figures["cells_lowest_P-E"] >= 34
    assert abs(figures["cells_P-P_below_P-N"] - 18) <= 2
    assert figures["friedman_p"] < 0.001


@pytest.mark.parametrize("seed", SEEDS)
def test_errors_fall_and_rise_with_speed_as_the_papers(found, seed):
    trend = found[seed]["trend"]
    for target in COUNTED:
        assert trend["P-N"][f"{target:g}"] < -0.9
        assert trend["P-P"][f"{target:g}"] > 0.9


@pytest.mark.parametrize("seed", SEEDS)
def test_the_post_hoc_pattern_is_the_papers(found, seed):
    """P-E is smaller than either, p < .001; P-N and P-P cannot be told apart."""
    corrected = {tuple(item["pair"]): item["p_corrected"] for item in found[seed]["post_hoc"]}
    assert corrected["P-N", "P-E"] < 0.001
    assert corrected["P-P", "P-E"] < 0.001
    assert corrected["P-N", "P-P"] > 0.05


def test_no_error_of_the_144_depends_on_the_step(run):
    errors = [
        np.array([trial.figures["rmse"] for trial in run(1, time_step=step).trials]) for step in (5e-5, 1e-4, 2e-4)
    ]
    assert len(errors[0]) == 144
    assert np.max(np.ptp(errors, axis=0)) < 0.01


def test_friction_moves_what_nothing_makes_up_for(run):
    """10 % more or less of it: 3.2 N becomes 3.5 and 2.9 N."""
    more, less = (run(1, friction_share=share).figures["median_rmse"]["P-N"] for share in (1.1, 0.9))
    assert more == pytest.approx(1.1 * 3.2, abs=0.05)
    assert less == pytest.approx(0.9 * 3.2, abs=0.05)
