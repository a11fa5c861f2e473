"""The Python interface to benchmarks in simulated time."""

from __future__ import annotations

import json
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path

from fluxbore.actuators import ACTUATORS, actuator_of
from fluxbore.design.errors import SpecError, shown
from fluxbore.design.spec import Spec
from fluxbore.design_result import judged
from fluxbore.optimize.benchmark import Benchmark, BenchmarkResult
from fluxbore.optimize.benchmark_plain import result_plain
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import Evaluation, Fidelity
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.folder import Folder
from fluxbore.optimize.progress import Report
from fluxbore.optimize.simulation_record import simulation_key
from fluxbore.optimize.simulation_run import KIND, run_benchmark
from fluxbore.optimize.simulation_table import FILE_NAME, TRACES, traces_table, trials_table
from fluxbore.reading import as_spec
from fluxbore.report_file import REPORT_FILE, write_report_file
from fluxbore.workshop import DESIGN_FILE, Workshop, workshop

FIGURES_FILE = "figures.json"

MOST_SEEDS = 1000
LARGEST_SEED = 2**31 - 1


def simulate(
    spec: Spec | Path | str,
    benchmark: str | None = None,
    folder: Path | str | None = None,
    *,
    seeds: int | None = None,
    seed: int = 1,
    against: Sequence[Spec | Path | str] = (),
    vary: bool = False,
    fidelity: Fidelity = "fem",
    workers: int | None = None,
    scheduler: str | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: Report | None = None,
    picture: bool = True,
    command: Sequence[str] | None = None,
) -> BenchmarkResult:
    """Put the specification's design through a benchmark of its kind, such as "mcfc"; without a name, the only one.

    seeds : how many, `Benchmark.usual_seeds` where not given, and one where nothing is drawn by chance; the first is
    ``seed``, each other one more. against : other designs, put through the same with the specification's own section
    of the benchmark, so that only the designs differ. vary : whether the first seed is run under the benchmark's other
    conditions too, for a table of sensitivities. folder : gets ``results.csv``, ``traces.parquet``, ``figures.json``,
    ``report.html`` and the journal, from which the same run takes what it has.
    fidelity : what computes the field that the mover passes. picture : whether the report has a rendered view.

    Look at ``.ok`` first: a design whose field does not converge comes back without figures and with its reasons.
    Raises SpecError for a benchmark that the kind does not have, for seeds beyond their range and for designs that
    cannot be set against this one; OutputError for a folder with other results.
    """
    spec = as_spec(spec)
    chosen = benchmark_of(spec, benchmark)
    numbers = _seeds(chosen, seeds, seed)
    designs = [(spec.word("actuator.name"), spec), *_others(chosen, spec, against)]
    with workshop(spec, folder, workers, scheduler, time_limit, force, tables="simulation") as shop:
        place = shop.folder
        result = run_benchmark(
            chosen,
            designs,
            numbers,
            shop.executor,
            shop.journal,
            fidelity,
            progress,
            place.path if place is not None else None,
            vary,
        )
        if place is None or not result.ok:
            return result
        return replace(result, files=tuple(_write(place, shop, spec, result, fidelity, picture, command)))


def benchmark_of(spec: Spec, name: str | None = None) -> Benchmark:
    """The benchmark of this name, or the only one. Raises SpecError where the specification's kind does not have it."""
    known = actuator_of(spec).benchmarks
    if name is None and len(known) == 1:
        return next(iter(known.values()))
    if name is not None and name in known:
        return known[name]
    got = "none" if name is None else shown(name)
    if known:
        raise SpecError(
            f"benchmark must be one of {', '.join(known)} for an actuator of kind {spec.kind.name}; got {got}."
        )
    having = "; ".join(
        f"{kind} has {', '.join(actuator.benchmarks)}" for kind, actuator in ACTUATORS.items() if actuator.benchmarks
    )
    raise SpecError(
        f"benchmark must be one of the actuator's kind, and kind {spec.kind.name} has none ({having}); got {got}."
    )


def _seeds(benchmark: Benchmark, wanted: int | None, first: int) -> tuple[int, ...]:
    count = wanted if wanted is not None else benchmark.usual_seeds if benchmark.random else 1
    if not benchmark.random and count > 1:
        raise SpecError(
            f"seeds must be 1 for the benchmark {benchmark.name}, in which nothing is drawn by chance; "
            f"got {shown(count)}."
        )
    if not 1 <= count <= MOST_SEEDS:
        raise SpecError(f"seeds must be from 1 to {MOST_SEEDS}; got {shown(count)}.")
    if not 0 <= first <= LARGEST_SEED:
        raise SpecError(f"seed must be from 0 to {LARGEST_SEED}; got {shown(first)}.")
    return tuple(range(first, first + count))


def _others(benchmark: Benchmark, spec: Spec, against: Sequence[Spec | Path | str]) -> list[tuple[str, Spec]]:
    """The other designs by their labels, on the specification's own test stand."""
    found: list[tuple[str, Spec]] = []
    labels = {spec.word("actuator.name")}
    for item in against:
        other = as_spec(item)
        label = other.word("actuator.name") if isinstance(item, Spec) else _label(Path(item), labels)
        if other.kind is not spec.kind:
            raise SpecError(
                f"against must name designs of kind {spec.kind.name}, as the specification's is; "
                f"{shown(label)} is of kind {other.kind.name}."
            )
        if label in labels:
            raise SpecError(f"against must name every design once, and not the specification's; got {shown(label)}.")
        labels.add(label)
        found.append((label, on_the_stand_of(spec, benchmark, other)))
    return found


def _label(path: Path, taken: Collection[str]) -> str:
    """What a design is called by its file, design.toml by its folder; the whole path where that name is taken."""
    short = path.parent.name if path.name == DESIGN_FILE and path.parent.name else path.stem
    return short if short not in taken else str(path.with_suffix(""))


def on_the_stand_of(spec: Spec, benchmark: Benchmark, other: Spec) -> Spec:
    """The other design with the specification's keys of the benchmark, and only those; what the benchmark counts to
    the design stays its own."""

    def stands(key: str) -> bool:
        return key.startswith(benchmark.section) and key.removeprefix(benchmark.section) not in benchmark.own

    given = {key: value for key, value in other.given.items() if not stands(key)}
    own = {key: value for key, value in spec.given.items() if stands(key)}
    notes = tuple(note for note in other.notes if not stands(note.key))
    return replace(other, given={**given, **own}, notes=notes)


def _write(
    place: Folder,
    shop: Workshop,
    spec: Spec,
    result: BenchmarkResult,
    fidelity: Fidelity,
    picture: bool,
    command: Sequence[str] | None,
) -> list[Path]:
    first = result.run.simulations[0]
    key = simulation_key(result.benchmark, spec, fidelity, result.run.field, first.seed)
    files = [
        place.write(FILE_NAME, trials_table(result.runs)),
        place.write(TRACES, traces_table(first, key)),
        place.write(FIGURES_FILE, json.dumps(result_plain(result), indent=1, allow_nan=False) + "\n"),
    ]
    found = replace(judged(spec, _by_fem(spec, shop, result, fidelity)), simulation=result)
    files.append(write_report_file(spec, found, place.path / REPORT_FILE, None, picture, command, None))
    return files


def _by_fem(spec: Spec, shop: Workshop, result: BenchmarkResult, fidelity: Fidelity) -> Evaluation:
    """The design as a report shows it, whatever the field of the simulation was computed by."""
    if fidelity == "fem":
        return result.run.evaluation
    return Evaluator(spec, shop.executor, shop.journal, "fem", evaluate_design, KIND).all([{}])[0].evaluation
