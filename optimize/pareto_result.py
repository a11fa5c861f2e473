"""What the search for a Pareto front found: frozen data that tables, messages and pictures read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from fluxbore.design.study import Objective
from fluxbore.optimize.outcome import Candidate, SearchEnding

Standing = Literal["front", "dominated", "repeated", "failed"]
"""A design that no other point's surpasses; one that another point's does; one that another point found too; none."""


@dataclass(frozen=True, slots=True)
class FrontPoint:
    """One point of the front: what was asked for and what came of it.

    position : 0 at the best of the study's objective, 1 at the best of the second one.
    limit : the bound that the second figure was held to (SI); None at the ends and by normal boundary intersection.
    design : the best that was found; None where nothing met every limit, which ``reason`` explains.
    first, second : its two figures (SI).
    reason : a sentence on why the search for this point stopped.
    residual : of the Karush-Kuhn-Tucker conditions, see `fluxbore.optimize.pareto_slope`; None without gradients.
    slope : d first/d second along the front (SI), from the multipliers; None without gradients, and at an end where
        only one of the objectives decides.
    designs : how many were evaluated for this point.
    """

    position: float
    limit: float | None
    design: Candidate | None
    first: float | None
    second: float | None
    standing: Standing
    reason: str
    residual: float | None = None
    slope: float | None = None
    designs: int = 0


@dataclass(frozen=True, slots=True)
class ParetoResult:
    """The front from one end to the other.

    objective, against : the two objectives; method : one of `fluxbore.design.study.PARETO_METHODS`.
    start : the start design, which the study's relative limits refer to.
    points : in order of ``position``, the two ends first and last; dominated and failed ones are among them, marked.
        A single point where the objectives do not conflict.
    history : every design in the order it was asked for, the start first.
    reference : the two figures (SI) of the point that ``hypervolume`` refers to: the worse end's value of each.
    hypervolume : what the front dominates of the rectangle between ``reference`` and the best of both, 0 to 1; a
        straight front has 1/2. None where there is no front of two ends.
    reused : how many designs of the history stood in the journal already; seconds are this run's.
    stop_reason : a sentence; ending : what sort of end that was, whatever had been found by then.
    conflicting : False where one design is the best in both objectives.
    algorithm : the search that ran, where the study asks for "auto"; COBYLA where the model gives no gradients.
    """

    objective: Objective
    against: Objective
    method: str
    start: Candidate
    points: tuple[FrontPoint, ...]
    history: tuple[Candidate, ...]
    reference: tuple[float, float] | None
    hypervolume: float | None
    stop_reason: str
    seconds: float
    ending: SearchEnding = "done"
    reused: int = 0
    conflicting: bool = True
    algorithm: str = ""

    @property
    def front(self) -> tuple[FrontPoint, ...]:
        """The points that no other point dominates or repeats."""
        return tuple(point for point in self.points if point.standing == "front")

    @property
    def failed(self) -> tuple[FrontPoint, ...]:
        """The points without a design, each with its reason."""
        return tuple(point for point in self.points if point.standing == "failed")

    @property
    def anchors(self) -> tuple[FrontPoint | None, FrontPoint | None]:
        """The best of the objective and the best of the second one, None where it was not found."""
        ends = [
            next((point for point in self.points if point.position == end and point.design is not None), None)
            for end in (0.0, 1.0)
        ]
        return ends[0], ends[1]

    @property
    def replayed(self) -> bool:
        """Whether most of the front was an earlier run's, so that ``seconds`` says nothing of its cost."""
        return 2 * self.reused > len(self.history)
