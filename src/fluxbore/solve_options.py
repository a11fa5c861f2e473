"""The options of `fluxbore solve`, and what is asked by them."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from math import isfinite
from typing import Any

from fluxbore.design.errors import SpecError, shown


_PLACES = ("--point", "--line")


def add_to(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options."""
    parser.add_argument("model", metavar="MODEL", help="FEMM magnetics file (.fem)")
    parser.add_argument(
        "--group", metavar="N", type=int, action="append", default=[], help="force and torque on the labels of group N"
    )
    parser.add_argument(
        "--point", metavar="X,Y", type=_pair, action="append", default=[], help="A, B and H there, in the file's unit"
    )
    parser.add_argument(
        "--accuracy", metavar="P%", type=_percent, help="refine until the estimated errors are below; default: 0.1%%"
    )
    parser.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        help="another value, such as --set circuit.coil.current=3 or --set group.1.displacement.z=-2",
    )
    parser.add_argument(
        "--open-boundary", action="store_true", help="all of space around the model in place of its outer boundary"
    )
    parser.add_argument("--json", action="store_true", help="print JSON")


def joined(arguments: Sequence[str]) -> list[str]:
    """The command line with `--point -5,3` as `--point=-5,3`, which the parser would take for another option."""
    found: list[str] = []
    for text in arguments:
        if found and found[-1] in _PLACES and text.startswith("-"):
            found[-1] += f"={text}"
        else:
            found.append(text)
    return found


def question(options: argparse.Namespace) -> dict[str, Any]:
    """The arguments of `solving.solve` that the options stand for."""
    return {
        "groups": tuple(dict.fromkeys(options.group)),
        "points": tuple(options.point),
        "accuracy": options.accuracy,
        "changes": assignments(options.set, "circuit.coil.current=3"),
        "open_boundary": options.open_boundary,
    }


def assignments(items: Sequence[str], example: str) -> dict[str, str]:
    """The values of `--set KEY=VALUE`, by key. Raises SpecError for what is not of that form."""
    found = {}
    for item in items:
        key, equals, value = item.partition("=")
        if not equals or not key.strip():
            raise SpecError(f"--set must be KEY=VALUE, such as {example}; got {shown(item)}.")
        found[key.strip()] = value.strip()
    return found


def _pair(text: str) -> tuple[float, float]:
    parts = text.split(",")
    try:
        x, y = (float(part) for part in parts)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be X,Y; got {shown(text)}") from None
    if not (isfinite(x) and isfinite(y)):
        raise argparse.ArgumentTypeError(f"must be two finite numbers; got {shown(text)}")
    return x, y


def _percent(text: str) -> float:
    number = text.strip().removesuffix("%")
    try:
        value = float(number)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a percentage such as 0.2%; got {shown(text)}") from None
    return value / 100
