"""The parts list on a drawing: a table above the title block, more of it beside that, and numbers at the parts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from fluxbore.geometry.parts_list import Item as Line
from fluxbore.geometry.sheet import Box, Circle, Item, Place, Stroke, Text
from fluxbore.geometry.sheet_dimension import spread
from fluxbore.geometry.sheet_frame import TABLE_ROW, TITLE_HEIGHT, TITLE_WIDTH, mass_text, table
from fluxbore.geometry.sheet_text import LARGE
from fluxbore.geometry.sheet_view import MM, Section

HEAD = ("no.", "pieces", "part", "material", "part number", "mass of one", "order as, or note")
WIDTHS = (9.0, 12.0, 38.0, 30.0, 36.0, 19.0, 36.0)
"""mm, in all the width of the title block."""

ABOVE = 16
"""Rows above the title block at most, so that there is room for the drawing."""

REMARKS = 20.0
"""mm below the part of the table that stands beside the title block."""

BALLOON = 3.6
"""mm, radius of the circle around a number."""

BALLOON_GAP = 9.0


def cells(items: Sequence[Line]) -> list[tuple[str, ...]]:
    """A row for each item, without the head."""
    return [
        (
            str(item.number),
            str(item.count),
            item.name,
            item.part.material or "envelope only",
            item.part_number,
            mass_text(item.mass) if item.part.material else "",
            item.part.bought or item.part.note,
        )
        for item in items
    ]


def parts_table(items: Sequence[Line], area: Box) -> tuple[list[Item], bool]:
    """The table within a frame's inner area, and whether it must have sheets of its own; then it is empty.

    The first rows stand above the title block and the rest to the left of it, both with a head.
    """
    rows = cells(items)
    beside = int((TITLE_HEIGHT + (ABOVE + 1) * TABLE_ROW - REMARKS) / TABLE_ROW) - 1
    if len(rows) > ABOVE + beside:
        return [], True
    (left, low, right, _), first = area, rows[:ABOVE]
    corner = right - TITLE_WIDTH, low + TITLE_HEIGHT + (len(first) + 1) * TABLE_ROW
    found = table([HEAD, *first], WIDTHS, corner)
    if rest := rows[ABOVE:]:
        found += table([HEAD, *rest], WIDTHS, (left + 6, low + REMARKS + (len(rest) + 1) * TABLE_ROW))
    return found, False


def list_pages(items: Sequence[Line], area: Box) -> list[list[Item]]:
    """The table on sheets of its own, in two columns, the right one above the title block."""
    left, low, right, high = area
    long = int((high - low - 12) / TABLE_ROW) - 1
    short = int((high - low - TITLE_HEIGHT - 12) / TABLE_ROW) - 1
    rows, pages = cells(items), []
    while rows:
        first, second, rows = rows[:long], rows[long : long + short], rows[long + short :]
        page = table([HEAD, *first], WIDTHS, (left + 6, high - 6))
        if second:
            page += table([HEAD, *second], WIDTHS, (right - TITLE_WIDTH, high - 6))
        pages.append(page)
    return pages


def balloons(section: Section, items: Sequence[Line], height: float, scale: float) -> list[Item]:
    """The number of each item that the plane passes, at a height (mm) and as near to its part as the others let it."""
    faces = {part.name: found for part, found in zip(section.parts, section.faces, strict=True) if not found.is_empty}
    targets: list[tuple[Place, int]] = []
    for item in items:
        shown = next((faces[part.name] for part in item.parts if part.name in faces), None)
        if shown is not None:  # of arcs around the axis the plane may pass none
            upper = _upper(shown)
            targets.append(((upper[0] * MM * scale, upper[1] * MM * scale), item.number))
    targets.sort()
    drawn: list[Item] = []
    for (point, number), x in zip(targets, spread([x for (x, _), _ in targets], BALLOON_GAP), strict=True):
        drawn.append(Stroke("DIMENSIONS", (point, (x, height))))
        drawn.append(Circle("DIMENSIONS", point, 0.5))
        drawn.append(Circle("TEXT", (x, height + BALLOON), BALLOON))
        drawn.append(Text(str(number), (x, height + BALLOON - LARGE / 2 + 0.2), 3.0, "middle"))
    return drawn


def _upper(cut: Any) -> tuple[float, float]:
    """A point within the part of a face above the axis, or of all of it (m)."""
    import shapely

    left, _, right, high = cut.bounds
    half = cut.intersection(shapely.box(left, 0.0, right, high))
    point = (cut if half.is_empty else half).representative_point()
    return point.x, abs(point.y)
