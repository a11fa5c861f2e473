"""What surrounds a drawing: the sheet's frame by ISO 5457, its title block by ISO 7200, and tables above that.

Lengths in mm of the paper.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from fluxbore.design.errors import one_line
from fluxbore.design.title_block import TitleBlock
from fluxbore.geometry.program import program
from fluxbore.geometry.sheet import Box, Circle, Item, Place, Stroke, Text
from fluxbore.geometry.sheet_text import CAPTION, LARGE, SMALL, fitted, text_width, wrapped

SIZES: dict[str, tuple[float, float]] = {"A4": (297.0, 210.0), "A3": (420.0, 297.0)}
"""Landscape."""

BINDING, MARGIN = 20.0, 10.0
"""Of the frame from the left border of the sheet, and from the others."""

TITLE_WIDTH, TITLE_HEIGHT = 180.0, 36.0

LINE = 4.4
"""Between the foot lines of two lines of notes."""

TABLE_ROW, TABLE_STEP = 5.0, 3.6
"""Height of a row, and of each further line in it."""

SCALES = (100.0, 50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 1e-4)
"""Of ISO 5455, from the largest."""


@dataclass(frozen=True, slots=True)
class TitleWords:
    """What the title block of one sheet says beyond the design's own words. page : "1 of 9"."""

    title: str
    part_number: str
    drawing_number: str
    material: str = ""
    mass: str = ""
    page: str = ""


def inner(size: str) -> Box:
    """The area within the frame."""
    width, height = SIZES[size]
    return BINDING, MARGIN, width - MARGIN, height - MARGIN


def scale_text(scale: float) -> str:
    """ "2:1" or "1:5"."""
    return f"{scale:.6g}:1" if scale >= 1 else f"1:{1 / scale:.6g}"


def mass_text(mass: float) -> str:
    """Of kilograms: "131.7 g" or "2.43 kg"."""
    unit, _ = next(pair for pair in (("t", 1e4), ("kg", 1.0), ("g", 0.0)) if mass >= pair[1])
    return f"{mass / {'t': 1e3, 'kg': 1.0, 'g': 1e-3}[unit]:.4g} {unit}"


def frame(size: str, block: TitleBlock, words: TitleWords, scale: float | None) -> list[Item]:
    """Frame, centring marks and title block. scale : None where nothing is drawn to one."""
    left, low, right, high = inner(size)
    width, height = SIZES[size]
    items: list[Item] = [Stroke("FRAME", ((left, low), (right, low), (right, high), (left, high)), closed=True)]
    middle, level = width / 2, height / 2
    for outer, end in (
        ((middle, 5.0), (middle, low)),
        ((middle, height - 5), (middle, high)),
        ((5.0, level), (left, level)),
        ((width - 5, level), (right, level)),
    ):
        items.append(Stroke("FRAME", (outer, end)))
    return items + _title_block((right - TITLE_WIDTH, low), size, block, words, scale)


def _title_block(corner: Place, size: str, block: TitleBlock, words: TitleWords, scale: float | None) -> list[Item]:
    """Four rows of fields from the lower left corner."""
    shown_scale = "not to scale" if scale is None else scale_text(scale)
    rows: tuple[tuple[float, tuple[tuple[str, str, float, float], ...]], ...] = (
        (
            27.0,
            (
                ("Organisation", block.organisation, 52, SMALL),
                ("Author", block.author, 36, SMALL),
                ("Released by", block.approver, 32, SMALL),
                ("Drawn by program", program(), 30, SMALL),
                ("General tolerances", block.general_tolerance, 30, SMALL),
            ),
        ),
        (
            18.0,
            (
                ("Material", words.material, 62, SMALL),
                ("Mass", words.mass, 30, SMALL),
                ("Surfaces, unless stated", block.surface, 88, SMALL),
            ),
        ),
        (9.0, (("Title", words.title, 106, LARGE), ("Part number", words.part_number, 74, LARGE))),
        (
            0.0,
            (
                ("Part of", block.name, 50, SMALL),
                ("Scale", shown_scale, 22, SMALL),
                ("Size", size, 12, SMALL),
                ("Projection", "", 22, SMALL),
                ("Drawing number", words.drawing_number, 42, LARGE),
                ("Revision", block.revision, 14, LARGE),
                ("Sheet", words.page, 18, SMALL),
            ),
        ),
    )
    x0, y0 = corner
    right = x0 + TITLE_WIDTH
    items: list[Item] = [Stroke("FRAME", ((x0, y0), (x0, y0 + TITLE_HEIGHT), (right, y0 + TITLE_HEIGHT)))]
    for height, fields in rows:
        y, x = y0 + height, x0
        if height:
            items.append(Stroke("SHEET", ((x0, y), (right, y))))
        for caption, value, width, text_size in fields:
            if x > x0:
                items.append(Stroke("SHEET", ((x, y), (x, y + 9))))
            items.append(Text(caption, (x + 1, y + 6.4), CAPTION))
            if value:
                shown, text_height = fitted(one_line(value), width - 2, text_size)
                items.append(Text(shown, (x + 1, y + 1.7), text_height))
            if caption == "Projection":
                items += _first_angle((x + 12.5, y + 3.4))
            x += width
    return items


def _first_angle(middle: Place) -> list[Item]:
    """The symbol of ISO 5456-2: a cone and, to the right of it, how it looks from its small end, the left."""
    x, y = middle
    cone = ((x - 7, y - 1.2), (x - 2, y - 2.3), (x - 2, y + 2.3), (x - 7, y + 1.2))
    return [
        Stroke("EDGES", cone, closed=True),
        Circle("EDGES", (x + 4, y), 1.2),
        Circle("EDGES", (x + 4, y), 2.3),
        Stroke("CENTRE", ((x - 8, y), (x + 7.3, y))),
        Stroke("CENTRE", ((x + 4, y - 2.9), (x + 4, y + 2.9))),
    ]


def notes(lines: Sequence[str], corner: Place, width: float, size: float = SMALL) -> list[Item]:
    """Lines of text, broken to this width, the last at the lower left corner."""
    broken = [piece for line in lines for piece in wrapped(one_line(line), width, size)]
    x, y = corner
    step = LINE * size / SMALL
    return [Text(text, (x, y + step * (len(broken) - 1 - i)), size) for i, text in enumerate(broken)]


def table(cells: Sequence[Sequence[str]], widths: Sequence[float], corner: Place, size: float = SMALL) -> list[Item]:
    """Rows from the upper left corner; a cell may have several lines. What is too wide is shown smaller."""
    x0, y0 = corner
    right = x0 + sum(widths)
    levels = [y0]
    for row in cells:
        levels.append(levels[-1] - row_height(row, size))
    items: list[Item] = [Stroke("SHEET", ((x0, y), (right, y))) for y in levels]
    x = x0
    for i, width in enumerate((*widths, 0.0)):
        items.append(Stroke("SHEET", ((x, y0), (x, levels[-1]))))
        for top, row in zip(levels, cells, strict=False):
            lines = (
                [fitted(one_line(line), width - 1.6, size, 0.7 * size) for line in row[i].split("\n")] if width else []
            )
            for number, (text, _) in enumerate(lines):
                if text:
                    foot = top - (0.72 * TABLE_ROW + number * TABLE_STEP) * size / SMALL
                    items.append(Text(text, (x + 0.8, foot), min(least for _, least in lines)))
        x += width
    return items


def row_height(row: Sequence[str], size: float = SMALL) -> float:
    """mm, by the cell with the most lines."""
    return (TABLE_ROW + TABLE_STEP * max(cell.count("\n") for cell in row)) * size / SMALL


def natural_widths(cells: Sequence[Sequence[str]], size: float = SMALL) -> list[float]:
    """Of the columns of a table, so that nothing needs to be smaller."""
    columns = max(len(row) for row in cells)
    return [max(text_width(row[i], size) for row in cells if i < len(row)) + 1.7 for i in range(columns)]
