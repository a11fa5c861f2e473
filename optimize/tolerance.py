"""What comes off the line: how the figures of one design scatter with its tolerances, and how many actuators are good.

First order: every figure is  nominal + sum of slope_i x deviation_i  with exact slopes where the model gives them, so
that its mean, its variance and each tolerance's share of it, and its worst case follow without sampling. The yield of
all limits together is counted in seeded samples of that linear model. As many of these samples as ``checks`` says are
computed in full; they correct the linear model (control variates) and say how far it can be trusted.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import SpecError
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec
from fluxbore.design.study import Production
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import Fidelity
from fluxbore.optimize.evaluator import Evaluate, Evaluator
from fluxbore.optimize.executor import Executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.problem import resolve_limits
from fluxbore.optimize.progress import Report, Tracker
from fluxbore.optimize.tolerance_checks import Checks, run_checks
from fluxbore.optimize.tolerance_intervals import corrected_share, quantile_interval, share_interval
from fluxbore.optimize.tolerance_model import LinearModel, Subject, held_keys, linear_model, production_design
from fluxbore.optimize.tolerance_result import QUANTILES, FigureSpread, Interval, Requirement, ToleranceResult
from fluxbore.optimize.tolerance_scatter import deviations
from fluxbore.optimize.tolerance_shift import shifted_yield
from fluxbore.optimize.tolerance_warnings import warnings
from fluxbore.optimize.tolerance_yield import Scatter, expected_yield, meets, scatter

Array = NDArray[np.float64]


def run_tolerance(
    spec: Spec,
    journal: Journal | None,
    executor: Executor,
    progress: Report | None = None,
    evaluate: Evaluate = evaluate_design,
    *,
    limits: Sequence[Limit] | None = None,
    fidelity: Fidelity = "fem",
) -> ToleranceResult:
    """Analyse the design that the specification itself describes; `fluxbore.optimize.tolerance_robust.made_design`
    makes one of what a search found.

    limits : to hold the production to; None for the study's constraints, where "start" is then this very design.
    With the journal of an analysis that was killed nothing is computed twice.

    Raises SpecError where the study has no production or its tolerances do not fit the specification; DesignError
    where the nominal design has no figures, or not those that the limits name.
    """
    production = spec.study.production
    if production is None:
        raise SpecError("study.production must be given for a tolerance analysis; got none.")
    begin = time.monotonic()
    tolerances = production.tolerances
    design = production_design(spec, tolerances)
    evaluator = Evaluator(design, executor, journal, fidelity, evaluate, "tolerance")
    subjects = None if limits is None else [limit.subject for limit in limits]
    needed = [item.subject for item in spec.study.constraints] if subjects is None else subjects
    objective = spec.study.objective
    model = linear_model(evaluator, tolerances, [*([objective.figure] if objective else []), *needed])
    if limits is None:
        limits = resolve_limits(design, model.nominal)
    tracker = Tracker("tolerance", 1 + production.checks, progress, None)
    tracker.add({item.key: design.number(item.key) for item in tolerances}, model.nominal)

    samples = deviations(tolerances, production.samples, production.seed)
    built = scatter(evaluator, tolerances, samples, production.checks)
    linear = _Linear(production, model, tuple(limits), samples, built, built.verdicts(limits, model.subjects))
    checks = run_checks(evaluator, tolerances, samples[: production.checks], linear.limits, model.subjects, tracker)
    spreads = tuple(_spread(linear, subject, checks) for subject in _order(model, linear.limits))
    requirements = tuple(_requirement(linear, column, checks) for column in range(len(linear.limits)))
    good = linear.good
    count = len(checks.full)
    simulated = share_interval(int(good.sum()), len(good))
    checked = corrected_share(good, checks.joint(linear.verdicts, built.built), checks.all) if count else None
    direct = share_interval(int(checks.all.sum()), count) if count else None
    return ToleranceResult(
        production=production,
        values={item.key: design.number(item.key) for item in tolerances},
        held=held_keys(design, tolerances),
        nominal=model.nominal,
        figures=spreads,
        requirements=requirements,
        simulated=simulated,
        examined=len(good),
        effects=built.effects(linear.limits, model.subjects),
        rejects=built.rejects,
        failures=checks.failures,
        checked=checked,
        direct=direct,
        shifted=_shifted(linear, range(len(linear.limits)), checks, alone=False),
        warnings=warnings(spec, spreads, requirements, simulated, direct, production),
        evaluations=model.evaluations + checks.evaluations,
        reused=model.reused + checks.reused,
        seconds=time.monotonic() - begin,
    )


@dataclass(frozen=True, slots=True)
class _Linear:
    """All that the linear model says: verdicts are (examined, limits)."""

    production: Production
    model: LinearModel
    limits: tuple[Limit, ...]
    samples: Array
    built: Scatter
    verdicts: NDArray[np.bool_]

    @property
    def good(self) -> NDArray[np.bool_]:
        """(examined,): can be built and meets every limit."""
        return np.asarray(self.built.built & self.verdicts.all(axis=1))


def _order(model: LinearModel, limits: Sequence[Limit]) -> list[Subject]:
    """The subjects to report: what was needed first, as `linear_model` was asked; then the figures that scatter."""
    named = [limit.subject for limit in limits]
    rest = [name for name in FIGURES if name in model.subjects and model.subjects[name].scatters]
    return [model.subjects[name] for name in dict.fromkeys([*model.first, *named, *rest])]


def _spread(linear: _Linear, subject: Subject, checks: Checks) -> FigureSpread:
    keys = [item.key for item in linear.production.tolerances]
    total = subject.total
    worst = total.worst
    ordered = np.sort(subject.values(linear.samples))
    return FigureSpread(
        subject=subject.name,
        nominal=subject.nominal,
        mean=subject.mean,
        sigma=total.sigma,
        worst_low=subject.nominal + worst[0],
        worst_high=subject.nominal + worst[1],
        slopes=dict(zip(keys, subject.slopes, strict=True)),
        shares={
            key: part / total.variance if subject.scatters else 0.0
            for key, part in zip(keys, total.variances, strict=True)
        },
        exact=subject.exact,
        quantiles={share: quantile_interval(ordered, share) for share in QUANTILES},
        checked=checks.figure(subject),
    )


def _requirement(linear: _Linear, column: int, checks: Checks) -> Requirement:
    limit = linear.limits[column]
    subject = linear.model.subjects[limit.subject]
    room = limit.limit - subject.mean if limit.sense == "<=" else subject.mean - limit.limit
    others = np.delete(linear.verdicts, column, axis=1).all(axis=1) & linear.built.built
    alone = meets(limit, subject.values(linear.samples))
    count = len(checks.full)
    return Requirement(
        limit=limit,
        nominal=subject.nominal,
        margin=room / subject.total.sigma if subject.scatters else np.copysign(np.inf, room),
        expected=expected_yield(limit, subject),
        simulated=share_interval(int(alone.sum()), len(alone)),
        cost=float(np.mean(others) - np.mean(linear.good)),
        checked=corrected_share(alone, alone[:count], checks.full[:, column]) if count else None,
        shifted=_shifted(linear, [column], checks, alone=True),
    )


def _shifted(linear: _Linear, columns: Sequence[int], checks: Checks, *, alone: bool) -> Interval | None:
    """The yield of these limits; what cannot be built counts among all of them, and not against one alone."""
    limits = [linear.limits[column] for column in columns]
    subjects = [linear.model.subjects[limit.subject] for limit in limits]
    built = np.ones_like(linear.built.built) if alone else linear.built.built
    return shifted_yield(limits, subjects, linear.built.deviations, built, checks)
