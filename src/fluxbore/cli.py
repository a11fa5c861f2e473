"""The command line: the only place that prints.

Exit status: 0 done; 1 a fault of the program; 2 the input is wrong, one sentence on stderr and nothing on stdout; 3 it
ran and the result is not valid (no feasible design, no convergence); 130 interrupted. Results go to stdout,
everything else to stderr.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from io import TextIOWrapper
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from fluxbore import __version__, solve_command
from fluxbore.design.errors import FluxboreError, one_line, shown

if TYPE_CHECKING:
    from fluxbore.design.spec import Spec

DONE, PROGRAM_FAULT, INPUT_WRONG, NOT_VALID, INTERRUPTED = 0, 1, 2, 3, 130


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    # One BLAS thread a process: the workers are the parallelism, and matrices here are too narrow to share.
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    for stream in (sys.stdout, sys.stderr):
        # Names may hold letters that the terminal's encoding lacks; an escape is better than a traceback.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        options = _parser().parse_args(solve_command.joined(arguments))
        options.arguments = arguments
        command: Callable[[argparse.Namespace], int] = options.command
        status = command(options)
        if sys.stdout is not None:  # None where it was closed before the start
            sys.stdout.flush()
        return status
    except FluxboreError as error:
        return _refuse(str(error))
    except SystemExit as stop:  # argparse: --help, --version and what it cannot read
        return stop.code if isinstance(stop.code, int) else INPUT_WRONG
    except KeyboardInterrupt:
        print("fluxbore: interrupted; the same command goes on where it was.", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        # Whoever read our output has seen enough; keep Python from complaining while it flushes at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except OSError as error:
        where = f"{error.filename} " if error.filename else ""
        return _refuse(f"{where}cannot be read or written: {error.strerror or error}.")
    except Exception as error:
        if os.environ.get("FLUXBORE_TRACEBACK"):
            raise
        _refuse(
            f"a fault of the program, {type(error).__name__}: {error}; please report it with the specification "
            "(FLUXBORE_TRACEBACK=1 shows where)."
        )
        return PROGRAM_FAULT


def _refuse(sentence: str) -> int:
    print(f"fluxbore: {one_line(sentence)}", file=sys.stderr)
    return INPUT_WRONG


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one sentence, like every other error."""

    def error(self, message: str) -> NoReturn:
        raise SystemExit(_refuse(f"{message}; see {self.prog} --help."))


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="fluxbore", description="Designs tubular linear actuators from a one-page specification.")
    parser.add_argument("--version", action="version", version=f"fluxbore {__version__}")
    commands = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=_Parser)

    def add(name: str, run: Callable[[argparse.Namespace], int], text: str) -> argparse.ArgumentParser:
        sub = commands.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".")
        sub.set_defaults(command=run)
        return sub

    new = add("new", _new, "print a commented specification to start from")
    new.add_argument("name", metavar="TEMPLATE", help="such as ipehla")
    add("schema", _schema, "print the JSON Schema of specifications, for editors")
    add("doctor", _doctor, "say what this machine lacks and how to get it").add_argument("--json", action="store_true")

    check = _with_spec(add("check", _check, "read a specification and say what it amounts to"))
    check.add_argument("--json", action="store_true", help="print JSON")

    evaluate = _with_spec(add("evaluate", _evaluate, "compute the figures of the specification's own design"))
    evaluate.add_argument("--fidelity", choices=("network", "fem"), default="fem", help="default: fem")
    evaluate.add_argument("--json", action="store_true", help="print JSON")

    sweep = _with_run(add("sweep", _sweep, "compute the study's grids of designs"), folder_needed=False)
    sweep.add_argument("--fidelity", choices=("network", "fem"), default="fem", help="default: fem")
    _with_run(add("optimize", _optimize, "search for the study's best design"), folder_needed=False)

    export = _with_spec(add("export", _export, "write the design as STEP files or as a FEMM model"))
    export.add_argument("-o", "--output", metavar="DIR", type=_path, required=True, help="folder for the files")
    export.add_argument("--format", choices=("step", "fem"), default="step", help="default: step")
    export.add_argument("--force", action="store_true", help="take a folder that holds other files")
    export.add_argument("--json", action="store_true", help="print JSON")

    report = _with_spec(add("report", _report, "write the report of the specification's own design"))
    report.add_argument(
        "-o", "--output", metavar="FILE", type=_path, required=True, help="the HTML file, or a folder for it"
    )
    report.add_argument("--no-picture", action="store_true", help="do without the rendered picture")
    report.add_argument("--force", action="store_true", help="replace the file where it exists")
    report.add_argument("--json", action="store_true", help="print JSON")

    solve_command.add_to(add("solve", _solve, "solve a FEMM magnetics file (.fem)"), _path, _positive)

    design = _with_run(add("design", _design, "sweeps, search, STEP files and report in one"), folder_needed=True)
    design.add_argument("--no-picture", action="store_true", help="do without the rendered picture")
    return parser


def _with_spec(parser: argparse.ArgumentParser) -> argparse.ArgumentParser:
    parser.add_argument("spec", metavar="SPEC", type=_path, help="specification file (TOML)")
    parser.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        help='another value at a dotted key, such as --set actuator.mover.ring_width="2 mm"; nothing after = drops it',
    )
    return parser


def _with_run(parser: argparse.ArgumentParser, *, folder_needed: bool) -> argparse.ArgumentParser:
    _with_spec(parser)
    parser.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        type=_path,
        required=folder_needed,
        help="folder for the results; a run goes on in it",
    )
    parser.add_argument("--workers", type=_positive, metavar="N", help="processes; default: one a core")
    parser.add_argument("--force", action="store_true", help="replace the results of another specification in DIR")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument("--quiet", action="store_true", help="no progress on stderr")
    return parser


def _positive(text: str) -> int:
    if not text.isascii() or not text.isdigit() or not 1 <= int(text) <= 1024:
        raise argparse.ArgumentTypeError(f"must be a whole number from 1 to 1024; got {shown(text)}")
    return int(text)


def _path(text: str) -> str:
    """Refuses the empty name, which a script's unset variable makes and Python takes for the working folder."""
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"must name a file or folder; got {shown(text)}")
    return text


def _load(options: argparse.Namespace) -> Spec:
    from fluxbore.actuators import actuator_of
    from fluxbore.design.spec import load

    spec = load(options.spec, solve_command.assignments(options.set, 'actuator.mover.ring_width="2 mm"'))
    # Parts that overlap in the drawing alone are wrong input too; a study's designs are judged one by one instead.
    actuator_of(spec).assembly(spec)
    return spec


def _new(options: argparse.Namespace) -> int:
    from fluxbore.design.spec_file import template

    print(template(options.name), end="")
    return DONE


def _schema(_: argparse.Namespace) -> int:
    from fluxbore.design.schema import json_schema

    _print_json(json_schema())
    return DONE


def _doctor(options: argparse.Namespace) -> int:
    from dataclasses import asdict

    from fluxbore.doctor import diagnose, report

    findings = diagnose()
    if options.json:
        _print_json({"findings": [asdict(finding) for finding in findings]})
    else:
        print(report(findings))
    return DONE if all(finding.ok for finding in findings) else NOT_VALID


def _check(options: argparse.Namespace) -> int:
    from fluxbore.messages import spec_plain, spec_text

    spec = _load(options)
    if options.json:
        _print_json(spec_plain(spec))
    else:
        print(spec_text(spec))
    return DONE


def _evaluate(options: argparse.Namespace) -> int:
    from fluxbore.messages import evaluation_text
    from fluxbore.optimize.evaluate import evaluate
    from fluxbore.optimize.evaluation import to_plain

    spec = _load(options)
    evaluation = evaluate(spec, options.fidelity)
    if options.json:
        _print_json({"name": spec.word("actuator.name"), "specification": spec.fingerprint(), **to_plain(evaluation)})
    else:
        print(evaluation_text(evaluation))
    return DONE if evaluation.ok else NOT_VALID


def _sweep(options: argparse.Namespace) -> int:
    from fluxbore.api import sweep
    from fluxbore.messages import Bar, sweeps_plain, sweeps_text

    spec = _load(options)
    with Bar(options.quiet) as bar:
        results = sweep(
            spec,
            options.output,
            fidelity=options.fidelity,
            workers=options.workers,
            force=options.force,
            progress=bar.show,
        )
    if options.json:
        _print_json(sweeps_plain(spec, results))
    else:
        print(sweeps_text(spec, results))
    return DONE if any(row.evaluation.ok for result in results for row in result.rows) else NOT_VALID


def _optimize(options: argparse.Namespace) -> int:
    from fluxbore.api import optimize
    from fluxbore.messages import Bar, search_plain, search_text

    spec = _load(options)
    with Bar(options.quiet) as bar:
        result = optimize(spec, options.output, workers=options.workers, force=options.force, progress=bar.show)
    if options.json:
        _print_json(search_plain(result))
    else:
        print(search_text(spec, result))
    if result.ending == "interrupted":
        return INTERRUPTED
    return DONE if result.chosen is not None and result.ending == "done" else NOT_VALID


def _export(options: argparse.Namespace) -> int:
    from fluxbore.api import export

    found = export(_load(options), options.output, force=options.force, form=options.format)
    files = [str(path) for path in found]
    if options.json:
        _print_json({"status": "ok", "reasons": [], "files": files})
    else:
        print("\n".join(files))
    return DONE


def _report(options: argparse.Namespace) -> int:
    from fluxbore.api import REPORT_FILE, report
    from fluxbore.messages import design_plain

    spec = _load(options)
    target = Path(options.output)
    target = target if target.suffix.lower() in (".html", ".htm") else target / REPORT_FILE
    found = report(spec, target, force=options.force, picture=not options.no_picture, command=options.arguments)
    if options.json:
        _print_json(design_plain(found))
    else:
        print("\n".join([*found.reasons, *(str(path) for path in found.files)]))
    return DONE if found.ok else NOT_VALID


def _solve(options: argparse.Namespace) -> int:
    valid, answer = solve_command.solve(options)
    if isinstance(answer, str):
        print(answer)
    else:
        _print_json(answer)
    return DONE if valid else NOT_VALID


def _design(options: argparse.Namespace) -> int:
    from fluxbore.api import design
    from fluxbore.messages import Bar, design_plain, design_text

    spec = _load(options)
    with Bar(options.quiet) as bar:
        result = design(
            spec,
            options.output,
            workers=options.workers,
            force=options.force,
            progress=bar.show,
            say=bar.say,
            picture=not options.no_picture,
            command=options.arguments,
        )
    if options.json:
        _print_json(design_plain(result))
    else:
        print(design_text(spec, result))
    return DONE if result.ok else NOT_VALID


def _print_json(value: Any) -> None:
    import json

    print(json.dumps(value, indent=1, allow_nan=False))
