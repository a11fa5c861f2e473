"""Every design that a study computed, as rows and columns that plots and a table share."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from fluxbore.design.errors import FluxboreError
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.noise import clear_value
from fluxbore.optimize.outcome import Candidate, Check, Limit, SweepResult
from fluxbore.optimize.problem import check, resolve_limits
from fluxbore.reports.content import ReportContent
from fluxbore.reports.wording import Scale, capital, key_scale, subject_label, subject_scale

MOST = 1500
"""Designs on the page; of more, so many evenly spread over the order in which they were computed."""

FEWEST = 3
"""Designs below which there is nothing to compare."""

COLUMNS = 9
"""Axes side by side that can still be told apart."""

FEASIBLE, BROKEN = "meets every limit", "breaks a limit"


@dataclass(frozen=True, slots=True)
class Column:
    """One axis: a variable, an objective or a figure under a limit. Numbers are in the unit of ``scale``.

    ends : of the axis. limits : sense and number of what the study asks of it.
    """

    subject: str
    label: str
    scale: Scale
    ends: tuple[float, float]
    limits: tuple[tuple[str, float], ...] = ()

    @property
    def title(self) -> str:
        return f"{self.label} ({self.scale.unit})" if self.scale.unit else self.label


@dataclass(frozen=True, slots=True)
class Design:
    """One design: a number for each column (None where its route gives none), how it stands, where it comes from.

    mark : "start", "chosen", "published optimum", or empty.
    """

    values: tuple[float | None, ...]
    feasible: bool
    origin: str
    mark: str = ""


@dataclass(frozen=True, slots=True)
class DesignTable:
    """The columns and the designs; ``left_out`` were too many, ``lost`` have no result.

    across, up : numbers of the two columns that the scatter shows first.
    """

    columns: tuple[Column, ...]
    designs: tuple[Design, ...]
    left_out: int
    lost: int
    across: int
    up: int


@dataclass(slots=True)
class _Found:
    """A design while it is gathered, in SI."""

    values: Mapping[str, float]
    evaluation: Evaluation
    checks: tuple[Check, ...]
    origin: str
    marks: list[str] = field(default_factory=list)

    def value(self, subject: str) -> float | None:
        found = getattr(self.evaluation.performance, subject) if subject in FIGURES else self.values.get(subject)
        return float(found) if found is not None and math.isfinite(found) else None


def design_table(content: ReportContent) -> DesignTable | None:
    """All designs of search, front and sweeps by one route; None where there are too few to compare."""
    found = _gathered(content)
    sound = [item for item in found if item.evaluation.ok]
    subjects = _subjects(content)
    kept = _thinned(sound)
    columns = [column for subject in subjects if (column := _column(content, subject, kept)) is not None]
    if len(kept) < FEWEST or len(columns) < 2:
        return None
    columns = columns[:COLUMNS]
    designs = tuple(_design(item, columns) for item in kept)
    across, up = _first_pair(content, [column.subject for column in columns])
    return DesignTable(tuple(columns), designs, len(sound) - len(kept), len(found) - len(sound), across, up)


def _design(item: _Found, columns: list[Column]) -> Design:
    values = (item.value(column.subject) for column in columns)
    shown = tuple(
        None if value is None else column.scale.shown(value) for value, column in zip(values, columns, strict=True)
    )
    return Design(shown, all(one.satisfied for one in item.checks), item.origin, item.marks[0] if item.marks else "")


def _gathered(content: ReportContent) -> list[_Found]:
    """Each design once, in the order in which it was asked for; what was computed by another route is no peer."""
    base = _base(content.spec)
    variables = [variable.key for variable in content.spec.study.variables]
    keys = variables or [axis.key for result in content.sweeps for axis in result.sweep.axes]
    found: dict[tuple[float | None, ...], _Found] = {}
    fidelity = ""
    for origin, values, evaluation, checks in _sources(content, base):
        fidelity = fidelity or evaluation.fidelity
        if evaluation.fidelity != fidelity:
            continue
        whole = {**base, **{key: clear_value(content.spec, key, value) for key, value in values.items()}}
        place = _place(whole, keys)
        # A sweep beyond the variables moves what these leave alone: such designs are told apart by their figures.
        others = tuple(value for key, value in sorted(values.items()) if key not in keys)
        found.setdefault((*place, *others), _Found(whole, evaluation, checks, origin))
    _mark(content, {key[: len(keys)]: item for key, item in reversed(found.items())}, base, keys)
    return list(found.values())


def _sources(
    content: ReportContent, base: Mapping[str, float]
) -> Iterator[tuple[str, Mapping[str, float], Evaluation, tuple[Check, ...]]]:
    search, front = content.search, content.front
    candidates: list[tuple[str, Candidate | None]] = []
    if search is not None:
        candidates += [("search", search.start), *(("search", item) for item in search.history)]
        candidates += [("search", search.best), ("search", search.rounded), ("one at a time", content.one_at_a_time)]
    if front is not None:
        candidates += [("front", front.start), *(("front", item) for item in front.history)]
        candidates += [("front", point.design) for point in front.points]
    for origin, item in candidates:
        if item is not None:
            yield origin, item.values, item.evaluation, item.checks
    limits = _limits(content)
    for result in content.sweeps:
        for row in result.rows:
            values = {**base, **row.values}
            yield _sweep_name(result), row.values, row.evaluation, check(limits, values, row.evaluation.performance)


def _sweep_name(result: SweepResult) -> str:
    return f"sweep “{result.sweep.name}”"


def _base(spec: Spec) -> dict[str, float]:
    """The start's numbers."""
    values = spec.for_study().values
    return {key: float(value) for key, value in values.items() if isinstance(value, (int, float))}


def _limits(content: ReportContent) -> tuple[Limit, ...]:
    """The study's limits; none where the start that they refer to has no result."""
    if content.start is None:
        return ()
    try:
        return resolve_limits(content.spec, content.start)
    except FluxboreError:
        return ()


def _place(values: Mapping[str, float], keys: list[str]) -> tuple[float | None, ...]:
    return tuple(None if (value := values.get(key)) is None else float(f"{value:.9g}") for key in keys)


def _mark(
    content: ReportContent,
    found: Mapping[tuple[float | None, ...], _Found],
    base: Mapping[str, float],
    keys: list[str],
) -> None:
    """Start, chosen and published designs, where they were computed."""
    published = {
        result.sweep.axes[0].key: result.sweep.reference
        for result in content.sweeps
        if result.sweep.reference is not None
    }
    chosen = content.search.chosen if content.search is not None else None
    for name, values in (
        ("chosen", chosen.values if chosen is not None else None),
        ("start", {}),
        ("published optimum", published or None),
    ):
        item = found.get(_place({**base, **values}, keys)) if values is not None else None
        if item is not None:
            item.marks.append(name)


def _thinned(found: list[_Found]) -> list[_Found]:
    if len(found) <= MOST:
        return found
    picked = {round(i * (len(found) - 1) / (MOST - 1)) for i in range(MOST)}
    return [item for i, item in enumerate(found) if i in picked or item.marks]


def _subjects(content: ReportContent) -> list[str]:
    """Variables, what is swept besides them, objectives, figures under limits."""
    study = content.spec.study
    names = [variable.key for variable in study.variables]
    names += [axis.key for result in content.sweeps for axis in result.sweep.axes]
    names += [study.objective.figure] if study.objective is not None else ["force_constant"] if content.sweeps else []
    names += [content.front.against.figure] if content.front is not None else []
    names += [constraint.subject for constraint in study.constraints]
    return list(dict.fromkeys(names))


def _column(content: ReportContent, subject: str, found: list[_Found]) -> Column | None:
    """The axis of a subject; None where no two designs differ in it."""
    spec = content.spec
    values = [value for item in found if (value := item.value(subject)) is not None]
    if not values or max(values) - min(values) <= 1e-9 * max(abs(value) for value in values):
        return None
    sound = [item.value(subject) for item in found if item.marks or all(one.satisfied for one in item.checks)]
    low, high = _window(values, [value for value in sound if value is not None])
    for variable in spec.study.variables:
        if variable.key == subject:
            low, high = min(low, variable.lower), max(high, variable.upper)
    scale = subject_scale(spec, subject, values) if subject in FIGURES else key_scale(spec, subject, values)
    limits = tuple((limit.sense, scale.shown(limit.limit)) for limit in _limits(content) if limit.subject == subject)
    ends = (scale.shown(low), scale.shown(high))
    return Column(subject, capital(subject_label(spec, subject)), scale, ends, limits)


def _window(values: list[float], sound: list[float]) -> tuple[float, float]:
    """Ends of an axis: twice beyond what sound designs span, no further than the designs reach."""
    low, high = min(values), max(values)
    if len(sound) >= FEWEST:
        span = max(sound) - min(sound) or 0.05 * abs(sound[0])
        low, high = max(low, min(sound) - 2 * span), min(high, max(sound) + 2 * span)
    spare = 0.03 * (high - low)
    return low - spare, high + spare


def _first_pair(content: ReportContent, subjects: list[str]) -> tuple[int, int]:
    """The objective over the second one, else over the first variable."""
    study = content.spec.study
    figure = study.objective.figure if study.objective is not None else "force_constant"
    up = subjects.index(figure) if figure in subjects else len(subjects) - 1
    against = content.front.against.figure if content.front is not None else ""
    across = subjects.index(against) if against in subjects else 0
    return (across, up) if across != up else (int(up == 0), up)


def page_data(table: DesignTable) -> dict[str, Any]:
    """What the page's script reads: columns, and the designs column by column, to five digits."""
    origins = list(dict.fromkeys(item.origin for item in table.designs))
    return {
        "columns": [
            {"label": item.label, "unit": item.scale.unit, "decimals": item.scale.decimals, "ends": item.ends}
            for item in table.columns
        ],
        "values": [
            [None if value is None else float(f"{value:.5g}") for value in column]
            for column in zip(*(item.values for item in table.designs), strict=True)
        ],
        "broken": [int(not item.feasible) for item in table.designs],
        "origins": origins,
        "origin": [origins.index(item.origin) for item in table.designs],
        "marks": {str(number): item.mark for number, item in enumerate(table.designs) if item.mark},
        "across": table.across,
        "up": table.up,
    }
