"""The search: the network proposes, the finite elements decide, and the best feasible design is never lost."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence

from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.design.study import GRADIENT_ALGORITHMS
from fluxbore.optimize.enumeration import combinations
from fluxbore.optimize.evaluate import MODELS
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import failure
from fluxbore.optimize.evaluator import Evaluate, Evaluator
from fluxbore.optimize.executor import Executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.network_start import network_optimum as network_optimum
from fluxbore.optimize.outcome import Candidate, Limit, SearchResult, SweepResult
from fluxbore.optimize.problem import Box, box, candidate, check, resolve_limits, show_limit
from fluxbore.optimize.progress import Report, Tracker
from fluxbore.optimize.search_run import SearchRun
from fluxbore.optimize.sweep import DEFAULT_OBJECTIVE, numbers


def run_search(
    spec: Spec,
    journal: Journal | None,
    executor: Executor,
    progress: Report | None = None,
    evaluate: Evaluate = evaluate_design,
    gradients: bool | None = None,
) -> SearchResult:
    """Look for the study's best feasible design by FEM, within ``max_evaluations`` designs, the start among them.

    gradients : whether ``evaluate`` brings derivatives; None asks `fluxbore.optimize.evaluate.MODELS`.

    Nothing that happens to a design ends the search. Whatever does end it (convergence, budget, a full disk, Ctrl-C)
    stands in ``ending`` and ``stop_reason``, and the best feasible design so far in ``best``. With the journal of a
    search that was killed, the same designs are asked for in the same order and none is computed twice.

    Raises SpecError where the study has no objective or no variables, or as `check_study` does; KeyboardInterrupt only
    before the first design is known.
    """
    study = spec.study
    if study.objective is None or not study.variables:
        missing = "study.objective" if study.objective is None else "study.variables"
        raise SpecError(f"{missing} must be given for a search; got none.")
    check_study(spec)
    begin = time.monotonic()
    base, search = spec.for_study(), study.search
    bounds = _bounds(base)
    given = gives_gradients(spec, evaluate) if gradients is None else gradients
    algorithm, remark = _algorithm(search.algorithm, given and bool(bounds.keys))
    wanted = algorithm in GRADIENT_ALGORITHMS or search.network == "manifold"
    slopes = bounds.keys if given and wanted else ()
    run = SearchRun(
        base=base,
        bounds=bounds,
        combinations=combinations(base, _known_limits(base)),
        algorithm=algorithm,
        evaluator=Evaluator(base, executor, journal, "fem", evaluate, "search", slopes),
        gradients=given,
        tracker=Tracker("search", search.max_evaluations, progress, study.objective),
        deadline=math.inf if search.time_limit is None else begin + search.time_limit,
    )
    return run.result(remark, begin)


def gives_gradients(spec: Spec, evaluate: Evaluate) -> bool:
    """Whether evaluations by this function bring derivatives, as far as the table of models knows."""
    model = MODELS.get(spec.kind.name)
    return evaluate is evaluate_design and model is not None and model.gradients


def _algorithm(wanted: str, gradients: bool) -> tuple[str, str]:
    """The algorithm to run, and what there is to say where it is not the one that is wanted."""
    if wanted == "auto":
        return ("SLSQP" if gradients else "COBYLA"), ""
    if wanted in GRADIENT_ALGORITHMS and not gradients:
        return "COBYLA", f"{wanted} needs derivatives, which there are none of here, so COBYLA searched. "
    return wanted, ""


def check_study(spec: Spec) -> None:
    """Refuse a search that cannot succeed, as far as that is known without a field. Raises SpecError.

    That is where limits leave a variable no room, or a limit on a key that no variable moves is missed at the start;
    "1.1 x start" on a key counts, for the start's own keys are known.
    """
    base = spec.for_study()
    _bounds(base)
    combinations(base, _known_limits(base))
    _check_objectives(base)
    moving = {variable.key for variable in base.study.variables}
    for item in check(_known_limits(base), base.values, Performance(), "network") if moving else ():
        name = item.limit.subject
        if item.satisfied or name in moving or name not in base.given:
            continue
        word = "at most" if item.limit.sense == "<=" else "at least"
        raise SpecError(
            f"study.constraints cannot be met: {name} would have to be {word} {show_limit(base, item.limit)}, but no "
            f"variable moves it from {base.kind.known(name).show(base.number(name))}."
        )


def _check_objectives(base: Spec) -> None:
    """Refuse an objective that no design has. Raises SpecError."""
    study, model = base.study, MODELS.get(base.kind.name)
    named = {"study.objective": study.objective, "study.pareto.against": study.pareto.against if study.pareto else None}
    for where, objective in named.items() if model is not None else ():
        why = None if objective is None or model is None else model.never(base, objective.figure)
        if objective is not None and why is not None:
            raise SpecError(
                f"{where} must name a figure that the designs have; {objective.figure} is not given: {why}."
            )


def one_at_a_time(
    spec: Spec,
    sweeps: Sequence[SweepResult],
    journal: Journal | None,
    executor: Executor,
    evaluate: Evaluate = evaluate_design,
) -> Candidate | None:
    """What choosing each quantity by itself amounts to: the best value of every sweep of one axis, all in one design.

    It is evaluated by FEM and held against the study's limits. None without such a sweep, without a sound row in one,
    or where limits refer to a start that has no figures.
    """
    objective = spec.study.objective or DEFAULT_OBJECTIVE
    base = spec.for_study()
    chosen: dict[str, float] = {}
    for result in sweeps:
        best = result.best(objective.figure, objective.maximise) if len(result.sweep.axes) == 1 else None
        if best is not None:
            chosen.update(best.values)
    if not chosen:
        return None
    evaluator = Evaluator(base, executor, journal, "fem", evaluate, "one at a time")
    start, joint = evaluator.all([{}, chosen])
    try:
        limits = resolve_limits(base, start.evaluation)
    except FluxboreError:  # the search says why
        return None
    keys = list(dict.fromkeys([*(variable.key for variable in spec.study.variables), *chosen]))
    try:
        return candidate(evaluator.design(chosen), objective, limits, keys, joint.evaluation)
    except FluxboreError:  # the two choices cannot stand in one design, which its evaluation says
        return Candidate(numbers(chosen), joint.evaluation, None, ())


def _known_limits(base: Spec) -> tuple[Limit, ...]:
    """The limits whose numbers are known before the first evaluation: all but those relative to the start's figures."""
    return resolve_limits(base, failure("network", "", ""))


def _bounds(base: Spec) -> Box:
    """The box of the variables, with the limits on them."""
    keys = {variable.key for variable in base.study.variables}
    return box(base, [limit for limit in _known_limits(base) if limit.subject in keys])
