"""What a whole run found: the design to make, whether it holds the study's limits, and the files that were written."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from fluxbore.design.spec import Spec
from fluxbore.design.study import Constraint
from fluxbore.optimize.benchmark import BenchmarkResult
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.outcome import Candidate, Check, SearchResult, SweepResult
from fluxbore.optimize.pareto_result import ParetoResult
from fluxbore.optimize.problem import check, resolve_limits, show_limit
from fluxbore.optimize.tolerance_result import RobustResult, ToleranceResult


@dataclass(frozen=True, slots=True)
class DesignResult:
    """What `design` found and wrote.

    spec, evaluation : the design to make, by finite elements; the start where the study found nothing feasible.
    checks : the study's limits held against that design.
    status : "ok", or in a few words why the result is not one to build: "no feasible design", "not converged", ...
    reasons : the same in sentences. warnings : what could not be made, such as STEP files without libGL.
    front, tolerance, robust : what the study asked for besides; of a robust search ``search`` is the round chosen.
    simulation : the benchmark in simulated time that the design was put through.
    """

    spec: Spec
    evaluation: Evaluation
    checks: tuple[Check, ...]
    status: str
    reasons: tuple[str, ...]
    search: SearchResult | None = None
    sweeps: tuple[SweepResult, ...] = ()
    files: tuple[Path, ...] = ()
    warnings: tuple[str, ...] = ()
    front: ParetoResult | None = None
    tolerance: ToleranceResult | None = None
    robust: RobustResult | None = None
    simulation: BenchmarkResult | None = None

    @property
    def ok(self) -> bool:
        return self.status == OK

    @property
    def history(self) -> tuple[Candidate, ...]:
        """Every design that the search asked for, in all its rounds."""
        if self.robust is not None:
            return tuple(step for item in self.robust.rounds for step in item.search.history)
        return self.search.history if self.search is not None else ()


def searched(spec: Spec, search: SearchResult) -> DesignResult:
    """The search's outcome: its chosen design, else the start with the reason."""
    chosen = search.chosen
    if chosen is None:
        reasons = (search.stop_reason, *search.start.evaluation.reasons)
        return DesignResult(spec, search.start.evaluation, search.start.checks, "no feasible design", reasons, search)
    status, reasons = (OK, ()) if search.ending == "done" else (search.ending, (search.stop_reason,))
    final = chosen_spec(spec, chosen, search)
    return DesignResult(final, chosen.evaluation, chosen.checks, status, reasons, search)


def judged(spec: Spec, evaluation: Evaluation, start: Evaluation | None = None) -> DesignResult:
    """A design that was evaluated as it is, held against the study's limits.

    start : what limits that are relative to the start refer to; without it the evaluation itself.
    """
    if not evaluation.ok:
        return DesignResult(spec, evaluation, (), evaluation.status, evaluation.reasons)
    checks = check(resolve_limits(spec, start or evaluation), spec.values, evaluation.performance, evaluation.fidelity)
    missed = tuple(
        f"{item.limit.subject} {item.limit.sense} {show_limit(spec, item.limit)} is not met."
        for item in checks
        if not item.satisfied
    )
    return DesignResult(spec, evaluation, checks, "limits not met" if missed else OK, missed)


def chosen_spec(spec: Spec, chosen: Candidate, search: SearchResult) -> Spec:
    """The chosen design as a specification of its own; limits relative to the start become numbers."""
    final = spec.for_study().with_values(chosen.values)
    constraints = tuple(
        Constraint(
            check.limit.subject,
            check.limit.limit if check.limit.sense == "<=" else None,
            check.limit.limit if check.limit.sense == ">=" else None,
        )
        for check in search.start.checks
    )
    return replace(final, study=replace(final.study, constraints=constraints))
