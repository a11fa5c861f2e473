"""results.csv: one line for each design of a study, SI units, floats that read back exactly."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Mapping, Sequence

from fluxbore.design.errors import FluxboreError
from fluxbore.design.keys import Value
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import Candidate, SweepResult

FILE_NAME = "results.csv"

Cell = Value | None
"""A number, a word, or nothing where a figure is not known."""


def results_table(spec: Spec, sweeps: Sequence[SweepResult], candidates: Sequence[Candidate] = ()) -> str:
    """The text of results.csv: the `columns` as header, then the `cells` of each design."""
    keys = moved_keys(sweeps, candidates)
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(columns(keys))
    writer.writerows(_shown(row) for row in cells(spec, keys, sweeps, candidates))
    return buffer.getvalue()


def moved_keys(sweeps: Sequence[SweepResult], candidates: Sequence[Candidate]) -> tuple[str, ...]:
    """The dotted keys that anything moves, the sweeps' axes first, each once."""
    axes = (axis.key for result in sweeps for axis in result.sweep.axes)
    return tuple(dict.fromkeys([*axes, *(key for candidate in candidates for key in candidate.values)]))


def columns(keys: Sequence[str]) -> list[str]:
    """The moved keys, the figures' names, ``status``, ``reason``."""
    return [*keys, *FIGURES, "status", "reason"]


def cells(
    spec: Spec, keys: Sequence[str], sweeps: Sequence[SweepResult], candidates: Sequence[Candidate]
) -> Iterator[list[Cell]]:
    """The designs' rows (SI): the sweeps' in grid order, then a search's designs in the order of its asking.

    A key that a row's own sweep does not move has the value that follows for that row's design; where there is no such
    design, the start's.
    """
    base = spec.for_study()
    for values, evaluation in _rows(sweeps, candidates):
        figures: list[Cell] = [getattr(evaluation.performance, name) for name in FIGURES]
        yield [*_moved(base, keys, values), *figures, evaluation.status, _reason(evaluation)]


def _rows(
    sweeps: Sequence[SweepResult], candidates: Sequence[Candidate]
) -> Iterable[tuple[Mapping[str, float], Evaluation]]:
    for result in sweeps:
        for row in result.rows:
            yield row.values, row.evaluation
    for candidate in candidates:
        yield candidate.values, candidate.evaluation


def _moved(base: Spec, keys: Sequence[str], values: Mapping[str, float]) -> list[Cell]:
    try:
        resolved = base.with_values(values).values
    except (FluxboreError, ArithmeticError, KeyError):
        resolved = base.values
    return [values.get(key, resolved.get(key)) for key in keys]


def _shown(values: Iterable[Cell]) -> list[str]:
    return ["" if value is None else value if isinstance(value, str) else repr(value) for value in values]


def _reason(evaluation: Evaluation) -> str:
    """All reasons on one line: a line break inside a field breaks the simpler readers."""
    return " ".join(" ".join(evaluation.reasons).split())
