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
from fluxbore.geometry.assembly import Assembly, Body, Part
from fluxbore.geometry.drawing_sheet import add_sheet, program
from fluxbore.geometry.measure import Measure, overall
from fluxbore.geometry.section import face, rims_beside, seen_behind

MM = 1e3
"""Millimetres in a metre."""

APPLICATION = "FLUXBORE"
"""Under which the name of a dimension stands in its extended data."""

TEXT_SHARE = 1 / 110
"""Height of the text over the longest side of the assembly: 2.5 mm on 275 mm."""

NARROW = 4e-6
"""m^2; smaller sections are filled, not hatched."""

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
        space.add_lwpolyline(_mm(line), dxfattribs={"layer": "EDGES"})
    for rim in rims_beside(assembly):
        (z, y), along, across = rim.centre, rim.along, max(rim.across, 1e-6 * rim.along)
        major, ratio = ((along, 0.0), across / along) if along >= across else ((0.0, across), along / across)
        space.add_ellipse((z * MM, y * MM), (major[0] * MM, major[1] * MM), ratio, dxfattribs={"layer": "HIDDEN"})
    space.add_line((low * MM - 3 * size, 0), (high * MM + 3 * size, 0), dxfattribs={"layer": "CENTRE"})
    measures = assembly.measures or overall(assembly.parts, 3.5 * size / MM)
    for measure in measures:
        _add_dimension(space, measure, reach * MM, size)
    rows = [measure.place for measure in measures if not measure.across]
    above, below = (reach * MM + (3 * max(side * row for row in (0, *rows)) + 5) * size for side in (-1, 1))
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


def _mm(points: Any) -> list[tuple[float, float]]:
    return [(z * MM, y * MM) for z, y in points]


def _add_part(space: Any, part: Body, number: int, size: float) -> None:
    """Outline and hatch; neighbours' hatches lean to opposite sides."""
    found = face(part)
    for polygon in getattr(found, "geoms", (found,)):
        if polygon.geom_type != "Polygon":
            continue
        rings = [_mm(ring.coords[:-1]) for ring in (polygon.exterior, *polygon.interiors)]
        for ring in rings:
            space.add_lwpolyline(ring, close=True, dxfattribs={"layer": "OUTLINE"})
        if _is_bar(part):
            continue
        hatch = space.add_hatch(color=256, dxfattribs={"layer": "HATCH"})
        if polygon.area < NARROW:
            hatch.set_solid_fill(color=256)
        else:
            hatch.set_pattern_fill("ANSI31", scale=0.2 * size * (1 + 0.15 * (number % 3)), angle=90 * (number % 2))
        for place, ring in enumerate(rings):
            hatch.paths.add_polyline_path(ring, is_closed=True, flags=0 if place else 1)


def _is_bar(part: Body) -> bool:
    """Whether the part is solid all along its axis."""
    if not isinstance(part, Part) or part.holes:
        return False
    heights = [z for _, z in part.profile]
    on_axis = [z for r, z in part.profile if r == 0]
    return bool(on_axis) and max(on_axis) == max(heights) and min(on_axis) == min(heights) and len(on_axis) == 2


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


def _add_dimension(space: Any, measure: Measure, reach: float, size: float) -> None:
    """A DIMENSION entity; its line stands at a height z, or in a row below or above the drawing, `reach` (mm) high."""
    start, end = _mm((measure.start, measure.end))
    side = 1 if measure.place < 0 else -1
    row = side * (reach + 3 * abs(measure.place) * size)
    made = space.add_linear_dim(
        base=(measure.place * MM, 0.0) if measure.across else (0.0, row),
        p1=start,
        p2=end,
        angle=90 if measure.across else 0,
        dimstyle=APPLICATION,
        override={"dimpost": f"{measure.sign}<>"} if measure.sign else {},
        dxfattribs={"layer": "DIMENSIONS"},
    )
    made.dimension.set_xdata(APPLICATION, [(1000, measure.name)])
    made.render()
