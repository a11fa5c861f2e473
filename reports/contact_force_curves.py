"""The pictures of the contact-force benchmark: those of Nakata and Noda (2023), and designs beside one another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from fluxbore.design.dynamics.contact_force import COUNTED, TARGETS
from fluxbore.design.dynamics.simulation import Simulation, Trace, Trial
from fluxbore.optimize.benchmark import DesignRun
from fluxbore.reports.svg import CHOSEN, INK, MUTED, OTHER, PUBLISHED, START, Drawing, drawing, new_figure, style
from fluxbore.reports.wording import listing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CONDITIONS = ("P-N", "P-P", "P-E")
COLOURS = {"P-N": START, "P-P": OTHER, "P-E": CHOSEN}
MARKS = {"P-N": "s", "P-P": "^", "P-E": "o"}

WIDE = 1000.0

SLOW, FAST = START, PUBLISHED
"""Colours of the slowest and the fastest disturbance."""

LEVELS = ((1e-3, "p < .001"), (1e-2, "p < .01"), (0.05, "p < .05"))

TRACED = (40.0, 1.0)
"""Target force (N) and frequency (Hz) of the trial that is drawn over time, the nearest there is."""

Medians = Mapping[str, float]


def loops(simulation: Simulation) -> Drawing | None:
    """Contact force over relative position, slowest and fastest disturbance; None without traces."""
    frequencies = sorted({float(trial.setting["frequency"]) for trial in simulation.trials if trial.trace is not None})
    if not frequencies:
        return None
    shown = [(frequencies[0], SLOW), (frequencies[-1], FAST)][: len(frequencies)]
    with style():
        canvas = new_figure(WIDE, 460.0)
        plots = canvas.subplots(1, len(CONDITIONS), sharey=True)
        for plot, condition in zip(plots, CONDITIONS, strict=True):
            for target in TARGETS:
                plot.axhline(target, color=INK, lw=0.8, ls=(0, (4, 3)))
                for frequency, colour in shown[::-1]:
                    trial = _trial(simulation, condition, target, frequency)
                    if trial is None or trial.trace is None or not _counted(trial):
                        continue
                    part = _last_trips(trial.trace, frequency, 1)
                    position, force = trial.trace.signals["position"][part], trial.trace.signals["force"][part]
                    plot.plot(position * 1e3, force, color=colour, lw=1.1)
            plot.set_title(condition, loc="left")
            plot.set_xlabel("relative position (mm)")
        plots[0].set_ylabel("contact force (N)")
        for frequency, colour in shown:
            plots[0].plot([], [], color=colour, label=f"{frequency:g} Hz")
        plots[0].plot([], [], color=INK, lw=0.8, ls=(0, (4, 3)), label="target")
        canvas.legend(*plots[0].get_legend_handles_labels(), loc="outside upper left", ncols=3)
        alt = (
            "Hysteresis loops of the contact force over the relative position under P-N, P-P and P-E, "
            f"at targets of {listing(f'{target:g}' for target in TARGETS)} N and "
            f"{listing(f'{frequency:g} Hz' for frequency, _ in shown)}."
        )
        caption = (
            "Force of the load cell over the relative position in the last round trip of the slowest and of the "
            f"fastest disturbance, as in Fig. 16; seed {simulation.seed}. P-P at 0 N is left out, as there."
        )
        return drawing(canvas, "contact-force-loops", alt, caption, wide=True)


def errors_over_speed(simulation: Simulation, published: Medians) -> Drawing:
    """RMSE of each trial over its mean speed, a panel for each target."""
    with style():
        canvas = new_figure(WIDE, 340.0)
        plots = canvas.subplots(1, len(TARGETS), sharey=True)
        for plot, target in zip(plots, TARGETS, strict=True):
            for condition in CONDITIONS:
                trials = [t for t in _of(simulation, condition) if t.setting["target"] == target and _counted(t)]
                points = sorted((t.figures["mean_speed"] * 1e3, t.figures["rmse"]) for t in trials)
                if points:
                    x, y = zip(*points, strict=True)
                    plot.plot(x, y, MARKS[condition] + "-", color=COLOURS[condition], ms=5, lw=1.2, label=condition)
                if target in COUNTED and condition in published:
                    plot.axhline(published[condition], color=COLOURS[condition], lw=1.2, ls=(0, (2, 2)))
            plot.set_title(f"{target:g} N", loc="left")
            plot.set_xlabel("mean speed (mm/s)")
        plots[0].set_ylim(bottom=0.0)
        plots[0].set_ylabel("RMSE of the force (N)")
        _condition_legend(canvas, "published median of 20, 40 and 60 N" if published else "")
        alt = "Root mean square error of the contact force over the mean speed, a panel for each target force."
        caption = (
            f"Error of each trial over the mean speed of its disturbance, as in Fig. 17(a); seed {simulation.seed}. "
            "The paper's own points are in a picture only, so that its medians stand for them."
        )
        return drawing(canvas, "contact-force-speed", alt, caption, wide=True)


def boxes(simulation: Simulation, published: Medians) -> Drawing:
    """The cells of each condition as a box plot, medians and the significance of their differences."""
    cells = {
        condition: [t.figures["rmse"] for t in _of(simulation, condition) if t.setting["target"] in COUNTED]
        for condition in CONDITIONS
    }
    with style():
        canvas = new_figure(500.0, 420.0)
        plot = canvas.subplots()
        for place, condition in enumerate(CONDITIONS):
            plot.boxplot(
                [cells[condition]],
                positions=[place],
                widths=0.5,
                boxprops={"color": COLOURS[condition], "lw": 1.6},
                whiskerprops={"color": COLOURS[condition]},
                capprops={"color": COLOURS[condition]},
                medianprops={"color": COLOURS[condition], "lw": 2.4},
                flierprops={"markeredgecolor": COLOURS[condition], "ms": 5},
            )
            middle = float(np.median(cells[condition]))
            plot.annotate(
                f"{middle:.2f}", (place + 0.25, middle), xytext=(5, 0), textcoords="offset points", va="center"
            )
            if condition in published:
                plot.plot([place - 0.42, place + 0.25], [published[condition]] * 2, color=INK, lw=1.4, ls=(0, (2, 2)))
        top = max(max(values) for values in cells.values())
        for level, pair in enumerate(simulation.figures["post_hoc"]):
            _bracket(plot, pair, top * (1.08 + 0.11 * level), top)
        plot.plot([], [], color=INK, lw=1.4, ls=(0, (2, 2)), label="published median")
        plot.legend(loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.2)
        plot.set_xticks(range(len(CONDITIONS)), CONDITIONS)
        plot.set_xlim(-0.6, len(CONDITIONS) - 0.2)
        plot.set_ylim(0.0, top * 1.46)
        plot.grid(visible=False, axis="x")
        plot.set_ylabel("RMSE of the force (N)")
        count = len(cells[CONDITIONS[0]])
        medians = "; ".join(f"{name} {float(np.median(values)):.2f} N" for name, values in cells.items())
        alt = f"Box plot of the {count} errors under each condition; medians {medians}."
        caption = (
            f"The {count} cells of each condition, targets of 20, 40 and 60 N, as in Fig. 17(b); seed "
            f"{simulation.seed}. Brackets: Wilcoxon's signed-rank test, p corrected after Bonferroni."
        )
        return drawing(canvas, "contact-force-boxes", alt, caption)


def over_time(simulation: Simulation) -> Drawing | None:
    """One trial under the three conditions over its last two round trips; None without traces."""
    chosen = {condition: _nearest(_of(simulation, condition)) for condition in CONDITIONS}
    traces = {name: trial.trace for name, trial in chosen.items() if trial is not None and trial.trace is not None}
    first = next((trial for trial in chosen.values() if trial is not None), None)
    if len(traces) < len(CONDITIONS) or first is None:
        return None
    target, frequency = float(first.setting["target"]), float(first.setting["frequency"])
    parts = {name: _last_trips(trace, frequency, 2) for name, trace in traces.items()}
    rows = (
        ("force", "force (N)", 1.0, CONDITIONS, 2.2),
        ("pressure", "pressure (kPa)", 1e-3, ("P-N", "P-P"), 1.3),
        ("current", "current (A)", 1.0, ("P-E",), 1.1),
        ("position", "position (mm)", 1e3, ("P-E",), 1.0),
    )
    with style():
        canvas = new_figure(WIDE, 620.0)
        plots = canvas.subplots(len(rows), 1, sharex=True, height_ratios=[row[-1] for row in rows])
        for plot, (signal, label, factor, names, _) in zip(plots, rows, strict=True):
            for name in names:
                trace, part = traces[name], parts[name]
                time = trace.time[part] - trace.time[part][0]
                colour = INK if signal == "position" else COLOURS[name]
                plot.plot(time, trace.signals[signal][part] * factor, color=colour, lw=1.2)
            plot.set_ylabel(label)
        plots[0].axhline(target, color=INK, lw=0.8, ls=(0, (4, 3)))
        plots[-1].set_xlabel("time (s)")
        canvas.align_ylabels(plots)
        _condition_legend(canvas, "")
        alt = f"Force, chamber pressure, current and position over time at {target:g} N and {frequency:g} Hz."
        caption = (
            f"The last two round trips at a target of {target:g} N and {frequency:g} Hz, seed {simulation.seed}: force "
            "of the load cell with its noise, gauge pressure in the chamber, current of the motor, relative position."
        )
        return drawing(canvas, "contact-force-trace", alt, caption, wide=True)


def designs(runs: Sequence[DesignRun]) -> Drawing:
    """The medians of every design under the three conditions, each seed as a small mark."""
    with style():
        canvas = new_figure(WIDE, 90.0 + 34.0 * max(len(runs), 3))
        plots = canvas.subplots(1, len(CONDITIONS), sharey=True)
        names = [_short(run.label) for run in runs]
        for plot, condition in zip(plots, CONDITIONS, strict=True):
            middles = [float(run.figures["median_rmse"][condition]) for run in runs]
            for place, (run, middle) in enumerate(zip(runs, middles, strict=True)):
                seeds = [float(item.figures["median_rmse"][condition]) for item in run.simulations]
                colour = COLOURS[condition]
                plot.plot(seeds, [place] * len(seeds), "|", color=colour, ms=12, mew=1.2, alpha=0.7)
                plot.plot(middle, place, MARKS[condition], color=colour, ms=8, mfc="none" if place == 0 else colour)
                plot.annotate(f"{middle:.3f}", (middle, place), xytext=(0, 8), textcoords="offset points", ha="center")
            plot.axvline(middles[0], color=MUTED, lw=0.9, ls=(0, (2, 2)))
            plot.set_title(condition, loc="left")
            plot.set_xlabel("median RMSE (N)")
            plot.margins(x=0.25)
            plot.locator_params(axis="x", nbins=5)
            spread = max(middles) - min(middles)
            if spread < 0.1:  # N: what is nearly equal shall not look far apart
                plot.set_xlim(middles[0] - 0.1, middles[0] + 0.1)
        plots[0].set_yticks(range(len(names)), names)
        plots[0].set_ylim(len(names) - 0.4, -0.8)
        alt = "Median error of each design: " + "; ".join(
            f"{run.label} " + ", ".join(f"{c} {float(run.figures['median_rmse'][c]):.3f} N" for c in CONDITIONS)
            for run in runs
        )
        caption = "Median error of each design on the same test stand, from the same seeds; a small stroke is one seed."
        return drawing(canvas, "contact-force-designs", alt + ".", caption, wide=True)


def _of(simulation: Simulation, condition: str) -> list[Trial]:
    return [trial for trial in simulation.trials if trial.setting["condition"] == condition]


def _counted(trial: Trial) -> bool:
    """Whether the paper has such a trial: its air could not pull."""
    return trial.setting["condition"] != "P-P" or trial.setting["target"] in COUNTED


def _trial(simulation: Simulation, condition: str, target: float, frequency: float) -> Trial | None:
    wanted = {"condition": condition, "target": target, "frequency": frequency}
    return next((trial for trial in simulation.trials if wanted.items() <= trial.setting.items()), None)


def _nearest(trials: Sequence[Trial]) -> Trial | None:
    """The trial nearest to `TRACED`."""
    target, frequency = TRACED
    return min(
        trials,
        key=lambda trial: (
            abs(float(trial.setting["target"]) - target),
            abs(float(trial.setting["frequency"]) - frequency),
        ),
        default=None,
    )


def _last_trips(trace: Trace, frequency: float, trips: int) -> slice:
    """The samples of the last round trips."""
    begin = trace.time[-1] - trips / frequency
    return slice(int(np.searchsorted(trace.time, begin)), None)


def _condition_legend(canvas: Figure, published: str) -> None:
    from matplotlib.lines import Line2D

    lines = [Line2D([], [], color=COLOURS[name], marker=MARKS[name], label=name, lw=1.6) for name in CONDITIONS]
    if published:
        lines.append(Line2D([], [], color=MUTED, lw=1.2, ls=(0, (2, 2)), label=published))
    canvas.legend(handles=lines, loc="outside upper left", ncols=len(lines))


def _bracket(plot: Axes, pair: Mapping[str, object], height: float, top: float) -> None:
    """Two conditions joined above the boxes, with how sure their difference is."""
    names, p = pair["pair"], pair["p_corrected"]
    assert isinstance(names, (list, tuple))
    first, second = (CONDITIONS.index(name) for name in names)
    foot = height - 0.02 * top
    plot.plot([first, first, second, second], [foot, height, height, foot], color=MUTED, lw=1.0)
    plot.annotate(
        significance(p if isinstance(p, float) else None),
        ((first + second) / 2, height),
        xytext=(0, 2),
        textcoords="offset points",
        ha="center",
        fontsize=10.0,
    )


def significance(p: float | None) -> str:
    """``p < .001`` as papers have it; ``not significant`` from .05."""
    if p is None:
        return "not tested"
    return next((text for limit, text in LEVELS if p < limit), f"not significant (p = {p:.2g})")


def _short(label: str, most: int = 26) -> str:
    return label if len(label) <= most else f"…{label[1 - most :]}"
