"""`fluxbore identify`: its options, what they ask of the Python interface, and what it answers."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from fluxbore.design.errors import SpecError, shown
from fluxbore.exit_status import DONE
from fluxbore.spec_options import path_name, read_spec
from fluxbore.study_command import Add, Answer

if TYPE_CHECKING:
    from fluxbore.design.spec import Spec


def add_to(add: Add) -> None:
    """Make the parser of this command."""
    parser = add("identify", _identify, "find a model's parameters in measured data, with their intervals")
    parser.add_argument("model", metavar="MODEL", help="such as friction, of the hybrid actuator's seal")
    parser.add_argument("data", metavar="DATA", type=path_name, help="file of measurements (CSV)")
    parser.add_argument(
        "--spec",
        metavar="SPEC",
        type=path_name,
        help="of the actuator that was measured; friction takes the template without it",
    )
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="another value in SPEC")
    parser.add_argument("--level", type=_share, default=0.95, help="of confidence; default: 0.95")
    parser.add_argument(
        "--free",
        metavar="NAME",
        action="append",
        default=[],
        help="a parameter that stays as it is unless asked for, such as viscous_coefficient",
    )
    parser.add_argument("--json", action="store_true", help="print JSON")


def _identify(options: argparse.Namespace) -> Answer:
    from fluxbore.identification_messages import identification_plain, identification_text
    from fluxbore.identifying import identify

    result = identify(options.model, options.data, spec=_spec(options), level=options.level, free=options.free)
    return Answer(DONE, identification_plain(result) if options.json else identification_text(result))


def _spec(options: argparse.Namespace) -> Spec | None:
    if options.spec is not None:
        return read_spec(options)
    if options.set:
        raise SpecError(f"--set must come with --spec; got {shown(options.set[0])} alone.")
    return None


def _share(text: str) -> float:
    """A share of one, or a percentage; its range is the interface's to check."""
    try:
        return float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a number such as 0.95; got {shown(text)}") from None
