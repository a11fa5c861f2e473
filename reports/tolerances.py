"""What manufacture makes of the design: the yield, the limits it is lost at, the tolerances that cost it."""

from __future__ import annotations

import math

from fluxbore.design.performance import FIGURES, grouped
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective, Tolerance
from fluxbore.optimize.outcome import Limit
from fluxbore.optimize.tolerance_result import CONFIDENCE, FigureSpread, Interval, RobustResult, ToleranceResult
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import (
    DASH,
    capital,
    difference,
    figure_label,
    figure_scale,
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

LEAST_GAIN = 5e-4
"""Yield; a smaller gain is not told from the sampling's own noise."""


def sentences(spec: Spec, result: ToleranceResult) -> tuple[str, ...]:
    """The yield, how it was estimated, what hurts it most, and what could not be made."""
    if not result.nominal.ok:
        return (f"The design has no figures ({result.nominal.status}): {' '.join(result.nominal.reasons)}",)
    found = [f"{_yield(result.best_estimate)} of the actuators made would meet every limit."]
    how = f"Estimated from {result.examined:,} samples of a linear model by the derivatives".replace(",", "\u202f")
    if result.checked is not None:
        how += f", corrected by {result.production.checks} of them computed in full"
    found.append(f"{how}; {result.evaluations} designs evaluated.")
    worst = result.effects[0] if result.effects else None
    if worst is not None and worst.gain > LEAST_GAIN:
        found.append(
            f"The tolerance of the {key_label(spec, worst.tolerance.key)} hurts most: half of it would raise the yield "
            f"to {percent(worst.halved)}, a gain of {_points(worst.gain)}."
        )
    elif result.effects:
        found.append("No single tolerance costs a notable part of the yield.")
    found += [
        f"{item.count} cannot be made, such as: {item.reason}"
        for item in sorted((*result.rejects, *result.failures), key=lambda item: -item.count)[:3]
    ]
    if result.held:
        found.append(f"Held while the others scatter: {listing(f'the {key_label(spec, key)}' for key in result.held)}.")
    return (*found, *result.warnings)


def requirements(spec: Spec, result: ToleranceResult) -> Table | None:
    """Each limit: where the production stands to it, and what it costs of the yield."""
    rows = []
    for item in result.requirements:
        subject = item.limit.subject
        spread = result.figure(subject)
        scale = subject_scale(spec, subject, [item.limit.limit, item.nominal])
        rows.append(
            (
                Cell(f"{capital(subject_label(spec, subject))} {limit_text(spec, item.limit)}"),
                Cell(scale.quantity(item.nominal)),
                Cell(scale.quantity(spread.mean) if spread is not None else DASH),
                Cell(_room(item.margin), "bad" if item.margin < 0 else ""),
                Cell(_yield(item.best_estimate)),
                Cell(
                    _points(item.cost) if item.cost > LEAST_GAIN else "nothing",
                    "" if item.cost > LEAST_GAIN else "muted",
                ),
            )
        )
    head = ("Limit", "Nominal", "Mean", "Room in standard deviations", "Met by", "Without it the yield would gain")
    return Table("Limits held against the production", head, tuple(rows)) if rows else None


def tolerances(spec: Spec, result: ToleranceResult) -> Table | None:
    """Each tolerance, the most harmful first: what half of it would gain, and its share of each limit's variance."""
    limits = [item.limit for item in result.requirements]
    rows = []
    for effect in result.effects:
        key = effect.tolerance.key
        nominal = result.values[key]
        rows.append(
            (
                Cell(capital(key_label(spec, key))),
                Cell(key_scale(spec, key, [nominal]).quantity(nominal)),
                Cell(tolerance_text(spec, effect.tolerance)),
                Cell(effect.tolerance.distribution),
                Cell(percent(effect.halved)),
                Cell(_points(effect.gain, signed=True), "strong" if effect.gain > LEAST_GAIN else "muted"),
                *(Cell(f"{100 * share:.1f}\u00a0%") for share in effect.shares),
            )
        )
    shares = (f"Share of the variance, {subject_label(spec, limit.subject)}" for limit in limits)
    head = ("Tolerance of", "Nominal", "Within", "Distribution", "Yield with half of it", "Gain", *shares)
    return Table("Tolerances, the most harmful first", head, tuple(rows), words=frozenset({3})) if rows else None


def spreads(spec: Spec, result: ToleranceResult) -> Table | None:
    """How every figure scatters, under its heading; keys that limits name come last."""
    moving = {item.subject: item for item in result.figures if item.sigma > 0}
    rows: list[tuple[Cell, ...]] = []
    sections = []
    keys = tuple(name for name in moving if name not in FIGURES)
    for group, names in [*grouped(moving), *([("Dimensions", keys)] if keys else [])]:
        sections.append((len(rows), group))
        rows += [_spread(spec, moving[name]) for name in names]
    head = ("Figure", "Nominal", "Mean", "Standard deviation", "Worst case", "Most of the variance by")
    return (
        Table("How the figures scatter", head, tuple(rows), words=frozenset({5}), sections=tuple(sections))
        if rows
        else None
    )


def robust_sentences(spec: Spec, result: RobustResult) -> tuple[str, ...]:
    """Whether the yield asked for was reached, and what it costs of the objective."""
    found = [f"A yield of {percent(result.target)} was asked for. {result.stop_reason}"]
    objective = spec.study.objective
    if result.price is not None and objective is not None:
        unit = subject_measure(spec, objective.figure, result.price)
        found.append(
            f"Price of the yield: {difference(unit, abs(result.price))} of {figure_label(objective.figure)} against "
            "the design that stands on its limits."
        )
    return tuple(found)


def rounds(spec: Spec, result: RobustResult) -> Table:
    """Each search with the limits it was given."""
    objective: Objective | None = spec.study.objective
    figure = objective.figure if objective is not None else "force_constant"
    scale = figure_scale(figure, [item.objective for item in result.rounds])
    limits = _moved(result)
    rows = []
    for number, item in enumerate(result.rounds):
        given = {(limit.subject, limit.sense): limit.limit for limit in item.limits}
        made = item.production
        rows.append(
            (
                Cell(str(number + 1) + (" – chosen" if number == result.chosen else "")),
                *(
                    Cell(
                        subject_scale(spec, limit.subject, [limit.limit]).quantity(
                            given.get((limit.subject, limit.sense))
                        )
                    )
                    for limit in limits
                ),
                Cell(scale.number(item.objective)),
                Cell(_yield(made.best_estimate) if made is not None else item.reason or DASH),
            )
        )
    titles = (
        f"{capital(subject_label(spec, item.subject))} {'at most' if item.sense == '<=' else 'at least'}"
        for item in limits
    )
    goal = f"{capital(figure_label(figure))}{f' ({scale.unit})' if scale.unit else ''}"
    return Table("Limits backed off round by round", ("Round", *titles, goal, "Yield"), tuple(rows))


def tolerance_text(spec: Spec, tolerance: Tolerance) -> str:
    """``±0.05 mm``, or ``+0.05 / −0.02 mm``."""
    unit = subject_measure(spec, tolerance.key)
    if tolerance.plus == -tolerance.minus:
        return f"±{difference(unit, tolerance.plus, 4)}"
    low, high = (difference(unit, value, 4, signed=True) for value in (tolerance.minus, tolerance.plus))
    return f"{high} / {low}"


def _moved(result: RobustResult) -> list[Limit]:
    """The limits that some round was given tighter than the first; all of them where none was."""
    first = list(result.rounds[0].limits)
    later = [{(item.subject, item.sense): item.limit for item in step.limits} for step in result.rounds]
    moved = [item for item in first if any(step.get((item.subject, item.sense)) != item.limit for step in later)]
    return moved or first


def _spread(spec: Spec, item: FigureSpread) -> tuple[Cell, ...]:
    scale = subject_scale(spec, item.subject, [item.mean, item.worst_low, item.worst_high])
    unit = subject_measure(spec, item.subject, item.mean)
    most = max(item.shares, key=lambda key: item.shares[key])
    return (
        Cell(capital(subject_label(spec, item.subject))),
        Cell(scale.quantity(item.nominal)),
        Cell(scale.quantity(item.mean)),
        Cell(difference(unit, item.sigma)),
        Cell(f"{scale.number(item.worst_low)} to {scale.quantity(item.worst_high)}"),
        Cell(f"{key_label(spec, most)}, {percent(item.shares[most])}"),
    )


def _yield(interval: Interval) -> str:
    low, high = max(interval.low, 0.0), min(interval.high, 1.0)
    return f"{percent(interval.value)} ({significant(100 * low, 3)} to {percent(high)})"


def confidence() -> str:
    """What the brackets after a share are."""
    return f"In brackets the interval of {percent(CONFIDENCE)} confidence."


def _room(margin: float) -> str:
    if math.isinf(margin):
        return "does not scatter" if margin > 0 else "beyond the limit, does not scatter"
    return significant(margin, 3)


def _points(gain: float, *, signed: bool = False) -> str:
    sign = "+" if signed and gain > 0 else ""
    return f"{sign}{significant(100 * gain, 3)} points"
