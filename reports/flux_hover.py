"""The field under the pointer: B on a grid over a picture, small enough to travel in the page.

Between the picture's triangles and the reader stand two roundings: the nearest point of the grid, and a step of B.
Parts are told by their outlines, which are exact.
"""

from __future__ import annotations

import base64
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from fluxbore.reports.content import Array, FluxMap, Triangles
from fluxbore.reports.readout import frame

if TYPE_CHECKING:
    from matplotlib.axes import Axes

POINTS = 24_000
"""Of a picture's grid, about."""

STEP = 2e-3
"""T, between two values that the page can tell apart: the elements themselves are good for a few millitesla."""

LARGEST = 32_000 * STEP
"""T, beyond which a value would not fit."""


def field_readout(plot: Axes, field: FluxMap) -> tuple[dict[str, Any], ...]:
    """What the pointer reads off a map that `plot` shows; empty where its field has no components.

    Beside box, x and y of any readout: parts, name and outline [z, r] in mm; start, step and count of the grid in z and
    in r (mm); samples, B_r, B_z and |B| in steps of `unit` (T), each row by row, as differences of 16 bits, deflated.
    """
    if field.components is None:
        return ()
    (start, end), (low, high) = plot.get_xlim(), plot.get_ylim()
    low, high = max(low, 0.0), max(abs(low), abs(high))  # a picture mirrored at the axis has one half twice
    size = float(((end - start) * (high - low) / POINTS) ** 0.5)
    z, r = _middles(start, end, size), _middles(low, high, size)
    inside = _holders(field, z * 1e-3, r * 1e-3)
    found = np.column_stack((field.components, _magnitudes(field)))
    values = np.where(inside[:, None] >= 0, found[inside], 0.0)
    grid = {"z": _grid(z, size), "r": _grid(r, size), "unit": STEP, "samples": packed(values)}
    return ({**frame(plot), "parts": _parts(field, (start, end)), "field": grid},)


def packed(values: Array) -> str:
    """Columns (k, n) of flux densities (T) as text: 16 bits of differences along each column, deflated, base 64."""
    steps = np.rint(np.clip(values, -LARGEST, LARGEST) / STEP).astype(np.int32).T.ravel()
    differences = np.diff(steps, prepend=0).astype("<i2")
    # Low bytes and high bytes apart: the high ones are nearly all alike.
    halves = differences.view(np.uint8).reshape(-1, 2).T.tobytes()
    return base64.b64encode(zlib.compress(halves, 9)).decode("ascii")


def _holders(field: FluxMap, z: Array, r: Array) -> Triangles:
    """The triangle that holds each point of the grid, row by row in r; -1 where there is none."""
    corners = np.stack((field.z[field.triangles], field.r[field.triangles]), axis=-1)
    held = np.full(z.size * r.size, -1)
    size = z[1] - z[0]
    first = [np.ceil((corners[..., i].min(1) - axis[0]) / size).astype(int) for i, axis in enumerate((z, r))]
    last = [np.floor((corners[..., i].max(1) - axis[0]) / size).astype(int) for i, axis in enumerate((z, r))]
    first = [np.maximum(low, 0) for low in first]
    last = [np.minimum(high, axis.size - 1) for high, axis in zip(last, (z, r), strict=True)]
    counts = [np.maximum(high - low + 1, 0) for low, high in zip(first, last, strict=True)]
    # Every point of the box around each triangle, one after another; those inside the triangle are its own.
    boxes = counts[0] * counts[1]
    number = np.repeat(np.arange(len(corners)), boxes)
    within = np.arange(number.size) - np.repeat(np.cumsum(boxes) - boxes, boxes)
    column = first[0][number] + within % np.maximum(counts[0][number], 1)
    row = first[1][number] + within // np.maximum(counts[0][number], 1)
    point = np.column_stack((z[column], r[row]))
    inside = _contains(corners[number], point)
    held[row[inside] * z.size + column[inside]] = number[inside]
    return held


def _contains(corners: Array, points: Array) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Whether each triangle (n, 3, 2) holds its point (n, 2), its sides included."""
    sides = np.roll(corners, -1, axis=1) - corners
    away = points[:, None, :] - corners
    turns = sides[..., 0] * away[..., 1] - sides[..., 1] * away[..., 0]
    slack = 1e-9 * np.abs(sides).max(axis=(1, 2)) ** 2
    return np.asarray(np.all(turns >= -slack[:, None], axis=1) | np.all(turns <= slack[:, None], axis=1))


def _magnitudes(field: FluxMap) -> Array:
    """|B| in the triangles (m,)."""
    at_nodes = len(field.flux_density) == len(field.r)
    return np.asarray(field.flux_density[field.triangles].mean(axis=1) if at_nodes else field.flux_density)


def _middles(low: float, high: float, size: float) -> Array:
    """Middles of pieces of this size between two ends; two at least."""
    return np.asarray(low + (np.arange(max(round((high - low) / size), 2)) + 0.5) * size, dtype=np.float64)


def _grid(places: Array, size: float) -> dict[str, float]:
    return {"start": round(float(places[0]), 5), "step": round(size, 7), "count": int(places.size)}


def _parts(field: FluxMap, window: tuple[float, float]) -> list[list[Any]]:
    """Names and outlines (mm) of the parts that the picture shows."""
    found = []
    for name, outline in field.outlines:
        points = np.round(outline[:, ::-1] * 1e3, 3)
        if points[:, 0].max() > window[0] and points[:, 0].min() < window[1]:
            found.append([name, points.tolist()])
    return found
