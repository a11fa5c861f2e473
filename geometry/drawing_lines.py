"""What every view of a drawing is made of: points in millimetres, hatches and dimensions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from fluxbore.design.errors import one_line
from fluxbore.geometry.measure import Measure
from fluxbore.geometry.outline import Point
from fluxbore.geometry.part import Body, Part

MM = 1e3
"""Millimetres in a metre."""

APPLICATION = "FLUXBORE"
"""Under which the name of a dimension stands in its extended data."""

LONGEST = 60
"""Letters of a name in extended data, which holds 255 bytes at most."""

NARROW = 4e-6
"""m^2; smaller sections are filled, not hatched."""

View = tuple[Point, Point, float]
"""What of the model (m) stands where on the sheet (mm), and how much larger than 1:1."""

PLAIN: View = ((0.0, 0.0), (0.0, 0.0), 1.0)


def in_mm(points: Iterable[Sequence[float]], view: View = PLAIN) -> list[Point]:
    """Points (m) on the sheet (mm)."""
    (z0, y0), (left, up), scale = view
    return [(left + (z - z0) * MM * scale, up + (y - y0) * MM * scale) for z, y in points]


def add_hatch(space: Any, part: Body, number: int, polygon: Any, size: float, view: View = PLAIN) -> None:
    """The hatch of a cut face, m; neighbours' lean to opposite sides, a solid bar has none."""
    if _is_bar(part):
        return
    hatch = space.add_hatch(color=256, dxfattribs={"layer": "HATCH"})
    if polygon.area * view[2] ** 2 < NARROW:
        hatch.set_solid_fill(color=256)
    else:
        lean = (number + (part.group == "mover")) % 2  # what slides differs from what it slides in, as a rule
        hatch.set_pattern_fill("ANSI31", scale=0.2 * size * (1 + 0.15 * (number % 3)), angle=90 * lean)
    for place, ring in enumerate((polygon.exterior, *polygon.interiors)):
        hatch.paths.add_polyline_path(in_mm(ring.coords[:-1], view), is_closed=True, flags=0 if place else 1)


def _is_bar(part: Body) -> bool:
    """Whether the part is solid all along its axis."""
    if not isinstance(part, Part) or part.holes:
        return False
    heights = [z for _, z in part.profile]
    on_axis = [z for r, z in part.profile if r == 0]
    return on_axis.count(min(heights)) == on_axis.count(max(heights)) == 1 and len(on_axis) == 2


def add_dimension(space: Any, measure: Measure, start: Point, end: Point, place: float, scale: float = 1.0) -> None:
    """A DIMENSION entity between two points of the sheet; its line at x, or along the axis at y (mm)."""
    override: dict[str, Any] = {"dimpost": f"{measure.sign}<>"} if measure.sign else {}
    if scale != 1:
        override["dimlfac"] = 1 / scale
    made = space.add_linear_dim(
        base=(place, 0.0) if measure.across else (0.0, place),
        p1=start,
        p2=end,
        angle=90 if measure.across else 0,
        dimstyle=APPLICATION,
        override=override,
        dxfattribs={"layer": "DIMENSIONS"},
    )
    made.dimension.set_xdata(APPLICATION, [(1000, one_line(measure.name)[:LONGEST])])
    made.render()


def add_text(space: Any, text: str, place: Point, size: float, *, centred: bool = False) -> None:
    """One line of text from a point, or about it (mm)."""
    from ezdxf.enums import TextEntityAlignment

    entity = space.add_text(one_line(text), height=size, dxfattribs={"layer": "TEXT"})
    entity.set_placement(place, align=TextEntityAlignment.CENTER if centred else TextEntityAlignment.LEFT)
