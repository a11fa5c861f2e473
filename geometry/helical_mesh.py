"""Helical parts as triangles, straight from their outlines: for pictures, without the CAD kernel."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from fluxbore.geometry import unrolled
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.unrolled import TURN, Outline

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Numbers = NDArray[np.int64]


def triangles(part: HelicalPart, tolerance: float, step: float, opening: float = 0.0) -> tuple[Floats, Numbers]:
    """Vertices (n, 3) in m and triangles (m, 3), counter-clockwise from outside; corners are repeated between faces.

    tolerance : m from the surface at most. step : rad between neighbouring stations at most. opening : the sector from
    angle 0 (+x) to this one (rad) is left out, for a look inside.
    """
    widest = min(step, 2 * math.acos(max(1 - tolerance / part.outer_radius, 0.0)))
    points, faces, count = [], [], 0
    for outline in _kept(part.outline, opening):
        for vertices, found in _piece(part, outline, widest):
            points.append(vertices)
            faces.append(found + count)
            count += len(vertices)
    if not points:
        return np.empty((0, 3)), np.empty((0, 3), dtype=np.int64)
    return np.concatenate(points), np.concatenate(faces)


def _kept(outline: Outline, opening: float) -> list[Outline]:
    """What of an outline lies outside the opening, turn by turn."""
    if opening == 0.0:
        return [outline]
    low, high = unrolled.reach(outline)
    cut = (
        unrolled.between(outline, turn * TURN + opening, (turn + 1) * TURN)
        for turn in range(math.floor(low / TURN), math.ceil(high / TURN))
    )
    return [kept for kept in cut if len(kept) > 2 and unrolled.area(kept) > 0]


def _piece(part: HelicalPart, outline: Outline, step: float) -> list[tuple[Floats, Numbers]]:
    lower, upper = unrolled.chains(outline)
    corners = sorted({theta for theta, _ in (*lower, *upper)})
    stations = [np.linspace(a, b, max(1, math.ceil((b - a) / step)), endpoint=False) for a, b in pairwise(corners)]
    theta = np.concatenate([*stations, [corners[-1]]])
    low, high = (np.interp(theta, *np.transpose(chain)) for chain in (lower, upper))
    around = np.column_stack([np.cos(theta), np.sin(theta)])

    def line(radius: float, z: Floats) -> Floats:
        return np.column_stack([radius * around, z])

    inner, outer = part.inner_radius, part.outer_radius
    edges = [line(outer, low), line(outer, high), line(inner, high), line(inner, low)]
    # Both long sides are split along the same diagonal, so that what one bulges the other lacks.
    found = [_strip(edges[i], edges[(i + 1) % 4], falling=i == 3) for i in range(4)]
    for end, order in ((0, (3, 0, 1, 2)), (-1, (0, 3, 2, 1))):
        if high[end] > low[end]:
            found.append((np.array([edges[i][end] for i in order]), np.array([[0, 1, 2], [0, 2, 3]])))
    return found


def _strip(first: Floats, second: Floats, *, falling: bool) -> tuple[Floats, Numbers]:
    """Quadrilaterals between two edges, the outside to the left of the way from the first to the second seen along
    them; falling : split from the first edge's far corner to the second's near one, instead of the other way."""
    n = len(first)
    a = np.arange(n - 1)
    b, c, d = a + 1, a + 1 + n, a + n
    halves = ((a, b, d), (b, c, d)) if falling else ((a, b, c), (a, c, d))
    return np.concatenate([first, second]), np.concatenate([np.column_stack(half) for half in halves])
