"""Parts as solids of the CAD kernel (Open CASCADE, through cadquery), in millimetres, and as triangles for a picture.

cadquery takes seconds to import and wants libGL (see `gl_stand_in`), so it is imported inside the functions. Everything
a solid must be, one body, valid, closed, of positive volume, is insisted upon here: boolean operations fail in silence.
"""

from __future__ import annotations

import math
from types import ModuleType
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from fluxbore.design.errors import DesignError, MissingLibraryError
from fluxbore.design.graphics import APT_LINE, has_gl
from fluxbore.geometry import gl_stand_in
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.helical_mesh import triangles
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.helical_solid import MILLIMETRE, helical_solid
from fluxbore.geometry.part import AxialHole, Body, Colour, Hole, Part, volume

if TYPE_CHECKING:
    import cadquery

QUARTER = math.pi / 2

BALANCE = 1e-7
"""Relative difference of volumes at which a helical solid is not what its outline says."""

ANGULAR_TOLERANCE = 0.1
"""rad between neighbouring facets: 63 to a turn."""


class Mesh(NamedTuple):
    """Triangles of one part. vertices : (n, 3) in m; corners are repeated where faces meet, so that edges stay sharp.
    triangles : (m, 3) indices into them, counter-clockwise from outside."""

    name: str
    colour: Colour
    vertices: npt.NDArray[np.float64]
    triangles: npt.NDArray[np.int64]


def load_cadquery() -> ModuleType:
    """The cadquery module; MissingLibraryError says how to get what it lacks."""
    if not has_gl() and not gl_stand_in.load():
        raise MissingLibraryError(f"CAD needs the system library libGL.so.1; get it by: {APT_LINE}")
    try:
        import cadquery
    except ImportError as error:
        raise MissingLibraryError(f"CAD needs cadquery ({error}); get it by: pip install cadquery") from error
    module: ModuleType = cadquery
    return module


def solid(part: Body, opening: float = 0.0) -> cadquery.Solid:
    """One valid closed solid, in mm.

    opening : the sector from angle 0 (+x) to this one (rad) is left out of a revolution, for a look inside; what
    follows a helix stays whole. Raises DesignError where the kernel does not make exactly one such body of the part.
    """
    cq = load_cadquery()
    body = helical_solid(part) if isinstance(part, HelicalPart) else _turned(cq, part, opening)
    if not body.isValid() or not is_closed(body) or not (found := kernel_volume(body)) > 0:
        raise DesignError(f"The {part.name} must be one valid closed solid; the CAD kernel made an invalid one.")
    if isinstance(part, HelicalPart) and abs(found - (exact := volume(part))) > BALANCE * exact:
        raise DesignError(
            f"The {part.name} must have {exact * 1e9:.9g} mm^3; the CAD kernel made it with {found * 1e9:.9g} mm^3."
        )
    return body


def _turned(cq: ModuleType, part: Part, opening: float) -> cadquery.Solid:
    corners = [
        cq.Vector(r * math.cos(opening) / MILLIMETRE, r * math.sin(opening) / MILLIMETRE, z / MILLIMETRE)
        for r, z in part.profile
    ]
    wire = cq.Wire.makePolygon(corners, close=True)
    body = cq.Solid.revolve(wire, [], 360 - math.degrees(opening), cq.Vector(0, 0, 0), cq.Vector(0, 0, 1))
    drills = [_drill(cq, part, hole) for hole in part.holes] + [_axial_drill(cq, hole) for hole in part.axial_holes]
    # All at once: that takes a fraction of the time of one after the other.
    return _one_solid(body.cut(*drills) if drills else body, part)


def is_closed(body: cadquery.Shape) -> bool:
    """Whether every shell of the shape is watertight."""
    from OCP.BRep import BRep_Tool

    shells = body.Shells()
    return bool(shells) and all(BRep_Tool.IsClosed_s(shell.wrapped) for shell in shells)


def kernel_volume(body: cadquery.Shape) -> float:
    """The kernel's volume (m^3), integrated adaptively: its quick rule is 1e-5 off where a drilling meets a bore."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(body.wrapped, properties, 1e-9)
    return float(properties.Mass()) * MILLIMETRE**3


def tessellate(assembly: Assembly, tolerance: float, cut_away: bool = False) -> list[Mesh]:
    """Triangles of every part, in the assembly's order, no farther than ``tolerance`` (m) from the surface.

    cut_away : the group outside lacks the quarter from +x to +y, whose first face shows the ports cut; the other stays
    whole. A part of which nothing is left then has no triangles.
    """
    meshes = []
    for part in assembly.parts:
        opening = QUARTER if cut_away and part.group == assembly.outside else 0.0
        if isinstance(part, HelicalPart):
            meshes.append(Mesh(part.name, part.colour, *triangles(part, tolerance, ANGULAR_TOLERANCE, opening)))
            continue
        body = solid(part, opening)
        vertices, corners = body.tessellate(tolerance / MILLIMETRE, ANGULAR_TOLERANCE)
        points = np.array([vertex.toTuple() for vertex in vertices], dtype=np.float64) * MILLIMETRE
        meshes.append(Mesh(part.name, part.colour, points, np.array(corners, dtype=np.int64)))
    return meshes


def _drill(cq: ModuleType, part: Part, hole: Hole) -> cadquery.Solid:
    outside = 1.1 * max(r for r, _ in part.profile)
    along = cq.Vector(math.cos(hole.angle), math.sin(hole.angle), 0)
    start = along * (hole.bottom / MILLIMETRE) + cq.Vector(0, 0, hole.z / MILLIMETRE)
    radius, length = hole.diameter / 2 / MILLIMETRE, (outside - hole.bottom) / MILLIMETRE
    return cq.Solid.makeCylinder(radius, length, start, along)


def _axial_drill(cq: ModuleType, hole: AxialHole) -> cadquery.Solid:
    x, y = hole.radius * math.cos(hole.angle), hole.radius * math.sin(hole.angle)
    start = cq.Vector(x / MILLIMETRE, y / MILLIMETRE, hole.start / MILLIMETRE)
    length = (hole.end - hole.start) / MILLIMETRE
    return cq.Solid.makeCylinder(hole.diameter / 2 / MILLIMETRE, length, start, cq.Vector(0, 0, 1))


def _one_solid(shape: cadquery.Shape, part: Part) -> cadquery.Solid:
    """The only solid in a shape: a cut returns a compound, which may hold none or several."""
    solids = shape.Solids()
    if len(solids) != 1:
        raise DesignError(f"The {part.name} must be one solid; its drillings leave {len(solids)}.")
    return solids[0]
