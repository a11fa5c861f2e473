"""An assembly's longitudinal section as a DXF file (R2010, millimetres, 1:1): outlines, hatch, dimensions, parts list.

Layers, so that a reader can hide what is in the way:

    OUTLINE what the plane cuts   EDGES seen behind it       HIDDEN drillings beside it   CENTRE the axis
    HATCH                         DIMENSIONS with DIMENSION entities, each told by its name in extended data
    TEXT parts list and title     SHEET their lines

Solid bars (rods, shafts) are not hatched, as ISO 128-3 has it; sections too narrow for a hatch are filled. Text grows
with the assembly, so that all of the sheet can be read at once. ezdxf is imported inside the functions.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import Any

from fluxbore.design.errors import MissingLibraryError
from fluxbore.design.materials import Material
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.drawing_detail import add_detail
from fluxbore.geometry.drawing_lines import APPLICATION, MM, add_dimension, add_hatch, in_mm
from fluxbore.geometry.drawing_sheet import add_sheet, program
from fluxbore.geometry.measure import Measure, overall
from fluxbore.geometry.part import Body
from fluxbore.geometry.section import face, rims_beside, seen_behind

TEXT_SHARE = 1 / 110
"""Height of the text over the longest side of the assembly: 2.5 mm on 275 mm."""

LAYERS = {
    "OUTLINE": (7, "Continuous", 50),
    "EDGES": (7, "Continuous", 25),
    "HIDDEN": (8, "DASHED", 18),
    "CENTRE": (1, "CENTER", 18),
    "HATCH": (8, "Continuous", 13),
    "DIMENSIONS": (5, "Continuous", 18),
    "TEXT": (7, "Continuous", 25),
    "SHEET": (7, "Continuous", 25),
}
"""Colour index, line type and line weight (1/100 mm)."""


def dxf_text(assembly: Assembly, materials: Mapping[str, Material]) -> str:
    """The whole file. Raises MissingLibraryError where ezdxf is missing."""
    document = dxf_document(assembly, materials)
    stream = io.StringIO()
    document.write(stream)
    # A comment, which readers skip: whose the file is.
    return f"999\n{program()}\n{stream.getvalue()}"


def dxf_document(assembly: Assembly, materials: Mapping[str, Material]) -> Any:
    """The same as a document of ezdxf's."""
    ezdxf = _load_ezdxf()
    low, high, reach = _extent(assembly)
    size = max(high - low, 2 * reach) * MM * TEXT_SHARE
    document = ezdxf.new("R2010", setup=["linetypes"], units=ezdxf.units.MM)
    document.header["$LTSCALE"] = 2 * size
    document.appids.new(APPLICATION)
    for name, (colour, linetype, weight) in LAYERS.items():
        document.layers.add(name, color=colour, linetype=linetype, lineweight=weight)
    _add_style(document, size)
    space = document.modelspace()
    for number, part in enumerate(assembly.parts):
        _add_part(space, part, number, size)
    for line in seen_behind(assembly):
        space.add_lwpolyline(in_mm(line), dxfattribs={"layer": "EDGES"})
    for rim in rims_beside(assembly):
        (z, y), along, across = rim.centre, rim.along, max(rim.across, 1e-6 * rim.along)
        major, ratio = ((along, 0.0), across / along) if along >= across else ((0.0, across), along / across)
        space.add_ellipse((z * MM, y * MM), (major[0] * MM, major[1] * MM), ratio, dxfattribs={"layer": "HIDDEN"})
    space.add_line((low * MM - 3 * size, 0), (high * MM + 3 * size, 0), dxfattribs={"layer": "CENTRE"})
    measures = assembly.measures or overall(assembly.parts, 3.5 * size / MM)
    for measure in measures:
        _add_measure(space, measure, reach * MM, size)
    rows = [measure.place for measure in measures if not measure.across]
    above, below = (reach * MM + (3 * max(side * row for row in (0, *rows)) + 5) * size for side in (-1, 1))
    right = high * MM + 8 * size
    for detail in assembly.details:
        right = add_detail(space, assembly, detail, (right, -below), size)
    add_sheet(space, assembly, materials, (above, -below), size)
    document.set_modelspace_vport(
        height=1.2 * max(high - low, 4 * reach) * MM, center=((low + high) / 2 * MM, -reach * MM)
    )
    return document


def _load_ezdxf() -> Any:
    try:
        import ezdxf
        import ezdxf.units
    except ImportError as error:
        raise MissingLibraryError(f"A DXF file needs ezdxf ({error}); get it by: pip install ezdxf") from error
    return ezdxf


def _extent(assembly: Assembly) -> tuple[float, float, float]:
    """Lowest and highest z, and the largest radius (m)."""
    points = [point for part in assembly.parts for point in part.profile]
    heights = [z for _, z in points]
    return min(heights), max(heights), max(r for r, _ in points)


def _add_part(space: Any, part: Body, number: int, size: float) -> None:
    found = face(part)
    for polygon in getattr(found, "geoms", (found,)):
        for ring in (polygon.exterior, *polygon.interiors):
            space.add_lwpolyline(in_mm(ring.coords[:-1]), close=True, dxfattribs={"layer": "OUTLINE"})
        add_hatch(space, part, number, polygon, size)


def _add_style(document: Any, size: float) -> None:
    document.dimstyles.new(
        APPLICATION,
        dxfattribs={
            "dimtxt": size,
            "dimasz": size,
            "dimexe": 0.5 * size,
            "dimexo": 0.3 * size,
            "dimgap": 0.3 * size,
            "dimtad": 1,
            "dimdec": 3,
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


def _add_measure(space: Any, measure: Measure, reach: float, size: float) -> None:
    """Its line stands at a height z, or in a row below or above the drawing, which is `reach` (mm) high."""
    side = 1 if measure.place < 0 else -1
    row = side * (reach + 3 * abs(measure.place) * size)
    start, end = in_mm((measure.start, measure.end))
    add_dimension(space, measure, start, end, measure.place * MM if measure.across else row)
