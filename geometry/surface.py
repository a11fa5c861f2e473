"""The surface of a part as triangles: what pictures, printers and viewers take."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Numbers = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A closed surface. points : (n, 3) in m; corners are repeated where faces meet at an edge, so that edges stay
    sharp. normals : (n, 3), outwards, of unit length. triangles : (m, 3) into both, counter-clockwise from outside.
    """

    points: Floats
    normals: Floats
    triangles: Numbers

    @property
    def is_empty(self) -> bool:
        return len(self.triangles) == 0


EMPTY = Surface(np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 3), dtype=np.int64))


def shaded(points: Floats, triangles: Numbers) -> Surface:
    """The surface with normals that are the mean, by area, of the triangles that share a point.

    A triangle with two corners at one place, as at the end of a helix that runs out, is left out.
    """
    ends = points[triangles]
    whole = np.all([np.any(ends[:, i] != ends[:, i - 1], axis=1) for i in range(3)], axis=0)
    triangles = triangles[whole]
    corners = points[triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(normals, triangles[:, corner], across)
    return Surface(points, unit(normals), triangles)


def unit(vectors: Floats) -> Floats:
    """(n, 3) at unit length; what has none stands along z."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(lengths > 0, vectors / np.where(lengths > 0, lengths, 1.0), [0.0, 0.0, 1.0])


def joined(points: Floats, triangles: Numbers) -> tuple[Floats, Numbers]:
    """The same triangles over points that are each there once; triangles that have lost a side are left out.

    Points are one where their numbers are: a file in single precision is joined after it is rounded.
    """
    unique, which = np.unique(points, axis=0, return_inverse=True)
    found = which.reshape(-1)[triangles]
    whole = (found[:, 0] != found[:, 1]) & (found[:, 1] != found[:, 2]) & (found[:, 2] != found[:, 0])
    return unique, found[whole]


def is_closed(triangles: Numbers) -> bool:
    """Whether every side of a triangle is passed as often one way as the other: a watertight surface, all of whose
    triangles are seen from the same side."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    if len(sides) == 0:
        return False
    there, times = np.unique(sides, axis=0, return_counts=True)
    back, again = np.unique(sides[:, ::-1], axis=0, return_counts=True)
    return bool(np.array_equal(there, back) and np.array_equal(times, again))


def enclosed(points: Floats, triangles: Numbers) -> float:
    """Volume within a closed surface, in the cube of its points' unit."""
    corners = points[triangles]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)
