"""What every drawing sheet must keep: texts apart and within the frame, every size of a part told."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import combinations
from typing import Any

import numpy as np
import pytest

from fluxbore.geometry.outline import edges
from fluxbore.geometry.part import Hole, Part
from fluxbore.geometry.sheet import Dimension, Sheet, texts_of
from fluxbore.geometry.sheet_dxf import APPLICATION
from fluxbore.geometry.sheet_frame import inner

MM = 1e-3


def check_texts(sheet: Sheet) -> None:
    """No text over another, none beyond the frame."""
    left, low, right, high = inner(sheet.size)
    texts = texts_of(sheet.items)
    x0, y0, x1, y1 = np.array([text.box for text in texts]).T
    beyond = (x0 < left) | (y0 < low) | (x1 > right) | (y1 > high)
    assert not beyond.any(), (sheet.title, [texts[i].text for i in np.flatnonzero(beyond)])
    for i, text in enumerate(texts):
        along = np.minimum(x1[i], x1[:i]) - np.maximum(x0[i], x0[:i])
        across = np.minimum(y1[i], y1[:i]) - np.maximum(y0[i], y0[:i])
        hit = np.flatnonzero((along > 0.05) & (across > 0.05))
        assert not hit.size, (sheet.title, text.text, [texts[j].text for j in hit])


Sizes = dict[str, tuple[str, float]]
"""Name of a dimension -> kind and length (m)."""


def told(sheet: Sheet) -> Sizes:
    """What the sheet's dimensions measure, as its points lie on the paper."""
    found: Sizes = {}
    for item in sheet.items:
        if isinstance(item, Dimension):
            (x0, y0), (x1, y1) = item.points
            size = {"along": abs(x1 - x0), "across": abs(y1 - y0), "from": abs(x1 - x0)}.get(
                item.kind, math.hypot(x1 - x0, y1 - y0)
            )
            assert item.name not in found, item.name
            found[item.name] = (item.kind, size / sheet.scale * item.factor * MM)
    return found


def read_back(document: Any) -> Sizes:
    """The same from a DXF file."""
    kinds = {0: "along", 3: "round", 6: "from"}
    found: Sizes = {}
    for entity in document.modelspace().query("DIMENSION"):
        kind = kinds[entity.dimtype]
        if kind == "along" and entity.dxf.angle == 90:
            kind = "across"
        size = entity.get_measurement()
        length = abs(size.x) if kind == "from" else float(size)
        found[entity.get_xdata(APPLICATION)[0].value] = (kind, length * entity.override().get("dimlfac", 1.0) * MM)
    return found


def check_told(part: Part, sizes: Sizes) -> None:
    """Every corner of the outline and every drilling can be made from these sizes alone, and no size twice."""
    low = min(z for _, z in part.profile)
    chamfers = [size for name, (_, size) in sizes.items() if name.startswith("chamfer")]
    diameters = [size for name, (_, size) in sizes.items() if name.startswith("diameter")]
    heights = [
        0.0, *(size for name, (kind, size) in sizes.items() if kind in ("along", "from") and "chamfer" not in name)
    ]  # fmt: skip
    for values in (diameters, heights):
        assert all(abs(a - b) > 1e-9 for a, b in combinations(values, 2))
    cut = [pair for a, b in edges(part.profile) for pair in ((a, b), (b, a))]
    for point in part.profile:
        r, z = point[0], point[1] - low
        # A chamfer's corners may follow from the chamfer's size and the other corner.
        mates = [
            (other[0], other[1] - low)
            for mine, other in cut
            if mine == point
            and any(_near(abs(other[0] - r), size) and _near(abs(other[1] - low - z), size) for size in chamfers)
        ]
        assert r == 0 or _in(2 * r, diameters) or any(_in(2 * mate, diameters) for mate, _ in mates), (part.name, point)
        assert _in(z, heights) or any(_in(mate, heights) for _, mate in mates), (part.name, point)
    holes = [size for name, (_, size) in sizes.items() if name.startswith("hole ")]
    circles = [size for name, (_, size) in sizes.items() if name.startswith("pitch circle")]
    for hole in (*part.holes, *part.axial_holes):
        assert _in(hole.diameter, holes), part.name
        if isinstance(hole, Hole):
            assert _in(hole.z - low, heights), part.name
        else:
            assert _in(2 * hole.radius, circles), part.name
            assert _in(hole.start - low, heights)
            assert _in(hole.end - low, heights)


def _near(value: float, other: float) -> bool:
    return value == pytest.approx(other, rel=1e-9, abs=1e-12)


def _in(value: float, values: Iterable[float]) -> bool:
    return any(_near(value, other) for other in values)
