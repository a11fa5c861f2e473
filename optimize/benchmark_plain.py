"""A benchmark's result as JSON has it."""

from __future__ import annotations

from typing import Any

from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun
from fluxbore.plain_values import finite


def result_plain(result: BenchmarkResult) -> dict[str, Any]:
    """Status and figures: each the median over the seeds, and under ``seeds`` what it is of; SI units throughout."""
    plain: dict[str, Any] = finite(
        {
            "status": result.run.status,
            "reasons": list(result.run.reasons),
            "benchmark": result.benchmark.name,
            "figures": _figures(result.run) if result.ok else {},
            "against": [_named("design", run) for run in result.against],
            "variations": [_named("change", run) for run in result.variations],
        }
    )
    return plain


def _named(what: str, run: DesignRun) -> dict[str, Any]:
    figures = _figures(run) if run.ok else {}
    return {what: run.label, "status": run.status, "reasons": list(run.reasons), "figures": figures}


def _figures(run: DesignRun) -> dict[str, Any]:
    seeds = [{"seed": simulation.seed, **simulation.figures} for simulation in run.simulations]
    return {**run.figures, "seeds": seeds}
