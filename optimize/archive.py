"""The designs that a search has asked for: its memory, its history and its incumbent."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence

from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.outcome import Candidate, Limit
from fluxbore.optimize.problem import Box, Point, better, candidate, check, numbers
from fluxbore.optimize.progress import Tracker


class BudgetUsedError(Exception):
    """The search asked for one design more than it may."""


class TimeUsedError(BudgetUsedError):
    """The search asked for one more design after its time limit."""


class Archive:
    """Every design that was asked for, each evaluated once.

    The best feasible design stands here from the moment it is evaluated, so whatever ends the search cannot lose it.

    fixed : values that every design has besides those of its point, such as the counts of one combination.
    deadline : of `time.monotonic`, after which no further design is begun.
    reserve : designs of the budget that are kept back as long as no design is feasible.
    """

    def __init__(
        self,
        evaluator: Evaluator,
        box: Box,
        objective: Objective,
        limits: Sequence[Limit],
        budget: int,
        tracker: Tracker | None = None,
        fixed: Mapping[str, Value] | None = None,
        deadline: float = math.inf,
    ) -> None:
        self._evaluator, self.box, self.objective, self.limits = evaluator, box, objective, tuple(limits)
        self.budget = budget
        self.fixed: dict[str, Value] = dict(fixed or {})
        self.deadline = deadline
        self.reserve = 0
        self._tracker = tracker
        self._memory: dict[Point, Candidate] = {}
        self.history: list[Candidate] = []
        self.best_so_far: list[int | None] = []
        self.reused = 0

    @property
    def best(self) -> Candidate | None:
        """The best feasible design so far."""
        index = self.best_so_far[-1] if self.best_so_far else None
        return None if index is None else self.history[index]

    @property
    def left(self) -> int:
        """How many designs may still be asked for; none after the deadline."""
        kept = self.reserve if self.best is None else 0
        return 0 if self.late else max(self.budget - kept - len(self.history), 0)

    @property
    def derives(self) -> bool:
        """Whether its designs are asked for derivatives."""
        return bool(self._evaluator.gradient)

    @property
    def late(self) -> bool:
        return time.monotonic() > self.deadline

    def design(self, made: Mapping[str, Value]) -> Spec:
        """The design of these values as a specification. Raises SpecError or DesignError where there is none."""
        return self._evaluator.design({**made, **self.fixed})

    @property
    def points(self) -> list[tuple[Point, Candidate]]:
        """Every design with its scaled point."""
        return list(self._memory.items())

    def knows(self, point: Point) -> bool:
        return self.box.tidy(point) in self._memory

    def at(self, point: Point) -> Candidate:
        """The design at a scaled point, from memory where it was asked for before. Raises BudgetUsedError."""
        tidy = self.box.tidy(point)
        if tidy not in self._memory:
            self._ask([tidy], [self.box.values(tidy)])
        return self._memory[tidy]

    def evaluate(self, designs: Sequence[Mapping[str, float]]) -> list[Candidate]:
        """Evaluate designs side by side and in this order; BudgetUsedError where one of them is beyond the budget.

        Their order in the history does not depend on which worker is the quickest: a search replays exactly.
        """
        return self._ask([self.box.point(values) for values in designs], designs)

    def _ask(self, points: Sequence[Point], designs: Sequence[Mapping[str, float]]) -> list[Candidate]:
        fresh: list[tuple[Point, Mapping[str, Value]]] = []
        for point, given in zip(points, designs, strict=True):
            known = self._memory.get(point)
            values: dict[str, Value] = {**given, **self.fixed}
            if (known is None or known.values != values) and (point, values) not in fresh:
                fresh.append((point, values))
        within = fresh[: self.left]
        for item in self._evaluator.all([values for _, values in within]):
            point, asked = within[item.index]
            self._keep(point, self._candidate(asked, item.evaluation), item.reused)
        if len(within) < len(fresh):
            raise TimeUsedError if self.late else BudgetUsedError
        return [self._memory[point] for point in points]

    def adopt(self, values: Mapping[str, float], evaluation: Evaluation, reused: bool) -> Candidate:
        """Take in a design of these values that was evaluated already."""
        made = self._candidate({**values, **self.fixed}, evaluation)
        self._keep(self.box.point(values), made, reused)
        return made

    def _candidate(self, values: Mapping[str, Value], evaluation: Evaluation) -> Candidate:
        try:
            spec = self._evaluator.design(values)
        except Exception:  # it cannot be built, which its evaluation says
            return Candidate(numbers(values), evaluation, None, check(self.limits, {}, evaluation.performance))
        return candidate(spec, self.objective, self.limits, (*self.box.keys, *self.fixed), evaluation)

    def _keep(self, point: Point, made: Candidate, reused: bool) -> None:
        self._memory[point] = made
        self.history.append(made)
        self.reused += reused
        best = self.best_so_far[-1] if self.best_so_far else None
        eligible = made.feasible and made.objective is not None and self.box.contains(made.values)
        if eligible and (best is None or better(made, self.history[best], self.objective)):
            best = len(self.history) - 1
        self.best_so_far.append(best)
        if self._tracker is not None:
            self._tracker.add(made.values, made.evaluation, reused=reused, eligible=eligible)
