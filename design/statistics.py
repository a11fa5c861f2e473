"""Statistics of repeated measurements under several conditions, as experimental papers report them.

Friedman's test by ranks (Friedman 1937), with every pair of conditions compared by Wilcoxon's signed-rank test
(Wilcoxon 1945) and p-values corrected after Bonferroni; Spearman's rank correlation for trends.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Friedman:
    """chi2 with `degrees` of freedom and its p-value; rank_sums : by condition, one being the smallest value's rank."""

    chi2: float
    p: float
    degrees: int
    rank_sums: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two conditions, cell by cell.

    statistic : Wilcoxon's, the smaller of the two rank sums. p : two-sided. corrected : p times the number of
    comparisons, at most one. medians : of the two conditions. lower : cells in which the first is below the second.
    """

    first: str
    second: str
    statistic: float
    p: float
    corrected: float
    medians: tuple[float, float]
    lower: int


def root_mean_square(error: ArrayLike) -> float:
    """sqrt(mean of x^2) of a record of at least one value."""
    values = np.asarray(error, dtype=np.float64)
    return float(np.sqrt(np.mean(values * values)))


def friedman(cells: Mapping[str, Floats]) -> Friedman:
    """Whether conditions differ over the same cells.

    cells : condition -> (n,) values, three conditions or more; ties share their ranks. Where every cell has only
    ties, nothing differs: chi2 is zero and p is one. chi2 is approximate, as always, and good from about ten cells.
    """
    values = np.array(list(cells.values()))
    ranks = stats.rankdata(values, axis=0)
    sums = dict(zip(cells, (float(total) for total in ranks.sum(axis=1)), strict=True))
    if np.all(values == values[0]):
        return Friedman(0.0, 1.0, len(values) - 1, sums)
    found = stats.friedmanchisquare(*values)
    return Friedman(float(found.statistic), float(found.pvalue), len(values) - 1, sums)


def compare(cells: Mapping[str, Floats]) -> tuple[Comparison, ...]:
    """Every pair of conditions, in their order, with Bonferroni's correction for their number.

    cells : condition -> (n,) values of the same cells. p is exact for up to fifty cells without ties and zeros, normal
    beyond; a cell in which both are equal tells nothing and drops out. Where all are equal, p is one.
    """
    pairs = list(combinations(cells, 2))
    found = []
    for first, second in pairs:
        a, b = cells[first], cells[second]
        differences = np.asarray(a - b)
        differing = differences[differences != 0]
        if len(differing):
            test = stats.wilcoxon(differing)
            statistic, p = float(test.statistic), float(test.pvalue)
        else:
            statistic, p = 0.0, 1.0
        medians = float(np.median(a)), float(np.median(b))
        below = int(np.sum(differences < 0))
        found.append(Comparison(first, second, statistic, p, min(1.0, len(pairs) * p), medians, below))
    return tuple(found)


def trend(x: ArrayLike, y: ArrayLike) -> float:
    """Spearman's rank correlation: 1 where y rises with x throughout, -1 where it falls; 0 where either is constant."""
    x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    if np.ptp(x) == 0 or np.ptp(y) == 0:
        return 0.0
    return float(stats.spearmanr(x, y).statistic)
