"""Rounds the optimum to what a workshop makes, and looks again: the nearest steps need not be the best or feasible."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce
from itertools import product

from fluxbore.design.study import Variable
from fluxbore.optimize.archive import Archive
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.problem import better

MOST_COMBINED = 4
"""Variables whose steps below and above are all combined; with more, each goes to its nearest step."""


def neighbours(archive: Archive, variables: Sequence[Variable], best: Candidate) -> list[dict[str, float]]:
    """The workshop's designs around ``best``, the nearest first: every combination of the steps below and above."""
    stepped = [variable for variable in variables if variable.resolution is not None]
    choices = []
    for variable in variables:
        index = archive.box.keys.index(variable.key)
        low, high = archive.box.lower[index], archive.box.upper[index]
        value = best.values[variable.key]
        steps = _steps(variable, value, low, high) or [value]
        choices.append(steps if len(stepped) <= MOST_COMBINED else steps[:1])

    def distance(values: Sequence[float]) -> float:
        moved = (
            (value - best.values[variable.key]) / variable.resolution
            for variable, value in zip(variables, values, strict=True)
            if variable.resolution is not None
        )
        return math.hypot(*moved)

    keys = [variable.key for variable in variables]
    return [dict(zip(keys, values, strict=True)) for values in sorted(product(*choices), key=distance)]


def _steps(variable: Variable, value: float, low: float, high: float) -> list[float]:
    """The multiples of the resolution next to ``value`` that lie within the bounds, the nearest first."""
    if variable.resolution is None:
        return [value]
    below = math.floor(value / variable.resolution + 1e-6)
    above = math.ceil(value / variable.resolution - 1e-6)
    # 12 digits: 29 steps of 0.05 mm are the 1.45 mm that a person would type.
    steps = {float(f"{count * variable.resolution:.12g}") for count in (below, above)}
    slack = 1e-9 * variable.resolution
    within = [min(max(step, low), high) for step in steps if low - slack <= step <= high + slack]
    return sorted(within, key=lambda step: (abs(step - value), step))


def count(variables: Sequence[Variable]) -> int:
    """The most designs that rounding asks for; 0 without a resolution."""
    stepped = sum(variable.resolution is not None for variable in variables)
    return 0 if not stepped else 2**stepped if stepped <= MOST_COMBINED else 1


def round_off(archive: Archive, variables: Sequence[Variable]) -> Candidate | None:
    """The best design at the workshop's resolution next to the archive's best, evaluated; None without a resolution.

    It may violate a limit where all its neighbours do: its checks tell.
    """
    best = archive.best
    if best is None or not count(variables):
        return None
    asked = neighbours(archive, variables, best)[: count(variables)]
    known = [values for values in asked if archive.knows(archive.box.point(values))]
    fresh = [values for values in asked if values not in known][: archive.left]
    made = archive.evaluate([values for values in asked if values in known or values in fresh])
    return reduce(lambda one, other: other if better(other, one, archive.objective) else one, made) if made else None
