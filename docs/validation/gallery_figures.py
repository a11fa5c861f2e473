"""The gallery's pictures of what is modelled."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from cases.case import Case
from matplotlib import pyplot, rcParams
from matplotlib.axes import Axes

from fluxbore.fem.femm_problem import drawing
from fluxbore.fem.mesh import Floats

pyplot.switch_backend("Agg")
rcParams["svg.hashsalt"] = "fluxbore"  # the same picture is the same file

CONDITION, PERIODIC, LINE = "#b3261e", "#1f5fa8", "#222222"


def draw_model(case: Case, file: Path) -> None:
    """Lines with their conditions, labels' materials, and the points that are asked."""
    figure, axes = pyplot.subplots(figsize=(6, 6), layout="constrained")
    paired = {k for pair in drawing(case.model).outline.pairs for k in (pair.first, pair.second)}
    for number, (points, conditioned) in enumerate(_curves(case)):
        colour = PERIODIC if number in paired else CONDITION if conditioned else LINE
        axes.plot(*points.T, color=colour, linewidth=1)
    for label in case.model.labels:
        assert label.material is not None
        axes.annotate(case.model.materials[label.material].name, (label.x, label.y), fontsize=7, ha="center")
    if case.points:
        axes.plot(*np.array(case.points).T, "x", color="#2e7d32", markersize=5)
    _finish(case, axes)
    figure.savefig(file, metadata={"Date": None})
    pyplot.close(figure)


def _curves(case: Case) -> Iterator[tuple[Floats, bool]]:
    """Points along each curve in the file's unit, and whether it carries a condition."""
    outline = drawing(case.model).outline
    for curve in outline.curves:
        points = outline.along(curve, np.linspace(0, 1, 2 if curve.turn == 0 else 60))
        yield points / case.model.metres, curve.condition is not None


def _finish(case: Case, axes: Axes) -> None:
    points = np.vstack([points for points, _ in _curves(case)])
    margin = 0.02 * np.ptp(points, axis=0).max()
    axes.set_xlim(points[:, 0].min() - margin, points[:, 0].max() + margin)
    axes.set_ylim(points[:, 1].min() - margin, points[:, 1].max() + margin)
    axes.set_aspect("equal")
    first, second = ("r", "z") if case.model.axisymmetric else ("x", "y")
    unit = {"millimeters": "mm", "inches": "in", "meters": "m"}.get(case.model.unit, case.model.unit)
    axes.set_xlabel(f"{first} ({unit})")
    axes.set_ylabel(f"{second} ({unit})")
