"""The front's points one after the other: both ends, the points between them, a second look, and their standing."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from fluxbore.design.errors import FluxboreError
from fluxbore.design.study import Pareto, Search
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.evaluator import Evaluated
from fluxbore.optimize.outcome import Candidate, SearchEnding
from fluxbore.optimize.pareto_lanes import Ask, Job, side_by_side
from fluxbore.optimize.pareto_point import RESIDUAL, Found, PointSearch, choose, nearest
from fluxbore.optimize.pareto_result import FrontPoint
from fluxbore.optimize.pareto_scalar import Row, Scalarisation, Scale, best_of, boundary_intersection
from fluxbore.optimize.pareto_sight import Sight
from fluxbore.optimize.pareto_slope import met_at
from fluxbore.optimize.pareto_standing import hypervolume, with_standing
from fluxbore.optimize.problem import Point

FIRST_STEP = 0.1
"""First step of COBYLA at the ends, of each variable's range; between them it is smaller."""

_NOT_REACHED = "The run ended before this point."


END_WEIGHT = 1e3
"""Weight of an end's own objective against the other one, which then decides between designs that share the best."""


class _TimeUpError(Exception):
    """The study's time limit is over."""


@dataclass(slots=True)
class Front:
    """One front over its archive. `run` fills what stands below ``deadline``.

    sight : how designs are seen, in the figures' own units at first and scaled to the front's ends after these.
    deadline : on the monotonic clock, or None.
    """

    pareto: Pareto
    search: Search
    archive: Archive
    sight: Sight
    deadline: float | None
    reason: str = ""
    ending: SearchEnding = "done"
    conflicting: bool = True
    reference: tuple[float, float] | None = None
    hypervolume: float | None = None
    _problems: dict[float, Scalarisation] = field(default_factory=dict)
    _found: dict[float, Found] = field(default_factory=dict)

    @property
    def points(self) -> tuple[FrontPoint, ...]:
        """The points in their order along the front, each with its standing."""
        made = [self._point(position, found) for position, found in sorted(self._found.items())]
        return with_standing(made, self.sight.scale, self.search.relative_tolerance)

    def run(self, first: Sequence[Mapping[str, float]], done: Sequence[Evaluated]) -> None:
        """Run every stage and say in ``reason`` why the front ended."""
        try:
            for values, item in zip(first, done, strict=True):
                self.archive.adopt(values, item.evaluation, item.reused)
            self.reason = self._stages()
        except KeyboardInterrupt:
            self.ending, self.reason = "interrupted", "The front was interrupted."
        except _TimeUpError:
            self.reason = f"The front reached its time limit of {self.search.time_limit:g} s."
        except Exception as error:
            self.ending = "failed"
            self.reason = (
                str(error)
                if isinstance(error, FluxboreError)
                else f"The front failed with {type(error).__name__}: {error}."
            )
        for position in self._problems:
            self._found.setdefault(position, Found(None, None, _NOT_REACHED, 0))
        if self.reference is not None:
            self.hypervolume = hypervolume(self.points, self.sight.scale)

    def _stages(self) -> str:
        self._ends()
        one, other = (self._found[end].design for end in (0.0, 1.0))
        if one is None and other is None:
            return f"No design of the front is feasible. {self._found[0.0].reason}"
        if one is None or other is None:
            return f"The front has one end only. {self._found[1.0 if other is None else 0.0].reason}"
        alone = self._without_conflict(one, other)
        if alone is not None:
            self.conflicting = False
            self._found, self._problems = {alone: self._found[alone]}, {}
            return "The objectives do not conflict: one design is the best in both, and the front is that one point."
        self._scale_to(one, other)
        count = self.pareto.points
        inner = [i / (count - 1) for i in range(1, count - 1)]
        for position in inner:
            self._problems[position] = self._problem(position)
        half = (len(inner) + 1) // 2
        self._serve([self._walk([0.0, *inner[:half]]), self._walk([1.0, *reversed(inner[half:])])])
        self._look_again([0.0, *inner, 1.0])
        return self._summary()

    # The ends.

    def _ends(self) -> None:
        """The best of each objective side by side; then, where one lane found nothing, from the other's design."""
        scales = [self._unit(which) for which in (0, 1)]
        self.sight = replace(self.sight, scale=replace(self.sight.scale, span=(scales[0], scales[1])))
        self._problems = {0.0: best_of(0), 1.0: best_of(1)}
        self._serve([self._end(0), self._end(1)])
        lost = [which for which in (0, 1) if self._found[float(which)].design is None]
        if len(lost) == 1:
            self._serve([self._end(lost[0])])

    def _end(self, which: int) -> Job:
        """The best of one objective, and of all designs that share it the best of the other one.

        Without the second step an end of the front could be dominated: where the first objective leaves a variable
        free, any value of that is as good to it.
        """

        def job(ask: Ask) -> None:
            position = float(which)
            found = self._solve(position, ask, best_of(which), None, FIRST_STEP)
            if found.design is None:
                return
            self._solve(position, ask, _favouring(which), self.archive.box.point(found.design.values), FIRST_STEP / 10)

        return job

    def _unit(self, which: int) -> float:
        """A figure's size (SI), from the first design that has it."""
        for design in self.archive.history:
            figures = self.sight.scale.figures(design)
            if figures is not None and figures[which]:
                return abs(figures[which])
        return 1.0

    def _without_conflict(self, one: Candidate, other: Candidate) -> float | None:
        """The end that is the best in both objectives, to the search's tolerance; None where they conflict."""
        first, second = (self.sight.scale.losses(design) for design in (one, other))
        assert first is not None
        assert second is not None
        room = [self.search.relative_tolerance * max(abs(a), abs(b)) for a, b in zip(first, second, strict=True)]
        if second[0] - first[0] <= room[0]:
            return 1.0
        return 0.0 if first[1] - second[1] <= room[1] else None

    def _scale_to(self, one: Candidate, other: Candidate) -> None:
        """From here on both losses run from 0 to 1 between the ends."""
        scale = self.sight.scale
        figures, others = scale.figures(one), scale.figures(other)
        assert figures is not None
        assert others is not None
        s_u, s_v = scale.signs
        origin = (s_u * figures[0], s_v * others[1])
        span = (s_u * others[0] - origin[0], s_v * figures[1] - origin[1])
        self.sight = replace(self.sight, scale=Scale(scale.objectives, origin, span))
        self.reference = (others[0], figures[1])
        for end, problem, design in ((0.0, best_of(1, 0.0), one), (1.0, best_of(0, 0.0), other)):
            met = met_at(problem, self.sight, design)
            self._found[end] = replace(self._found[end], conditions=met)

    # Between the ends.

    def _problem(self, position: float) -> Scalarisation:
        if self.pareto.method == "epsilon constraint":
            return best_of(0, 1.0 - position)
        return boundary_intersection(position)

    def _walk(self, positions: Sequence[float]) -> Job:
        """From an end inwards, each point from where the latest two lead to."""

        def job(ask: Ask) -> None:
            for position in positions[1:]:
                behind = [p for p in positions if p != position and self._design(p) is not None]
                behind = sorted(behind, key=lambda p: abs(p - position))[:2]
                self._solve(position, ask, self._problems[position], self._ahead(behind, position), self._step())

        return job

    def _ahead(self, behind: Sequence[float], position: float) -> Point | None:
        """The scaled point where the straight line through the two designs behind arrives at this position."""
        designs = [design for p in behind if (design := self._design(p)) is not None]
        points = [self.archive.box.point(design.values) for design in designs]
        if len(points) < 2:
            return points[0] if points else None
        share = (position - behind[0]) / (behind[0] - behind[1])
        return self.archive.box.tidy([x + share * (x - y) for x, y in zip(*points, strict=True)])

    def _look_again(self, positions: Sequence[float]) -> None:
        """Solve a point again where something better is known, it is not settled, or it fell on another one's design.

        From the best that is known, or else from between the neighbours that are on the front.
        """
        self._problems |= {0.0: best_of(0), 1.0: best_of(1)}
        on_front = [point.position for point in self.points if point.standing == "front"]
        again: list[tuple[float, Point | None]] = []
        for position in positions:
            problem, found = self._problems[position], self._found[position]
            seen = choose(problem, self.sight, self.archive, self.search.relative_tolerance)
            if found.design is None or (seen is not None and self._gain(problem, found.design, seen) > 0):
                again.append((position, None))
            elif not self._settled(found):
                again.append((position, self.archive.box.point(found.design.values)))
            elif position not in on_front and 0.0 < position < 1.0:
                again.append((position, self._between(on_front, position)))
        self._serve([self._again(again[lane::2]) for lane in (0, 1)])

    def _settled(self, found: Found) -> bool:
        """Whether the optimality conditions are met, as far as they are known."""
        return found.conditions is None or found.conditions.residual <= RESIDUAL * self.search.relative_tolerance

    def _between(self, on_front: Sequence[float], position: float) -> Point | None:
        """The scaled point where the line between the designs on either side passes this position."""
        below = [p for p in on_front if p < position]
        above = [p for p in on_front if p > position]
        return self._ahead([max(below), min(above)], position) if below and above else None

    def _again(self, tasks: Sequence[tuple[float, Point | None]]) -> Job:
        def job(ask: Ask) -> None:
            for position, start in tasks:
                self._solve(position, ask, self._problems[position], start, self._step())

        return job

    def _gain(self, problem: Scalarisation, one: Candidate, other: Candidate) -> float:
        """How much less the other design loses, beyond the tolerance."""
        losses = [self.sight.scale.losses(design) for design in (one, other)]
        first, second = (problem.score(*pair)[1] for pair in losses if pair is not None)
        return first - second - 2 * self.search.relative_tolerance

    # One point.

    def _solve(self, position: float, ask: Ask, problem: Scalarisation, start: Point | None, step: float) -> Found:
        """Search for one point and keep what is found; without a start, from the archive's nearest design."""
        before = self._found.get(position)
        spent = 0 if before is None else before.designs
        search = PointSearch(
            problem=problem,
            sight=self.sight,
            archive=self.archive,
            budget=self.search.max_evaluations,
            tolerance=self.search.relative_tolerance,
            seed=self.search.seed,
            asked=spent,
        )
        if start is None:
            made = nearest(problem, self.sight, self.archive)
            start = (0.5,) * len(self.archive.box.keys) if made is None else self.archive.box.point(made.values)
        found = search.run(ask, start, step)
        if found.design is None and before is not None and before.design is not None:
            found = replace(before, designs=found.designs)
        self._problems[position] = problem
        self._found[position] = found
        return found

    def _step(self) -> float:
        return max(FIRST_STEP / (self.pareto.points - 1), 1e-3)

    def _design(self, position: float) -> Candidate | None:
        found = self._found.get(position)
        return None if found is None else found.design

    def _serve(self, jobs: Sequence[Job]) -> None:
        side_by_side(jobs, self._evaluate)

    def _evaluate(self, points: Sequence[Point]) -> list[Candidate]:
        """A batch of the lanes; raises `_TimeUpError` where a fresh design would begin after the deadline."""
        box = self.archive.box
        fresh = [point for point in dict.fromkeys(points) if not self.archive.knows(point)]
        if fresh and self.deadline is not None and time.monotonic() >= self.deadline:
            raise _TimeUpError
        if fresh:
            self.archive.evaluate([box.values(point) for point in fresh])
        return [self.archive.at(point) for point in points]

    def _point(self, position: float, found: Found) -> FrontPoint:
        scale = self.sight.scale
        figures = None if found.design is None else scale.figures(found.design)
        inner = 0.0 < position < 1.0 and self.pareto.method == "epsilon constraint"
        return FrontPoint(
            position=position,
            limit=scale.figure(1, 1.0 - position) if inner else None,
            design=found.design,
            first=None if figures is None else figures[0],
            second=None if figures is None else figures[1],
            standing="front" if figures is not None else "failed",
            reason=found.reason,
            residual=None if found.conditions is None else found.conditions.residual,
            slope=None if found.conditions is None else found.conditions.slope(scale),
            designs=found.designs,
        )

    def _summary(self) -> str:
        standings = [point.standing for point in self.points]
        words = [
            f"{standings.count(standing)} {'is' if standings.count(standing) == 1 else 'are'} {said}"
            for standing, said in (
                ("dominated", "dominated by others"),
                ("repeated", "found twice"),
                ("failed", "without a feasible design"),
            )
            if standing in standings
        ]
        end = f"The front has {standings.count('front')} of the {len(standings)} points asked for"
        return f"{end}; {', '.join(words)}." if words else f"{end}."


def _favouring(which: int) -> Scalarisation:
    """One loss with the other one a little beside it."""
    return Scalarisation(Row(END_WEIGHT, 1.0) if which == 0 else Row(1.0, END_WEIGHT))
