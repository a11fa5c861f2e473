"""The Python interface: whatever the command line does, in the same words and with typed results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryFile
from time import monotonic

from fluxbore.comparing import COMPARISON_FILE, ComparisonResult, compare
from fluxbore.design.errors import FluxboreError, OutputError
from fluxbore.design.spec import Spec
from fluxbore.design_result import DesignResult, judged
from fluxbore.design_steps import every_design, search_design, with_front, with_tolerances
from fluxbore.evaluating import evaluate
from fluxbore.exporting import STEP_SCHEMAS, export_files, write_cad
from fluxbore.identifying import identify
from fluxbore.optimize.evaluate import evaluate as evaluate_design
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.evaluator import Evaluator
from fluxbore.optimize.executor import Executor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.progress import Report as ProgressReport
from fluxbore.optimize.search import check_study, one_at_a_time
from fluxbore.optimize.sweep import run_sweeps
from fluxbore.reading import as_spec, load
from fluxbore.report_file import REPORT_FILE, write_report_file
from fluxbore.simulating import simulate
from fluxbore.studies import optimize, pareto, robust, sweep, tolerance
from fluxbore.workshop import DESIGN_FILE, design_text, workshop

__all__ = [
    "CAD_FOLDER",
    "COMPARISON_FILE",
    "DESIGN_FILE",
    "REPORT_FILE",
    "ComparisonResult",
    "DesignResult",
    "compare",
    "design",
    "evaluate",
    "export",
    "identify",
    "load",
    "optimize",
    "pareto",
    "report",
    "robust",
    "simulate",
    "sweep",
    "tolerance",
]

CAD_FOLDER = "cad"

Say = Callable[[str], None]
"""Receives a sentence about what could not be done; the command line prints it."""


def export(
    spec: Spec | Path | str,
    folder: Path | str,
    *,
    force: bool = False,
    form: str | Sequence[str] = "step",
    schema: str = STEP_SCHEMAS[0],
) -> list[Path]:
    """Write the design's files: for a workshop, a printer, a viewer or another solver.

    form : a word of `fluxbore.exporting.WORDS` or several; "all" is every format that the kind has. schema : of STEP
    files, "AP242" or "AP214". The whole is named as the design; what is one part's lies in ``parts``.
    Raises MissingLibraryError where a library is missing, with the line that installs it; OutputError where the folder
    holds other files and is not to be taken by ``force``; SpecError for a word that is no format, and for a kind of
    actuator without such a file.
    """
    return export_files(as_spec(spec), folder, (form,) if isinstance(form, str) else form, schema=schema, force=force)


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
    spec, path = as_spec(spec), Path(path)
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
    scheduler: str | None = None,
    time_limit: float | None = None,
    force: bool = False,
    progress: ProgressReport | None = None,
    say: Say | None = None,
    picture: bool = True,
    command: Sequence[str] | None = None,
) -> DesignResult:
    """The whole way: sweeps, search, front, tolerances, STEP files, report; an interrupted run goes on in ``folder``.

    Writes ``results.csv``, ``results.parquet``, ``report.html``, of a design that can be made ``design.toml`` and
    ``cad/*.step``, and where the study asks for them ``front.csv`` and ``tolerance.csv``. Without an objective and
    variables the design is evaluated as it is; with ``study.production.yield`` the search is for a design that
    reaches it.
    """
    begin = monotonic()
    spec = as_spec(spec)
    check_study(spec)
    with workshop(spec, folder, workers, scheduler, time_limit, force) as shop:
        assert shop.folder is not None
        sweeps = run_sweeps(spec, shop.journal, shop.executor, "fem", progress) if spec.study.sweeps else ()
        separate = None
        if spec.study.objective is not None and spec.study.variables:
            found = search_design(spec, shop, progress)
            separate = one_at_a_time(spec, sweeps, shop.journal, shop.executor)
        else:
            found = judged(spec, _evaluated(spec, shop.journal, shop.executor))
        found = replace(found, sweeps=tuple(sweeps))
        found = with_tolerances(spec, with_front(spec, found, shop, progress), shop, progress)
        files = shop.write_results(spec, sweeps, every_design(found))
        files += shop.write_front(found.front) if found.front is not None else []
        files += shop.write_tolerance(found.tolerance) if found.tolerance is not None else []
        if found.search is None or found.search.chosen is not None:
            files.append(shop.folder.write(DESIGN_FILE, design_text(found.spec)))
            try:
                files += write_cad(found.spec, shop.folder, CAD_FOLDER)
            except FluxboreError as error:
                found = replace(found, warnings=(*found.warnings, f"No CAD files: {error}"))
        replayed = found.search is not None and found.search.replayed
        seconds = None if replayed else monotonic() - begin
        files.append(
            write_report_file(spec, found, shop.folder.path / REPORT_FILE, separate, picture, command, seconds)
        )
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


def _evaluated(spec: Spec, journal: Journal | None, executor: Executor) -> Evaluation:
    """The start design through the journal."""
    return Evaluator(spec, executor, journal, "fem", evaluate_design, "evaluate").all([{}])[0].evaluation
