"""The gradient stages of a search: rounds of NLopt's run until maxima, norms and first-order conditions agree."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from fluxbore.design.errors import FluxboreError
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.gradient_search import NO_START, View, minimise
from fluxbore.optimize.nlopt_loop import Ending
from fluxbore.optimize.optimality import multipliers
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.problem import Point
from fluxbore.optimize.slopes import NoSlopesError, Slopes

BESIDE = (1e-3, 1e-2)
"""Of a variable's range: how far from a design without derivatives a neighbour lends it its own; the first at which
there is a sound one, for a part may be too thin to be made or meshed before it vanishes."""

ROUNDS = 8
"""Runs of NLopt, each from where the one before ended; designs seen before cost nothing."""


@dataclass(slots=True)
class GradientStage:
    """Gradient searches over an archive.

    room : to leave to the limits (relative). tolerance : relative, of the objective.
    failed : designs without figures that the searches met. ended : the point at which the latest search ended.
    ran : the algorithms of the latest search, in order. gave_up : whether its last run ended with a failure of NLopt.
    """

    archive: Archive
    slopes: Slopes
    room: float
    tolerance: float
    failed: int = 0
    ended: Point = ()
    ran: list[str] = field(default_factory=list)
    gave_up: bool = False
    _seen: dict[Point, View] = field(default_factory=dict)

    def run(self, algorithm: str, start: Candidate) -> str:
        """Search from ``start`` until it is settled; returns why it ended, a sentence.

        Settled: maximum / norm is the same before and after a round, and the first-order conditions hold or a round has
        gained nothing. Raises what stopped a run from within, NoSlopesError among it.
        """
        self.ended, self.ran, self.gave_up = self.archive.box.point(start.values), [], False
        reason = self._rounds(algorithm)
        if algorithm == "SLSQP" or reason == NO_START or self.first_order(self.ended):
            return reason
        # From outside a limit they can stall far from any optimum; there SLSQP has a step to offer.
        more = self._rounds("SLSQP")
        return f"{algorithm} stopped where the first-order conditions do not hold; SLSQP went on from there. {more}"

    def _rounds(self, algorithm: str) -> str:
        reason = NO_START
        for _ in range(ROUNDS):
            point = self.ended
            kappas = self.slopes.kappas(self.archive.at(point))
            ending = self._round(algorithm, point, kappas)
            if self._seen and algorithm not in self.ran:
                self.ran.append(algorithm)
            if ending.stopped_by is not None:
                raise ending.stopped_by
            self.gave_up = ending.failed
            if ending.reason == NO_START:
                break
            reason = ending.reason
            found = self._best(kappas)
            if found is None:
                break
            before, after = self._rank(point, kappas), self._rank(found, kappas)
            gained = before[1] - after[1] if before[0] <= after[0] else math.inf
            self.ended = found
            still = found == point or gained <= self.tolerance / 10
            if self.settled(kappas, found) and (still or self.first_order(found)):
                break
        return reason

    def _round(self, algorithm: str, point: Point, kappas: Mapping[str, float]) -> Ending:
        self._seen = {}

        def function(x: Point) -> View | None:
            view = self.at(x, kappas)
            if view is not None:
                self._seen[self.archive.box.tidy(x)] = view
            return view

        size = len(point)
        return minimise(
            function,
            point,
            (0.0,) * size,
            (1.0,) * size,
            algorithm=algorithm,
            objective_tolerance=self.tolerance / 10,
            variable_tolerance=self.tolerance,
            miss_tolerance=self.room / 2,
            asked_tolerance=self.tolerance,
        )

    def at(self, x: Point, kappas: Mapping[str, float]) -> View | None:
        """What NLopt sees at a scaled point: the design's view with ``room`` left to the limits."""
        known = self.archive.knows(x)
        view = self._view(x, kappas)
        if view is None:
            self.failed += not known
            return None
        return View(view.loss, tuple(miss + self.room for miss in view.misses), view.slope, view.miss_slopes)

    def _view(self, x: Point, kappas: Mapping[str, float]) -> View | None:
        """The design's view; where an interval vanishes and takes derivatives with it, with those of a neighbour.

        At a ring of no width the section has fewer parts, and nothing says what a width would do; a thousandth of the
        range away something does. None where there is no such neighbour. NoSlopesError where it has none either.
        """
        made = self.archive.at(x)
        try:
            return self.slopes.view(made, kappas)
        except NoSlopesError as error:
            points = self._beside(x, error.keys)
            if not points:
                raise
            beside = self._first_sound(points)
            return None if beside is None else self.slopes.view(made, kappas, beside)

    def lender(self, made: Candidate) -> Candidate | None:
        """The neighbour whose derivatives stood in for this design's; None where it has its own or there is none."""
        try:
            self.slopes.view(made, self.slopes.kappas(made))
        except NoSlopesError as error:
            points = self._beside(self.archive.box.point(made.values), error.keys)
            return self._first_sound(point for point in points if self.archive.knows(point))
        return None

    def _first_sound(self, points: Iterable[Point]) -> Candidate | None:
        for point in points:
            made = self.archive.at(point)
            if made.evaluation.ok:
                return made
        return None

    def _beside(self, x: Point, keys: Sequence[str]) -> list[Point]:
        """The points a little nearer to the middle of these variables' ranges at which something can be built."""
        box, found = self.archive.box, []
        for step in BESIDE if keys else ():
            moved = box.tidy(
                [
                    value if key not in keys else value + (step if value <= 0.5 else -step)
                    for key, value in zip(box.keys, x, strict=True)
                ]
            )
            with contextlib.suppress(FluxboreError):
                self.archive.design(box.values(moved))
                found.append(moved)
        return found

    def settled(self, kappas: Mapping[str, float], point: Point) -> bool:
        """Whether maximum / norm at the point is what the round took it for."""
        now = self.slopes.kappas(self.archive.at(point))
        return now.keys() == kappas.keys() and all(abs(now[k] / kappas[k] - 1) <= self.room / 2 for k in now)

    def first_order(self, point: Point) -> bool:
        """Whether the first-order conditions hold there."""
        view = self._view(point, self.slopes.kappas(self.archive.at(point)))
        return view is not None and multipliers(view, point)[1] <= 10 * self.tolerance

    def _best(self, kappas: Mapping[str, float]) -> Point | None:
        """The best point of the latest round, as the round saw it; the maxima are looked at afterwards."""
        return min(self._seen, key=lambda point: self._rank(point, kappas), default=None)

    def _rank(self, point: Point, kappas: Mapping[str, float]) -> tuple[float, float]:
        """The smaller the better: the worst miss first, then the loss."""
        view = self._seen.get(point) or self.at(point, kappas)
        if view is None:
            return math.inf, math.inf
        return max([0.0, *(miss - self.room / 2 for miss in view.misses)]), view.loss
