"""The straight sides of triangles along an outline's pieces, and their division until they do not disturb each other.

Every rule works on the same arrays: where two sides come too close for their length, the longer one is divided.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely

from fluxbore.design.errors import MeshError
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.outline import Outline
from fluxbore.fem.outline_check import LEAST, Pieces, diagonal, distance, place

ARC_STEP = np.radians(15)
"""Greatest angle of an arc's side (rad)."""
NEAR = 2.0
"""Greatest ratio of a side's length to its distance from the nearest feature it does not touch."""


@dataclass(frozen=True, slots=True, eq=False)
class Edges:
    """Sides ordered along the pieces.

    nodes : (n, 2) m. ends : (k, 2). piece : (k,). t : (k, 2) fractions of the curve.
    """

    nodes: Floats
    ends: Ints
    piece: Ints
    t: Floats

    @property
    def lengths(self) -> Floats:
        return np.asarray(np.hypot(*(self.nodes[self.ends[:, 1]] - self.nodes[self.ends[:, 0]]).T))

    @property
    def middles(self) -> Floats:
        return np.asarray(self.nodes[self.ends].mean(axis=1))

    @property
    def lines(self) -> list[shapely.LineString]:
        return list(shapely.linestrings(self.nodes[self.ends]))


class Drawing:
    """An outline with its pieces, and what dividing them needs: the curves as arrays."""

    def __init__(self, outline: Outline, pieces: Pieces) -> None:
        self.outline, self.pieces, self.size = outline, pieces, diagonal(outline)
        curves = [outline.curves[c] for c in pieces.curve]
        self.turn = np.array([c.turn for c in curves])
        self.centre = np.array([outline.centre(c) if c.turn else (0.0, 0.0) for c in curves])
        self.arm = np.array([outline.points[c.start] for c in curves]) - self.centre

    def edges(self) -> Edges:
        """One side for each line, sides of at most ARC_STEP for arcs."""
        p = self.pieces
        whole = Edges(p.points, p.ends, np.arange(len(p.ends)), p.t)
        return self.divide(whole, np.ceil(self.turn * np.diff(p.t)[:, 0] / ARC_STEP - 1e-9).astype(int))

    def at(self, piece: Ints, t: Floats) -> Floats:
        """(k, 2) points at the curves' fractions t (m). Lines run between their piece's ends."""
        a, b = (self.pieces.points[self.pieces.ends[piece, i]] for i in (0, 1))
        t0, t1 = self.pieces.t[piece].T
        straight = a + (b - a) * ((t - t0) / (t1 - t0))[:, None]
        angle, arm = (self.turn[piece] * t), self.arm[piece]
        c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
        bent = self.centre[piece] + c * arm + s * np.column_stack((-arm[:, 1], arm[:, 0]))
        return np.asarray(np.where(self.turn[piece, None] > 0, bent, straight))

    def divide(self, edges: Edges, parts: Ints) -> Edges:
        """Each side in so many equal parts; periodic partners alike."""
        parts = np.maximum(parts, 1)
        partner = self.partners(edges)
        parts = np.where(partner >= 0, np.maximum(parts, parts[partner]), parts)
        if (parts == 1).all():
            return edges
        owner = np.repeat(np.arange(len(parts)), parts)
        step = np.arange(len(owner)) - np.repeat(np.cumsum(parts) - parts, parts)
        share, n = step / parts[owner], parts[owner]
        t0, t1 = edges.t[owner].T
        start = t0 + (t1 - t0) * share
        inner = step > 0
        nodes = np.vstack((edges.nodes, self.at(edges.piece[owner[inner]], start[inner])))
        first = edges.ends[owner, 0].copy()
        first[inner] = np.arange(len(edges.nodes), len(nodes))
        last = np.append(first[1:], 0)
        stop = np.append(start[1:], 0.0)
        final = step == n - 1
        last[final], stop[final] = edges.ends[:, 1], edges.t[:, 1]
        return Edges(nodes, np.column_stack((first, last)), edges.piece[owner], np.column_stack((start, stop)))

    def partners(self, edges: Edges) -> Ints:
        """(k,) number of the periodic partner of each side, −1 for none."""
        count = np.bincount(edges.piece, minlength=len(self.pieces.ends))
        begin = np.cumsum(count) - count
        along = np.arange(len(edges.piece)) - begin[edges.piece]
        other = self.pieces.partner[edges.piece]
        back = count[other] - 1 - along
        return np.where(other >= 0, begin[other] + np.where(self.pieces.mirrored[edges.piece] == 1, back, along), -1)

    def sagitta(self, edges: Edges) -> Floats:
        """Height of each side's arc over it (m)."""
        return np.asarray(edges.lengths * np.tan(self.turn[edges.piece] * np.diff(edges.t)[:, 0] / 4) / 2)

    def untangled(self, edges: Edges, spots: Floats, limit: int) -> Edges:
        """With arcs so fine that sides meet, and lie on the same side of the spots, as the arcs do."""

        def clashes(e: Edges, new: Ints) -> Ints:
            lines, reach = e.lines, 1.1 * self.sagitta(e)
            tree = shapely.STRtree(lines)
            i, j = tree.query([lines[k] for k in new], predicate="dwithin", distance=reach[new])
            i = new[i]
            i, j = i[i != j], j[i != j]
            shared = (e.ends[i][:, :, None] == e.ends[j][:, None, :]).sum(axis=(1, 2))
            bad = (shared == 0) | (shared == 2) | ((shared == 1) & _overlap(e, i, j))
            i, j = i[bad], j[bad]
            straight = (self.turn[e.piece[i]] == 0) & (self.turn[e.piece[j]] == 0)
            if straight.any():
                k = int(np.flatnonzero(straight)[0])
                self._refuse_crossing(e, int(i[k]), int(j[k]))
            finest = np.minimum(e.lengths[i], e.lengths[j]) < 8 * LEAST * self.size
            if finest.any():
                k = int(np.flatnonzero(finest)[0])
                self._refuse_crossing(e, int(i[k]), int(j[k]))
            split = np.concatenate((i, j))
            if len(spots):
                a, b = tree.query(shapely.points(spots), predicate="dwithin", distance=float(reach.max()))
                gap = shapely.distance(shapely.points(spots[a]), np.array(lines, dtype=object)[b])
                split = np.concatenate((split, b[(gap < reach[b]) & (e.lengths[b] > 8 * LEAST * self.size)]))
            return np.asarray(split[self.turn[e.piece[split]] > 0])

        return self._until_settled(edges, clashes, limit)

    def resolved(self, edges: Edges, spots: Floats, limit: int) -> Edges:
        """With sides no longer than NEAR times their distance from features that they do not touch."""

        def crowded(e: Edges, new: Ints) -> Ints:
            lines, length = e.lines, e.lengths
            i, j = shapely.STRtree(lines).query(
                [lines[k] for k in new], predicate="dwithin", distance=length[new] / NEAR
            )
            i = new[i]
            apart = (e.piece[i] != e.piece[j]) & ~(e.ends[i][:, :, None] == e.ends[j][:, None, :]).any(axis=(1, 2))
            i, j = i[apart], j[apart]
            # Near a corner of two pieces sides may grow with their distance from it, or an acute corner were cut for
            # ever.
            room = np.zeros(len(i))
            ends = self.pieces.ends
            for own in (0, 1):
                corner = ends[e.piece[i], own]
                meet = (corner[:, None] == ends[e.piece[j]]).any(axis=1)
                off = np.hypot(*(e.nodes[e.ends[i]] - e.nodes[corner][:, None]).T).min(axis=0)
                room = np.where(meet, np.maximum(room, np.where(off < 1e-9 * self.size, np.inf, 1.01 * off)), room)
            split = i[length[i] > room]
            if len(spots):
                a, b = shapely.STRtree(shapely.points(spots)).query(
                    [lines[k] for k in new], predicate="dwithin", distance=length[new] / NEAR
                )
                away = ~(e.nodes[e.ends[new[a]]] == spots[b][:, None]).all(axis=2).any(axis=1)
                split = np.concatenate((split, new[a[away]]))
            small = length[split] < 2 * LEAST * self.size
            if small.any():
                at = e.middles[split[small][0]]
                raise MeshError(
                    f"the drawing has a gap near {place(self.outline, at)} that is too narrow to be meshed;"
                    f" the least in a drawing of its size is {distance(self.outline, LEAST * self.size)}"
                )
            return np.asarray(split)

        return self._until_settled(edges, crowded, limit)

    def _until_settled(self, edges: Edges, rule: Callable[[Edges, Ints], Ints], limit: int) -> Edges:
        new, count = np.arange(len(edges.ends)), len(edges.ends)
        while len(new):
            split = rule(edges, new)
            if not len(split):
                break
            parts = np.ones(len(edges.ends), dtype=int)
            parts[split] = 2
            if parts.sum() > max(limit / 6, 1.2 * count):
                at = place(self.outline, edges.middles[split[edges.lengths[split].argmin()]])
                raise MeshError(f"the narrow gaps of the drawing, such as near {at}, need more than {limit} triangles")
            before = {*map(tuple, edges.ends.tolist())}
            edges = self.divide(edges, parts)
            new = np.array([k for k, e in enumerate(map(tuple, edges.ends.tolist())) if e not in before], dtype=int)
        return edges

    def _refuse_crossing(self, e: Edges, i: int, j: int) -> None:
        a, b = (shapely.LineString(e.nodes[e.ends[k]]) for k in (i, j))
        at = np.asarray(shapely.shortest_line(a, b).coords).mean(axis=0)
        what = {0: "lines", 1: "a line and an arc", 2: "arcs"}[int((self.turn[e.piece[[i, j]]] > 0).sum())]
        raise MeshError(f"{what} cross or touch at {place(self.outline, at)}, where the drawing has no point")


def _overlap(e: Edges, i: Ints, j: Ints) -> Ints:
    """Whether sides with one common end leave it in the same direction."""
    p, q = e.ends[i], e.ends[j]
    flip_p = (p[:, 0, None] != q).all(axis=1)
    p = np.where(flip_p[:, None], p[:, ::-1], p)
    q = np.where((q[:, 0] != p[:, 0])[:, None], q[:, ::-1], q)
    u, v = (e.nodes[x[:, 1]] - e.nodes[x[:, 0]] for x in (p, q))
    scale = np.hypot(*u.T) * np.hypot(*v.T)
    return np.asarray(((u * v).sum(axis=1) > 0) & (np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) < 1e-9 * scale))
