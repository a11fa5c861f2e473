"""The bill of materials: the parts list as a table for a workshop or a buyer, one line an item, as CSV (RFC 4180).

Masses are of the parts as drawn, in kilograms; their sum is the mass that the design's figures use for its parts.
"""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Sequence

from fluxbore.design.errors import one_line
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.part import Part
from fluxbore.geometry.part_size import size_text
from fluxbore.geometry.parts_list import Item

HEAD = (
    "item",
    "part number",
    "drawing number",
    "revision",
    "name",
    "group",
    "material",
    "size",
    "pieces",
    "mass each (kg)",
    "mass total (kg)",
    "centre of gravity above the lower end (mm)",
    "moment of inertia about the axis (kg mm2)",
    "moment of inertia across the axis (kg mm2)",
    "make or buy",
    "designation",
    "note",
)

CARRIED = "carried along, not drawn"
"""The name of the line for what moves with the mover and is no part."""


def bill_of_materials(assembly: Assembly, items: Sequence[Item]) -> str:
    """The file's text. items : the assembly's own parts list."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\r\n")
    writer.writerow(HEAD)
    for item in items:
        writer.writerow(_row(item, assembly.title.revision))
    if assembly.carried_mass > 0:
        mass = _mass(assembly.carried_mass)
        blank = ("",) * 5
        writer.writerow(("", "", "", "", CARRIED, "mover", "", "", 1, mass, mass, *blank, "no part of its own"))
    return stream.getvalue()


def item_note(item: Item) -> str:
    """What the name does not say: of several pieces each of their notes once, and the toleranced sizes."""
    notes = piece_notes(item)
    if isinstance(item.part, Part):
        notes += [f"{fit.feature} {fit.nominal * 1e3:.6g} {fit.tolerance}" for fit in item.part.fits]
    return "; ".join(notes)


def piece_notes(item: Item) -> list[str]:
    """What is noted of the pieces, each note once, with how many it is of where it is not of all."""
    counts = Counter(part.note for part in item.parts)
    return [
        note if count == item.count else f"{count} of {item.count}: {note}" for note, count in counts.items() if note
    ]


def _row(item: Item, revision: str) -> tuple[object, ...]:
    part = item.part
    made = not part.bought
    return (
        item.number,
        _words(item.part_number),
        _words(item.drawing_number) if made else "",
        _words(revision) if made else "",
        _words(item.name),
        part.group,
        _words(part.material) or "envelope only",
        size_text(part),
        item.count,
        _mass(item.mass),
        _mass(item.mass * item.count),
        *_inertia(item),
        item.source,
        _words(part.bought),
        _words(item_note(item)),
    )


def _words(text: str) -> str:
    """On one line. Spreadsheets run what begins like a formula, whoever wrote the specification; with an apostrophe
    before it they show it."""
    line = one_line(text)
    return f"'{line}" if line.lstrip().startswith(("=", "+", "-", "@")) else line


def _inertia(item: Item) -> tuple[str, ...]:
    """Of one piece, about axes through its centre of gravity; across, the greater of both."""
    if not item.mass:
        return "", "", ""
    found = item.inertia
    above = found.centre[2] - min(z for _, z in item.part.profile)
    across = max(found.tensor[0, 0], found.tensor[1, 1])
    return tuple(f"{value:.7g}" for value in (above * 1e3, found.tensor[2, 2] * 1e6, across * 1e6))


def _mass(mass: float) -> str:
    """Figures enough that sums agree with the masses of the design to 1e-9."""
    return f"{mass:.12g}"
