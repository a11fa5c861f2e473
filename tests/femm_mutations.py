"""Damage to the text of FEMM files, as editors, scripts, disks and typing errors do it. Deterministic for a generator.

Each mutator takes a text and a generator and gives a text; what it cannot be done to comes back as it is. `mutate` does
one to three of them. Most leave a file that still reads, so that a run over whole solves goes past the reader.
"""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np

Rng = np.random.Generator
Mutator = Callable[[str, Rng], str]

NUMBER = re.compile(r"(?<![A-Za-z_\d.<\[])[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?![A-Za-z_\d.>\]])")
SECTION = re.compile(r"^\s*\[", re.MULTILINE)
EXTREMES = ["0", "-0.0", "1e-300", "1e-12", "1e-6", "1e6", "1e15", "1e300", "1e999", "nan", "inf", "-inf", "-1", "1e"]
WORDS = ["abc", "", "1_0", "٣", "0x10", "1,5", '"', "[", "<", "--", "\x00", "\ufeff", "True", "1.5.2", "9" * 400]
UNITS = ["inches", "millimeters", "centimeters", "meters", "mils", "microns", "parsecs", ""]


def pick(rng: Rng, count: int) -> int:
    return int(rng.integers(count))


def delete_line(text: str, rng: Rng) -> str:
    lines = text.split("\n")
    del lines[pick(rng, len(lines))]
    return "\n".join(lines)


def duplicate_line(text: str, rng: Rng) -> str:
    lines = text.split("\n")
    at = pick(rng, len(lines))
    return "\n".join([*lines[:at], lines[at], *lines[at:]])


def swap_lines(text: str, rng: Rng) -> str:
    lines = text.split("\n")
    i, j = pick(rng, len(lines)), pick(rng, len(lines))
    lines[i], lines[j] = lines[j], lines[i]
    return "\n".join(lines)


def _change_number(text: str, rng: Rng, change: Callable[[str], str]) -> str:
    found = list(NUMBER.finditer(text))
    if not found:
        return text
    match = found[pick(rng, len(found))]
    return text[: match.start()] + change(match[0]) + text[match.end() :]


def flip_sign(text: str, rng: Rng) -> str:
    return _change_number(text, rng, lambda number: number[1:] if number.startswith("-") else "-" + number)


def extreme_number(text: str, rng: Rng) -> str:
    return _change_number(text, rng, lambda _: EXTREMES[pick(rng, len(EXTREMES))])


def nonsense_number(text: str, rng: Rng) -> str:
    return _change_number(text, rng, lambda _: WORDS[pick(rng, len(WORDS))])


def scale_number(text: str, rng: Rng) -> str:
    return _change_number(text, rng, lambda number: repr(float(number) * 10.0 ** rng.uniform(-3, 3)))


def jiggle_number(text: str, rng: Rng) -> str:
    """By so little that two points nearly meet, or a line nearly misses one."""
    return _change_number(text, rng, lambda number: repr(float(number) * (1 + 10.0 ** rng.uniform(-16, -2))))


def off_by_one(text: str, rng: Rng) -> str:
    step = 1 if rng.random() < 0.5 else -1
    return _change_number(text, rng, lambda number: repr(float(number) + step).removesuffix(".0"))


def truncate(text: str, rng: Rng) -> str:
    return text[: pick(rng, len(text) + 1)]


def rows_of(lines: list[str], section: str) -> range:
    """The numbers of a section's rows in ``lines``, none where it cannot be found."""
    for at, line in enumerate(lines):
        if line.lower().startswith(f"[{section.lower()}]"):
            count = re.search(r"\d+\s*$", line)
            return range(at + 1, min(at + 1 + int(count[0][:6]), len(lines))) if count else range(0)
    return range(0)


def _change_row(text: str, rng: Rng, section: str, change: Callable[[list[str], list[list[str]]], list[str]]) -> str:
    lines = text.split("\n")
    rows = rows_of(lines, section)
    if len(rows) == 0:
        return text
    at = rows[pick(rng, len(rows))]
    lines[at] = "\t".join(change(lines[at].split(), [lines[other].split() for other in rows]))
    return "\n".join(lines)


def swap_coordinates(text: str, rng: Rng) -> str:
    section = ["NumPoints", "NumBlockLabels", "NumSegments"][pick(rng, 3)]
    return _change_row(text, rng, section, lambda row, _: [*row[1:2], *row[:1], *row[2:]])


def merge_nodes(text: str, rng: Rng) -> str:
    """One node onto another, exactly or nearly."""
    return _change_row(text, rng, "NumPoints", lambda row, rows: [*rows[pick(rng, len(rows))][:2], *row[2:]])


def move_node(text: str, rng: Rng) -> str:
    """Somewhere else, so that lines cross."""

    def moved(row: list[str], rows: list[list[str]]) -> list[str]:
        return [*rows[pick(rng, len(rows))][:1], *rows[pick(rng, len(rows))][1:2], *row[2:]]

    return _change_row(text, rng, "NumPoints", moved)


def move_label(text: str, rng: Rng) -> str:
    """Onto a node, or into another label's region."""
    lines = text.split("\n")
    nodes = rows_of(lines, "NumPoints")
    if len(nodes) == 0:
        return text
    place = lines[nodes[pick(rng, len(nodes))]].split()[:2]
    return _change_row(
        text,
        rng,
        "NumBlockLabels",
        lambda row, rows: [*(place if rng.random() < 0.5 else rows[pick(rng, len(rows))][:2]), *row[2:]],
    )


def rewire(text: str, rng: Rng) -> str:
    """A segment or arc to another point: it may cross, double or dangle."""
    section = "NumSegments" if rng.random() < 0.7 else "NumArcSegments"
    return _change_row(text, rng, section, lambda row, rows: [*row[:1], *rows[pick(rng, len(rows))][:1], *row[2:]])


def drop_row(text: str, rng: Rng) -> str:
    """A row with its announcement: the file stays sound, the drawing does not."""
    section = ["NumSegments", "NumArcSegments", "NumBlockLabels", "NumPoints"][pick(rng, 4)]
    lines = text.split("\n")
    rows = rows_of(lines, section)
    if len(rows) == 0:
        return text
    lines[rows.start - 1] = f"[{section}] = {len(rows) - 1}"
    del lines[rows[pick(rng, len(rows))]]
    return "\n".join(lines)


def garbage(text: str, rng: Rng) -> str:
    at = pick(rng, len(text) + 1)
    noise = bytes(rng.integers(0, 256, size=pick(rng, 12) + 1, dtype=np.uint8)).decode("latin-1")
    return text[:at] + noise + text[at + len(noise) * pick(rng, 2) :]


def change_unit(text: str, rng: Rng) -> str:
    unit = UNITS[pick(rng, len(UNITS))]
    return re.sub(r"(\[LengthUnits\]\s*=\s*)\S+", lambda match: match[1] + unit, text, flags=re.IGNORECASE)


def change_problem(text: str, rng: Rng) -> str:
    kind = ["planar", "axisymmetric", "spherical"][pick(rng, 3)]
    return re.sub(r"(\[ProblemType\]\s*=\s*)\S+", lambda match: match[1] + kind, text, flags=re.IGNORECASE)


def drop_section(text: str, rng: Rng) -> str:
    starts = [*(match.start() for match in SECTION.finditer(text)), len(text)]
    if len(starts) < 2:
        return text
    at = pick(rng, len(starts) - 1)
    return text[: starts[at]] + text[starts[at + 1] :]


def move_section(text: str, rng: Rng) -> str:
    """To the end: keys come in any order."""
    starts = [*(match.start() for match in SECTION.finditer(text)), len(text)]
    if len(starts) < 2:
        return text
    at = pick(rng, len(starts) - 1)
    section = text[starts[at] : starts[at + 1]]
    return text[: starts[at]] + text[starts[at + 1] :] + ("" if text.endswith("\n") else "\n") + section


def line_ends(text: str, rng: Rng) -> str:
    return text.replace("\n", ["\r\n", "\r", "\n\n", "\x0b", " \t\n"][pick(rng, 5)])


MUTATORS: tuple[Mutator, ...] = (
    delete_line,
    duplicate_line,
    swap_lines,
    flip_sign,
    extreme_number,
    nonsense_number,
    scale_number,
    jiggle_number,
    off_by_one,
    truncate,
    swap_coordinates,
    merge_nodes,
    move_node,
    move_label,
    rewire,
    drop_row,
    garbage,
    change_unit,
    change_problem,
    drop_section,
    move_section,
    line_ends,
)


def mutate(text: str, rng: Rng) -> str:
    """One to three of `MUTATORS`, one after the other."""
    for _ in range(1 + pick(rng, 3)):
        text = MUTATORS[pick(rng, len(MUTATORS))](text, rng)
    return text
