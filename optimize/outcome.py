"""What a study found: frozen data that the search and the sweeps make and the report reads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from fluxbore.design.study import Sweep
from fluxbore.optimize.evaluation import Evaluation

SearchEnding = Literal["done", "interrupted", "failed"]
"""How a search ended: by itself (convergence, budget), by Ctrl-C, or by an error of the program or its surroundings."""


@dataclass(frozen=True, slots=True)
class Limit:
    """A constraint with its limit as a number.

    subject : a figure's name or a dotted key; sense : "<=" or ">="; limit : SI.
    scale : SI, > 0, what misses and margins are measured in where the limit's own number says nothing of their size,
    for it is zero or next to it; None elsewhere. It has no part in which limit this is.
    """

    subject: str
    sense: str
    limit: float
    scale: float | None = field(default=None, compare=False)

    @property
    def size(self) -> float:
        """What misses and margins are relative to (SI, > 0)."""
        return self.scale or abs(self.limit) or 1.0


@dataclass(frozen=True, slots=True)
class Check:
    """A limit held against a design. ``value`` is None where the route cannot give the figure, or where the part whose
    safety is limited bears no load: that limit is satisfied.

    margin : positive where the limit holds with room to spare, relative to the limit's size, 1 where nothing bears a
    load, None where nothing is known; active : within the search's tolerance of the limit.
    """

    limit: Limit
    value: float | None
    margin: float | None
    satisfied: bool
    active: bool

    @property
    def unloaded(self) -> bool:
        """Whether the limit is on the safety of a part that bears no load."""
        return self.value is None and self.margin is not None


@dataclass(frozen=True, slots=True)
class Candidate:
    """A design of the study: the values of its variables (SI), its evaluation, and the limits held against it."""

    values: Mapping[str, float]
    evaluation: Evaluation
    objective: float | None
    checks: tuple[Check, ...]

    @property
    def feasible(self) -> bool:
        """Whether the design is sound and every limit that could be checked holds."""
        return self.evaluation.ok and all(check.satisfied for check in self.checks)


@dataclass(frozen=True, slots=True)
class Multiplier:
    """What moving one limit or bound would do to the objective, to first order.

    subject, sense : as a `Limit`'s; ``bound`` where it is a variable's own bound. limit, value : SI, of the limit and
    of the design. per_unit : d objective / d limit (both SI): a limit of a diameter moved by +1 m changes the objective
    by so much. share : the same in plain numbers, relative objective per relative limit (per range, of a bound); >= 0.
    """

    subject: str
    sense: str
    limit: float
    value: float
    per_unit: float
    share: float
    bound: bool = False


@dataclass(frozen=True, slots=True)
class Optimality:
    """How nearly the best continuous design fulfils the conditions of Karush, Kuhn and Tucker, by exact gradients.

    residual : see `fluxbore.optimize.optimality.residual`; relative objective per range of a variable, so that 1e-3
    promises about a thousandth of the objective for a walk across the whole range. multipliers : of what is active, the
    largest share first.
    """

    residual: float
    multipliers: tuple[Multiplier, ...]


@dataclass(frozen=True, slots=True)
class Clash:
    """A limit or a bound that takes part in a conflict.

    missed : SI, >= 0, how far the least infeasible design is beyond it; 0 for a bound. relative : the same of the
    limit's size. scale : as the limit's, SI; None where its size is its own number.
    weight : of this one in the conflict, their sum over the limits being 1: moving it by 1 % of its size (a bound by
    1 % of its range) brings the worst miss down by weight x 1 %; None where there are no gradients or the least
    infeasible design was not found. alone : SI, how far it would have to give way, alone, for every limit to hold, to
    first order; None without a weight, and where that is more than its own size, where no slope tells.
    """

    subject: str
    sense: str
    limit: float
    value: float
    missed: float
    relative: float
    weight: float | None = None
    alone: float | None = None
    bound: bool = False
    scale: float | None = None


@dataclass(frozen=True, slots=True)
class Conflict:
    """Why no design is feasible: the limits that exclude one another around the least infeasible design.

    values : that design's variables (SI). worst : its largest relative miss. clashes : the heaviest first.
    settled : whether the least infeasible design was found by gradients, so that (locally) none is less infeasible.
    """

    values: Mapping[str, float]
    worst: float
    clashes: tuple[Clash, ...]
    settled: bool = False

    @property
    def unscaled(self) -> Clash | None:
        """The clash that is missed the most, where that is no share of its limit."""
        most = max(self.clashes, key=lambda clash: clash.relative, default=None)
        return None if most is None or most.scale is None else most


@dataclass(frozen=True, slots=True)
class SearchResult:
    """The search from beginning to end.

    history : every FEM design in the order it was asked for; best_so_far : index into it of the best feasible one
    after each step (None before there was one).
    network_start : the network's own optimum, where the FEM search began.
    rounded : the best design at the workshop's resolution, re-evaluated; None where no variable has a resolution.
    reused : how many designs of the history stood in the journal already; seconds are this run's.
    stop_reason : a sentence; ending : what sort of end that was, whatever had been found by then.
    optimality : of ``best``; None where the model gives no gradients. conflict : where no design was feasible.
    algorithm : what ran, in order, such as "MMA, then SLSQP"; of several combinations of counts,
    for the one whose design is the best. network_calls : of the analytic network, for the start and by the mapping.
    """

    start: Candidate
    network_start: Candidate | None
    history: tuple[Candidate, ...]
    best_so_far: tuple[int | None, ...]
    best: Candidate | None
    rounded: Candidate | None
    stop_reason: str
    seconds: float
    ending: SearchEnding = "done"
    reused: int = 0
    optimality: Optimality | None = None
    conflict: Conflict | None = None
    algorithm: str = ""
    network_calls: int = 0

    @property
    def replayed(self) -> bool:
        """Whether most of the search was an earlier run's, so that ``seconds`` says nothing of its cost."""
        return 2 * self.reused > len(self.history)

    @property
    def chosen(self) -> Candidate | None:
        """The design to make: the rounded one where it is feasible, else the best."""
        return self.rounded if self.rounded is not None and self.rounded.feasible else self.best


@dataclass(frozen=True, slots=True)
class SweepRow:
    """One design of a sweep: the swept keys' values (SI) and its evaluation."""

    values: Mapping[str, float]
    evaluation: Evaluation


@dataclass(frozen=True, slots=True)
class SweepResult:
    """A sweep's rows in grid order."""

    sweep: Sweep
    rows: tuple[SweepRow, ...]

    def best(self, figure: str, maximise: bool = True) -> SweepRow | None:
        """The row with the largest (or smallest) figure among the sound ones."""
        sound = [
            row for row in self.rows if row.evaluation.ok and getattr(row.evaluation.performance, figure) is not None
        ]
        if not sound:
            return None
        sign = 1.0 if maximise else -1.0
        return max(sound, key=lambda row: sign * getattr(row.evaluation.performance, figure))
