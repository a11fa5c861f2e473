"""`fluxbore solve`: its options, what they ask, and what is done about it."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Sequence
from dataclasses import asdict
from math import isfinite
from pathlib import Path
from tempfile import TemporaryFile
from typing import TYPE_CHECKING, Any

from fluxbore.design.errors import OutputError, SpecError, shown

if TYPE_CHECKING:
    from fluxbore.fem.femm_solution import FemmSolution

_SIGNED = ("--point", "--line", "--accuracy", "--group")
"""Options whose value may begin with a minus."""

FILES = {
    "vtu": "the field as a VTK file, for ParaView",
    "png": "a picture of |B| and the field lines",
    "svg": "the same as SVG",
    "ans": "the solution as FEMM stores it",
    "csv": "the field along --line",
}
"""Options that name a file, and what is in it."""


def add_to(parser: argparse.ArgumentParser, path: Callable[[str], str], count: Callable[[str], int]) -> None:
    """Give a parser the options. path, count : what reads the name of a file or folder and a number of processes."""
    parser.add_argument("model", metavar="MODEL", type=path, help="FEMM magnetics file (.fem)")

    def several(name: str, metavar: str, text: str, kind: Callable[[str], Any] = str) -> None:
        parser.add_argument(name, metavar=metavar, type=kind, action="append", default=[], help=text)

    several("--group", "N", "force and torque on the labels of group N", _group)
    several("--point", "X,Y", "A, B and H there, in the file's unit", _pair)
    several(
        "--line",
        "X,Y:X,Y[:N]",
        "line integrals through these and more places, the last one X,Y@DEGREES by an arc; with --csv of N samples",
    )
    several("--set", "KEY=VALUE", "another value, such as circuit.coil.current=3 or group.1.displacement.z=-2")
    several(
        "--sweep",
        "KEY=FIRST:LAST:STEP",
        "a row for every value, or of KEY=VALUE,VALUE,..., into the folder of -o; given twice, for all combinations",
    )
    parser.add_argument(
        "--accuracy", metavar="P%", type=_percent, help="of the estimated errors; default: 0.1%% or a modest mesh"
    )
    parser.add_argument(
        "--open-boundary", action="store_true", help="all of space around the model in place of its outer boundary"
    )
    parser.add_argument("--integrals", action="store_true", help="block integrals, of each --group or of all")
    for name, text in FILES.items():
        parser.add_argument(f"--{name}", metavar="FILE", type=path, help=text)
    parser.add_argument("--full", action="store_true", help="draw the whole model, not what is of interest in it")
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=path, help="folder for the rows of --sweep; a run goes on in it"
    )
    parser.add_argument("--workers", metavar="N", type=count, help="processes for --sweep; default: one a core")
    parser.add_argument("--force", action="store_true", help="replace the rows of another sweep in DIR")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument("--quiet", action="store_true", help="no progress on stderr")


def joined(arguments: Sequence[str]) -> list[str]:
    """The command line with `--point -5,3` as `--point=-5,3`, which the parser would take for another option."""
    found: list[str] = []
    for text in arguments:
        if found and found[-1] in _SIGNED and re.match(r"-[.\d]", text):
            found[-1] += f"={text}"
        else:
            found.append(text)
    return found


def solve(options: argparse.Namespace) -> tuple[bool, dict[str, Any] | str]:
    """Do what the options ask. Whether the result is valid, and what is to be printed: an object or a text."""
    from fluxbore import solving
    from fluxbore.plain_values import finite
    from fluxbore.solution_messages import solution_plain, solution_text

    _check(options)
    if options.sweep:
        return _sweep(options)
    groups, points = tuple(dict.fromkeys(options.group)), tuple(options.point)
    solution = solving.solve(
        options.model,
        groups=groups,
        points=points,
        accuracy=options.accuracy,
        changes=_changes(options.set),
        open_boundary=options.open_boundary,
    )
    plain = solution_plain(solution, groups, points)
    if options.line:
        plain["lines"] = [_line_plain(solution, text) for text in options.line]
    if options.integrals:
        plain["integrals"] = _integrals(solution, groups)
    if files := _write(solution, options):
        plain["files"] = files
    valid = solution.solution.convergence.converged
    return valid, finite(plain) if options.json else solution_text(plain)


def assignments(items: Sequence[str], example: str) -> dict[str, str]:
    """The values of `--set KEY=VALUE`, by key. Raises SpecError for what is not of that form."""
    found = {}
    for item in items:
        key, equals, value = item.partition("=")
        if not equals or not key.strip():
            raise SpecError(f"--set must be KEY=VALUE, such as {example}; got {shown(item)}.")
        found[key.strip()] = value.strip()
    return found


def _changes(items: Sequence[str]) -> dict[str, str]:
    """The values of `--set` by key; an equals sign within quotes is part of a name."""
    from fluxbore.fem.femm_setting import setting

    return dict(setting(item) for item in items)


def _check(options: argparse.Namespace) -> None:
    """Refuse what cannot be done before the work: options that need each other, files that cannot be written."""
    named = [name for name in FILES if getattr(options, name)]
    asked = {
        "--full": ("--png or --svg", options.full and not (options.png or options.svg)),
        "-o": ("--sweep", options.output and not options.sweep),
        "--workers": ("--sweep", options.workers and not options.sweep),
        "--force": ("--sweep", options.force and not options.sweep),
        "--sweep": ("a folder for its rows, -o DIR", options.sweep and not options.output),
    }
    for name, (needed, missing) in asked.items():
        if missing:
            raise SpecError(f"{name} must come with {needed}; got none.")
    if options.csv and len(options.line) != 1:
        raise SpecError(f"--csv must come with one --line; got {len(options.line)}.")
    alone = [*(f"--{name}" for name in named), *(["--line"] if options.line else [])]
    alone += ["--integrals"] if options.integrals else []
    if options.sweep and alone:
        raise SpecError(f"--sweep must come without {alone[0]}, which is of one solution; got both.")
    if options.line:
        from fluxbore.fem.line_text import parse_line

        for text in options.line:
            parse_line(text, 1.0)
    for name in named:
        _check_file(f"--{name}", f".{name}", Path(getattr(options, name)), Path(options.model))


def _check_file(option: str, suffix: str, path: Path, model: Path) -> None:
    if path.suffix.lower() != suffix:
        raise SpecError(f"{option} must name a {suffix} file; got {shown(path.name)}.")
    if not path.parent.is_dir():
        raise SpecError(f"{option} must name a file in a folder that exists; got {shown(str(path))}.")
    if path.is_dir():
        raise SpecError(f"{option} must name a file; {shown(str(path))} is a folder.")
    if path.exists() and model.exists() and path.samefile(model):
        raise SpecError(f"{option} must name another file than the model; got {shown(str(path))} for both.")
    try:
        with TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror or error}.") from error


def _sweep(options: argparse.Namespace) -> tuple[bool, dict[str, Any] | str]:
    from fluxbore.fem.femm_reader import read_model
    from fluxbore.model_sweep import ModelSweep, run_sweep
    from fluxbore.progress_bar import Bar

    sweep = ModelSweep.of(
        read_model(options.model),
        options.sweep,
        changes=tuple(_changes(options.set).items()),
        groups=tuple(dict.fromkeys(options.group)),
        points=tuple(options.point),
        accuracy=options.accuracy,
        open_boundary=options.open_boundary,
    )
    with Bar(options.quiet) as bar:
        path, rows = run_sweep(sweep, options.output, options.workers, options.force, bar.show)
    failed = [row for row in rows if row["status"] != "ok"]
    valid = len(failed) < len(rows)
    if options.json:
        status = "some failed" if failed and valid else "failed" if failed else "ok"
        return valid, {"status": status, "rows": rows, "file": str(path)}
    said = [f"{len(failed)} failed, such as: {failed[0]['reason']}"] if failed else []
    return valid, "\n".join([f"{len(rows) - len(failed)} of {len(rows)} rows solved: {path}", *said])


def _line_plain(solution: FemmSolution, text: str) -> dict[str, Any]:
    from fluxbore.fem.line_text import parse_line
    from fluxbore.fem.line_values import line_integrals

    path, _ = parse_line(text, solution.model.metres)
    found = asdict(line_integrals(solution, path))
    found.pop("errors")  # of the quadrature alone: far below the field's own
    return {"line": text, **found}


def _integrals(solution: FemmSolution, groups: Sequence[int]) -> dict[str, Any]:
    from fluxbore.fem.integrals import block_integrals

    if not groups:
        return {"all": block_integrals(solution)}
    return {str(group): block_integrals(solution, group) for group in groups}


def _write(solution: FemmSolution, options: argparse.Namespace) -> list[str]:
    """Write the files that were asked for; their names."""
    from fluxbore.optimize.folder import write_atomic

    written = []
    if options.vtu:
        from fluxbore.fem.field_file import vtu

        written.append(write_atomic(options.vtu, vtu(solution)))
    if options.ans:
        from fluxbore.fem.ans_file import ans_text

        written.append(write_atomic(options.ans, ans_text(solution)))
    if options.csv:
        from fluxbore.fem.line_text import parse_line
        from fluxbore.fem.line_values import line_values

        table = line_values(solution, *parse_line(options.line[0], solution.model.metres))
        written.append(write_atomic(options.csv, table.csv()))
    for name in (options.png, options.svg):
        if name:
            from fluxbore.reports.flux_plot import flux_plot

            written.append(flux_plot(solution, name, full=options.full))
    return [str(path) for path in written]


def _pair(text: str) -> tuple[float, float]:
    parts = text.split(",")
    try:
        x, y = (float(part) for part in parts)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be X,Y; got {shown(text)}") from None
    if not (isfinite(x) and isfinite(y)):
        raise argparse.ArgumentTypeError(f"must be two finite numbers; got {shown(text)}")
    return x, y


def _group(text: str) -> int:
    if not re.fullmatch(r"-?\d{1,9}", text, re.ASCII):
        raise argparse.ArgumentTypeError(f"must be the whole number of a group; got {shown(text)}")
    return int(text)


def _percent(text: str) -> float:
    try:
        return float(text.strip().removesuffix("%")) / 100
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a percentage such as 0.2%; got {shown(text)}") from None
