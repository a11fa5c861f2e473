"""The commands that compute designs: their options, what they ask of the Python interface, and what they answer."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from fluxbore.design.errors import DesignError, SpecError
from fluxbore.exit_status import DONE, INTERRUPTED, NOT_VALID
from fluxbore.spec_options import path_name, read_spec, share, with_fidelity, with_run, with_spec


@dataclass(frozen=True, slots=True)
class Answer:
    """A command's exit status, and what it prints: an object as JSON, or a text."""

    status: int
    content: dict[str, Any] | str


Run = Callable[[argparse.Namespace], Answer]


class Add(Protocol):
    """Makes the parser of a command: its name, what it runs, and what it is for."""

    def __call__(self, name: str, run: Run, text: str) -> argparse.ArgumentParser: ...


def add_to(add: Add) -> None:
    """Make the parsers of these commands."""
    evaluate = with_fidelity(with_spec(add("evaluate", _evaluate, "compute the figures of the specification's design")))
    evaluate.add_argument(
        "--gradient", action="store_true", help="their derivatives too, by the study's continuous variables"
    )
    evaluate.add_argument("--json", action="store_true", help="print JSON")

    with_fidelity(with_run(add("sweep", _sweep, "compute the study's grids of designs"), folder_needed=False))
    with_run(add("optimize", _optimize, "search for the study's best design"), folder_needed=False)
    with_run(add("pareto", _pareto, "look for the front between the study's two objectives"), folder_needed=False)
    with_fidelity(
        with_run(add("tolerance", _tolerance, "say what comes off the line within the tolerances"), folder_needed=False)
    )
    with_run(add("robust", _robust, "search for the best design that reaches the yield"), folder_needed=False)

    report = with_spec(
        add("report", _report, "write the report of the specification's own design, or compare several designs"),
        several="specification files (TOML); several are compared, as are folders of finished runs",
    )
    report.add_argument(
        "-o", "--output", metavar="FILE", type=path_name, required=True, help="the HTML file, or a folder for it"
    )
    report.add_argument("--no-picture", action="store_true", help="do without the rendered picture")
    report.add_argument(
        "--same",
        type=share,
        metavar="PERCENT",
        help="figures of a comparison no further apart are the same; default: 0.1",
    )
    report.add_argument("--force", action="store_true", help="replace the file where it exists")
    report.add_argument("--json", action="store_true", help="print JSON")

    design = with_run(add("design", _design, "the whole study, STEP files and report in one"), folder_needed=True)
    design.add_argument("--no-picture", action="store_true", help="do without the rendered picture")


def _evaluate(options: argparse.Namespace) -> Answer:
    from fluxbore.evaluating import evaluate
    from fluxbore.gradient_messages import gradient_text
    from fluxbore.messages import evaluation_plain, evaluation_text

    spec = read_spec(options)
    evaluation = evaluate(spec, options.fidelity, gradient=options.gradient)
    status = DONE if evaluation.ok else NOT_VALID
    if options.json:
        return Answer(status, evaluation_plain(spec, evaluation))
    slopes = ["", gradient_text(spec, evaluation)] if evaluation.gradient is not None else []
    return Answer(status, "\n".join([evaluation_text(spec, evaluation), *slopes]))


def _early(options: argparse.Namespace) -> None:
    """Local processes start while the specification is read, unless a cluster computes."""
    if options.scheduler is None and (options.workers is None or options.workers > 0):
        from fluxbore.optimize.executor import start_early

        start_early(options.workers)


def _sweep(options: argparse.Namespace) -> Answer:
    _early(options)
    from fluxbore.messages import sweeps_plain, sweeps_text
    from fluxbore.progress_bar import Bar
    from fluxbore.studies import sweep

    spec = read_spec(options)
    with Bar(options.quiet) as bar:
        results = sweep(spec, options.output, fidelity=options.fidelity, progress=bar.show, **run_options(options))
    status = DONE if any(row.evaluation.ok for result in results for row in result.rows) else NOT_VALID
    return Answer(status, sweeps_plain(spec, results) if options.json else sweeps_text(spec, results))


def _optimize(options: argparse.Namespace) -> Answer:
    _early(options)
    from fluxbore.progress_bar import Bar
    from fluxbore.search_messages import search_plain, search_text
    from fluxbore.studies import optimize

    spec = read_spec(options)
    with Bar(options.quiet) as bar:
        result = optimize(spec, options.output, progress=bar.show, **run_options(options))
    done = DONE if result.chosen is not None and result.ending == "done" else NOT_VALID
    status = INTERRUPTED if result.ending == "interrupted" else done
    return Answer(status, search_plain(result) if options.json else search_text(spec, result))


def _pareto(options: argparse.Namespace) -> Answer:
    _early(options)
    from fluxbore.pareto_messages import pareto_plain, pareto_text
    from fluxbore.progress_bar import Bar
    from fluxbore.studies import pareto

    spec = read_spec(options)
    with Bar(options.quiet) as bar:
        result = pareto(spec, options.output, progress=bar.show, **run_options(options))
    done = DONE if result.front and result.ending == "done" else NOT_VALID
    status = INTERRUPTED if result.ending == "interrupted" else done
    return Answer(status, pareto_plain(result) if options.json else pareto_text(spec, result))


def _tolerance(options: argparse.Namespace) -> Answer:
    _early(options)
    from fluxbore.progress_bar import Bar
    from fluxbore.studies import tolerance
    from fluxbore.tolerance_messages import tolerance_plain, tolerance_text

    spec = read_spec(options)
    try:
        with Bar(options.quiet) as bar:
            result = tolerance(
                spec, options.output, fidelity=options.fidelity, progress=bar.show, **run_options(options)
            )
    except DesignError as error:  # it was evaluated, and there is nothing that could scatter
        plain = {"status": "not analysed", "reasons": [str(error)]}
        return Answer(NOT_VALID, plain if options.json else str(error))
    return Answer(DONE, tolerance_plain(result) if options.json else tolerance_text(spec, result))


def _robust(options: argparse.Namespace) -> Answer:
    _early(options)
    from fluxbore.progress_bar import Bar
    from fluxbore.search_messages import robust_design_text
    from fluxbore.studies import robust
    from fluxbore.tolerance_messages import robust_plain, robust_text

    spec = read_spec(options)
    with Bar(options.quiet) as bar:
        result = robust(spec, options.output, progress=bar.show, **run_options(options))
    interrupted = result.rounds[-1].search.ending == "interrupted"
    status = INTERRUPTED if interrupted else DONE if result.reached else NOT_VALID
    if options.json:
        return Answer(status, robust_plain(result))
    return Answer(status, "\n\n".join(filter(None, [robust_text(spec, result), robust_design_text(spec, result)])))


def _report(options: argparse.Namespace) -> Answer:
    from fluxbore.api import REPORT_FILE, report
    from fluxbore.design_messages import design_plain

    if len(options.specs) > 1:
        return _compare(options)
    (options.spec,) = options.specs
    if options.same is not None:
        raise SpecError("--same must be left out for one design; got one.")
    spec = read_spec(options)
    target = _page(options, REPORT_FILE)
    found = report(spec, target, force=options.force, picture=not options.no_picture, command=options.arguments)
    text = "\n".join([*found.reasons, *(str(path) for path in found.files)])
    return Answer(DONE if found.ok else NOT_VALID, design_plain(found) if options.json else text)


def _compare(options: argparse.Namespace) -> Answer:
    from fluxbore.api import COMPARISON_FILE, compare
    from fluxbore.comparison_messages import comparison_plain, comparison_text

    if options.set:
        raise SpecError("--set must be left out where several designs are compared; got one.")
    target = _page(options, COMPARISON_FILE)
    found = compare(options.specs, target, same=options.same, force=options.force, command=options.arguments)
    plain = comparison_plain(found) if options.json else comparison_text(found)
    return Answer(DONE if found.ok else NOT_VALID, plain)


def _page(options: argparse.Namespace, name: str) -> Path:
    """The file that ``--output`` means: itself, or one of this name in the folder."""
    target = Path(options.output)
    return target if target.suffix.lower() in (".html", ".htm") else target / name


def _design(options: argparse.Namespace) -> Answer:
    _early(options)
    from fluxbore.api import design
    from fluxbore.design_messages import design_plain, design_text
    from fluxbore.progress_bar import Bar

    spec = read_spec(options)
    with Bar(options.quiet) as bar:
        result = design(
            spec,
            options.output,
            progress=bar.show,
            say=bar.say,
            picture=not options.no_picture,
            command=options.arguments,
            **run_options(options),
        )
    return Answer(DONE if result.ok else NOT_VALID, design_plain(result) if options.json else design_text(spec, result))


def run_options(options: argparse.Namespace) -> dict[str, Any]:
    return {name: getattr(options, name) for name in ("workers", "scheduler", "time_limit", "force")}
