"""A Pareto front: the study's objective against a second one, point by point and each from its neighbour's optimum."""

from __future__ import annotations

import inspect
import time
from dataclasses import replace

from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.design.spec import Spec
from fluxbore.design.study import FREE_ALGORITHMS, Objective, Pareto
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.evaluate import MODELS
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import failure
from fluxbore.optimize.evaluator import Evaluate, Evaluator
from fluxbore.optimize.executor import Executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.network_start import network_optimum
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.pareto_front import Front
from fluxbore.optimize.pareto_points import Points
from fluxbore.optimize.pareto_result import ParetoResult
from fluxbore.optimize.pareto_scalar import Scale
from fluxbore.optimize.pareto_sight import Sight
from fluxbore.optimize.pareto_table import front_table
from fluxbore.optimize.problem import Box, box, candidate, resolve_limits
from fluxbore.optimize.progress import Report, Tracker
from fluxbore.optimize.search import check_study

__all__ = ["front_table", "run_pareto"]


def run_pareto(
    spec: Spec,
    journal: Journal | None,
    executor: Executor,
    progress: Report | None = None,
    evaluate: Evaluate = evaluate_design,
) -> ParetoResult:
    """Look for the front of ``study.objective`` against ``study.pareto.against`` by FEM.

    Each of its points may ask for ``max_evaluations`` designs; all share one memory, begin where a neighbour ended and
    run in two lanes, one from each end. With gradients SLSQP looks for them, without them COBYLA. Nothing that happens
    to a design ends the run. Whatever does end it (all points found, the time limit, a full disk, Ctrl-C) stands in
    ``ending`` and ``stop_reason``. With the journal of a run that was killed, the same designs are asked for in the
    same order and none is computed twice.

    Raises SpecError where the study has no objective, no second one, no variables or counts as variables, or as
    `check_study` does; KeyboardInterrupt only before the first design is known.
    """
    objective, pareto = _asked(spec)
    check_study(spec)
    begin = time.monotonic()
    base = spec.for_study()
    search = base.study.search
    bounds = _bounds(base)
    gradients = search.algorithm not in FREE_ALGORITHMS and _offers_gradients(base, evaluate)
    evaluator = Evaluator(base, executor, journal, "fem", evaluate, "front", bounds.keys if gradients else ())
    objectives = (objective, pareto.against)

    own = {key: base.number(key) for key in bounds.keys}
    inside = bounds.contains(own)
    proposed = _proposals(base, bounds, objectives, evaluate) if search.network != "off" else []
    first = [own, *([] if inside else [bounds.values(bounds.point(own))]), *(dict(made.values) for made in proposed)]
    done = evaluator.all(first)
    begun = done[0].evaluation
    try:
        limits = resolve_limits(base, begun)
    except FluxboreError as error:
        start = candidate(base, objective, (), bounds.keys, begun)
        return ParetoResult(
            *(objective, pareto.against, pareto.method, start, (), (start,), None, None, str(error)),
            time.monotonic() - begin,
        )
    start = candidate(base, objective, limits, bounds.keys, begun)
    budget = len(first) + pareto.points * search.max_evaluations
    archive = Archive(evaluator, bounds, objective, limits, budget, Tracker("front", budget, progress, objective))
    held = tuple(limit for limit in limits if limit.subject not in bounds.keys)
    sight = Sight(base, bounds, Scale(objectives), held, search.relative_tolerance / 10, gradients)
    if gradients and not sight.has_slopes(start):
        sight = replace(sight, gradients=False)
    algorithm = search.algorithm if search.algorithm in ("MMA", "CCSAQ") else "SLSQP"
    algorithm = algorithm if sight.gradients else "COBYLA"
    points = Points(pareto, search, algorithm, archive, sight)
    front = Front(points, None if search.time_limit is None else begin + search.time_limit)
    front.run(first if inside else first[1:], done if inside else done[1:])
    return ParetoResult(
        objective=objective,
        against=pareto.against,
        method=pareto.method,
        start=start,
        points=points.listed(),
        history=tuple(archive.history) if inside else (start, *archive.history),
        reference=front.reference,
        hypervolume=front.hypervolume,
        stop_reason=front.reason,
        seconds=time.monotonic() - begin,
        ending=front.ending,
        reused=archive.reused,
        conflicting=front.conflicting,
        algorithm=algorithm,
    )


def _asked(spec: Spec) -> tuple[Objective, Pareto]:
    """The objective and what it stands against. Raises SpecError where the study does not ask for a front."""
    study = spec.study
    if study.objective is None or study.pareto is None or not study.variables:
        missing = (
            "study.objective" if study.objective is None else "study.pareto" if study.pareto is None else "variables"
        )
        missing = "study.variables" if missing == "variables" else missing
        raise SpecError(f"{missing} must be given for a front; got none.")
    if study.pareto.against.figure == study.objective.figure:
        raise SpecError(
            f"study.pareto.against must be another figure than the objective's; got {study.objective.figure} for both."
        )
    counts = [variable.key for variable in study.variables if variable.integer]
    if counts:
        raise SpecError(f"study.variables must be continuous for a front; got the count {counts[0]}.")
    return study.objective, study.pareto


def _bounds(base: Spec) -> Box:
    """The box of the variables, with the limits on them."""
    keys = {variable.key for variable in base.study.variables}
    known = resolve_limits(base, failure("network", "", ""))
    return box(base, [limit for limit in known if limit.subject in keys])


def _offers_gradients(base: Spec, evaluate: Evaluate) -> bool:
    """Whether the model takes the keys of a gradient; what it makes of them, its first evaluation shows."""
    if evaluate is evaluate_design:
        return MODELS[base.kind.name].gradients
    return "gradient" in inspect.signature(evaluate).parameters


def _proposals(base: Spec, bounds: Box, objectives: tuple[Objective, Objective], evaluate: Evaluate) -> list[Candidate]:
    """The magnetic network's own optima of both objectives, where the ends' searches may begin."""
    studies = [replace(base, study=replace(base.study, objective=objective)) for objective in objectives]
    found = [network_optimum(study, bounds, evaluate) for study in studies]
    return [made for made in found if made is not None]
