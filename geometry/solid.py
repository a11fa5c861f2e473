"""Parts as solids of the CAD kernel, in millimetres.

The kernel takes seconds to import and wants libGL (see `gl_stand_in`), so it is imported inside the functions. What a
solid must be, one body, valid, closed, of positive volume, is insisted upon here: boolean operations fail in silence.
"""

from __future__ import annotations

import math
from types import ModuleType
from typing import TYPE_CHECKING

from fluxbore.design.errors import DesignError, MissingLibraryError
from fluxbore.geometry import kernel
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.helical_solid import helical_solid
from fluxbore.geometry.kernel import MILLIMETRE, Shape
from fluxbore.geometry.part import AxialHole, Body, Hole, Part, volume

if TYPE_CHECKING:
    import cadquery

BALANCE = 1e-7
"""Relative difference of volumes at which a helical solid is not what its outline says."""


def load_cadquery() -> ModuleType:
    """The cadquery module, for whoever goes on with a solid; MissingLibraryError says how to get what it lacks."""
    kernel.load_kernel()
    try:
        import cadquery
    except ImportError as error:
        raise MissingLibraryError(f"CAD needs cadquery ({error}); get it by: pip install cadquery") from error
    module: ModuleType = cadquery
    return module


def solid(part: Body) -> cadquery.Solid:
    """`shape` as cadquery has it."""
    found: cadquery.Solid = load_cadquery().Solid(shape(part))
    return found


def shape(part: Body) -> Shape:
    """One valid closed solid of the kernel, in mm.

    Raises DesignError where the kernel does not make exactly one such body of the part, MissingLibraryError without a
    kernel.
    """
    kernel.load_kernel()
    body = helical_solid(part) if isinstance(part, HelicalPart) else _turned(part)
    if not kernel.is_valid(body) or not kernel.is_closed(body) or not (found := kernel.volume_of(body)) > 0:
        raise DesignError(f"The {part.name} must be one valid closed solid; the CAD kernel made an invalid one.")
    if isinstance(part, HelicalPart) and abs(found - (exact := volume(part))) > BALANCE * exact:
        raise DesignError(
            f"The {part.name} must have {exact * 1e9:.9g} mm^3; the CAD kernel made it with {found * 1e9:.9g} mm^3."
        )
    return body


def _turned(part: Part) -> Shape:
    corners = [(r / MILLIMETRE, 0.0, z / MILLIMETRE) for r, z in part.profile]
    body = kernel.revolved(kernel.plane_face(kernel.polygon(corners)), math.tau)
    drills = [_drill(part, hole) for hole in part.holes] + [_axial_drill(hole) for hole in part.axial_holes]
    solids = kernel.solids_of(kernel.cut(body, drills) if drills else body)
    if len(solids) != 1:
        raise DesignError(f"The {part.name} must be one solid; its drillings leave {len(solids)}.")
    return solids[0]


def is_closed(body: cadquery.Shape) -> bool:
    """Whether every shell of the shape is watertight."""
    return kernel.is_closed(body.wrapped)


def kernel_volume(body: cadquery.Shape) -> float:
    """The kernel's volume (m^3), integrated adaptively."""
    return kernel.volume_of(body.wrapped)


def _drill(part: Part, hole: Hole) -> Shape:
    c, s = math.cos(hole.angle), math.sin(hole.angle)
    outside = 1.1 * max(r for r, _ in part.profile)
    start, bottom = hole.z / MILLIMETRE, hole.bottom / MILLIMETRE
    length = outside / MILLIMETRE - bottom
    return kernel.cylinder((bottom * c, bottom * s, start), (c, s, 0.0), hole.diameter / 2 / MILLIMETRE, length)


def _axial_drill(hole: AxialHole) -> Shape:
    radius, length = hole.radius / MILLIMETRE, (hole.end - hole.start) / MILLIMETRE
    start = radius * math.cos(hole.angle), radius * math.sin(hole.angle), hole.start / MILLIMETRE
    return kernel.cylinder(start, (0.0, 0.0, 1.0), hole.diameter / 2 / MILLIMETRE, length)
