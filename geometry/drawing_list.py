"""The parts list on a drawing: a table above the title block, more of it beside that, and numbers at the parts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from fluxbore.geometry.parts_list import Item as Line
from fluxbore.geometry.sheet import Box, Circle, Item, Place, Stroke, Text
from fluxbore.geometry.sheet_dimension import spread
from fluxbore.geometry.sheet_frame import TITLE_HEIGHT, TITLE_WIDTH, mass_text, row_height, table
from fluxbore.geometry.sheet_text import LARGE, SMALL, wrapped
from fluxbore.geometry.sheet_view import MM, Section

HEAD = ("no.", "pieces", "part", "material", "part number", "mass of one", "order as")
WIDTHS = (8.0, 12.0, 37.0, 31.0, 30.0, 19.0, 43.0)
"""mm, in all the width of the title block."""

ABOVE = 85.0
"""mm of rows above the title block at most, so that there is room for the drawing."""

REMARKS = 20.0
"""mm below the part of the table that stands beside the title block."""

BALLOON = 3.6
"""mm, radius of the circle around a number."""

BALLOON_GAP = 9.0

SMALLER = 0.8
"""Of the height of a designation's text, so that fewer need a second line."""


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
            "\n".join(wrapped(item.part.bought, (WIDTHS[-1] - 1.6) / SMALLER, SMALL)),
        )
        for item in items
    ]


def parts_table(items: Sequence[Line], area: Box) -> tuple[list[Item], bool]:
    """The table within a frame's inner area, and whether it must have sheets of its own; then it is empty.

    The first rows stand above the title block and the rest to the left of it, both with a head.
    """
    left, low, right, _ = area
    first, rest = _fitting(cells(items), ABOVE)
    second, over = _fitting(rest, TITLE_HEIGHT + ABOVE - REMARKS)
    if over:
        return [], True
    found = table([HEAD, *first], WIDTHS, (right - TITLE_WIDTH, low + TITLE_HEIGHT + _height([HEAD, *first])))
    if second:
        found += table([HEAD, *second], WIDTHS, (left + 6, low + REMARKS + _height([HEAD, *second])))
    return found, False


def _height(rows: Sequence[Sequence[str]]) -> float:
    return sum(row_height(row) for row in rows)


def _fitting(rows: Sequence[tuple[str, ...]], room: float) -> tuple[list[tuple[str, ...]], list[tuple[str, ...]]]:
    """The first rows that fit under a head into a height (mm), and the others."""
    count = next((i for i in range(len(rows)) if _height([HEAD, *rows[: i + 1]]) > room), len(rows))
    return list(rows[:count]), list(rows[count:])


def list_pages(items: Sequence[Line], area: Box) -> list[list[Item]]:
    """The table on sheets of its own, in two columns, the right one above the title block."""
    left, low, right, high = area
    rows, pages = cells(items), []
    while rows:
        first, rows = _fitting(rows, high - low - 12)
        second, rows = _fitting(rows, high - low - TITLE_HEIGHT - 12)
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
