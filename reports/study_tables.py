"""The tables about the study: key figures, requirements, variables, and the designs on the way."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize.noise import clear_value
from fluxbore.optimize.outcome import Candidate, Check, SearchResult
from fluxbore.reports.content import ReportContent
from fluxbore.reports.tables import Cell, Table, titled
from fluxbore.reports.wording import (
    DASH,
    capital,
    change,
    figure_label,
    figure_scale,
    key_label,
    key_range,
    key_scale,
    limit_text,
    listing,
    meaning,
    room_text,
    subject_label,
    subject_scale,
    symbol,
)

AT_BOUND = 1e-3
"""Share of a variable's range within which it counts as standing at its bound."""


@dataclass(frozen=True, slots=True)
class Tile:
    """One key figure of the first screen."""

    label: str
    value: str
    unit: str
    before: str
    change: str
    meaning: str


@dataclass(frozen=True, slots=True)
class VariableRow:
    """A design variable between its bounds. Shares (0 to 100) place the marks of its range bar."""

    label: str
    symbol: str
    cells: tuple[Cell, ...]
    start_share: float
    chosen_share: float | None


def tiles(content: ReportContent) -> tuple[Tile, ...]:
    """The key figures of the design, each beside the start's."""
    design, start = content.design, content.start if content.is_study else None
    if design is None or not design.ok:
        return ()
    objective = content.spec.study.objective
    names = dict.fromkeys([*([objective.figure] if objective else []), *content.words.headlines])
    found = []
    for name in names:
        value = getattr(design.performance, name)
        before = getattr(start.performance, name) if start is not None else None
        if value is not None:
            scale = figure_scale(name, [value, before])
            more = change(before, value)
            old = f"start {scale.quantity(before)}" if before is not None else ""
            found.append(Tile(capital(figure_label(name)), scale.number(value), scale.unit, old, more, meaning(name)))
    return tuple(found[:6])


def requirements(content: ReportContent) -> Table | None:
    """Every limit held against the design, and against the start where there is one."""
    checks = content.design_checks
    if not checks:
        return None
    start = content.search.start.checks if content.search is not None and content.is_study else ()
    before = {(check.limit.subject, check.limit.sense): check.value for check in start}
    relative = {limit.subject for limit in content.spec.study.constraints if limit.relative_to_start}
    rows = []
    for check in checks:
        limit = check.limit
        old = before.get((limit.subject, limit.sense))
        scale = subject_scale(content.spec, limit.subject, [limit.limit, check.value, old])
        wanted = limit_text(content.spec, limit) + (" (from the start)" if limit.subject in relative else "")
        cells = [
            Cell(capital(subject_label(content.spec, limit.subject))),
            verdict(content.spec, check),
            Cell(wanted),
            Cell(scale.quantity(check.value)),
        ]
        if start:
            cells.append(Cell(scale.quantity(old), "muted"))
        rows.append(tuple(cells))
    head = ("Requirement", "Verdict", "Limit", "Design", *(("Start",) if start else ()))
    return Table("Requirements and whether the design meets them", head, tuple(rows), words=frozenset({1, 2}))


def verdicts(content: ReportContent) -> tuple[Cell, ...]:
    """Each requirement in a line, for the first screen: its mark, its value, its limit; the broken ones first."""
    found = []
    for check in sorted(content.design_checks, key=lambda check: check.satisfied):
        scale = subject_scale(content.spec, check.limit.subject, [check.limit.limit, check.value])
        shown = verdict(content.spec, check)
        value = "" if check.value is None else f" {scale.quantity(check.value)}"
        name = capital(subject_label(content.spec, check.limit.subject))
        found.append(Cell(f"{shown.text[0]} {name}{value}, {limit_text(content.spec, check.limit)}", shown.tone))
    return tuple(found)


def verdict(spec: Spec, check: Check) -> Cell:
    """Whether a limit holds, in words; by how much it is broken, since rounded figures can look equal."""
    if check.unloaded:
        return Cell("✓ met, without load", "good")
    if check.value is None:
        return Cell("? not checked", "muted") if check.satisfied else Cell("✗ not known, so not met", "bad")
    if not check.satisfied:
        missed = check.margin if check.margin is not None and check.margin < 0 else None
        by = f" by {room_text(spec, check.limit, missed)}" if missed is not None else ""
        return Cell(f"✗ broken{by}", "bad")
    return Cell("✓ met, at its limit" if check.active else "✓ met", "good")


def variables(content: ReportContent) -> tuple[tuple[str, ...], tuple[VariableRow, ...]]:
    """Column titles and rows: every variable with its bounds and its value in each candidate that there is."""
    spec, search = content.spec, content.search
    others: list[tuple[str, Candidate | None]] = []
    if search is not None:
        others = [(_cheap_start(content), search.network_start), ("One at a time", content.one_at_a_time)]
        if search.rounded is not None and search.chosen is search.rounded:
            others.append(("Optimum before rounding", search.best))
    columns = [(title, item) for title, item in others if item is not None]
    rows = []
    for variable in spec.study.variables:
        key = variable.key
        start = float(spec.for_study().values[key])
        chosen = float(content.chosen_spec.values[key]) if content.chosen_spec is not None else None
        span = variable.upper - variable.lower

        def share(value: float, lower: float = variable.lower, span: float = span) -> float:
            return min(max(100 * (value - lower) / span, 0.0), 100.0) if span > 0 else 50.0

        cells = [
            Cell(_exact(spec, key, start)),
            *(Cell(_exact(spec, key, i.values.get(key)), "muted") for _, i in columns),
        ]
        if chosen is not None:
            cells.append(Cell(_exact(spec, key, chosen), "strong"))
        steps = f" in steps of {_exact(spec, key, variable.resolution)}" if variable.resolution is not None else ""
        cells.append(Cell(f"{key_range(spec, key, variable.lower, variable.upper)}{steps}"))
        if chosen is not None:
            cells.append(_at_bound(chosen, variable.lower, variable.upper))
        sign = symbol(spec, key)
        sign = "" if "(" in sign else sign  # a formula for a symbol explains nothing that the label does not
        label, place = capital(key_label(spec, key)), share(chosen) if chosen is not None else None
        rows.append(VariableRow(label, sign, tuple(cells), share(start), place))
    decided = content.chosen_spec is not None
    head = ("Variable", "Start", *(title for title, _ in columns), *(("Chosen",) if decided else ()), "Bounds")
    return (*head, *(("At a bound",) if decided else ())), tuple(rows)


def candidates(content: ReportContent) -> Table | None:
    """The designs on the way, each with its objective and its limits."""
    search, objective = content.search, content.spec.study.objective
    if search is None or objective is None:
        return None
    named: list[tuple[str, Candidate | None]] = [
        ("Start", search.start),
        (_cheap_start(content), search.network_start),
        ("One at a time", content.one_at_a_time),
        ("Joint optimum", search.best),
        ("Joint optimum, rounded to the workshop’s steps", search.rounded),
    ]
    present: list[tuple[str, Candidate]] = []
    for name, item in named:
        twin = next((i for i, (_, other) in enumerate(present) if item is not None and _same(item, other)), None)
        if item is None:
            continue
        if twin is None:
            present.append((name, item))
        else:
            present[twin] = (f"{present[twin][0]}, also the {name[0].lower()}{name[1:]}", present[twin][1])
    scale = figure_scale(objective.figure, [item.objective for _, item in present])
    rows = tuple(
        (
            Cell(_named(name, item, content)),
            Cell(scale.number(item.objective), "strong" if _same(item, search.chosen) else ""),
            Cell(_against(search.start, item)),
            _standing(content, item),
        )
        for name, item in present
    )
    title = f"{capital(figure_label(objective.figure))}{f' ({scale.unit})' if scale.unit else ''}"
    return Table("Candidates compared", ("Design", title, "Against start", "Limits"), rows, words=frozenset({3}))


def history(content: ReportContent, search: SearchResult, objective: Objective) -> Table:
    """Every design of the search."""
    keys = [variable.key for variable in content.spec.study.variables]
    spec = content.spec
    scales = {
        key: key_scale(spec, key, [_without_noise(spec, key, c.values.get(key)) for c in search.history])
        for key in keys
    }
    scale = figure_scale(objective.figure, [c.objective for c in search.history])
    rows = tuple(
        (
            Cell(str(i)),
            *(Cell(scales[key].number(_without_noise(content.spec, key, item.values.get(key)))) for key in keys),
            Cell(scale.number(item.objective)),
            _standing(content, item),
        )
        for i, item in enumerate(search.history, start=1)
    )
    titles = (titled(key_label(content.spec, key), scales[key]) for key in keys)
    head = ("No.", *titles, titled(figure_label(objective.figure), scale), "Limits")
    return Table("Designs of the search in their order", head, rows, words=frozenset({len(head) - 1}))


def _at_bound(value: float, lower: float, upper: float) -> Cell:
    near = AT_BOUND * (upper - lower)
    if value <= lower + near:
        return Cell("at its lower bound", "bad")
    return Cell("at its upper bound", "bad") if value >= upper - near else Cell("no", "muted")


def _exact(spec: Spec, key: str, value: float | None) -> str:
    """A key's value with its unit and the decimals it needs, at most three."""
    value = _without_noise(spec, key, value)
    return key_scale(spec, key, [value]).quantity(value)


def _without_noise(spec: Spec, key: str, value: float | None) -> float | None:
    return None if value is None else clear_value(spec, key, value)


def _named(name: str, item: Candidate, content: ReportContent) -> str:
    route = f" ({content.words.network_short})" if item.evaluation.fidelity == "network" else ""
    chosen = content.search.chosen if content.search is not None else None
    return name + route + " – chosen" * _same(item, chosen)


def _cheap_start(content: ReportContent) -> str:
    """The start that the cheap model gives."""
    short = capital(content.words.network_short)
    return f"{short}{'’' if short.endswith('s') else '’s'} start"


def _same(item: Candidate, other: Candidate | None) -> bool:
    """Whether both are one design by one route: the best may be the start, and the rounded one may be the best."""
    if other is None or item.evaluation.fidelity != other.evaluation.fidelity:
        return False
    return dict(item.values) == dict(other.values)


def _against(start: Candidate, item: Candidate) -> str:
    """The change of the objective; figures of two routes are not set against each other."""
    if item.evaluation.fidelity != start.evaluation.fidelity:
        return DASH
    return change(start.objective, item.objective) or DASH


def _unknown(content: ReportContent, item: Candidate) -> list[str]:
    """The figures under a limit that the candidate's route cannot give."""
    subjects = dict.fromkeys(limit.subject for limit in content.spec.study.constraints)
    unloaded = {check.limit.subject for check in item.checks if check.unloaded}
    return [
        figure_label(name)
        for name in subjects
        if name in FIGURES and name not in unloaded and getattr(item.evaluation.performance, name) is None
    ]


def _standing(content: ReportContent, item: Candidate) -> Cell:
    """How a candidate stands to the limits, in words."""
    if not item.evaluation.ok:
        return Cell(" ".join(item.evaluation.reasons) or item.evaluation.status, "bad")
    broken = [subject_label(content.spec, check.limit.subject) for check in item.checks if not check.satisfied]
    if broken:
        return Cell(f"✗ breaks {', '.join(broken)}", "bad")
    unknown = _unknown(content, item)
    if unknown:
        route = f"the {content.words.network_short}" if item.evaluation.fidelity == "network" else content.words.route
        return Cell(f"{listing(unknown)} not known to {route}", "muted")
    active = [subject_label(content.spec, check.limit.subject) for check in item.checks if check.active]
    if item.evaluation.warnings:
        return Cell("✓ met, but with a warning", "warn")
    return Cell(f"✓ met; active: {', '.join(active)}" if active else "✓ met", "good")
