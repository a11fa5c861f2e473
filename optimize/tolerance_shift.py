"""The yield of the linear model corrected by what the samples computed in full found it to be off.

The error, full minus linear, is fitted by a parabola over the linear value: what curves with the toleranced keys errs
most where the linear value lies furthest out, which is where the limits are. What the parabola leaves is taken for
scatter, and beyond the checks nothing is presumed. Then a dozen checks still tell the yield to a third of what their
count alone does.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from fluxbore.design.performance import FIGURES
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.tolerance_checks import Checks
from fluxbore.optimize.tolerance_intervals import share_interval
from fluxbore.optimize.tolerance_model import Subject
from fluxbore.optimize.tolerance_result import CONFIDENCE, Interval
from fluxbore.optimize.tolerance_yield import meets

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

LINEAR_ERROR = 0.1
"""Root mean square of full minus linear, in standard deviations, from which the linear model is not good enough: at a
limit two standard deviations off it moves the yield by half a per cent."""

TERMS = 3
"""Of the parabola: constant, slope and curvature."""

FEWEST = 8
"""Checks without which nothing is said of the rest: the parabola leaves five of them to tell the scatter by."""


def good_enough(error: float, sigma: float, nominal: float) -> bool:
    """Whether a root mean square ``error`` is small against the scatter, or nothing but rounding."""
    return error <= max(LINEAR_ERROR * sigma, 1e-12 * abs(nominal))


def shifted_yield(
    limits: Sequence[Limit], subjects: Sequence[Subject], deviations: Array, built: Flags, checks: Checks
) -> Interval | None:
    """The share of the samples, (samples, keys), that meets the limits, one subject for each of them.

    Its value is counted with every linear value corrected by the parabola. Its interval's ends are those of Clopper and
    Pearson, counted with every value moved to the worse and to the better end of the prediction interval, at the error
    allowed divided by the limits (Bonferroni). A sample that lies further towards a limit than any check counts as
    missing it in the worse count and as meeting it in the better one, since a figure may bend where none was computed.
    None where the checks are fewer than `FEWEST` or where one has no figures: a share of the production then has none
    either, which no correction of values tells.
    """
    if len(checks.full) < FEWEST or not checks.sound.all():
        return None
    worse, value, better = (built.copy() for _ in range(3))
    for limit, subject in zip(limits, subjects, strict=True):
        made = _corrected(subject, deviations, checks, 1 - (1 - CONFIDENCE) / len(limits))
        if made is None:
            return None
        beyond = made.above if limit.sense == "<=" else made.below
        bad, good = made.middle + made.half, made.middle - made.half
        if limit.sense == ">=":
            bad, good = good, bad
        worse &= meets(limit, bad) & ~beyond
        value &= meets(limit, made.middle)
        better &= meets(limit, good) | beyond
    low, mean, high = (share_interval(int(found.sum()), len(built)) for found in (worse, value, better))
    return Interval(mean.value, min(low.low, mean.low), max(high.high, mean.high))


@dataclass(frozen=True, slots=True)
class _Corrected:
    """The values of a subject in each sample, (samples,): middle and half width of the prediction interval.

    above, below : whether the linear value is beyond those of all checks.
    """

    middle: Array
    half: Array
    above: Flags
    below: Flags


def _corrected(subject: Subject, deviations: Array, checks: Checks, confidence: float) -> _Corrected | None:
    """Prediction by least squares (Draper and Smith, Applied Regression Analysis, 1998, 3.1 and 5.1).

    With X = (1, x, x^2) of the checks, x the linear value in standard deviations, and s^2 the mean square that the
    parabola leaves, another sample is  x b +- t s sqrt(1 + x (X'X)^-1 x').  Presumes residuals that are normal and of
    one variance; those of a bent figure are not, which the interval's covering every sample at its end at once allows
    for: see the coverage in the tests. None where the subject is not known of every check.
    """
    linear = subject.values(deviations)
    inside = np.zeros(len(linear), dtype=bool)
    if subject.exact and subject.name not in FIGURES:  # a key that is given: nothing to correct
        return _Corrected(linear, np.zeros_like(linear), inside, inside)
    full, count = checks.figures[subject.name], len(checks.full)
    if not np.isfinite(full).all():
        return None
    ours = subject.values(checks.deviations)
    rest, sigma = full - ours, subject.total.sigma
    if not subject.scatters:
        shift, spread = float(np.mean(rest)), float(np.std(rest, ddof=1)) * math.sqrt(1 + 1 / count)
        half = float(stdtrit(count - 1, (1 + confidence) / 2)) * spread
        return _Corrected(linear + shift, np.full_like(linear, half), inside, inside)
    terms, every = (_terms((values - subject.mean) / sigma) for values in (ours, linear))
    rotated, triangle = np.linalg.qr(terms)
    weights = np.linalg.solve(triangle, rotated.T @ rest)
    left = rest - terms @ weights
    spread = math.sqrt(float(left @ left) / (count - TERMS))
    leverage = np.sum(np.linalg.solve(triangle.T, every.T) ** 2, axis=0)
    half = float(stdtrit(count - TERMS, (1 + confidence) / 2)) * spread * np.sqrt(1 + leverage)
    return _Corrected(linear + every @ weights, half, linear > ours.max(), linear < ours.min())


def _terms(x: Array) -> Array:
    """(samples, `TERMS`)."""
    return np.stack([x**power for power in range(TERMS)], axis=1)
