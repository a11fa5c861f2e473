"""What a search of one combination of counts does, one stage after the other, over one archive of designs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, reduce

from fluxbore.design.errors import FluxboreError
from fluxbore.design.study import GRADIENT_ALGORITHMS, Search
from fluxbore.optimize import elastic
from fluxbore.optimize.archive import Archive, BudgetUsedError, TimeUsedError
from fluxbore.optimize.enumeration import hopeless
from fluxbore.optimize.evaluator import Evaluated
from fluxbore.optimize.free_stage import FreeStage
from fluxbore.optimize.gradient_search import NO_START
from fluxbore.optimize.gradient_stage import GradientStage
from fluxbore.optimize.multistart import search_from_many
from fluxbore.optimize.outcome import Candidate, Limit, SearchEnding
from fluxbore.optimize.problem import Merit, Point, better, violation
from fluxbore.optimize.slopes import NoSlopesError, Slopes

RESTORING_SHARE = 0.25
"""Of the budget, kept back as long as no design is feasible: to find the least infeasible one."""


@dataclass(frozen=True, slots=True)
class Proposed:
    """How a search in place of NLopt's went.

    name : its name. reason : a sentence. network_calls : of the analytic network.
    """

    name: str
    reason: str
    converged: bool
    network_calls: int


Propose = Callable[[Archive, Point], Proposed]
"""A search in place of NLopt's, from a scaled point; NLopt's goes on where it has not converged."""


@dataclass
class Stages:
    """The stages of one search over its archive.

    algorithm : the one to run; `GRADIENT_ALGORITHMS` need an archive whose designs bring derivatives.
    held : the limits that NLopt must hold; those on variables are in the box already.
    back_off : room to leave to them (relative). Searches close in on a limit from both sides; this much room makes
    what they find feasible.
    propose : the search to run in place of NLopt's, or None.
    spare : further designs for the time when nothing feasible was found: there will be nothing to round.
    rest : what the budget beyond this archive's is for, in words. left_out : why the combination was not searched.
    ending : how `run` ended. ran : names of what searched, in order. network_calls : by ``propose``.
    """

    archive: Archive
    search: Search
    algorithm: str
    merit: Merit
    held: Sequence[Limit]
    back_off: float
    slopes: Slopes
    propose: Propose | None = None
    spare: int = 0
    rest: str = ""
    left_out: str = ""
    ending: SearchEnding = "done"
    ran: list[str] = field(default_factory=list)
    network_calls: int = 0

    @cached_property
    def gradient(self) -> GradientStage:
        return GradientStage(self.archive, self.slopes, self.back_off, self.search.relative_tolerance)

    @cached_property
    def free(self) -> FreeStage:
        return FreeStage(self.archive, self.search, self.merit, self.held, self.back_off)

    def run(self, first: Sequence[Mapping[str, float]], done: Sequence[Evaluated] | None = None) -> str:
        """Run every stage from these designs; returns in words why the search ended.

        done : what is known of them already, else they are evaluated here, as many as the budget allows.
        """
        try:
            if done is None:
                self.archive.evaluate(first[: self.archive.left])
            for values, item in zip(first, done or (), strict=done is not None):
                self.archive.adopt(values, item.evaluation, item.reused)
            self.probe()
            if self.left_out:
                return f"Its first designs all fail alike: {self.left_out}"
            return self.restored(self.searched())
        except KeyboardInterrupt:
            self.ending = "interrupted"
            return "The search was interrupted."
        except Exception as error:
            self.ending = "failed"
            return mishap(error)

    def probe(self) -> None:
        """See whether the counts alone make every design fail; where one design does, the middle of the box tells."""
        archive = self.archive
        if not archive.fixed or not archive.box.keys or any(made.evaluation.ok for made in archive.history):
            return
        if len(archive.history) == 1 and archive.left:
            archive.at((0.5,) * len(archive.box.keys))
        self.left_out = hopeless(archive.history)

    def searched(self) -> str:
        """The search from the best of the first designs; a used-up budget is an ending like others."""
        archive = self.archive
        if not archive.history:
            return self.spent(BudgetUsedError())
        if not archive.box.keys:
            return "Only counts vary: this combination is one design."
        if self.held:
            archive.reserve = int(RESTORING_SHARE * archive.left)
        origin = self.best_known()
        try:
            return self.proposed(self.propose, origin) if self.propose is not None else self.by_nlopt(origin)
        except BudgetUsedError as error:
            return self.spent(error)

    def proposed(self, propose: Propose, origin: Candidate) -> str:
        """The search in place of NLopt's, and NLopt's from the best design where that one has not converged."""
        found = propose(self.archive, self.archive.box.point(origin.values))
        self.note(found.name)
        self.network_calls += found.network_calls
        if found.converged or not self.archive.left:
            return found.reason
        try:
            more = self.by_nlopt(self.best_known())
        except BudgetUsedError as error:
            more = self.spent(error)
        return f"{found.reason} {self.algorithm} went on from its best. {more}"

    def by_nlopt(self, origin: Candidate) -> str:
        if self.algorithm in GRADIENT_ALGORITHMS:
            return self.by_gradients(origin)
        return self.freely(self.algorithm, origin)

    def note(self, name: str) -> None:
        """Take down what searches; what goes on after the looking for a feasible design is not told twice."""
        if self.ran[-1:] != [name]:
            self.ran.append(name)

    def restored(self, reason: str) -> str:
        """Where nothing feasible was found: look for the least infeasible design, and search on where it is feasible.

        For what keeps designs from being feasible see `fluxbore.optimize.elastic.conflict`.
        """
        archive, nearest = self.archive, min(self.archive.history, key=violation, default=None)
        archive.reserve = 0
        if archive.best is not None or not self.held or nearest is None or not nearest.evaluation.ok:
            return reason
        archive.budget += self.spare
        try:
            try:
                if not archive.derives:
                    raise NoSlopesError
                elastic.approach(self.gradient, nearest)
            except NoSlopesError:
                elastic.approach_freely(
                    self.gradient, self.free.see, archive.box.point(nearest.values), self.search.relative_tolerance * 10
                )
        except BudgetUsedError as error:
            return self.spent(error)
        if any(made.feasible for made in archive.history):
            return self.searched()
        return "The search ended at the least infeasible design that it found."

    def by_gradients(self, origin: Candidate) -> str:
        """SLSQP, MMA or CCSAQ, or SLSQP from many places; COBYLA where derivatives are missing or do not lead on."""
        try:
            if self.algorithm == "MLSL":
                self.note("MLSL")
                return search_from_many(self.gradient, self.search.seed)
            reason = self.gradient.run(self.algorithm, origin)
        except NoSlopesError as error:
            self.note_gradients()
            words = f"The model gives no derivative of {error}, so COBYLA searched in place of {self.algorithm}. "
            return words + self.freely("COBYLA", origin)
        except BudgetUsedError:
            self.note_gradients()
            raise
        self.note_gradients()
        if reason == NO_START:
            return f"{reason} COBYLA searched instead. " + self.freely("COBYLA", origin)
        best = self.archive.best
        if self.gradient.gave_up and not self.gradient.first_order(self.gradient.ended):
            words = f"{reason} COBYLA searched on in place of {self.gradient.ran[-1]}. "
            return words + self.freely("COBYLA", self.best_known())
        if not self.gradient.failed or best is None or self.gradient.first_order(self.archive.box.point(best.values)):
            return reason
        words = f"Designs without figures kept {self.algorithm} from going on, so COBYLA looked around its best. "
        return words + self.freely("COBYLA", best)

    def note_gradients(self) -> None:
        for name in self.gradient.ran if self.algorithm != "MLSL" else ():
            self.note(name)

    def freely(self, algorithm: str, origin: Candidate) -> str:
        """A search without derivatives."""
        try:
            return self.free.run(algorithm, origin)
        except BudgetUsedError as error:
            return self.free.said + self.spent(error)
        finally:
            for name in self.free.ran:
                self.note(name)

    def spent(self, error: BudgetUsedError) -> str:
        if isinstance(error, TimeUsedError):
            return f"The search reached its time limit of {self.search.time_limit:g} s."
        budget, share = self.search.max_evaluations, self.archive.budget
        rest = f"; the rest is for {self.rest}" if self.rest else ""
        if share >= budget:
            return f"The search used up its budget of {budget} FEM designs."
        return f"The search used up its share of the budget, {share} of {budget} FEM designs{rest}."

    def best_known(self) -> Candidate:
        """The best of all designs so far, feasible or not."""
        objective = self.archive.objective
        return reduce(lambda one, other: other if better(other, one, objective) else one, self.archive.history)


def mishap(error: Exception) -> str:
    """What ended a search from without, in a sentence."""
    return (
        str(error) if isinstance(error, FluxboreError) else f"The search failed with {type(error).__name__}: {error}."
    )
