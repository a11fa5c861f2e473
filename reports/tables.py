"""The tables of a report as plain data: texts with units, ready for the page, which adds nothing but markup."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from fluxbore.design.performance import HEAVY
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import SweepResult
from fluxbore.reports.content import PartRow, ReportContent
from fluxbore.reports.wording import (
    DASH,
    Scale,
    capital,
    change,
    key_scale,
    plain,
    significant,
)

LARGE = 1e-3
"""m^3, from which volumes are given in litres."""


@dataclass(frozen=True, slots=True)
class Cell:
    """A text with a tone, "good", "bad", "muted" or "strong", which the page shows beside the words, never instead."""

    text: str
    tone: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """head : column titles. rows : the first cell of each is its header. foot : rows of sums.

    sections : number of the first row under a heading, and the heading. signs : whether the texts are sentences with
    symbols such as τ_f, whose subscripts the page sets. parts : of a parts list, each row's number there; 0 for none.
    """

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    foot: tuple[tuple[Cell, ...], ...] = ()
    words: frozenset[int] = frozenset()
    """Columns of words; all others but the first are numbers and stand flush right."""
    sections: tuple[tuple[int, str], ...] = ()
    parts: tuple[int, ...] = ()
    signs: bool = False

    @property
    def bodies(self) -> tuple[tuple[str, tuple[tuple[Cell, ...], ...]], ...]:
        """The rows under each heading; a table without headings is one body under none."""
        if not self.sections:
            return (("", self.rows),)
        ends = [*(start for start, _ in self.sections[1:]), len(self.rows)]
        return tuple((title, self.rows[start:end]) for (start, title), end in zip(self.sections, ends, strict=True))


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
    weight, space = ("kg", 1.0) if max(row.mass for row in rows) >= HEAVY else ("g", 1e-3), ("mm³", 1e-9)
    if max(row.volume for row in rows) >= LARGE:
        space = ("dm³", 1e-3)

    def mass(value: float) -> str:
        return f"{value / weight[1]:.2f}" if value else DASH

    def volume(value: float) -> str:
        return f"{value / space[1]:,.0f}".replace(",", "\u202f") if value else DASH

    lines = tuple(
        (
            Cell(row.name),
            Cell(row.part_number.replace("-", "\u2011")),
            Cell(row.group),
            Cell(row.material),
            Cell(row.size),
            Cell(row.designation or row.source),
            Cell(str(row.count)),
            Cell(volume(row.volume)),
            Cell(mass(row.mass)),
            Cell(mass(row.mass * row.count)),
        )
        for row in rows
    )
    titles = (f"Volume of one ({space[0]})", f"Mass of one ({weight[0]})", f"Mass ({weight[0]})")
    groups = [*dict.fromkeys(row.group for row in rows)]
    sums = [(capital(group), [row for row in rows if row.group == group]) for group in groups]
    foot = []
    for title, members in [*(sums if len(sums) > 1 else []), ("All parts", rows)]:
        blank, count = Cell(""), sum(row.count for row in members)
        whole = Cell(mass(sum(row.mass * row.count for row in members)), "strong")
        foot.append((Cell(title), *(blank,) * 5, Cell(str(count)), blank, blank, whole))
    head = ("Part", "Number", "Group", "Material", "Size", "Make, or buy as", "Pieces", *titles)
    numbers = tuple(row.number for row in rows)
    return Table("Parts and masses", head, lines, tuple(foot), frozenset({1, 2, 3, 4, 5}), parts=numbers)


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
