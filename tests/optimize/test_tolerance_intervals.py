"""Confidence intervals: closed forms at their ends, and how often they cover the truth over 200 seeds."""

import math

import numpy as np
import pytest

from fluxbore.optimize.tolerance_intervals import corrected_share, mean_interval, quantile_interval, share_interval

SEEDS = range(200)
FEWEST = 180
"""Of 200 that must cover: a true coverage of 95 % gives fewer with a probability of 1 in 1000."""


def test_shares_of_all_and_none():
    """Clopper and Pearson's ends for no failure in n: 1 - (alpha/2)^(1/n)."""
    none = share_interval(0, 50)
    assert (none.value, none.low, none.high) == (0.0, 0.0, pytest.approx(1 - 0.025 ** (1 / 50)))
    every = share_interval(50, 50)
    assert (every.low, every.high) == (pytest.approx(0.025 ** (1 / 50)), 1.0)


def test_the_published_example_of_a_share():
    """7 of 20, 95 %: 0.1539 to 0.5922 (tables of exact binomial limits)."""
    made = share_interval(7, 20)
    assert (made.low, made.high) == (pytest.approx(0.1539, abs=5e-5), pytest.approx(0.5922, abs=5e-5))


@pytest.mark.parametrize("share", [0.6, 0.9, 0.99])
def test_intervals_of_shares_cover(share):
    covered = 0
    for seed in SEEDS:
        made = share_interval(int(np.sum(np.random.default_rng(seed).random(300) < share)), 300)
        covered += made.low <= share <= made.high
    assert covered >= FEWEST


@pytest.mark.parametrize("share", [0.01, 0.5, 0.99])
def test_intervals_of_quantiles_cover(share):
    covered = 0
    for seed in SEEDS:
        made = quantile_interval(np.sort(np.random.default_rng(seed).random(2000)), share)
        covered += made.low <= share <= made.high
    assert FEWEST <= covered <= 199


def test_a_median_of_ten_by_its_order_statistics():
    """Numbers 2 and 9 of ten: P = 97.9 %; 3 and 8 would have 89.1 % only."""
    made = quantile_interval(np.arange(1.0, 11.0), 0.5)
    assert (made.low, made.high) == (2.0, 9.0)


def test_a_far_quantile_of_few_samples_is_open():
    made = quantile_interval(np.arange(100.0), 0.99)
    assert made.high == math.inf
    assert math.isfinite(made.low)


def test_intervals_of_means_cover():
    covered = 0
    for seed in SEEDS:
        made = mean_interval(np.random.default_rng(seed).normal(3.0, 1.0, 12))
        covered += made.low <= 3.0 <= made.high
    assert covered >= FEWEST
    assert mean_interval(np.array([1.0])).high == math.inf


def verdicts(seed, wrong, checks=150, samples=4000):
    """Linear verdicts of which 70 % are good, and full ones of the first few that differ in the share ``wrong``."""
    rng = np.random.default_rng(seed)
    linear = rng.random(samples) < 0.7
    full = linear[:checks] & (rng.random(checks) >= wrong)
    return linear, full


@pytest.mark.parametrize("wrong", [0.0, 0.05, 0.5])
def test_corrected_shares_cover(wrong):
    """An interval that trusts the linear verdicts where the full ones differ, or that shrinks to nothing."""
    truth = 0.7 * (1 - wrong)
    covered = 0
    for seed in SEEDS:
        linear, full = verdicts(seed, wrong)
        made = corrected_share(linear, linear[: len(full)], full)
        assert made.low <= made.value <= made.high
        covered += made.low <= truth <= made.high
    assert covered >= FEWEST


def test_good_linear_verdicts_make_the_interval_narrower():
    """The point of a control variate: few checks of a good model tell more than their count alone."""
    linear, full = verdicts(3, 0.0)
    made, plain = corrected_share(linear, linear[: len(full)], full), share_interval(int(full.sum()), len(full))
    assert made.high - made.low < 0.8 * (plain.high - plain.low)
