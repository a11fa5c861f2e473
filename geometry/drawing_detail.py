"""A detail of a drawing: a circle of the section beside it, enlarged by a scale of ISO 5455, with dimensions."""

from __future__ import annotations

from typing import Any

from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.drawing_lines import MM, View, add_dimension, add_hatch, add_text, in_mm
from fluxbore.geometry.measure import Detail
from fluxbore.geometry.outline import Point
from fluxbore.geometry.section import face

SCALES = (1, 2, 5, 10, 20, 50, 100)
"""To one, as ISO 5455 has them for enlargements."""

LARGEST = 12.0
"""Radius of a detail over the height of the text."""


def add_detail(space: Any, assembly: Assembly, detail: Detail, corner: Point, size: float) -> float:
    """Draw it to the right of and above a corner of the sheet (mm); return where the next one may begin (mm).

    size : of the text (mm).
    """
    import shapely

    scale = max((scale for scale in SCALES if scale * detail.reach * MM <= LARGEST * size), default=1)
    radius = scale * detail.reach * MM
    middle = corner[0] + radius + 8 * size, max(0.0, corner[1] + radius + 8 * size)
    view: View = (detail.centre, middle, float(scale))
    disc = shapely.Point(detail.centre).buffer(detail.reach, quad_segs=32)
    for number, part in enumerate(assembly.parts):
        found = face(part)
        for line in _parts_of(found.boundary.intersection(disc), "LineString"):
            space.add_lwpolyline(in_mm(line.coords, view), dxfattribs={"layer": "OUTLINE"})
        for polygon in _parts_of(found.intersection(disc), "Polygon"):
            add_hatch(space, part, number, polygon, size, view)
    space.add_circle(middle, radius, dxfattribs={"layer": "EDGES"})
    for measure in detail.measures:
        (place,) = in_mm([(measure.place, measure.place)], view)
        start, end = in_mm((measure.start, measure.end), view)
        add_dimension(space, measure, start, end, place[0] if measure.across else place[1], scale)
    z, y = (value * MM for value in detail.centre)
    around = 1.1 * detail.reach * MM
    space.add_circle((z, y), around, dxfattribs={"layer": "EDGES"})
    add_text(space, detail.name, (z + around, y + around), 1.4 * size)
    add_text(space, f"{detail.name} ({scale}:1)", (middle[0], middle[1] - radius - 3 * size), 1.4 * size, centred=True)
    return middle[0] + radius + 8 * size


def _parts_of(shape: Any, kind: str) -> list[Any]:
    """The shapes of one kind in a shape or a collection of them."""
    return [piece for piece in getattr(shape, "geoms", (shape,)) if piece.geom_type == kind and not piece.is_empty]
