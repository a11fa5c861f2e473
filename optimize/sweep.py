"""Runs the grids of a study: in parallel, resumable, one row for every design whatever becomes of it."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product

from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective, Sweep
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import Evaluation, Fidelity
from fluxbore.optimize.evaluator import Evaluate, Evaluator
from fluxbore.optimize.executor import Executor, SerialExecutor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import SweepResult, SweepRow
from fluxbore.optimize.progress import Report, Tracker

DEFAULT_OBJECTIVE = Objective("force_constant", maximise=True)
"""What "best so far" means in a sweep of a specification that names no objective."""


def run_sweeps(
    spec: Spec,
    journal: Journal | None,
    executor: Executor,
    fidelity: Fidelity = "fem",
    progress: Report | None = None,
    evaluate: Evaluate = evaluate_design,
) -> tuple[SweepResult, ...]:
    """Every sweep of the study, rows in grid order; what the journal holds is not computed again.

    A design that cannot be built, does not converge or crashes its process is a row with its reason. Raises SpecError
    where a sweep's axes over-determine the actuator, OutputError where the journal cannot be written.
    """
    base = spec.for_study()
    for sweep in spec.study.sweeps:
        base.pinned(axis.key for axis in sweep.axes)
    grids = [grid(spec, sweep) for sweep in spec.study.sweeps]
    designs = [values for rows in grids for values in rows]
    tracker = Tracker("sweep", len(designs), progress, spec.study.objective or DEFAULT_OBJECTIVE)
    found: dict[int, Evaluation] = {}
    for item in Evaluator(base, executor, journal, fidelity, evaluate, "sweep").each(designs):
        found[item.index] = item.evaluation
        tracker.add(numbers(designs[item.index]), item.evaluation, reused=item.reused)
    results, begin = [], 0
    for sweep, rows in zip(spec.study.sweeps, grids, strict=True):
        made = (SweepRow(numbers(values), found[begin + i]) for i, values in enumerate(rows))
        results.append(SweepResult(sweep, tuple(made)))
        begin += len(rows)
    return tuple(results)


def recorded_sweeps(
    spec: Spec, journal: Journal | None, fidelity: Fidelity = "fem", evaluate: Evaluate = evaluate_design
) -> tuple[SweepResult, ...]:
    """Those sweeps of the study that the journal holds whole, as `run_sweeps` gave them; nothing is computed."""
    evaluator = Evaluator(spec.for_study(), SerialExecutor(), journal, fidelity, evaluate, "sweep")
    results = []
    for sweep in spec.study.sweeps if journal is not None else ():
        rows = []
        for values in grid(spec, sweep):
            evaluation = evaluator.known(values)
            if evaluation is None:
                break
            rows.append(SweepRow(numbers(values), evaluation))
        else:
            results.append(SweepResult(sweep, tuple(rows)))
    return tuple(results)


def grid(spec: Spec, sweep: Sweep) -> list[dict[str, Value]]:
    """The sweep's designs as values at its axes' keys; the last axis runs fastest. Counts are whole numbers."""
    counts = {key.name for key in spec.kind.keys if key.kind == "integer"}
    keys = [axis.key for axis in sweep.axes]
    return [
        {key: int(value) if key in counts else value for key, value in zip(keys, point, strict=True)}
        for point in product(*(axis.values for axis in sweep.axes))
    ]


def numbers(values: Mapping[str, Value]) -> dict[str, float]:
    """The values without the words among them."""
    return {key: value for key, value in values.items() if not isinstance(value, str)}
