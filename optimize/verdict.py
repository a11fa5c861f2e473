"""What is to be said of a search as a whole: its history in one piece, and why nothing was feasible."""

from __future__ import annotations

import math
from collections.abc import Sequence

from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize import elastic
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.outcome import Candidate, Conflict
from fluxbore.optimize.problem import better, show_limit, show_miss, violation
from fluxbore.optimize.stages import Stages


def joined(archives: Sequence[Archive], objective: Objective) -> tuple[tuple[Candidate, ...], tuple[int | None, ...]]:
    """The history of all archives, one after the other, and the index of the best so far at each step of it."""
    history: list[Candidate] = []
    best_so_far: list[int | None] = []
    best: int | None = None
    for archive in archives:
        offset = len(history)
        history += archive.history
        for own in archive.best_so_far:
            if own is not None and (best is None or better(history[offset + own], history[best], objective)):
                best = offset + own
            best_so_far.append(best)
    return tuple(history), tuple(best_so_far)


def conflict_of(searches: Sequence[Stages]) -> Conflict | None:
    """What keeps the least infeasible design of all searches from being feasible."""
    if not searches:
        return None
    nearest = min(searches, key=lambda stages: min(map(violation, stages.archive.history), default=math.inf))
    return elastic.conflict(nearest.slopes, nearest.archive.history)


def shortfall(base: Spec, history: Sequence[Candidate], conflict: Conflict | None) -> str:
    """Where no design is feasible: which limits the nearest one misses, by how much, and which are in conflict."""
    if not history:
        return ""
    nearest = min(history, key=violation)
    if math.isinf(violation(nearest)):
        return _without(base, history)
    missed = [
        f"{item.limit.subject} {item.limit.sense} {show_limit(base, item.limit)} by {show_miss(base, item)}"
        for item in nearest.checks
        if not item.satisfied and item.margin is not None
    ]
    words = f" No design met every limit; the nearest missed {' and '.join(missed)}."
    return words + (elastic.describe(base, conflict) if conflict is not None else "")


def _without(base: Spec, history: Sequence[Candidate]) -> str:
    """What is missing where every design lacks something: figures, or sound designs at all."""
    sound = [made for made in history if made.evaluation.ok]
    if not sound:
        reasons = list(dict.fromkeys(reason for made in history for reason in made.evaluation.reasons))
        return " None of its designs could be evaluated." + (f" The first: {reasons[0]}" if reasons else "")
    figure = base.study.objective.figure if base.study.objective is not None else ""
    lacking = [made for made in sound if made.objective is None]
    if len(lacking) == len(sound):
        return f" None of its designs gives {figure}, the objective.{_reasons(sound, [figure])}"
    names = [item.limit.subject for made in sound for item in made.checks if item.margin is None and not item.satisfied]
    named = list(dict.fromkeys(names))
    return f" No design gives every figure that is limited; missing are {' and '.join(named)}.{_reasons(sound, named)}"


def _reasons(sound: Sequence[Candidate], figures: Sequence[str]) -> str:
    """The evaluations' own words about figures that are not given, each once."""
    words = dict.fromkeys(
        warning
        for made in sound
        for warning in made.evaluation.warnings
        if any(warning.startswith(f"{name} is not given") for name in figures)
    )
    return "".join(f" {word}" for word in list(words)[:3])
