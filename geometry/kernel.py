"""The CAD kernel's few calls that solids are made with (Open CASCADE through OCP), in millimetres.

OCP alone: cadquery on top of it would load a graphics toolkit that takes as long again.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

from fluxbore.design.errors import MissingLibraryError
from fluxbore.design.graphics import APT_LINE, has_gl
from fluxbore.geometry import gl_stand_in

MILLIMETRE = 1e-3

Shape = Any
"""A TopoDS_Shape, one of its kinds."""

Place = tuple[float, float, float]
"""(x, y, z) in mm."""


def load_kernel() -> None:
    """Import the kernel, and keep it from chatting. Raises MissingLibraryError: how to get what is missing."""
    if not has_gl() and not gl_stand_in.load():
        raise MissingLibraryError(f"CAD needs the system library libGL.so.1; get it by: {APT_LINE}")
    try:
        from OCP.Message import Message, Message_Gravity
    except ImportError as error:
        raise MissingLibraryError(f"CAD needs cadquery ({error}); get it by: pip install cadquery") from error
    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)


def polygon(corners: Sequence[Place]) -> Shape:
    """A closed wire."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakePolygon
    from OCP.gp import gp_Pnt

    made = BRepBuilderAPI_MakePolygon()
    for corner in corners:
        made.Add(gp_Pnt(*corner))
    made.Close()
    return made.Wire()


def plane_face(wire: Shape) -> Shape:
    """What a plane wire encloses."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace

    return BRepBuilderAPI_MakeFace(wire, True).Face()


def revolved(face: Shape, angle: float) -> Shape:
    """A face turned about z (rad), up to a whole turn."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeRevol
    from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt

    return BRepPrimAPI_MakeRevol(face, gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), angle, True).Shape()


def cylinder(start: Place, along: Place, radius: float, length: float) -> Shape:
    """Its axis begins at the middle of one end and goes along a direction."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(*start), gp_Dir(*along)), radius, length, math.tau).Shape()


def cut(body: Shape, tools: Iterable[Shape]) -> Shape:
    """The body without the tools, all at once: that takes a fraction of the time of one after the other."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
    from OCP.TopTools import TopTools_ListOfShape

    operation, bodies, cutters = BRepAlgoAPI_Cut(), TopTools_ListOfShape(), TopTools_ListOfShape()
    bodies.Append(body)
    for tool in tools:
        cutters.Append(tool)
    operation.SetArguments(bodies)
    operation.SetTools(cutters)
    operation.Build()
    return operation.Shape()


def solids_of(shape: Shape) -> list[Shape]:
    """The solids in a shape: a cut gives a compound, which may hold none or several."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    return [TopoDS.Solid_s(found) for found in _parts(shape, TopAbs_ShapeEnum.TopAbs_SOLID)]


def is_valid(shape: Shape) -> bool:
    from OCP.BRepCheck import BRepCheck_Analyzer

    return bool(BRepCheck_Analyzer(shape).IsValid())


def is_closed(shape: Shape) -> bool:
    """Whether every shell of the shape is watertight."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum

    shells = _parts(shape, TopAbs_ShapeEnum.TopAbs_SHELL)
    return bool(shells) and all(BRep_Tool.IsClosed_s(shell) for shell in shells)


def volume_of(shape: Shape) -> float:
    """m^3, integrated adaptively: the kernel's quick rule is 1e-5 off where a drilling meets a bore."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties, 1e-9)
    return float(properties.Mass()) * MILLIMETRE**3


def _parts(shape: Shape, kind: Any) -> list[Shape]:
    from OCP.TopExp import TopExp
    from OCP.TopTools import TopTools_IndexedMapOfShape

    found = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, kind, found)
    return [found.FindKey(i) for i in range(1, found.Extent() + 1)]
