"""Which end of a periodic curve meets which end of its partner."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fluxbore.fem.edges import Drawing
from fluxbore.fem.faces import faces
from fluxbore.fem.outline import Outline, Pair
from fluxbore.fem.outline_check import cleaned, pieces

_LIMIT = 50_000
"""Of triangles, as the mesh's: what telling close curves apart may cost."""


def facing(outline: Outline) -> Outline:
    """The outline with its pairs turned as FEMM turns them, whatever way their curves were drawn.

    Walked with the domain on the left, the first curve begins where the second one ends: the two sides of a sector or
    of a pole pitch are the same up to a rotation or a shift. The rim of a Kelvin exterior becomes its mirror image,
    which is the same to an empty exterior. Raises MeshError, as `triangulate` does.
    """
    if not outline.pairs:
        return outline
    bare = cleaned(replace(outline, pairs=()))
    drawing = Drawing(bare, pieces(bare))
    used = np.isin(np.arange(len(drawing.pieces.points)), drawing.pieces.ends)
    spots = drawing.pieces.points[~used]
    seeds = np.array([seed.position for seed in bare.seeds], dtype=float).reshape(-1, 2)
    edges = drawing.untangled(drawing.edges(), np.vstack((spots, seeds)), _LIMIT)
    found = faces(drawing, edges, spots)
    inside = found.sides >= 0
    # +1 for a side with the domain on its left only, −1 for one with it on its right only.
    way = inside[:, 0].astype(int) - inside[:, 1].astype(int)
    curve = drawing.pieces.curve[edges.piece]
    turned = []
    for pair in outline.pairs:
        first, second = (np.sign(way[curve == number].sum()) for number in (pair.first, pair.second))
        by_radius = _by_radius(outline, pair)
        turned.append(replace(pair, reverse=bool(first == second) if by_radius is None else by_radius))
    return replace(outline, pairs=tuple(turned))


def _by_radius(outline: Outline, pair: Pair) -> bool | None:
    """Whether two arcs about an axis are the same the one way round only, by the distance of their ends from it.

    The rim of a Kelvin exterior may be drawn in several arcs: what meets must be at one latitude.
    """
    curves = [outline.curves[number] for number in (pair.first, pair.second)]
    if outline.chart != "axisymmetric" or any(curve.turn == 0 for curve in curves):
        return None
    ends = []
    for curve in curves:
        radius = np.hypot(*(outline.points[curve.start] - outline.centre(curve)))
        ends.append(outline.points[[curve.start, curve.end], 0] / radius)
    straight, crossed = (bool(np.abs(ends[0] - other).max() < 1e-4) for other in (ends[1], ends[1][::-1]))
    return crossed if straight != crossed else None
