"""Which forces an electro-hydrostatic actuator makes at which frequency, and how well, as pictures (Figs. 6 and 7)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.force_reference import HALF, READINGS
from fluxbore.design.dynamics.simulation import Simulation, Trial
from fluxbore.design.dynamics.tracking_benchmark import TRACKING
from fluxbore.design.dynamics.tracking_stand import TrackingStand
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.hydrostatic_figures import force_frequency_limit, ideal_force
from fluxbore.design.hydrostatic_range import demand
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
from fluxbore.reports.wording import plain

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]

WIDE = 1000.0

READING_COLOURS = {HALF: CHOSEN}
"""The other reading has `OTHER`."""

WORDS = {HALF: "amplitude read as half the distance between peaks"}
"""The other reading: the whole distance."""

FREQUENCIES, AMPLITUDES = 9, 12
"""At which pressure, torque and power are computed: their limits are smooth lines, right to 1 %."""


def made(simulation: Simulation) -> list[Trial]:
    """The pairs that can be made, in their order."""
    return [trial for trial in _pairs(simulation) if not trial.setting["reason"]]


def refused(simulation: Simulation) -> list[Trial]:
    """Those that cannot."""
    return [trial for trial in _pairs(simulation) if trial.setting["reason"]]


def swing(trial: Trial) -> float:
    """Half the distance between the peaks of a pair's reference (N)."""
    return float(trial.setting["amplitude"]) / (1 if trial.setting["reading"] == HALF else 2)


def operating_range(simulation: Simulation, actuator: HydrostaticActuator, stand: TrackingStand) -> Drawing:
    """Force over frequency with every limit, and the pairs with their mean absolute errors."""
    trials = _pairs(simulation)
    pairs = [float(trial.setting["frequency"]) for trial in trials]
    low, high = min(pairs) / 2, max(pairs) * 2
    largest = max(swing(trial) for trial in trials)
    f = np.geomspace(low, high, 200)
    with style():
        canvas = new_figure(WIDE, 520.0)
        plot = canvas.subplots()
        plot.set_xscale("log")
        plot.set_yscale("log")
        plot.plot(f, force_frequency_limit(actuator) / f, color=INK, lw=2.0, label="speed, (4)")
        end = _force_at_end(actuator)
        _level(plot, f, (end - stand.offset) / 2, START, "stroke")
        _level(plot, f, (end - stand.margin - stand.offset) / 2, START, "stroke less margin", dashed=True)
        top = 3 * max(largest, (ideal_force(actuator) - stand.offset) / 2)
        at = np.geomspace(low, high, FREQUENCIES)
        pressure, torque, power = load_limits(actuator, stand.offset, at, top)
        plot.plot(at, pressure, color=BAD, lw=1.5, label="rated pressure")
        plot.plot(at, torque, color=GOOD, lw=1.5, label="motor’s torque")
        if actuator.motor.rated_power is not None:
            plot.plot(at, power, color=PUBLISHED, lw=1.5, label="motor’s power")
        for trial in trials:
            _mark(plot, trial)
        plot.set_xlim(low, high)
        plot.set_ylim(min(swing(trial) for trial in trials) / 2, top)
        plot.set_xlabel("frequency (Hz)")
        plot.set_ylabel("half the distance between the force’s peaks (N)")
        for axis in (plot.xaxis, plot.yaxis):
            axis.set_major_formatter(lambda value, _: f"{value:g}")
        canvas.legend(*plot.get_legend_handles_labels(), loc="outside upper left", ncols=5)
        alt = "Largest force over frequency by each limit, with the pairs’ mean absolute errors: " + "; ".join(
            f"{swing(trial):g} N at {float(trial.setting['frequency']):g} Hz: {_error(trial)}" for trial in trials
        )
        caption = (
            "Sinusoidal forces above the stand’s offset that each limit allows, as in Fig. 6, and the simulated pairs "
            "with their mean absolute errors: discs where the amplitude is half the distance between the peaks, "
            "squares where it is the whole of it, crosses for what cannot be made."
        )
        return drawing(canvas, "tracking-range", alt, caption, wide=True)


def error_map(simulation: Simulation) -> Drawing:
    """Largest and mean absolute errors over the frequency, by reading."""
    trials = made(simulation)
    with style():
        canvas = new_figure(WIDE, 360.0)
        left, right = canvas.subplots(1, 2, sharex=True)
        for plot, name, title in ((left, "max_error", "largest"), (right, "mean_absolute_error", "mean absolute")):
            for reading in READINGS:
                own = [trial for trial in trials if trial.setting["reading"] == reading]
                plot.plot(
                    [float(trial.setting["frequency"]) for trial in own],
                    [trial.figures[name] for trial in own],
                    "o-" if reading == HALF else "s-",
                    color=_colour(reading),
                    label=WORDS.get(reading, "read as the whole of it"),
                )
            plot.set_xscale("log")
            plot.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
            plot.set_xlabel("frequency (Hz)")
            plot.set_ylabel(f"{title} error (N)")
        left.plot(4.0, 2.44, "D", color=PUBLISHED, ms=8, mfc="none", mew=1.6, label="paper’s model, 50 N at 4 Hz")
        left.plot(4.0, 6.44, "D", color=PUBLISHED, ms=8, label="paper’s measurement, 50 N at 4 Hz")
        right.plot(4.0, 3.03, "D", color=PUBLISHED, ms=8)
        right.axhspan(0.44, 3.61, color=PUBLISHED, alpha=0.1, lw=0, label="range of the paper’s mean errors, measured")
        for plot in (left, right):
            plot.set_ylim(bottom=0.0)
        labels = dict(zip(*reversed([*left.get_legend_handles_labels()]), strict=True))
        handles, texts = right.get_legend_handles_labels()
        labels.update(dict(zip(texts[-1:], handles[-1:], strict=True)))
        canvas.legend(labels.values(), labels.keys(), loc="outside upper left", ncols=3)
        alt = "Errors over frequency by both readings: " + "; ".join(
            f"{trial.setting['amplitude']:g} N at {trial.setting['frequency']:g} Hz, {trial.setting['reading']}: "
            f"largest {plain(trial.figures['max_error'], 2)} N, mean {_error(trial)}"
            for trial in trials
        )
        caption = (
            "Errors of the sinusoid over the frequency. The paper’s marks and its range of mean absolute errors are "
            "measurements but for its model’s largest error; which reading they have is not told."
        )
        return drawing(canvas, "tracking-errors", alt, caption, wide=True)


def traces(simulation: Simulation, name: str) -> Drawing | None:
    """Reference, force, error, pressures and speed over two periods of the pair that `energy_of` names."""
    trial = next((each for each in made(simulation) if each.trace is not None and _name(each) == name), None)
    if trial is None or trial.trace is None:
        return None
    period = 1 / float(trial.setting["frequency"])
    time = trial.trace.time
    few = slice(int(np.searchsorted(time, time[-1] - min(2 * period, time[-1]))), None)
    t, s = time[few], {key: signal[few] for key, signal in trial.trace.signals.items()}
    with style():
        canvas = new_figure(WIDE, 640.0)
        force, error, pressure, speed = canvas.subplots(4, 1, sharex=True, height_ratios=(5, 3, 4, 4))
        force.plot(t, s["reference"], color=INK, lw=1.0, ls=(0, (4, 2)), label="reference")
        force.plot(t, s["force"], color=CHOSEN, lw=1.4, label="force")
        force.set_ylabel("force (N)")
        error.axhline(0.0, color=MUTED, lw=0.8)
        error.plot(t, s["error"], color=BAD, lw=1.3, label="error")
        error.set_ylabel("error (N)")
        worst = int(np.argmax(np.abs(s["error"])))
        error.plot(t[worst], s["error"][worst], "o", color=BAD, ms=8, mfc="none", mew=1.6)
        for key, colour, label in (
            ("input_pressure", PUBLISHED, "input chamber"),
            ("line_pressure", START, "block"),
            ("output_pressure", GOOD, "output chamber"),
        ):
            pressure.plot(t, s[key] / 1e5, color=colour, lw=1.3, label=label)
        pressure.set_ylabel("pressure (bar)")
        speed.axhline(0.0, color=MUTED, lw=0.8)
        speed.plot(t, s["velocity"], color=OTHER, lw=1.3, label="output piston’s speed")
        speed.set_ylabel("speed (m/s)")
        speed.set_xlabel("time (s)")
        frequency = float(trial.setting["frequency"])
        ramp, half = _ramp(trial), 2 * frequency
        turns = [ramp + n / half for n in range(math.ceil(half * (t[0] - ramp)), int(half * (t[-1] - ramp)) + 1)]
        for plot in (force, error, pressure, speed):
            plot.margins(x=0.01)
            for at in turns:
                plot.axvline(at, color=MUTED, lw=0.8, ls=(0, (1, 2)))
        canvas.align_ylabels()
        canvas.legend(*_labels(force, error, pressure, speed), loc="outside upper left", ncols=7)
        shown = f"{trial.setting['amplitude']:g} N at {frequency:g} Hz"
        alt = f"Reference, force, error, pressures and speed over the last two periods of {shown}."
        caption = (
            f"The last two periods of {shown} ({WORDS.get(str(trial.setting['reading']), 'read as the whole of it')}), "
            "as in Fig. 7. Dotted: the extrema of the reference; the ring is the largest error of these periods."
        )
        return drawing(canvas, "tracking-traces", alt, caption, wide=True)


def _pairs(simulation: Simulation) -> list[Trial]:
    return [trial for trial in simulation.trials if trial.setting.get("run") == TRACKING]


def _name(trial: Trial) -> str:
    setting = trial.setting
    return f"{setting['amplitude']:g} N at {setting['frequency']:g} Hz, {setting['reading']}"


def _ramp(trial: Trial) -> float:
    return float(trial.setting["ramp"])


def _colour(reading: str) -> str:
    return READING_COLOURS.get(reading, OTHER)


def _error(trial: Trial) -> str:
    return "cannot be made" if trial.setting["reason"] else f"{plain(trial.figures['mean_absolute_error'], 2)} N"


def _mark(plot: Axes, trial: Trial) -> None:
    """A pair at its place, with its mean absolute error beside it."""
    half = trial.setting["reading"] == HALF
    at = float(trial.setting["frequency"]), swing(trial)
    colour = _colour(str(trial.setting["reading"]))
    if trial.setting["reason"]:
        plot.plot(*at, "x", color=BAD, ms=9, mew=2.0)
        return
    plot.plot(*at, "o" if half else "s", color=colour, ms=7)
    plot.annotate(
        _error(trial),
        at,
        xytext=(-7 if half else 8, -12),
        textcoords="offset points",
        ha="right" if half else "left",
        color=colour,
        fontsize=11.0,
    )


def _level(plot: Axes, f: Floats, force: float, colour: str, label: str, *, dashed: bool = False) -> None:
    if force > 0:
        plot.plot(f[[0, -1]], [force, force], color=colour, lw=1.5, ls=(0, (4, 3)) if dashed else "-", label=label)


def _force_at_end(actuator: HydrostaticActuator) -> float:
    stroke = actuator.output_cylinder.stroke
    return actuator.return_element.force(stroke) + (actuator.series_stiffness or 0.0) * stroke


def load_limits(actuator: HydrostaticActuator, offset: float, frequencies: Floats, top: float) -> Floats:
    """Amplitudes (N), (3, f), at which pressure, torque and power are all there is, seals' friction included.

    offset : the least force (N). frequencies : (f,) Hz. top : the largest amplitude looked at (N). Not a number where
    there is no such amplitude.
    """
    amplitudes = np.geomspace(top / 300, top, AMPLITUDES)
    found = np.full((3, len(frequencies)), np.nan)
    for i, frequency in enumerate(frequencies.tolist()):
        asked = [demand(actuator, float(amplitude), frequency, offset) for amplitude in amplitudes]
        pressed = np.array([each.pressure for each in asked])
        if pressed[0] < 1 < pressed[-1]:
            found[0, i] = np.interp(1.0, pressed, amplitudes)  # next to straight: an offset, and the amplitude's share
        for j, name in enumerate(("torque", "power"), 1):
            share = np.log([max(getattr(each, name), 1e-12) for each in asked])
            if share[0] < 0 < share[-1] and np.all(np.diff(share) > 0):
                found[j, i] = math.exp(np.interp(0.0, share, np.log(amplitudes)))
    return found


def _labels(*plots: Axes) -> tuple[list[Artist], list[str]]:
    handles: list[Artist] = []
    texts: list[str] = []
    for plot in plots:
        own = plot.get_legend_handles_labels()
        handles += own[0]
        texts += own[1]
    return handles, texts
