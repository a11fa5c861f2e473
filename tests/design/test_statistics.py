"""The statistics against published examples, and against counting every case."""

from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.statistics import compare, friedman, root_mean_square, trend

# Hollander and Wolfe (1973), p. 140: times of 22 players to second base by three ways round the first (s).
BASES = np.array(
    [
        [5.40, 5.50, 5.55], [5.85, 5.70, 5.75], [5.20, 5.60, 5.50], [5.55, 5.50, 5.40], [5.90, 5.85, 5.70],
        [5.45, 5.55, 5.60], [5.40, 5.40, 5.35], [5.45, 5.50, 5.35], [5.25, 5.15, 5.00], [5.85, 5.80, 5.70],
        [5.25, 5.20, 5.10], [5.65, 5.55, 5.45], [5.60, 5.35, 5.45], [5.05, 5.00, 4.95], [5.50, 5.50, 5.40],
        [5.45, 5.55, 5.50], [5.55, 5.55, 5.35], [5.45, 5.50, 5.55], [5.50, 5.45, 5.25], [5.65, 5.60, 5.40],
        [5.70, 5.65, 5.55], [6.30, 6.30, 6.25],
    ]
)  # fmt: skip

# Hollander and Wolfe (1973), p. 29: Hamilton depression scale factor of nine patients before and after.
BEFORE = np.array([1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30])
AFTER = np.array([0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29])


def named(values):
    return {name: np.asarray(column, dtype=float) for name, column in zip("abc", values, strict=True)}


def test_friedman_of_the_bases():
    """With ties, chi2 = 11.143 and p = 0.003805."""
    found = friedman(named(BASES.T))
    assert found.chi2 == pytest.approx(11.143, abs=5e-4)
    assert found.p == pytest.approx(0.003805, abs=5e-7)
    assert found.degrees == 2
    assert found.rank_sums == {"a": 53.0, "b": 47.0, "c": 32.0}


def test_the_papers_chi2_is_that_of_even_wins_behind_a_sure_winner():
    """36 cells, the third lowest in all: 18 wins of the second over the first give 54.0, and no other count does."""

    def chi2(wins):
        second = np.where(np.arange(36) < wins, 2.0, 4.0)
        return friedman(named([np.full(36, 3.0), second, np.ones(36)])).chi2

    assert chi2(18) == pytest.approx(54.0, abs=1e-12)
    assert [wins for wins in range(37) if round(chi2(wins), 1) == 54.0] == [18]


def test_chi2_over_all_orders_has_the_mean_of_its_distribution():
    """Every one of the 6^3 ways to rank three conditions in three cells is as likely where nothing differs."""
    values = [friedman(named(np.array(orders).T)).chi2 for orders in product(permutations((1.0, 2.0, 3.0)), repeat=3)]
    assert np.mean(values) == pytest.approx(2.0, abs=1e-12)


def test_nothing_differs_where_all_is_equal():
    cells = named(np.ones((3, 5)))
    assert (friedman(cells).chi2, friedman(cells).p) == (0.0, 1.0)
    assert [(pair.p, pair.corrected) for pair in compare(cells)] == [(1.0, 1.0)] * 3


def test_wilcoxon_of_the_depression_scale():
    """V = 40 of 45, p = 0.01953 on one side; corrected for the one pair that there is."""
    (pair,) = compare({"before": BEFORE, "after": AFTER})
    assert pair.statistic == 5.0
    assert pair.p == pytest.approx(2 * 0.01953, abs=1e-5)
    assert pair.corrected == pair.p
    assert (pair.first, pair.second, pair.lower) == ("before", "after", 2)
    assert pair.medians == (1.68, 1.06)


@given(st.lists(st.integers(1, 10**6), min_size=3, max_size=9, unique=True), st.data())
def test_p_is_the_share_of_signs_that_are_as_uneven(sizes, data):
    """Exact: all 2^n ways to give the differences signs."""
    signs = data.draw(st.lists(st.sampled_from([-1, 1]), min_size=len(sizes), max_size=len(sizes)))
    ranks = np.argsort(np.argsort(sizes)) + 1
    total = ranks.sum()

    def lower(signs):
        positive = ranks[np.array(signs) > 0].sum()
        return min(positive, total - positive)

    (pair,) = compare({"a": np.array(sizes, dtype=float) * signs, "b": np.zeros(len(sizes))})
    cases = [lower(signs) for signs in product((-1, 1), repeat=len(sizes))]
    assert pair.statistic == lower(signs)
    assert pair.p == pytest.approx(np.mean(np.array(cases) <= pair.statistic), abs=1e-12)


def test_cells_that_are_equal_drop_out():
    """Four that differ, all the same way, are as many signs; no warning of a small sample gets out."""
    values = np.array([0.0, 0.0, 0.0, 1.0, 2.0, 3.5, 5.0])
    (pair,) = compare({"a": values, "b": np.zeros(7)})
    assert (pair.statistic, pair.lower) == (0.0, 0)
    assert pair.p == pytest.approx(2 / 2**4)


def test_three_pairs_are_corrected_by_three_and_stop_at_one():
    rng = np.random.default_rng(3)
    a = rng.normal(size=12)
    pairs = compare({"a": a, "b": a + 5 + 0.1 * rng.normal(size=12), "c": a + rng.normal(size=12)})
    assert [(pair.first, pair.second) for pair in pairs] == [("a", "b"), ("a", "c"), ("b", "c")]
    assert pairs[0].p == pytest.approx(2 / 2**12)
    assert pairs[0].corrected == pytest.approx(3 * pairs[0].p)
    assert all(pair.corrected == min(1.0, 3 * pair.p) for pair in pairs)


def test_root_mean_square_adds_noise_in_quadrature():
    assert root_mean_square([3.0, -4.0]) == pytest.approx(12.5**0.5)


def test_trend_is_a_matter_of_order():
    x = np.array([0.3, 1.0, 2.0, 9.0])
    assert trend(x, np.exp(x)) == 1.0
    assert trend(x, 1 / x) == -1.0
    assert trend(x, np.ones(4)) == 0.0
    assert trend(x, [1.0, 3.0, 2.0, 4.0]) == pytest.approx(0.8)
