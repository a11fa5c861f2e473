"""The static loops of a magnetic lead screw's force over its displacement: pictures and words for (17) and (18)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.force_parameters import ForceParameters
from fluxbore.design.dynamics.magnetic_hysteresis import force_record, peak_force
from fluxbore.design.dynamics.magnetic_spring import SineSpring
from fluxbore.design.dynamics.simulation import Trace, Trial
from fluxbore.reports.svg import CHOSEN, INK, MUTED, OTHER, Drawing, drawing, new_figure, style
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import listing, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]

WIDE = 1000.0

COLOURS = (CHOSEN, OTHER)
"""Of the smaller loop and of the larger one."""

POINTS = 201
"""Of a curve: a hundredth of the way is finer than the page shows."""


def peak_sentence(parameters: ForceParameters) -> str:
    """That (17) does not reach the stall force that it is written with."""
    spring, given = parameters.spring, parameters.stall_force
    peak, bound = peak_force(spring), spring.memory.bound
    held = math.sin(min(bound / parameters.transfer_ratio, math.pi / 2))
    stall = f"{plain(given, 1)}\u00a0N"
    return (
        f"The force of (17) peaks at w F_stall + (1 − w) F_stall sin(x_s/h) = {plain(peak, 1)}\u00a0N, not at "
        f"F_stall = {stall}: (18) holds its memory x_s within {plain(bound * 1e3, 3)}\u00a0mm, where the sine of its "
        f"share, 1 − w = {plain(1 - spring.weight, 2)}, is {plain(held, 3)}. To peak at {stall}, (17) would need an "
        f"F_stall that is {plain(100 * (given / peak - 1), 1)}\u00a0% larger."
    )


def loop_table(trials: Sequence[Trial]) -> Table:
    """Height at no displacement, area and tip of each loop."""
    rows = tuple(
        (
            Cell(f"{float(trial.setting['force']):g}\u00a0N"),
            Cell(plain(trial.figures["height"], 2), "strong"),
            Cell(plain(trial.figures["area"] * 1e3, 2)),
            Cell(plain(trial.figures["peak"], 1)),
        )
        for trial in trials
    )
    head = ("Up to, by the sine (14)", "Height at x_d = 0 (N)", "Area (mJ)", "Force at the tip (N)")
    return Table("Closed loops of the hysteresis (17), (18)", head, rows)


def loops(parameters: ForceParameters, trials: Sequence[Trial]) -> Drawing | None:
    """Force over displacement, and what of it the sine does not give; None without traces."""
    traced = [(trial, trial.trace) for trial in trials if trial.trace is not None]
    if not traced:
        return None
    law, spring = SineSpring(parameters.stall_force, parameters.transfer_ratio), parameters.spring
    quarter = law.transfer_ratio * math.pi / 2
    with style():
        canvas = new_figure(WIDE, 420.0)
        whole, near = canvas.subplots(1, 2, width_ratios=(5, 6), gridspec_kw={"wspace": 0.05})
        way = np.linspace(-quarter, quarter, POINTS)
        whole.plot(way * 1e3, law.force(way), color=MUTED, lw=1.0, ls=(0, (4, 3)), label="sine alone, (14)")
        once = np.linspace(0.0, quarter, POINTS)
        virgin = force_record(spring, once)
        whole.plot(once * 1e3, virgin, color=INK, lw=1.0, label="first way from rest")
        near.plot(once * 1e3, virgin - law.force(once), color=INK, lw=1.0)
        for (trial, trace), colour in zip(traced, COLOURS, strict=False):
            _loop(whole, near, law, trial, trace, colour)
        _level(whole, -quarter, law.stall_force, "stall force", above=True)
        _level(whole, -quarter, peak_force(spring), "peak of (17)", above=False)
        whole.set_ylim(-1.15 * law.stall_force, 1.2 * law.stall_force)
        whole.set_ylabel("force (N)")
        near.axvline(0.0, color=MUTED, lw=0.8)
        near.axhline(0.0, color=MUTED, lw=0.8)
        near.set_ylabel("force less that of the sine (N)")
        for plot in (whole, near):
            plot.set_xlabel("relative displacement (mm)")
        canvas.legend(*whole.get_legend_handles_labels(), loc="outside upper left", ncols=2 + len(traced))
        heights = listing(_height(trial) for trial, _ in traced)
        alt = f"Hysteresis loops of the magnetic force over the relative displacement: {heights}."
        caption = (
            "Force of (17) over the displacement, as in Figs. 9 and 18: closed loops, the first way from rest, and the "
            "sine alone. On the right the sine is taken off; the arrows are the loops’ heights at no displacement."
        )
        return drawing(canvas, "force-loops", alt, caption, wide=True)


def _loop(whole: Axes, near: Axes, law: SineSpring, trial: Trial, trace: Trace, colour: str) -> None:
    """One closed loop in both panels, its height as an arrow."""
    way, force = trace.signals["displacement"], trace.signals["spring_force"]
    whole.plot(way * 1e3, force, color=colour, lw=1.3, label=f"loop {_height(trial)}")
    near.plot(way * 1e3, force - law.force(way), color=colour, lw=1.3)
    half = trial.figures["height"] / 2
    ends = {"arrowstyle": "<->", "color": colour, "lw": 1.2, "shrinkA": 0, "shrinkB": 0}
    near.annotate("", (0.0, half), xytext=(0.0, -half), arrowprops=ends)


def _height(trial: Trial) -> str:
    """``up to 75 N, 2.12 N high``."""
    return f"up to {float(trial.setting['force']):g} N, {plain(trial.figures['height'], 2)} N high"


def _level(plot: Axes, left: float, force: float, text: str, *, above: bool) -> None:
    """A force (N) that nothing exceeds, named at a displacement (m)."""
    plot.axhline(force, color=MUTED, lw=0.8, ls=(0, (1, 2)))
    plot.annotate(
        f"{text} {plain(force, 1)} N",
        (left * 1e3, force),
        xytext=(0, 3 if above else -3),
        textcoords="offset points",
        va="bottom" if above else "top",
        fontsize=10.5,
    )
