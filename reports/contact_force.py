"""The contact-force benchmark on the page: what was simulated, beside what was measured, and what it rests on."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.design.units import DIMENSIONS
from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun, Published
from fluxbore.reports import contact_force_curves as curves
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import DASH, Scale, capital, key_scale, listing, plain, scale, significant

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

GIVEN = "as the specification has it, without a mark"

DEFAULT = "published, or what is taken where nothing is given: docs/mcfc.md"


def section(result: BenchmarkResult) -> dict[str, Any]:
    """Everything that the template shows."""
    run, benchmark = result.run, result.benchmark
    first = run.simulations[0]
    medians = {
        item.path[1]: item.value
        for item in benchmark.published
        if item.path[0] == "median_rmse" and item.value is not None
    }
    sound = [item for item in result.runs if item.ok]
    return {
        "source": benchmark.source,
        "sentences": tuple(_whole(text) for text in sentences(result)),
        "loops": curves.loops(first),
        "speed": curves.errors_over_speed(first, medians),
        "boxes": curves.boxes(first, medians),
        "trace": curves.over_time(first),
        "statistics": statistics(result),
        "post_hoc": post_hoc(run),
        "trends": trends(run),
        "seeds": seeds(result) if len(result.seeds) > 1 else None,
        "parameters": parameters(run.spec, benchmark.section),
        "missed": missed(result),
        "limits": tuple(_whole(text) for text in benchmark.limits),
        "designs": curves.designs(sound) if len(sound) > 1 else None,
        "comparison": comparison(sound, benchmark.published, benchmark.causes) if len(sound) > 1 else None,
        "gains": gains(sound) if len(sound) > 1 else (),
        "why": WHY,
        "variations": variations(result) if result.variations else None,
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


def statistics(result: BenchmarkResult) -> Table:
    """Each published figure beside the simulated one, its range over the seeds, and whether it is reproduced."""
    rows = []
    for item in result.benchmark.published:
        found, reproduced = item.of(result.run.figures), item.reproduced(result.run.figures)
        every = [value for sim in result.run.simulations if (value := item.of(sim.figures)) is not None]
        unit = _scale(item, [found, item.value])
        rows.append(
            (
                Cell(_label(item)),
                Cell(unit.quantity(found), "strong"),
                Cell(_range(unit, every)),
                Cell(unit.quantity(item.value)),
                Cell(DASH if found is None or item.value is None else _signed(unit, found - item.value)),
                Cell(*_verdict(unit, item, reproduced)),
                Cell(_whole(item.note), "muted"),
            )
        )
    head = ("Figure", "Simulated", "Over the seeds", "Published", "Difference", "Reproduced", "Where it is published")
    return Table("The paper's figures, simulated", head, tuple(rows), words=frozenset({5, 6}))


def post_hoc(run: DesignRun) -> Table:
    """Wilcoxon's test of every pair; over several seeds the medians of its figures."""
    rows = tuple(
        (
            Cell(_whole(f"{pair['pair'][0]} and {pair['pair'][1]}")),
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
            Cell(_whole(condition)),
            *(
                Cell(DASH if condition == "P-P" and target == "0" else f"{plain(by[target], 2)} {_way(by[target])}")
                for target in targets
            ),
        )
        for condition, by in found.items()
    )
    head = ("Condition", *(f"{target} N" for target in targets))
    return Table("Error with speed: Spearman's rank correlation at each target", head, rows)


def seeds(result: BenchmarkResult) -> Table:
    """The figures that differ from seed to seed."""
    run = result.run
    varying = [
        item for item in result.benchmark.published if len({item.of(sim.figures) for sim in run.simulations}) > 1
    ]
    scales = {item.path: _scale(item, [item.of(sim.figures) for sim in run.simulations]) for item in varying}
    rows = tuple(
        (Cell(str(sim.seed)), *(Cell(scales[item.path].number(item.of(sim.figures))) for item in varying))
        for sim in run.simulations
    )
    head = ("Seed", *(_titled(item, scales[item.path]) for item in varying))
    return Table("Every seed", head, rows)


def parameters(spec: Spec, prefix: str) -> Table:
    """Every key of the benchmark: its value, where it comes from and why."""
    notes = {note.key: note for note in spec.notes}
    rows = []
    for key in spec.kind.keys:
        if not key.name.startswith(prefix) or key.name not in spec.values:
            continue
        value, note = spec.values[key.name], notes.get(key.name)
        unmarked = DEFAULT if value == key.default else GIVEN
        rows.append(
            (
                Cell(capital(key.leaf.replace("_", " "))),
                Cell(capital(key.doc)),
                Cell(_value(spec, key.name, value)),
                Cell(note.status if note is not None else DASH),
                Cell(*((note.reason,) if note is not None else (unmarked, "muted"))),
            )
        )
    head = ("Parameter", "What it is", "Value", "Status", "Reason")
    return Table(
        "What the test stand and the controllers are taken to be", head, tuple(rows), words=frozenset({1, 3, 4})
    )


def _value(spec: Spec, name: str, value: Value) -> str:
    if isinstance(value, str):
        return value
    unit = key_scale(spec, name, [float(value)])
    return f"{unit.shown(float(value)):.6g}\u00a0{unit.unit}".rstrip()


def missed(result: BenchmarkResult) -> tuple[str, ...]:
    """The published figures that the simulation does not reach, in sentences."""
    found = []
    for item in result.benchmark.published:
        value = item.of(result.run.figures)
        if item.reproduced(result.run.figures) is not False or value is None or item.value is None:
            continue
        unit = _scale(item, [value, item.value])
        found.append(
            f"{_label(item)}: {unit.quantity(value)} is simulated, {unit.quantity(item.value)} published, which "
            f"is further apart than {unit.quantity(item.within)}."
        )
    return tuple(found)


def comparison(runs: Sequence[DesignRun], published: Sequence[Published], causes: Sequence[Published]) -> Table:
    """Errors of every design, the change from the first, and what they come from."""
    errors = [item for item in published if item.path[0] == "median_rmse"]
    shown = (*errors, *causes)
    scales = {item.path: _scale(item, [item.of(run.figures) for run in runs]) for item in shown}
    rows = []
    for number, run in enumerate(runs):
        cells = [Cell(run.label + (" (start)" if number == 0 else ""))]
        for item in shown:
            value, before = item.of(run.figures), item.of(runs[0].figures)
            text = scales[item.path].number(value)
            if number and item in errors and value is not None and before is not None:
                text += f" ({_signed(scales[item.path], value - before, unit_too=False)})"
            cells.append(Cell(text, "strong" if item in errors else ""))
        rows.append(tuple(cells))
    head = ("Design", *(_titled(item, scales[item.path]) for item in shown))
    return Table("Designs on the same test stand, and what makes them differ", head, tuple(rows))


def variations(result: BenchmarkResult) -> Table:
    """The first seed under every other condition, beside the same seed as it was."""
    first = result.run.simulations[0]
    shown = result.moved
    everyone = [first.figures, *(run.figures for run in result.variations if run.ok)]
    scales = {item.path: _scale(item, [item.of(figures) for figures in everyone]) for item in shown}

    def row(label: str, figures: Mapping[str, Any], tone: str) -> tuple[Cell, ...]:
        return (Cell(capital(label)), *(Cell(scales[item.path].number(item.of(figures)), tone) for item in shown))

    rows = [row("as it is", first.figures, "strong")]
    for run in result.variations:
        rows.append(row(run.label if run.ok else f"{run.label}: {' '.join(run.reasons)}", run.figures, ""))
    head = ("One change at a time", *(_titled(item, scales[item.path]) for item in shown))
    return Table(f"What a tenth more or less does; seed {first.seed}", head, tuple(rows))


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
            parts.append(f"{text}{word} under {_whole(name)}")
        found.append(f"{run.label}: median error {listing(parts)}.")
    return tuple(found)


def _spread(run: DesignRun, condition: str) -> float:
    """How far the seeds' medians lie apart (N)."""
    values = [sim.figures["median_rmse"][condition] for sim in run.simulations]
    return float(max(values) - min(values))


def _scale(item: Published, values: Sequence[float | None]) -> Scale:
    if item.dimension in DIMENSIONS:
        return scale(item.dimension, values)
    whole = all(value is None or float(value).is_integer() for value in values)
    return Scale("", 1.0, decimals=0 if whole else 1)


def _label(item: Published) -> str:
    return _whole(capital(item.label))


def _titled(item: Published, unit: Scale) -> str:
    return f"{_label(item)} ({unit.unit})" if unit.unit else _label(item)


def _whole(text: str) -> str:
    """The conditions' names with hyphens at which no line breaks."""
    return re.sub(r"\bP-(?=[NPE]\b)", "P\N{NON-BREAKING HYPHEN}", text)


def _range(unit: Scale, values: Sequence[float]) -> str:
    if len(set(values)) < 2:
        return DASH
    return f"{unit.number(min(values))} to {unit.number(max(values))}"


def _signed(unit: Scale, change: float, *, unit_too: bool = True) -> str:
    text = plain(change / unit.factor, unit.decimals)
    sign = "+" if change > 0 and text.strip("0.") else ""
    return f"{sign}{text}\u00a0{unit.unit}" if unit.unit and unit_too else f"{sign}{text}"


def _verdict(unit: Scale, item: Published, reproduced: bool | None) -> tuple[str, str]:
    if reproduced is None:
        return (DASH, "muted")
    within = f"within {unit.quantity(item.within)}"
    return (f"✓ {within}", "good") if reproduced else (f"✗ not {within}", "bad")


def _way(value: float) -> str:
    return "falls" if value < 0 else "rises" if value > 0 else "stays"


def _number(value: float) -> str:
    return f"{value:g}"
