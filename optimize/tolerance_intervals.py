"""Confidence intervals of shares, quantiles and means, from few samples as from many."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fluxbore.optimize.tolerance_result import CONFIDENCE, Interval

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def share_interval(count: int, of: int, confidence: float = CONFIDENCE) -> Interval:
    """A share by its count, with the interval of Clopper and Pearson (Biometrika 26, 1934, 404-413).

    It covers the true share at least as often as ``confidence`` says, whatever the share is.
    """
    from scipy.special import betaincinv

    tail = (1 - confidence) / 2
    low = float(betaincinv(count, of - count + 1, tail)) if count > 0 else 0.0
    high = float(betaincinv(count + 1, of - count, 1 - tail)) if count < of else 1.0
    return Interval(count / of, low, high)


def corrected_share(linear: Flags, checked_linear: Flags, checked_full: Flags) -> Interval:
    """A share in full from many linear verdicts, (samples,), and the few samples that have both, (checks,).

    The linear verdict is the control variate, its coefficient that of least variance, which for two verdicts is
    stratification after sampling:  p = s q1 + (1 - s) q0  with s the linear share and q1, q0 the full shares among
    the checks that the linear model passes and fails. Each of the three has Clopper and Pearson's interval at a third
    of the allowed error (Bonferroni), and the interval of p is the widest that they leave. Unlike one from a variance
    it stays honest where no two verdicts differ. A stratum without a check is taken by the linear verdict, and its
    interval is open.
    """
    confidence = 1 - (1 - CONFIDENCE) / 3
    many = share_interval(int(linear.sum()), len(linear), confidence)
    passed, failed = (
        share_interval(int(found.sum()), len(found), confidence) if len(found) else Interval(verdict, 0.0, 1.0)
        for found, verdict in ((checked_full[checked_linear], 1.0), (checked_full[~checked_linear], 0.0))
    )

    def mixed(share: float, one: float, other: float) -> float:
        return share * one + (1 - share) * other

    return Interval(
        mixed(many.value, passed.value, failed.value),
        min(mixed(share, passed.low, failed.low) for share in (many.low, many.high)),
        max(mixed(share, passed.high, failed.high) for share in (many.low, many.high)),
    )


def quantile_interval(ordered: Array, share: float, confidence: float = CONFIDENCE) -> Interval:
    """The value that the ``share`` of a population lies below, from its samples in ascending order.

    The interval's ends are order statistics (Wilks, Ann. Math. Stat. 13, 1942, 400-409): sample number r, from 1, is
    below the quantile with the binomial probability P(at least r of n below), whatever the distribution. An end is
    infinite where there are too few samples for it.
    """
    from scipy.special import bdtr

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
    from scipy.special import stdtrit

    count = len(values)
    mean = float(np.mean(values))
    if count < 2:
        return Interval(mean, -math.inf, math.inf)
    half = float(stdtrit(count - 1, (1 + confidence) / 2)) * float(np.std(values, ddof=1)) / math.sqrt(count)
    return Interval(mean, mean - half, mean + half)
