"""Figures of several designs side by side: differences to the first, and the best where a goal tells which it is."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from fluxbore.design.performance import FIGURES, grouped
from fluxbore.reports.compare_content import ComparedDesign, Comparison
from fluxbore.reports.figure_tables import against
from fluxbore.reports.wording import DASH, capital, figure_label, figure_scale, significant

MANIFOLD = 10.0
"""Times the first, from which per cent say less than a factor."""

FAR_APART = 1e3
"""Times the smallest, from which the numbers of a row have units of their own."""


@dataclass(frozen=True, slots=True)
class SideCell:
    """A text, what stands small behind it, and how it is set: tone as of `tables.Cell`; best of its row or not."""

    text: str
    note: str = ""
    tone: str = ""
    best: bool = False


@dataclass(frozen=True, slots=True)
class SideTable:
    """A row for each subject, a column for each design. sections : number of the first row under a heading, heading.

    words : whether the cells hold words, which stand flush left. unit : whether the second column is the unit's.
    differs : whether the notes of all designs but the first are differences to it.
    """

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[SideCell, ...], ...]
    sections: tuple[tuple[int, str], ...] = ()
    foot: tuple[tuple[SideCell, ...], ...] = ()
    words: bool = False
    unit: bool = False
    differs: bool = True

    @property
    def before(self) -> int:
        """How many columns stand before the first design's."""
        return 2 if self.unit else 1

    @property
    def bodies(self) -> tuple[tuple[str, tuple[tuple[SideCell, ...], ...]], ...]:
        """The rows under each heading; a table without headings is one body under none."""
        if not self.sections:
            return (("", self.rows),)
        ends = [*(start for start, _ in self.sections[1:]), len(self.rows)]
        return tuple((title, self.rows[start:end]) for (start, title), end in zip(self.sections, ends, strict=True))


def glance(comparison: Comparison) -> SideTable | None:
    """What the designs were made for: goals, limited figures and headlines that all of them have."""
    wanted: dict[str, None] = {}
    for design in comparison.designs:
        study = design.spec.study
        if study.objective is not None:
            wanted[study.objective.figure] = None
    wanted |= dict.fromkeys(name for name in _directions(comparison) if name in FIGURES)
    wanted |= dict.fromkeys(name for design in comparison.designs for name in design.words.headlines)
    return _table(comparison, [name for name in wanted if _shared(comparison, name)], "Main figures", heads=False)


def common(comparison: Comparison) -> SideTable | None:
    """Every figure that all sound designs have."""
    names = [name for name in FIGURES if _shared(comparison, name)]
    return _table(comparison, names, "Figures that every design has" if not comparison.alike else "All figures")


def partial(comparison: Comparison) -> SideTable | None:
    """Every figure that some designs have and others lack: by their kind, or for want of a value to compute it from."""
    names = [
        name
        for name in FIGURES
        if not _shared(comparison, name) and any(item.figure(name) is not None for item in comparison.designs)
    ]
    return _table(comparison, names, "Figures that not every design has")


def _shared(comparison: Comparison, name: str) -> bool:
    sound = [design for design in comparison.designs if design.evaluation.ok]
    return bool(sound) and all(design.figure(name) is not None for design in sound)


def _table(comparison: Comparison, names: Sequence[str], caption: str, *, heads: bool = True) -> SideTable | None:
    if not names:
        return None
    directions = _directions(comparison)
    rows: list[tuple[SideCell, ...]] = []
    sections = []
    for group, members in grouped(names) if heads else [("", names)]:
        sections.append((len(rows), group))
        rows += [_row(comparison, name, directions.get(name, 0)) for name in members]
    head = ("Figure", "Unit", *(design.letter for design in comparison.designs))
    return SideTable(caption, head, tuple(rows), tuple(sections) if heads else (), unit=True)


def _row(comparison: Comparison, name: str, direction: int) -> tuple[SideCell, ...]:
    values = [design.figure(name) for design in comparison.designs]
    scale = figure_scale(name, values)
    best = best_of(values, direction, comparison.same)
    apart = _far_apart(values)
    unit = SideCell(DASH if apart else scale.unit or DASH, tone="muted")
    cells = [SideCell(capital(figure_label(name))), unit]
    for i, value in enumerate(values):
        note = "" if i == 0 else _difference(name, values[0], value, comparison.same)
        shown = figure_scale(name, [value]).quantity(value) if apart else scale.number(value)
        cells.append(SideCell(shown, note, best=i in best))
    return tuple(cells)


def _far_apart(values: Sequence[float | None]) -> bool:
    """Whether one unit with as many decimals for all would leave nothing of the smallest."""
    sizes = [abs(value) for value in values if value]
    return bool(sizes) and max(sizes) > FAR_APART * min(sizes)


def _difference(name: str, first: float | None, value: float | None, same: float) -> str:
    """Against the first: a share, many times it a factor, of temperatures a difference; "=" for what is the same."""
    if first is None or value is None:
        return ""
    if close(first, value, same):
        return "="
    if FIGURES[name].dimension != "temperature" and first * value > 0 and abs(value) > MANIFOLD * abs(first):
        return f"× {significant(value / first, 3)}"
    return against(name, first, value)


def close(first: float, second: float, same: float) -> bool:
    """Whether two numbers count as the same."""
    return math.isclose(first, second, rel_tol=same, abs_tol=0.0) or first == second


def best_of(values: Sequence[float | None], direction: int, same: float) -> frozenset[int]:
    """Which of the values are the best, those that count as the same with it; none where no direction is known, fewer
    than two can be compared, or all are the same.

    direction : 1 where more is better, -1 where less is.
    """
    known = [value for value in values if value is not None and math.isfinite(value)]
    if not direction or len(known) < 2:
        return frozenset()
    top = max(known, key=lambda value: direction * value)
    if all(close(top, value, same) for value in known):
        return frozenset()
    return frozenset(i for i, value in enumerate(values) if value is not None and close(top, value, same))


def _directions(comparison: Comparison) -> dict[str, int]:
    """Figure or key -> 1 where more of it is better, -1 where less: by what the designs' studies ask for.

    What one study wants more of and another less, and what is limited on both sides, has no direction.
    """
    asked: dict[str, set[int]] = {}
    for design in comparison.designs:
        for subject, sign in _wishes(design):
            asked.setdefault(subject, set()).add(sign)
    return {subject: min(signs) for subject, signs in asked.items() if len(signs) == 1}


def _wishes(design: ComparedDesign) -> Iterable[tuple[str, int]]:
    objective = design.spec.study.objective
    if objective is not None:
        yield objective.figure, 1 if objective.maximise else -1
    for limit in design.spec.study.constraints:
        if limit.lower is not None:
            yield limit.subject, 1
        if limit.upper is not None:
            yield limit.subject, -1
