"""Sheets as one PDF file, a page each, of their true size: lines stay lines, texts texts, the font is embedded.

matplotlib's PDF writer does it (it is imported for the pages' curves anyway). Nothing in the file depends on the day.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from fluxbore.design.errors import MissingLibraryError
from fluxbore.geometry.hatch_lines import hatch_lines
from fluxbore.geometry.program import program
from fluxbore.geometry.sheet import LAYERS, Circle, Ellipse, Filled, Hatch, Sheet, Stroke, Text, parts_of
from fluxbore.geometry.sheet_frame import SIZES
from fluxbore.geometry.sheet_svg import CAPITALS, DASHES
from fluxbore.geometry.sheet_text import text_width

if TYPE_CHECKING:
    from matplotlib.font_manager import FontProperties

POINT = 72 / 25.4
"""Points in a millimetre."""


def pdf_bytes(sheets: Sequence[Sheet]) -> bytes:
    """The whole file. Raises MissingLibraryError where matplotlib is missing."""
    try:
        import matplotlib
        from matplotlib.backends.backend_pdf import PdfPages
        from matplotlib.figure import Figure
    except ImportError as error:
        raise MissingLibraryError(
            f"A PDF file needs matplotlib ({error}); get it by: pip install matplotlib"
        ) from error
    buffer = io.BytesIO()
    facts = {"Title": sheets[0].title, "Creator": program(), "Producer": program(), "CreationDate": None}
    # Type 42 keeps the font's own outlines, and texts can be searched and copied.
    with matplotlib.rc_context({"pdf.fonttype": 42}), PdfPages(buffer, metadata=facts) as pages:
        for sheet in sheets:
            width, height = SIZES[sheet.size]
            figure = Figure(figsize=(width / 25.4, height / 25.4))
            figure.add_artist(_artist(sheet))
            pages.savefig(figure)
    return buffer.getvalue()


def _artist(sheet: Sheet) -> Any:
    """Draws the whole sheet in one go, past all that a plot would do for each line."""
    from matplotlib.artist import Artist

    class SheetArtist(Artist):
        def draw(self, renderer: Any) -> None:
            _draw(sheet, renderer)

    return SheetArtist()


def _draw(sheet: Sheet, renderer: Any) -> None:
    from matplotlib.font_manager import FontProperties

    fonts: dict[float, FontProperties] = {}
    shapes: dict[tuple[str, bool], list[Any]] = {}
    for item in parts_of(sheet.items):
        if isinstance(item, Text):
            font = fonts.get(item.size)
            if font is None:
                font = fonts[item.size] = FontProperties(family="DejaVu Sans", size=item.size / CAPITALS * POINT)
            _draw_text(renderer, item, font)
        else:
            solid = isinstance(item, Filled) or (isinstance(item, Hatch) and not item.spacing)
            shapes.setdefault((item.layer, solid), []).append(_path(item))
    for (layer, solid), paths in shapes.items():  # as one path each, which is written ten times faster
        _draw_shapes(renderer, layer, solid, paths)


def _draw_text(renderer: Any, item: Text, font: Any) -> None:
    if not item.text:
        return
    graphics = renderer.new_gc()
    graphics.set_foreground("black")
    width = text_width(item.text, item.size)
    if item.anchor != "left":
        # By the font's own measure, which is a little less than the one that the layout allows for.
        width = renderer.get_text_width_height_descent(item.text, font, ismath=False)[0] / POINT
    back = width * {"left": 0.0, "middle": 0.5, "right": 1.0}[item.anchor]
    x, y = item.place
    x, y = (x, y - back) if item.angle else (x - back, y)
    renderer.draw_text(graphics, x * POINT, y * POINT, item.text, font, item.angle, ismath=False)
    graphics.restore()


def _draw_shapes(renderer: Any, layer: str, solid: bool, paths: Sequence[Any]) -> None:
    from matplotlib.path import Path
    from matplotlib.transforms import Affine2D

    _, linetype, width = LAYERS[layer]
    graphics = renderer.new_gc()
    graphics.set_foreground("black")
    graphics.set_linewidth(0.0 if solid else width * POINT)
    graphics.set_joinstyle("round")
    graphics.set_capstyle("butt" if linetype in DASHES else "round")
    if linetype in DASHES:
        graphics.set_dashes(0, [float(length) * POINT for length in DASHES[linetype].split()])
    # Filled shapes one by one: where two overlap as one path, what they share would be left open.
    for path in paths if solid else [Path.make_compound_path(*paths)]:
        renderer.draw_path(graphics, path, Affine2D().scale(POINT), (0.0, 0.0, 0.0) if solid else None)
    graphics.restore()


def _path(item: Stroke | Circle | Ellipse | Filled | Hatch) -> Any:
    from matplotlib.path import Path
    from matplotlib.transforms import Affine2D

    match item:
        case Stroke():
            return _polygon([item.points], closed=item.closed)
        case Filled():
            return _polygon([item.points], closed=True)
        case Circle():
            return Path.circle(item.centre, item.radius)
        case Ellipse():
            return Path.unit_circle().transformed(Affine2D().scale(item.along, item.across).translate(*item.centre))
    if not item.spacing:
        return _polygon(item.rings, closed=True)
    return _polygon(hatch_lines(item), closed=False)


def _polygon(lines: Sequence[Sequence[tuple[float, float]]], *, closed: bool) -> Any:
    from matplotlib.path import Path

    points: list[tuple[float, float]] = []
    codes: list[Any] = []
    for line in lines:
        points += [*line, line[0]] if closed else line
        codes += [Path.MOVETO, *(Path.LINETO,) * (len(line) - 1), *([Path.CLOSEPOLY] if closed else [])]
    return Path(points or [(0.0, 0.0)], codes or [Path.MOVETO])
