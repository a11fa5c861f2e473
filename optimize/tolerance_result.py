"""What a tolerance analysis found: frozen data that tables, messages and the robust search read. SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from fluxbore.design.study import Production, Tolerance
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import Limit, SearchResult

CONFIDENCE = 0.95
"""Of every interval here."""

QUANTILES = (0.01, 0.5, 0.99)
"""Shares of the actuators below the values that `FigureSpread.quantiles` gives."""


@dataclass(frozen=True, slots=True)
class Interval:
    """An estimate and its confidence interval, `CONFIDENCE`; an end that too few samples leave open is infinite."""

    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class CheckedFigure:
    """A figure in the ``count`` sound ones of the samples that were computed in full.

    mean : of the production, by the linear model as control variate. bias, error : mean and root mean square of
    full minus linear.
    """

    count: int
    mean: Interval
    bias: float
    error: float


@dataclass(frozen=True, slots=True)
class FigureSpread:
    """How one figure, or one key that a limit names, scatters by the linear model about the nominal design.

    mean, sigma : of the production; a mean off the nominal value comes of asymmetric tolerances.
    worst_low, worst_high : with every toleranced key at its least favourable limit.
    slopes : d figure / d key. shares : each tolerance's share of the variance, adding up to 1 where sigma > 0.
    exact : False where the slopes are central differences, the model having no derivative to give.
    quantiles : share below -> value, of the sampled linear model, intervals by order statistics.
    """

    subject: str
    nominal: float
    mean: float
    sigma: float
    worst_low: float
    worst_high: float
    slopes: Mapping[str, float]
    shares: Mapping[str, float]
    exact: bool
    quantiles: Mapping[float, Interval]
    checked: CheckedFigure | None = None


@dataclass(frozen=True, slots=True)
class Requirement:
    """One limit held against the production.

    margin : room between the mean and the limit in standard deviations, negative beyond the limit, infinite where
    nothing scatters. expected : share that meets it by the linear model, without sampling. simulated : the same
    counted in the samples. checked : corrected by the samples computed in full. shifted : see `ToleranceResult`.
    cost : what the yield of all limits together would gain if this one were dropped.
    """

    limit: Limit
    nominal: float
    margin: float
    expected: float
    simulated: Interval
    cost: float
    checked: Interval | None = None
    shifted: Interval | None = None

    @property
    def best_estimate(self) -> Interval:
        """The share that meets it, by the best that was computed; see `ToleranceResult.best_estimate`."""
        return self.shifted or self.checked or self.simulated


@dataclass(frozen=True, slots=True)
class ToleranceEffect:
    """What one tolerance does to the yield.

    halved : yield with both of its limits halved, the same samples counted again; gain : that less the yield as it is.
    shares : of each requirement's variance, in the order of the requirements.
    """

    tolerance: Tolerance
    halved: float
    gain: float
    shares: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Reject:
    """Why ``count`` samples are rejects whatever their figures; ``reason`` is the first one's sentence."""

    reason: str
    count: int


@dataclass(frozen=True, slots=True)
class ToleranceResult:
    """The analysis of one design.

    values : the nominal values of the toleranced keys. held : of the keys that exclude one another, those that stay
    while the toleranced ones scatter.
    figures : the objective's first, then those of the limits, then the rest. requirements : in the study's order.
    simulated : yield of all limits together in the samples of the linear model, among them those that cannot be built.
    examined : how many samples that is. checked : the same corrected by the samples computed in full. direct : the
    plain count in those. shifted : the linear model corrected by its error in those, which presumes that the error is
    smooth between them; None where they are too few or one failed, see `fluxbore.optimize.tolerance_shift`.
    effects : the most harmful tolerance first.
    rejects : of the samples. failures : of those computed in full, which count as rejects too.
    warnings : whole sentences. reused : evaluations that the journal held, of ``evaluations``; seconds are this run's.
    """

    production: Production
    values: Mapping[str, float]
    held: tuple[str, ...]
    nominal: Evaluation
    figures: tuple[FigureSpread, ...]
    requirements: tuple[Requirement, ...]
    simulated: Interval
    examined: int
    effects: tuple[ToleranceEffect, ...]
    rejects: tuple[Reject, ...]
    failures: tuple[Reject, ...] = ()
    checked: Interval | None = None
    direct: Interval | None = None
    shifted: Interval | None = None
    warnings: tuple[str, ...] = ()
    evaluations: int = 0
    reused: int = 0
    seconds: float = 0.0

    @property
    def best_estimate(self) -> Interval:
        """The yield by the best that was computed: ``shifted`` where it is given."""
        return self.shifted or self.checked or self.simulated

    def figure(self, subject: str) -> FigureSpread | None:
        return next((item for item in self.figures if item.subject == subject), None)


@dataclass(frozen=True, slots=True)
class RobustRound:
    """One search under the limits it was given, and the production of the design it chose.

    production : None where the search found no design, or one that no tolerances can be analysed at. reason : why.
    """

    limits: tuple[Limit, ...]
    search: SearchResult
    production: ToleranceResult | None
    objective: float | None
    reason: str = ""


@dataclass(frozen=True, slots=True)
class RobustResult:
    """Searches with limits backed off, round by round, until the yield asked for is reached.

    rounds : the first one with the study's own limits. chosen : index of the best design that reaches the target, or
    of the highest yield where none does; None where no round has a design.
    price : by how much the objective of the chosen design is worse than the first round's, SI; None without both.
    stop_reason : a sentence.
    """

    target: float
    rounds: tuple[RobustRound, ...]
    chosen: int | None
    reached: bool
    price: float | None
    stop_reason: str

    @property
    def best(self) -> RobustRound | None:
        return None if self.chosen is None else self.rounds[self.chosen]
