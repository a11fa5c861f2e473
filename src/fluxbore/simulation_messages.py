"""What the command line says of a benchmark: its figures beside the published ones, the seeds, other designs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from fluxbore.design.units import DIMENSIONS, format_quantity
from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun, Published
from fluxbore.optimize.benchmark_plain import result_plain
from fluxbore.plain_values import finite
from fluxbore.value_text import route

DIGITS = 4

WORDS = {
    "friedman_p": "Friedman's p",
    "rank_sums": "rank sums",
    "post_hoc": "Wilcoxon",
    "p_corrected": "p, Bonferroni",
    "trend": "rank correlation of error and speed, by target (N)",
}
"""Names of figures, in JSON and Python, that read otherwise in words."""


def simulation_plain(result: BenchmarkResult) -> dict[str, Any]:
    """As figures.json has it, and the files."""
    return {**result_plain(result), "files": [str(path) for path in result.files]}


def simulation_text(result: BenchmarkResult) -> str:
    """Tables for people, or why there are none."""
    run, benchmark = result.run, result.benchmark
    if not result.ok:
        return f"{run.status}: {' '.join(run.reasons)}"
    count = len(result.seeds)
    seeds = f"seed {result.seeds[0]}" if count == 1 else f"medians over seeds {result.seeds[0]} to {result.seeds[-1]}"
    field = f"field by {route(run.spec, run.evaluation.fidelity)}" if run.field is not None else ""
    conditions = ", ".join(part for part in (seeds if benchmark.random else "", field) if part)
    parts = [
        f"{benchmark.name}: {benchmark.title} ({benchmark.source}); {conditions}",
        _table([("figure", "simulated", "published", "difference", ""), *_published(benchmark.published, run)]),
    ]
    told = (*benchmark.published, *benchmark.causes)
    parts += [_table(rows) for rows in _rest(told, run.figures)]
    if count > 1:
        parts.append(_table(_seeds(benchmark.published, run)))
    parts.append(_table(_designs(result)))
    if result.against:
        parts += [f"{item.label}: {' '.join(item.reasons)}" for item in result.against if not item.ok]
    if result.variations:
        parts.append(_table(_variations(result)))
    if result.files:
        parts.append("\n".join(str(path) for path in result.files))
    return "\n\n".join(parts)


def _published(published: Sequence[Published], run: DesignRun) -> list[tuple[str, ...]]:
    """Each figure beside its source's, with what of it is reproduced."""
    rows: list[tuple[str, ...]] = []
    for item in published:
        found = item.of(run.figures)
        given, reproduced = item.value, item.reproduced(run.figures)
        apart = "" if found is None or given is None else _signed(found - given, item.dimension)
        limits = item.limits(lambda value, item=item: _show(value, item.dimension))  # type: ignore[misc]
        word = {True: limits, False: f"NOT {limits}", None: ""}[reproduced]
        rows.append((item.label, _show(found, item.dimension), _show(given, item.dimension), apart, word))
    return rows


def _rest(shown: Sequence[Published], figures: Mapping[str, Any]) -> list[list[tuple[str, ...]]]:
    """The figures that no source gives, in SI: plain ones together, every table of others by itself."""
    told = {item.path[0] for item in shown}
    left = {name: value for name, value in finite(figures).items() if name not in told}
    nested = {name: value for name, value in left.items() if _records(value)}
    plain: list[tuple[str, ...]] = [(_word(name), _plain(value)) for name, value in left.items() if name not in nested]
    grids = [_grid(name, _records(value)) for name, value in nested.items()]
    return [[("other figures", "SI units"), *plain], *grids] if plain else grids


def _records(value: Any) -> dict[str, Mapping[str, Any]]:
    """Rows of a table by their names: of a table of tables, or of a list of them; empty for anything else."""
    if isinstance(value, (list, tuple)):
        value = {str(number): item for number, item in enumerate(value, 1)}
    alike = isinstance(value, Mapping) and all(isinstance(item, Mapping) for item in value.values())
    return dict(value) if alike else {}


def _grid(name: str, rows: Mapping[str, Mapping[str, Any]]) -> list[tuple[str, ...]]:
    columns = list(dict.fromkeys(column for row in rows.values() for column in row))
    body = [(label, *(_plain(row.get(column)) for column in columns)) for label, row in rows.items()]
    return [(_word(name), *(_word(column) for column in columns)), *body]


def _word(name: str) -> str:
    return WORDS.get(name, name)


def _seeds(published: Sequence[Published], run: DesignRun) -> list[tuple[str, ...]]:
    """The published figures' values of every seed that differ between seeds."""
    varying = [item for item in published if len({item.of(simulation.figures) for simulation in run.simulations}) > 1]
    rows: list[tuple[str, ...]] = [("seed", *(item.label for item in varying))]
    for simulation in run.simulations:
        rows.append((str(simulation.seed), *(_show(item.of(simulation.figures), item.dimension) for item in varying)))
    return rows


def _designs(result: BenchmarkResult) -> list[tuple[str, ...]]:
    """What the figures come from; of several designs side by side, with the figures."""
    sound = [run for run in result.runs if run.ok]
    rows: list[tuple[str, ...]] = [("design", *(run.label for run in sound))]
    shown = (*(result.benchmark.published if result.against else ()), *result.benchmark.causes)
    for item in {item.path: item for item in shown}.values():
        rows.append((item.label, *(_show(item.of(run.figures), item.dimension) for run in sound)))
    return rows


def _variations(result: BenchmarkResult) -> list[tuple[str, ...]]:
    """The first seed under every other condition, and as it was."""
    varying, first = result.moved, result.run.simulations[0]
    head = f"seed {first.seed}" if result.benchmark.random else "one change at a time"
    rows: list[tuple[str, ...]] = [(head, *(item.label for item in varying))]
    rows.append(("as it is", *(_show(item.of(first.figures), item.dimension) for item in varying)))
    for run in result.variations:
        shown = [_show(item.of(run.figures), item.dimension) for item in varying]
        rows.append((run.label, *shown) if run.ok else (run.label, " ".join(run.reasons), *[""] * (len(varying) - 1)))
    return rows


def _show(value: float | None, dimension: str, digits: int = DIGITS) -> str:
    if value is None:
        return "-"
    if dimension == "fraction":
        return f"{100 * value:.{digits}g} %"
    return format_quantity(value, dimension, digits) if dimension in DIMENSIONS else f"{value:.{digits}g}"


def _signed(value: float, dimension: str) -> str:
    shown = _show(value, dimension, 2)
    return shown if shown.startswith("-") else f"+{shown}"


def _plain(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.3g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(f"({_plain(item)})" if isinstance(item, (list, tuple)) else _plain(item) for item in value)
    if isinstance(value, Mapping):
        return ", ".join(f"{name}: {_plain(item)}" for name, item in value.items())
    return "-" if value is None else str(value)


def _table(rows: Sequence[tuple[str, ...]]) -> str:
    """Columns as wide as their widest text."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join(
        "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in rows
    )
