"""The search: the network proposes, the finite elements decide, and the best feasible design is never lost."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence

from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.optimize import nlopt_loop
from fluxbore.optimize.archive import Archive, BudgetUsedError
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import failure
from fluxbore.optimize.evaluator import Evaluate, Evaluator
from fluxbore.optimize.executor import Executor, SerialExecutor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import Candidate, Limit, SearchResult, SweepResult
from fluxbore.optimize.problem import Box, Merit, box, candidate, check, resolve_limits, show_limit, violation
from fluxbore.optimize.progress import Report, Tracker
from fluxbore.optimize.stages import FIRST_STEP, Stages
from fluxbore.optimize.sweep import DEFAULT_OBJECTIVE, numbers

NETWORK_CALLS = 150
"""Calls of the network for each variable in the global search for its optimum; it costs a thousandth of the FEM."""


def run_search(
    spec: Spec,
    journal: Journal | None,
    executor: Executor,
    progress: Report | None = None,
    evaluate: Evaluate = evaluate_design,
) -> SearchResult:
    """Look for the study's best feasible design by FEM, within ``max_evaluations`` designs, the start among them.

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
    base = spec.for_study()
    bounds = _bounds(base)
    budget = study.search.max_evaluations
    evaluator = Evaluator(base, executor, journal, "fem", evaluate, "search")
    network = network_optimum(base, bounds, evaluate)

    # The first designs side by side: the start as it is (limits refer to it), clipped into the bounds, the network's.
    own = {key: base.number(key) for key in bounds.keys}
    inside = bounds.contains(own)
    first = [own, *([] if inside else [bounds.values(bounds.point(own))]), *([network.values] if network else [])][
        :budget
    ]
    done = evaluator.all(first)
    try:
        limits = resolve_limits(base, done[0].evaluation)
    except FluxboreError as error:
        start = candidate(base, study.objective, (), bounds.keys, done[0].evaluation)
        return SearchResult(start, network, (start,), (None,), None, None, str(error), time.monotonic() - begin)
    start = candidate(base, study.objective, limits, bounds.keys, done[0].evaluation)
    tracker = Tracker("search", budget, progress, study.objective)
    # A start outside the bounds is not one of the search's designs, but it has cost one.
    archive = Archive(evaluator, bounds, study.objective, limits, budget if inside else budget - 1, tracker)
    stages = Stages(
        archive=archive,
        study=study,
        merit=Merit(study.objective, _size(start, *(network,) if network else ())),
        held=[limit for limit in limits if limit.subject not in bounds.keys],
        back_off=study.search.relative_tolerance / 10,
    )
    reason = stages.run(first if inside else first[1:], done if inside else done[1:]) + _shortfall(base, archive)
    return SearchResult(
        start=start,
        network_start=network,
        history=tuple(archive.history),
        best_so_far=tuple(archive.best_so_far),
        best=archive.best,
        rounded=stages.rounded,
        stop_reason=reason,
        seconds=time.monotonic() - begin,
        ending=stages.ending,
        reused=archive.reused,
    )


def check_study(spec: Spec) -> None:
    """Refuse a search that cannot succeed, as far as that is known without a field. Raises SpecError.

    That is where limits leave a variable no room, or a limit on a key that no variable moves is missed at the start;
    "1.1 x start" on a key counts, for the start's own keys are known.
    """
    base = spec.for_study()
    bounds = _bounds(base)
    for item in check(_known_limits(base), base.values, Performance(), "network") if bounds.keys else ():
        name = item.limit.subject
        if item.satisfied or name in bounds.keys or name not in base.given:
            continue
        word = "at most" if item.limit.sense == "<=" else "at least"
        raise SpecError(
            f"study.constraints cannot be met: {name} would have to be {word} {show_limit(base, item.limit)}, but no "
            f"variable moves it from {base.kind.known(name).show(base.number(name))}."
        )


def network_optimum(base: Spec, bounds: Box, evaluate: Evaluate) -> Candidate | None:
    """The magnetic network's own optimum under those limits that it can evaluate; None where it finds none.

    Global (DIRECT-L), then local (COBYLA); a few hundred calls of microseconds, in this process.
    """
    objective = base.study.objective or DEFAULT_OBJECTIVE
    evaluator = Evaluator(base, SerialExecutor(), None, "network", evaluate, "search")
    start = evaluator.all([{}])[0].evaluation
    limits = [
        limit
        for limit in resolve_limits(base, start)
        if limit.subject not in bounds.keys
        and (limit.subject in base.values or getattr(start.performance, limit.subject) is not None)
    ]
    calls = NETWORK_CALLS * len(bounds.keys)
    archive = Archive(evaluator, bounds, objective, limits, 2 * calls)
    made = candidate(base, objective, limits, bounds.keys, start)
    stages = Stages(archive, base.study, Merit(objective, _size(made)), limits, back_off=0.0)
    for algorithm in ("DIRECT-L", "COBYLA"):
        best = archive.best
        if algorithm == "COBYLA" and best is None:
            break
        origin = archive.box.point({key: base.number(key) for key in bounds.keys} if best is None else best.values)
        ending = nlopt_loop.minimise(
            algorithm,
            stages.see,
            len(limits),
            origin,
            step=FIRST_STEP / 2,
            objective_tolerance=1e-7,
            variable_tolerance=1e-4,
            seed=base.study.search.seed,
            calls=calls,
        )
        if ending.stopped_by is not None and not isinstance(ending.stopped_by, BudgetUsedError):
            raise ending.stopped_by
    return archive.best


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


def _shortfall(base: Spec, archive: Archive) -> str:
    """Where no design was feasible: which limits the nearest one missed, and by how much."""
    if archive.best is not None or not archive.history:
        return ""
    nearest = min(archive.history, key=violation)
    if math.isinf(violation(nearest)):
        return " None of its designs could be evaluated in full."
    missed = [
        f"{item.limit.subject} {item.limit.sense} {show_limit(base, item.limit)} by {-item.margin:.2%}"
        for item in nearest.checks
        if not item.satisfied and item.margin is not None
    ]
    return f" No design met every limit; the nearest missed {' and '.join(missed)}."


def _size(*designs: Candidate) -> float:
    """The objective's size, for scaling: the first design's that has one."""
    for design in designs:
        if design.objective and math.isfinite(design.objective):
            return abs(design.objective)
    return 1.0
