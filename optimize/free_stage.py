"""The stage of a search without derivatives: a global algorithm, a local one after it, and the polishing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from fluxbore.design.study import Search
from fluxbore.optimize import nlopt_loop
from fluxbore.optimize.archive import Archive, BudgetUsedError
from fluxbore.optimize.outcome import Candidate, Limit
from fluxbore.optimize.polish import polish
from fluxbore.optimize.problem import Merit, Point

FIRST_STEP = 0.1
"""First step of the local searches, of each variable's range."""

GLOBAL_SHARE = 0.6
"""What a global algorithm gets of the budget; the rest is for the local search after it."""


@dataclass(slots=True)
class FreeStage:
    """Searches without derivatives over an archive.

    held : the limits that NLopt must hold. room : to leave to them (relative).
    ran : the algorithms of the latest search, in order. said : how far it went, in words.
    """

    archive: Archive
    search: Search
    merit: Merit
    held: Sequence[Limit]
    room: float
    ran: list[str] = field(default_factory=list)
    said: str = ""
    _penalties: dict[Point, float] = field(default_factory=dict)

    def run(self, algorithm: str, origin: Candidate) -> str:
        """Search from ``origin``; returns why it ended, sentences. Raises what stopped it from within."""
        archive, point = self.archive, self.archive.box.point(origin.values)
        self.ran, self.said = [], ""
        if algorithm in nlopt_loop.GLOBAL:
            self.ran.append(algorithm)
            self.said = f"{algorithm} looked at the whole range; then COBYLA looked around its best. "
            self._explore(algorithm, point)
            point = point if archive.best is None else archive.box.point(archive.best.values)
        local = "BOBYQA" if algorithm == "BOBYQA" and len(point) > 1 else "COBYLA"
        self.ran.append(local)
        self._prefetch(point, both=local == "BOBYQA")
        self.said += self._loop(local, point)
        polish(archive, self.merit, self.held, self.room, self.search.relative_tolerance / 10)
        return self.said

    def see(self, x: Point) -> tuple[float, tuple[float, ...]]:
        """What NLopt sees at a scaled point.

        A design without figures is seen as worse than the worst sound one so far by the objective's own size, and as
        missing every limit by all of it: finite, so that the algorithms' models survive it. The number stays within
        NLopt; the history has the design with its reason.
        """
        made = self.archive.at(x)
        loss = self.merit.loss(made)
        if loss is not None:
            return loss, tuple(miss + self.room for miss in self.merit.misses(made, self.held))
        point = self.archive.box.tidy(x)
        if point not in self._penalties:
            sound = [loss for design in self.archive.history if (loss := self.merit.loss(design)) is not None]
            self._penalties[point] = max(sound, default=0.0) + 1.0
        return self._penalties[point], (1.0,) * len(self.held)

    def _explore(self, algorithm: str, point: Point) -> None:
        """Let a global algorithm have its share of the budget; it finds the valley, a local one finds its floor."""
        archive, most = self.archive, self.archive.budget
        archive.budget = most - int((1 - GLOBAL_SHARE) * archive.left)
        try:
            self._loop(algorithm, point)
        except BudgetUsedError:
            pass
        finally:
            archive.budget = most

    def _loop(self, algorithm: str, point: Point) -> str:
        """One run of NLopt over the archive; returns why it ended. Raises what stopped it from within."""
        search = self.search
        ending = nlopt_loop.minimise(
            algorithm,
            self.see,
            len(self.held),
            point,
            step=FIRST_STEP,
            objective_tolerance=search.relative_tolerance,
            variable_tolerance=search.relative_tolerance * 10,
            seed=search.seed,
            calls=20 * search.max_evaluations + 1000,
        )
        if ending.stopped_by is not None:
            raise ending.stopped_by
        if all(self.merit.loss(made) is None for made in self.archive.history):
            return "It found no design to go by."
        return ending.reason

    def _prefetch(self, origin: Point, both: bool) -> None:
        """Evaluate side by side what COBYLA (and on ``both`` sides BOBYQA) asks for first, one by one.

        A point that is not asked for after all is a design seen, no more: the models of the polishing use it.
        """
        points = []
        for i, x in enumerate(origin):
            steps = (FIRST_STEP, -FIRST_STEP) if both else (FIRST_STEP if x + FIRST_STEP <= 1 else -FIRST_STEP,)
            points += [self.archive.box.tidy([*origin[:i], x + step, *origin[i + 1 :]]) for step in steps]
        fresh = [point for point in dict.fromkeys(points) if not self.archive.knows(point)][: self.archive.left]
        self.archive.evaluate([self.archive.box.values(point) for point in fresh])
