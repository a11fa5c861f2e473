"""`fluxbore solve`: its options, what they ask, and what is done about it."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from itertools import pairwise
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluxbore.design.errors import SpecError, shown

if TYPE_CHECKING:
    from fluxbore.fem.femm_solution import FemmSolution
    from fluxbore.fem.paths import Path as FieldPath

_PLACES = ("--point", "--line")

FILES = {
    "vtu": "the field as a VTK file, for ParaView",
    "png": "a picture of |B| and the field lines",
    "svg": "the same as SVG",
    "ans": "the solution as FEMM stores it",
    "csv": "the field along --line",
}
"""Options that name a file, and what is in it."""


def add_to(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options."""
    parser.add_argument("model", metavar="MODEL", help="FEMM magnetics file (.fem)")

    def several(name: str, metavar: str, text: str, kind: Callable[[str], Any] = str) -> None:
        parser.add_argument(name, metavar=metavar, type=kind, action="append", default=[], help=text)

    several("--group", "N", "force and torque on the labels of group N", int)
    several("--point", "X,Y", "A, B and H there, in the file's unit", _pair)
    several("--line", "X,Y:X,Y[:...][:N]", "line integrals, and with --csv N samples (201), along it", _line)
    several("--set", "KEY=VALUE", "another value, such as circuit.coil.current=3 or group.1.displacement.z=-2")
    several("--sweep", "KEY=FIRST:LAST:STEP", "a row for every value, into the folder of -o")
    parser.add_argument("--accuracy", metavar="P%", type=_percent, help="of the estimated errors; default: 0.1%%")
    parser.add_argument(
        "--open-boundary", action="store_true", help="all of space around the model in place of its outer boundary"
    )
    parser.add_argument("--integrals", action="store_true", help="block integrals, of each --group or of all")
    for name, text in FILES.items():
        parser.add_argument(f"--{name}", metavar="FILE", help=text)
    parser.add_argument("--full", action="store_true", help="draw the whole model, not what is of interest in it")
    parser.add_argument("-o", "--output", metavar="DIR", help="folder for the rows of --sweep; a run goes on in it")
    parser.add_argument("--workers", metavar="N", type=_count, help="processes for --sweep; default: one a core")
    parser.add_argument("--force", action="store_true", help="replace the rows of another sweep in DIR")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument("--quiet", action="store_true", help="no progress on stderr")


def joined(arguments: Sequence[str]) -> list[str]:
    """The command line with `--point -5,3` as `--point=-5,3`, which the parser would take for another option."""
    found: list[str] = []
    for text in arguments:
        if found and found[-1] in _PLACES and text.startswith("-"):
            found[-1] += f"={text}"
        else:
            found.append(text)
    return found


def solve(options: argparse.Namespace, show: Callable[[str], None]) -> tuple[bool, dict[str, Any] | str]:
    """Do what the options ask. Whether the result is valid, and what is to be printed: an object or a text.

    show : takes lines of progress.
    """
    from fluxbore import solving
    from fluxbore.solution_messages import solution_plain, solution_text

    _check(options)
    if options.sweep:
        return _sweep(options, show)
    solution = solving.solve(
        options.model,
        groups=tuple(dict.fromkeys(options.group)),
        points=tuple(options.point),
        accuracy=options.accuracy,
        changes=assignments(options.set, "circuit.coil.current=3"),
        open_boundary=options.open_boundary,
    )
    plain = solution_plain(solution, tuple(dict.fromkeys(options.group)), tuple(options.point))
    extra: dict[str, Any] = {}
    if options.line:
        extra["lines"] = [_line_plain(solution, corners) for corners, _ in options.line]
    if options.integrals:
        extra["integrals"] = _integrals(solution, options.group)
    files = _write(solution, options)
    if files:
        extra["files"] = files
    plain.update(extra)
    valid = solution.solution.convergence.converged
    return valid, plain if options.json else solution_text(plain)


def assignments(items: Sequence[str], example: str) -> dict[str, str]:
    """The values of `--set KEY=VALUE`, by key. Raises SpecError for what is not of that form."""
    found = {}
    for item in items:
        key, equals, value = item.partition("=")
        if not equals or not key.strip():
            raise SpecError(f"--set must be KEY=VALUE, such as {example}; got {shown(item)}.")
        found[key.strip()] = value.strip()
    return found


def _check(options: argparse.Namespace) -> None:
    """Refuse options that need each other before the work."""
    if options.csv and len(options.line) != 1:
        raise SpecError(f"--csv must come with one --line; got {len(options.line)}.")
    if options.sweep and not options.output:
        raise SpecError("--sweep must come with a folder for its rows, -o DIR; got none.")
    named = [name for name in FILES if getattr(options, name)]
    if options.sweep and (named or options.line or options.integrals):
        raise SpecError("--sweep gives rows of figures; pictures, lines and integrals are of one solution at a time.")
    for name in named:
        path = Path(getattr(options, name))
        if path.suffix.lower() != f".{name}":
            raise SpecError(f"--{name} must name a .{name} file; got {shown(path.name)}.")
        if not path.parent.is_dir():
            raise SpecError(f"--{name} must name a file in a folder that exists; got {shown(str(path))}.")


def _sweep(options: argparse.Namespace, show: Callable[[str], None]) -> tuple[bool, dict[str, Any] | str]:
    from fluxbore.fem.femm_edit import edit
    from fluxbore.fem.femm_reader import read_model
    from fluxbore.model_sweep import ModelSweep, run_sweep

    model = edit(read_model(options.model), assignments(options.set, "circuit.coil.current=3"))
    sweep = ModelSweep.of(
        model,
        options.sweep,
        groups=tuple(dict.fromkeys(options.group)),
        points=tuple(options.point),
        accuracy=options.accuracy,
        open_boundary=options.open_boundary,
    )

    def done(count: int, total: int) -> None:
        if not options.quiet:
            show(f"sweep {count}/{total}")

    path, rows = run_sweep(sweep, options.output, options.workers, options.force, done)
    solved = sum(row["status"] == "ok" for row in rows)
    if options.json:
        return solved > 0, {"status": "ok" if solved == len(rows) else "some failed", "rows": rows, "file": str(path)}
    return solved > 0, f"{solved} of {len(rows)} rows solved: {path}"


def _line_plain(solution: FemmSolution, corners: Sequence[tuple[float, float]]) -> dict[str, Any]:
    from dataclasses import asdict

    from fluxbore.fem.line_values import line_integrals

    found = asdict(line_integrals(solution, _path(solution, corners)))
    found.pop("errors")  # of the quadrature alone: far below the field's own
    return {"through": [list(corner) for corner in corners], **found}


def _path(solution: FemmSolution, corners: Sequence[tuple[float, float]]) -> FieldPath:
    from fluxbore.fem.paths import Path as FieldPath

    metres = solution.model.metres
    return FieldPath.through([(x * metres, y * metres) for x, y in corners])


def _integrals(solution: FemmSolution, groups: Sequence[int]) -> dict[str, Any]:
    from fluxbore.fem.integrals import block_integrals

    if not groups:
        return {"all": block_integrals(solution)}
    return {str(group): block_integrals(solution, group) for group in dict.fromkeys(groups)}


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
        from fluxbore.fem.line_values import SAMPLES, line_values

        corners, samples = options.line[0]
        path = _path(solution, corners)
        written.append(write_atomic(options.csv, line_values(solution, path, samples or SAMPLES).csv()))
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


def _line(text: str) -> tuple[tuple[tuple[float, float], ...], int | None]:
    """Corners, and how many samples."""
    parts = text.split(":")
    samples = None
    if parts and "," not in parts[-1]:
        samples = _count(parts.pop(), 2, 100_000)
    corners = tuple(_pair(part) for part in parts)
    if len(corners) < 2 or any(a == b for a, b in pairwise(corners)):
        raise argparse.ArgumentTypeError(f"must be two or more different places X,Y:X,Y; got {shown(text)}")
    return corners, samples


def _count(text: str, least: int = 1, most: int = 1024) -> int:
    if not text.isascii() or not text.isdigit() or not least <= int(text) <= most:
        raise argparse.ArgumentTypeError(f"must be a whole number from {least} to {most}; got {shown(text)}")
    return int(text)


def _percent(text: str) -> float:
    number = text.strip().removesuffix("%")
    try:
        value = float(number)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a percentage such as 0.2%; got {shown(text)}") from None
    return value / 100
