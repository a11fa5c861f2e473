"""The points of one front: how each is looked for, and what was found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from fluxbore.design.study import Pareto, Search
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.pareto_lanes import Ask
from fluxbore.optimize.pareto_point import Found, PointSearch, choose, nearest
from fluxbore.optimize.pareto_result import FrontPoint
from fluxbore.optimize.pareto_scalar import Row, Scalarisation, Scale, best_of, boundary_intersection
from fluxbore.optimize.pareto_sight import Sight
from fluxbore.optimize.pareto_slope import met_at
from fluxbore.optimize.pareto_standing import jumps, with_standing
from fluxbore.optimize.problem import Point

END_WEIGHT = 1e3
"""Weight of an end's own objective against the other one, which then decides between designs that share the best."""

Task = tuple[float, Point]
"""A position and the scaled point from which to look for its design."""

_NOT_REACHED = "The run ended before this point."


@dataclass(slots=True)
class Points:
    """The points by their position: the problem that stands for each, and what its search found.

    algorithm : NLopt's, one with gradients where the sight has them, else COBYLA.
    sight : how designs are seen, in the figures' own units at first and scaled to the front's ends after these.
    """

    pareto: Pareto
    search: Search
    algorithm: str
    archive: Archive
    sight: Sight
    problems: dict[float, Scalarisation] = field(default_factory=dict)
    found: dict[float, Found] = field(default_factory=dict)
    tried: set[Task] = field(default_factory=set)

    def listed(self) -> tuple[FrontPoint, ...]:
        """The points in their order along the front, each with its standing."""
        for position in self.problems:
            self.found.setdefault(position, Found(None, None, _NOT_REACHED, 0))
        made = [self._point(position, found) for position, found in sorted(self.found.items())]
        return with_standing(made, self.sight.scale, self.search.relative_tolerance)

    def design(self, position: float) -> Candidate | None:
        found = self.found.get(position)
        return None if found is None else found.design

    def solve(self, position: float, ask: Ask, problem: Scalarisation, start: Point | None, step: float) -> Found:
        """Search for one point and keep what is found; without a start, from the archive's nearest design."""
        before = self.found.get(position)
        spent = 0 if before is None else before.designs
        search = PointSearch(
            problem=problem,
            algorithm=self.algorithm,
            sight=self.sight,
            archive=self.archive,
            budget=self.search.max_evaluations,
            tolerance=self.search.relative_tolerance,
            seed=self.search.seed,
            asked=spent,
        )
        found = search.run(ask, self._nearest(problem) if start is None else start, step)
        if found.design is None and before is not None and before.design is not None:
            found = replace(before, designs=found.designs)
        self.problems[position] = problem
        self.found[position] = found
        return found

    def set_inner(self) -> list[float]:
        """State the problems between the ends; returns their positions."""
        count = self.pareto.points
        inner = [i / (count - 1) for i in range(1, count - 1)]
        epsilon = self.pareto.method == "epsilon constraint"
        self.problems |= {p: best_of(0, 1.0 - p) if epsilon else boundary_intersection(p) for p in inner}
        return inner

    def scale_to_ends(self) -> tuple[float, float]:
        """From here on both losses run from 0 to 1 between the ends; returns the worse end's figure of each (SI)."""
        scale, (one, other) = self.sight.scale, (self._end_figures(end) for end in (0.0, 1.0))
        s_u, s_v = scale.signs
        origin = (s_u * one[0], s_v * other[1])
        span = (s_u * other[0] - origin[0], s_v * one[1] - origin[1])
        self.sight = replace(self.sight, scale=Scale(scale.objectives, origin, span))
        self.judge_ends()
        return other[0], one[1]

    def judge_ends(self) -> None:
        """The optimality conditions of the ends: the best of the other objective, none given up of the end's own."""
        for which in (0, 1):
            found = self.found[float(which)]
            losses = None if found.design is None else self.sight.scale.losses(found.design)
            if found.design is not None and losses is not None:
                met = met_at(best_of(1 - which, losses[which]), self.sight, found.design)
                self.found[float(which)] = replace(found, conditions=met)

    def shared_best(self) -> float | None:
        """The end that is the best in both objectives, to the search's tolerance; None where they conflict."""
        first, second = (self.sight.scale.scaled(self._end_figures(end)) for end in (0.0, 1.0))
        room = [self.search.relative_tolerance * max(abs(a), abs(b)) for a, b in zip(first, second, strict=True)]
        if second[0] - first[0] <= room[0]:
            return 1.0
        return 0.0 if first[1] - second[1] <= room[1] else None

    def leave_only(self, end: float) -> None:
        """The front is this one point: there is no slope along it."""
        found = self.found[end]
        met = None if found.conditions is None else replace(found.conditions, weights=(0.0, 0.0))
        self.found, self.problems = {end: replace(found, conditions=met)}, {}

    def ahead(self, behind: Sequence[float], position: float) -> Point | None:
        """The scaled point where the straight line through the two designs behind arrives at this position."""
        designs = [design for p in behind if (design := self.design(p)) is not None]
        points = [self.archive.box.point(design.values) for design in designs]
        if len(points) < 2:
            return points[0] if points else None
        share = (position - behind[0]) / (behind[0] - behind[1])
        return self.archive.box.tidy([x + share * (x - y) for x, y in zip(*points, strict=True)])

    def wanting(self) -> list[Task]:
        """The points to solve again, with a start: something better is known, one is not settled, fell on another's
        design or stands beside a jump. No start is tried twice.

        They begin at the best that is known, or else between the neighbours that are on the front.
        """
        listed = self.listed()
        on_front = [point.position for point in listed if point.standing == "front"]
        again: list[Task] = []
        for position, found in sorted(self.found.items()):
            problem = self.problems[position]
            seen = choose(problem, self.sight, self.archive, self.search.relative_tolerance)
            if found.design is None or (seen is not None and self._gain(problem, found.design, seen) > 0):
                again.append((position, self._nearest(problem)))
            elif not self._settled(found):
                again.append((position, self.archive.box.point(found.design.values)))
            elif position not in on_front and 0.0 < position < 1.0:
                below, above = ([p for p in on_front if (p < position) is side] for side in (True, False))
                between = self.ahead([max(below), min(above)], position) if below and above else None
                again.append((position, between or self._nearest(problem)))
        for sides in jumps(listed):
            middle = self.ahead(sides, sum(sides) / 2)
            again += [(side, middle) for side in sides if 0.0 < side < 1.0 and middle is not None]
        fresh = [task for task in dict.fromkeys(again) if task not in self.tried]
        self.tried.update(fresh)
        return fresh

    def _nearest(self, problem: Scalarisation) -> Point:
        """The design of the archive from which to begin, or the middle of the box."""
        made = nearest(problem, self.sight, self.archive)
        return (0.5,) * len(self.archive.box.keys) if made is None else self.archive.box.point(made.values)

    def _gain(self, problem: Scalarisation, one: Candidate, other: Candidate) -> float:
        """How much less the other design loses, beyond the tolerance."""
        losses = [self.sight.scale.losses(design) for design in (one, other)]
        first, second = (problem.score(*pair)[1] for pair in losses if pair is not None)
        return (first - second) / max(1.0, problem.loss.first, problem.loss.second) - 2 * self.search.relative_tolerance

    def _settled(self, found: Found) -> bool:
        """Whether the optimality conditions are met, as far as they are known."""
        return found.conditions is None or found.conditions.settled(self.search.relative_tolerance)

    def _end_figures(self, end: float) -> tuple[float, float]:
        design = self.found[end].design
        figures = None if design is None else self.sight.scale.figures(design)
        assert figures is not None
        return figures

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


def favouring(which: int) -> Scalarisation:
    """One loss with the other one a little beside it."""
    return Scalarisation(Row(END_WEIGHT, 1.0) if which == 0 else Row(1.0, END_WEIGHT))
