"""Limits backed off from the study's own, so that what scatters about a design that meets them still meets the study's.

For a limit  f <= u  the search is given  nominal f <= u - q(p),  where q(p) is the value that the share p of the
linear deviations of f lies below; for normal scatter about the nominal value that is u - k sigma with p = Phi(k). One p
serves all limits. It is the smallest at which their joint yield reaches the target, counted in the samples: limits
that are far away or that fail in the same actuators then cost nothing twice, unlike by Boole's inequality.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri

from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.tolerance_intervals import share_interval
from fluxbore.optimize.tolerance_result import FigureSpread, ToleranceResult
from fluxbore.optimize.tolerance_scatter import LinearSum, deviations

Array = NDArray[np.float64]

FURTHEST = 6.0
"""k of a normal distribution beyond which no limit is backed off."""

_HALVINGS = 40


def backed_off(limits: Sequence[Limit], result: ToleranceResult, target: float) -> tuple[Limit, ...]:
    """The limits that a nominal design near the analysed one must meet for a yield of ``target``.

    limits : of the production, each of them one that ``result`` was made with. The joint yield aimed at is such that
    the lower end of its confidence interval is the target, and higher by as much as the samples computed in full found
    fewer good actuators than the linear model. A limit is never moved outwards.
    """
    margins = [_Margin(limit, result) for limit in limits]
    if not margins:
        return ()
    sample = deviations(result.production.tolerances, result.examined, result.production.seed)
    shifts = [margin.shifts(sample) for margin in margins]
    buildable = 1 - sum(item.count for item in result.rejects) / result.examined
    aim = target + max(0.0, result.simulated.value - result.best_estimate.value)

    def enough(k: float) -> bool:
        rooms = [max(margin.room, margin.off(float(ndtr(k)))) for margin in margins]
        met = np.ones(result.examined, dtype=bool)
        for shift, room in zip(shifts, rooms, strict=True):
            met &= shift <= room + 1e-12 * abs(room)
        return share_interval(int(met.sum() * buildable), result.examined).low >= aim

    low, high = float(ndtri(min(max(target, 0.5), 1 - 1e-9))), FURTHEST
    for _ in range(_HALVINGS if not enough(low) else 0):
        middle = (low + high) / 2
        low, high = (low, middle) if enough(middle) else (middle, high)
    share = float(ndtr(high if not enough(low) else low))
    return tuple(margin.moved(share) for margin in margins)


class _Margin:
    """One limit with the distribution of its subject, both turned so that larger is worse."""

    def __init__(self, limit: Limit, result: ToleranceResult) -> None:
        spread = result.figure(limit.subject)
        if spread is None:
            raise KeyError(limit.subject)
        self.limit = limit
        self._sign = 1.0 if limit.sense == "<=" else -1.0
        self._total = _sum(spread, result, self._sign)
        self.room = self._sign * (limit.limit - spread.nominal)

    def shifts(self, sample: Array) -> Array:
        """(samples,): how much worse than the nominal value each is."""
        made: Array = sample @ np.array(self._total.slopes)
        return made

    def off(self, share: float) -> float:
        """The room that the share of samples needs, never negative."""
        return max(0.0, self._total.quantile(share))

    def moved(self, share: float) -> Limit:
        return replace(self.limit, limit=self.limit.limit - self._sign * self.off(share))


def _sum(spread: FigureSpread, result: ToleranceResult, sign: float) -> LinearSum:
    tolerances = result.production.tolerances
    return LinearSum(tolerances, tuple(sign * spread.slopes[item.key] for item in tolerances))
