"""The pictures of a search: its progress, and its path in the plane of two variables."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize.outcome import Candidate, SearchResult
from fluxbore.reports.axes import HEIGHT, WIDTH, axis_title, crosses, legend_above, shown
from fluxbore.reports.svg import (
    BAD,
    CHOSEN,
    GOOD,
    INK,
    MUTED,
    OTHER,
    PUBLISHED,
    START,
    Drawing,
    drawing,
    new_figure,
    style,
)
from fluxbore.reports.wording import Scale, capital, figure_label, figure_scale, key_label, key_scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CLOUD = 0.8
"""Share of a search's designs that its pictures are fitted to, the nearest to the best first."""

Window = tuple[float, float]
"""The two ends of an axis in its own unit."""


def convergence_curve(spec: Spec, search: SearchResult, objective: Objective) -> Drawing | None:
    """The objective of every design in the order it was tried, and the best feasible one so far."""
    values = [item.objective for item in search.history]
    if not any(value is not None for value in values):
        return None
    scale = figure_scale(objective.figure, values)
    with style():
        canvas = new_figure(WIDTH, HEIGHT)
        plot = canvas.subplots()
        runs = list(enumerate(search.history, start=1))
        window, beyond = _feasible_window(search, scale), 0
        best = [math.nan if i is None else shown(values[i], scale) for i in search.best_so_far]
        plot.step(range(1, len(best) + 1), best, where="post", color=CHOSEN, label="best feasible so far")
        for marker, colour, label, chosen in (
            ("o", CHOSEN, "feasible", [(i, c.objective) for i, c in runs if c.feasible]),
            (
                "D",
                PUBLISHED,
                "breaks a limit",
                [(i, c.objective) for i, c in runs if c.evaluation.ok and not c.feasible],
            ),
        ):
            points = [(float(i), scale.shown(value)) for i, value in chosen if value is not None]
            beyond += _points(plot, points, (None, window), marker, colour, label)
        failed = [i for i, c in runs if not c.evaluation.ok]
        if failed:
            crosses(plot, failed, "no result")
        if search.start.objective is not None:
            plot.axhline(scale.shown(search.start.objective), color=START, lw=1.2, ls=(0, (2, 2)), label="start design")
        if beyond:
            plot.plot([], [], "^", color=MUTED, mfc="none", ms=6, mew=1.3, label=f"beyond the axis ({beyond})")
        if window is not None:
            plot.set_ylim(*window)
        legend_above(plot, 3)
        plot.set_xlabel("evaluation")
        plot.set_ylabel(axis_title(figure_label(objective.figure), scale.unit))
        plot.locator_params(axis="x", integer=True)
        found = scale.quantity(search.best.objective) if search.best is not None else "no feasible design"
        alt = f"{capital(figure_label(objective.figure))} over {len(values)} evaluations; best: {found}."
        caption = "Every design of the search in the order it was tried."
        if beyond:
            caption += " The axis is fitted to the feasible designs; triangles at its edge lie beyond."
        return drawing(canvas, "convergence", alt, caption)


def search_path(spec: Spec, search: SearchResult, one_at_a_time: Candidate | None) -> Drawing | None:
    """The designs of a search over two variables, in the plane of both; None for any other number."""
    variables = spec.study.variables
    if len(variables) != 2 or not search.history:
        return None
    keys = [variable.key for variable in variables]
    scales = [key_scale(spec, key, [c.values[key] for c in search.history]) for key in keys]

    def at(item: Candidate) -> tuple[float, float]:
        return scales[0].shown(item.values[keys[0]]), scales[1].shown(item.values[keys[1]])

    window = _cloud([at(item) for item in search.history], at(search.chosen or search.start), at(search.start))
    with style():
        canvas = new_figure(WIDTH, HEIGHT)
        plot = canvas.subplots()
        beyond = 0
        for marker, colour, label, items in (
            ("o", CHOSEN, "feasible", [c for c in search.history if c.feasible]),
            ("D", PUBLISHED, "breaks a limit", [c for c in search.history if c.evaluation.ok and not c.feasible]),
            ("x", BAD, "no result", [c for c in search.history if not c.evaluation.ok]),
        ):
            beyond += _points(plot, [at(item) for item in items], window, marker, colour, label)
        for item, label, marker, colour in (
            (search.start, "start", "s", START),
            (search.network_start, "network's start", "^", OTHER),
            (one_at_a_time, "one at a time", "v", GOOD),
            (search.chosen, "chosen", "*", INK),
        ):
            if item is None or not all(key in item.values for key in keys):
                continue
            place, size = at(item), 13 if marker == "*" else 9
            if _within(place, window):
                plot.plot(*place, marker, ms=size, color=colour, label=label, ls="none")
            else:
                shown = " / ".join(axis.quantity(item.values[key]) for axis, key in zip(scales, keys, strict=True))
                look: dict[str, Any] = {"mfc": "none", "mew": 1.5, "ls": "none", "clip_on": False}
                plot.plot(
                    *_clipped(place, window), marker, ms=size, color=colour, label=f"{label} (beyond: {shown})", **look
                )
                beyond += 1
        plot.set_xlim(*window[0])
        plot.set_ylim(*window[1])
        legend_above(plot, 2)
        plot.set_xlabel(axis_title(key_label(spec, keys[0]), scales[0].unit))
        plot.set_ylabel(axis_title(key_label(spec, keys[1]), scales[1].unit))
        alt = f"Designs of the search in the plane of {key_label(spec, keys[0])} and {key_label(spec, keys[1])}."
        caption = "Where the search went in the plane of its two variables."
        if beyond:
            caption += " The picture is fitted to the designs around the best; open marks at its edge lie beyond."
        return drawing(canvas, "search-path", alt, caption)


def _feasible_window(search: SearchResult, scale: Scale) -> Window | None:
    """The ordinate around most of the feasible designs and the start, with a margin; None where nothing is feasible."""
    feasible = [scale.shown(c.objective) for c in search.history if c.feasible and c.objective is not None]
    if not feasible:
        return None
    best = search.best.objective if search.best is not None else None
    known = _nearest(feasible, scale.shown(best) if best is not None else feasible[-1])
    known += [scale.shown(search.start.objective)] if search.start.objective is not None else []
    low, high = min(known), max(known)
    spare = max(0.3 * (high - low), 1e-3 * abs(high))
    return low - spare, high + spare


def _cloud(
    points: Sequence[tuple[float, float]], centre: tuple[float, float], start: tuple[float, float]
) -> tuple[Window, Window]:
    """The two axes' windows around the designs nearest to the centre, each with a margin; the start if it is near."""
    windows = []
    for axis in (0, 1):
        near = _nearest([point[axis] for point in points], centre[axis])
        reach = max(abs(value - centre[axis]) for value in near) or 0.02 * abs(centre[axis]) or 1.0
        if abs(start[axis] - centre[axis]) <= 3 * reach:
            near.append(start[axis])
        low, high = min(*near, centre[axis]), max(*near, centre[axis])
        spare = 0.15 * (high - low) or reach
        windows.append((low - spare, high + spare))
    return windows[0], windows[1]


def _nearest(values: Sequence[float], centre: float) -> list[float]:
    """Most of the values, the nearest to the centre."""
    return sorted(values, key=lambda value: abs(value - centre))[: max(math.ceil(CLOUD * len(values)), 1)]


def _points(
    plot: Axes,
    points: Sequence[tuple[float, float]],
    window: tuple[Window | None, Window | None],
    marker: str,
    colour: str,
    label: str,
) -> int:
    """Designs as marks, those outside the window as open triangles at its edge that point to them; how many do."""
    inside = [point for point in points if _within(point, window)]
    if points:
        x, y = zip(*inside, strict=True) if inside else ((), ())
        face = colour if marker == "o" else "none"
        plot.plot(x, y, marker, color=colour, mfc=face, ms=4.5, mew=1.3, alpha=0.8, label=label)
    for point in points:
        if not _within(point, window):
            edge = _clipped(point, window)
            steps = [one - other for one, other in zip(point, edge, strict=True)]
            arrow = ("^" if steps[1] > 0 else "v") if steps[1] else (">" if steps[0] > 0 else "<")
            plot.plot(*edge, arrow, color=colour, mfc="none", ms=6, mew=1.3, clip_on=False)
    return len(points) - len(inside)


def _within(point: tuple[float, float], window: tuple[Window | None, Window | None]) -> bool:
    return _clipped(point, window) == point


def _clipped(point: tuple[float, float], window: tuple[Window | None, Window | None]) -> tuple[float, float]:
    """The point, or the nearest on the window's edge; None leaves an axis open."""
    x, y = (
        value if span is None else min(max(value, span[0]), span[1]) for value, span in zip(point, window, strict=True)
    )
    return x, y
