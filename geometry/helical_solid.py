"""Helical parts as solids of the CAD kernel, in millimetres: faces that share their edges, sewn; no boolean is needed.

The outline is cut along generators into cells of less than a turn. Over each cell the inside and the outside are faces
on a cylinder of their own, whose seam lies opposite; the long sides are ruled between the edges.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any, NamedTuple

from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity
from fluxbore.geometry import kernel, unrolled
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.kernel import MILLIMETRE, Shape

WIDEST = 2 * math.pi / 3
"""rad. Of a cell; a face of half a turn or more would reach its cylinder's seam when a reader puts that elsewhere."""

CURVE = 1e-7
"""mm, from a helix to the polynomial that the kernel keeps of it."""

THINNEST = 1e-6
"""m. Nobody makes a thinner magnet, and the kernel, which calls points 1e-10 m apart the same, is far from trouble."""

SEAM = 1e-6
"""mm. Edges of neighbouring faces that are no farther apart are one."""


class _Cell(NamedTuple):
    """A trapezoid or triangle: its angles (rad), and its lower and upper end at each (mm)."""

    start: float
    end: float
    first: tuple[float, float]
    last: tuple[float, float]


def helical_solid(part: HelicalPart) -> Shape:
    """One closed solid, in mm; its validity and volume are the caller's to look at.

    Raises DesignError where the part is too thin for the kernel, which would crash, and where it leaves faces apart.
    """
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
    from OCP.BRepLib import BRepLib
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    _check(part)
    sewing = BRepBuilderAPI_Sewing(SEAM)
    for face in _faces(part):
        sewing.Add(face)
    sewing.Perform()
    sewn = sewing.SewedShape()
    if sewn.ShapeType() != TopAbs_ShapeEnum.TopAbs_SHELL or sewing.NbFreeEdges():
        raise DesignError(f"The {part.name} must be one closed solid; the CAD kernel left its faces apart.")
    body = BRepBuilderAPI_MakeSolid(TopoDS.Shell_s(sewn)).Solid()
    BRepLib.OrientClosedSolid_s(body)
    return body


def _check(part: HelicalPart) -> None:
    sizes = (part.outer_radius - part.inner_radius, part.width, part.angle * part.inner_radius)
    for size, what in zip(sizes, ("radially", "along the axis", "around it"), strict=True):
        if size < THINNEST:
            raise DesignError(
                f"The {part.name} must be at least {format_quantity(THINNEST, 'length')} {what} for the CAD kernel; "
                f"got {format_quantity(size, 'length', 6)}."
            )


def _cells(part: HelicalPart) -> list[_Cell]:
    lower, upper = unrolled.chains(part.outline)
    first, *between, last = sorted({theta for theta, _ in (*lower, *upper)})
    apart = SEAM * MILLIMETRE / part.inner_radius
    corners = [first]
    for theta in between:
        # Two corners above one another may differ by a rounding, and the kernel crashes on a face without width.
        if theta - corners[-1] > apart and last - theta > apart:
            corners.append(theta)
    corners.append(last)
    angles = []
    for a, b in pairwise(corners):
        pieces = math.ceil((b - a) / WIDEST)
        angles += [a + (b - a) * i / pieces for i in range(pieces)]
    angles.append(corners[-1])
    spans = [(unrolled.at(lower, theta) / MILLIMETRE, unrolled.at(upper, theta) / MILLIMETRE) for theta in angles]
    return [_Cell(angles[i], angles[i + 1], spans[i], spans[i + 1]) for i in range(len(angles) - 1)]


def _faces(part: HelicalPart) -> list[Any]:
    from OCP.BRepFill import BRepFill

    radii = (part.inner_radius / MILLIMETRE, part.outer_radius / MILLIMETRE)
    cells = _cells(part)
    found = []
    for cell in cells:
        curved = [_curved(cell, radius) for radius in radii]
        found += [face for face, _, _ in curved]
        (_, low_inside, high_inside), (_, low_outside, high_outside) = curved
        found += [BRepFill.Face_s(low_inside, low_outside), BRepFill.Face_s(high_inside, high_outside)]
    ends = ((cells[0].start, cells[0].first), (cells[-1].end, cells[-1].last))
    found += [_end(radii, theta, span) for theta, span in ends if span[1] - span[0] > SEAM]
    return found


def _curved(cell: _Cell, radius: float) -> tuple[Any, Any, Any]:
    """The cell on a cylinder (mm), and its lower and its upper edge."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
    from OCP.Geom import Geom_CylindricalSurface
    from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt

    seam = (cell.start + cell.end) / 2 - math.pi
    place = gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(math.cos(seam), math.sin(seam), 0))
    surface = Geom_CylindricalSurface(place, radius)
    start, end = cell.start - seam, cell.end - seam
    (low, high), (onwards, above) = cell.first, cell.last
    lower, upper = _edge(surface, (start, low), (end, onwards)), _edge(surface, (end, above), (start, high))
    wire = BRepBuilderAPI_MakeWire()
    wire.Add(lower)
    if above - onwards > SEAM:
        wire.Add(_edge(surface, (end, onwards), (end, above)))
    wire.Add(upper)
    if high - low > SEAM:
        wire.Add(_edge(surface, (start, high), (start, low)))
    face = BRepBuilderAPI_MakeFace(surface, wire.Wire(), True).Face()
    return face, lower, _edge(surface, (start, high), (end, above))


def _edge(surface: Any, start: tuple[float, float], end: tuple[float, float]) -> Any:
    """What a straight line of the unrolled plane is on a cylinder."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge
    from OCP.BRepLib import BRepLib
    from OCP.GCE2d import GCE2d_MakeSegment
    from OCP.GeomAbs import GeomAbs_Shape
    from OCP.gp import gp_Pnt2d

    segment = GCE2d_MakeSegment(gp_Pnt2d(*start), gp_Pnt2d(*end)).Value()
    edge = BRepBuilderAPI_MakeEdge(segment, surface).Edge()
    BRepLib.BuildCurves3d_s(edge, CURVE, GeomAbs_Shape.GeomAbs_C1, 14, 64)
    return edge


def _end(radii: tuple[float, float], theta: float, span: tuple[float, float]) -> Any:
    """The flat face at a generator."""
    corners = [(radii[0], span[0]), (radii[1], span[0]), (radii[1], span[1]), (radii[0], span[1])]
    return kernel.plane_face(kernel.polygon([(r * math.cos(theta), r * math.sin(theta), z) for r, z in corners]))
