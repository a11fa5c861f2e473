"""Puts designs through a benchmark: the field first, then every seed, each result from the journal where it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import monotonic
from typing import Any

from fluxbore.design.dynamics.simulation import Simulation
from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.design.spec import Spec
from fluxbore.optimize.benchmark import Benchmark, BenchmarkResult, DesignRun
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import FAILED, OK, Evaluation, Fidelity, failure
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.executor import Executor
from fluxbore.optimize.journal import Journal, strict
from fluxbore.optimize.progress import Progress, Report
from fluxbore.optimize.simulation_median import median_figures
from fluxbore.optimize.simulation_record import from_plain, simulation_key, to_plain
from fluxbore.optimize.simulation_table import TRACES, read_traces

KIND = "simulation"

REFUSED = "refused"
"""The status of a design that the benchmark cannot take, such as one whose stroke is too short for it."""


@dataclass(slots=True)
class _Design:
    """What is known of one design so far: its seeds come as they are computed."""

    label: str
    spec: Spec
    evaluation: Evaluation
    surroundings: Any = None
    status: str = OK
    reasons: tuple[str, ...] = ()
    seeds: dict[int, Simulation] = field(default_factory=dict)

    def fail(self, status: str, reasons: Sequence[str]) -> None:
        self.status, self.reasons = status, tuple(reasons)

    def run(self) -> DesignRun:
        whole = tuple(self.seeds[seed] for seed in sorted(self.seeds)) if self.status == OK else ()
        figures = median_figures([simulation.figures for simulation in whole])
        return DesignRun(
            self.label, self.spec, self.evaluation, self.surroundings, whole, figures, self.status, tuple(self.reasons)
        )


def run_benchmark(
    benchmark: Benchmark,
    designs: Sequence[tuple[str, Spec]],
    seeds: Sequence[int],
    executor: Executor,
    journal: Journal | None = None,
    fidelity: Fidelity = "fem",
    progress: Report | None = None,
    traces: Path | None = None,
    vary: bool = False,
) -> BenchmarkResult:
    """Every design with every seed, in the executor's processes.

    designs : by label, the study's own first; its first seed comes with traces. traces : a folder whose traces are
    taken where they are that seed's. vary : whether the own design's variations are wanted too.
    Another design without figures keeps its reasons, and does not stop the others.

    Raises SpecError where the study's own design cannot be put through it as its specification stands.
    """
    seen = [_seen(benchmark, label, spec, executor, journal, fidelity) for label, spec in designs]
    _check(seen[0])
    count = len(seen)
    seen += _varied(benchmark, seen[0]) if vary and seen[0].status == OK else []
    keys: dict[tuple[int, int], str] = {}
    waiting: list[tuple[int, int]] = []
    for number, design in enumerate(seen):
        wanted = seeds if number < count else seeds[:1]
        for seed in wanted if design.status == OK else ():
            place = number, seed
            keys[place] = simulation_key(benchmark, design.spec, fidelity, design.surroundings, seed)
            known = _known(journal, keys[place], traces if place == (0, seeds[0]) else None, place == (0, seeds[0]))
            if known is None:
                waiting.append(place)
            else:
                design.seeds[seed] = known
    reused = len(keys) - len(waiting)
    tasks = (
        (benchmark.simulate, seen[number].spec, seen[number].surroundings, seed, (number, seed) == (0, seeds[0]))
        for number, seed in waiting
    )
    begin, done, failed = monotonic(), reused, 0
    _tell(progress, done, len(keys), reused, failed, begin)
    for outcome in executor.run(_simulate, tasks):
        number, seed = waiting[outcome.index]
        done += 1
        if isinstance(outcome.value, Simulation):
            seen[number].seeds[seed] = _recorded(journal, keys[number, seed], outcome.value)
        elif isinstance(outcome.value, str):
            failed += 1
            seen[number].fail(REFUSED, (outcome.value,))
            _check(seen[0])
        else:
            failed += 1
            seen[number].fail(FAILED, (outcome.failure or "The simulation failed.",))
        _tell(progress, done, len(keys), reused, failed, begin)
    runs = tuple(design.run() for design in seen)
    return BenchmarkResult(benchmark, tuple(seeds), runs[0], runs[1:count], runs[count:], reused)


def _seen(
    benchmark: Benchmark, label: str, spec: Spec, executor: Executor, journal: Journal | None, fidelity: Fidelity
) -> _Design:
    """The design with its field."""
    evaluator = Evaluator(spec, executor, journal, fidelity, evaluate, KIND)
    try:
        around_it = benchmark.designs(spec)
    except FluxboreError as error:
        return _Design(label, spec, failure(fidelity, REFUSED, str(error)), None, REFUSED, (str(error),))
    own, *around = [item.evaluation for item in evaluator.all([{}, *around_it])]
    design = _Design(label, spec, own)
    bad = next((item for item in (own, *around) if not item.ok), None)
    if bad is not None:
        design.fail(bad.status, bad.reasons)
        return design
    try:
        design.surroundings = benchmark.field(spec, around)
    except FluxboreError as error:
        design.fail(REFUSED, (str(error),))
    return design


def _varied(benchmark: Benchmark, own: _Design) -> list[_Design]:
    """The own design under each of the benchmark's other conditions, in the same field."""
    found = []
    for label, values in benchmark.variations(own.spec, own.surroundings):
        try:
            found.append(_Design(label, own.spec.with_values(values), own.evaluation, own.surroundings))
        except FluxboreError as error:  # beyond a key's limits
            found.append(_Design(label, own.spec, own.evaluation, own.surroundings, REFUSED, (str(error),)))
    return found


def _check(own: _Design) -> None:
    """A refused design is what the specification asks for: its sentence is the user's."""
    if own.status == REFUSED:
        raise SpecError(" ".join(own.reasons))


def _known(journal: Journal | None, key: str, folder: Path | None, traced: bool) -> Simulation | None:
    """The simulation of this key where nothing of it has to be computed."""
    plain = journal.noted(key) if journal is not None else None
    if plain is None:
        return None
    simulation = from_plain(plain)
    if not traced:
        return simulation
    return read_traces(folder / TRACES, key, simulation) if folder is not None else None


def _recorded(journal: Journal | None, key: str, simulation: Simulation) -> Simulation:
    """The simulation as the journal gives it back, and its traces."""
    plain = to_plain(simulation)
    plain = journal.note(key, KIND, plain) if journal is not None else strict(plain)
    settled = from_plain(plain)
    pairs = zip(settled.trials, simulation.trials, strict=True)
    return replace(settled, trials=tuple(replace(trial, trace=other.trace) for trial, other in pairs))


def _simulate(task: tuple[Any, Spec, Any, int, bool]) -> Simulation | str:
    """Runs in the worker; a sentence where the design cannot be simulated."""
    simulate, spec, seen, seed, traces = task
    try:
        result: Simulation = simulate(spec, seen, seed, traces)
    except FluxboreError as error:
        return str(error)
    return result


def _tell(progress: Report | None, done: int, total: int, reused: int, failed: int, begin: float) -> None:
    if progress is None or total == 0:
        return
    rate = (done - reused) / max(monotonic() - begin, 1e-9) if done > reused + 1 else None
    left = (total - done) / rate if rate else None
    progress(Progress(KIND, done, total, reused, failed, None, None, None, rate, left))
