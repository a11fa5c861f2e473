"""The search: the network proposes, the finite elements decide, and the best feasible design is never lost."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.design.spec import Spec
from fluxbore.design.study import Search
from fluxbore.optimize import nlopt_loop, rounding
from fluxbore.optimize.archive import Archive, BudgetUsedError
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import failure
from fluxbore.optimize.evaluator import Evaluate, Evaluated, Evaluator
from fluxbore.optimize.executor import Executor, SerialExecutor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import Candidate, Limit, SearchResult, SweepResult
from fluxbore.optimize.polish import polish
from fluxbore.optimize.problem import Box, Merit, Point, better, box, candidate, resolve_limits, violation
from fluxbore.optimize.progress import Report, Tracker
from fluxbore.optimize.sweep import DEFAULT_OBJECTIVE, numbers

FIRST_STEP = 0.1
"""First step of the local searches, of each variable's range."""

GLOBAL_SHARE = 0.6
"""What a global algorithm gets of the budget; the rest is for the local search after it."""

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
    stands in ``stop_reason``, and the best feasible design so far in ``best``. With the journal of a search that was
    killed, the same designs are asked for in the same order and none is computed twice.

    Raises SpecError where the study has no objective or no variables, or limits leave a variable no room;
    KeyboardInterrupt only before the first design is known.
    """
    study = spec.study
    if study.objective is None or not study.variables:
        missing = "study.objective" if study.objective is None else "study.variables"
        raise SpecError(f"{missing} must be given for a search; got none.")
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
    run = _Run(base, archive, start)
    reason = run.all(first if inside else first[1:], done if inside else done[1:]) + _shortfall(archive)
    return SearchResult(
        start=start,
        network_start=network,
        history=tuple(archive.history),
        best_so_far=tuple(archive.best_so_far),
        best=archive.best,
        rounded=run.rounded,
        stop_reason=reason,
        seconds=time.monotonic() - begin,
    )


@dataclass(slots=True)
class _Run:
    """The stages of one search over its archive."""

    base: Spec
    archive: Archive
    start: Candidate
    rounded: Candidate | None = None
    penalties: dict[Point, float] = field(default_factory=dict)

    def all(self, first: Sequence[Mapping[str, float]], done: Sequence[Evaluated]) -> str:
        """Run every stage; returns in words why the search ended."""
        variables, most = self.base.study.variables, self.archive.budget
        reserve = min(rounding.count(variables), most // 3)
        self.archive.budget = most - reserve
        try:
            begun = [self.archive.adopt(v, d.evaluation, d.reused) for v, d in zip(first, done, strict=True)]
            reason = self.search(begun)
        except KeyboardInterrupt:
            return "The search was interrupted."
        except Exception as error:
            return _mishap(error)
        self.archive.budget = most
        try:
            self.rounded = rounding.round_off(self.archive, variables)
        except KeyboardInterrupt:
            return f"{reason} The rounding to the workshop's steps was interrupted."
        except Exception as error:
            return f"{reason} The rounding to the workshop's steps failed: {_mishap(error)}"
        return reason

    def search(self, begun: Sequence[Candidate]) -> str:
        """NLopt from the better of the first designs, then the polishing; BudgetUsedError is an ending like others."""
        archive, search = self.archive, self.base.study.search
        objective = archive.objective
        spent = f"The search used up its budget of {search.max_evaluations} FEM designs."
        if not begun:
            return spent
        origin = begun[0]
        for other in begun[1:]:
            origin = other if better(other, origin, objective) else origin
        held = [limit for limit in archive.limits if limit.subject not in archive.box.keys]
        merit = Merit(objective, _size(self.start, origin))
        # Searches close in on a limit from both sides; leaving it this much room makes what they find feasible.
        back_off = search.relative_tolerance / 10
        point = archive.box.point(origin.values)
        try:
            reason = ""
            if search.algorithm in nlopt_loop.GLOBAL:
                reason = f"{search.algorithm} looked at the whole range; then COBYLA looked around its best. "
                self.explore(search, point, merit, held, back_off)
                best = archive.best
                point = point if best is None else archive.box.point(best.values)
            local = "BOBYQA" if search.algorithm == "BOBYQA" else "COBYLA"
            self.prefetch(point, both=local == "BOBYQA")
            reason += self.loop(local, search, point, merit, held, back_off)
            polish(archive, merit, held, back_off, search.relative_tolerance / 10)
        except BudgetUsedError:
            return reason + spent
        return reason

    def explore(self, search: Search, point: Point, merit: Merit, held: Sequence[Limit], back_off: float) -> None:
        """Let a global algorithm have its share of the budget; it finds the valley, a local one finds its floor."""
        archive, most = self.archive, self.archive.budget
        archive.budget = most - int((1 - GLOBAL_SHARE) * archive.left)
        try:
            self.loop(search.algorithm, search, point, merit, held, back_off)
        except BudgetUsedError:
            pass
        finally:
            archive.budget = most

    def loop(
        self, algorithm: str, search: Search, point: Point, merit: Merit, held: Sequence[Limit], back_off: float
    ) -> str:
        """One run of NLopt over the archive; returns why it ended. Raises what stopped it from within."""
        ending = nlopt_loop.minimise(
            algorithm,
            lambda x: self.see(x, merit, held, back_off),
            len(held),
            point,
            step=FIRST_STEP,
            objective_tolerance=search.relative_tolerance / 10,
            variable_tolerance=search.relative_tolerance * 10,
            seed=search.seed,
            calls=20 * search.max_evaluations + 1000,
        )
        if ending.stopped_by is not None:
            raise ending.stopped_by
        return ending.reason

    def see(self, x: Point, merit: Merit, held: Sequence[Limit], back_off: float) -> tuple[float, tuple[float, ...]]:
        """What NLopt sees at a scaled point.

        A design without figures is seen as worse than the worst sound one so far by the objective's own size, and as
        missing every limit by all of it: finite, so that the algorithms' models survive it. The number stays within
        NLopt; the history has the design with its reason.
        """
        made = self.archive.at(x)
        loss = merit.loss(made)
        if loss is not None:
            return loss, tuple(miss + back_off for miss in merit.misses(made, held))
        point = self.archive.box.tidy(x)
        if point not in self.penalties:
            sound = [loss for design in self.archive.history if (loss := merit.loss(design)) is not None]
            self.penalties[point] = max(sound, default=0.0) + 1.0
        return self.penalties[point], (1.0,) * len(held)

    def prefetch(self, origin: Point, both: bool) -> None:
        """Evaluate side by side what COBYLA (and on ``both`` sides BOBYQA) asks for first, one by one.

        A point that is not asked for after all is a design seen, no more: the models of the polishing use it.
        """
        points = []
        for i, x in enumerate(origin):
            steps = (FIRST_STEP, -FIRST_STEP) if both else (FIRST_STEP if x + FIRST_STEP <= 1 else -FIRST_STEP,)
            points += [self.archive.box.tidy([*origin[:i], x + step, *origin[i + 1 :]]) for step in steps]
        fresh = [point for point in dict.fromkeys(points) if not self.archive.knows(point)][: self.archive.left]
        self.archive.evaluate([self.archive.box.values(point) for point in fresh])


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
    run = _Run(base, archive, made)
    merit = Merit(objective, _size(made, made))
    for algorithm in ("DIRECT-L", "COBYLA"):
        best = archive.best
        if algorithm == "COBYLA" and best is None:
            break
        origin = archive.box.point({key: base.number(key) for key in bounds.keys} if best is None else best.values)
        ending = nlopt_loop.minimise(
            algorithm,
            lambda x: run.see(x, merit, limits, 0.0),
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

    It is evaluated by FEM and held against the study's limits. None without such a sweep or without a sound row in one.
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
    limits = resolve_limits(base, start.evaluation)
    keys = list(dict.fromkeys([*(variable.key for variable in spec.study.variables), *chosen]))
    try:
        return candidate(evaluator.design(chosen), objective, limits, keys, joint.evaluation)
    except FluxboreError:  # the two choices cannot stand in one design, which its evaluation says
        return Candidate(numbers(chosen), joint.evaluation, None, ())


def _bounds(base: Spec) -> Box:
    """The box of the variables; limits on keys need no evaluation, so they are known before the first."""
    keys = {variable.key for variable in base.study.variables}
    return box(base, [limit for limit in resolve_limits(base, failure("network", "", "")) if limit.subject in keys])


def _shortfall(archive: Archive) -> str:
    """Where no design was feasible: which limits the nearest one missed, and by how much."""
    if archive.best is not None or not archive.history:
        return ""
    nearest = min(archive.history, key=violation)
    if math.isinf(violation(nearest)):
        return " None of its designs could be evaluated in full."
    missed = [
        f"{item.limit.subject} {item.limit.sense} {item.limit.limit:.6g} by {-item.margin:.2%}"
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


def _mishap(error: Exception) -> str:
    return (
        str(error) if isinstance(error, FluxboreError) else f"The search failed with {type(error).__name__}: {error}."
    )
