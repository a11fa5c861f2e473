"""The analytic network as the mapping's cheap model: responses and slopes at any point, counted."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from fluxbore.design.spec import Spec
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.evaluator import Evaluate, Evaluator
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.outcome import Candidate, Limit
from fluxbore.optimize.problem import Box, Merit, Point, candidate
from fluxbore.optimize.space_mapping_response import Array, Response, response

Network = Callable[[Point], Candidate | None]
"""Scaled point, not cut to any digits -> the network's design there; None where there is none."""

STEP = 1e-6
"""Of the differences, of each variable's range: closed forms bear it."""


def network_model(archive: Archive, base: Spec, evaluate: Evaluate) -> Network:
    """The network of the archive's study; a design that cannot be built or computed is None.

    base : the start design as the study sees it (`Spec.for_study`), with the counts that the archive holds fixed.
    """
    box = archive.box
    keys = (*box.keys, *archive.fixed)
    evaluator = Evaluator(base, SerialExecutor(), None, "network", evaluate, "search")

    def at(point: Point) -> Candidate | None:
        try:
            spec = evaluator.design(box.values(point))
            evaluation = evaluate(spec, "network")
        except Exception:  # whatever a model raises at one point of the range is that point's own, as in a worker
            return None
        return candidate(spec, archive.objective, archive.limits, keys, evaluation) if evaluation.ok else None

    return at


@dataclass(slots=True)
class Coarse:
    """The network by scaled points, each computed once.

    calls : of the network so far.
    """

    network: Network
    merit: Merit
    held: Sequence[Limit]
    box: Box
    calls: int = 0
    _values: dict[Point, Response | None] = field(default_factory=dict)
    _slopes: dict[Point, Response | None] = field(default_factory=dict)

    def at(self, x: Array) -> Response | None:
        """The response at a scaled point; None where the network has none."""
        point = tuple(float(value) for value in x)
        if point not in self._values:
            self.calls += 1
            made = self.network(point)
            self._values[point] = None if made is None else response(made, self.merit, self.held, self.box)
        return self._values[point]

    def with_slopes(self, x: Array) -> Response | None:
        """The same with all slopes: the network's own where it gives them, else one-sided differences, inwards."""
        point = tuple(float(value) for value in x)
        if point not in self._slopes:
            self._slopes[point] = self._differenced(point)
        return self._slopes[point]

    def _differenced(self, point: Point) -> Response | None:
        here = self.at(point)
        if here is None or np.isfinite(here.slopes[np.isfinite(here.values)]).all():
            return here
        columns = []
        for i, x in enumerate(point):
            for step in (STEP, -STEP) if x <= 0.5 else (-STEP, STEP):
                there = self.at((*point[:i], x + step, *point[i + 1 :]))
                if there is not None:
                    columns.append((there.values - here.values) / step)
                    break
            else:
                return None
        return Response(here.values, here.figures, np.column_stack(columns))
