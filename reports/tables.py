"""The tables of a report as plain data: texts with units, ready for the page, which adds nothing but markup."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from fluxbore.design.performance import FIGURES
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import SweepResult
from fluxbore.reports.content import PartRow, ReportContent
from fluxbore.reports.wording import (
    DASH,
    Scale,
    capital,
    change,
    figure_label,
    figure_scale,
    key_scale,
    plain,
    significant,
)


@dataclass(frozen=True, slots=True)
class Cell:
    """A text with a tone, "good", "bad", "muted" or "strong", which the page shows beside the words, never instead."""

    text: str
    tone: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """head : column titles. rows : the first cell of each is its header. foot : rows of sums."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    foot: tuple[tuple[Cell, ...], ...] = ()
    words: frozenset[int] = frozenset()
    """Columns of words; all others but the first are numbers and stand flush right."""


def comparison(content: ReportContent) -> Table | None:
    """Every figure of the design: start and chosen by finite elements, the chosen by the network."""
    design, network = content.design, content.design_network
    if design is None and network is None:
        return None
    columns: list[tuple[str, Evaluation | None]] = []
    if content.is_study and content.start is not None:
        columns.append(("Start, FEM", content.start))
    word = "Chosen, " if content.is_study else ""
    columns += [(f"{word}FEM", design), (f"{word}network", network)]
    present = [(title, item) for title, item in columns if item is not None]
    rows = []
    for name in FIGURES:
        values = [getattr(item.performance, name) for _, item in present]
        if all(value is None for value in values):
            continue
        scale = figure_scale(name, values)
        cells = [
            Cell(capital(figure_label(name))),
            Cell(scale.unit or DASH, "muted"),
            *(Cell(scale.number(v)) for v in values),
        ]
        if design is not None and network is not None:
            fine, coarse = getattr(design.performance, name), getattr(network.performance, name)
            cells.append(Cell(change(fine, coarse) or DASH, "muted"))
        rows.append(tuple(cells))
    head = ["Figure", "Unit", *(title for title, _ in present)]
    if design is not None and network is not None:
        head.append("Network against FEM")
    return Table("Every figure by both routes", tuple(head), tuple(rows), words=frozenset({1})) if rows else None


def positions(design: Evaluation) -> Table | None:
    """Force by both routes, cogging, and Newton's iteration at each position of the window."""
    if not design.positions:
        return None
    rows = tuple(
        (
            Cell(f"{p.position * 1e3:.4g}"),
            Cell(f"{p.force_constant:.4f}"),
            Cell(f"{p.force_constant_linkage:.4f}"),
            Cell(change(p.force_constant, p.force_constant_linkage)),
            Cell(plain(p.cogging_force * 1e3, 1)),
            Cell(str(p.iterations)),
            Cell(significant(p.residual, 2)),
        )
        for p in design.positions
    )
    head = (
        "z (mm)",
        "Stress tensor (N/A)",
        "Flux linkage (N/A)",
        "Difference",
        "Cogging (mN)",
        "Newton steps",
        "Residual",
    )
    return Table("Force and convergence at each position", head, rows)


def failed_rows(content: ReportContent, result: SweepResult) -> Table | None:
    """The designs of a sweep that have no figures, with the reasons."""
    rows = tuple(
        (
            Cell(", ".join(key_scale(content.spec, key, [value]).quantity(value) for key, value in row.values.items())),
            Cell(row.evaluation.status),
            Cell(" ".join(row.evaluation.reasons)),
        )
        for row in result.rows
        if not row.evaluation.ok
    )
    return (
        Table("Designs without a result", ("Design", "Status", "Reason"), rows, words=frozenset({1, 2}))
        if rows
        else None
    )


def parts(rows: Sequence[PartRow]) -> Table | None:
    """The parts list with the masses of mover, stator and all."""
    if not rows:
        return None
    lines = tuple(
        (
            Cell(row.name),
            Cell(row.group),
            Cell(row.material),
            Cell(row.size),
            Cell(str(row.count)),
            Cell(f"{row.volume * 1e9:,.0f}".replace(",", "\u202f")),
            Cell(_grams(row.mass)),
            Cell(_grams(row.mass * row.count)),
        )
        for row in rows
    )
    head = ("Part", "Group", "Material", "Size", "Pieces", "Volume of one (mm³)", "Mass of one (g)", "Mass (g)")
    groups = [*dict.fromkeys(row.group for row in rows)]
    foot = [_sum(capital(group), [row for row in rows if row.group == group]) for group in groups]
    foot.append(_sum("All parts", rows))
    return Table("Parts and masses", head, lines, tuple(foot), frozenset({1, 2, 3}))


def details(evaluations: Iterable[tuple[str, Evaluation | None]]) -> Table | None:
    """What a route says of itself beside the figures, in SI units."""
    rows = tuple(
        (Cell(name.replace("_", "\u200b_")), Cell(route), Cell(significant(value, 5)))
        for route, evaluation in evaluations
        if evaluation is not None
        for name, value in (evaluation.details or {}).items()
    )
    return (
        Table("Details of the routes (SI units)", ("Name", "Route", "Value"), rows, words=frozenset({1}))
        if rows
        else None
    )


def titled(label: str, scale: Scale) -> str:
    """A column's title with its unit."""
    return f"{capital(label)} ({scale.unit})" if scale.unit else capital(label)


def _grams(mass: float) -> str:
    return f"{mass * 1e3:.2f}"


def _sum(title: str, rows: Sequence[PartRow]) -> tuple[Cell, ...]:
    count, mass = sum(row.count for row in rows), sum(row.mass * row.count for row in rows)
    blank = Cell("")
    return Cell(title), blank, blank, blank, Cell(str(count)), blank, blank, Cell(_grams(mass), "strong")
