"""The drawing of an assembly: its longitudinal section with dimensions, numbers at the parts, parts list and details.

Layers, so that a reader of the DXF file can hide what is in the way:

    OUTLINE what the plane cuts   EDGES seen behind it       HIDDEN drillings beside it   CENTRE the axis
    HATCH                         DIMENSIONS with DIMENSION entities, each told by its name in extended data
    TEXT notes and tables         SHEET their lines          FRAME of the sheet

Solid bars (rods, shafts) are not hatched, as ISO 128-3 has it; sections too narrow for a hatch are filled. The scale is
the largest of ISO 5455 at which all of it finds room on A3.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from fluxbore.design.errors import DesignError
from fluxbore.design.materials import Material
from fluxbore.design.units import format_quantity
from fluxbore.geometry import sheet_dxf
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.drawing_detail import detail_view
from fluxbore.geometry.drawing_list import balloons, list_pages, parts_table
from fluxbore.geometry.measure import Measure, overall
from fluxbore.geometry.parts_list import Item as Line
from fluxbore.geometry.parts_list import parts_list
from fluxbore.geometry.sheet import Dimension, Item, Sheet, bounds, moved
from fluxbore.geometry.sheet_dimension import LEAST, ROW, apart, linear, spread, touching
from fluxbore.geometry.sheet_frame import SCALES, TITLE_HEIGHT, TITLE_WIDTH, TitleWords, frame, inner, mass_text, notes
from fluxbore.geometry.sheet_view import MM, Section, on_paper, section_of, section_view

SIZE = "A3"

ASIDE = 20.0
"""mm, more than any number is long."""

CLEAR = 4.0
"""mm between the drawing and what is around it."""


@dataclass(frozen=True, slots=True)
class Page:
    """Where a sheet stands in its set, from 1."""

    number: int = 1
    of: int = 1

    def __str__(self) -> str:
        return f"{self.number} of {self.of}"


def dxf_text(assembly: Assembly, materials: Mapping[str, Material]) -> str:
    """The whole drawing as a DXF file's text. Raises MissingLibraryError where ezdxf is missing."""
    return sheet_dxf.dxf_text(assembly_sheet(assembly, parts_list(assembly, materials)))


def dxf_document(assembly: Assembly, materials: Mapping[str, Material]) -> Any:
    """The same as a document of ezdxf's."""
    return sheet_dxf.dxf_document(assembly_sheet(assembly, parts_list(assembly, materials)))


def assembly_sheet(assembly: Assembly, items: Sequence[Line], page: Page | None = None) -> Sheet:
    """The sheet. items : the assembly's own parts list. Raises DesignError where no scale is small enough."""
    left, low, right, high = inner(SIZE)
    table, elsewhere = parts_table(items, (left, low, right, high))
    block = assembly.title
    words = TitleWords(
        f"{assembly.name}, assembly",
        block.part_number,
        block.drawing_number,
        "see the parts list",
        mass_text(sum(item.mass * item.count for item in items)),
        str(page or Page()),
    )
    remarks = [*_remarks(assembly), *(["Parts list: see the next sheet."] if elsewhere else [])]
    around = [*table, *notes(remarks, (left + 2, low + 2), right - left - TITLE_WIDTH - 4)]
    floor = max(bounds(around)[3], low + TITLE_HEIGHT) + CLEAR
    room = (right - left - 2 * CLEAR, high - floor - CLEAR)
    section = section_of(assembly)
    for scale in SCALES:
        drawn = _views(assembly, section, scale)
        drawn += balloons(section, items, bounds(drawn)[3] + 5, scale)
        drawn = _with_details(assembly, section, drawn, scale)
        x0, y0, x1, y1 = bounds(drawn)
        if x1 - x0 <= room[0] and y1 - y0 <= room[1]:
            break
    else:
        raise DesignError(f"The drawing of {assembly.name} must find room on {SIZE}; it is too large for any scale.")
    origin = (left + right - x0 - x1) / 2, (floor + high - y0 - y1) / 2
    placed = [moved(item, origin) for item in apart(drawn)]
    every = (*frame(SIZE, block, words, scale), *around, *placed)
    return Sheet("", f"{words.title}, {block.drawing_number}", SIZE, scale, origin, every)


def _remarks(assembly: Assembly) -> list[str]:
    mover = any(part.group == "mover" for part in assembly.parts)
    place = f", mover at {format_quantity(assembly.position, 'length', 6)}" if mover else ""
    lines = [f"Longitudinal section{place}. Dimensions in mm. Mass as drawn."]
    if assembly.squeezes:
        pairs = "; ".join(f"{one} in {other}" for one, other in assembly.squeezes)
        lines.append(f"Drawn overlapping on purpose, one of them yields: {pairs}.")
    if assembly.carried_mass:
        lines.append(f"Carried along, not drawn: {format_quantity(assembly.carried_mass, 'mass', 4)}.")
    return lines


def _views(assembly: Assembly, section: Section, scale: float) -> list[Item]:
    """The section and its dimensions about the model's origin."""
    items = section_view(section, scale)
    lines = _dimensions(assembly, scale, 0.0, own_rows=False)
    if touching(lines):  # a number that stands above the part, for want of room between its arrows
        lines = _dimensions(assembly, scale, ASIDE, own_rows=False)
    if touching(lines):  # neighbours in a row that are shorter than their numbers
        lines = _dimensions(assembly, scale, ASIDE, own_rows=True)
    return [*items, *lines]


def _dimensions(assembly: Assembly, scale: float, aside: float, *, own_rows: bool) -> list[Item]:
    """aside : mm by which the rows above the drawing are farther from it. own_rows : none is shared by two lengths."""
    low, high, reach = (value * MM * scale for value in extent(assembly))
    measures = assembly.measures or overall(assembly.parts, ROW / MM / scale)
    across = [measure for measure in measures if measure.across]
    below = sorted((m for m in measures if not m.across and m.place > 0), key=lambda m: (m.place, m.length))
    columns = iter(_columns([measure.place * MM * scale for measure in across], low, high))

    def line(measure: Measure) -> float:
        """x of one across; else y of its row, counted from 1 below the drawing and from -1 above it."""
        if measure.across:
            return next(columns)
        place = 1.0 + below.index(measure) if own_rows and measure.place > 0 else abs(measure.place)
        row = reach + 2 + ROW * place
        return -row if measure.place > 0 else row + aside

    return [dimension(measure, scale, line(measure)) for measure in measures]


def _columns(places: Sequence[float], low: float, high: float) -> list[float]:
    """x of the lines across; those that are meant to stand outside of the drawing do so in the same order, a row's
    width from one another at whatever scale, and those within have room for their texts."""
    result = list(places)
    within = sorted((x, i) for i, x in enumerate(places) if low <= x <= high)
    for (_, i), x in zip(within, spread([x for x, _ in within], LEAST), strict=True):
        result[i] = x
    for side, edge in ((-1, low), (1, high)):
        outside = sorted((x * side, i) for i, x in enumerate(places) if (x - edge) * side > 0)
        for number, (_, i) in enumerate(outside, 1):
            result[i] = edge + side * (2 + ROW * number)
    return result


def dimension(measure: Measure, scale: float, line: float, factor: float = 1.0) -> Dimension:
    """A measure on paper, its line at x, or y along the axis (mm). factor : as in `Dimension`."""
    start, end = on_paper((measure.start, measure.end), scale / factor)
    label = f"{measure.sign}<>".replace("%%c", "Ø")
    return linear(
        measure.name, start, end, line, measure.length * MM, across=measure.across, label=label, factor=factor
    )


def extent(assembly: Assembly) -> tuple[float, float, float]:
    """Lowest and highest z, and the largest radius (m)."""
    points = [point for part in assembly.parts for point in part.profile]
    heights = [z for _, z in points]
    return min(heights), max(heights), max(r for r, _ in points)


def _with_details(assembly: Assembly, section: Section, items: list[Item], scale: float) -> list[Item]:
    """The views with every detail beside one another below them."""
    result = list(items)
    x, low, _, _ = bounds(items)
    for detail in assembly.details:
        view, marks = detail_view(section, detail, scale)
        x0, _, x1, y1 = bounds(view)
        result += [*marks, *(moved(item, (x - x0, low - CLEAR - y1)) for item in view)]
        x += x1 - x0 + 2 * CLEAR
    return result


def list_sheets(assembly: Assembly, items: Sequence[Line], first: Page) -> list[Sheet]:
    """Sheets of the parts list alone, where it is too long for the drawing; none where it is not."""
    area = inner(SIZE)
    if not parts_table(items, area)[1]:
        return []
    block, title = assembly.title, f"{assembly.name}, parts list"
    sheets = []
    for i, page in enumerate(list_pages(items, area)):
        shown = str(replace(first, number=first.number + i))
        words = TitleWords(title, block.part_number, block.drawing_number, page=shown)
        every = (*frame(SIZE, block, words, None), *page)
        sheets.append(Sheet(f"parts-list-{i + 1}", title, SIZE, 1.0, (0.0, 0.0), every))
    return sheets
