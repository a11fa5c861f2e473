"""The curves of a report: sweeps, force over position, slotted against slotless."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.outcome import SweepResult
from fluxbore.reports.axes import HEIGHT, WIDTH, axis_title, crosses, legend_above, shown
from fluxbore.reports.content import SlotComparison
from fluxbore.reports.svg import (
    BAD,
    CHOSEN,
    GOOD,
    MUTED,
    PUBLISHED,
    START,
    Drawing,
    drawing,
    new_figure,
    style,
)
from fluxbore.reports.wording import capital, figure_label, figure_scale, key_label, key_scale

if TYPE_CHECKING:
    pass


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
                (x_scale.shown(row.values[along.key]), shown(getattr(row.evaluation.performance, figure), y_scale))
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
            crosses(plot, failed, marks[-1])
        legend_above(plot, 1 if len(axes) == 1 else 2)
        plot.set_xlabel(axis_title(key_label(spec, along.key), x_scale.unit))
        plot.set_ylabel(axis_title(figure_label(figure), y_scale.unit))
        alt = f"{capital(figure_label(figure))} over {key_label(spec, along.key)}; " + "; ".join(marks)
        caption = f"{capital(figure_label(figure))} over {key_label(spec, along.key)}, by {route}."
        return drawing(canvas, name, alt + ".", caption)


def _objective(spec: Spec) -> str:
    return spec.study.objective.figure if spec.study.objective is not None else ""


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
        legend_above(plot, 2)
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
        legend_above(plot, 3)
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
            legend_above(plot, 2)
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
        legend_above(plot, 2)
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
