"""What the command line says of a Pareto front."""

from __future__ import annotations

from typing import Any

from fluxbore.design.performance import show_figure
from fluxbore.design.rates import handy_step, measure_of_figure
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize.pareto_result import FrontPoint, ParetoResult
from fluxbore.search_messages import candidate_plain
from fluxbore.value_text import route, short_names, show_subject


def pareto_plain(result: ParetoResult) -> dict[str, Any]:
    """The front: how it ended, and all its points in order, those that are dominated or failed among them."""
    found = bool(result.front)
    done = result.ending == "done"
    return {
        "status": "no feasible design" if not found else "ok" if done else result.ending,
        "reasons": [] if found and done else [result.stop_reason],
        "stop_reason": result.stop_reason,
        "objective": _goal(result.objective),
        "against": _goal(result.against),
        "method": result.method,
        "conflicting": result.conflicting,
        "hypervolume": result.hypervolume,
        "reference": result.reference,
        "evaluations": len(result.history),
        "start": candidate_plain(result.start),
        "points": [
            {
                "position": point.position,
                "limit": point.limit,
                "standing": point.standing,
                "first": point.first,
                "second": point.second,
                "slope": point.slope,
                "residual": point.residual,
                "designs": point.designs,
                "reason": point.reason,
                "design": candidate_plain(point.design),
            }
            for point in result.points
        ],
    }


def _goal(objective: Objective) -> str:
    return f"{'maximise' if objective.maximise else 'minimise'} {objective.figure}"


def pareto_text(spec: Spec, result: ParetoResult) -> str:
    """The front as a table: both figures, what a step of the second one costs, and the variables."""
    cost = f"{result.reused} of them from the journal" if result.replayed else f"in {result.seconds:.0f} s"
    lines = [
        result.stop_reason,
        f"Front of {_goal(result.objective)} against {_goal(result.against)}, {result.method}: "
        f"{len(result.history)} designs by {route(spec, 'fem')}, {cost}.",
    ]
    lines += _constant(result)
    rows = [_row(result, point) for point in result.points]
    rows.insert(0, [result.objective.figure, result.against.figure, "exchange", "standing", "design"])
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    lines += [
        "",
        *("  ".join([*(cell.ljust(w) for cell, w in zip(row, widths, strict=False)), row[4]]) for row in rows),
    ]
    if result.hypervolume is not None:
        lines += [
            "",
            f"Hypervolume: {result.hypervolume:.4g} of the rectangle between its ends (a straight front: 0.5).",
        ]
    return "\n".join(line.rstrip() for line in lines)


def _constant(result: ParetoResult) -> list[str]:
    """Where there is nothing to trade: the figure that no design of the search moved, if that is why."""
    if result.conflicting:
        return []
    figures = (result.objective.figure, result.against.figure)
    found = []
    for figure in figures:
        values = {getattr(made.evaluation.performance, figure) for made in result.history if made.evaluation.ok}
        if len(values - {None}) == 1 and len(result.history) > 1:
            value = show_figure(figure, max(values - {None}))
            found.append(f"No variable moves {figure}: it is {value} in every design of the search.")
    return found


def _row(result: ParetoResult, point: FrontPoint) -> list[str]:
    if point.design is None:
        return ["-", "-", "-", point.standing, point.reason]
    short = short_names(point.design.values)
    values = ", ".join(f"{short[key]} {show_subject(key, value)}" for key, value in point.design.values.items())
    return [
        show_figure(result.objective.figure, point.first),
        show_figure(result.against.figure, point.second),
        _exchange(result, point),
        point.standing,
        values,
    ]


def _exchange(result: ParetoResult, point: FrontPoint) -> str:
    """How the first figure moves with the second along the front: ``+0.02 N/A per 10 g``."""
    if point.slope is None or point.second is None:
        return "-"
    unit = measure_of_figure(result.against.figure, point.second)
    step = handy_step(point.second, unit)
    change = point.slope * step
    sign = "+" if change >= 0 else "-"
    return f"{sign}{measure_of_figure(result.objective.figure, change).show(abs(change))} per {unit.show(step)}"
