"""The magnetic network's own optimum: where a search by finite elements begins."""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.spec import Spec
from fluxbore.optimize import nlopt_loop
from fluxbore.optimize.archive import Archive, BudgetUsedError
from fluxbore.optimize.enumeration import Counts
from fluxbore.optimize.evaluator import Evaluate, Evaluator
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.free_stage import FIRST_STEP, FreeStage
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.problem import Box, Merit, candidate, resolve_limits
from fluxbore.optimize.sweep import DEFAULT_OBJECTIVE

NETWORK_CALLS = 150
"""Calls of the network for each variable in the global search for its optimum; it costs a thousandth of the FEM."""


NEXT_TO_ZERO = 1e-2
"""Of what a problem is about: a start's objective below this says nothing of the objective's size."""


@dataclass(frozen=True, slots=True)
class NetworkStart:
    """The network's own optimum, None where it finds none, and how often the network was called for it."""

    best: Candidate | None
    calls: int


def network_optimum(base: Spec, bounds: Box, evaluate: Evaluate, counts: Counts | None = None) -> Candidate | None:
    """`network_start`, its optimum alone."""
    return network_start(base, bounds, evaluate, counts).best


def network_start(base: Spec, bounds: Box, evaluate: Evaluate, counts: Counts | None = None) -> NetworkStart:
    """The magnetic network's own optimum under those limits that it can evaluate.

    counts : of one combination; limits relative to the start refer to the start's own.
    Global (DIRECT-L), then local (COBYLA); a few hundred calls of microseconds, in this process.
    """
    if not bounds.keys:
        return NetworkStart(None, 0)
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
    archive = Archive(evaluator, bounds, objective, limits, 2 * calls, fixed=counts)
    made = candidate(base, objective, limits, bounds.keys, start)
    merit = Merit(objective, objective_size(made, None, objective.figure, bounds))
    stage = FreeStage(archive, base.study.search, merit, limits, 0.0)
    for algorithm in ("DIRECT-L", "COBYLA"):
        best = archive.best
        if algorithm == "COBYLA" and best is None:
            break
        origin = bounds.point({key: base.number(key) for key in bounds.keys} if best is None else best.values)
        ending = nlopt_loop.minimise(
            algorithm,
            stage.see,
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
    return NetworkStart(archive.best, 1 + len(archive.history))


def objective_size(start: Candidate, network: Candidate | None, figure: str, bounds: Box) -> float:
    """The objective's size, for scaling: the start's, or what the problem is about where the start's is next to zero.

    That is the network's optimum, or what a walk across the range of one variable promises by the derivatives that the
    start brings; the start's counts down to `NEXT_TO_ZERO` of the larger. 1 where nothing is known.
    """
    row = (start.evaluation.gradient or {}).get(figure, {})
    spans = {key: high - low for key, low, high in zip(bounds.keys, bounds.lower, bounds.upper, strict=True)}
    walks = [slope * spans[key] for key, slope in row.items() if key in spans]
    known = [design.objective for design in (start, network) if design is not None and design.objective is not None]
    sizes = [abs(size) for size in (*known, *walks) if math.isfinite(size)]
    largest = max(sizes, default=0.0)
    own = abs(start.objective) if start.objective is not None and math.isfinite(start.objective) else 0.0
    return (own if own > NEXT_TO_ZERO * largest else largest) or 1.0
