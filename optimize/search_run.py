"""One search from its first designs to its result: every combination of counts in turn, then the rounding."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from fluxbore.design.errors import FluxboreError
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective, Variable
from fluxbore.optimize import rounding
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.enumeration import Counts, distance, in_turn, show, told_left_out, told_rest
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.evaluator import Evaluated, Evaluator
from fluxbore.optimize.network_start import network_start, objective_size
from fluxbore.optimize.optimality import optimality
from fluxbore.optimize.outcome import Candidate, Limit, Optimality, SearchEnding, SearchResult
from fluxbore.optimize.problem import Box, Merit, Point, better, candidate, resolve_limits
from fluxbore.optimize.progress import Tracker
from fluxbore.optimize.slopes import Slopes
from fluxbore.optimize.stages import Proposed, Stages, mishap
from fluxbore.optimize.verdict import conflict_of, joined, shortfall


@dataclass
class SearchRun:
    """The state of a search.

    base : the start design as the study sees it. bounds : of the continuous variables. combinations : of the counts.
    algorithm : the one that runs. gradients : whether the model can bring derivatives.
    deadline : of `time.monotonic`.
    """

    base: Spec
    bounds: Box
    combinations: Sequence[Counts]
    algorithm: str
    evaluator: Evaluator
    gradients: bool
    tracker: Tracker
    deadline: float = math.inf
    stages: list[Stages] = field(default_factory=list)
    rounded: Candidate | None = None
    ending: SearchEnding = "done"
    network_calls: int = 0

    def result(self, remark: str, begin: float) -> SearchResult:
        """Run the search. ``remark`` comes before the reason why it ended; ``begin`` is of `time.monotonic`."""
        turns = in_turn(self.combinations, self.start_counts)
        network = self.network_start(turns[0])
        first = self.first_designs(turns[0], network)
        done = self.evaluator.all(first)
        try:
            limits = resolve_limits(self.base, done[0].evaluation)
        except FluxboreError as error:
            start = self.as_candidate(done[0].evaluation, ())
            seconds = time.monotonic() - begin
            return SearchResult(
                start, network, (start,), (None,), None, None, str(error), seconds, network_calls=self.network_calls
            )
        start = self.as_candidate(done[0].evaluation, limits)
        merit = Merit(self.objective, objective_size(start, network, self.objective.figure, self.bounds))
        outside = 0 if self.inside else 1
        reason = remark + self.search_all(turns, first[outside:], done[outside:], limits, merit)
        best = self.best
        reason += self.round_off()
        history, best_so_far = joined([stages.archive for stages in self.stages], self.objective)
        conflict = conflict_of(self.stages) if self.best is None else None
        return SearchResult(
            start=start,
            network_start=network,
            history=history,
            best_so_far=best_so_far,
            best=self.best,
            rounded=self.rounded,
            stop_reason=reason + (shortfall(self.base, history, conflict) if self.best is None else ""),
            seconds=time.monotonic() - begin,
            ending=self.ending,
            reused=sum(stages.archive.reused for stages in self.stages),
            optimality=self.optimality(best),
            conflict=conflict,
            algorithm=self.ran,
            network_calls=self.network_calls + sum(stages.network_calls for stages in self.stages),
        )

    @property
    def ran(self) -> str:
        """What searched, for the best design where there is one."""
        stages = self.winner or (self.stages[-1] if self.stages else None)
        return "" if stages is None else ", then ".join(stages.ran)

    @cached_property
    def objective(self) -> Objective:
        assert self.base.study.objective is not None
        return self.base.study.objective

    @cached_property
    def start_values(self) -> dict[str, float]:
        return {key: self.base.number(key) for key in self.bounds.keys}

    @cached_property
    def start_counts(self) -> Counts:
        return {key: int(self.base.number(key)) for key in self.combinations[0]}

    @cached_property
    def inside(self) -> bool:
        """Whether the start is one of the search's designs; else it has cost one all the same."""
        return self.bounds.contains(self.start_values) and self.start_counts in self.combinations

    @property
    def budget(self) -> int:
        return self.base.study.search.max_evaluations

    @property
    def left(self) -> int:
        """Designs of the whole budget that are left."""
        return self.budget - (not self.inside) - sum(len(stages.archive.history) for stages in self.stages)

    @property
    def best(self) -> Candidate | None:
        """The best feasible design of all combinations."""
        winner = self.winner
        return None if winner is None else winner.archive.best

    @property
    def winner(self) -> Stages | None:
        """The search that found the best feasible design."""
        found: Stages | None = None
        for stages in self.stages:
            best = stages.archive.best
            known = None if found is None else found.archive.best
            if best is not None and (known is None or better(best, known, self.objective)):
                found = stages
        return found

    def network_start(self, counts: Counts) -> Candidate | None:
        if self.base.study.search.network == "off":
            return None
        found = network_start(self.base, self.bounds, self.evaluator.evaluate, counts)
        self.network_calls += found.calls
        return found.best

    def first_designs(self, counts: Counts, network: Candidate | None) -> list[dict[str, float]]:
        """Side by side: the start as it is (limits refer to it), clipped into the bounds, the network's."""
        clipped = self.bounds.values(self.bounds.point(self.start_values))
        designs: list[dict[str, float]] = [{**self.start_values, **self.start_counts}]
        designs += [] if self.inside else [{**clipped, **counts}]
        designs += [dict(network.values)] if network else []
        return designs[: self.budget]

    def as_candidate(self, evaluation: Evaluation, limits: Sequence[Limit]) -> Candidate:
        keys = (*self.bounds.keys, *self.start_counts)
        return candidate(self.base, self.objective, limits, keys, evaluation)

    def search_all(
        self,
        turns: Sequence[Counts],
        first: Sequence[Mapping[str, float]],
        done: Sequence[Evaluated],
        limits: Sequence[Limit],
        merit: Merit,
    ) -> str:
        """Every combination in its turn, each with its share of what is left of the budget; returns why it ended."""
        reasons: list[str] = []
        kept = min(rounding.reserve(self.continuous, self.slopes(limits, merit)), self.budget // 3)
        for i, counts in enumerate(turns):
            share = (self.left - kept) // (len(turns) - i)
            if i and share < 1:
                break
            stages = self.made(counts, limits, merit, max(share, len(first)) if i == 0 else share)
            stages.spare = kept if i == len(turns) - 1 else 0
            stages.rest = told_rest(outside=not self.inside, several=len(turns) > 1, rounded=kept > 0)
            try:
                begun = first if i == 0 else self.warm(counts)
            except KeyboardInterrupt:
                self.ending = "interrupted"
                return "The search was interrupted."
            self.stages.append(stages)
            reasons.append(stages.run(begun, done if i == 0 else None))
            self.ending = stages.ending
            if self.ending != "done":
                return reasons[-1]
        return self.told(reasons, len(turns))

    def told(self, reasons: Sequence[str], many: int) -> str:
        """The reason of the search that found the best; of several combinations, which it is."""
        if many == 1:
            return reasons[0]
        searched = [stages for stages in self.stages if not stages.left_out]
        winner = self.winner or (searched or self.stages)[-1]
        words = f"{len(searched)} of {many} combinations of counts were searched. "
        words += told_left_out([(_counts(stages), stages.left_out) for stages in self.stages if stages.left_out])
        if len(reasons) < many:
            words += f"The budget of {self.budget} FEM designs did not reach for the others. "
        best = "" if self.winner is None else f"The best is at {show(_counts(winner))}: "
        reason = reasons[self.stages.index(winner)]
        return words + best + reason

    def made(self, counts: Counts, limits: Sequence[Limit], merit: Merit, budget: int) -> Stages:
        """The stages of one combination."""
        search = self.base.study.search
        archive = Archive(
            self.evaluator, self.bounds, self.objective, limits, budget, self.tracker, counts, self.deadline
        )
        held = self.held(limits)
        back_off = search.relative_tolerance / 10
        slopes = Slopes(self.base, self.bounds, merit, held)
        stages = Stages(archive, search, self.algorithm, merit, held, back_off, slopes)
        if search.network == "manifold" and self.bounds.keys:
            base, evaluate, tolerance = (
                self.base.with_values(counts),
                self.evaluator.evaluate,
                search.relative_tolerance,
            )

            def propose(archive: Archive, start: Point) -> Proposed:
                from fluxbore.optimize.space_mapping import run_mapping
                from fluxbore.optimize.space_mapping_network import network_model

                network = network_model(archive, base, evaluate)
                found = run_mapping(archive, merit, held, network, start, tolerance, back_off)
                return Proposed("manifold mapping", found.reason, found.converged, found.network_calls)

            stages.propose = propose
        return stages

    def held(self, limits: Sequence[Limit]) -> list[Limit]:
        """The limits that a search must hold; those on variables are in the bounds and the combinations already."""
        return [limit for limit in limits if limit.subject not in (*self.bounds.keys, *self.start_counts)]

    def slopes(self, limits: Sequence[Limit], merit: Merit) -> Slopes | None:
        """None where designs bring no derivatives."""
        if not self.evaluator.gradient:
            return None
        return Slopes(self.base, self.bounds, merit, self.held(limits))

    @cached_property
    def continuous(self) -> list[Variable]:
        return [variable for variable in self.base.study.variables if not variable.integer]

    def warm(self, counts: Counts) -> list[dict[str, float]]:
        """Where a later combination begins: at the best of its nearest neighbour, and at its own network's optimum."""
        built = [stages for stages in self.stages if not stages.left_out] or self.stages
        neighbour = min(built, key=lambda stages: distance(_counts(stages), counts))
        known = neighbour.archive.best or (neighbour.best_known() if neighbour.archive.history else None)
        values = self.start_values if known is None else known.values
        network = self.network_start(counts)
        begun = [self.bounds.values(self.bounds.point(values))]
        return begun + ([self.bounds.values(self.bounds.point(network.values))] if network else [])

    def round_off(self) -> str:
        """Round the best design to the workshop's steps, within its combination of counts; returns what went wrong."""
        winner = self.winner
        if winner is None or self.ending != "done":
            return ""
        winner.archive.budget = len(winner.archive.history) + self.left
        tolerance = self.base.study.search.relative_tolerance
        slopes = winner.slopes if self.evaluator.gradient else None
        try:
            self.rounded = rounding.round_off(
                winner.archive, self.continuous, winner.merit, winner.held, tolerance, slopes
            )
        except KeyboardInterrupt:
            self.ending = "interrupted"
            return " The rounding to the workshop's steps was interrupted."
        except Exception as error:
            self.ending = "failed"
            return f" The rounding to the workshop's steps failed: {mishap(error)}"
        return ""

    def optimality(self, best: Candidate | None) -> Optimality | None:
        """Of the best design before the rounding; a search without derivatives asks for them here, if there are any.

        That is one more evaluation of a design that is known, where the budget has room for it.
        """
        winner = self.winner
        if best is None or winner is None or not self.gradients:
            return None
        try:
            if best.evaluation.gradient is None and self.left > 0 and self.ending == "done":
                asking = replace(self.evaluator, gradient=self.bounds.keys)
                evaluation = asking.all([best.values])[0].evaluation
                keys = (*self.bounds.keys, *self.start_counts)
                best = candidate(asking.design(best.values), self.objective, winner.archive.limits, keys, evaluation)
            return optimality(winner.slopes, best, winner.gradient.lender(best))
        except KeyboardInterrupt:
            self.ending = "interrupted"
        except Exception:  # the design is found; what its limits cost is not worth losing it
            return None
        return None


def _counts(stages: Stages) -> Counts:
    return {key: int(value) for key, value in stages.archive.fixed.items()}
