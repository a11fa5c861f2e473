"""The pictures of a study with several ends: the Pareto front, and the tolerances that cost the yield."""

from __future__ import annotations

from fluxbore.design.spec import Spec
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.pareto_result import ParetoResult
from fluxbore.optimize.tolerance_result import ToleranceResult
from fluxbore.reports.svg import BAD, CHOSEN, GOOD, INK, MUTED, PUBLISHED, START, Drawing, drawing, new_figure, style
from fluxbore.reports.tolerances import tolerance_text
from fluxbore.reports.wording import capital, figure_label, figure_scale, key_label

WIDTH, HEIGHT = 500.0, 360.0

LEAST_BARS = 3
"""Bars for which the picture has room in any case."""


def front_curve(result: ParetoResult, chosen: Candidate | None) -> Drawing | None:
    """Both objectives of every point, the start's and the chosen design's beside them; None without a point."""
    found = [
        (point, point.second, point.first)
        for point in result.points
        if point.first is not None and point.second is not None
    ]
    if not found:
        return None
    one, other = result.objective.figure, result.against.figure
    y_scale, x_scale = figure_scale(one, [y for _, _, y in found]), figure_scale(other, [x for _, x, _ in found])
    with style():
        canvas = new_figure(WIDTH, HEIGHT)
        plot = canvas.subplots()
        on = [(x_scale.shown(x), y_scale.shown(y)) for point, x, y in found if point.standing == "front"]
        off = [(x_scale.shown(x), y_scale.shown(y)) for point, x, y in found if point.standing != "front"]
        if on:
            plot.plot(*zip(*sorted(on), strict=True), "-o", color=CHOSEN, ms=6, label=f"front ({len(on)})")
        if off:
            label = f"dominated or repeated ({len(off)})"
            plot.plot(*zip(*off, strict=True), "D", color=PUBLISHED, mfc="none", ms=6, mew=1.3, label=label)
        marks = []
        for item, label, marker, colour, size in (
            (result.start, "start", "s", START, 8),
            (chosen, "chosen", "*", INK, 13),
        ):
            if item is None or not item.evaluation.ok:
                continue
            x, y = (getattr(item.evaluation.performance, name) for name in (other, one))
            if x is None or y is None:
                continue
            broken = "" if item.feasible else " (breaks a limit)"
            at = (x_scale.shown(x), y_scale.shown(y))
            plot.plot(*at, marker, color=colour, ms=size, ls="none", label=f"{label}{broken}")
            marks.append(f"{label} {y_scale.quantity(y)} at {x_scale.quantity(x)}")
        plot.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, borderaxespad=0.2, handlelength=1.6)
        plot.margins(0.08)
        plot.set_xlabel(f"{figure_label(other)} ({x_scale.unit})" if x_scale.unit else figure_label(other))
        plot.set_ylabel(f"{figure_label(one)} ({y_scale.unit})" if y_scale.unit else figure_label(one))
        title = f"{capital(figure_label(one))} over {figure_label(other)}"
        alt = f"{title} along the front of {len(on)} designs; " + "; ".join(marks) + "."
        return drawing(canvas, "front", alt, f"{title}: the designs that none surpasses in both.")


def tolerance_bars(spec: Spec, result: ToleranceResult) -> Drawing | None:
    """What half of each tolerance would gain of the yield, the most harmful on top; None without a tolerance."""
    if not result.effects:
        return None
    effects = result.effects[::-1]
    gains = [100 * effect.gain for effect in effects]
    names = [f"{key_label(spec, effect.tolerance.key)}\n{tolerance_text(spec, effect.tolerance)}" for effect in effects]
    with style():
        canvas = new_figure(WIDTH, 60.0 + 46.0 * max(len(effects), LEAST_BARS))
        plot = canvas.subplots()
        colours = [BAD if gain == max(gains) and gain > 0 else CHOSEN if gain >= 0 else GOOD for gain in gains]
        plot.barh(range(len(gains)), gains, color=colours, height=0.6)
        for place, gain in enumerate(gains):
            text = f"{gain:+.2g}".replace("-", "−") if abs(gain) >= 0.005 else "0"
            plot.annotate(text, (max(gain, 0.0), place), xytext=(5, 0), textcoords="offset points", va="center")
        plot.axvline(0, color=MUTED, lw=0.8)
        plot.set_yticks(range(len(gains)), names)
        plot.grid(visible=False, axis="y")
        plot.margins(x=0.12)
        plot.set_xlabel("yield gained (percentage points)")
        ranked = "; ".join(
            f"{key_label(spec, effect.tolerance.key)} {100 * effect.gain:.3g}" for effect in result.effects
        )
        alt = f"Yield gained in percentage points if one tolerance were halved: {ranked}."
        return drawing(canvas, "tolerances", alt, "What half of one tolerance would gain, the others as they are.")
