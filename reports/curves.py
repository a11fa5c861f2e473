"""The curves of a report: sweeps, the search's progress and path, force over position, slotted against slotless."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from fluxbore.design.spec import Spec
from fluxbore.design.study import Objective
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import Candidate, SearchResult, SweepResult
from fluxbore.reports.content import SlotComparison
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

WIDTH, HEIGHT = 500.0, 320.0
"""Of an ordinary figure, which stands two abreast on a desk and alone on a telephone."""

CLOUD = 0.8
"""Share of a search's designs that its pictures are fitted to, the nearest to the best first."""

Window = tuple[float, float]
"""The two ends of an axis in its own unit."""

_PHASES = (("U", BAD), ("V", GOOD), ("W", CHOSEN))


def sweep_curve(
    spec: Spec, result: SweepResult, name: str, figure: str, maximise: bool, route: str = "finite elements"
) -> Drawing | None:
    """A figure over the swept key, with the computed best and the published optimum; None beyond two axes.

    Of two axes the last runs along the abscissa and the first gives the family of curves.
    """
    axes = result.sweep.axes
    best = result.best(figure, maximise)
    if best is None or not 1 <= len(axes) <= 2:
        return None
    along = axes[-1]
    x_scale = key_scale(spec, along.key, along.values)
    y_scale = figure_scale(figure, [getattr(row.evaluation.performance, figure) for row in result.rows])
    with style():
        canvas = new_figure(WIDTH, HEIGHT)
        plot = canvas.subplots()
        for values, label, shade in _families(spec, result):
            points = [
                (x_scale.shown(row.values[along.key]), _shown(getattr(row.evaluation.performance, figure), y_scale))
                for row in result.rows
                if all(row.values[key] == value for key, value in values.items())
            ]
            plot.plot(*zip(*points, strict=True), "-o", color=CHOSEN, alpha=shade, ms=3.5, label=label)
        value = getattr(best.evaluation.performance, figure)
        word = "computed maximum" if maximise else "computed minimum"
        marks = [f"{word} {x_scale.quantity(best.values[along.key])}: {y_scale.quantity(value)}"]
        top = x_scale.shown(best.values[along.key]), y_scale.shown(value)
        plot.plot(*top, "o", ms=10, mfc="none", mec=CHOSEN, mew=2, label=marks[0])
        if result.sweep.reference is not None and len(axes) == 1:
            marks.append(f"published optimum {x_scale.quantity(result.sweep.reference)}")
            published = x_scale.shown(result.sweep.reference)
            plot.axvline(published, color=PUBLISHED, lw=1.4, ls=(0, (5, 3)), label=marks[-1])
        if result.sweep.published and figure == _objective(spec):
            points = [(x_scale.shown(x), y_scale.shown(y)) for x, y in result.sweep.published]
            marks.append(f"published ({len(points)})")
            look: dict[str, Any] = {"color": PUBLISHED, "mfc": "none", "mew": 1.8, "ms": 8, "ls": "none"}
            plot.plot(*zip(*points, strict=True), "s", label=marks[-1], **look)
        failed = [x_scale.shown(row.values[along.key]) for row in result.rows if not row.evaluation.ok]
        if failed:
            marks.append(f"no result ({len(failed)})")
            _crosses(plot, failed, marks[-1])
        _legend_above(plot, 1 if len(axes) == 1 else 2)
        plot.set_xlabel(_axis(key_label(spec, along.key), x_scale.unit))
        plot.set_ylabel(_axis(figure_label(figure), y_scale.unit))
        alt = f"{capital(figure_label(figure))} over {key_label(spec, along.key)}; " + "; ".join(marks)
        caption = f"{capital(figure_label(figure))} over {key_label(spec, along.key)}, by {route}."
        return drawing(canvas, name, alt + ".", caption)


def _objective(spec: Spec) -> str:
    return spec.study.objective.figure if spec.study.objective is not None else ""


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
        best = [math.nan if i is None else _shown(values[i], scale) for i in search.best_so_far]
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
            _crosses(plot, failed, "no result")
        if search.start.objective is not None:
            plot.axhline(scale.shown(search.start.objective), color=START, lw=1.2, ls=(0, (2, 2)), label="start design")
        if beyond:
            plot.plot([], [], "^", color=MUTED, mfc="none", ms=6, mew=1.3, label=f"beyond the axis ({beyond})")
        if window is not None:
            plot.set_ylim(*window)
        _legend_above(plot, 3)
        plot.set_xlabel("evaluation")
        plot.set_ylabel(_axis(figure_label(objective.figure), scale.unit))
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
        _legend_above(plot, 2)
        plot.set_xlabel(_axis(key_label(spec, keys[0]), scales[0].unit))
        plot.set_ylabel(_axis(key_label(spec, keys[1]), scales[1].unit))
        alt = f"Designs of the search in the plane of {key_label(spec, keys[0])} and {key_label(spec, keys[1])}."
        caption = "Where the search went in the plane of its two variables."
        if beyond:
            caption += " The picture is fitted to the designs around the best; open marks at its edge lie beyond."
        return drawing(canvas, "search-path", alt, caption)


def force_curve(design: Evaluation, start: Evaluation | None) -> Drawing | None:
    """The force constant over the window by both routes; the start's stands behind."""
    if not design.positions:
        return None
    with style():
        canvas = new_figure(WIDTH, HEIGHT)
        plot = canvas.subplots()
        pairs = [(design, CHOSEN, "chosen, " if start else "")]
        if start is not None and start.positions:
            pairs.append((start, START, "start, "))
        for item, colour, word in pairs:
            z = [p.position * 1e3 for p in item.positions]
            plot.plot(
                z, [p.force_constant for p in item.positions], "-o", color=colour, ms=4, label=f"{word}stress tensor"
            )
            linkage = [p.force_constant_linkage for p in item.positions]
            plot.plot(
                z, linkage, ls=(0, (4, 2)), marker="s", mfc="none", color=colour, ms=5, label=f"{word}flux linkage"
            )
        # A ripple of half a per cent should look like one: never let the scale zoom in on less than 4 %.
        low, high = plot.get_ylim()
        spare = max(0.04 * high - (high - low), 0.0) / 2
        plot.set_ylim(low - spare, high + spare)
        _legend_above(plot, 2)
        plot.set_xlabel("position z (mm)")
        plot.set_ylabel("force constant (N/A)")
        alt = f"Force constant at {len(design.positions)} positions by stress tensor and by flux linkage."
        return drawing(canvas, "force", alt, "Force constant over position by both routes.")


def phase_curve(design: Evaluation) -> Drawing | None:
    """The thrust constants of the three phases over position."""
    if not design.positions:
        return None
    with style():
        canvas = new_figure(WIDTH, HEIGHT)
        plot = canvas.subplots()
        z = [p.position * 1e3 for p in design.positions]
        for i, (phase, colour) in enumerate(_PHASES):
            plot.plot(
                z, [p.thrust_constants[i] for p in design.positions], "-o", ms=4, color=colour, label=f"phase {phase}"
            )
        plot.axhline(0, color=MUTED, lw=0.8)
        _legend_above(plot, 3)
        plot.set_xlabel("position z (mm)")
        plot.set_ylabel("thrust per ampere (N/A)")
        return drawing(
            canvas, "phases", "Thrust constants of phases U, V and W over position.", "Thrust of each phase."
        )


def cogging_curve(design: Evaluation, start: Evaluation | None) -> Drawing | None:
    """The axial force at no current over position."""
    if not design.positions:
        return None
    both = [(design, CHOSEN, "chosen"), *([(start, START, "start")] if start is not None else [])]
    largest = max((abs(p.cogging_force) for item, _, _ in both for p in item.positions), default=0.0)
    factor, unit = (1e3, "mN") if largest < 0.5 else (1.0, "N")
    with style():
        canvas = new_figure(WIDTH, HEIGHT)
        plot = canvas.subplots()
        for item, colour, label in both:
            z = [p.position * 1e3 for p in item.positions]
            plot.plot(z, [p.cogging_force * factor for p in item.positions], "-o", ms=4, color=colour, label=label)
        plot.axhline(0, color=MUTED, lw=0.8)
        if len(both) > 1:
            _legend_above(plot, 2)
        plot.set_xlabel("position z (mm)")
        plot.set_ylabel(f"cogging force ({unit})")
        return drawing(
            canvas, "cogging", "Axial force at no current over position.", "Cogging: axial force at no current."
        )


def slot_curve(slots: SlotComparison) -> Drawing:
    """Slotted and slotless force constants as a cylinder is inserted, by equation (2)."""
    with style():
        canvas = new_figure(WIDTH, HEIGHT)
        plot = canvas.subplots()
        wall = [value * 1e3 for value in slots.wall_thickness]
        plot.plot(wall, slots.slotted, "-o", ms=4, color=PUBLISHED, label="slotted")
        plot.plot(wall, slots.slotless, "-o", ms=4, color=CHOSEN, label="slotless")
        plot.set_ylim(bottom=0)
        _legend_above(plot, 2)
        plot.set_xlabel("thickness of the cylinder's wall (mm)")
        plot.set_ylabel("force constant by eq. (2) (N/A)")
        alt = "Force constant by equation (2) over the cylinder's wall thickness, slotted and slotless."
        return drawing(canvas, "slots", alt, "A cylinder inserted between mover and winding, by the network.")


def _families(spec: Spec, result: SweepResult) -> list[tuple[dict[str, float], str | None, float]]:
    """For each curve: the values it holds, its label and its opacity. At most six curves, spread over the axis."""
    if len(result.sweep.axes) == 1:
        return [({}, None, 1.0)]
    axis = result.sweep.axes[0]
    count = min(len(axis.values), 6)
    picked = [axis.values[round(i * (len(axis.values) - 1) / max(count - 1, 1))] for i in range(count)]
    scale = key_scale(spec, axis.key, picked)
    return [
        ({axis.key: value}, scale.quantity(value), 0.3 + 0.7 * i / max(count - 1, 1)) for i, value in enumerate(picked)
    ]


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


def _shown(value: float | None, scale: Scale) -> float:
    """The number in the axis's unit; matplotlib leaves a gap where it is not a number."""
    return math.nan if value is None else scale.shown(value)


def _axis(label: str, unit: str) -> str:
    return f"{label} ({unit})" if unit else label


def _legend_above(plot: Axes, columns: int) -> None:
    """A legend above the axes: it never covers a point, whatever the data."""
    plot.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=columns, borderaxespad=0.2, handlelength=1.6)


def _crosses(plot: Axes, places: Sequence[float], label: str) -> None:
    """Designs without a result, as crosses along the foot of the axes."""
    foot = plot.get_xaxis_transform()
    plot.plot(places, [0.02] * len(places), "x", color=BAD, transform=foot, clip_on=False, label=label)
