"""What the command line says of an optimum and of a conflict: what each limit costs, in words with units."""

from __future__ import annotations

from fluxbore.design.performance import FIGURES
from fluxbore.design.rates import Measure, handy_step, measure_of_figure, measure_of_key
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize.outcome import Clash, Conflict, Multiplier, Optimality
from fluxbore.value_text import show_subject

SMALLEST_SHARE = 1e-6
"""Relative objective per relative limit, below which a limit is said to be free of charge."""


def optimality_lines(spec: Spec, objective: Objective, found: Optimality) -> list[str]:
    """How nearly the design is an optimum, and what more room at each active limit would buy."""
    lines = [
        f"Karush-Kuhn-Tucker residual: {found.residual:.2g} (relative change of {objective.figure} over a variable's "
        "whole range)."
    ]
    if found.multipliers:
        lines.append("What more room would buy, to first order:")
    return [*lines, *(f"  {_limit(item)}: {_bought(spec, objective, item)}" for item in found.multipliers)]


def _limit(item: Multiplier | Clash) -> str:
    word = "at most" if item.sense == "<=" else "at least"
    own = ", its own bound" if item.bound else ""
    return f"{item.subject} {word} {show_subject(item.subject, item.limit)}{own}"


def _bought(spec: Spec, objective: Objective, item: Multiplier) -> str:
    """What a tenth or less of the limit's size would do: ``0.1 mm more would raise force_constant by 0.02 N/A``."""
    if item.share < SMALLEST_SHARE:
        return f"more room would not change {objective.figure}"
    unit = _measure(spec, item.subject, item.limit)
    step = handy_step(item.limit, unit)
    change = item.per_unit * (step if item.sense == "<=" else -step)
    verb = "raise" if change > 0 else "lower"
    amount = measure_of_figure(objective.figure, change).show(abs(change))
    way = "more" if item.sense == "<=" else "less"
    return f"{unit.show(step)} {way} would {verb} {objective.figure} by {amount}"


def _measure(spec: Spec, subject: str, size: float) -> Measure:
    return measure_of_figure(subject, size) if subject in FIGURES else measure_of_key(spec.kind.known(subject))


def _percent(share: float) -> str:
    return f"{100 * share:.3g} %" if share < 10 else f"{100 * share:.0f} %"


def conflict_lines(spec: Spec, found: Conflict) -> list[str]:
    """What keeps the least infeasible design from being feasible, by how much, and what would settle it.

    weight : the limit's share of the conflict. alone : what it would have to give way by, if nothing else did.
    That limits exclude one another is said only where no small step betters the worst of them.
    """
    several = len(found.clashes) > 1
    most = found.unscaled
    missed = _percent(found.worst) if most is None else _measure(spec, most.subject, most.limit).show(most.missed)
    if not found.settled:
        what = "These limits could not be met" if several else "This limit could not be met"
        first = f"{what}, as far as the search went; the nearest design misses the worst by {missed}:"
    elif several:
        first = f"These limits exclude one another; the nearest design misses the worst of them by {missed}:"
    else:
        first = f"This limit cannot be met around the nearest design, whatever the others; it is missed by {missed}:"
    lines = [first]
    for item in found.clashes:
        unit = _measure(spec, item.subject, item.limit)
        parts = [f"found {show_subject(item.subject, item.value)}"]
        if item.missed > 0:
            share = f" ({_percent(item.relative)})" if item.scale is None else ""
            parts.append(f"missed by {unit.show(item.missed)}{share}")
        if item.weight is not None and not item.bound:  # a bound's is on another scale
            parts.append(f"weight {100 * item.weight:.3g} %")
        if item.alone is not None and item.alone > 0:
            parts.append(f"alone {unit.show(item.alone)} would do")
        lines.append(f"  {_limit(item)}: {', '.join(parts)}")
    where = ", ".join(f"{key} {show_subject(key, value)}" for key, value in found.values.items())
    return [*lines, f"  there: {where}"]
