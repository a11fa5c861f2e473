"""What the command line says of tolerances: yield, the limits it is lost at, and the tolerances that cost it."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

from fluxbore.design.performance import FIGURES
from fluxbore.design.rates import Measure, measure_of_figure, measure_of_key
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import to_plain
from fluxbore.optimize.tolerance_result import CONFIDENCE, FigureSpread, Interval, RobustResult, ToleranceResult
from fluxbore.search_messages import search_plain
from fluxbore.value_text import show_subject, tolerance_size

MOST_REASONS = 3
"""Commonest reasons of rejects that are quoted."""


def tolerance_plain(result: ToleranceResult) -> dict[str, Any]:
    """The whole analysis: yield with its confidence interval, limits, tolerances, figures, rejects."""
    parts = (
        "simulated",
        "checked",
        "direct",
        "rejects",
        "failures",
        "figures",
        "requirements",
        "effects",
        "production",
    )
    status = "ok" if result.nominal.ok else result.nominal.status
    return {
        "status": status,
        "reasons": list(result.nominal.reasons),
        "yield": asdict(result.best_estimate),
        "confidence": CONFIDENCE,
        "samples": result.examined,
        "values": dict(result.values),
        "held": list(result.held),
        "nominal": to_plain(result.nominal)["performance"],
        **{name: _plain(getattr(result, name)) for name in parts},
        "warnings": list(result.warnings),
        "evaluations": result.evaluations,
        "reused": result.reused,
    }


def _plain(value: Any) -> Any:
    """Dataclasses as objects whose keys are texts, as JSON has them."""
    if hasattr(value, "__dataclass_fields__"):
        return {name: _plain(getattr(value, name)) for name in value.__dataclass_fields__}
    if isinstance(value, dict) or hasattr(value, "items"):
        return {str(key): _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, (list, tuple)) else value


def robust_plain(result: RobustResult) -> dict[str, Any]:
    """The search for the yield asked for: its rounds, and the design it ended with."""
    best = result.best
    return {
        "status": "ok" if result.reached else "yield not reached" if best is not None else "no feasible design",
        "reasons": [] if result.reached else [result.stop_reason],
        "stop_reason": result.stop_reason,
        "target": result.target,
        "price": result.price,
        "rounds": [
            {
                "objective": item.objective,
                "yield": _plain(item.production.best_estimate) if item.production is not None else None,
                "limits": [asdict(limit) for limit in item.limits],
                "reason": item.reason,
            }
            for item in result.rounds
        ],
        "search": search_plain(best.search) if best is not None else None,
        "tolerance": tolerance_plain(best.production) if best is not None and best.production is not None else None,
    }


def tolerance_text(spec: Spec, result: ToleranceResult) -> str:
    """The yield, where it is lost, which tolerance hurts most, and how the figures scatter."""
    if not result.nominal.ok:
        return f"{result.nominal.status}: " + " ".join(result.nominal.reasons)
    how = f"{result.examined} samples of the linear model"
    if result.checked is not None:
        how += f", corrected by {result.production.checks} computed in full"
    cost = f", {result.reused} of them from the journal" if result.reused else ""
    lines = [f"Yield: {_share(result.best_estimate)}; {how}; designs evaluated: {result.evaluations}{cost}."]
    if result.requirements:
        lines += ["", "Limits:"]
    for item in result.requirements:
        subject = item.limit.subject
        limit = f"{subject} {item.limit.sense} {show_subject(subject, item.limit.limit)}"
        lines.append(
            f"  {limit}: {_share(item.best_estimate)} hold it, the mean is {_room(item.margin)}, "
            f"without this limit the yield would gain {_points(item.cost)}"
        )
    lines += ["", "Tolerances, the most harmful first:"]
    for effect in result.effects:
        found = effect.tolerance
        nominal = show_subject(found.key, result.values[found.key])
        lines.append(
            f"  {found.key} {nominal} {tolerance_size(found, spec.kind.known(found.key))}, {found.distribution}: "
            f"half of it would gain {_points(effect.gain)}"
        )
    lines += ["", f"Figures (mean, standard deviation, worst case; {_slopes(result)}):"]
    lines += [f"  {_spread(spec, item)}" for item in result.figures if item.sigma > 0]
    for reject in sorted((*result.rejects, *result.failures), key=lambda item: -item.count)[:MOST_REASONS]:
        lines.append(f"{reject.count} cannot be made, such as: {reject.reason}")
    if result.held:
        lines.append(f"Held while the others scatter: {', '.join(result.held)}.")
    return "\n".join([*lines, *result.warnings])


def _slopes(result: ToleranceResult) -> str:
    return "exact slopes" if all(item.exact for item in result.figures) else "some slopes by central differences"


def _share(interval: Interval) -> str:
    low, high = max(interval.low, 0.0), min(interval.high, 1.0)
    return (
        f"{100 * interval.value:.4g} % ({100 * low:.4g} to {100 * high:.4g} % with {100 * CONFIDENCE:g} % confidence)"
    )


def _room(margin: float) -> str:
    if math.isinf(margin):
        return f"{'inside' if margin > 0 else 'outside'} and does not scatter"
    return f"{abs(margin):.3g} standard deviations {'inside' if margin >= 0 else 'outside'}"


def _points(difference: float) -> str:
    return f"{100 * difference:.3g} points"


def _spread(spec: Spec, item: FigureSpread) -> str:
    worst = " to ".join(show_subject(item.subject, value, 5) for value in (item.worst_low, item.worst_high))
    unit = _measure(spec, item)
    most = max(item.shares, key=lambda key: item.shares[key])
    return (
        f"{item.subject}: {show_subject(item.subject, item.mean, 5)}, {unit.show(item.sigma, 3)}, {worst}; "
        f"{100 * item.shares[most]:.3g} % of the variance by {most}"
    )


def _measure(spec: Spec, item: FigureSpread) -> Measure:
    return (
        measure_of_figure(item.subject, item.sigma)
        if item.subject in FIGURES
        else measure_of_key(spec.kind.known(item.subject))
    )


def robust_text(spec: Spec, result: RobustResult) -> str:
    """How the search reached the yield, or did not: what each round had, and what the yield costs."""
    figure = spec.study.objective.figure if spec.study.objective is not None else ""
    lines = [result.stop_reason]
    for number, item in enumerate(result.rounds, 1):
        found = item.reason or "no design"
        if item.production is not None and item.objective is not None:
            found = f"{figure} {show_subject(figure, item.objective)}, yield {_share(item.production.best_estimate)}"
        lines.append(f"Round {number}: {found}")
    if result.price is not None:
        lines.append(f"Price of the yield: {measure_of_figure(figure, result.price).show(result.price)} of {figure}.")
    best = result.best
    if best is not None and best.production is not None:
        lines += ["", tolerance_text(spec, best.production)]
    return "\n".join(lines)
