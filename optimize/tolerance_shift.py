"""The yield of the linear model moved by what the samples computed in full found it to be off.

It presumes that full minus linear is alike for all samples, which is sound where it is small against the scatter. Then
a dozen checks tell the yield to a fraction of what their count alone could.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

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

FEWEST = 5
"""Checks without which nothing is said of the rest."""


def good_enough(error: float, sigma: float, nominal: float) -> bool:
    """Whether a root mean square ``error`` is small against the scatter, or nothing but rounding."""
    return error <= max(LINEAR_ERROR * sigma, 1e-12 * abs(nominal))


def shifted_yield(
    limits: Sequence[Limit], subjects: Sequence[Subject], deviations: Array, built: Flags, checks: Checks
) -> Interval | None:
    """The share of the samples, (samples, keys), that meets the limits, one subject for each of them.

    Its value is counted with every linear value moved by the mean of full minus linear. Its interval's ends are those
    of Clopper and Pearson, counted with every value moved to the worse and to the better end of Student's prediction
    interval of full minus linear.
    None where the checks are fewer than `FEWEST`, where one has no figures, or where the linear model is not
    `good_enough`.
    """
    if len(checks.full) < FEWEST or not checks.sound.all():
        return None
    counts = [built.copy() for _ in range(3)]
    for limit, subject in zip(limits, subjects, strict=True):
        made = _bounds(subject, checks)
        if made is None:
            return None
        linear = subject.values(deviations)
        low, mean, high = made if limit.sense == ">=" else made[::-1]
        for found, shift in zip(counts, (low, mean, high), strict=True):
            found &= meets(limit, linear + shift)
    worse, value, better = (share_interval(int(found.sum()), len(built)) for found in counts)
    return Interval(value.value, min(worse.low, value.low), max(better.high, value.high))


def _bounds(subject: Subject, checks: Checks) -> tuple[float, float, float] | None:
    """The low end, the mean and the high end of what full minus linear is of another sample."""
    spread = checks.figure(subject)
    count = len(checks.full)
    if spread is None or spread.count < count:
        return None
    if not good_enough(spread.error, subject.total.sigma, subject.nominal):
        return None
    rest = max(spread.error**2 - spread.bias**2, 0.0) * count / (count - 1)
    half = float(stdtrit(count - 1, (1 + CONFIDENCE) / 2)) * math.sqrt(rest * (1 + 1 / count))
    return spread.bias - half, spread.bias, spread.bias + half
