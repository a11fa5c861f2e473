"""Where no design is feasible: the least infeasible one, and which limits exclude one another there.

The problem  min t, misses_i(x) <= t  has multipliers whose sum over the limits is 1. Those that are positive belong to
the limits in conflict: by theorem 12.1 of Nocedal and Wright (2006) no small step betters all of them, and the others
could be dropped without making the problem feasible.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from fluxbore.design.spec import Spec
from fluxbore.optimize.gradient_search import View, minimise
from fluxbore.optimize.gradient_stage import GradientStage
from fluxbore.optimize.nlopt_loop import Ending
from fluxbore.optimize.nlopt_loop import minimise as minimise_freely
from fluxbore.optimize.outcome import Candidate, Check, Clash, Conflict, Limit
from fluxbore.optimize.problem import Box, Point, show_limit, violation
from fluxbore.optimize.slopes import Slopes

NEGLIGIBLE = 1e-3
"""Of the weights' sum: what weighs less takes no part in the conflict."""

TOUCHING = 1e-2
"""Of a variable's range or of the worst miss: what is farther away holds nothing, whatever it would cancel."""

STATIONARY = 1e-2
"""Largest residual of the multipliers at which the least infeasible design counts as found."""

ROUNDS = 2


def approach(stage: GradientStage, start: Candidate) -> None:
    """Let SLSQP look for the least infeasible design from a sound one; what it finds stands in the archive.

    Ends as soon as a design is feasible by ``room``. Raises what stops it from within.
    """
    for _ in range(ROUNDS):
        point, kappas = stage.archive.box.point(start.values), stage.slopes.kappas(start)
        first = stage.at(point, kappas)
        if first is None:
            return
        ending = _relaxed(stage, point, max(first.misses), kappas)
        if ending.stopped_by is not None:
            raise ending.stopped_by
        nearest = min(stage.archive.history, key=violation)
        if stage.archive.best is not None or nearest is start or not kappas:
            return
        start = nearest


def _relaxed(stage: GradientStage, point: Point, worst: float, kappas: Mapping[str, float]) -> Ending:
    size = len(point)

    def function(x: Point) -> View | None:
        view = stage.at(x[:size], kappas)
        if view is None:
            return None
        return View(
            x[size],
            tuple(miss - x[size] for miss in view.misses),
            (0.0,) * size + (1.0,),
            tuple((*slopes, -1.0) for slopes in view.miss_slopes),
        )

    top = max(worst, 0.0) + 1.0
    return minimise(
        function,
        (*point, worst),
        (0.0,) * size + (min(0.0, worst),),
        (1.0,) * size + (top,),
        objective_tolerance=stage.tolerance / 10,
        variable_tolerance=stage.tolerance / 10,
        miss_tolerance=stage.room / 2,
    )


def approach_freely(stage: GradientStage, see: Any, start: Point, tolerance: float) -> None:
    """The same by COBYLA, without derivatives; ``see`` is point -> (loss, misses)."""
    size, worst = len(start), max(see(start)[1])
    span = max(worst, 0.0) + 1.0

    def function(u: Point) -> tuple[float, tuple[float, ...]]:
        level = u[size] * span
        return level, tuple(miss - level for miss in see(u[:size])[1])

    ending = minimise_freely(
        "COBYLA",
        function,
        len(stage.slopes.held),
        (*start, min(max(worst / span, 0.0), 1.0)),
        step=0.1,
        objective_tolerance=tolerance / 10,
        variable_tolerance=tolerance,
        seed=1,
        calls=2000,
    )
    if ending.stopped_by is not None:
        raise ending.stopped_by


def conflict(slopes: Slopes, designs: Sequence[Candidate]) -> Conflict | None:
    """What keeps the least infeasible of these designs from being feasible; None where one is feasible or none sound.

    Without derivatives, and where the search ended before the least infeasible design, the conflict is all that this
    design misses.
    """
    nearest = min(designs, key=violation, default=None)
    worst = math.inf if nearest is None else violation(nearest)
    if nearest is None or math.isinf(worst) or worst == 0:
        return None
    weighed = _weighed(slopes, nearest, worst)
    if weighed is None or weighed[1] > STATIONARY:
        missed = [_clash(item) for item in nearest.checks if not item.satisfied]
        return Conflict(nearest.values, worst, tuple(sorted(missed, key=lambda clash: -clash.relative)))
    return Conflict(nearest.values, worst, tuple(sorted(weighed[0], key=_heaviest)), settled=True)


def describe(base: Spec, found: Conflict) -> str:
    """The conflict in sentences."""
    if not found.settled or not found.clashes:
        return ""
    names = [
        f"{clash.subject} {clash.sense} {show_limit(base, Limit(clash.subject, clash.sense, clash.limit))}"
        for clash in found.clashes
    ]
    if len(names) == 1:
        return f" {names[0]} cannot be met around this design, whatever the other limits."
    return f" In conflict are {_listed(names)}: around this design, none is missed by less unless another gives way."


def _weighed(slopes: Slopes, made: Candidate, worst: float) -> tuple[list[Clash], float] | None:
    """The clashes by their multipliers, and the residual that these leave."""
    import numpy as np
    from scipy.optimize import nnls

    view = slopes.own_view(made)
    if view is None or not slopes.box.keys:
        return None
    x = np.asarray(slopes.box.point(made.values))
    size, count = len(x), len(view.misses)
    sides = np.vstack([np.reshape(view.miss_slopes, (count, size)), -np.eye(size), np.eye(size)])
    # The slopes' own size decides between rows: a conflict is one of directions.
    room = np.concatenate([(worst - np.asarray(view.misses)) / worst, x, 1 - x])
    size_of = float(np.abs(sides[:count]).max()) or 1.0
    one = np.concatenate([np.ones(count), np.zeros(2 * size)])
    touching = np.flatnonzero(room <= TOUCHING)
    matrix = np.vstack([sides.T / size_of, np.diag(room), 1e3 * one])[:, touching]
    weights, _ = nnls(matrix, np.concatenate([np.zeros(size + len(room)), [1e3]]))
    left = float(np.abs(matrix[:-1] @ weights).max())
    found = np.zeros(len(room))
    found[touching] = weights
    checks = {item.limit: item for item in made.checks}
    clashes = [
        _clash(checks[limit], weight, worst)
        for limit, weight in zip(slopes.held, found, strict=False)
        if weight > NEGLIGIBLE
    ]
    for j in range(size):
        for sense, weight in ((">=", found[count + j]), ("<=", found[count + size + j])):
            if weight > NEGLIGIBLE * size_of:
                clashes.append(_bound(slopes.box, made, j, sense, float(weight), worst))
    return clashes, left


def _clash(item: Check, weight: float | None = None, worst: float = 0.0) -> Clash:
    limit, size = item.limit, item.limit.size
    relative = max(-item.margin, 0.0) if item.margin is not None else math.inf
    alone = None if weight is None or worst > weight else worst * size / float(weight)
    value = math.nan if item.value is None else item.value
    return Clash(
        limit.subject,
        limit.sense,
        limit.limit,
        value,
        relative * size,
        relative,
        None if weight is None else float(weight),
        alone,
        scale=limit.scale,
    )


def _bound(box: Box, made: Candidate, j: int, sense: str, weight: float, worst: float) -> Clash:
    key, span = box.keys[j], box.upper[j] - box.lower[j]
    limit = (box.lower if sense == ">=" else box.upper)[j]
    alone = None if worst > weight else worst * span / weight
    return Clash(key, sense, limit, made.values[key], 0.0, 0.0, weight, alone, bound=True)


def _heaviest(clash: Clash) -> float:
    return -(clash.weight or 0.0)


def _listed(words: Sequence[str]) -> str:
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))
