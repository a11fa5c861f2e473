"""The faces that a drawing's sides enclose, and the seed that fills each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from fluxbore.design.errors import MeshError
from fluxbore.fem.edges import Drawing, Edges
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.outline import HOLE, Outline
from fluxbore.fem.outline_check import LEAST, diagonal, place


@dataclass(frozen=True, slots=True, eq=False)
class Faces:
    """area, extent : (f,) m² and m, the diagonal of the bounding box. seed : (f,) number of the seed that fills it.

    sides : (k, 2) the faces on the left and right of each side, −1 outside. Holes are outside too.
    spots : (s,) the face around each lone point, −1 outside.
    """

    area: Floats
    extent: Floats
    seed: Ints
    sides: Ints
    spots: Ints


def faces(drawing: Drawing, edges: Edges, spots: Floats) -> Faces:
    """Of sides that meet in their ends only. spots : (n, 2) points on no curve."""
    outline = drawing.outline
    polygons = _polygons(outline, edges)
    seed = _seeds(outline, polygons, edges)
    sides = _sides(edges, polygons)
    around = np.full(len(spots), -1)
    which, face = shapely.STRtree(polygons).query(shapely.points(spots), predicate="within")
    around[which] = face
    kept = np.array([outline.seeds[s].region != HOLE for s in seed])
    number = np.append(np.where(kept, np.cumsum(kept) - 1, -1), -1)
    bounds = shapely.bounds(polygons)[kept]
    if not kept.any():
        raise MeshError("every face of the drawing is a hole: there is nothing to be meshed")
    return Faces(
        np.asarray(shapely.area(polygons)[kept]),
        np.asarray(np.hypot(bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1])),
        seed[kept],
        number[sides],
        number[around],
    )


def _polygons(outline: Outline, edges: Edges) -> Floats:
    """(f,) array of shapely polygons, exterior counter-clockwise, holes clockwise."""
    found = shapely.polygonize(edges.lines)
    polygons = np.array(shapely.get_parts(found), dtype=object)
    if not len(polygons):
        at = place(outline, edges.nodes[edges.ends[0, 0]])
        raise MeshError(f"the lines and arcs enclose no area: the outline is open, for one at {at}")
    return np.asarray(shapely.orient_polygons(polygons, exterior_cw=False))


def _seeds(outline: Outline, polygons: Floats, edges: Edges) -> Ints:
    """(f,) number of each face's seed; every face has exactly one, and every seed has a face."""
    positions = np.array([s.position for s in outline.seeds], dtype=float).reshape(-1, 2)
    filler = [k for k, s in enumerate(outline.seeds) if s.default]
    if len(filler) > 1:
        where = " and ".join(place(outline, positions[k]) for k in filler[:2])
        raise MeshError(f"two block labels, {where}, are the default of faces without one; only one can be")
    points = shapely.points(positions)
    on_line, _ = shapely.STRtree(edges.lines).query(points, predicate="dwithin", distance=LEAST * diagonal(outline))
    if len(on_line):
        raise MeshError(
            f"the block label at {place(outline, positions[on_line[0]])} lies on a line or arc, not inside a face"
        )
    label, face = shapely.STRtree(polygons).query(points, predicate="within")
    stray = np.setdiff1d(np.arange(len(positions)), [*label, *filler])
    if len(stray):
        raise MeshError(f"the block label at {place(outline, positions[stray[0]])} lies outside every closed face")
    seed = np.full(len(polygons), -1)
    for k, f in zip(label.tolist(), face.tolist(), strict=True):
        if seed[f] >= 0:
            a, b = outline.seeds[seed[f]], outline.seeds[k]
            same = ", of the same kind," if a.region == b.region else ""
            raise MeshError(
                f"the block labels at {place(outline, positions[seed[f]])} and {place(outline, positions[k])}{same}"
                " lie in one face, which can have one only"
            )
        seed[f] = k
    bare = np.flatnonzero(seed < 0)
    if len(bare) and not filler:
        inside = np.asarray(shapely.get_coordinates(shapely.point_on_surface(polygons[bare[0]])))[0]
        raise MeshError(f"the region around {place(outline, inside)} has no block label")
    return np.where(seed < 0, filler[0] if filler else -1, seed)


def _sides(edges: Edges, polygons: Floats) -> Ints:
    """(k, 2) the polygons on the left and right of each side, −1 for none."""
    rings, owner = _ring_sides(polygons)
    node = {xy: n for n, xy in enumerate(map(tuple, edges.nodes.tolist()))}
    of = {
        (node[a], node[b]): f
        for a, b, f in zip(
            map(tuple, rings[:, 0].tolist()), map(tuple, rings[:, 1].tolist()), owner.tolist(), strict=True
        )
    }
    sides = np.array([(of.get((a, b), -1), of.get((b, a), -1)) for a, b in edges.ends.tolist()])
    loose = np.flatnonzero((sides < 0).all(axis=1))
    if len(loose):
        k, f = shapely.STRtree(polygons).query(shapely.points(edges.middles[loose]), predicate="within")
        sides[loose[k]] = f[:, None]
    return sides


def _ring_sides(polygons: Floats) -> tuple[Floats, Ints]:
    """(q, 2, 2) the ends of the sides of all rings, directed with the polygon on their left, and (q,) whose."""
    rings, owner = shapely.get_rings(polygons, return_index=True)
    xy, ring = shapely.get_coordinates(rings, return_index=True)
    inside = ring[1:] == ring[:-1]
    return np.stack((xy[:-1], xy[1:]), axis=1)[inside], owner[ring[:-1][inside]]
