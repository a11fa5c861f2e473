"""A path as it is written on a command line: `X1,Y1:X2,Y2[:...][:N]`, an arc of so many degrees with `X2,Y2@DEG`."""

from __future__ import annotations

from math import isfinite, radians

from fluxbore.design.errors import SpecError, shown
from fluxbore.fem.line_values import SAMPLES
from fluxbore.fem.paths import Path

MOST_SAMPLES = 1_000_000


def parse_line(text: str, metres: float) -> tuple[Path, int]:
    """The path and the number of its samples. metres : of one unit of the text's lengths.

    Raises SpecError for whatever is no path.
    """
    parts = text.split(":")
    samples = SAMPLES
    if len(parts) > 1 and "," not in parts[-1]:
        samples = _count(text, parts.pop())
    corners, turns = [], []
    for part in parts:
        place, arc, angle = part.partition("@")
        numbers = [_number(text, word) for word in place.split(",")]
        if len(numbers) != 2:
            raise _refusal(text, f"{shown(part)} is not a point")
        corners.append((numbers[0] * metres, numbers[1] * metres))
        turns.append(radians(_number(text, angle)) if arc else 0.0)
    if len(corners) < 2:
        raise _refusal(text, "one point is no line")
    if turns[0]:
        raise _refusal(text, "an arc is written at its end")
    try:
        return Path.through(corners, turns[1:]), samples
    except ValueError:
        raise _refusal(text, "a piece has no length or turns by a whole circle") from None


def _number(text: str, word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = float("nan")
    if not (isfinite(value) and abs(value) < 1e100):
        raise _refusal(text, f"{shown(word)} is not a number")
    return value


def _count(text: str, word: str) -> int:
    if not (word.isascii() and word.isdigit() and len(word) < 10 and 2 <= int(word) <= MOST_SAMPLES):
        raise _refusal(text, f"the number of samples must be from 2 to {MOST_SAMPLES}")
    return int(word)


def _refusal(text: str, why: str) -> SpecError:
    return SpecError(f"--line must be X1,Y1:X2,Y2[:N], an arc X2,Y2@DEGREES; {why} in {shown(text)}.")
