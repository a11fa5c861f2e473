"""Pictures of an electro-hydrostatic actuator: range, power, the operating point in time, return element."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.reports.hydrostatic_content import HydraulicsContent, OperatingPoint, RangeMap, Tracked
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
from fluxbore.reports.wording import capital, listing, significant

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDE, HALF = 1000.0, 490.0

COLOURS: Mapping[str, str] = {"speed": CHOSEN, "stroke": GOOD, "pressure": BAD, "torque": PUBLISHED, "power": OTHER}

SAMPLES = 121
"""Along the stroke, and along the frequency."""


def range_map(limits: RangeMap, point: OperatingPoint, fits: bool) -> Drawing:
    """Amplitude over frequency: every limit, what all of them leave, and the operating point."""
    least, largest = limits.amplitudes
    f = np.geomspace(limits.frequencies[0], limits.frequencies[-1], SAMPLES)
    known = np.log(limits.frequencies)
    rows = {name: np.exp(np.interp(np.log(f), known, np.log(values))) for name, values in limits.limits.items()}
    free = np.clip(np.min(list(rows.values()), axis=0), least, largest)
    binding = [name for name, row in rows.items() if np.any(row <= free * (1 + 1e-9))]
    with style():
        canvas = new_figure(WIDE, 460.0)
        plot = canvas.subplots()
        plot.fill_between(f, least, free, color=GOOD, alpha=0.12, lw=0, label="within all limits")
        for name, values in rows.items():
            if np.any((least < values) & (values < largest)):
                plot.plot(f, values, color=COLOURS[name], label=name, lw=2.2 if name in binding else 1.3)
        tone = INK if fits else BAD
        plot.plot([point.frequency], [point.amplitude], "*", color=tone, ms=13, ls="none", label="operating point")
        plot.set_xscale("log")
        plot.set_yscale("log")
        plot.set_xlim(f[0], f[-1])
        plot.set_ylim(least, largest)
        _plain(plot)
        plot.set_xlabel("frequency (Hz)")
        plot.set_ylabel("amplitude of the force (N)")
        canvas.legend(*plot.get_legend_handles_labels(), loc="outside upper left", ncols=7)
        alt = f"Largest amplitude of a sinusoidal force over its frequency, limited by {listing(binding)}."
        caption = (
            "Which sinusoidal forces can be made: half the distance between the peaks, upwards of a least force of "
            f"{significant(point.least)}\u00a0N, over the frequency. Each line is one limit by itself; what lies under "
            f"all of them can be kept up. {capital(listing(binding))} set the bound here."
        )
        return drawing(canvas, "hydraulic-range", alt, caption, wide=True)


def _plain(plot: Axes) -> None:
    """Numbers in place of powers of ten."""
    from matplotlib.ticker import FuncFormatter, NullFormatter

    for axis in (plot.xaxis, plot.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())


def power_band(tracked: Tracked) -> Drawing:
    """What goes to the load and what comes back, port by port: a band that the losses make narrower."""
    names = [row.name for row in tracked.ports]
    sent, returned = np.array([(row.sent, row.returned) for row in tracked.ports]).T
    x = np.arange(len(names))
    with style():
        canvas = new_figure(WIDE, 400.0)
        plot = canvas.subplots()
        plot.bar(x, sent, 0.62, color=CHOSEN, label="sent to the load")
        plot.bar(x, -returned, 0.62, color=START, label="returned by the spring and the rotor")
        plot.plot(x, sent - returned, "o-", color=BAD, ms=5, label="difference: lost behind the port")
        plot.axhline(0, color=MUTED, lw=0.8)
        plot.set_xticks(x, [name.replace(", ", ",\n").replace(" ", "\n", 1) for name in names], fontsize=10)
        plot.set_xlim(-0.6, len(names) - 0.4)
        plot.grid(axis="x", visible=False)
        plot.set_ylabel("mean power (W)")
        canvas.legend(*plot.get_legend_handles_labels(), loc="outside upper left", ncols=3)
        alt = f"Mean power at {len(names)} ports, from {sent[0]:.3g} W at the motor to {sent[-1]:.3g} W at the spring."
        caption = (
            "Power at every port of the chain, a mean over whole periods of the operating point: what flows towards "
            "the load while it does, and what flows back. Between motor shaft and screw stands the rotor’s inertia, "
            "which takes and gives back; every other step down is friction or flow."
        )
        return drawing(canvas, "hydraulic-power", alt, caption, wide=True)


def traces(tracked: Tracked) -> Drawing:
    """Force, error and pressures over the last periods."""
    time = tracked.time
    scale, unit = (1e3, "ms") if time[-1] < 2 else (1.0, "s")
    error = tracked.reference - tracked.force
    with style():
        canvas = new_figure(WIDE, 520.0)
        force, miss, pressure = canvas.subplots(3, 1, sharex=True, height_ratios=(3, 2, 3))
        force.plot(time * scale, tracked.reference, color=START, ls=(0, (5, 3)), label="reference")
        force.plot(time * scale, tracked.force, color=CHOSEN, label="output")
        force.set_ylabel("force (N)")
        _headed(force, 2)
        miss.plot(time * scale, error, color=BAD)
        miss.axhline(0, color=MUTED, lw=0.8)
        miss.set_ylabel("error (N)")
        middles = (time[1:] + time[:-1]) / 2 * scale
        for values, name, colour in zip(
            tracked.pressures.T, ("input cylinder", "block", "output cylinder"), (PUBLISHED, MUTED, CHOSEN), strict=True
        ):
            pressure.plot(middles, values / 1e5, color=colour, lw=1.4, label=name)
        pressure.set_ylabel("pressure (bar)")
        pressure.set_xlabel(f"time ({unit})")
        pressure.set_xlim(0, time[-1] * scale)
        _headed(pressure, 3)
        canvas.align_ylabels()
        alt = f"Reference and output force, their difference up to {np.max(np.abs(error)):.3g} N, and three pressures."
        caption = (
            "The operating point in simulated time, its last whole periods: reference and output force, reference less "
            "output, and pressures above the atmosphere’s."
        )
        return drawing(canvas, "hydraulic-traces", alt, caption, wide=True)


def _headed(plot: Axes, columns: int) -> None:
    """A legend above the curves."""
    low, high = plot.get_ylim()
    plot.set_ylim(low, high + 0.22 * (high - low))
    plot.legend(loc="upper right", ncols=columns)


def return_curve(content: HydraulicsContent) -> Drawing:
    """Force of the return element over the stroke, with what the operating point uses of it."""
    actuator, point = content.actuator, content.point
    stroke = actuator.output_cylinder.stroke
    x = np.linspace(0.0, stroke, SAMPLES)
    force = np.array([held(actuator, place) for place in x.tolist()])
    with style():
        canvas = new_figure(HALF, 340.0)
        plot = canvas.subplots()
        plot.plot(x * 1e3, force, color=CHOSEN, label="return element")
        most = float(force.max())
        caption = "What the output piston works against over its stroke, the load held"
        if content.range is not None:
            plot.axhspan(point.least, point.top, color=PUBLISHED, alpha=0.15, lw=0, label="operating point")
            most = max(most, point.top)
            caption += "; the band is the operating point’s"
        plot.set_xlim(0, stroke * 1e3)
        plot.set_ylim(0, 1.1 * most)
        plot.set_xlabel("way of the output piston (mm)")
        plot.set_ylabel("force (N)")
        plot.legend(loc="lower right")
        alt = f"Force of the return element from {force[0]:.4g} N to {force[-1]:.4g} N over {stroke * 1e3:.4g} mm."
        return drawing(canvas, "hydraulic-return", alt, f"{caption}.")


def held(actuator: HydrostaticActuator, extension: float) -> float:
    """Of return element and series spring (N) at an extension (m), the load held."""
    return actuator.return_element.force(extension) + (actuator.series_stiffness or 0.0) * extension
