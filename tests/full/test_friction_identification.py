"""The friction law from 200 noisy experiments, and from simulated runs: half a minute, so only with -m full."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from friction_identification import NOISE, RUN_SEEDS, TRIALS, TRUTH, estimates, experiment, trials

pytestmark = pytest.mark.full


@pytest.mark.parametrize("both", [True, False], ids=["192 points", "96 points"])
def test_parameters_within_five_per_cent_and_intervals_that_cover_in_200_trials(both: bool) -> None:
    """Catches an estimator that is worse than the data allow, and intervals that are too narrow or too wide. With one
    point for each run the bound of Cramer and Rao leaves v_s beyond 5 % in one trial of five."""
    assert (TRIALS, NOISE) == (200, 0.1)
    for name, tally in trials(both=both).items():
        assert tally.error <= 0.05, name
        assert tally.within >= (0.9 if both else 0.75), name
        assert 0.90 * TRIALS <= tally.covered <= 0.98 * TRIALS, name


def test_the_papers_run_gives_the_plants_parameters_on_five_seeds() -> None:
    """Catches a window that takes the turns in, and a chamber's thrust that passes for friction."""
    assert len(RUN_SEEDS) >= 5
    for seed in RUN_SEEDS:
        found = estimates(experiment(seed, corrected=True)[1])
        assert all(abs(found[name].value / value - 1) < 0.01 for name, value in TRUTH.items()), seed
