"""Parts list and title of a drawing: numbers at the parts, a table of them, and what the sheet is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from typing import Any, NamedTuple

from fluxbore.design.materials import Material
from fluxbore.design.units import format_quantity
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.drawing_lines import MM, add_text
from fluxbore.geometry.mass import part_masses
from fluxbore.geometry.part import Body
from fluxbore.geometry.section import face

HEAD = ("no.", "pieces", "part", "material", "mass", "note")

CHARACTER = 0.95
"""Width of a letter over its height, generously."""


class Item(NamedTuple):
    """A line of the parts list: the parts of one role and one material, one of which bears the number."""

    number: int
    parts: tuple[Body, ...]
    mass: float


def items(assembly: Assembly, materials: Mapping[str, Material]) -> list[Item]:
    """Alike parts under one number, in the assembly's order; mass (kg) of all of them."""
    kinds: dict[tuple[str, str], list[Any]] = {}
    for row in part_masses(assembly, materials):
        kinds.setdefault((row.part.role, row.part.material), []).append(row)
    return [
        Item(number, tuple(row.part for row in rows), sum(row.mass for row in rows))
        for number, rows in enumerate(kinds.values(), 1)
    ]


def add_sheet(
    space: Any, assembly: Assembly, materials: Mapping[str, Material], free: tuple[float, float], size: float
) -> None:
    """Numbers above the drawing, from the first of the heights `free` (mm); below the second the table and the title.

    size : of the text (mm).
    """
    rows = items(assembly, materials)
    above, top = free
    left = min(z for part in assembly.parts for _, z in part.profile) * MM
    _add_numbers(space, rows, above, size)
    cells = [HEAD, *(_cells(item) for item in rows)]
    widths = [(max(len(row[i]) for row in cells) * CHARACTER + 2) * size for i in range(len(HEAD))]
    _add_table(space, cells, widths, (left, top), size)
    total = sum(item.mass for item in rows)
    title = (
        (assembly.name,),
        (f"longitudinal section, mover at {format_quantity(assembly.position, 'length', 6)}",),
        (f"scale 1:1, dimensions in mm; mass as drawn {format_quantity(total, 'mass', 4)}",),
        ("nominal sizes: tolerances, fits, chamfers and threads are for the workshop to add",),
        (program(),),
    )
    width = (max(len(row[0]) for row in title) * CHARACTER + 2) * size
    _add_table(space, title, (width,), (left + sum(widths) + 4 * size, top), size)


def _cells(item: Item) -> tuple[str, ...]:
    part, alone = item.parts[0], len(item.parts) == 1
    mass = format_quantity(item.mass, "mass", 4) if part.material else ""
    name, note = (part.name, part.note) if alone else (part.role, "")
    return str(item.number), str(len(item.parts)), name, part.material, mass, note


def _add_numbers(space: Any, rows: Sequence[Item], height: float, size: float) -> None:
    """Each over its part, or as near as the number before it lets it."""
    targets = []
    for item in rows:
        faces = (face(part) for part in item.parts)
        cut = next((found for found in faces if not found.is_empty), None)
        if cut is not None:  # of arcs around the axis the plane may pass none
            point = cut.representative_point()
            targets.append((point.x * MM, abs(point.y) * MM, item.number))
    last = float("-inf")
    for z, y, number in sorted(targets):
        place = max(z, last + 4 * size)
        last = place
        space.add_line((z, y), (place, height), dxfattribs={"layer": "DIMENSIONS"})
        space.add_circle((z, y), 0.2 * size, dxfattribs={"layer": "DIMENSIONS"})
        add_text(space, str(number), (place, height + 0.6 * size), 1.4 * size, centred=True)


def _add_table(
    space: Any,
    cells: Sequence[Sequence[str]],
    widths: Sequence[float],
    corner: tuple[float, float],
    size: float,
) -> None:
    """Cells with a frame, from the upper left corner (mm)."""
    left, top = corner
    line, right, bottom = 2 * size, left + sum(widths), top - 2 * size * len(cells)
    for number in range(len(cells) + 1):
        y = top - number * line
        space.add_line((left, y), (right, y), dxfattribs={"layer": "SHEET"})
    x = left
    for i, width in enumerate((*widths, 0.0)):
        space.add_line((x, top), (x, bottom), dxfattribs={"layer": "SHEET"})
        for number, row in enumerate(cells):
            if i < len(row):
                add_text(space, row[i], (x + size, top - (number + 0.75) * line), size)
        x += width


def program() -> str:
    """The program's name with its version."""
    try:
        return f"fluxbore {version('fluxbore')}"
    except PackageNotFoundError:  # run from a bare checkout
        return "fluxbore"
