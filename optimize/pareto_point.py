"""The search for one point of a front, over the archive that all its points share."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from fluxbore.optimize import gradient_search, nlopt_loop
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.gradient_search import View
from fluxbore.optimize.nlopt_loop import Ending
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.pareto_lanes import Ask
from fluxbore.optimize.pareto_scalar import Scalarisation
from fluxbore.optimize.pareto_sight import Sight
from fluxbore.optimize.pareto_slope import Conditions, met_at
from fluxbore.optimize.problem import Point, show_limit, show_miss, violation
from fluxbore.optimize.slopes import NoSlopesError

CALLS = 1000
"""Points that one run of NLopt may ask for, repeated ones included."""

ROUNDS = 4
"""Runs of SLSQP for one point: it begins anew from the best design while that is not settled."""

_MISS = 10.0  # what a relative miss weighs against the loss, where a start is chosen
_STEEP = 100.0  # what a missed row weighs against the loss, where the best is chosen
_UNKNOWN = 1e3  # the miss of a design whose limits are not known
_LEAST_SHARE = 1e-3  # of the loss: less would leave no digits to an upright front


@dataclass(frozen=True, slots=True)
class Found:
    """What a search for one point ended with; ``design`` is None where nothing was feasible."""

    design: Candidate | None
    conditions: Conditions | None
    reason: str
    designs: int


class PointBudgetError(Exception):
    """The search for a point asked for one design more than it may."""


@dataclass(slots=True)
class PointSearch:
    """One problem with one objective, solved from several starts if need be.

    budget : designs that it may have evaluated; tolerance : of the scaled losses, and of the box.
    asked : how many were. reason : why the latest run stopped.
    """

    problem: Scalarisation
    algorithm: str
    sight: Sight
    archive: Archive
    budget: int
    tolerance: float
    seed: int
    asked: int = 0
    reason: str = ""

    def run(self, ask: Ask, start: Point, step: float) -> Found:
        """Search from a scaled point with a first step (of the box); what was found, whatever ended the search."""
        try:
            if self.sight.gradients:
                self._descend(ask, start, step)
            else:
                self._probe(ask, start, step)
        except PointBudgetError:
            self.reason = f"The search for this point used up its budget of {self.budget} designs."
        return self.found()

    def found(self) -> Found:
        """The best design of the archive for this problem, and its optimality conditions."""
        best = choose(self.problem, self.sight, self.archive, self.tolerance)
        met = None if best is None else met_at(self.problem, self.sight, best)
        return Found(best, met, self.reason if best is not None else self._shortfall(), self.asked)

    def _descend(self, ask: Ask, start: Point, step: float) -> None:
        """SLSQP, again from its best design until that is settled, its figures' maxima standing for their norms.

        Where a design lacks a derivative that the others have, COBYLA goes on.
        """
        point = self._sound(ask, start)
        try:
            for _ in range(ROUNDS):
                kappas, before = self.sight.kappas(self._ask(ask, point)), self.asked
                ending = self._slope_down(ask, point, step, kappas)
                self.reason = ending.reason
                if ending.stopped_by is not None:
                    raise ending.stopped_by
                best = choose(self.problem, self.sight, self.archive, self.tolerance)
                met = None if best is None else met_at(self.problem, self.sight, best)
                if best is None or self.asked == before or (met is not None and met.settled(self.tolerance)):
                    return
                point = self.archive.box.point(best.values)
        except NoSlopesError as error:
            self.sight = replace(self.sight, gradients=False)
            self._probe(ask, point, step)
            self.reason += f" A design without the derivatives of {error} was met, so COBYLA went on."

    def _sound(self, ask: Ask, start: Point) -> Point:
        """The start, or the best of the archive where the start has no figures."""
        if self.sight.scale.losses(self._ask(ask, start)) is not None:
            return start
        made = nearest(self.problem, self.sight, self.archive)
        return start if made is None else self.archive.box.point(made.values)

    def _slope_down(self, ask: Ask, start: Point, step: float, kappas: Mapping[str, float]) -> Ending:
        """One run of SLSQP.

        It begins as if the loss's curvature were 1, so that its first step is as long as the gradient. The loss is
        multiplied by what makes that ``step``: far longer steps cost designs, for the line search takes them back.
        """
        size = len(start)
        first = self.sight.see(self._ask(ask, start), kappas)
        if first is None:
            return Ending(gradient_search.NO_START)
        slack = self.problem.begin(first)
        length = math.hypot(*self.problem.view(first, slack).slope)
        share = 1.0 if self.problem.lifted else min(max(step / length, _LEAST_SHARE) if length else 1.0, 1.0)

        def function(z: Point) -> View | None:
            seen = self.sight.see(self._ask(ask, z[:size]), kappas)
            if seen is None:
                return None
            view = self.problem.view(seen, z[size:])
            # One more, so that the tolerance is one of the front's range where the loss itself is 0.
            return replace(view, loss=share * (1 + view.loss), slope=tuple(share * slope for slope in view.slope))

        lower, upper = (0.0,) * (size + len(slack)), (1.0,) * (size + len(slack))
        return gradient_search.minimise(
            function,
            (*start, *slack),
            lower,
            upper,
            algorithm=self.algorithm,
            objective_tolerance=self.tolerance / 100,
            variable_tolerance=self.tolerance / 10,
            miss_tolerance=self.tolerance / 100,
            calls=CALLS,
        )

    def _probe(self, ask: Ask, start: Point, step: float) -> None:
        """COBYLA, which needs no gradients.

        A design without figures is seen as worse than the worst sound one so far by one range of the objectives, and
        as missing every limit by all of it: finite, so that the algorithm's model survives it.
        """
        size, worst = len(start), 0.0

        def function(z: Point) -> tuple[float, tuple[float, ...]]:
            nonlocal worst
            seen = self.sight.see(self._ask(ask, z[:size]), {})
            if seen is None:
                return worst + 1.0, (1.0,) * constraints
            view = self.problem.view(seen, z[size:])
            worst = max(worst, view.loss)
            return view.loss, view.misses

        constraints = len(self.problem.rows) + len(self.sight.held)
        first = self.sight.see(self._ask(ask, start), {})
        ending = nlopt_loop.minimise(
            "COBYLA",
            function,
            constraints,
            (*start, *((0.5,) * self.problem.lifted if first is None else self.problem.begin(first))),
            step=step,
            objective_tolerance=self.tolerance / 10,
            variable_tolerance=self.tolerance,
            seed=self.seed,
            calls=20 * self.budget + CALLS,
        )
        self.reason = ending.reason
        if ending.stopped_by is not None:
            raise ending.stopped_by

    def _ask(self, ask: Ask, point: Point) -> Candidate:
        point = self.archive.box.tidy(point)
        if not self.archive.knows(point):
            if self.asked >= self.budget:
                raise PointBudgetError
            self.asked += 1
        return ask(point)

    def _shortfall(self) -> str:
        """Why there is no design: what the nearest one misses, and why the search stopped."""
        known = [(miss, made) for _, made in self.archive.points if not math.isinf(max(miss := self._miss(made)))]
        if not known:
            return f"No design for this point could be evaluated in full. {self.reason}".strip()
        (row, _), near = min(known, key=lambda item: max(item[0]))
        words = [
            f"{item.limit.subject} {item.limit.sense} {show_limit(self.sight.base, item.limit)} "
            f"by {show_miss(self.sight.base, item)}"
            for item in near.checks
            if not item.satisfied and item.margin is not None
        ]
        if row > self.tolerance:
            words.append(f"the bound on the other objective by {row:.2%} of the front's range")
        return f"No design met every limit; the nearest missed {' and '.join(words)}. {self.reason}".strip()

    def _miss(self, design: Candidate) -> tuple[float, float]:
        losses = self.sight.scale.losses(design)
        return (math.inf, math.inf) if losses is None else (self.problem.score(*losses)[0], violation(design))


def choose(problem: Scalarisation, sight: Sight, archive: Archive, tolerance: float) -> Candidate | None:
    """The feasible design of the archive that solves the problem best; rows may be missed by ``tolerance``.

    Such a miss weighs as much as it could gain on a steep front: else a design on the way, a little beyond the row,
    would be preferred to the one that the search ended at.
    """
    best: tuple[float, Candidate] | None = None
    for _, design in archive.points:
        losses = sight.scale.losses(design)
        if losses is None or not design.feasible:
            continue
        miss, loss = problem.score(*losses)
        if miss <= tolerance and (best is None or loss + _STEEP * miss < best[0]):
            best = (loss + _STEEP * miss, design)
    return None if best is None else best[1]


def nearest(problem: Scalarisation, sight: Sight, archive: Archive) -> Candidate | None:
    """The design of the archive from which to begin: little missed, little lost."""
    best: tuple[float, Candidate] | None = None
    for _, design in archive.points:
        losses = sight.scale.losses(design)
        if losses is None:
            continue
        miss, loss = problem.score(*losses)
        merit = loss + _MISS * (miss + min(violation(design), _UNKNOWN))
        if best is None or merit < best[0]:
            best = (merit, design)
    return None if best is None else best[1]
