"""One force-frequency pair of the tracking benchmark: simulated, and what came out of it."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.hydrostatic_drive import DriveRun, simulate
from fluxbore.design.dynamics.hydrostatic_ports import EnergyAudit, energy_audit
from fluxbore.design.dynamics.simulation import Trace
from fluxbore.design.dynamics.tracking_stand import Pair, TrackingStand, reference_of
from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic import HydrostaticActuator

Floats = NDArray[np.float64]

SAMPLES = 4000
"""Of a trace at most."""

NEAR = math.radians(5.0)
"""Of an extremum of the reference, on either side: what still counts to it."""


@dataclass(frozen=True, slots=True)
class PairFigures:
    """Errors of the sinusoid, without the ramp (N); over the whole run the pressures (Pa gauge).

    phase : of the largest error, after the last extremum of the reference (rad), 0 to pi. extremum_error : the largest
    within `NEAR` of an extremum (N). peak_pressure : in any volume. energy_imbalance : over the energy that entered.
    loss : mean power lost in seals, screw and fluid (W); copper_loss : in the winding (W).
    """

    max_error: float
    mean_absolute_error: float
    phase: float
    extremum_error: float
    peak_pressure: float
    least_pressure: float
    largest_speed: float
    energy_imbalance: float
    loss: float
    copper_loss: float


@dataclass(frozen=True, slots=True, eq=False)
class PairRun:
    """figures : None where the pair cannot be made; reason : why. energy : by component what entered, left, was stored
    and was lost (J). trace : None where it was not asked for."""

    pair: Pair
    figures: PairFigures | None
    reason: str = ""
    energy: dict[str, dict[str, float]] | None = None
    trace: Trace | None = None


def run_pair(actuator: HydrostaticActuator, stand: TrackingStand, pair: Pair, *, traces: bool) -> PairRun:
    """The pair's run; its reason in its place where stroke, vapour pressure or reference forbid it."""
    try:
        signal = reference_of(actuator, stand, pair)
        run = simulate(actuator, signal, stand.ramp + stand.sinusoid(pair), step=stand.step)
    except DesignError as error:
        return PairRun(pair, None, str(error))
    audit = energy_audit(run)
    figures = _figures(run, audit)
    energy = {part.name: {**_flows(asdict(part))} for part in audit.components}
    return PairRun(pair, figures, "", energy, _trace(run) if traces else None)


def _figures(run: DriveRun, audit: EnergyAudit) -> PairFigures:
    ramp, frequency = run.signal.ramp, run.signal.frequency
    sine = run.time >= ramp - run.step / 2
    error = np.abs(run.reference - run.force)[sine]
    turn = math.tau * frequency * (run.time[sine] - ramp)
    after = np.mod(turn, math.pi)
    near = np.minimum(after, math.pi - after) <= NEAR
    total = float(run.time[-1])
    return PairFigures(
        max_error=float(np.max(error)),
        mean_absolute_error=float(np.mean(error)),
        phase=float(after[np.argmax(error)]),
        extremum_error=float(np.max(error[near])),
        peak_pressure=float(np.max(run.pressure)),
        least_pressure=float(np.min(run.pressure)),
        largest_speed=float(np.max(np.abs(run.velocity[sine, 1]))),
        energy_imbalance=audit.imbalance,
        loss=sum(part.lost for part in audit.components) / total,
        copper_loss=audit.copper / total,
    )


def _flows(part: dict[str, Any]) -> dict[str, float]:
    return {name: float(part[name]) for name in ("entered", "left", "stored", "lost")}


def _trace(run: DriveRun) -> Trace:
    """At the control samples, thinned out to `SAMPLES`."""
    steps = max(1, round(run.network.actuator.drive.force_period / run.step))
    every = steps * max(1, math.ceil(len(run.time) / steps / SAMPLES))
    at = slice(every, None, every)
    of_step = slice(every - 1, None, every)
    ratio = run.network.actuator.ball_screw.ratio
    return Trace(
        run.time[at],
        {
            "reference": run.reference[at],
            "force": run.force[at],
            "error": (run.reference - run.force)[at],
            "velocity": run.velocity[at, 1],
            "position": run.way[at, 1],
            "input_pressure": run.pressure[of_step, 0],
            "line_pressure": run.pressure[of_step, 1],
            "output_pressure": run.pressure[of_step, 2],
            "motor_torque": run.motor_force[of_step] * ratio,
        },
    )
