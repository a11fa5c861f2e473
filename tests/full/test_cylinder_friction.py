"""The cylinder's friction from 200 noisy experiments of each plan: half a minute, so only with -m full."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cylinder_friction import EXAMPLE, NOISE, PAPERS, PLANNED, PLANS, TABLE_I, TARGET, TRIALS, example, page, trials

pytestmark = pytest.mark.full


def test_standard_errors_are_such_as_table_i_has() -> None:
    """Within a factor of 1.5 for even speeds and 2 N, as expected before measuring. The median of those stated is so
    too but for F_S0: of the trials that tell it at all it is 3.93 N, where Table I over 1.5 is 3.97 N."""
    table, refused = trials(PLANS[PAPERS])
    assert (TRIALS, NOISE) == (200, 2.0)
    assert refused < TRIALS / 2
    for name, error in TABLE_I.items():
        assert error / 1.5 <= table[name].expected <= 1.5 * error, name
        if name != "stribeck_force":
            assert error / 1.5 <= table[name].stated <= 1.5 * error, name


def test_intervals_of_the_planned_experiment_cover() -> None:
    """All four parameters in 90 to 98 % of 200 trials, none refused; the errors are those that the fit states."""
    table, refused = trials(PLANS[PLANNED])
    assert refused == 0
    for name, tally in table.items():
        assert 0.90 * TRIALS <= tally.covered <= 0.98 * TRIALS, name
        assert tally.error == pytest.approx(tally.stated, rel=0.15), name


def test_page_and_example_are_as_written() -> None:
    assert TARGET.read_text(encoding="utf-8") == page()
    assert EXAMPLE.read_text(encoding="utf-8") == example()
