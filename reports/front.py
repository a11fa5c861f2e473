"""The Pareto front in words and as a table: what a step of the second objective costs of the first."""

from __future__ import annotations

from fluxbore.design.rates import handy_step, measure_of_figure
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize.pareto_result import FrontPoint, ParetoResult
from fluxbore.reports.kind_words import KindWords
from fluxbore.reports.tables import Cell, Table, titled
from fluxbore.reports.wording import (
    DASH,
    capital,
    difference,
    duration,
    figure_label,
    figure_scale,
    key_label,
    key_scale,
    listing,
    subject_label,
)

_STANDINGS = {
    "front": ("✓ on the front", "good"),
    "dominated": ("dominated", "muted"),
    "repeated": ("repeated", "muted"),
}

METHODS = {
    "epsilon constraint": "the second figure bounded in steps (ε-constraint)",
    "normal boundary intersection": "normal boundary intersection (Das and Dennis 1998)",
}


def sentences(result: ParetoResult, words: KindWords) -> tuple[str, ...]:
    """What was traded, what the trade costs, how the front was found and why it ended."""
    one, other = figure_label(result.objective.figure), figure_label(result.against.figure)
    method = METHODS.get(result.method, result.method)
    found = [f"{capital(_goal(result.objective))} against {_goal(result.against)}, by {method}."]
    if not result.conflicting:
        found.append(f"{capital(one)} and {other} do not conflict: one design is the best in both.")
    found += [text for text in (_span(result), _exchange_range(result)) if text]
    count = len(result.history)
    cost = (
        f"{result.reused} of them from an earlier run" if result.replayed else f"computed in {duration(result.seconds)}"
    )
    by = f", by {result.algorithm}" if result.algorithm else ""
    found.append(f"{count} designs by {words.route}{by}, {cost}. {result.stop_reason}")
    if result.hypervolume is not None:
        found.append(
            f"The front dominates {result.hypervolume:.3f} of the rectangle between its two ends; a straight one would "
            "dominate half of it."
        )
    return tuple(found)


def table(spec: Spec, result: ParetoResult) -> Table:
    """Every point from one end to the other, those that were not found with the reason."""
    keys = list(dict.fromkeys(key for point in result.points if point.design for key in point.design.values))
    scales = {key: key_scale(spec, key, [p.design.values.get(key) for p in result.points if p.design]) for key in keys}
    one = figure_scale(result.objective.figure, [point.first for point in result.points])
    other = figure_scale(result.against.figure, [point.second for point in result.points])
    rows = []
    for number, point in enumerate(result.points, 1):
        values = point.design.values if point.design is not None else {}
        rows.append(
            (
                Cell(str(number)),
                Cell(one.number(point.first), "strong" if point.standing == "front" else "muted"),
                Cell(other.number(point.second), "strong" if point.standing == "front" else "muted"),
                Cell(exchange(result, point)),
                *(Cell(scales[key].number(values.get(key))) for key in keys),
                _standing(spec, point),
            )
        )
    head = (
        "No.",
        titled(figure_label(result.objective.figure), one),
        titled(figure_label(result.against.figure), other),
        "Exchange along the front",
        *(titled(key_label(spec, key), scales[key]) for key in keys),
        "Standing",
    )
    return Table("Points of the front", head, tuple(rows), words=frozenset({len(head) - 1}))


def exchange(result: ParetoResult, point: FrontPoint) -> str:
    """``+0.02 N/A per 10 g``: how the first figure moves with the second one along the front."""
    if point.slope is None or point.second is None:
        return DASH
    unit = measure_of_figure(result.against.figure, point.second)
    step = handy_step(point.second, unit)
    change = point.slope * step
    gained = difference(measure_of_figure(result.objective.figure, change), change, signed=True)
    return f"{gained} per {difference(unit, step)}"


def _standing(spec: Spec, point: FrontPoint) -> Cell:
    if point.design is None:
        return Cell(f"✗ not found: {point.reason}", "bad")
    text, tone = _STANDINGS.get(point.standing, (point.standing, "muted"))
    active = [subject_label(spec, check.limit.subject) for check in point.design.checks if check.active]
    return Cell(f"{text}; active: {listing(active)}" if active else text, tone)


def _goal(objective: Objective) -> str:
    return f"{'largest' if objective.maximise else 'smallest'} {figure_label(objective.figure)}"


def _span(result: ParetoResult) -> str:
    """What lies between the two ends."""
    first, last = result.anchors
    if first is None or last is None or not result.conflicting:
        return ""
    if None in (first.first, first.second, last.first, last.second):
        return ""
    one = figure_scale(result.objective.figure, [first.first, last.first])
    other = figure_scale(result.against.figure, [first.second, last.second])
    return (
        f"From the {_goal(result.objective)} to the {_goal(result.against)} the "
        f"{figure_label(result.objective.figure)} goes from {one.quantity(first.first)} to {one.quantity(last.first)}, "
        f"the {figure_label(result.against.figure)} from {other.quantity(first.second)} to "
        f"{other.quantity(last.second)}."
    )


def _exchange_range(result: ParetoResult) -> str:
    """Where the second figure is worth most and least of the first."""
    priced = [point for point in result.front if point.slope is not None and point.second is not None]
    if len(priced) < 2:
        return ""
    dear, cheap = (pick(priced, key=lambda point: abs(point.slope or 0.0)) for pick in (max, min))
    unit = measure_of_figure(result.against.figure, max(abs(point.second or 0.0) for point in priced))
    step = handy_step(max(abs(point.second or 0.0) for point in priced), unit)
    scale = figure_scale(result.against.figure, [dear.second, cheap.second])
    steep, flat = (
        difference(
            measure_of_figure(result.objective.figure, (point.slope or 0.0) * step),
            (point.slope or 0.0) * step,
            signed=True,
        )
        for point in (dear, cheap)
    )
    return (
        f"{difference(unit, step)} more {figure_label(result.against.figure)} moves the "
        f"{figure_label(result.objective.figure)} by {steep} at {scale.quantity(dear.second)} and by {flat} at "
        f"{scale.quantity(cheap.second)}, all variables following."
    )
