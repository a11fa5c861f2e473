"""The winding in a report: what holds for all coils, a row a phase, and every coil; the chart's own figures."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.winding_chart import WindingChart
from fluxbore.geometry.winding_sheet import COIL_HEAD, PHASE_HEAD, coil_row, facts, phase_row, shown
from fluxbore.reports.tables import Cell, Table

WORDS = {"coil", "phase", "direction", "start joined to", "coils in series"}
"""Columns of words."""


@dataclass(frozen=True, slots=True)
class WindingSection:
    """Tables of what all coils share, of phases (None without any) and of coils, and sentences, with those assumed."""

    facts: Table
    phases: Table | None
    coils: Table
    told: tuple[str, ...]
    assumed: tuple[str, ...]


def winding_section(chart: WindingChart | None) -> WindingSection | None:
    """Nothing where there is no winding."""
    if chart is None:
        return None
    common = tuple((Cell(label), Cell(text)) for label, text in facts(chart))
    coils = [tuple(map(shown, coil_row(coil, chart))) for coil in chart.coils]
    used = [i for i in range(len(COIL_HEAD)) if any(row[i] for row in coils)]
    rows = [tuple(row[i] for i in used) for row in coils]
    phases = [tuple(map(shown, phase_row(phase))) for phase in chart.phases]
    return WindingSection(
        Table("Conductor", ("Of all coils", "Value"), common, words=frozenset({1})),
        _table("Phases", PHASE_HEAD, phases) if phases else None,
        _table("Coils, in the order along the axis", tuple(COIL_HEAD[i] for i in used), rows),
        chart.told,
        chart.assumed,
    )


def _table(caption: str, head: tuple[str, ...], rows: list[tuple[str, ...]]) -> Table:
    words = frozenset(i for i, title in enumerate(head) if i and title in WORDS)
    titles = tuple(f"{title[0].upper()}{title[1:]}" for title in head)
    return Table(caption, titles, tuple(tuple(Cell(text) for text in row) for row in rows), words=words)
