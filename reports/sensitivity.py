"""What a unit more of each variable does to each figure of the design, by its exact derivatives."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from fluxbore.design.performance import FIGURES, grouped
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.noise import clear_slopes
from fluxbore.reports.content import ReportContent
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import (
    DASH,
    capital,
    difference,
    figure_label,
    figure_scale,
    key_label,
    listing,
    subject_measure,
    symbol,
    unit_sign,
)

FEW = 12
"""Figures that stand open together; of more only those that the kind's words name, the study's own among them."""

DIGITS = 3


@dataclass(frozen=True, slots=True)
class Sensitivities:
    """main : the figures that people ask for first. rest : all others that something moves. notes : sentences."""

    main: Table
    rest: Table | None
    notes: tuple[str, ...]


def sensitivities(content: ReportContent) -> Sensitivities | None:
    """The tables of the design's derivatives, by the study's variables or else by what has tolerances; None without."""
    found = (content.design, content.tolerance.nominal if content.tolerance is not None else None)
    design = next((item for item in found if item is not None and item.gradient), None)
    if design is None or not design.gradient:
        return None
    design = replace(design, gradient=clear_slopes(content.spec, design))
    assert design.gradient is not None
    moved = [name for name, slopes in design.gradient.items() if any(slopes.values())]
    keys = _keys(content, design)
    study = content.spec.study
    asked = {limit.subject for limit in study.constraints} | {study.objective.figure if study.objective else ""}
    first = {*content.words.main, *asked} if len(moved) > FEW else set(moved)
    if not keys or not moved:
        return None
    main = _table(content, design, keys, [name for name in moved if name in first], "What one unit more changes")
    rest = _table(content, design, keys, [name for name in moved if name not in first], "The other figures")
    still = [name for name in design.gradient if name not in moved]
    return Sensitivities(main or _required(rest), rest if main else None, _notes(design, still))


def _keys(content: ReportContent, design: Evaluation) -> list[str]:
    """The study's variables in its order, then whatever else there are derivatives by."""
    known = dict.fromkeys(key for slopes in (design.gradient or {}).values() for key in slopes)
    own = [variable.key for variable in content.spec.study.variables if variable.key in known]
    return [*own, *(key for key in known if key not in own)]


def _table(
    content: ReportContent, design: Evaluation, keys: list[str], names: Iterable[str], caption: str
) -> Table | None:
    rows: list[tuple[Cell, ...]] = []
    sections = []
    for group, members in grouped(names):
        sections.append((len(rows), group))
        rows += [_row(content, design, keys, name) for name in members]
    steps = [subject_measure(content.spec, key) for key in keys]
    titles = [
        f"{capital(key_label(content.spec, key))}{_sign(content, key)}, per {unit_sign(step) or 'unit'}"
        for key, step in zip(keys, steps, strict=True)
    ]
    head = ("Figure", "Design", *titles)
    return Table(caption, head, tuple(rows), sections=tuple(sections)) if rows else None


def _sign(content: ReportContent, key: str) -> str:
    sign = symbol(content.spec, key)
    return f" {sign}" if sign and "(" not in sign and "/" not in sign else ""


def _row(content: ReportContent, design: Evaluation, keys: list[str], name: str) -> tuple[Cell, ...]:
    """The figure, its value and its norm's, and the change by a unit of each key."""
    assert design.gradient is not None
    value, norm = getattr(design.performance, name), (design.norms or {}).get(name)
    scale = figure_scale(name, [value])
    shown = scale.quantity(value)
    if norm is not None:
        shown += f" ({norm.exponent:g}-norm {figure_scale(name, [norm.value]).quantity(norm.value)})"
    cells = [Cell(capital(figure_label(name))), Cell(shown)]
    for key in keys:
        slope = design.gradient[name].get(key)
        if slope is None:
            cells.append(Cell(DASH, "muted"))
            continue
        change = slope * subject_measure(content.spec, key).factor
        unit = subject_measure(content.spec, name, max(abs(value or 0.0), abs(change)))
        text = difference(unit, change, DIGITS, signed=True) if change else "0"
        cells.append(Cell(text, "" if change else "muted"))
    return tuple(cells)


def _notes(design: Evaluation, still: list[str]) -> tuple[str, ...]:
    notes = [
        "Each column moves one variable, the others and the held values staying as they are. The derivatives are exact "
        "for the discrete problem, not differences of two designs; they predict small steps, not always a whole unit."
    ]
    if design.norms:
        notes.append(
            "A figure that is a largest value over places or positions has no derivative where two of them are equal: "
            "its derivative is that of the p-norm in brackets, which stands beside the true maximum."
        )
    if still:
        notes.append(f"None of them moves {listing(figure_label(name) for name in FIGURES if name in still)}.")
    return tuple(notes)


def _required(table: Table | None) -> Table:
    assert table is not None
    return table
