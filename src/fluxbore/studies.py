"""The Python interface to studies: sweeps, searches, fronts and tolerances, each in a folder in which it goes on."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Fidelity
from fluxbore.optimize.outcome import Candidate, SearchResult, SweepResult
from fluxbore.optimize.progress import Report
from fluxbore.optimize.sweep import recorded_sweeps, run_sweeps
from fluxbore.reading import as_spec, need
from fluxbore.workshop import Workshop, workshop

# Each study brings in libraries of its own, which take as long to load as a design takes to compute.
if TYPE_CHECKING:
    from fluxbore.optimize.pareto_result import ParetoResult
    from fluxbore.optimize.tolerance_result import RobustResult, ToleranceResult


def sweep(
    spec: Spec | Path | str,
    folder: Path | str | None = None,
    *,
    fidelity: Fidelity = "fem",
    workers: int | None = None,
    scheduler: str | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: Report | None = None,
) -> tuple[SweepResult, ...]:
    """Run the study's sweeps, in parallel and resumable.

    folder : gets ``results.csv``, ``results.parquet`` and the journal from which an interrupted sweep goes on; without
    it nothing is kept. workers : processes on this machine; scheduler : of a Dask cluster in their place. time_limit :
    s after which one design is given up.
    Raises SpecError where the study has no sweep.
    """
    spec = as_spec(spec)
    need(spec.study.sweeps, "study.sweeps", "a sweep")
    with workshop(spec, folder, workers, scheduler, time_limit, force) as shop:
        results = run_sweeps(spec, shop.journal, shop.executor, fidelity, progress)
        shop.write_results(spec, results)
    return results


def optimize(
    spec: Spec | Path | str,
    folder: Path | str | None = None,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: Report | None = None,
) -> SearchResult:
    """Search for the study's best feasible design by finite elements.

    folder : gets ``design.toml``, ``results.csv``, ``results.parquet`` and the journal; the others as for `sweep`.
    Raises SpecError where the study has no objective or no variables.
    """
    from fluxbore.design_result import chosen_spec
    from fluxbore.optimize.search import run_search

    spec = as_spec(spec)
    _need_search(spec, "a search")
    with workshop(spec, folder, workers, scheduler, time_limit, force) as shop:
        result = run_search(spec, shop.journal, shop.executor, progress)
        _write_search(spec, shop, result.history)
        if result.chosen is not None:
            shop.write_design(chosen_spec(spec, result.chosen, result))
    return result


def pareto(
    spec: Spec | Path | str,
    folder: Path | str | None = None,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: Report | None = None,
) -> ParetoResult:
    """Look for the front of the study's objective against ``study.pareto.against`` by finite elements.

    folder : gets ``front.csv``, ``results.csv`` and ``results.parquet`` with every design that was evaluated, and the
    journal; the others as for `sweep`. Raises SpecError where the study asks for no front.
    """
    from fluxbore.optimize.pareto import run_pareto

    spec = as_spec(spec)
    _need_search(spec, "a front")
    need(spec.study.pareto, "study.pareto", "a front")
    with workshop(spec, folder, workers, scheduler, time_limit, force) as shop:
        result = run_pareto(spec, shop.journal, shop.executor, progress)
        _write_search(spec, shop, result.history)
        shop.write_front(result)
    return result


def tolerance(
    spec: Spec | Path | str,
    folder: Path | str | None = None,
    *,
    fidelity: Fidelity = "fem",
    workers: int | None = None,
    scheduler: str | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: Report | None = None,
) -> ToleranceResult:
    """What comes off the line when the specification's own design is made within ``study.production.tolerances``.

    folder : gets ``tolerance.csv`` and the journal; the others as for `sweep`. Raises SpecError where the study has no
    production; DesignError where the design has no figures.
    """
    from fluxbore.optimize.tolerance import run_tolerance

    spec = as_spec(spec)
    need(spec.study.production, "study.production", "a tolerance analysis")
    with workshop(spec, folder, workers, scheduler, time_limit, force, tables=None) as shop:
        result = run_tolerance(spec, shop.journal, shop.executor, progress, fidelity=fidelity)
        shop.write_tolerance(result)
    return result


def robust(
    spec: Spec | Path | str,
    folder: Path | str | None = None,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: Report | None = None,
) -> RobustResult:
    """Search for the best design of which the share ``study.production.yield`` meets every constraint.

    folder : gets ``design.toml``, ``tolerance.csv``, the tables of results and the journal; the others as for `sweep`.
    Raises SpecError where the study asks for no yield.
    """
    from fluxbore.design_result import chosen_spec
    from fluxbore.optimize.tolerance_robust import run_robust

    spec = as_spec(spec)
    production = spec.study.production
    need(production is not None and production.target_yield, "study.production.yield", "a search that reaches it")
    _need_search(spec, "a search")
    with workshop(spec, folder, workers, scheduler, time_limit, force) as shop:
        result = run_robust(spec, shop.journal, shop.executor, progress)
        _write_search(spec, shop, tuple(step for item in result.rounds for step in item.search.history))
        best = result.best
        if best is not None and best.search.chosen is not None:
            shop.write_design(chosen_spec(spec, best.search.chosen, result.rounds[0].search))
        if best is not None and best.production is not None:
            shop.write_tolerance(best.production)
    return result


def _need_search(spec: Spec, what: str) -> None:
    """Refuse a study that nothing can be looked for in, before a folder is touched."""
    from fluxbore.optimize.search import check_study

    need(spec.study.objective is not None, "study.objective", what)
    need(spec.study.variables, "study.variables", what)
    check_study(spec)


def _write_search(spec: Spec, shop: Workshop, history: tuple[Candidate, ...]) -> None:
    """A search's designs, after the rows of those sweeps that the journal holds whole."""
    if shop.folder is not None:
        shop.write_results(spec, recorded_sweeps(spec, shop.journal, "fem"), history)
