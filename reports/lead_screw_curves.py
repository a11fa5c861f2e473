"""Curves of a magnetic lead screw: force and energy over the displacement, what is engaged, figures over the pitch."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from fluxbore.optimize.pitch_curve import PitchCurve, PitchPoint
from fluxbore.reports.lead_screw_content import ScrewContent
from fluxbore.reports.svg import (
    BAD,
    CHOSEN,
    GOOD,
    INK,
    MUTED,
    PUBLISHED,
    START,
    Drawing,
    drawing,
    new_figure,
    style,
)
from fluxbore.reports.wording import Scale, capital, figure_label, figure_scale, scale, significant

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDE = 1000.0

SPAN = -0.5, 1.4
"""Of the pitch, along the displacement: the rest before and after a slip, and both their peaks."""

SAMPLES = 481

NOTABLE_MISS = 0.01
"""Of the stall force, by which the series may miss a field before the caption tells."""

Value = Callable[[PitchPoint], float | None]


def force_curve(content: ScrewContent, load: float) -> Drawing:
    """Force and torque over the displacement, with the spring constant, the load (N) and the slip at the stall."""
    spring, pitch = content.spring, content.spring.pitch
    top, stall = content.peak
    forces = scale("force", [stall])
    x = np.linspace(SPAN[0], SPAN[1], SAMPLES) * pitch
    rest = content.rest_under(load)
    with style():
        canvas = new_figure(WIDE, 460.0)
        plot = canvas.subplots()
        _falling(plot, top, pitch)
        plot.axhline(0, color=MUTED, lw=0.8)
        plot.plot(
            x * 1e3, content.analytic.force(x) / forces.factor, color=START, ls=(0, (5, 3)), label="analytic field"
        )
        plot.plot(x * 1e3, spring.force(x) / forces.factor, color=CHOSEN, lw=2.2, label="finite elements")
        solved = [(item.displacement * 1e3, item.force / forces.factor) for item in content.samples]
        plot.plot(*zip(*solved, strict=True), "o", ms=6, mfc="none", mec=CHOSEN, mew=1.6, label="solved there")
        slope = float(spring.stiffness(0.0))
        ends = np.array([-0.5, 1.0]) * stall / slope
        tangent = scale("stiffness", [slope]).quantity(slope)
        plot.plot(
            ends * 1e3,
            slope * ends / forces.factor,
            color=GOOD,
            lw=1.4,
            ls=(0, (2, 2)),
            label=f"spring constant {tangent}",
        )
        if load > 0:
            _load(plot, content, load, rest, forces)
        _slip(plot, content, forces)
        plot.set_xlim(x[0] * 1e3, x[-1] * 1e3)
        most = max(stall, content.analytic.peak[1]) / forces.factor
        plot.set_ylim(-1.3 * most, 1.45 * most)
        plot.set_xlabel("relative displacement x_d (mm)")
        plot.set_ylabel(f"force F ({forces.unit})")
        torques = scale("torque", [content.screw.h * stall])
        factor = content.screw.h * forces.factor / torques.factor

        def torque(force: Any) -> Any:
            return force * factor

        def back(torque: Any) -> Any:
            return torque / factor

        beside = plot.secondary_yaxis("right", functions=(torque, back))
        beside.set_ylabel(f"torque h F ({torques.unit})")
        canvas.legend(*plot.get_legend_handles_labels(), loc="outside upper left", ncols=4)
        alt = (
            f"Force over the relative displacement: largest {forces.quantity(stall)} at {top * 1e3:.4g} mm, "
            f"spring constant {tangent} at rest."
        )
        caption = (
            "Force that pulls the rotor back, and the motor’s torque for it, over the relative displacement x_d. "
            "Between the peaks, in the shade, no load is held: the rotor goes on to the next rest, one pitch away."
        )
        miss = abs(float(spring.force(top)) / stall - 1)
        if miss > NOTABLE_MISS:
            caption += (
                f" Iron saturates so sharply here that the curve, drawn through what was solved, is out by "
                f"{100 * miss:.0f}\u00a0% at the stall; the star is solved."
            )
        return drawing(canvas, "screw-force", alt, caption, wide=True)


def _falling(plot: Axes, top: float, pitch: float) -> None:
    """Shade where the force falls as the displacement grows: nothing rests there."""
    for low, high in ((SPAN[0] * pitch, -top), (top, pitch - top), (pitch + top, SPAN[1] * pitch)):
        plot.axvspan(low * 1e3, high * 1e3, color=BAD, alpha=0.08, lw=0)


def _load(plot: Axes, content: ScrewContent, load: float, rest: float | None, forces: Scale) -> None:
    """The load as a level line, and where it comes to rest."""
    label = f"load {significant(load / forces.factor)}\u00a0{forces.unit}"
    if rest is None:
        plot.axhline(load / forces.factor, color=PUBLISHED, lw=1.4, ls=(0, (6, 3)), label=f"{label}: slips")
        return
    plot.plot([0.0, rest * 1e3], [load / forces.factor] * 2, color=PUBLISHED, lw=1.4)
    plot.plot([rest * 1e3] * 2, [0.0, load / forces.factor], color=PUBLISHED, lw=1.4)
    at = rest * 1e3, load / forces.factor
    plot.plot(*at, "s", ms=7, color=PUBLISHED, label=f"{label} at {significant(rest * 1e3, 3)}\u00a0mm")


def _slip(plot: Axes, content: ScrewContent, forces: Scale) -> None:
    """The peak with its figures, and the way to the next one."""
    top, stall = content.peak
    level, pitch = stall / forces.factor, content.spring.pitch
    plot.plot([top * 1e3, (top + pitch) * 1e3], [level] * 2, "*", ms=13, color=INK, ls="none", label="stall")
    plot.annotate(
        "",
        ((top + pitch) * 1e3, 1.06 * level),
        (top * 1e3, 1.06 * level),
        arrowprops={"arrowstyle": "-|>", "color": BAD, "lw": 1.4, "shrinkA": 4, "shrinkB": 4},
    )
    text = f"slips by one pitch, {significant(pitch * 1e3)}\u00a0mm"
    plot.annotate(text, ((top + pitch / 2) * 1e3, 1.09 * level), ha="center", va="bottom", color=BAD)
    where = f"stall {forces.quantity(stall)}\nat {significant(top * 1e3)}\u00a0mm"
    plot.annotate(where, (top * 1e3, 1.08 * level), ha="right", va="bottom", xytext=(-2, 0), textcoords="offset points")


def energy_curve(content: ScrewContent, load: float) -> Drawing:
    """What the spring stores over the displacement, to the top where it slips."""
    spring, pitch = content.spring, content.spring.pitch
    top, _ = content.peak
    energies = scale("work", [spring.barrier])
    x = np.linspace(SPAN[0], SPAN[1], SAMPLES) * pitch
    rest = content.rest_under(load)
    with style():
        canvas = new_figure(500.0, 330.0)
        plot = canvas.subplots()
        _falling(plot, top, pitch)
        plot.plot(x * 1e3, spring.energy(x) / energies.factor, color=CHOSEN)
        marks = [("at the top", "^", BAD, pitch / 2), ("at the stall", "*", INK, top)]
        if load > 0 and rest is not None:
            marks.append(("under the load", "s", PUBLISHED, rest))
        for name, marker, colour, place in marks:
            stored = float(spring.energy(place))
            at = place * 1e3, stored / energies.factor
            size = 12 if marker == "*" else 7
            plot.plot(*at, marker, color=colour, ms=size, ls="none", label=f"{name} {energies.quantity(stored)}")
        plot.set_ylim(0, 1.15 * spring.barrier / energies.factor)
        plot.set_xlim(x[0] * 1e3, x[-1] * 1e3)
        plot.set_xlabel("relative displacement x_d (mm)")
        plot.set_ylabel(f"stored energy ({energies.unit})")
        plot.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, borderaxespad=0.2, columnspacing=1.2)
        alt = f"Stored energy over the relative displacement, {energies.quantity(spring.barrier)} at the top."
        caption = "Energy of the magnetic spring beyond its rest, the force integrated; over the top the screw slips."
        return drawing(canvas, "screw-energy", alt, caption)


def engagement_curve(content: ScrewContent, load: float) -> Drawing:
    """The stall force that is left over the mover's position."""
    forces = scale("force", [max(content.engaged)])
    end = content.stroke / 2 * 1e3
    with style():
        canvas = new_figure(500.0, 330.0)
        plot = canvas.subplots()
        plot.axvspan(-end, end, color=GOOD, alpha=0.08, lw=0)
        for sign in (-1, 1):
            plot.axvline(
                sign * end, color=GOOD, lw=1.2, ls=(0, (5, 3)), label="ends of the stroke" if sign > 0 else None
            )
        places = [place * 1e3 for place in content.positions]
        plot.plot(places, [force / forces.factor for force in content.engaged], color=CHOSEN, label="stall force left")
        if load > 0:
            label = f"load {significant(load / forces.factor)}\u00a0{forces.unit}"
            plot.axhline(load / forces.factor, color=PUBLISHED, lw=1.4, ls=(0, (6, 3)), label=label)
        plot.set_ylim(bottom=0.0)
        plot.set_xlabel("rotor’s middle from the translator’s (mm)")
        plot.set_ylabel(f"stall force ({forces.unit})")
        plot.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, borderaxespad=0.2, columnspacing=1.2)
        alt = f"Stall force over the mover's position; stroke of {significant(2 * end)} mm shaded."
        caption = (
            "Stall force over the mover’s position, in proportion to the overlap of both members’ magnets; fringes of "
            "about a pole at the ends are left out."
        )
        return drawing(canvas, "screw-engagement", alt, caption)


def pitch_curves(curve: PitchCurve) -> Drawing | None:
    """Stall force and stiffness over the pitch, and what the motor and the volume make of it."""
    if not curve.network:
        return None
    panels = [panel for panel in PITCH_PANELS if any(_figure(item, panel) is not None for item in curve.network)]
    with style():
        rows = (len(panels) + 1) // 2
        canvas = new_figure(WIDE, 30.0 + 290.0 * rows)
        plots = canvas.subplots(rows, 2, squeeze=False).ravel()
        for plot, name in zip(plots, panels, strict=False):
            _panel(plot, curve, name)
        for plot in plots[len(panels) :]:
            plot.set_visible(False)
        for plot in plots[max(0, len(panels) - 2) : len(panels)]:
            plot.set_xlabel("pitch l_p (mm)")
        handles, labels = plots[0].get_legend_handles_labels()
        canvas.legend(handles, labels, loc="outside upper left", ncols=4)
        own = curve.design.evaluation.performance
        forces, slopes = (
            figure_scale("stall_force", [own.stall_force]),
            figure_scale("spring_constant", [own.spring_constant]),
        )
        alt = (
            f"Stall force and spring constant over the pitch; the design at {curve.design.pitch * 1e3:.4g} mm has "
            f"{forces.quantity(own.stall_force)} and {slopes.quantity(own.spring_constant)}."
        )
        caption = (
            "The same design with other pitches: with its number of poles, so that the rotor’s magnets grow with the "
            "pitch, and at the design’s own length of poles, which then need not be a whole number."
        )
        return drawing(canvas, "screw-pitch", alt, caption, wide=True)


PITCH_PANELS = ("stall_force", "spring_constant", "motor_torque", "stall_force_density")
"""Figures over the pitch."""

PER_LENGTH = ("stall_force", "spring_constant")
"""Those that go with the length of the poles, all else the same."""


def _figure(item: PitchPoint, name: str) -> float | None:
    value = getattr(item.evaluation.performance, name)
    return None if value is None else float(value)


def _panel(plot: Axes, curve: PitchCurve, name: str) -> None:
    """One figure over the pitch by both routes, the design marked."""
    axis = figure_scale(name, [_figure(item, name) for item in curve.network])
    length = curve.design.active_length

    def points(items: Sequence[PitchPoint], same_length: bool) -> tuple[list[float], list[float]]:
        pairs = [
            (item.pitch * 1e3, axis.shown(value * (length / item.active_length if same_length else 1.0)))
            for item in items
            if (value := _figure(item, name)) is not None
        ]
        return [x for x, _ in pairs], [y for _, y in pairs]

    plot.plot(*points(curve.network, False), color=CHOSEN, label="analytic field")
    plot.plot(*points(curve.fem, False), "o", mfc="none", mec=CHOSEN, mew=1.6, ms=6, label="finite elements")
    if name in PER_LENGTH:
        label = "analytic field, poles as long as the design’s"
        plot.plot(*points(curve.network, True), color=PUBLISHED, ls=(0, (5, 3)), label=label)
    plot.axvline(curve.design.pitch * 1e3, color=MUTED, lw=0.9, ls=(0, (2, 2)))
    own = _figure(curve.design, name)
    if own is not None:
        at = curve.design.pitch * 1e3, axis.shown(own)
        plot.plot(*at, "*", ms=14, color=INK, ls="none", label="the design, by finite elements", zorder=5)
    plot.set_ylim(0.0, 1.02 * plot.get_ylim()[1])
    plot.set_ylabel(f"{capital(figure_label(name))} ({axis.unit})")
