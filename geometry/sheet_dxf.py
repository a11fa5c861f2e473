"""A sheet as a DXF file (R2010, millimetres): the main view 1:1 about the model's origin, the paper around it enlarged.

What is drawn at 1:5 thus has a frame five times as large, and a machine that reads outlines cuts true sizes. The
layout "Sheet" shows all of it at the sheet's scale, for printing. Every DIMENSION entity measures what the model has,
is told by its name in extended data, and shows strokes and text of our own in its block. ezdxf is imported inside the
functions.
"""

from __future__ import annotations

import io
from collections.abc import Iterable
from typing import Any

from fluxbore.design.errors import MissingLibraryError, one_line
from fluxbore.geometry.program import program
from fluxbore.geometry.sheet import LAYERS, Circle, Dimension, Ellipse, Filled, Hatch, Place, Sheet, Stroke, Text
from fluxbore.geometry.sheet_dimension import ARROW, BEYOND, DECIMALS, GAP
from fluxbore.geometry.sheet_frame import SIZES
from fluxbore.geometry.sheet_text import SMALL

APPLICATION = "FLUXBORE"
"""Under which the name of a dimension stands in its extended data."""

LONGEST = 60
"""Letters of a name in extended data, which holds 255 bytes at most."""

FONT = "arial.ttf"

KINDS = {"along": 0, "across": 0, "round": 3, "from": 6 + 64}
"""Types of DIMENSION entities: linear, diameter, ordinate along x."""

OWN_BLOCK = 32
"""Added to the type of a dimension whose block belongs to it alone."""


def dxf_text(sheet: Sheet) -> str:
    """The whole file. Raises MissingLibraryError where ezdxf is missing."""
    document = dxf_document(sheet)
    stream = io.StringIO()
    document.write(stream)
    # A comment, which readers skip: whose the file is.
    return f"999\n{program()}\n{stream.getvalue()}"


def dxf_document(sheet: Sheet) -> Any:
    """The same as a document of ezdxf's."""
    document = _new_document(sheet)
    pen = _Pen(document, sheet)
    for item in sheet.items:
        if isinstance(item, Dimension):
            pen.dimension(item)
        else:
            pen.draw(pen.space, item)
    _add_layout(document, sheet)
    return document


def _new_document(sheet: Sheet) -> Any:
    try:
        import ezdxf
        import ezdxf.units
    except ImportError as error:
        raise MissingLibraryError(f"A DXF file needs ezdxf ({error}); get it by: pip install ezdxf") from error
    document = ezdxf.new("R2010", setup=["linetypes"], units=ezdxf.units.MM)
    document.header["$LTSCALE"] = 5 / sheet.scale
    document.appids.new(APPLICATION)
    document.styles.get("Standard").dxf.font = FONT
    for name, (colour, linetype, width) in LAYERS.items():
        document.layers.add(name, color=colour, linetype=linetype, lineweight=round(100 * width))
    size = 1 / sheet.scale
    document.dimstyles.new(
        APPLICATION,
        dxfattribs={
            "dimtxt": SMALL * size,
            "dimasz": ARROW * size,
            "dimexe": BEYOND * size,
            "dimexo": GAP * size,
            "dimgap": GAP * size,
            "dimtad": 1,
            "dimdec": DECIMALS,
            "dimzin": 8,
            "dimdsep": ord("."),
            "dimlfac": 1.0,
            "dimtih": 0,
            "dimtoh": 0,
            "dimtmove": 2,
            "dimblk": "",
            "dimtxsty": "Standard",
        },
    )
    return document


def _add_layout(document: Any, sheet: Sheet) -> None:
    """Paper of the sheet's size with a window on all of it, and the first look at the model."""
    width, height = SIZES[sheet.size]
    (left, low), scale = sheet.origin, sheet.scale
    middle = (width / 2 - left) / scale, (height / 2 - low) / scale
    document.set_modelspace_vport(height=1.1 * height / scale, center=middle)
    layout = document.layout("Layout1")
    document.layouts.rename("Layout1", "Sheet")
    layout.page_setup(size=(width, height), margins=(0, 0, 0, 0), units="mm")
    layout.add_viewport((width / 2, height / 2), (width, height), middle, height / scale)


class _Pen:
    """Draws items of a sheet into a space or a block, in the model's millimetres."""

    def __init__(self, document: Any, sheet: Sheet) -> None:
        self.document, self.space = document, document.modelspace()
        self.origin, self.scale = sheet.origin, sheet.scale

    def at(self, place: Place) -> Place:
        """A place of the paper in the file."""
        return (place[0] - self.origin[0]) / self.scale, (place[1] - self.origin[1]) / self.scale

    def all_at(self, places: Iterable[Place]) -> list[Place]:
        return [self.at(place) for place in places]

    def draw(self, space: Any, item: Stroke | Circle | Ellipse | Filled | Hatch | Text) -> None:
        layer = {"layer": item.layer}
        match item:
            case Stroke():
                space.add_lwpolyline(self.all_at(item.points), close=item.closed, dxfattribs=layer)
            case Circle():
                space.add_circle(self.at(item.centre), item.radius / self.scale, dxfattribs=layer)
            case Ellipse():
                self._ellipse(space, item)
            case Filled():
                # A SOLID's third and fourth corners are crossed; a triangle repeats its last.
                space.add_solid([*self.all_at(item.points), self.at(item.points[-1])][:4], dxfattribs=layer)
            case Hatch():
                self._hatch(space, item)
            case Text():
                self._text(space, item)

    def _ellipse(self, space: Any, item: Ellipse) -> None:
        along, across = item.along / self.scale, max(item.across / self.scale, 1e-6 * item.along / self.scale)
        major, ratio = ((along, 0.0), across / along) if along >= across else ((0.0, across), along / across)
        space.add_ellipse(self.at(item.centre), major, ratio, dxfattribs={"layer": item.layer})

    def _hatch(self, space: Any, item: Hatch) -> None:
        hatch = space.add_hatch(color=256, dxfattribs={"layer": item.layer})
        if item.spacing:
            # ANSI31 has its lines 3.175 mm apart and at 45 degrees.
            hatch.set_pattern_fill("ANSI31", scale=item.spacing / 3.175 / self.scale, angle=item.angle - 45)
        else:
            hatch.set_solid_fill(color=256)
        for place, ring in enumerate(item.rings):
            hatch.paths.add_polyline_path(self.all_at(ring), is_closed=True, flags=0 if place else 1)

    def _text(self, space: Any, item: Text) -> None:
        from ezdxf.enums import TextEntityAlignment

        anchors = {
            "left": TextEntityAlignment.LEFT,
            "middle": TextEntityAlignment.CENTER,
            "right": TextEntityAlignment.RIGHT,
        }
        attributes = {"layer": item.layer, "rotation": item.angle, "style": "Standard"}
        entity = space.add_text(one_line(item.text), height=item.size / self.scale, dxfattribs=attributes)
        entity.set_placement(self.at(item.place), align=anchors[item.anchor])

    def dimension(self, item: Dimension) -> None:
        """An entity with its points; what it shows stands in a block of its own."""
        block = self.document.blocks.new_anonymous_block(type_char="D")
        for stroke in item.strokes:
            self.draw(block, stroke)
        if item.shown.text:
            self.draw(block, item.shown)
        (start, end), (x, y) = self.all_at(item.points), self.at((item.line, item.line))
        middle = self.at(item.shown.place)
        attributes: dict[str, Any] = {
            "layer": "DIMENSIONS",
            "dimtype": KINDS[item.kind] + OWN_BLOCK,
            "dimstyle": APPLICATION,
            "geometry": block.name,
            "text": item.label.replace("Ø", "%%c"),
            "text_midpoint": middle,
        }
        match item.kind:
            case "from":
                attributes |= {"defpoint": start, "defpoint2": end, "defpoint3": (end[0], y)}
            case "round":
                attributes |= {"defpoint": start, "defpoint4": end}
            case "across":
                attributes |= {"defpoint": (x, end[1]), "defpoint2": start, "defpoint3": end, "angle": 90}
            case _:
                attributes |= {"defpoint": (end[0], y), "defpoint2": start, "defpoint3": end, "angle": 0}
        entity = self.space.new_entity("DIMENSION", dxfattribs=attributes)
        entity.set_xdata(APPLICATION, [(1000, one_line(item.name)[:LONGEST])])
        if item.factor != 1:
            style = entity.override()
            style.update({"dimlfac": item.factor})
            style.commit()
