"""The steps of a whole run that look for something: the search, the front, the tolerances."""

from __future__ import annotations

from dataclasses import replace

from fluxbore.design.errors import FluxboreError
from fluxbore.design.spec import Spec
from fluxbore.design_result import DesignResult, searched
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.pareto import run_pareto
from fluxbore.optimize.problem import check
from fluxbore.optimize.progress import Report
from fluxbore.optimize.search import run_search
from fluxbore.optimize.tolerance import run_tolerance
from fluxbore.optimize.tolerance_result import RobustResult
from fluxbore.optimize.tolerance_robust import made_design, run_robust
from fluxbore.workshop import Workshop


def search_design(spec: Spec, shop: Workshop, progress: Report | None) -> DesignResult:
    """The search that the study asks for: for the best design, or for the best one that reaches the yield.

    Raises KeyboardInterrupt where the search was interrupted: what follows must not run on a design of halfway.
    """
    production = spec.study.production
    if production is not None and production.target_yield is not None:
        found = _robust(spec, run_robust(spec, shop.journal, shop.executor, progress))
    else:
        found = searched(spec, run_search(spec, shop.journal, shop.executor, progress))
    if found.search is not None and found.search.ending == "interrupted":
        raise KeyboardInterrupt
    return found


def _robust(spec: Spec, result: RobustResult) -> DesignResult:
    """The robust search's design, held against the study's own limits and not those that were backed off."""
    first, last = result.rounds[0].search, result.rounds[-1].search
    if last.ending == "interrupted":
        return replace(searched(spec, last), robust=result)
    best = result.best
    if best is None:
        return replace(searched(spec, first), robust=result)
    found = searched(spec, replace(best.search, start=first.start))
    limits = [item.limit for item in first.start.checks]
    checks = check(limits, found.spec.values, found.evaluation.performance, found.evaluation.fidelity)
    found = replace(found, checks=checks, robust=result, tolerance=best.production)
    if found.ok and not result.reached:
        return replace(found, status="yield not reached", reasons=(result.stop_reason,))
    return found


def with_front(spec: Spec, found: DesignResult, shop: Workshop, progress: Report | None) -> DesignResult:
    """The front too, where the study asks for one."""
    if spec.study.pareto is None:
        return found
    front = run_pareto(spec, shop.journal, shop.executor, progress)
    if front.ending == "interrupted":
        raise KeyboardInterrupt
    return replace(found, front=front)


def every_design(found: DesignResult) -> tuple[Candidate, ...]:
    """The search's designs, and those that only the front asked for."""
    history = found.history
    known = [dict(made.values) for made in history]
    front = () if found.front is None else found.front.history
    return (*history, *(made for made in front if dict(made.values) not in known))


def with_tolerances(spec: Spec, found: DesignResult, shop: Workshop, progress: Report | None) -> DesignResult:
    """The scatter of the design that was found, where the study has a production; a warning where it has none."""
    chosen = found.search.chosen if found.search is not None else None
    if spec.study.production is None or found.tolerance is not None or not found.evaluation.ok:
        return found
    if found.search is not None and chosen is None:
        return found
    try:
        design = made_design(chosen, spec) if chosen is not None else spec
        limits = [item.limit for item in found.checks]
        result = run_tolerance(design, shop.journal, shop.executor, progress, limits=limits)
    except FluxboreError as error:
        return replace(found, warnings=(*found.warnings, f"No tolerance analysis: {error}"))
    return replace(found, tolerance=result)
