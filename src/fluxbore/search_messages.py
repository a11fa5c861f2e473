"""What the command line says of searches: plain values for ``--json``, and start and result side by side."""

from __future__ import annotations

import re
from dataclasses import asdict
from typing import Any

from fluxbore.design.performance import FIGURES, show_figure
from fluxbore.design.spec import Spec
from fluxbore.optimality_messages import conflict_lines, optimality_lines
from fluxbore.optimize.evaluation import to_plain
from fluxbore.optimize.outcome import Candidate, Check, SearchResult
from fluxbore.optimize.tolerance_result import RobustResult
from fluxbore.value_text import route, show_subject, show_variable

TOLD = ("force_constant", "motor_constant", "stray_field", "yoke_flux_density", "moving_mass", "total_mass")
"""Figures that are told of any search, besides those that it is about."""


def candidate_plain(candidate: Candidate | None) -> dict[str, Any] | None:
    """A design of a study."""
    if candidate is None:
        return None
    evaluation = to_plain(candidate.evaluation)
    return {
        "values": dict(candidate.values),
        "objective": candidate.objective,
        "feasible": candidate.feasible,
        "fidelity": candidate.evaluation.fidelity,
        "status": candidate.evaluation.status,
        "reasons": evaluation["reasons"],
        "performance": evaluation["performance"],
        "constraints": [
            {
                "subject": check.limit.subject,
                "sense": check.limit.sense,
                "limit": check.limit.limit,
                "value": check.value,
                "margin": check.margin,
                "satisfied": check.satisfied,
                "active": check.active,
            }
            for check in candidate.checks
        ],
    }


def search_plain(result: SearchResult) -> dict[str, Any]:
    """The search: how it ended, start, best, chosen and history."""
    chosen = result.chosen
    return {
        "status": "no feasible design" if chosen is None else "ok" if result.ending == "done" else result.ending,
        "reasons": [] if chosen is not None and result.ending == "done" else [result.stop_reason],
        "stop_reason": result.stop_reason,
        "ending": result.ending,
        "algorithm": result.algorithm,
        "evaluations": len(result.history),
        "network_calls": result.network_calls,
        "start": candidate_plain(result.start),
        "network_start": candidate_plain(result.network_start),
        "best": candidate_plain(result.best),
        "rounded": candidate_plain(result.rounded),
        "chosen": candidate_plain(chosen),
        "optimality": asdict(result.optimality) if result.optimality is not None else None,
        "conflict": asdict(result.conflict) if result.conflict is not None else None,
        "history": [
            {"values": dict(step.values), "objective": step.objective, "feasible": step.feasible}
            for step in result.history
        ],
    }


def _limit(check: Check) -> str:
    return f"{check.limit.subject} {check.limit.sense} {show_subject(check.limit.subject, check.limit.limit)}"


def _failures(result: SearchResult) -> list[str]:
    """The commonest reasons of failed designs with their counts; sentences that differ by numbers alone are one."""
    alike: dict[str, list[str]] = {}
    for step in result.history:
        if not step.evaluation.ok:
            reason = " ".join(step.evaluation.reasons)
            alike.setdefault(re.sub(r"[\d.]+", "#", reason), []).append(reason)
    common = sorted(alike.values(), key=len, reverse=True)[:3]
    return [f"{len(reasons)} of them failed, such as: {reasons[0]}" for reasons in common]


def search_text(spec: Spec, result: SearchResult) -> str:
    """Start and chosen design side by side, and why the search ended."""
    cost = f"{result.reused} of them from the journal" if result.replayed else f"in {result.seconds:.0f} s"
    made = f"{len(result.history)} designs by {route(spec, 'fem')}{_network(spec, result)}"
    lines = [_why(result), f"Search{_algorithm(result)}: {made}, {cost}."]
    lines += _failures(result)
    chosen = result.chosen
    if chosen is None:
        missed = conflict_lines(spec, result.conflict) if result.conflict is not None else []
        return "\n".join([*lines, "No feasible design was found.", *missed])
    if dict(chosen.values) == dict(result.start.values):
        lines.append("Nothing better than the start was found.")
    lines.append("")
    lines += variable_lines(spec, result.start, result)
    limited = [check.limit.subject for check in chosen.checks if check.limit.subject in FIGURES]
    goal = [spec.study.objective.figure] if spec.study.objective is not None else []
    for name in dict.fromkeys([*goal, *limited, *TOLD]):
        before, after = (getattr(item.evaluation.performance, name) for item in (result.start, chosen))
        if before is not None or after is not None:
            lines.append(f"{name}: {show_figure(name, before)} -> {show_figure(name, after)}")
    if chosen.checks:
        lines.append(f"Limits at {'the rounded design' if chosen is result.rounded else 'this design'}:")
    for check in chosen.checks:
        state = "active" if check.active else "met"
        found = show_subject(check.limit.subject, check.value) if check.value is not None else "no value"
        lines.append(f"  {_limit(check)}: {found}, {state}")
    lines += _rounding(spec, result)
    if result.optimality is not None and spec.study.objective is not None:
        lines += ["", f"At {'the best design before rounding' if chosen is result.rounded else 'this design'}:"]
        lines += optimality_lines(spec, spec.study.objective, result.optimality)
    return "\n".join(lines)


def _why(result: SearchResult) -> str:
    """Why the search ended; what no design met is left to the list of the conflict, where there is one."""
    if result.chosen is not None or result.conflict is None or not result.conflict.clashes:
        return result.stop_reason
    return result.stop_reason.partition(" No design met every limit; ")[0]


def variable_lines(spec: Spec, start: Candidate, result: SearchResult) -> list[str]:
    """The variables from the start to the chosen design, with the values before rounding beside those it moved."""
    chosen, best = result.chosen, result.best
    lines = []
    for key, value in chosen.values.items() if chosen is not None else ():
        before = best.values[key] if best is not None else value
        unrounded = f" ({show_variable(spec, key, before)} before rounding)" if before != value else ""
        first, last = (show_variable(spec, key, number) for number in (start.values[key], value))
        lines.append(f"{key}: {first} -> {last}{unrounded}")
    return lines


def _algorithm(result: SearchResult) -> str:
    return f" by {result.algorithm}" if result.algorithm else ""


def _network(spec: Spec, result: SearchResult) -> str:
    return f" and {result.network_calls} by {route(spec, 'network')}" if result.network_calls else ""


def _rounding(spec: Spec, result: SearchResult) -> list[str]:
    """What the workshop's steps cost against the best design between them."""
    best, rounded = result.best, result.rounded
    if best is None or rounded is None or spec.study.objective is None:
        return []
    if rounded is not result.chosen:
        missed = [_limit(check) for check in rounded.checks if not check.satisfied]
        why = f"misses {' and '.join(missed)}" if missed else " ".join(rounded.evaluation.reasons)
        return ["", f"Not rounded to the workshop's steps: the rounded design {why}."]
    figure = spec.study.objective.figure
    before, after = best.objective, rounded.objective
    if before is None or after is None:
        return []
    then = f"{show_figure(figure, before)} -> {show_figure(figure, after)}"
    share = f" ({100 * (after / before - 1):+.2g} %)" if before else ""
    return ["", f"Rounded to the workshop's steps: {figure} {then}{share}"]


def robust_design_text(spec: Spec, result: RobustResult) -> str:
    """The variables from the start to the design, and how its search ended; empty where there is no design."""
    best = result.best
    if best is None or result.chosen is None or best.search.chosen is None:
        return ""
    start, found = result.rounds[0].search.start, best.search
    residual = ""
    if found.optimality is not None:
        where = " before rounding" if found.chosen is found.rounded else ""
        residual = f" Karush-Kuhn-Tucker residual{where}: {found.optimality.residual:.2g}."
    lines = [*variable_lines(spec, start, found), f"{found.stop_reason}{residual}"]
    return "\n".join([f"Design of round {result.chosen + 1}:", *(f"  {line}" for line in lines)])
