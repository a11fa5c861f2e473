"""The options that commands on specifications share, and how they are read."""

from __future__ import annotations

import argparse
import math
import re
from typing import TYPE_CHECKING

from fluxbore.design.errors import shown
from fluxbore.solve_command import assignments

if TYPE_CHECKING:
    from fluxbore.design.spec import Spec


def with_spec(parser: argparse.ArgumentParser, *, several: str = "") -> argparse.ArgumentParser:
    """SPEC and ``--set``. several : what more than one SPEC means; they then are ``specs``."""
    if several:
        parser.add_argument("specs", metavar="SPEC", type=path_name, nargs="+", help=several)
    else:
        parser.add_argument("spec", metavar="SPEC", type=path_name, help="specification file (TOML)")
    parser.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        help='another value at a dotted key, such as --set actuator.mover.ring_width="2 mm"; nothing after = drops it',
    )
    return parser


def with_run(parser: argparse.ArgumentParser, *, folder_needed: bool) -> argparse.ArgumentParser:
    """`with_spec` and what a run over many designs takes besides."""
    with_spec(parser)
    parser.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        type=path_name,
        required=folder_needed,
        help="folder for the results; a run goes on in it",
    )
    parser.add_argument("--workers", type=count, metavar="N", help="processes; default: one a core")
    parser.add_argument(
        "--scheduler", type=address, metavar="tcp://HOST:PORT", help="of a Dask cluster, whose workers compute instead"
    )
    parser.add_argument(
        "--time-limit", type=seconds, metavar="S", help="seconds after which one design is given up; default: 1800"
    )
    parser.add_argument("--force", action="store_true", help="replace the results of another specification in DIR")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument("--quiet", action="store_true", help="no progress on stderr")
    return parser


def with_fidelity(parser: argparse.ArgumentParser) -> argparse.ArgumentParser:
    """``--fidelity``."""
    parser.add_argument("--fidelity", choices=("network", "fem"), default="fem", help="default: fem")
    return parser


def count(text: str) -> int:
    """A number of processes."""
    if not text.isascii() or not text.isdigit() or not 1 <= int(text) <= 1024:
        raise argparse.ArgumentTypeError(f"must be a whole number from 1 to 1024; got {shown(text)}")
    return int(text)


def seconds(text: str) -> float:
    """A time, in seconds."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError(f"must be a number of seconds above 0; got {shown(text)}")
    return value


def share(text: str) -> float:
    """Per cent, as a share."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and 0 <= value < 100):
        raise argparse.ArgumentTypeError(f"must be per cent from 0 to below 100; got {shown(text)}")
    return value / 100


def address(text: str) -> str:
    """Where a scheduler listens."""
    if not re.fullmatch(r"[a-z]+://[^\s/]+", text):
        raise argparse.ArgumentTypeError(f"must be an address such as tcp://host:8786; got {shown(text)}")
    return text


def path_name(text: str) -> str:
    """Refuses the empty name, which a script's unset variable makes and Python takes for the working folder."""
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"must name a file or folder; got {shown(text)}")
    return text


def read_spec(options: argparse.Namespace) -> Spec:
    """The specification that the options name, with their values set."""
    from fluxbore.actuators import assembly_of
    from fluxbore.design.spec import load

    spec = load(options.spec, assignments(options.set, 'actuator.mover.ring_width="2 mm"'))
    # Parts that overlap in the drawing alone are wrong input too; a study's designs are judged one by one instead.
    assembly_of(spec)
    return spec
