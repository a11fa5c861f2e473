"""How well the electro-hydrostatic actuator follows sinusoidal forces: the paper's pairs, both readings, sensitivities.

Error: reference less output force, over the cosine alone; "mean absolute" is the arithmetic mean of its size (Sec. IV
of the paper on the PREHydrA). The place of the largest error is told in degrees after the reference's last extremum, of
0 to 180: the paper has it at the extrema, where the pistons turn.

Of the pairs the paper publishes 300 N at 0.5 Hz, 50 N at 4 Hz and 20 N at 10 Hz, and says that others ran from 0.1 to
10 Hz with 300 to 20 N; those between are assumed, along the line F f of equation (4) where they can be.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.force_reference import HALF, RAMP, READINGS, force_reference
from fluxbore.design.dynamics.hydrostatic_drive import DriveRun, simulate
from fluxbore.design.dynamics.hydrostatic_ports import energy_audit, fluid_loss
from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic import HydrostaticActuator

Floats = NDArray[np.float64]

LEAST_FORCE = 45.0
"""N, the offset of the paper's references (Sec. IV)."""

LEAST_TIME = 2.0
"""s of cosine, rounded up to whole periods."""


@dataclass(frozen=True, slots=True)
class Pair:
    """amplitude (N) as published, frequency (Hz); assumed where the paper does not publish it."""

    amplitude: float
    frequency: float
    assumed: bool = False


PAIRS = (
    Pair(300.0, 0.1, assumed=True),
    Pair(300.0, 0.5),
    Pair(100.0, 2.0, assumed=True),
    Pair(50.0, 4.0),
    Pair(30.0, 6.0, assumed=True),
    Pair(20.0, 10.0),
)


@dataclass(frozen=True, slots=True)
class Tracking:
    """One pair by one reading, SI units; phase in degrees.

    failure : why it cannot be run; the figures are None then. max_error, mean_absolute_error (N), phase : of the
    largest error. peak_pressure, least_pressure (Pa gauge), peak_torque (N m), fluid_loss : what warms the fluid (W).
    energy_imbalance : of what enters.
    """

    pair: Pair
    reading: str
    max_error: float | None = None
    mean_absolute_error: float | None = None
    phase: float | None = None
    peak_pressure: float | None = None
    least_pressure: float | None = None
    peak_torque: float | None = None
    fluid_loss: float | None = None
    energy_imbalance: float | None = None
    failure: str = ""


def tracking_run(
    actuator: HydrostaticActuator,
    pair: Pair,
    reading: str,
    *,
    least_force: float = LEAST_FORCE,
    time: float = LEAST_TIME,
    step: float | None = None,
) -> DriveRun:
    """The simulation of a pair, with whole periods of cosine over `time` (s) or more. Raises DesignError."""
    start = actuator.return_element.force(0.0)
    signal = force_reference(pair.amplitude, pair.frequency, reading, start, least_force)
    periods = max(math.ceil(time * pair.frequency - 1e-9), 1)
    return simulate(actuator, signal, RAMP + periods / pair.frequency, step=step)


def tracking_figures(run: DriveRun, pair: Pair, reading: str) -> Tracking:
    """What a run is judged by."""
    ramp, ratio = run.signal.ramp, run.network.actuator.ball_screw.ratio
    cosine = run.time >= ramp
    error = np.abs(run.reference - run.force)[cosine]
    angle = 360.0 * pair.frequency * (run.time[cosine] - ramp)
    audit = energy_audit(run)
    return Tracking(
        pair,
        reading,
        float(np.max(error)),
        float(np.mean(error)),
        float(angle[np.argmax(error)] % 180.0),
        float(np.max(run.pressure)),
        float(np.min(run.pressure)),
        float(np.max(np.abs(run.motor_force))) * ratio,
        fluid_loss(audit, float(run.time[-1])),
        audit.imbalance,
    )


def track(
    actuator: HydrostaticActuator,
    pair: Pair,
    reading: str,
    *,
    least_force: float = LEAST_FORCE,
    time: float = LEAST_TIME,
    step: float | None = None,
) -> Tracking:
    """A pair by a reading; what cannot be run is a row with its reason."""
    try:
        run = tracking_run(actuator, pair, reading, least_force=least_force, time=time, step=step)
    except DesignError as error:
        return Tracking(pair, reading, failure=str(error))
    return tracking_figures(run, pair, reading)


def track_all(
    actuator: HydrostaticActuator, pairs: Sequence[Pair] = PAIRS, readings: Sequence[str] = READINGS
) -> tuple[Tracking, ...]:
    """Every pair by every reading."""
    return tuple(track(actuator, pair, reading) for pair in pairs for reading in readings)


@dataclass(frozen=True, slots=True)
class Variation:
    """A number of the actuator by its path, and the two values in its place (SI)."""

    path: str
    low: float
    high: float


def prehydra_variations(actuator: HydrostaticActuator) -> tuple[Variation, ...]:
    """Of what the paper does not publish: over the range in which it may well lie, or a third to either side."""
    drive, fluid, hose = actuator.drive, actuator.fluid, actuator.hose

    def around(path: str, value: float, share: float = 1 / 3) -> Variation:
        return Variation(path, value * (1 - share), value * (1 + share))

    return (
        Variation("drive.delay", 0.5e-3, 1e-3),
        Variation("drive.bandwidth", drive.bandwidth / 2, drive.bandwidth * 2),
        Variation("drive.integral_time", drive.integral_time / 2, drive.integral_time * 2),
        Variation("drive.force_period", 0.5e-3, 2e-3),
        Variation("fluid.air_fraction", 0.0, 0.01),
        Variation("fluid.bulk_modulus", 2.2e9, 3.2e9),
        around("fluid.viscosity", fluid.viscosity),
        Variation("hose.wall_modulus", 0.3e9, 1e9),
        around("hose.bore", hose.bore, 0.2),
        Variation("orifices", 3.5e-3, 5.5e-3),
        around("output_cylinder.moving_mass", actuator.output_cylinder.moving_mass),
        around("motor.inertia", actuator.motor.inertia),
        Variation("ball_screw.efficiency", 0.8, 1.0),
        Variation("dead_volumes", 2e-6, 8e-6),
        Variation("friction", 0.9, 1.1),
        Variation("linear_speed", 1e-5, 1e-3),
    )


def varied(actuator: HydrostaticActuator, path: str, value: float) -> HydrostaticActuator:
    """The actuator with another value at a path: "component.field", or "orifices" (diameter of all), "dead_volumes" (of
    both cylinders), "friction" (a factor on both seals' forces), "linear_speed" (of both seals)."""
    if path == "orifices":
        changed = {name: replace(getattr(actuator, name), diameter=value) for name in ("port", "fitting")}
        block = replace(actuator.block, orifice=replace(actuator.block.orifice, diameter=value))
        return replace(actuator, block=block, **changed)
    if path in ("dead_volumes", "friction", "linear_speed"):
        cylinders: dict[str, Any] = {}
        for name in ("input_cylinder", "output_cylinder"):
            cylinder = getattr(actuator, name)
            law = cylinder.friction
            if path == "dead_volumes":
                cylinders[name] = replace(cylinder, dead_volume=value)
            elif path == "linear_speed":
                cylinders[name] = replace(cylinder, friction=replace(law, linear_speed=value))
            else:
                parts = ("preload", "pressure_coefficient", "stribeck_force", "viscous_coefficient")
                scaled = replace(law, **{part: value * getattr(law, part) for part in parts})
                cylinders[name] = replace(cylinder, friction=scaled)
        return replace(actuator, **cylinders)
    component, field = path.split(".")
    return replace(actuator, **{component: replace(getattr(actuator, component), **{field: value})})


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """What a variation makes of a pair's figures at its low and its high value."""

    variation: Variation
    low: Tracking
    high: Tracking


def sensitivities(
    actuator: HydrostaticActuator,
    variations: Iterable[Variation],
    pair: Pair = PAIRS[3],
    reading: str = HALF,
    *,
    time: float = 1.0,
    step: float | None = None,
) -> tuple[Sensitivity, ...]:
    """One variation at a time; a run of a few seconds each."""
    found = []
    for each in variations:
        low, high = (
            track(varied(actuator, each.path, value), pair, reading, time=time, step=step)
            for value in (each.low, each.high)
        )
        found.append(Sensitivity(each, low, high))
    return tuple(found)
