"""What a search does, one stage after the other, over one archive of designs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce

from fluxbore.design.errors import FluxboreError
from fluxbore.design.study import Study
from fluxbore.optimize import nlopt_loop, rounding
from fluxbore.optimize.archive import Archive, BudgetUsedError
from fluxbore.optimize.evaluator import Evaluated
from fluxbore.optimize.outcome import Candidate, Limit, SearchEnding
from fluxbore.optimize.polish import polish
from fluxbore.optimize.problem import Merit, Point, better

FIRST_STEP = 0.1
"""First step of the local searches, of each variable's range."""

GLOBAL_SHARE = 0.6
"""What a global algorithm gets of the budget; the rest is for the local search after it."""


@dataclass(slots=True)
class Stages:
    """The stages of one search over its archive.

    held : the limits that NLopt must hold; those on variables are in the box already.
    back_off : room to leave to them (relative). Searches close in on a limit from both sides; this much room makes
    what they find feasible.
    ending : how `run` ended.
    """

    archive: Archive
    study: Study
    merit: Merit
    held: Sequence[Limit]
    back_off: float
    rounded: Candidate | None = None
    ending: SearchEnding = "done"
    penalties: dict[Point, float] = field(default_factory=dict)

    def run(self, first: Sequence[Mapping[str, float]], done: Sequence[Evaluated]) -> str:
        """Run every stage; returns in words why the search ended."""
        variables, most = self.study.variables, self.archive.budget
        reserve = min(rounding.reserve(variables), most // 3)
        self.archive.budget = most - reserve
        try:
            begun = [self.archive.adopt(v, d.evaluation, d.reused) for v, d in zip(first, done, strict=True)]
            reason = self.search(begun)
        except KeyboardInterrupt:
            self.ending = "interrupted"
            return "The search was interrupted."
        except Exception as error:
            self.ending = "failed"
            return _mishap(error)
        self.archive.budget = most
        try:
            self.rounded = rounding.round_off(
                self.archive, variables, self.merit, self.held, self.study.search.relative_tolerance
            )
        except KeyboardInterrupt:
            self.ending = "interrupted"
            return f"{reason} The rounding to the workshop's steps was interrupted."
        except Exception as error:
            self.ending = "failed"
            return f"{reason} The rounding to the workshop's steps failed: {_mishap(error)}"
        return reason

    def search(self, begun: Sequence[Candidate]) -> str:
        """NLopt from the best of the first designs, then the polishing; a used-up budget is an ending like others."""
        archive, search = self.archive, self.study.search
        reason, spent = "", f"The search used up its budget of {search.max_evaluations} FEM designs."
        if not begun:
            return spent
        origin = reduce(lambda one, other: other if better(other, one, archive.objective) else one, begun)
        point = archive.box.point(origin.values)
        try:
            if search.algorithm in nlopt_loop.GLOBAL:
                reason = f"{search.algorithm} looked at the whole range; then COBYLA looked around its best. "
                self.explore(point)
                point = point if archive.best is None else archive.box.point(archive.best.values)
            local = "BOBYQA" if search.algorithm == "BOBYQA" else "COBYLA"
            self.prefetch(point, both=local == "BOBYQA")
            reason += self.loop(local, point)
            polish(archive, self.merit, self.held, self.back_off, search.relative_tolerance / 10)
        except BudgetUsedError:
            return reason + spent
        return reason

    def explore(self, point: Point) -> None:
        """Let a global algorithm have its share of the budget; it finds the valley, a local one finds its floor."""
        archive, most = self.archive, self.archive.budget
        archive.budget = most - int((1 - GLOBAL_SHARE) * archive.left)
        try:
            self.loop(self.study.search.algorithm, point)
        except BudgetUsedError:
            pass
        finally:
            archive.budget = most

    def loop(self, algorithm: str, point: Point) -> str:
        """One run of NLopt over the archive; returns why it ended. Raises what stopped it from within."""
        search = self.study.search
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
        return ending.reason

    def see(self, x: Point) -> tuple[float, tuple[float, ...]]:
        """What NLopt sees at a scaled point.

        A design without figures is seen as worse than the worst sound one so far by the objective's own size, and as
        missing every limit by all of it: finite, so that the algorithms' models survive it. The number stays within
        NLopt; the history has the design with its reason.
        """
        made = self.archive.at(x)
        loss = self.merit.loss(made)
        if loss is not None:
            return loss, tuple(miss + self.back_off for miss in self.merit.misses(made, self.held))
        point = self.archive.box.tidy(x)
        if point not in self.penalties:
            sound = [loss for design in self.archive.history if (loss := self.merit.loss(design)) is not None]
            self.penalties[point] = max(sound, default=0.0) + 1.0
        return self.penalties[point], (1.0,) * len(self.held)

    def prefetch(self, origin: Point, both: bool) -> None:
        """Evaluate side by side what COBYLA (and on ``both`` sides BOBYQA) asks for first, one by one.

        A point that is not asked for after all is a design seen, no more: the models of the polishing use it.
        """
        points = []
        for i, x in enumerate(origin):
            steps = (FIRST_STEP, -FIRST_STEP) if both else (FIRST_STEP if x + FIRST_STEP <= 1 else -FIRST_STEP,)
            points += [self.archive.box.tidy([*origin[:i], x + step, *origin[i + 1 :]]) for step in steps]
        fresh = [point for point in dict.fromkeys(points) if not self.archive.knows(point)][: self.archive.left]
        self.archive.evaluate([self.archive.box.values(point) for point in fresh])


def _mishap(error: Exception) -> str:
    return (
        str(error) if isinstance(error, FluxboreError) else f"The search failed with {type(error).__name__}: {error}."
    )
