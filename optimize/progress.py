"""How far a sweep or a search is, as frozen data that the command line prints."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from fluxbore.design.study import Objective
from fluxbore.optimize.evaluation import Evaluation


@dataclass(frozen=True, slots=True)
class Progress:
    """The state after one more design.

    done, total : designs; a search's total is its budget, which it need not use up.
    reused : of those done, taken from the journal or from memory. failed : without figures, for whatever reason.
    best, best_values : the best figure so far (SI) with the moved keys' values (SI); None before there is one.
    rate : computed designs per second; seconds_left : at that rate; both None before the first computed one.
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


Report = Callable[[Progress], None]
"""What receives the progress; the command line prints it, a notebook may draw it."""


class Tracker:
    """Counts designs and tells ``report`` after each one; without ``report`` it does nothing."""

    def __init__(self, label: str, total: int, report: Report | None, objective: Objective | None) -> None:
        self._label, self._total, self._report, self._objective = label, total, report, objective
        self._done = self._reused = self._failed = 0
        self._best: float | None = None
        self._best_values: Mapping[str, float] | None = None
        self._begin = time.monotonic()

    def add(
        self, values: Mapping[str, float], evaluation: Evaluation, *, reused: bool = False, eligible: bool = True
    ) -> None:
        """One more design is done; only an ``eligible`` one (a feasible one, in a search) can be the best."""
        self._done += 1
        self._reused += reused
        self._failed += not evaluation.ok
        if self._objective is not None and evaluation.ok and eligible:
            value: float | None = getattr(evaluation.performance, self._objective.figure)
            sign = 1.0 if self._objective.maximise else -1.0
            if value is not None and (self._best is None or sign * value > sign * self._best):
                self._best, self._best_values = value, dict(values)
        if self._report is not None:
            self._report(self._state())

    def _state(self) -> Progress:
        computed = self._done - self._reused
        elapsed = time.monotonic() - self._begin
        rate = computed / elapsed if computed and elapsed > 0 else None
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
        )
