"""The yield of a production: samples of the linear model held against the limits, and what decides it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import FluxboreError
from fluxbore.design.study import Tolerance
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.problem import FEASIBILITY
from fluxbore.optimize.tolerance_model import Subject
from fluxbore.optimize.tolerance_result import Reject, ToleranceEffect

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

EXAMINED = 50_000
"""Samples that are built, without a field, to see whether they can be; a third of a millisecond each."""

_NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", re.IGNORECASE)


def meets(limit: Limit, values: Array) -> Flags:
    """Which values hold the limit, to the rounding errors that a search allows too."""
    slack = FEASIBILITY * limit.size
    made = values <= limit.limit + slack if limit.sense == "<=" else values >= limit.limit - slack
    return np.asarray(made)


def expected_yield(limit: Limit, subject: Subject) -> float:
    """The share that meets the limit by the linear model, without sampling."""
    slack = FEASIBILITY * limit.size
    if not subject.scatters:
        return float(meets(limit, np.array([subject.mean]))[0])
    if limit.sense == "<=":
        return subject.total.below(limit.limit + slack - subject.nominal)
    return 1 - subject.total.below(limit.limit - slack - subject.nominal)


@dataclass(frozen=True, slots=True)
class Scatter:
    """The samples that were built: their deviations (examined, keys), which can be built, and why others cannot."""

    evaluator: Evaluator
    tolerances: tuple[Tolerance, ...]
    deviations: Array
    built: Flags
    rejects: tuple[Reject, ...]

    def verdicts(self, limits: Sequence[Limit], subjects: Mapping[str, Subject]) -> Flags:
        """(examined, limits): which limits each sample meets by the linear model."""
        return _verdicts(limits, subjects, self.deviations)

    def effects(self, limits: Sequence[Limit], subjects: Mapping[str, Subject]) -> tuple[ToleranceEffect, ...]:
        """What halving each tolerance would buy, by the same samples with that key's deviation halved.

        A sample that could be built is tried again as one that could not: where two keys exclude one another, what
        moves nearer the nominal value leaves the other one no room. If no sample is a reject, none is tried: the
        halved production is at most a few times as dense anywhere as the whole one, so that its rejects are then
        within the yield's interval.

        Sorted by the gain in yield; where that is the same, by the largest share of a requirement's variance.
        """
        now = float(np.mean(self.built & self.verdicts(limits, subjects).all(axis=1)))
        made = []
        for column, tolerance in enumerate(self.tolerances):
            halved = self.deviations.copy()
            halved[:, column] /= 2
            good: Flags = np.array(_verdicts(limits, subjects, halved).all(axis=1))
            for row in np.flatnonzero(good) if not self.built.all() else ():
                good[row] = why_not(self.evaluator, values(self.evaluator, self.tolerances, halved[row])) is None
            share = float(np.mean(good))
            shares = tuple(_share(subjects[limit.subject], column) for limit in limits)
            made.append(ToleranceEffect(tolerance, share, share - now, shares))
        return tuple(sorted(made, key=lambda item: (-item.gain, -max(item.shares, default=0.0))))


def scatter(evaluator: Evaluator, tolerances: Sequence[Tolerance], deviations: Array, least: int = 0) -> Scatter:
    """Build each of the samples, as far as `EXAMINED` and at least ``least``."""
    deviations = deviations[: max(EXAMINED, least)]
    reasons = [why_not(evaluator, values(evaluator, tolerances, row)) for row in deviations]
    built = np.array([reason is None for reason in reasons], dtype=bool)
    return Scatter(evaluator, tuple(tolerances), deviations, built, counted(reason for reason in reasons if reason))


def values(evaluator: Evaluator, tolerances: Sequence[Tolerance], deviations: Array) -> dict[str, float]:
    """One sample's values at the toleranced keys."""
    return {
        item.key: evaluator.base.number(item.key) + float(step)
        for item, step in zip(tolerances, deviations, strict=True)
    }


def why_not(evaluator: Evaluator, sample: Mapping[str, float]) -> str | None:
    """Why there is no such design; None where it can be built."""
    try:
        evaluator.design(sample)
    except FluxboreError as error:
        return str(error)
    except ArithmeticError as error:
        return f"The design cannot be built: {type(error).__name__}: {error}."
    return None


def counted(reasons: Iterable[str]) -> tuple[Reject, ...]:
    """Equal reasons counted, the most frequent first; sentences that differ in their numbers alone are equal."""
    first: dict[str, str] = {}
    counts: dict[str, int] = {}
    for reason in reasons:
        form = _NUMBER.sub("#", reason)
        first.setdefault(form, reason)
        counts[form] = counts.get(form, 0) + 1
    return tuple(Reject(first[form], counts[form]) for form in sorted(counts, key=lambda form: -counts[form]))


def _verdicts(limits: Sequence[Limit], subjects: Mapping[str, Subject], deviations: Array) -> Flags:
    made = [meets(limit, subjects[limit.subject].values(deviations)) for limit in limits]
    return np.stack(made, axis=1) if made else np.ones((len(deviations), 0), dtype=bool)


def _share(subject: Subject, column: int) -> float:
    return subject.total.variances[column] / subject.total.variance if subject.scatters else 0.0
