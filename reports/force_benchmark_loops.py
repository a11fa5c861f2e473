"""The static loops of a magnetic lead screw's force over its displacement: the picture of (17) and (18)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.magnetic_hysteresis import (
    HysteresisSpring,
    force_record,
    peak_force,
    steady_branches,
    steady_loop,
)
from fluxbore.design.dynamics.magnetic_spring import SineSpring
from fluxbore.reports.svg import CHOSEN, INK, MUTED, OTHER, PUBLISHED, START, Drawing, drawing, new_figure, style
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import listing, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]

WIDE = 1000.0

COLOURS = (CHOSEN, OTHER, PUBLISHED, START)

POINTS = 201
"""On either branch of a loop: a hundredth of the way is finer than the page shows."""


def loops_section(spring: HysteresisSpring, law: SineSpring, forces: Sequence[float]) -> dict[str, object]:
    """The picture, the table and the sentences of the loops up to these forces (N) of the sine."""
    return {
        "figure": loops(spring, law, forces),
        "table": loop_table(spring, law, forces),
        "sentence": peak_sentence(spring, law),
    }


def amplitude(law: SineSpring, force: float) -> float:
    """The displacement (m) at which the plain sine (14) has a force (N) below its stall force."""
    return law.transfer_ratio * math.asin(force / law.stall_force)


def peak_sentence(spring: HysteresisSpring, law: SineSpring) -> str:
    """That (17) does not reach the stall force that it is written with."""
    peak, bound = peak_force(spring), spring.memory.bound
    held = math.sin(_held(spring, law))
    more = 100 * (law.stall_force / peak - 1)
    stall = f"{plain(law.stall_force, 1)}\u00a0N"
    return (
        f"The force of (17) peaks at w F_stall + (1 − w) F_stall sin(x_s/h) = {plain(peak, 1)}\u00a0N, not at "
        f"F_stall = {stall}: (18) holds its memory x_s within {plain(bound * 1e3, 3)}\u00a0mm, where the sine of its "
        f"share, 1 − w = {plain(1 - spring.weight, 2)}, is {plain(held, 3)}. To peak at {stall}, (17) would need an "
        f"F_stall that is {plain(more, 1)}\u00a0% larger."
    )


def loop_table(spring: HysteresisSpring, law: SineSpring, forces: Sequence[float]) -> Table:
    """Amplitude, height at no displacement, area and tip of each loop."""
    rows = []
    for force in forces:
        reach = amplitude(law, force)
        loop = steady_loop(spring, reach)
        rows.append(
            (
                Cell(f"{plain(force, 0)}\u00a0N"),
                Cell(plain(reach * 1e3, 3)),
                Cell(plain(loop.height, 2), "strong"),
                Cell(plain(loop.area * 1e3, 2)),
                Cell(plain(loop.peak, 1)),
            )
        )
    head = ("Up to, by (14)", "Amplitude of x_d (mm)", "Height at x_d = 0 (N)", "Area (mJ)", "Force at the tip (N)")
    return Table("Closed loops of the hysteresis (17), (18)", head, tuple(rows))


def loops(spring: HysteresisSpring, law: SineSpring, forces: Sequence[float]) -> Drawing:
    """Force over displacement, and what of it the sine alone does not give; the loops' heights at no displacement."""
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
        for number, force in enumerate(forces):
            _loop(whole, near, spring, law, force, COLOURS[number % len(COLOURS)])
        for level, text in ((law.stall_force, "stall force"), (peak_force(spring), "peak of (17)")):
            low = text != "stall force"
            whole.axhline(level, color=MUTED, lw=0.8, ls=(0, (1, 2)))
            whole.annotate(
                f"{text} {plain(level, 1)} N",
                (-quarter * 1e3, level),
                xytext=(0, -3 if low else 3),
                textcoords="offset points",
                va="top" if low else "bottom",
                fontsize=10.5,
            )
        whole.set_ylim(-1.15 * law.stall_force, 1.2 * law.stall_force)
        whole.set_xlabel("relative displacement (mm)")
        whole.set_ylabel("force (N)")
        near.axvline(0.0, color=MUTED, lw=0.8)
        near.axhline(0.0, color=MUTED, lw=0.8)
        near.set_xlabel("relative displacement (mm)")
        near.set_ylabel("force less that of the sine (N)")
        canvas.legend(*whole.get_legend_handles_labels(), loc="outside upper left", ncols=2 + len(forces))
        heights = listing(
            f"{plain(steady_loop(spring, amplitude(law, f)).height, 2)} N up to {plain(f, 0)} N" for f in forces
        )
        alt = f"Hysteresis loops of the magnetic force over the displacement; height at no displacement {heights}."
        caption = (
            "Force of (17) over the displacement, as in Figs. 9 and 18: closed loops, the first way from rest, and the "
            "sine alone. On the right the sine is taken off; the arrows are the loops’ heights at no displacement."
        )
        return drawing(canvas, "force-loops", alt, caption, wide=True)


def _loop(whole: Axes, near: Axes, spring: HysteresisSpring, law: SineSpring, force: float, colour: str) -> None:
    """One closed loop in both panels, its height as an arrow."""
    way, up, down = steady_branches(spring, amplitude(law, force), POINTS)
    middle = len(way) // 2
    high, low = float(up[middle]), float(down[middle])
    round_way = np.concatenate((way, way[::-1])) * 1e3
    whole.plot(
        round_way,
        np.concatenate((up, down[::-1])),
        color=colour,
        lw=1.3,
        label=f"loop up to {force:g} N, {plain(high - low, 2)} N high",
    )
    sine = law.force(way)
    near.plot(round_way, np.concatenate((up - sine, (down - sine)[::-1])), color=colour, lw=1.3)
    near.annotate(
        "",
        (0.0, high),
        xytext=(0.0, low),
        arrowprops={"arrowstyle": "<->", "color": colour, "lw": 1.2, "shrinkA": 0, "shrinkB": 0},
    )


def _held(spring: HysteresisSpring, law: SineSpring) -> float:
    """x_s/h (rad) at the peak of (17)."""
    return min(spring.memory.bound / law.transfer_ratio, math.pi / 2)
