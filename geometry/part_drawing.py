"""The drawing of one part: its views with all dimensions, drillings in a table, notes, and the title block.

The sheet is A4 where the part is shown in full size or larger on it, else A3; the scale is the largest of ISO 5455 that
fits.
"""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.errors import DesignError
from fluxbore.design.title_block import TitleBlock
from fluxbore.geometry.bill_of_materials import piece_notes
from fluxbore.geometry.drawing import Page
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.hole_table import has_end, hole_table, table_height
from fluxbore.geometry.part import Body, Part
from fluxbore.geometry.part_dimensions import ALIKE, diameters, fit_text, hole_groups, levels
from fluxbore.geometry.part_size import winding_text
from fluxbore.geometry.part_views import alone, part_views, standing
from fluxbore.geometry.parts_list import Item as Line
from fluxbore.geometry.sheet import Item, Place, Sheet, bounds, moved
from fluxbore.geometry.sheet_dimension import number
from fluxbore.geometry.sheet_frame import SCALES, TITLE_HEIGHT, TITLE_WIDTH, TitleWords, frame, inner, mass_text, notes
from fluxbore.geometry.sheet_view import MM, Section

CLEAR = 3.0
"""mm around the views."""


@dataclass(frozen=True, slots=True)
class _Layout:
    """Views that fit a sheet: at which scale, and where on the paper the part's datum is."""

    size: str
    scale: float
    origin: Place
    views: tuple[Item, ...]


def part_sheet(item: Line, block: TitleBlock, name: str, page: Page | None = None) -> Sheet:
    """One item of the parts list. name : of the file. Raises DesignError where a tolerance or the paper do not do."""
    part = standing(item.part)
    section, groups = alone(part), hole_groups(part) if isinstance(part, Part) else []
    found = [layout for size in ("A4", "A3") if (layout := _layout(part, section, size, len(groups))) is not None]
    if not found:
        raise DesignError(f"The drawing of the {item.name} must find room on A3; it is too large for any scale.")
    chosen = found[0] if found[0].scale >= min(1.0, found[-1].scale) else found[-1]
    words = TitleWords(
        item.name,
        item.part_number,
        item.drawing_number,
        part.material or "envelope only",
        mass_text(item.mass) if part.material else "",
        str(page or Page()),
    )
    left, low, right, _ = inner(chosen.size)
    every = (
        *frame(chosen.size, block, words, chosen.scale),
        *notes(_remarks(item), (left + 2, low + 2), right - left - TITLE_WIDTH - 4),
        *hole_table(groups, (right - TITLE_WIDTH, low + TITLE_HEIGHT), chosen.origin, chosen.scale),
        *chosen.views,
    )
    title = f"{item.name}, {item.drawing_number}"
    return Sheet(name, title, chosen.size, chosen.scale, chosen.origin, every)


def _layout(part: Body, section: Section, size: str, groups: int) -> _Layout | None:
    """The largest scale at which all views find room; None where not even the smallest will do."""
    left, low, right, high = inner(size)
    floor = low + TITLE_HEIGHT + table_height(groups) + CLEAR
    width, height = right - left - 2 * CLEAR, high - floor - CLEAR
    across, along = 2 * max(r for r, _ in part.profile) * MM, max(z for _, z in part.profile) * MM
    for scale in SCALES:
        if scale * across > height or scale * along > width:
            continue  # without looking at the dimensions
        views = part_views(part, section, scale)
        x0, y0, x1, y1 = bounds(views)
        if x1 - x0 <= width and y1 - y0 <= height:
            origin = (left + right - x0 - x1) / 2, (floor + high - y0 - y1) / 2
            return _Layout(size, scale, origin, tuple(moved(view, origin) for view in views))
    return None


def _remarks(item: Line) -> list[str]:
    """What no view says, a line each."""
    part = item.part
    lines = [f"{item.count} pieces. Dimensions in mm." if item.count > 1 else "Dimensions in mm."]
    if isinstance(part, HelicalPart):
        lines.append(f"Envelope and section: {winding_text(part)}.")
    elif len(levels(upright := _turned(part))) + len(hole_groups(upright)) > 1:
        lines[0] += " Lengths from the left face."
    if part.fill < 1:
        lines.append(f"Drawn as the whole window, of which {part.fill:.3g} is {part.material}.")
    lines += [f"{note[0].upper()}{note[1:]}." for note in piece_notes(item)]
    if isinstance(part, Part):
        lines += _other_fits(part)
        if any(group.first.thread and has_end(group) for group in hole_groups(part)):
            lines.append("Blind threads reach the floor: bottoming tap.")
    return lines


def _turned(part: Part) -> Part:
    moved_part = standing(part)
    assert isinstance(moved_part, Part)
    return moved_part


def _other_fits(part: Part) -> list[str]:
    """Tolerances of sizes that no dimension shows."""
    shown = [2 * item.r for item in diameters(part)] + [level.z for level in levels(_turned(part))]
    return [
        f"{fit.feature[0].upper()}{fit.feature[1:]}: {number(fit.nominal * MM)} {fit_text(fit)}."
        for fit in part.fits
        if all(abs(fit.nominal - size) > ALIKE for size in shown)
    ]
