"""What the pointer reads off a drawing: its axes in the drawing's own units, and the values along each curve."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

MOST_POINTS = 240
"""Of a curve, from which the pointer reads; a curve of more is thinned out evenly, both its ends kept."""

DIGITS = 5
"""Significant digits of a value that is read: one more than the page prints."""

_JOINS = {"default": "line", "steps-post": "steps"}


def readouts(figure: Figure, variables: Mapping[str, str]) -> tuple[Mapping[str, Any], ...]:
    """One entry for each pair of axes with curves, once the figure has been laid out.

    box : left, top, right, bottom in units of the drawing. x, y : label, unit, the values at the box's two ends, and
    whether the scale is logarithmic. curves : name, colour, how points are joined ("line", "steps" or "none"), x, y;
    None stands in a gap. Maps with equal axes have none: what lies in them is no function.
    variables : colours of the drawing and the page's names for them, which follow its theme.
    """
    found = []
    for plot in figure.axes:
        curves = [_curve(line, variables) for line in _lines(plot)]
        if not curves:
            continue
        found.append({**frame(plot), "curves": curves})
    return tuple(found)


def frame(plot: Axes) -> dict[str, Any]:
    """Where a pair of axes lies in the drawing, and what its ends stand for."""
    figure = plot.get_figure(root=True)
    assert figure is not None
    height, box = figure.get_size_inches()[1] * figure.dpi, plot.get_window_extent()
    return {
        "box": _rounded((box.x0, height - box.y1, box.x1, height - box.y0)),
        "x": _axis(plot.get_xlabel(), plot.get_xlim(), plot.get_xscale()),
        "y": _axis(plot.get_ylabel(), plot.get_ylim(), plot.get_yscale()),
    }


def _lines(plot: Axes) -> list[Line2D]:
    """The lines that show data: not those across the whole axes, and not single marks, whose legend has their value."""
    if plot.get_aspect() != "auto" or plot.get_label() == "<colorbar>":
        return []
    least = {True: 2, False: 3}
    return [
        line
        for line in plot.lines
        if line.get_transform() == plot.transData and len(_points(line)) >= least[_name(line) != ""]
    ]


def _points(line: Line2D) -> np.ndarray[Any, np.dtype[np.float64]]:
    points = np.asarray(line.get_xydata(), dtype=float)
    if len(points) > MOST_POINTS:
        points = points[np.round(np.linspace(0, len(points) - 1, MOST_POINTS)).astype(int)]
    return points


def _curve(line: Line2D, variables: Mapping[str, str]) -> dict[str, Any]:
    from matplotlib.colors import to_hex

    x, y = _points(line).T
    colour = to_hex(line.get_color())
    drawn = line.get_linestyle() not in ("None", "none", "", " ")
    return {
        "name": _name(line),
        "colour": f"var(--fig-{variables[colour]})" if colour in variables else colour,
        "join": _JOINS.get(line.get_drawstyle(), "line") if drawn else "none",
        "x": _rounded(x),
        "y": _rounded(y),
    }


def _name(line: Line2D) -> str:
    """The curve's name in the legend; empty where it has none."""
    name = str(line.get_label())
    return "" if name.startswith("_") else name


def _axis(label: str, ends: tuple[float, float], scale: str) -> dict[str, Any]:
    """``position z (mm)`` is a label and a unit."""
    parts = re.fullmatch(r"(.*) \(([^()]*)\)", label)
    name, unit = parts.groups() if parts else (label, "")
    return {"label": name, "unit": unit, "ends": _rounded(ends, DIGITS + 2), "log": scale == "log"}


def _rounded(values: Sequence[float] | np.ndarray[Any, Any], digits: int = DIGITS) -> list[float | None]:
    """Few digits, whole numbers as such, so that the page stays small; None for what is no number."""
    shown = (float(f"{value:.{digits}g}") if math.isfinite(value) else None for value in values)
    return [int(value) if value is not None and value.is_integer() else value for value in shown]
