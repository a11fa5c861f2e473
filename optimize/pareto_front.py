"""The front from end to end: both ends, the points between them, a second look."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from fluxbore.design.errors import FluxboreError
from fluxbore.optimize.evaluator import Evaluated
from fluxbore.optimize.outcome import Candidate, SearchEnding
from fluxbore.optimize.pareto_lanes import Ask, Job, side_by_side
from fluxbore.optimize.pareto_points import Points, Task, favouring
from fluxbore.optimize.pareto_scalar import best_of
from fluxbore.optimize.pareto_standing import hypervolume, summary
from fluxbore.optimize.problem import Point

FIRST_STEP = 0.1
"""First step of the searches at the ends, of each variable's range; between them it is smaller."""


LOOKS = 5
"""Further rounds over the points that leave something to be wished for."""

END_ROUNDS = 3
"""Searches for the ends, at the scale of the front that those before them found."""


class _TimeUpError(Exception):
    """The study's time limit is over."""


@dataclass(slots=True)
class Front:
    """One front. `run` fills ``points`` and what stands below ``deadline``.

    deadline : on the monotonic clock, or None.
    """

    points: Points
    deadline: float | None
    reason: str = ""
    ending: SearchEnding = "done"
    conflicting: bool = True
    reference: tuple[float, float] | None = None
    hypervolume: float | None = None

    def run(self, first: Sequence[Mapping[str, float]], done: Sequence[Evaluated]) -> None:
        """Run every stage and say in ``reason`` why the front ended."""
        try:
            for values, item in zip(first, done, strict=True):
                self.points.archive.adopt(values, item.evaluation, item.reused)
            self.reason = self._stages()
        except KeyboardInterrupt:
            self.ending, self.reason = "interrupted", "The front was interrupted."
        except _TimeUpError:
            self.reason = f"The front reached its time limit of {self.points.search.time_limit:g} s."
        except Exception as error:
            self.ending = "failed"
            known = isinstance(error, FluxboreError)
            self.reason = str(error) if known else f"The front failed with {type(error).__name__}: {error}."
        if self.reference is not None:
            self.hypervolume = hypervolume(self.points.listed(), self.points.sight.scale)

    def _stages(self) -> str:
        points = self.points
        self._ends()
        lost = [end for end in (0.0, 1.0) if points.design(end) is None]
        if lost:
            what = "No design of the front is feasible." if len(lost) == 2 else "The front has one end only."
            return f"{what} {points.found[lost[0]].reason}"
        alone = points.shared_best()
        if alone is not None:
            self.conflicting = False
            points.leave_only(alone)
            return "The objectives do not conflict: one design is the best in both, and the front is that one point."
        self._settle_ends()
        inner = points.set_inner()
        half = (len(inner) + 1) // 2
        self._serve([self._walk([0.0, *inner[:half]]), self._walk([1.0, *reversed(inner[half:])])])
        for _ in range(LOOKS):
            again = points.wanting()
            if not again:
                break
            self._serve([self._again(again[lane::2]) for lane in (0, 1)])
        points.judge_ends()
        return summary(points.listed())

    def _ends(self) -> None:
        """The best of each objective side by side; then, where one lane found nothing, from the other's design."""
        points = self.points
        spans = self._size(0), self._size(1)
        points.sight = replace(points.sight, scale=replace(points.sight.scale, span=spans))
        points.problems = {0.0: best_of(0), 1.0: best_of(1)}
        self._serve([self._end(0), self._end(1)])
        lost = [which for which in (0, 1) if points.design(float(which)) is None]
        if len(lost) == 1:
            self._serve([self._end(lost[0])])

    def _settle_ends(self) -> None:
        """Scale to the ends; where that shows that an end's search stopped short of it, search and scale again.

        What an end is missing shifts all points: their limits are shares of the way from end to end.
        """
        points = self.points
        for _ in range(END_ROUNDS):
            self.reference = points.scale_to_ends()
            short = points.wanting()
            before = len(points.archive.history)
            self._serve([self._again([task]) for task in short])
            if len(points.archive.history) == before:
                return
        self.reference = points.scale_to_ends()

    def _end(self, which: int) -> Job:
        """The best of one objective, and of all designs that share it the best of the other one.

        Without the second step an end of the front could be dominated: where the first objective leaves a variable
        free, any value of that is as good to it.
        """
        points = self.points

        def job(ask: Ask) -> None:
            found = points.solve(float(which), ask, best_of(which), None, FIRST_STEP)
            if found.design is not None:
                start = points.archive.box.point(found.design.values)
                points.solve(float(which), ask, favouring(which), start, FIRST_STEP / 10)

        return job

    def _size(self, which: int) -> float:
        """A figure's size (SI), from the first design that has it."""
        for design in self.points.archive.history:
            figures = self.points.sight.scale.figures(design)
            if figures is not None and figures[which]:
                return abs(figures[which])
        return 1.0

    def _walk(self, positions: Sequence[float]) -> Job:
        """From an end inwards, each point from where the latest two lead to."""
        points = self.points

        def job(ask: Ask) -> None:
            for position in positions[1:]:
                behind = [p for p in positions if p != position and points.design(p) is not None]
                behind = sorted(behind, key=lambda p: abs(p - position))[:2]
                points.solve(position, ask, points.problems[position], points.ahead(behind, position), self._step())

        return job

    def _again(self, tasks: Sequence[Task]) -> Job:
        def job(ask: Ask) -> None:
            for position, start in tasks:
                self.points.solve(position, ask, self.points.problems[position], start, self._step())

        return job

    def _step(self) -> float:
        return max(FIRST_STEP / (self.points.pareto.points - 1), 1e-3)

    def _serve(self, jobs: Sequence[Job]) -> None:
        side_by_side(jobs, self._evaluate)

    def _evaluate(self, asked: Sequence[Point]) -> list[Candidate]:
        """A batch of the lanes; raises `_TimeUpError` where a fresh design would begin after the deadline."""
        archive = self.points.archive
        fresh = [point for point in dict.fromkeys(asked) if not archive.knows(point)]
        if fresh and self.deadline is not None and time.monotonic() >= self.deadline:
            raise _TimeUpError
        if fresh:
            archive.evaluate([archive.box.values(point) for point in fresh])
        return [archive.at(point) for point in asked]
