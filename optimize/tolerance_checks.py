"""Samples computed in full: what the linear model is corrected by and judged with."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import FluxboreError
from fluxbore.design.performance import FIGURES
from fluxbore.design.study import Tolerance
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.problem import check
from fluxbore.optimize.progress import Tracker
from fluxbore.optimize.tolerance_intervals import mean_interval
from fluxbore.optimize.tolerance_model import Subject
from fluxbore.optimize.tolerance_result import CheckedFigure, Interval, Reject
from fluxbore.optimize.tolerance_yield import counted, values

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Checks:
    """The first samples, computed in full.

    deviations : (checks, keys). figures : subject -> (checks,) values, NaN where the sample has none.
    sound : (checks,) whether there are figures at all. full : (checks, limits) which limits are met; a sample without
    figures meets none. failures : why samples have no figures.
    """

    deviations: Array
    figures: Mapping[str, Array]
    sound: Flags
    full: Flags
    failures: tuple[Reject, ...]
    evaluations: int
    reused: int

    @property
    def all(self) -> Flags:
        """(checks,): sound and within every limit."""
        return np.asarray(self.sound & self.full.all(axis=1))

    def joint(self, verdicts: Flags, built: Flags) -> Flags:
        """(checks,): what the linear model says of the same samples."""
        count = len(self.full)
        return np.asarray(verdicts[:count].all(axis=1) & built[:count])

    def figure(self, subject: Subject) -> CheckedFigure | None:
        """The subject in the sound samples against the linear model; None without such a sample.

        The mean over the production is the linear model's exact mean plus the mean of full minus linear: the linear
        model as control variate, its coefficient 1, so that the estimate has no bias.
        """
        full = self.figures[subject.name]
        known = np.isfinite(full)
        if not known.any():
            return None
        rest = full[known] - subject.values(self.deviations[known])
        bias = mean_interval(rest)
        mean = Interval(subject.mean + bias.value, subject.mean + bias.low, subject.mean + bias.high)
        return CheckedFigure(int(known.sum()), mean, bias.value, math.sqrt(float(np.mean(rest**2))))


def run_checks(
    evaluator: Evaluator,
    tolerances: Sequence[Tolerance],
    deviations: Array,
    limits: Sequence[Limit],
    subjects: Mapping[str, Subject],
    tracker: Tracker,
) -> Checks:
    """Compute the samples ``deviations`` (checks, keys) by the evaluator's route.

    A sample that cannot be built, does not converge or crashes its process is a reject with its reason.
    """
    samples = [values(evaluator, tolerances, row) for row in deviations]
    figures = {name: np.full(len(samples), np.nan) for name in subjects}
    sound = np.zeros(len(samples), dtype=bool)
    full = np.zeros((len(samples), len(limits)), dtype=bool)
    reasons: dict[int, str] = {}
    reused = 0
    for item in evaluator.each(samples):
        reused += item.reused
        tracker.add(samples[item.index], item.evaluation, reused=item.reused)
        if not item.evaluation.ok:
            reasons[item.index] = " ".join(item.evaluation.reasons) or item.evaluation.status
            continue
        sound[item.index] = True
        found = _found(evaluator, samples[item.index], item.evaluation, limits, subjects)
        full[item.index] = found[1]
        for name, value in found[0].items():
            figures[name][item.index] = value
    failures = counted(reasons[index] for index in sorted(reasons))
    return Checks(deviations, figures, sound, full, failures, len(samples), reused)


def _found(
    evaluator: Evaluator,
    sample: Mapping[str, float],
    evaluation: Evaluation,
    limits: Sequence[Limit],
    subjects: Mapping[str, Subject],
) -> tuple[dict[str, float], list[bool]]:
    """One sound sample's subjects, those that it has, and which limits it meets."""
    try:
        resolved = evaluator.design(sample).values
    except FluxboreError:  # an evaluation of it exists, so that this is a model that builds what its kind refuses
        resolved = evaluator.base.values
    found = {}
    for name in subjects:
        value = getattr(evaluation.performance, name) if name in FIGURES else resolved[name]
        if value is not None and not isinstance(value, str):
            found[name] = float(value)
    made = check(limits, resolved, evaluation.performance, "fem")
    return found, [item.satisfied for item in made]
