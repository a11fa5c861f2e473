"""results.csv: one line for each design of a study, SI units, floats that read back exactly."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence

from fluxbore.design.errors import FluxboreError
from fluxbore.design.keys import Value
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import Candidate, SweepResult

FILE_NAME = "results.csv"


def results_table(spec: Spec, sweeps: Sequence[SweepResult], candidates: Sequence[Candidate] = ()) -> str:
    """The text of results.csv: the sweeps' rows in grid order, then a search's designs in the order of its asking.

    Header: the dotted keys that anything moves, the figures' names, ``status``, ``reason``. A key that a row's own
    sweep does not move has the value that follows for that row's design; where there is no such design, the start's.
    """
    axes = (axis.key for result in sweeps for axis in result.sweep.axes)
    keys = list(dict.fromkeys([*axes, *(key for candidate in candidates for key in candidate.values)]))
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow([*keys, *FIGURES, "status", "reason"])
    base = spec.for_study()
    for values, evaluation in _rows(sweeps, candidates):
        writer.writerow(
            [*_shown(_moved(base, keys, values)), *_figures(evaluation), evaluation.status, _reason(evaluation)]
        )
    return buffer.getvalue()


def _rows(
    sweeps: Sequence[SweepResult], candidates: Sequence[Candidate]
) -> Iterable[tuple[Mapping[str, float], Evaluation]]:
    for result in sweeps:
        for row in result.rows:
            yield row.values, row.evaluation
    for candidate in candidates:
        yield candidate.values, candidate.evaluation


def _moved(base: Spec, keys: Sequence[str], values: Mapping[str, float]) -> list[Value | None]:
    try:
        resolved = base.with_values(values).values
    except (FluxboreError, ArithmeticError, KeyError):
        resolved = base.values
    return [values.get(key, resolved.get(key)) for key in keys]


def _figures(evaluation: Evaluation) -> list[str]:
    return _shown([getattr(evaluation.performance, name) for name in FIGURES])


def _shown(values: Iterable[Value | None]) -> list[str]:
    return ["" if value is None else value if isinstance(value, str) else repr(value) for value in values]


def _reason(evaluation: Evaluation) -> str:
    """All reasons on one line: a line break inside a field breaks the simpler readers."""
    return " ".join(" ".join(evaluation.reasons).split())
