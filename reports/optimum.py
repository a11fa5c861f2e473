"""How nearly the search's best design is an optimum, what its limits cost, and which limits exclude one another."""

from __future__ import annotations

from fluxbore.design.rates import handy_step, measure_of_figure
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize.outcome import Clash, Conflict, Limit, Multiplier, SearchResult
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import (
    DASH,
    capital,
    difference,
    figure_label,
    key_label,
    key_scale,
    limit_text,
    listing,
    percent,
    significant,
    subject_label,
    subject_measure,
    subject_scale,
)

FREE = 1e-6
"""Relative objective per relative limit, below which a limit costs nothing."""


def residual(search: SearchResult, objective: Objective | None) -> str:
    """The residual of the first-order conditions, and what it promises."""
    found = search.optimality
    if found is None or objective is None:
        return ""
    before = ", before it was rounded," if search.chosen is search.rounded and search.rounded is not None else ""
    free = "" if found.multipliers else " No limit and no bound costs anything there."
    return (
        f"At the joint optimum{before} the first-order conditions of Karush, Kuhn and Tucker hold to a residual of "
        f"{significant(found.residual, 2)}, by exact derivatives: a walk across the whole range of one variable, its "
        f"price at the active limits paid, promises no more than about {percent(found.residual, 2)} of the "
        f"{figure_label(objective.figure)}.{free}"
    )


def prices(spec: Spec, search: SearchResult, objective: Objective | None) -> Table | None:
    """What more room at each active limit or bound would buy, to first order."""
    found = search.optimality
    if found is None or objective is None or not found.multipliers:
        return None
    label = figure_label(objective.figure)
    rows = []
    for item in found.multipliers:
        scale = subject_scale(spec, item.subject, [item.value, item.limit])
        step, bought = _bought(spec, objective, item)
        share = percent(0.01 * item.share, 2) + (" (1\u00a0% of its range)" if item.bound else "")
        share = share if item.limit or item.bound else DASH  # nothing is a share of a limit of zero
        rows.append((Cell(_named(spec, item)), Cell(scale.quantity(item.value)), Cell(step), Cell(bought), Cell(share)))
    better = "larger" if objective.maximise else "smaller"
    return Table(
        f"What more room at the active limits would buy, to first order ({label})",
        ("Limit", "Optimum", "Moved by", f"Would change the {label} by", f"1\u00a0% more room: {better} by"),
        tuple(rows),
    )


def _bought(spec: Spec, objective: Objective, item: Multiplier) -> tuple[str, str]:
    """A handy step that gives the limit more room, and what it does to the objective."""
    unit = subject_measure(spec, item.subject, item.limit)
    step = handy_step(item.limit, unit) * (1 if item.sense == "<=" else -1)
    change = item.per_unit * step
    bought = (
        "nothing" if item.share < FREE else difference(measure_of_figure(objective.figure, change), change, signed=True)
    )
    return difference(unit, step, signed=True), bought


def conflict(spec: Spec, found: Conflict) -> tuple[str, Table]:
    """The sentence about the nearest design, and the limits that exclude one another there."""
    where = listing(
        f"{key_label(spec, key)} {key_scale(spec, key, [value]).quantity(value)}" for key, value in found.values.items()
    )
    sure = "" if found.settled else " as far as the search went"
    most = found.unscaled
    worst = (
        percent(found.worst)
        if most is None
        else difference(subject_measure(spec, most.subject, most.limit), most.missed)
    )
    text = (
        f"These limits exclude one another: the nearest design{sure} ({where}) still misses the worst of them by "
        f"{worst}."
    )
    rows = []
    for item in found.clashes:
        unit = subject_measure(spec, item.subject, item.limit)
        scale = subject_scale(spec, item.subject, [item.value, item.limit])
        share = f" ({percent(item.relative)})" if item.scale is None else ""
        missed = f"{difference(unit, item.missed)}{share}" if item.missed > 0 else DASH
        weight = percent(item.weight) if item.weight is not None and not item.bound else DASH
        alone = difference(unit, item.alone) if item.alone is not None and item.alone > 0 else DASH
        rows.append(
            (
                Cell(_named(spec, item)),
                Cell(scale.quantity(item.value)),
                Cell(missed, "bad" if item.missed > 0 else "muted"),
                Cell(weight),
                Cell(alone),
            )
        )
    head = ("Limit", "Nearest design", "Missed by", "Share of the conflict", "Alone would have to give way by")
    return text, Table("The limits in conflict", head, tuple(rows))


def _named(spec: Spec, item: Multiplier | Clash) -> str:
    """``Stray field at most 21.3 mT``."""
    text = limit_text(spec, Limit(item.subject, item.sense, item.limit))
    return f"{capital(subject_label(spec, item.subject))} {text}{', its own bound' if item.bound else ''}"
