"""Parts as triangles without the CAD kernel: bodies of revolution by their profile, drillings taken away by manifold.

manifold3d subtracts closed surfaces from one another and leaves a closed one, always; the normals travel along. So
pictures and printers' files need neither libGL nor the seconds that cadquery takes to load.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from fluxbore.design.errors import DesignError
from fluxbore.geometry.helical_mesh import triangles as helical_triangles
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.outline import Profile, rectangle
from fluxbore.geometry.part import AxialHole, Body, Hole, Part
from fluxbore.geometry.surface import EMPTY, Surface, shaded, unit

if TYPE_CHECKING:
    from fluxbore.geometry.surface import Floats, Numbers

QUARTER = math.pi / 2

STEP = 0.1
"""rad between neighbouring facets of a part at most: 64 to a turn."""

HOLE_STEP = 0.3
"""rad; a drilling is small beside its part."""

CREASE = math.radians(30)
"""Two stretches of a profile that meet at less are one rounding, shaded as such."""


def surface(part: Body, tolerance: float, *, cut_open: bool = False) -> Surface:
    """The part's surface, no farther than ``tolerance`` (m) from the true one, inside of it where that is convex.

    cut_open : the quarter from +x to +y is left out, for a look inside; of a part that lies there nothing is left.
    Raises DesignError where drillings leave nothing.
    """
    if isinstance(part, HelicalPart):
        points, faces = helical_triangles(part, tolerance, STEP, QUARTER if cut_open else 0.0)
        return shaded(points, faces) if len(faces) else EMPTY
    whole = _revolved(part.profile, tolerance, STEP)
    tools = [_drill(part, hole, tolerance) for hole in part.holes]
    tools += [_axial_drill(hole, tolerance) for hole in part.axial_holes]
    if cut_open:
        tools.append(_quarter(part.profile))
    if not tools:
        return _as_surface(*whole[:2], whole[3])
    found = _difference(whole, tools)
    if found.is_empty and not cut_open:
        raise DesignError(f"The {part.name} must be one solid; its drillings leave nothing.")
    return found


_Raw = tuple["Floats", "Floats", "Numbers", "Numbers"]
"""Points, normals, for each point the first one at the same place, triangles."""


def facets(radius: float, tolerance: float, step: float) -> int:
    """How many sides a circle of this radius (m) has: a multiple of four, so that quarters end at a corner."""
    widest = min(step, 2 * math.acos(max(1 - tolerance / radius, 0.0)))
    return 4 * math.ceil(QUARTER / widest - 1e-9)


def _revolved(profile: Profile, tolerance: float, step: float) -> _Raw:
    """The body of a counter-clockwise profile, each stretch of it with points and normals of its own."""
    corners = np.array(profile)
    count, n = len(corners), facets(float(corners[:, 0].max()), tolerance, step)
    ahead = np.roll(corners, -1, axis=0) - corners
    outwards = np.column_stack([ahead[:, 1], -ahead[:, 0]]) / np.linalg.norm(ahead, axis=1, keepdims=True)
    angle = np.arange(n) * (2 * math.pi / n)
    around = np.round(np.column_stack([np.cos(angle), np.sin(angle)]), 15)  # exact at the quarters
    points, normals, places, faces = [], [], [], []
    station = np.arange(n)
    following = (station + 1) % n
    for i in range(count):
        ends = (i, (i + 1) % count)
        base = 2 * n * i
        for corner, beside in zip(ends, ((i - 1) % count, (i + 1) % count), strict=True):
            (r, z), normal = corners[corner], outwards[i]
            if float(normal @ outwards[beside]) > math.cos(CREASE):
                normal = normal + outwards[beside]
            points.append(np.column_stack([r * around, np.full(n, z)]))
            normals.append(np.column_stack([normal[0] * around, np.full(n, normal[1])]))
            # On the axis all stations are one point.
            places.append(2 * n * corner + (station if r > 0 else np.zeros(n, dtype=np.int64)))
        a, b, c, d = base + station, base + following, base + n + following, base + n + station
        if corners[ends[0]][0] > 0:
            faces.append(np.column_stack([a, b, c if corners[ends[1]][0] > 0 else d]))
        if corners[ends[1]][0] > 0:
            faces.append(np.column_stack([a, c, d]))
    return np.concatenate(points), unit(np.concatenate(normals)), np.concatenate(places), np.concatenate(faces)


def _drill(part: Part, hole: Hole, tolerance: float) -> _Raw:
    beyond = 1.1 * max(r for r, _ in part.profile)
    radius = hole.diameter / 2
    along = np.array([0.0, 0.0, 1.0])
    points, normals, places, faces = _revolved(rectangle(0.0, radius, hole.bottom, beyond), tolerance, HOLE_STEP)
    outwards = np.array([math.cos(hole.angle), math.sin(hole.angle), 0.0])
    turn = np.array([np.cross(along, outwards), along, outwards])
    return points @ turn + hole.z * along, -normals @ turn, places, faces


def _axial_drill(hole: AxialHole, tolerance: float) -> _Raw:
    points, normals, places, faces = _revolved(
        rectangle(0.0, hole.diameter / 2, hole.start, hole.end), tolerance, HOLE_STEP
    )
    centre = np.array([hole.radius * math.cos(hole.angle), hole.radius * math.sin(hole.angle), 0.0])
    return points + centre, -normals, places, faces


def _quarter(profile: Profile) -> _Raw:
    """The block over x > 0, y > 0, with the normals that its faces give to what is left."""
    radii, heights = zip(*profile, strict=True)
    reach, beyond = 1.1 * max(radii), 0.1 * max(radii)
    low = np.array([0.0, 0.0, min(heights) - beyond])
    size = np.array([reach, reach, max(heights) + beyond]) - np.array([0.0, 0.0, low[2]])
    points: list[Floats] = []
    normals: list[Floats] = []
    places: list[Numbers] = []
    faces: list[Numbers] = []
    for axis in range(3):
        second, third = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            square = np.zeros((4, 3))
            square[:, axis] = side
            square[[1, 2], second] = 1
            square[[2, 3], third] = 1
            base = 4 * len(points)
            points.append(low + square * size)
            normals.append(np.tile((1 - 2 * side) * np.eye(3)[axis], (4, 1)))
            places.append((square @ [1, 2, 4]).astype(np.int64))
            order = [[0, 1, 2], [0, 2, 3]] if side else [[0, 2, 1], [0, 3, 2]]
            faces.append(base + np.array(order))
    names = np.concatenate(places)
    first = {int(name): i for i, name in reversed(list(enumerate(names)))}
    return (
        np.concatenate(points),
        np.concatenate(normals),
        np.array([first[int(n)] for n in names]),
        np.concatenate(faces),
    )


def _as_surface(points: Floats, normals: Floats, triangles: Numbers) -> Surface:
    """Without the points that no triangle has."""
    used, which = np.unique(triangles, return_inverse=True)
    return Surface(points[used], normals[used], which.reshape(triangles.shape).astype(np.int64))


def _difference(whole: _Raw, tools: list[_Raw]) -> Surface:
    import manifold3d

    body, *others = (_solid(manifold3d, raw) for raw in (whole, *tools))
    left = manifold3d.Manifold.batch_boolean([body, *others], manifold3d.OpType.Subtract)
    mesh = left.to_mesh64()
    found, faces = np.asarray(mesh.vert_properties), np.asarray(mesh.tri_verts, dtype=np.int64)
    return _as_surface(found[:, :3], unit(found[:, 3:6]), faces) if len(faces) else EMPTY


def _solid(manifold3d: Any, raw: _Raw) -> Any:
    points, normals, places, faces = raw
    moved = np.flatnonzero(places != np.arange(len(places)))
    mesh = manifold3d.Mesh64(
        np.ascontiguousarray(np.hstack([points, normals])),
        faces.astype(np.uint64),
        moved.astype(np.uint64),
        places[moved].astype(np.uint64),
    )
    body = manifold3d.Manifold(mesh)
    if body.status() != manifold3d.Error.NoError:
        raise AssertionError(f"A revolved profile is closed by construction; manifold says {body.status()}.")
    return body
