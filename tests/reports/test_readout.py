"""What the pointer reads off a drawing: the values that were drawn, where they were drawn."""

from __future__ import annotations

import json
import math
import re

import numpy as np
import pytest

from fluxbore.reports.readout import MOST_POINTS, readouts
from fluxbore.reports.svg import CHOSEN, VARIABLES, drawing, new_figure, style


def test_a_value_lies_where_its_mark_is_drawn() -> None:
    """Catches a box in other units than the drawing's, an axis upside down, and a label that keeps its unit."""
    with style():
        figure = new_figure(400.0, 300.0)
        plot = figure.subplots()
        plot.plot([1.0, 2.0, 4.0], [10.0, 30.0, 20.0], "o", color=CHOSEN, label="designs")
        plot.set_xlabel("position z (mm)")
        made = drawing(figure, "a", "A drawing of three marks.", "Three marks.")
    (found,) = made.readouts
    assert (found["x"]["label"], found["x"]["unit"]) == ("position z", "mm")
    (curve,) = found["curves"]
    assert curve["name"] == "designs"
    assert curve["colour"] == "var(--fig-chosen)"
    assert curve["join"] == "none"
    left, top, right, bottom = found["box"]
    drawn = [tuple(map(float, at)) for at in re.findall(r'<use href="#[^"]+" x="([\d.]+)" y="([\d.]+)"', made.markup)]
    for x, y in zip(curve["x"], curve["y"], strict=True):
        (x0, x1), (y0, y1) = found["x"]["ends"], found["y"]["ends"]
        at = left + (x - x0) / (x1 - x0) * (right - left), bottom - (y - y0) / (y1 - y0) * (bottom - top)
        assert any(math.dist(at, mark) < 0.02 for mark in drawn)


def test_what_is_no_curve_is_not_read() -> None:
    """Catches values read off a map, off a line across the axes, and off a single mark whose legend has its value."""
    with style():
        figure = new_figure(400.0, 300.0)
        plot, field = figure.subplots(1, 2)
        plot.axhline(1.0, label="limit")
        plot.plot([1.0], [2.0], "o", label="start: 2 N")
        plot.plot([0.0, 1.0], [0.0, 1.0])
        field.set_aspect("equal")
        field.plot([0.0, 1.0, 2.0], [0.0, 1.0, 0.0], label="outline")
        figure.draw_without_rendering()
        assert readouts(figure, VARIABLES) == ()


def test_gaps_and_long_traces_are_data() -> None:
    """Catches NaN in the page's data, and a trace of a simulation that weighs a megabyte."""
    time = np.linspace(0.0, 1.0, 50_001)
    with style():
        figure = new_figure(400.0, 300.0)
        plot = figure.subplots()
        plot.plot([1.0, 2.0, 3.0], [1.0, math.nan, 2.0], label="gap")
        plot.step(time, time, where="post", label="trace")
        figure.draw_without_rendering()
        (found,) = readouts(figure, VARIABLES)
    gap, trace = found["curves"]
    assert gap["y"] == [1, None, 2]
    assert trace["join"] == "steps"
    assert (len(trace["x"]), trace["x"][0], trace["x"][-1]) == (MOST_POINTS, 0, 1)
    assert json.dumps(found, allow_nan=False)


@pytest.mark.parametrize("scale", ["log", "linear"])
def test_the_scale_is_told(scale: str) -> None:
    """Catches a logarithmic axis that is read as a linear one."""
    with style():
        figure = new_figure(400.0, 300.0)
        plot = figure.subplots()
        plot.plot([1.0, 10.0, 100.0], [1.0, 2.0, 3.0], label="all")
        plot.set_xscale(scale)
        figure.draw_without_rendering()
        (found,) = readouts(figure, VARIABLES)
    assert found["x"]["log"] is (scale == "log")
    assert found["y"]["log"] is False
