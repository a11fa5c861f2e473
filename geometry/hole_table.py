"""The drillings of a part as a table on its drawing: a row for each letter, its sizes being dimensions of the file."""

from __future__ import annotations

from collections.abc import Sequence

from fluxbore.geometry.part import AxialHole, Hole
from fluxbore.geometry.part_dimensions import ALIKE, HoleGroup
from fluxbore.geometry.sheet import Dimension, Item, Place, Text
from fluxbore.geometry.sheet_dimension import number
from fluxbore.geometry.sheet_frame import TABLE_ROW, table
from fluxbore.geometry.sheet_text import SMALL, fitted
from fluxbore.geometry.sheet_view import MM

HEAD = ("hole", "pieces", "size", "thread", "to", "on", "angle in the view from the left")
WIDTHS = (10.0, 12.0, 20.0, 26.0, 42.0, 20.0, 50.0)
"""mm, in all the width of the title block."""

SIZE, END, CIRCLE = 2, 4, 5
"""Columns whose numbers are dimensions."""


def table_height(groups: int) -> float:
    """mm."""
    return (groups + 1) * TABLE_ROW if groups else 0.0


def hole_table(groups: Sequence[HoleGroup], corner: Place, origin: Place, scale: float) -> list[Item]:
    """The table on its lower left corner. origin, scale : of the section to whose drillings its numbers belong."""
    if not groups:
        return []
    x, y = corner[0], corner[1] + table_height(len(groups))
    items = table([HEAD, *(_words(group) for group in groups)], WIDTHS, (x, y))
    for row, group in enumerate(groups, 1):
        foot = y - (row + 0.72) * TABLE_ROW
        items += _sizes(group, (x, foot), origin, MM * scale)
    return items


def _words(group: HoleGroup) -> tuple[str, ...]:
    """The cells that are no dimensions."""
    across = isinstance(group.first, Hole)
    end = "" if has_end(group) else _through(group)
    angles = group.angles + (", clockwise" if len(group.holes) > 1 else "")
    return (
        group.letter,
        str(len(group.holes)),
        "",
        group.first.thread,
        end,
        "radial" if across else "",
        angles,
    )


def _through(group: HoleGroup) -> str:
    first = group.first
    if isinstance(first, AxialHole):
        return "all through"
    return "into the bore" if group.bore > 0 else "the axis"


def has_end(group: HoleGroup) -> bool:
    """Whether a flat end is within the material."""
    first = group.first
    if isinstance(first, AxialHole):
        return not group.through
    return first.bottom > group.bore + ALIKE


def _sizes(group: HoleGroup, corner: Place, origin: Place, factor: float) -> list[Item]:
    """Diameter, end and pitch circle as dimensions whose texts stand in the table."""
    first, letter = group.first, group.letter
    x0, y0 = origin
    across = isinstance(first, Hole)
    z = first.z if isinstance(first, Hole) else (first.start + first.end) / 2
    half = first.diameter / 2
    if across:
        ends = ((x0 + (z - half) * factor, y0), (x0 + (z + half) * factor, y0))
    else:
        middle = y0 + first.radius * factor  # type: ignore[union-attr]
        ends = ((x0 + z * factor, middle - half * factor), (x0 + z * factor, middle + half * factor))
    found: list[Item] = [_cell(f"hole {letter}", SIZE, ends, first.diameter, "Ø<>", corner)]
    if isinstance(first, Hole):
        if has_end(group):
            ends = ((x0 + z * factor, y0), (x0 + z * factor, y0 + first.bottom * factor))
            found.append(_cell(f"end of hole {letter}", END, ends, first.bottom, "<> from the axis, flat", corner))
        return found
    circle = ((x0 + z * factor, y0 - first.radius * factor), (x0 + z * factor, y0 + first.radius * factor))
    found.append(_cell(f"pitch circle of {letter}", CIRCLE, circle, 2 * first.radius, "Ø<>", corner))
    if has_end(group):
        y = y0 + first.radius * factor
        ends = ((x0 + first.start * factor, y), (x0 + first.end * factor, y))
        side = group.face
        found.append(_cell(f"depth of hole {letter}", END, ends, first.end - first.start, f"<> deep{side}", corner))
    return found


def _cell(name: str, column: int, ends: tuple[Place, Place], size: float, label: str, corner: Place) -> Dimension:
    text = label.replace("<>", number(size * MM))
    shown, height = fitted(text, WIDTHS[column] - 1.6, SMALL)
    place = corner[0] + sum(WIDTHS[:column]) + 0.8, corner[1]
    words = Text(shown, place, height, "left", 0, "DIMENSIONS")
    return Dimension(name, "round", ends, 0.0, label, words, ())
