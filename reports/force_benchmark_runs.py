"""The runs of a lead screw's force benchmark as pictures: experiments, zero-force line and steps of the force."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.simulation import Simulation, Trace, Trial
from fluxbore.reports.svg import CHOSEN, INK, MUTED, OTHER, PUBLISHED, START, Drawing, drawing, new_figure, style
from fluxbore.reports.wording import listing, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]

ESTIMATES = ("linear", "polynomial", "proposed")
COLOURS = {"linear": START, "polynomial": PUBLISHED, "proposed": CHOSEN}
LABELS = {"linear": "linear, (1)", "polynomial": "polynomial", "proposed": "proposed, (25) with x_d0"}
STEP_COLOURS = (CHOSEN, OTHER)

WIDE = 1000.0

SHOWN = 900
"""Points of one curve: more than a screen has across a panel."""


def experiments(simulation: Simulation) -> Drawing | None:
    """Load force, its estimates and their errors over time, a column for each experiment; None without traces."""
    trials = [trial for trial in of_run(simulation, "experiment") if trial.trace is not None]
    if not trials:
        return None
    with style():
        canvas = new_figure(WIDE, 520.0)
        plots = canvas.subplots(2, len(trials), sharex="col", height_ratios=(5, 4), squeeze=False)
        for column, trial in enumerate(trials):
            trace = trial.trace
            assert trace is not None
            few = _few(trace)
            time, load = trace.time[few], trace.signals["load_force"][few]
            top, bottom = plots[0, column], plots[1, column]
            for name in ESTIMATES:
                estimate = trace.signals[name][few]
                top.plot(time, estimate, color=COLOURS[name], lw=1.3)
                bottom.plot(time, estimate - load, color=COLOURS[name], lw=1.1, label=LABELS[name])
            top.plot(time, load, color=INK, lw=1.0, ls=(0, (4, 2)))
            bottom.axhline(0.0, color=INK, lw=0.8)
            top.set_title(title_of(trial), loc="left")
            bottom.set_xlabel("time (s)")
        plots[0, 0].set_ylabel("load force (N)")
        plots[1, 0].set_ylabel("estimate less load (N)")
        canvas.align_ylabels(plots[:, 0])
        plots[1, 0].plot([], [], color=INK, lw=1.0, ls=(0, (4, 2)), label="load itself")
        canvas.legend(*plots[1, 0].get_legend_handles_labels(), loc="outside upper left", ncols=len(ESTIMATES) + 1)
        alt = f"Load force, its three estimates and their errors over time in {listing(map(title_of, trials))}."
        caption = (
            "Load force and its estimates over time, and below what each estimate has too much, as in Figs. 19 to 21 "
            "(which show the size of the error); every panel has its own scale."
        )
        return drawing(canvas, "force-experiments", alt, caption, wide=True)


def zero_force_line(simulation: Simulation) -> Drawing | None:
    """x_d0 as two unloaded runs find it, beside the plant's own, over the rotor's angle; None without traces."""
    trial = next((trial for trial in of_run(simulation, "detection") if trial.trace is not None), None)
    if trial is None or trial.trace is None:
        return None
    signals = trial.trace.signals
    turns = signals["angle"] / math.tau
    found, true = signals["zero_force_line_found"] * 1e6, signals["zero_force_line"] * 1e6
    with style():
        canvas = new_figure(WIDE, 400.0)
        line, apart = canvas.subplots(2, 1, sharex=True, height_ratios=(5, 2))
        line.plot(turns, true, color=INK, lw=5.0, alpha=0.25, label="of the plant")
        line.plot(turns, found, color=CHOSEN, lw=1.1, label="found by a run forward and one backward, (24)")
        apart.plot(turns, found - true, color=CHOSEN, lw=1.0)
        apart.axhline(0.0, color=INK, lw=0.8)
        line.set_ylabel("zero-force line (µm)")
        apart.set_ylabel("off (µm)")
        apart.set_xlabel("turns of the rotor")
        line.margins(x=0.01)
        canvas.align_ylabels((line, apart))
        canvas.legend(*line.get_legend_handles_labels(), loc="outside upper left", ncols=2)
        off = plain(trial.figures["zero_force_line_error"] * 1e6, 2)
        alt = f"Zero-force line over the rotor's angle, found and true; they are {off} µm rms apart."
        caption = (
            "Relative displacement at which the force vanishes, over the rotor’s angle, as in Fig. 12: detected "
            f"without a force sensor, and the plant’s own at the mover’s place without load; {off} µm rms apart."
        )
        return drawing(canvas, "force-zero-line", alt, caption, wide=True)


def steps(simulation: Simulation, poles: Mapping[str, float]) -> Drawing | None:
    """Force over time after each step of its reference, with a first-order rise by the pole; None without traces.

    poles : reference (N) as the figures name it -> dominant pole (1/s) there.
    """
    trials = [trial for trial in of_run(simulation, "step") if trial.trace is not None]
    if not trials:
        return None
    with style():
        canvas = new_figure(WIDE, 380.0)
        left, right = canvas.subplots(1, 2, width_ratios=(3, 2))
        for trial, colour in zip(trials, STEP_COLOURS, strict=False):
            trace = trial.trace
            assert trace is not None
            reference = float(trial.setting["force"])
            few = _few(trace)
            time, force = trace.time[few], trace.signals["load_force"][few]
            left.axhline(reference, color=INK, lw=0.8, ls=(0, (4, 3)))
            left.plot(time, force, color=colour, lw=1.6, label=f"step to {reference:g} N")
            right.plot(time, force - reference, color=colour, lw=1.4)
            pole = poles.get(f"{reference:g}")
            if pole is not None:
                rise = reference * (1 - np.exp(pole * time))
                left.plot(time, rise, color=colour, lw=1.6, ls=(0, (1, 1.6)))
            _mark_t63(left, trial, force, colour)
        left.plot([], [], color=INK, lw=0.8, ls=(0, (4, 3)), label="reference")
        left.plot([], [], color=MUTED, lw=1.6, ls=(0, (1, 1.6)), label="1 − exp(pole · time)")
        left.set_ylabel("load force (N)")
        right.axhline(0.0, color=INK, lw=0.8)
        right.set_ylabel("load less reference (N)")
        _near_zero(right, trials)
        for plot in (left, right):
            plot.set_xlabel("time (s)")
        canvas.legend(*left.get_legend_handles_labels(), loc="outside upper left", ncols=len(trials) + 2)
        alt = "Load force after a step of its reference: " + "; ".join(
            f"{float(trial.setting['force']):g} N, 63 % after {plain(trial.figures['t63'], 2)} s, "
            f"{plain(trial.figures['error'], 2)} N off at the end"
            for trial in trials
        )
        caption = (
            "Load force after a step of its reference, as in Fig. 25. Rings: 63 % of the end value. Dotted: a rise of "
            "first order by the dominant pole, linearised at the reference force. On the right, the error that is left."
        )
        return drawing(canvas, "force-steps", alt + ".", caption, wide=True)


def of_run(simulation: Simulation, run: str) -> list[Trial]:
    """The trials of one run, in their order."""
    return [trial for trial in simulation.trials if trial.setting.get("run") == run]


def title_of(trial: Trial) -> str:
    """``experiment 3, to 165 N``."""
    number = str(trial.setting["number"]).partition(",")[0]
    return f"experiment {number}, to {float(trial.setting['force']):g} N"


def _few(trace: Trace) -> slice:
    """Every so many samples that no more than `SHOWN` are left."""
    return slice(None, None, max(1, math.ceil(len(trace.time) / SHOWN)))


def _mark_t63(plot: Axes, trial: Trial, force: Floats, colour: str) -> None:
    """A ring where the force has come to 1 − 1/e of its end."""
    plot.plot(trial.figures["t63"], (1 - math.exp(-1)) * force[-1], "o", color=colour, ms=8, mfc="none", mew=1.6)


def _near_zero(plot: Axes, trials: Sequence[Trial]) -> None:
    """The scale of the errors that stay, not of the step itself."""
    largest = max(abs(trial.figures["error"]) for trial in trials)
    reference = max(float(trial.setting["force"]) for trial in trials)
    plot.set_ylim(-max(5 * largest, 0.02 * reference), max(largest, 0.005 * reference))
