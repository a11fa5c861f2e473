"""The Python interface: whatever the command line does, in the same words and with typed results."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from fluxbore.actuators import actuator_of
from fluxbore.design import spec as spec_module
from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.design.spec import Spec
from fluxbore.design.spec_file import to_toml
from fluxbore.design.study import Constraint
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import Evaluation, Fidelity
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.executor import Executor, local_executor
from fluxbore.optimize.folder import Folder, open_folder
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.outcome import Candidate, SearchResult, SweepResult
from fluxbore.optimize.progress import Report as ProgressReport
from fluxbore.optimize.search import one_at_a_time, run_search
from fluxbore.optimize.sweep import run_sweeps
from fluxbore.optimize.table import FILE_NAME, results_table

DESIGN_FILE = "design.toml"
REPORT_FILE = "report.html"
CAD_FOLDER = "cad"

Say = Callable[[str], None]
"""Receives a sentence about what could not be done; the command line prints it."""


@dataclass(frozen=True, slots=True)
class DesignResult:
    """What `design` found and wrote.

    spec, evaluation : the design to make, by finite elements; the start where the study found nothing feasible.
    feasible : whether that design meets every limit of the study.
    warnings : sentences on what could not be made, such as STEP files without libGL.
    """

    spec: Spec
    evaluation: Evaluation
    feasible: bool
    search: SearchResult | None
    sweeps: tuple[SweepResult, ...]
    files: tuple[Path, ...]
    warnings: tuple[str, ...]


def load(path: Path | str, overrides: Mapping[str, str] | None = None) -> Spec:
    """Read a specification file; ``overrides`` are dotted keys with texts, as ``--set`` takes them."""
    return spec_module.load(path, overrides)


def evaluate(spec: Spec | Path | str, fidelity: Fidelity = "fem") -> Evaluation:
    """The figures of the specification's own design, by "fem" or by "network".

    Look at ``.ok`` first: a design that does not converge comes back without figures and with its reasons.
    """
    return evaluate_design(_spec(spec), fidelity)


def sweep(
    spec: Spec | Path | str,
    folder: Path | str | None = None,
    *,
    fidelity: Fidelity = "fem",
    workers: int | None = None,
    force: bool = False,
    progress: ProgressReport | None = None,
) -> tuple[SweepResult, ...]:
    """Run the study's sweeps, in parallel and resumable.

    folder : gets ``results.csv`` and the journal from which an interrupted sweep goes on; without it nothing is kept.
    Raises SpecError where the study has no sweep.
    """
    spec = _spec(spec)
    _need(bool(spec.study.sweeps), "study.sweeps", "a sweep")
    with _workshop(spec, folder, workers, force) as (place, journal, executor):
        results = run_sweeps(spec, journal, executor, fidelity, progress)
        if place is not None:
            place.write(FILE_NAME, results_table(spec, results))
    return results


def optimize(
    spec: Spec | Path | str,
    folder: Path | str | None = None,
    *,
    workers: int | None = None,
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
    with _workshop(spec, folder, workers, force) as (place, journal, executor):
        result = run_search(spec, journal, executor, progress)
        if place is not None:
            place.write(FILE_NAME, results_table(spec, (), result.history))
            if result.chosen is not None:
                place.write(DESIGN_FILE, design_text(chosen_spec(spec, result.chosen, result)))
    return result


def export(spec: Spec | Path | str, folder: Path | str) -> list[Path]:
    """Write the design as STEP: the assembly, and a file for each part in ``parts``.

    Raises MissingLibraryError where cadquery or libGL is missing, with the line that installs it.
    """
    from fluxbore.geometry.step import write_step

    spec = _spec(spec)
    return write_step(actuator_of(spec).assembly(spec), Path(folder))


def report(
    spec: Spec | Path | str, path: Path | str, *, picture: bool = True, command: Sequence[str] | None = None
) -> Path:
    """Write the report of the specification's own design, without its study, as one offline HTML file."""
    spec = _spec(spec)
    start = evaluate_design(spec)
    findings = DesignResult(spec, start, True, None, (), (), ())
    return _write_report(spec, findings, Path(path), None, picture, command, None)


def design(
    spec: Spec | Path | str,
    folder: Path | str,
    *,
    workers: int | None = None,
    force: bool = False,
    progress: ProgressReport | None = None,
    say: Say | None = None,
    picture: bool = True,
    command: Sequence[str] | None = None,
) -> DesignResult:
    """The whole way: sweeps, search, STEP files, report; in ``folder``, where an interrupted run goes on.

    Writes ``results.csv``, ``design.toml``, ``cad/*.step`` and ``report.html``. Without a study the design is
    evaluated as it is.
    """
    from time import monotonic

    begin = monotonic()
    spec = _spec(spec)
    warnings: list[str] = []
    with _workshop(spec, folder, workers, force) as (place, journal, executor):
        assert place is not None
        sweeps = run_sweeps(spec, journal, executor, "fem", progress) if spec.study.sweeps else ()
        search = None
        separate = None
        if spec.study.objective is not None and spec.study.variables:
            search = run_search(spec, journal, executor, progress)
            separate = one_at_a_time(spec, sweeps, journal, executor)
        history = search.history if search is not None else ()
        files = [place.write(FILE_NAME, results_table(spec, sweeps, history))]
        chosen = search.chosen if search is not None else None
        final = chosen_spec(spec, chosen, search) if chosen is not None and search is not None else spec
        evaluation = chosen.evaluation if chosen is not None else _evaluated(spec, journal, executor)
        files.append(place.write(DESIGN_FILE, design_text(final)))
        try:
            files += export(final, place.path / CAD_FOLDER)
        except FluxboreError as error:
            warnings.append(f"No STEP files: {error}")
        feasible = chosen is not None or search is None
        findings = DesignResult(final, evaluation, feasible, search, tuple(sweeps), tuple(files), tuple(warnings))
        target = place.path / REPORT_FILE
        seconds = monotonic() - begin
        files.append(_write_report(spec, findings, target, separate, picture, command, seconds))
        if say is not None:
            for warning in warnings:
                say(warning)
    return replace(findings, files=tuple(files))


def chosen_spec(spec: Spec, chosen: Candidate, search: SearchResult) -> Spec:
    """The chosen design as a specification of its own; limits relative to the start become numbers."""
    final = spec.for_study().with_values(chosen.values)
    constraints = tuple(
        Constraint(
            check.limit.subject,
            check.limit.limit if check.limit.sense == "<=" else None,
            check.limit.limit if check.limit.sense == ">=" else None,
        )
        for check in search.start.checks
    )
    return replace(final, study=replace(final.study, constraints=constraints))


def design_text(spec: Spec) -> str:
    """The text of design.toml."""
    return to_toml(spec, f"{spec.word('actuator.name')}: the design that fluxbore chose, every value exact.")


def _spec(spec: Spec | Path | str) -> Spec:
    return spec if isinstance(spec, Spec) else load(spec)


def _need(present: bool, key: str, what: str) -> None:
    if not present:
        raise SpecError(f"{key} must be given for {what}; got none.")


def _evaluated(spec: Spec, journal: Journal | None, executor: Executor) -> Evaluation:
    """The start design through the journal."""
    return Evaluator(spec, executor, journal, "fem", evaluate_design, "evaluate").all([{}])[0].evaluation


@contextmanager
def _workshop(
    spec: Spec, folder: Path | str | None, workers: int | None, force: bool
) -> Iterator[tuple[Folder | None, Journal | None, Executor]]:
    """Folder, journal and workers of one run."""
    with ExitStack() as stack:
        executor = stack.enter_context(local_executor(workers))
        place = stack.enter_context(open_folder(folder, spec, force)) if folder is not None else None
        yield place, place.journal if place is not None else None, executor


def _write_report(
    spec: Spec,
    findings: DesignResult,
    path: Path,
    separate: Candidate | None,
    picture: bool,
    command: Sequence[str] | None,
    seconds: float | None,
) -> Path:
    from fluxbore import report_content as gather
    from fluxbore.reports.content import Picture, ReportContent
    from fluxbore.reports.page import write_report

    final = findings.spec
    studied = findings.search is not None and findings.search.chosen is not None
    views = actuator_of(final)
    parts = views.assembly(final)
    start = findings.search.start.evaluation if findings.search is not None else findings.evaluation
    content = ReportContent(
        spec=spec,
        chosen_spec=final if studied else None,
        start=start,
        chosen=findings.evaluation if studied else None,
        start_network=evaluate_design(spec, "network"),
        chosen_network=evaluate_design(final, "network") if studied else None,
        search=findings.search,
        sweeps=findings.sweeps,
        one_at_a_time=separate,
        flux_map=views.flux_map(final) if views.flux_map is not None and findings.evaluation.ok else None,
        start_flux_map=views.flux_map(spec) if views.flux_map is not None and studied and start.ok else None,
        slots=views.slots(final) if views.slots is not None else None,
        parts=gather.part_rows(final, parts),
        assembly=parts,
        picture=gather.picture(parts) if picture else Picture(None, "No picture was asked for."),
        checked=gather.checked(parts),
        not_checked=(*gather.NOT_CHECKED, *findings.warnings),
        provenance=gather.provenance(spec, findings.evaluation, command),
        seconds=seconds,
    )
    return write_report(content, path)
