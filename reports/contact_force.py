"""The contact-force benchmark on the page: what was simulated, beside what was measured, and what it rests on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun
from fluxbore.reports import benchmark_tables as shared
from fluxbore.reports import contact_force_curves as curves
from fluxbore.reports.benchmark_tables import unbroken
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import DASH, listing, plain, significant

HOW = (
    "fluxbore simulate SPEC --benchmark mcfc -o DIR --against DESIGN.toml puts other designs through the same, such as "
    "the design.toml that a search wrote: the figure then stands here."
)

WHY = (
    "A force constant that the controller knows drops out of the error: a stronger motor compensates the same friction "
    "with less current. What stays goes with the friction, µ (s P + F_0), and with how late the controller sees the "
    "velocity change its sign."
)

LEAST = 5e-4
"""N, below which two medians are shown as the same."""

DEFAULT = "published, or what is taken where nothing is given: docs/mcfc.md"


def section(result: BenchmarkResult) -> dict[str, Any]:
    """Everything that the template shows."""
    run, benchmark = result.run, result.benchmark
    first = run.simulations[0]
    errors = [item for item in benchmark.published if item.path[0] == "median_rmse"]
    medians = {item.path[1]: item.value for item in errors if item.value is not None}
    sound = [item for item in result.runs if item.ok]
    return {
        "source": benchmark.source,
        "sentences": tuple(unbroken(text) for text in sentences(result)),
        "loops": curves.loops(first),
        "speed": curves.errors_over_speed(first, medians),
        "boxes": curves.boxes(first, medians),
        "trace": curves.over_time(first),
        "statistics": shared.statistics(result),
        "post_hoc": post_hoc(run),
        "trends": trends(run),
        "seeds": shared.seeds(result) if len(result.seeds) > 1 else None,
        "parameters": shared.parameters(run.spec, benchmark.section, DEFAULT),
        "missed": shared.missed(result),
        "limits": tuple(unbroken(text) for text in benchmark.limits),
        "designs": curves.designs(sound) if len(sound) > 1 else None,
        "comparison": shared.comparison(sound, errors, benchmark.causes) if len(sound) > 1 else None,
        "gains": gains(sound) if len(sound) > 1 else (),
        "why": WHY,
        "variations": shared.variations(result) if result.variations else None,
        "failed": tuple(f"{item.label}: {' '.join(item.reasons)}" for item in result.runs if not item.ok),
        "how": "" if result.against else HOW,
    }


def sentences(result: BenchmarkResult) -> tuple[str, ...]:
    """What was done, and what came of it."""
    run, count = result.run, len(result.seeds)
    trials = len(run.simulations[0].trials)
    over = f"seed {result.seeds[0]}" if count == 1 else f"{count} seeds, {result.seeds[0]} to {result.seeds[-1]}"
    medians = run.figures["median_rmse"]
    told = listing(f"{medians[name]:.2f}\u00a0N under {name}" for name in curves.CONDITIONS)
    cells = run.figures["cells"]
    return (
        "A load actuator moves the rod to and fro while the actuator shall press with one force: by air alone (P-N), "
        "with its friction compensated by the air (P-P), or by the motor (P-E). The error is the root mean square of "
        "the force's distance from its target.",
        f"{trials} trials in simulated time with {over}; the force constant and the cogging over the way come from the "
        f"field of this design. Median error {told}{'' if count == 1 else ', each the median of the seeds'}. P-E is "
        f"lowest in {_number(run.figures['cells_lowest_P-E'])} of {_number(cells)} cells.",
    )


def post_hoc(run: DesignRun) -> Table:
    """Wilcoxon's test of every pair; over several seeds the medians of its figures."""
    rows = tuple(
        (
            Cell(unbroken(f"{pair['pair'][0]} and {pair['pair'][1]}")),
            Cell(" and ".join(plain(value, 2) for value in pair["medians"])),
            Cell(significant(pair["statistic"], 4)),
            Cell(significant(pair["p_corrected"], 2)),
            Cell(curves.significance(pair["p_corrected"])),
        )
        for pair in run.figures["post_hoc"]
    )
    head = ("Conditions", "Medians (N)", "Wilcoxon's statistic", "p, corrected after Bonferroni", "Difference")
    caption = f"Pairs of conditions; Friedman's test before them: p = {significant(run.figures['friedman_p'], 2)}"
    return Table(caption, head, rows, words=frozenset({4}))


def trends(run: DesignRun) -> Table:
    """How the error goes with speed."""
    found: Mapping[str, Mapping[str, float]] = run.figures["trend"]
    targets = list(next(iter(found.values())))
    rows = tuple(
        (
            Cell(unbroken(condition)),
            *(
                Cell(DASH if condition == "P-P" and target == "0" else f"{plain(by[target], 2)} {_way(by[target])}")
                for target in targets
            ),
        )
        for condition, by in found.items()
    )
    head = ("Condition", *(f"{target} N" for target in targets))
    return Table("Error with speed: Spearman's rank correlation at each target", head, rows)


def gains(runs: Sequence[DesignRun]) -> tuple[str, ...]:
    """What every other design does to the error, in a sentence each."""
    start = runs[0].figures["median_rmse"]
    found = []
    for run in runs[1:]:
        changes = {name: run.figures["median_rmse"][name] - start[name] for name in curves.CONDITIONS}
        if all(abs(change) < LEAST for change in changes.values()):
            found.append(f"{run.label}: the median error does not change under any condition.")
            continue
        parts = []
        for name, change in changes.items():
            sign = "+" if change > 0 else ""
            text = f"{sign}{plain(change, 3)}\u00a0N ({sign}{plain(100 * change / start[name], 1)}\u00a0%)"
            text = text if abs(change) >= LEAST else "no change"
            word = ", no more than the seeds differ," if LEAST <= abs(change) <= _spread(runs[0], name) else ""
            parts.append(f"{text}{word} under {unbroken(name)}")
        found.append(f"{run.label}: median error {listing(parts)}.")
    return tuple(found)


def _spread(run: DesignRun, condition: str) -> float:
    """How far the seeds' medians lie apart (N)."""
    values = [sim.figures["median_rmse"][condition] for sim in run.simulations]
    return float(max(values) - min(values))


def _way(value: float) -> str:
    return "falls" if value < 0 else "rises" if value > 0 else "stays"


def _number(value: float) -> str:
    return f"{value:g}"
