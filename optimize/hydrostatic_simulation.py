"""The operating point of an electro-hydrostatic actuator simulated in time, and what is read from the run.

The reference is the paper's: a skewed sine step over 2 s, then the cosine; errors are those of the cosine's part, in
which the slow force loop still settles, as they are in the benchmark of the tracking.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from fluxbore.design.dynamics.hydrostatic_drive import DriveRun
from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.units import format_quantity

LONGEST_STEP = 250e-6
"""s; half of it changes the errors of the published pairs by less than 1 % from 0.5 Hz on. At 0.1 Hz the pistons stick
and slip, and the largest error is known to a tenth at any step."""

LEAST_TIME = 1.0
"""s of the cosine; its whole periods that last no less are simulated."""

MOST_STEPS = 100_000
"""Of a run: some ten seconds of a computer's time, periods of 23 s at the usual step."""


@dataclass(frozen=True, slots=True)
class TrackingFigures:
    """SI units. error, mean_error : of the cosine's part (N). peak_output, peak_input, peak_hose, least : gauge
    pressures of the whole run. imbalance : of energy over what entered. loss : mean power that warms fluid and seals
    over the cosine's part. time : simulated (s)."""

    error: float
    mean_error: float
    peak_output: float
    peak_input: float
    peak_hose: float
    least: float
    imbalance: float
    loss: float
    time: float
    step: float


def track(actuator: HydrostaticActuator, amplitude: float, frequency: float, least_force: float) -> TrackingFigures:
    """Of an amplitude (N, half the distance between peaks), a frequency (Hz) and the least force (N).

    Raises DesignError for a run of more than `MOST_STEPS` steps, a force that the return element does not reach within
    the stroke, a stroke that is exceeded and cavitation.
    """
    import numpy as np

    from fluxbore.design.dynamics.force_reference import ForceReference
    from fluxbore.design.dynamics.hydrostatic_drive import simulate
    from fluxbore.design.dynamics.hydrostatic_ports import energy_audit, fluid_loss

    rest = actuator.return_element.force(0.0)
    signal = ForceReference(rest, least_force, amplitude, frequency)
    period = actuator.drive.force_period
    step = period / max(math.ceil(period / LONGEST_STEP - 1e-9), 1)
    turning = max(math.ceil(LEAST_TIME * frequency - 1e-9), 1) / frequency
    if not signal.ramp + turning <= MOST_STEPS * step:
        raise DesignError(
            f"The operating point must be simulated in {MOST_STEPS:g} steps or fewer; operating_point.frequency "
            f"{format_quantity(frequency, 'frequency', 4)} and actuator.drive.force_period "
            f"{format_quantity(period, 'time', 4)} ask for {(signal.ramp + turning) / step:.4g}."
        )
    run = simulate(actuator, signal, signal.ramp + turning, step=step)
    begun = round(signal.ramp / run.step)
    error = np.abs(run.reference - run.force)[begun:]
    turned = since(run, begun)
    audit = energy_audit(run)
    return TrackingFigures(
        float(np.max(error)),
        float(np.mean(error)),
        float(np.max(run.pressure[:, 2])),
        float(np.max(run.pressure[:, 0])),
        float(np.max(run.pressure[:, 1])),
        float(np.min(run.pressure)),
        float(audit.imbalance),
        float(fluid_loss(energy_audit(turned), run.step * (len(turned.time) - 1))),
        float(run.time[-1]),
        run.step,
    )


def since(run: DriveRun, begun: int) -> DriveRun:
    """The run from one of its steps on, as if it had begun there."""
    rows = ("time", "velocity", "way", "content", "pressure", "flow", "friction", "motor_force", "reference", "force")
    return replace(run, **{name: getattr(run, name)[begun:] for name in rows})
