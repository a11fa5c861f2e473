"""How far a sweep or a search is, as frozen data that the command line prints."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from fluxbore.design.study import Objective
from fluxbore.optimize.evaluation import INVALID, Evaluation


@dataclass(frozen=True, slots=True)
class Progress:
    """The state after one more design.

    done, total : designs; a search's total is its budget, which it need not use up.
    reused : of those done, taken from the journal or from memory. failed : without figures, for whatever reason.
    best, best_values : the best figure so far (SI) with the moved keys' values (SI); None before there is one.
    rate : computed designs per second; seconds_left : at that rate; both None before two were computed.
    at_most : whether ``total`` is a budget, and ``seconds_left`` with it the most that it can take.
    """

    label: str
    done: int
    total: int
    reused: int
    failed: int
    figure: str | None
    best: float | None
    best_values: Mapping[str, float] | None
    rate: float | None
    seconds_left: float | None
    at_most: bool = False


Report = Callable[[Progress], None]
"""What receives the progress; the command line prints it, a notebook may draw it."""

BUDGETED = ("search", "front")
"""The labels of what need not use up its total."""

BATCH = 0.1
"""s; designs that were evaluated side by side are told of together, within this time of the first one."""


class Tracker:
    """Counts designs and tells ``report`` after each one; without ``report`` it does nothing.

    The rate is that of designs that had to be computed: what stood in the journal costs nothing, nor does what cannot
    be built. A search's clock starts with its first batch, as the network has its time before that.
    """

    def __init__(self, label: str, total: int, report: Report | None, objective: Objective | None) -> None:
        self._label, self._total, self._report, self._objective = label, total, report, objective
        self._done = self._reused = self._failed = self._computed = self._uncounted = 0
        self._best: float | None = None
        self._best_values: Mapping[str, float] | None = None
        self._budget = label in BUDGETED
        self._begin = time.monotonic()
        self._first: float | None = None

    def add(
        self, values: Mapping[str, float], evaluation: Evaluation, *, reused: bool = False, eligible: bool = True
    ) -> None:
        """One more design is done; only an ``eligible`` one (a feasible one, in a search) can be the best."""
        self._done += 1
        self._reused += reused
        self._failed += not evaluation.ok
        if not reused and evaluation.status != INVALID:
            self._computed += 1
            self._clock()
        if self._objective is not None and evaluation.ok and eligible:
            value: float | None = getattr(evaluation.performance, self._objective.figure)
            sign = 1.0 if self._objective.maximise else -1.0
            if value is not None and (self._best is None or sign * value > sign * self._best):
                self._best, self._best_values = value, dict(values)
        if self._report is not None:
            self._report(self._state())

    def _clock(self) -> None:
        """Start a search's clock at its first computed batch, whose designs are then not in the rate."""
        now = time.monotonic()
        if self._first is None:
            self._first = now
        if self._budget and now - self._first <= BATCH:
            self._begin, self._uncounted = now, self._computed

    def _state(self) -> Progress:
        timed = self._computed - self._uncounted
        elapsed = time.monotonic() - self._begin
        rate = timed / elapsed if timed > 0 and self._computed > 1 and elapsed > 0 else None
        return Progress(
            label=self._label,
            done=self._done,
            total=self._total,
            reused=self._reused,
            failed=self._failed,
            figure=self._objective.figure if self._objective is not None else None,
            best=self._best,
            best_values=self._best_values,
            rate=rate,
            seconds_left=(self._total - self._done) / rate if rate else None,
            at_most=self._budget,
        )
