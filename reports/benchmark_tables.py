"""Tables of any benchmark in simulated time: figures beside the published ones, parameters, designs, variations."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.design.units import DIMENSIONS
from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun, Published
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import DASH, Scale, capital, greek, key_scale, plain, scale, significant

GIVEN = "as the specification has it, without a mark"
"""Why a parameter has its value, where the specification gives it and no reason."""

OWN = "the design's own"
"""The same, where the specification leaves it out."""


def statistics(result: BenchmarkResult) -> Table:
    """Each published figure beside the simulated one, its range over the seeds, and whether it is reproduced."""
    several = len(result.seeds) > 1
    rows = []
    for item in result.benchmark.published:
        found, reproduced = item.of(result.run.figures), item.reproduced(result.run.figures)
        every = [value for sim in result.run.simulations if (value := item.of(sim.figures)) is not None]
        unit = _scale(item, [found, item.value])
        rows.append(
            (
                Cell(_label(item)),
                Cell(unit.quantity(found), "strong"),
                *([Cell(_range(unit, every))] if several else []),
                Cell(unit.quantity(item.value)),
                Cell(DASH if found is None or item.value is None else _signed(unit, found - item.value)),
                Cell(*_verdict(unit, item, reproduced)),
                Cell(unbroken(item.note), "muted"),
            )
        )
    over = ("Over the seeds",) if several else ()
    head = ("Figure", "Simulated", *over, "Published", "Difference", "Reproduced", "Where it is published")
    words = frozenset({len(head) - 2, len(head) - 1})
    return Table("The paper's figures, simulated", head, tuple(rows), words=words, signs=True)


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


def parameters(spec: Spec, prefix: str, default: str, own: Mapping[str, float] | None = None) -> Table:
    """Every key of the benchmark: its value, where it comes from and why.

    default : what is said of a value that is the key's own default and bears no reason. own : by the rest of their
    names, values (SI) of the design itself, which stand for keys that the specification leaves out.
    """
    notes, given = {note.key: note for note in spec.notes}, own or {}
    rows = []
    for key in spec.kind.keys:
        if not key.name.startswith(prefix):
            continue
        value, note = spec.values.get(key.name), notes.get(key.name)
        unmarked = default if value == key.default else GIVEN
        if value is None:
            value, unmarked = given.get(key.leaf), OWN
        if value is None:
            continue
        rows.append(
            (
                Cell(capital(key.leaf.replace("_", " "))),
                Cell(capital(greek(key.doc))),
                Cell(_value(spec, key.name, value)),
                Cell(note.status if note is not None else DASH),
                Cell(*((greek(note.reason),) if note is not None else (unmarked, "muted"))),
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
        if item.reproduced(result.run.figures) is not False or value is None:
            continue
        unit = _scale(item, [value, item.value])
        given = "" if item.value is None else f", {unit.quantity(item.value)} published"
        found.append(f"{_label(item)}: {unit.quantity(value)} is simulated{given}; it is not {_limits(item, unit)}.")
    return tuple(found)


def comparison(runs: Sequence[DesignRun], errors: Sequence[Published], causes: Sequence[Published]) -> Table:
    """Errors of every design, the change from the first, and what they come from."""
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


def variations(result: BenchmarkResult, wanted: Sequence[Published] | None = None) -> Table:
    """The first seed under every other condition, beside the same seed as it was.

    wanted : the figures to show, of those that any condition changes; all of these without it.
    """
    first = result.run.simulations[0]
    shown = [item for item in result.moved if wanted is None or item in wanted]
    everyone = [first.figures, *(run.figures for run in result.variations if run.ok)]
    scales = {item.path: _scale(item, [item.of(figures) for figures in everyone]) for item in shown}

    def row(label: str, figures: Mapping[str, Any], tone: str) -> tuple[Cell, ...]:
        named = capital(label).replace(" %", "\u00a0%")
        return (Cell(named), *(Cell(scales[item.path].number(item.of(figures)), tone) for item in shown))

    rows = [row("as it is", first.figures, "strong")]
    for run in result.variations:
        rows.append(row(run.label if run.ok else f"{run.label}: {' '.join(run.reasons)}", run.figures, ""))
    head = ("One change at a time", *(_titled(item, scales[item.path]) for item in shown))
    seed = f"; seed {first.seed}" if result.benchmark.random else ""
    return Table(f"What a tenth more or less does{seed}", head, tuple(rows))


def _scale(item: Published, values: Sequence[float | None]) -> Scale:
    if item.dimension == "fraction":
        finest = min((abs(value) for value in (*values, item.within) if value), default=1.0)
        return replace(scale(item.dimension, values), decimals=min(max(2, -math.floor(math.log10(100 * finest))), 4))
    if item.dimension in DIMENSIONS:
        return scale(item.dimension, values)
    whole = all(value is None or float(value).is_integer() for value in values)
    return Scale("", 1.0, decimals=0 if whole else 2)


def _label(item: Published) -> str:
    return unbroken(capital(item.label))


def _titled(item: Published, unit: Scale) -> str:
    return f"{_label(item)} ({unit.unit})" if unit.unit else _label(item)


def unbroken(text: str) -> str:
    """Names such as P-N with hyphens at which no line breaks."""
    return re.sub(r"\b([A-Z])-(?=[A-Z]\b)", "\\1\N{NON-BREAKING HYPHEN}", text)


def _range(unit: Scale, values: Sequence[float]) -> str:
    if len(set(values)) < 2:
        return DASH
    return f"{unit.number(min(values))} to {unit.number(max(values))}"


def _signed(unit: Scale, change: float, *, unit_too: bool = True) -> str:
    text = plain(change / unit.factor, unit.decimals)
    sign = "+" if change > 0 and text.strip("0.") else ""
    return f"{sign}{text}\u00a0{unit.unit}" if unit.unit and unit_too else f"{sign}{text}"


def _limits(item: Published, unit: Scale) -> str:
    """What it takes to be reproduced, each limit without the zeros behind it."""
    sign = f"\u00a0{unit.unit}" if unit.unit else ""
    return item.limits(lambda value: f"{significant(unit.shown(value), 3)}{sign}")


def _verdict(unit: Scale, item: Published, reproduced: bool | None) -> tuple[str, str]:
    if reproduced is None:
        return (DASH, "muted")
    limits = _limits(item, unit)
    return (f"✓ {limits}", "good") if reproduced else (f"✗ not {limits}", "bad")
