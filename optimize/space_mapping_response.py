"""What the mapping sees of a design: loss and misses as one vector, with their slopes where the design brings them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import Candidate, Limit
from fluxbore.optimize.problem import Box, Merit

Array = Any


@dataclass(frozen=True, slots=True)
class Response:
    """Loss and misses of one design, in this order; NaN where the route does not give the figure.

    values : (1 + m,) the loss to minimise, then minus each limit's relative margin.
    figures : (1 + m,) the figures themselves, the loss for the objective: two routes compare by their ratio.
    slopes : (1 + m, n) derivatives by the scaled variables; rows of NaN where there are none.
    """

    values: Array
    figures: Array
    slopes: Array

    @property
    def complete(self) -> bool:
        return bool(np.isfinite(self.values).all())


def response(made: Candidate, merit: Merit, held: Sequence[Limit], box: Box) -> Response | None:
    """The design's response; None where it has no objective at all.

    The slope of a figure with a norm is the norm's times maximum/norm: the value is the maximum's own, and near the
    design the two go together.
    """
    loss = merit.loss(made)
    if not made.evaluation.ok or loss is None:
        return None
    checks = {item.limit: item for item in made.checks}
    found = [checks.get(limit) for limit in held]
    margins = [math.nan if item is None or item.margin is None else item.margin for item in found]
    figures = [math.nan if item is None or item.value is None else item.value for item in found]
    sign = -1.0 if merit.objective.maximise else 1.0
    rows = [sign / merit.scale * _slope(made.evaluation, merit.objective.figure, box)]
    for limit in held:
        sense = 1.0 if limit.sense == "<=" else -1.0
        rows.append(sense / limit.size * _slope(made.evaluation, limit.subject, box))
    return Response(np.array([loss, *(-m for m in margins)]), np.array([loss, *figures]), np.array(rows))


def _slope(evaluation: Evaluation, figure: str, box: Box) -> Array:
    """(n,) derivative of a figure by the scaled variables; NaN where it is not given by each of them."""
    slopes = (evaluation.gradient or {}).get(figure, {})
    spans = [high - low for low, high in zip(box.lower, box.upper, strict=True)]
    row = np.array([slopes.get(key, math.nan) * span for key, span in zip(box.keys, spans, strict=True)])
    norm = (evaluation.norms or {}).get(figure)
    value = getattr(evaluation.performance, figure, None)
    return row if norm is None or not norm.value or value is None else row * (value / norm.value)
