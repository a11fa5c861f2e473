"""Confidence intervals of shares, quantiles and means, from few samples as from many."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.special import bdtr, betaincinv, stdtrit

from fluxbore.optimize.tolerance_result import CONFIDENCE, Interval

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def share_interval(count: int, of: int, confidence: float = CONFIDENCE) -> Interval:
    """A share by its count, with the interval of Clopper and Pearson (Biometrika 26, 1934, 404-413).

    It covers the true share at least as often as ``confidence`` says, whatever the share is.
    """
    tail = (1 - confidence) / 2
    low = float(betaincinv(count, of - count + 1, tail)) if count > 0 else 0.0
    high = float(betaincinv(count + 1, of - count, 1 - tail)) if count < of else 1.0
    return Interval(count / of, low, high)


def corrected_share(linear: Flags, checked_linear: Flags, checked_full: Flags) -> Interval:
    """A share in full from many linear verdicts and the few samples that have both, (samples,) and (checks,).

    With a the share of samples that only the full model passes and b that of those that only the linear one does,
    the full share is  p = p_linear + a - b:  the linear verdict is the control variate. The interval adds the ends of
    those three, each by Clopper and Pearson, and is cut to the plain count's in the checks; the four share the
    allowed error in equal parts (Bonferroni), so that all hold together at `CONFIDENCE`. Unlike one from a variance
    it stays honest where no two verdicts differ.
    """
    count = len(checked_full)
    confidence = 1 - (1 - CONFIDENCE) / 4
    many = share_interval(int(linear.sum()), len(linear), confidence)
    gained = share_interval(int((checked_full & ~checked_linear).sum()), count, confidence)
    lost = share_interval(int((checked_linear & ~checked_full).sum()), count, confidence)
    plain = share_interval(int(checked_full.sum()), count, confidence)
    low = max(many.low + gained.low - lost.high, plain.low)
    high = min(many.high + gained.high - lost.low, plain.high)
    value = min(max(many.value + gained.value - lost.value, 0.0), 1.0)
    # Where the two disagree, which at this confidence is rare, neither is cut.
    low, high = (low, high) if low <= high else (plain.low, plain.high)
    return Interval(min(max(value, low), high), low, high)


def quantile_interval(ordered: Array, share: float, confidence: float = CONFIDENCE) -> Interval:
    """The value that the ``share`` of a population lies below, from its samples in ascending order.

    The interval's ends are order statistics (Wilks, Ann. Math. Stat. 13, 1942, 400-409): sample number r, from 1, is
    below the quantile with the binomial probability P(at least r of n below), whatever the distribution. An end is
    infinite where there are too few samples for it.
    """
    count = len(ordered)
    tail = (1 - confidence) / 2
    below = bdtr(np.arange(count + 1, dtype=float), count, share)  # P(at most k samples lie below the quantile)
    # low: the largest r with P(fewer than r below) <= tail; high: the smallest with P(at least r below) <= tail.
    low = int(np.searchsorted(below, tail, side="right"))
    high = int(np.searchsorted(below, 1 - tail, side="left")) + 1
    return Interval(
        float(np.quantile(ordered, share)),
        float(ordered[low - 1]) if low >= 1 else -math.inf,
        float(ordered[high - 1]) if high <= count else math.inf,
    )


def mean_interval(values: Array, confidence: float = CONFIDENCE) -> Interval:
    """The mean with Student's interval; infinite for a single value."""
    count = len(values)
    mean = float(np.mean(values))
    if count < 2:
        return Interval(mean, -math.inf, math.inf)
    half = float(stdtrit(count - 1, (1 + confidence) / 2)) * float(np.std(values, ddof=1)) / math.sqrt(count)
    return Interval(mean, mean - half, mean + half)
