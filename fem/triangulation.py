"""Straight triangles in space, with the memory of the outline that they fill: what meshers make and refinement cuts."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.fem.mesh import Floats, Ints


@dataclass(frozen=True, slots=True, eq=False)
class Triangulation:
    """A conforming mesh of an outline.

    points : (n, 2) m, in space: (r, z) or (x, y). triangles : (m, 3) counter-clockwise.
    region : (m,) region number of each triangle, from its seed.
    edges : (k, 2) the triangles' edges that lie on the outline's curves, directed from the curve's start to its end.
    curve : (k,) number of each edge's curve.
    vertex : (p,) node of each of the outline's points, −1 where it touches no region.
    """

    points: Floats
    triangles: Ints
    region: Ints
    edges: Ints
    curve: Ints
    vertex: Ints
