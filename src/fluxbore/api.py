"""The Python interface: whatever the command line does, in the same words and with typed results."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryFile
from time import monotonic
from typing import Literal

from fluxbore.actuators import actuator_of
from fluxbore.design import spec as spec_module
from fluxbore.design.errors import FluxboreError, OutputError, SpecError
from fluxbore.design.gradient_keys import gradient_keys
from fluxbore.design.spec import Spec
from fluxbore.design.spec_file import to_toml
from fluxbore.design_result import DesignResult, chosen_spec, judged, searched
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import Evaluation, Fidelity
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.executor import TIME_LIMIT, Executor, local_executor
from fluxbore.optimize.folder import Folder, open_folder
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import SearchResult, SweepResult
from fluxbore.optimize.progress import Report as ProgressReport
from fluxbore.optimize.search import check_study, one_at_a_time, run_search
from fluxbore.optimize.sweep import recorded_sweeps, run_sweeps
from fluxbore.optimize.table import FILE_NAME, results_table
from fluxbore.report_file import write_report_file

DESIGN_FILE = "design.toml"
REPORT_FILE = "report.html"
CAD_FOLDER = "cad"

Say = Callable[[str], None]
"""Receives a sentence about what could not be done; the command line prints it."""


def load(path: Path | str, overrides: Mapping[str, str] | None = None) -> Spec:
    """Read a specification file; ``overrides`` are dotted keys with texts, as ``--set`` takes them."""
    return spec_module.load(path, overrides)


def evaluate(
    spec: Spec | Path | str, fidelity: Fidelity = "fem", *, gradient: bool | Sequence[str] = False
) -> Evaluation:
    """The figures of the specification's own design, by "fem" or by "network".

    gradient : whether their derivatives are wanted too, by the study's continuous variables; or by which dotted keys.
    They stand in ``.gradient``, figure -> key -> derivative in SI.

    Look at ``.ok`` first: a design that does not converge comes back without figures and with its reasons. Raises
    SpecError where there is nothing to take derivatives by, or no model that has them.
    """
    spec = _spec(spec)
    if gradient is False:
        return evaluate_design(spec, fidelity)
    keys = gradient_keys(spec, None if gradient is True else gradient)
    # As the study sees it: what the keys move is given, and what follows from them moves along.
    found = evaluate_design(spec.for_study().pinned(keys), fidelity, keys)
    if found.ok and found.gradient is None:
        route = "finite elements" if fidelity == "fem" else "the network"
        raise SpecError(f"gradient must be left out: an actuator of kind {spec.kind.name} has none by {route}.")
    return found


def sweep(
    spec: Spec | Path | str,
    folder: Path | str | None = None,
    *,
    fidelity: Fidelity = "fem",
    workers: int | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: ProgressReport | None = None,
) -> tuple[SweepResult, ...]:
    """Run the study's sweeps, in parallel and resumable.

    folder : gets ``results.csv`` and the journal from which an interrupted sweep goes on; without it nothing is kept.
    Raises SpecError where the study has no sweep.
    """
    spec = _spec(spec)
    _need(bool(spec.study.sweeps), "study.sweeps", "a sweep")
    with _workshop(spec, folder, workers, time_limit, force) as (place, journal, executor):
        results = run_sweeps(spec, journal, executor, fidelity, progress)
        if place is not None:
            _write_sweeps(place, results_table(spec, results))
    return results


def optimize(
    spec: Spec | Path | str,
    folder: Path | str | None = None,
    *,
    workers: int | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: ProgressReport | None = None,
) -> SearchResult:
    """Search for the study's best feasible design by finite elements.

    folder : gets ``design.toml``, ``results.csv`` and the journal. Raises SpecError where the study has no objective
    or no variables.
    """
    spec = _spec(spec)
    _need(spec.study.objective is not None, "study.objective", "a search")
    _need(bool(spec.study.variables), "study.variables", "a search")
    check_study(spec)
    with _workshop(spec, folder, workers, time_limit, force) as (place, journal, executor):
        result = run_search(spec, journal, executor, progress)
        if place is not None:
            earlier = recorded_sweeps(spec, journal, "fem") if journal is not None else ()
            place.write(FILE_NAME, results_table(spec, earlier, result.history))
            if result.chosen is not None:
                place.write(DESIGN_FILE, design_text(chosen_spec(spec, result.chosen, result)))
    return result


def export(
    spec: Spec | Path | str, folder: Path | str, *, force: bool = False, form: Literal["step", "fem"] = "step"
) -> list[Path]:
    """Write the design as STEP, the assembly and a file for each part in ``parts``; or as a FEMM model of its field.

    Raises MissingLibraryError where cadquery or libGL is missing, with the line that installs it; OutputError where
    the folder holds other files and is not to be taken by ``force``; SpecError for a kind of actuator without a model.
    """
    spec = _spec(spec)
    if form == "fem":
        return [_write_femm(spec, folder, force)]
    from fluxbore.geometry.solid import load_cadquery

    load_cadquery()  # before the folder is touched: without it there is nothing to write
    with open_folder(folder, spec, force) as place:
        return _write_cad(spec, place.path)


def report(
    spec: Spec | Path | str,
    path: Path | str,
    *,
    force: bool = False,
    picture: bool = True,
    command: Sequence[str] | None = None,
) -> DesignResult:
    """Write the report of the specification's own design, without sweeps and search, as one offline HTML file.

    Raises OutputError where the file exists and is not to be replaced by ``force``.
    """
    spec, path = _spec(spec), Path(path)
    if path.exists() and not force:
        raise OutputError(f"{path} must not exist yet; it does (see --force).")
    _check_writable(path.parent)
    found = judged(spec, evaluate_design(spec))
    return replace(found, files=(write_report_file(spec, found, path, None, picture, command, None),))


def design(
    spec: Spec | Path | str,
    folder: Path | str,
    *,
    workers: int | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: ProgressReport | None = None,
    say: Say | None = None,
    picture: bool = True,
    command: Sequence[str] | None = None,
) -> DesignResult:
    """The whole way: sweeps, search, STEP files, report; in ``folder``, where an interrupted run goes on.

    Writes ``results.csv``, ``report.html`` and, of a design that can be made, ``design.toml`` and ``cad/*.step``.
    Without an objective and variables the design is evaluated as it is.
    """
    begin = monotonic()
    spec = _spec(spec)
    check_study(spec)
    with _workshop(spec, folder, workers, time_limit, force) as (place, journal, executor):
        assert place is not None
        sweeps = run_sweeps(spec, journal, executor, "fem", progress) if spec.study.sweeps else ()
        separate = None
        if spec.study.objective is not None and spec.study.variables:
            search = run_search(spec, journal, executor, progress)
            if search.ending == "interrupted":
                raise KeyboardInterrupt
            found = searched(spec, search)
            separate = one_at_a_time(spec, sweeps, journal, executor)
        else:
            found = judged(spec, _evaluated(spec, journal, executor))
        history = found.search.history if found.search is not None else ()
        files = [place.write(FILE_NAME, results_table(spec, sweeps, history))]
        if found.search is None or found.search.chosen is not None:
            files.append(place.write(DESIGN_FILE, design_text(found.spec)))
            try:
                files += _write_cad(found.spec, place.path / CAD_FOLDER)
            except FluxboreError as error:
                found = replace(found, warnings=(f"No STEP files: {error}",))
        found = replace(found, sweeps=tuple(sweeps))
        replayed = found.search is not None and found.search.replayed
        seconds = None if replayed else monotonic() - begin
        files.append(write_report_file(spec, found, place.path / REPORT_FILE, separate, picture, command, seconds))
        if say is not None:
            for warning in found.warnings:
                say(warning)
    return replace(found, files=tuple(files))


def _check_writable(folder: Path) -> None:
    """Fail before the work, not after it, where a folder cannot take the result."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise OutputError(f"{folder} cannot be written: {error.strerror or error}.") from error


def design_text(spec: Spec) -> str:
    """The text of design.toml."""
    return to_toml(spec, f"{spec.word('actuator.name')}: the design that fluxbore chose, every value exact.")


def _spec(spec: Spec | Path | str) -> Spec:
    return spec if isinstance(spec, Spec) else load(spec)


def _need(present: bool, key: str, what: str) -> None:
    if not present:
        raise SpecError(f"{key} must be given for {what}; got none.")


def _write_sweeps(place: Folder, table: str) -> None:
    """Write the sweeps' table, unless the one that stands there begins with it: a search's rows follow."""
    target = place.path / FILE_NAME
    before = target.read_text(encoding="utf-8") if place.resumed and target.exists() else ""
    if not before.startswith(table):
        place.write(FILE_NAME, table)


def _write_cad(spec: Spec, folder: Path) -> list[Path]:
    from fluxbore.geometry.step import write_step

    return write_step(actuator_of(spec).assembly(spec), folder)


def _write_femm(spec: Spec, folder: Path | str, force: bool) -> Path:
    from fluxbore.fem.femm_writer import write_text
    from fluxbore.geometry.step import file_name

    make = actuator_of(spec).femm_model
    _need(make is not None, "actuator.kind", "a FEMM model")
    assert make is not None
    text = write_text(make(spec))
    with open_folder(folder, spec, force) as place:
        return place.write(f"{file_name(spec.word('actuator.name'))}.fem", text)


def _evaluated(spec: Spec, journal: Journal | None, executor: Executor) -> Evaluation:
    """The start design through the journal."""
    return Evaluator(spec, executor, journal, "fem", evaluate_design, "evaluate").all([{}])[0].evaluation


@contextmanager
def _workshop(
    spec: Spec, folder: Path | str | None, workers: int | None, time_limit: float | None, force: bool
) -> Iterator[tuple[Folder | None, Journal | None, Executor]]:
    """Folder, journal and workers of one run."""
    with ExitStack() as stack:
        executor = stack.enter_context(local_executor(workers, time_limit=time_limit or TIME_LIMIT))
        place = stack.enter_context(open_folder(folder, spec, force)) if folder is not None else None
        yield place, place.journal if place is not None else None, executor
