"""`fluxbore simulate`: its options, what they ask of the Python interface, and what it answers."""

from __future__ import annotations

import argparse

from fluxbore.exit_status import DONE, NOT_VALID
from fluxbore.spec_options import path_name, read_spec, with_fidelity, with_run
from fluxbore.study_command import Add, Answer, run_options

MOST_DIGITS = 1000
"""Python itself reads no number of more than 4300."""


def add_to(add: Add) -> None:
    """Make the parser of this command."""
    parser = with_fidelity(
        with_run(
            add("simulate", _simulate, "put the specification's design through a benchmark in simulated time"),
            folder_needed=False,
        )
    )
    parser.add_argument(
        "--benchmark",
        metavar="NAME",
        help="mcfc of the hybrid actuator, force of the lead screw, tracking of the electro-hydrostatic one; "
        "default: the one that the actuator's kind has",
    )
    parser.add_argument(
        "--seeds",
        metavar="N",
        type=_whole,
        help="how many; default: 5 of mcfc, 1 of the others",
    )
    parser.add_argument("--seed", metavar="S", type=_whole, default=1, help="the first of them; default: 1")
    parser.add_argument(
        "--against",
        metavar="DESIGN",
        type=path_name,
        action="append",
        default=[],
        help="another design's specification, put through the same; may be given several times",
    )
    parser.add_argument("--vary", action="store_true", help="what a tenth more or less of some parameters does, too")
    parser.add_argument("--no-picture", action="store_true", help="do without the rendered picture in the report")


def _simulate(options: argparse.Namespace) -> Answer:
    from fluxbore.progress_bar import Bar
    from fluxbore.simulating import simulate
    from fluxbore.simulation_messages import simulation_plain, simulation_text

    spec = read_spec(options)
    with Bar(options.quiet) as bar:
        result = simulate(
            spec,
            options.benchmark,
            options.output,
            seeds=options.seeds,
            seed=options.seed,
            against=options.against,
            vary=options.vary,
            fidelity=options.fidelity,
            progress=bar.show,
            picture=not options.no_picture,
            command=options.arguments,
            **run_options(options),
        )
    status = DONE if result.ok else NOT_VALID
    return Answer(status, simulation_plain(result) if options.json else simulation_text(result))


def _whole(text: str) -> int:
    """A whole number; its range is the interface's to check."""
    from fluxbore.design.errors import shown

    digits = text.removeprefix("-")
    if not digits.isascii() or not digits.isdigit() or len(digits) > MOST_DIGITS:
        raise argparse.ArgumentTypeError(f"must be a whole number; got {shown(text)}")
    return int(text)
