"""The robust search: search, see what comes off the line, back the limits off, until the yield asked for is reached."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.design.study import Constraint
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluator import Evaluate
from fluxbore.optimize.executor import Executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import Candidate, Limit, SearchResult
from fluxbore.optimize.progress import Report
from fluxbore.optimize.search import run_search
from fluxbore.optimize.tolerance import run_tolerance
from fluxbore.optimize.tolerance_backoff import backed_off
from fluxbore.optimize.tolerance_result import RobustResult, RobustRound, ToleranceResult

ROUNDS = 4
"""Searches at most, the one with the study's own limits among them; each later one starts at the last one's design."""


def run_robust(
    spec: Spec,
    journal: Journal | None,
    executor: Executor,
    progress: Report | None = None,
    evaluate: Evaluate = evaluate_design,
    *,
    rounds: int = ROUNDS,
) -> RobustResult:
    """Look for the best design of which the share ``study.production.yield`` meets every constraint of the study.

    A round is a search and the tolerance analysis of the design it chose. Samples are computed in full only for a
    design that reaches the yield by the linear model; where they then say less, the next round backs off further. A
    round that overshoots the yield by more than its interval's width has given too much of the objective away, its
    limits having been backed off by another design's slopes: the next goes on from its own. What ends a search does not
    lose the rounds before it.

    Raises SpecError where the study asks for no yield, or as `run_search` and `run_tolerance` do before a first round.
    """
    production = spec.study.production
    if production is None or production.target_yield is None:
        raise SpecError("study.production.yield must be given for a search that reaches it; got none.")
    target = production.target_yield
    first = run_search(spec, journal, executor, progress, evaluate)
    study_limits = tuple(item.limit for item in first.start.checks)
    made = [_round(spec, study_limits, study_limits, first, journal, executor, progress, evaluate)]
    reason = ""
    while len(made) < rounds and not (reason := _ending(made[-1], target)):
        last = made[-1]
        assert last.production is not None
        limits = backed_off(study_limits, last.production, target)
        if _reaches(last, target) and not _looser(limits, last.limits):
            break
        try:
            search = run_search(_next(spec, last, limits), journal, executor, progress, evaluate)
        except FluxboreError as error:
            reason = f"The limits backed off for a yield of {target:.2%} leave no design. {error}"
            break
        made.append(_round(spec, study_limits, limits, search, journal, executor, progress, evaluate))
    reason = reason or f"The yield of {target:.2%} was not reached in {rounds} rounds."
    return _result(spec, target, made, reason)


def made_design(found: Candidate, spec: Spec) -> Spec:
    """What a search found, given by the same keys as the specification: the design to make, whatever the study held.

    Raises SpecError or DesignError where there is no such design.
    """
    return spec.for_study().with_values(_values(found, spec)).pinned(spec.given)


def _values(found: Candidate, spec: Spec) -> dict[str, Value]:
    """The candidate's values, its counts whole numbers again."""
    return {
        key: round(value) if spec.kind.known(key).kind == "integer" else value for key, value in found.values.items()
    }


def _round(
    spec: Spec,
    study_limits: Sequence[Limit],
    limits: tuple[Limit, ...],
    search: SearchResult,
    journal: Journal | None,
    executor: Executor,
    progress: Report | None,
    evaluate: Evaluate,
) -> RobustRound:
    chosen, production = search.chosen, spec.study.production
    assert production is not None
    assert production.target_yield is not None
    if chosen is None:
        return RobustRound(limits, search, None, None, search.stop_reason)

    def analyse(checks: int) -> ToleranceResult:
        study = replace(spec.study, production=replace(production, checks=checks))
        design = replace(made_design(chosen, spec), study=study)
        return run_tolerance(design, journal, executor, progress, evaluate, limits=study_limits)

    try:
        found = analyse(0)
        if production.checks and found.simulated.value >= production.target_yield:
            found = analyse(production.checks)
    except FluxboreError as error:
        return RobustRound(limits, search, None, chosen.objective, str(error))
    return RobustRound(limits, search, found, chosen.objective)


def _ending(last: RobustRound, target: float) -> str:
    """Why there is no further round after this one; empty where there is one."""
    if last.search.ending != "done":
        return last.search.stop_reason
    if last.production is None:
        return last.reason
    found = last.production.best_estimate
    return _arrival(last.production, target) if 0 <= found.value - target <= found.high - found.low else ""


def _arrival(production: ToleranceResult, target: float) -> str:
    """The sentence of a round that reaches the yield."""
    found = production.best_estimate
    how = "the linear model, corrected by samples computed in full" if production.checked else "the linear model"
    return (
        f"The yield reached {found.value:.2%} ({found.low:.2%} to {found.high:.2%}) by {how}; asked for {target:.2%}."
    )


def _reaches(item: RobustRound, target: float) -> bool:
    return item.production is not None and item.production.best_estimate.value >= target


def _looser(limits: Sequence[Limit], before: Sequence[Limit]) -> bool:
    """Whether one of the limits leaves the search more room than it had before, beyond rounding."""
    gained = (
        (new.limit - old.limit) * (1 if new.sense == "<=" else -1) for new, old in zip(limits, before, strict=True)
    )
    return any(room > 1e-9 * new.size for room, new in zip(gained, limits, strict=True))


def _next(spec: Spec, last: RobustRound, limits: Sequence[Limit]) -> Spec:
    """The study with these limits in place of its own, from the design that was found last."""
    constraints = tuple(
        Constraint(item.subject, upper=item.limit) if item.sense == "<=" else Constraint(item.subject, lower=item.limit)
        for item in limits
    )
    found = last.search.chosen
    assert found is not None
    study = replace(spec.study, constraints=constraints)
    return replace(spec.for_study().with_values(_values(found, spec)), study=study)


def _result(spec: Spec, target: float, made: Sequence[RobustRound], reason: str) -> RobustResult:
    objective = spec.study.objective
    sign = -1.0 if objective is not None and objective.maximise else 1.0

    def worth(index: int) -> tuple[bool, float]:
        """Reaching the target comes first; then the objective among those that do, the yield among the others."""
        item = made[index]
        found = item.production.best_estimate.value if item.production is not None else -1.0
        if _reaches(item, target) and item.objective is not None:
            return True, -sign * item.objective
        return False, found

    designs = [index for index, item in enumerate(made) if item.search.chosen is not None]
    chosen = max(designs, key=worth) if designs else None
    begin = made[0].objective
    reached = chosen is not None and worth(chosen)[0]
    if chosen is not None and reached:
        best = made[chosen].production
        assert best is not None
        # a later round that did not end as it should does not undo the arrival, but an interrupted search is said
        reason = _arrival(best, target) if made[-1].search.ending == "done" else reason
    end = None if chosen is None else made[chosen].objective
    return RobustResult(
        target=target,
        rounds=tuple(made),
        chosen=chosen,
        reached=reached,
        price=None if begin is None or end is None else sign * (end - begin),
        stop_reason=reason,
    )
