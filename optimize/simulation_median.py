"""The median over seeds of a simulation's figures, which may be nested."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import median
from typing import Any


def median_figures(runs: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Figures of the same shape from every seed as one: of each number its median.

    What is no number is kept where all seeds agree and None where they differ; a list whose length differs is None.
    """
    return {name: _median([run.get(name) for run in runs]) for name in (runs[0] if runs else {})}


def _median(values: Sequence[Any]) -> Any:
    first = values[0]
    if any(value is None for value in values):
        return None
    if all(isinstance(value, Mapping) for value in values):
        return {name: _median([value.get(name) for value in values]) for name in first}
    if all(isinstance(value, (list, tuple)) for value in values):
        alike = len({len(value) for value in values}) == 1
        return [_median(items) for items in zip(*values, strict=True)] if alike else None
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
        found = median(values)
        return int(found) if all(isinstance(value, int) for value in values) and found == int(found) else found
    return first if all(value == first for value in values) else None
