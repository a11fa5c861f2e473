"""The command line: the only place that prints.

Results go to stdout, everything else to stderr; see `fluxbore.exit_status` for how it ends.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from io import TextIOWrapper
from typing import Any, NoReturn

from fluxbore import __version__, export_command, identify_command, simulate_command, solve_command, study_command
from fluxbore.design.errors import FluxboreError, one_line
from fluxbore.exit_status import DONE, INPUT_WRONG, INTERRUPTED, NOT_VALID, PROGRAM_FAULT
from fluxbore.spec_options import count, path_name, read_spec, with_spec


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

    check = with_spec(add("check", _check, "read a specification and say what it amounts to"))
    check.add_argument("--json", action="store_true", help="print JSON")

    def answering(run: study_command.Run) -> Callable[[argparse.Namespace], int]:
        return lambda options: _answer(run(options))

    for commands_of in (study_command, simulate_command, identify_command):
        commands_of.add_to(lambda name, run, text: add(name, answering(run), text))

    export_command.add_to(add("export", _export, "write the design as files for a workshop or another program"))

    solve_command.add_to(add("solve", _solve, "solve a FEMM magnetics file (.fem)"), path_name, count)
    return parser


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

    spec = read_spec(options)
    if options.json:
        _print_json(spec_plain(spec))
    else:
        print(spec_text(spec))
    return DONE


def _export(options: argparse.Namespace) -> int:
    sound, answer = export_command.run(options)
    if isinstance(answer, str):
        print(answer)
    else:
        _print_json(answer)
    return DONE if sound else NOT_VALID


def _solve(options: argparse.Namespace) -> int:
    valid, answer = solve_command.solve(options)
    if isinstance(answer, str):
        print(answer)
    else:
        _print_json(answer)
    return DONE if valid else NOT_VALID


def _answer(answer: study_command.Answer) -> int:
    if isinstance(answer.content, str):
        print(answer.content)
    else:
        from fluxbore.plain_values import finite

        _print_json(finite(answer.content))
    return answer.status


def _print_json(value: Any) -> None:
    import json

    print(json.dumps(value, indent=1, allow_nan=False))
