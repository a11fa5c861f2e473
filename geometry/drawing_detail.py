"""A detail of a drawing: a circle of the section beside it, enlarged by a scale of ISO 5455, with dimensions."""

from __future__ import annotations

from typing import Any

from fluxbore.geometry.measure import Detail, Measure
from fluxbore.geometry.sheet import Circle, Hatch, Item, Stroke, Text, moved
from fluxbore.geometry.sheet_dimension import linear
from fluxbore.geometry.sheet_frame import SCALES, scale_text
from fluxbore.geometry.sheet_text import LARGE
from fluxbore.geometry.sheet_view import MM, Section, cut, on_paper, polygons

LARGEST = 26.0
"""mm, radius of a detail."""


def detail_view(section: Section, detail: Detail, scale: float) -> tuple[list[Item], list[Item]]:
    """The enlarged circle with its dimensions about its own middle, and the mark of it in the main view (mm)."""
    larger = next((s for s in SCALES if s * detail.reach * MM <= LARGEST), scale)
    larger = max(larger, scale)
    radius = larger * detail.reach * MM
    items = [*_cut_out(section, detail, larger), Circle("EDGES", (0.0, 0.0), radius)]
    items += [_dimension(measure, detail, scale, larger) for measure in detail.measures]
    name = f"{detail.name} ({scale_text(larger)})"
    items.append(Text(name, (0.0, -radius - LARGE - 2), LARGE, "middle"))
    ((z, y),) = on_paper([detail.centre], scale)
    around = 1.1 * detail.reach * MM * scale
    marks: list[Item] = [
        Circle("EDGES", (z, y), around),
        Text(detail.name, (z + around, y + around), LARGE),
    ]
    return items, marks


def _cut_out(section: Section, detail: Detail, scale: float) -> list[Item]:
    """What the circle holds of every face, about the circle's middle; its rim is no outline."""
    import shapely

    disc = shapely.Point(detail.centre).buffer(detail.reach, quad_segs=32)
    items: list[Item] = []
    for number, (part, found) in enumerate(zip(section.parts, section.faces, strict=True)):
        for polygon in polygons(found.intersection(disc)):
            items += [item for item in cut(part, number, polygon, scale) if isinstance(item, Hatch)]
        for line in _lines(found.boundary.intersection(disc)):
            items.append(Stroke("OUTLINE", on_paper(line.coords, scale)))
    (middle,) = on_paper([detail.centre], scale)
    return [moved(item, (-middle[0], -middle[1])) for item in items]


def _lines(shape: Any) -> list[Any]:
    found = getattr(shape, "geoms", (shape,))
    return [piece for piece in found if piece.geom_type == "LineString" and not piece.is_empty]


def _dimension(measure: Measure, detail: Detail, scale: float, larger: float) -> Item:
    """With its line where the measure says, z of one across the axis and y' of one along it."""
    z, y = detail.centre
    start, end = on_paper([(p[0] - z, p[1] - y) for p in (measure.start, measure.end)], larger)
    line = (measure.place - (z if measure.across else y)) * MM * larger
    label = f"{measure.sign}<>".replace("%%c", "Ø")
    return linear(
        measure.name,
        start,
        end,
        line,
        measure.length * MM,
        across=measure.across,
        label=label,
        factor=scale / larger,
    )
