"""Meshes of any outline: checked and divided here, filled with triangles by netgen in a process of its own.

Sides are twice as long as the wished distance of nodes, since a quadratic triangle has a node in the middle of each.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from fluxbore.design.errors import MeshError
from fluxbore.fem.edges import Drawing, Edges
from fluxbore.fem.faces import Faces, faces
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.mesh_worker import TIME_LIMIT, Answer, Job, run
from fluxbore.fem.outline import Outline
from fluxbore.fem.outline_check import LEAST, cleaned, distance, pieces, place
from fluxbore.fem.triangulation import Triangulation

Bools = NDArray[np.bool_]

AUTOMATIC = 0.1
"""Greatest side in a face without a size, as a share of the diagonal of its bounding box."""
SPEED = 10_000
"""Triangles that netgen makes in a second at the least; the time limit grows with them."""
GRADINGS = (0.3, 0.2, 0.25, 0.4)
"""Growth of the sides with the distance from shorter ones, and what to try next if that gives slender triangles."""


LIMIT = 50_000
"""Triangles: as fine as four times as many straight ones, and a nonlinear problem on them takes some 15 s."""


def triangulate(outline: Outline, limit: int = LIMIT) -> Triangulation:
    """A mesh of the outline with at most about `limit` triangles.

    Raises MeshError, one sentence with coordinates in the drawing's unit, for what cannot be meshed.
    """
    outline = cleaned(outline)
    drawing = Drawing(outline, pieces(outline))
    used = np.isin(np.arange(len(drawing.pieces.points)), drawing.pieces.ends)
    spots = drawing.pieces.points[~used]
    seeds = np.array([s.position for s in outline.seeds], dtype=float).reshape(-1, 2)
    edges = drawing.untangled(drawing.edges(), np.vstack((spots, seeds)), limit)
    found = faces(drawing, edges, spots)
    sizes = _sizes(drawing, edges, found, limit)
    edges = drawing.divide(edges, _parts(drawing, edges, found, sizes, limit))
    edges = drawing.resolved(edges, spots, limit)
    # Curves that leave a point close together are told apart by short sides only.
    edges = drawing.untangled(edges, spots, limit)
    found = faces(drawing, edges, spots)
    sizes = _sizes(drawing, edges, found, limit)
    kept = np.asarray((found.sides >= 0).any(axis=1))
    stubs, stub_sides = _stubs(edges, found, sizes, np.flatnonzero(~used))
    job = _job(drawing, edges, found, kept, sizes, stubs, stub_sides)
    return _filled(drawing, edges, kept, found, run(job))


def _sizes(drawing: Drawing, edges: Edges, found: Faces, limit: int) -> Floats:
    """(f,) greatest side in each face (m). Raises MeshError when they ask for too many triangles."""
    seeds = [drawing.outline.seeds[s] for s in found.seed]
    wished = np.array([np.nan if s.size is None else 2 * s.size for s in seeds])
    if (wished <= 0).any():
        at = place(drawing.outline, np.array(seeds[int(np.argmax(wished <= 0))].position))
        raise MeshError(f"the mesh size of the block label at {at} must be positive")
    # The square of a size such as 1e-200 would vanish.
    side = np.where(np.isnan(wished), AUTOMATIC * found.extent, np.maximum(wished, 1e-9 * found.extent))
    count = found.area / (0.43 * side**2)
    automatic = float(count[np.isnan(wished)].sum())
    coarser = max(1.0, np.sqrt(4 * automatic / limit))  # many faces: none of them may cost too much
    asked = np.where(np.isnan(wished), 0.0, count)
    if asked.sum() > limit:
        k = int(asked.argmax())
        raise MeshError(
            f"the mesh size {distance(drawing.outline, wished[k] / 2)} of the block label at"
            f" {place(drawing.outline, np.array(seeds[k].position))} asks for about {asked[k]:.2g} triangles;"
            f" at most {limit} are made"
        )
    # Nor may automatic sizes divide the sides of a drawing of many lines more than the limit allows.
    own = np.append(np.where(np.isnan(wished), side, np.inf), np.inf)[found.sides].min(axis=1)
    while coarser < 10 / AUTOMATIC and np.ceil(edges.lengths / (coarser * own)).sum() > max(limit / 8, len(own)):
        coarser *= 1.25
    return np.where(np.isnan(wished), coarser * side, side)


def _parts(drawing: Drawing, edges: Edges, found: Faces, sizes: Floats, limit: int) -> Ints:
    """(k,) parts into which the sizes of the curves and faces divide each side."""
    own = np.array([np.inf if (s := drawing.outline.curves[c].size) is None else 2 * s for c in drawing.pieces.curve])
    if (own <= 0).any():
        raise MeshError("the mesh size of a line or arc must be positive")
    size = np.minimum(own[edges.piece], np.append(sizes, np.inf)[found.sides].min(axis=1))
    parts = np.maximum(np.ceil(edges.lengths / size - 1e-6), 1)
    if parts.sum() > max(limit / 6, 1.2 * len(parts)):
        k = int(parts.argmax())
        raise MeshError(
            f"the mesh size {distance(drawing.outline, size[k] / 2)} near {place(drawing.outline, edges.middles[k])}"
            f" asks for more than {limit} triangles"
        )
    small = (parts > 1) & (edges.lengths / parts < LEAST * drawing.size)
    if small.any():
        k = int(small.argmax())
        raise MeshError(
            f"the mesh size {distance(drawing.outline, size[k] / 2)} near {place(drawing.outline, edges.middles[k])}"
            f" is below {distance(drawing.outline, LEAST * drawing.size)}, the least in a drawing of its size"
        )
    return np.asarray(parts.astype(int))


def _stubs(edges: Edges, found: Faces, sizes: Floats, lone: Ints) -> tuple[Floats, Ints]:
    """(s, 2, 2) short lines that bind points on no curve into the mesh, and (s, 2) the faces beside them.

    netgen meshes what lies on lines only.
    """
    if not len(lone):
        return np.zeros((0, 2, 2)), np.zeros((0, 2), dtype=int)
    spots = edges.nodes[lone]
    tree = shapely.STRtree(edges.lines)
    _, gap = tree.query_nearest(shapely.points(spots), all_matches=False, return_distance=True)
    if len(spots) > 1:
        gap = np.minimum(gap, cKDTree(spots).query(spots, k=2)[0][:, 1])
    face = found.spots
    length = 0.4 * np.minimum(gap, np.append(sizes, 1.0)[face])
    inside = face >= 0
    lines = np.stack((spots, spots + length[:, None] * [0.0, 1.0]), axis=1)[inside]
    return lines, np.column_stack((face, face))[inside]


def _job(
    drawing: Drawing, edges: Edges, found: Faces, kept: Bools, sizes: Floats, stubs: Floats, stub_sides: Ints
) -> Job:
    """For netgen: domains count from 1, and copies follow what they copy."""
    ends, sides = edges.ends[kept], found.sides[kept] + 1
    seconds = (6 * len(ends) + float((found.area / (0.43 * sizes**2)).sum())) / SPEED
    number = np.append(np.where(kept, np.cumsum(kept) - 1, -1), -1)
    partner = number[drawing.partners(edges)[kept]]
    copy = np.where(partner < np.arange(len(ends)), partner, -1)
    back = (copy >= 0) & (drawing.pieces.mirrored[edges.piece[kept]] == 1)
    ends, sides = (np.where(back[:, None], x[:, ::-1], x) for x in (ends, sides))
    tip = len(edges.nodes) + np.arange(2 * len(stubs)).reshape(-1, 2)
    # All coordinates by their exact values, and none that no line uses.
    used, ends = np.unique(np.vstack((ends, tip)), return_inverse=True)
    return Job(
        np.vstack((edges.nodes, stubs.reshape(-1, 2)))[used],
        ends.reshape(-1, 2),
        np.vstack((sides, stub_sides + 1)),
        np.append(copy, np.full(len(stubs), -1)),
        sizes,
        GRADINGS,
        TIME_LIMIT + seconds,
    )


def _filled(drawing: Drawing, edges: Edges, kept: Bools, found: Faces, answer: Answer) -> Triangulation:
    """netgen's mesh with the outline's exact points, and its memory of the curves."""
    raw, size = answer.points, drawing.size
    if not len(answer.triangles):
        raise MeshError("netgen cannot mesh this drawing: it made no triangles")
    triangles, area = _counter_clockwise(raw, answer.triangles)
    made = np.bincount(answer.domain - 1, area, minlength=len(found.area))
    _check_faces(drawing, found, np.abs(made - found.area) > 1e-6 * found.area + 1e-12 * size**2)

    number = np.unique(edges.ends[kept])
    away, near = cKDTree(edges.nodes[number]).query(raw)
    near = np.where(away < 1e-9 * size, number[near], -1)
    segments, side, share = _on_sides(edges, np.flatnonzero(kept), raw, answer.segments, 1e-7 * size)
    points = np.where((near >= 0)[:, None], edges.nodes[near], raw)
    t0, t1 = edges.t[side].T
    t = t0[:, None] + (t1 - t0)[:, None] * share
    for end in (0, 1):
        fresh = near[segments[:, end]] < 0
        points[segments[fresh, end]] = drawing.at(edges.piece[side[fresh]], t[fresh, end])
    flat = np.zeros(len(found.area), dtype=bool)
    flat[answer.domain[(_area(points, triangles) <= 1e-16 * size**2)] - 1] = True
    _check_faces(drawing, found, flat)

    used, triangles = np.unique(triangles, return_inverse=True)
    number = np.full(len(points), -1)
    number[used] = np.arange(len(used))
    lone = np.flatnonzero(~np.isin(np.arange(len(drawing.outline.points)), edges.ends))
    vertex = np.full(len(edges.nodes), -1)
    vertex[near[used][near[used] >= 0]] = number[used[near[used] >= 0]]
    if len(lone):
        away, of = cKDTree(points[used]).query(edges.nodes[lone])
        vertex[lone] = np.where(away < 1e-9 * size, of, -1)
        points[used[of[away < 1e-9 * size]]] = edges.nodes[lone[away < 1e-9 * size]]
    region = np.array([drawing.outline.seeds[s].region for s in found.seed])
    return Triangulation(
        points[used],
        triangles.reshape(-1, 3),
        region[answer.domain - 1],
        number[segments],
        drawing.pieces.curve[edges.piece[side]],
        vertex[: len(drawing.outline.points)],
    )


def _area(points: Floats, triangles: Ints) -> Floats:
    """(m,) m², positive counter-clockwise."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    return np.asarray((u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2)


def _counter_clockwise(points: Floats, triangles: Ints) -> tuple[Ints, Floats]:
    """The triangles turned where needed, and their areas (m²)."""
    area = _area(points, triangles)
    return np.where((area < 0)[:, None], triangles[:, ::-1], triangles), np.abs(area)


def _check_faces(drawing: Drawing, found: Faces, bad: Bools) -> None:
    if bad.any():
        at = drawing.outline.seeds[found.seed[int(bad.argmax())]].position
        raise MeshError(f"netgen cannot mesh the region of the block label at {place(drawing.outline, np.array(at))}")


def _on_sides(edges: Edges, kept: Ints, raw: Floats, segments: Ints, tolerance: float) -> tuple[Ints, Ints, Floats]:
    """The segments on sides of the outline, directed like them: (q, 2) nodes, (q,) side, (q, 2) shares.

    shares : where on its side each segment starts and ends.
    """
    lines = shapely.linestrings(edges.nodes[edges.ends[kept]])
    middle = shapely.points(raw[segments].mean(axis=1))
    which, found = shapely.STRtree(lines).query_nearest(middle, max_distance=4 * tolerance, all_matches=False)
    segments, side = segments[which], kept[found]
    a, b = (edges.nodes[edges.ends[side, k]] for k in (0, 1))
    along = b - a
    share = ((raw[segments] - a[:, None]) * along[:, None]).sum(axis=2) / (along**2).sum(axis=1)[:, None]
    back = share[:, 0] > share[:, 1]
    segments, share = (np.where(back[:, None], x[:, ::-1], x) for x in (segments, share))
    return segments, side, np.clip(share, 0.0, 1.0)
