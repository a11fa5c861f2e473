"""Small things that every workshop's part needs: toleranced sizes in a row, outlines without idle corners."""

from __future__ import annotations

import math

from fluxbore.design.iso286 import LARGEST
from fluxbore.geometry.outline import RESOLUTION, Point, Profile
from fluxbore.geometry.part import Fit


def fits(*sizes: tuple[str, float, str]) -> tuple[Fit, ...]:
    """(feature, nominal size in m, class) as `Fit`s; those beyond the range of ISO 286-1's tables are left out."""
    return tuple(Fit(*size) for size in sizes if 0 < size[1] <= LARGEST)


def outline_of(*points: Point) -> Profile:
    """The polygon through these points, of which neighbours at the same place count once: a step that has no height."""
    kept: list[Point] = []
    for point in points:
        if not kept or math.dist(kept[-1], point) >= RESOLUTION:
            kept.append(point)
    while len(kept) > 1 and math.dist(kept[0], kept[-1]) < RESOLUTION:
        kept.pop()
    return tuple(kept)
