"""What a step of the reference force is judged by."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.force_control import ForceController, force_loop
from fluxbore.design.dynamics.force_step import ForceStep
from fluxbore.design.dynamics.linearised import UNFILTERED, force_characteristic
from fluxbore.design.dynamics.series_elastic import Environment, SeriesElastic
from fluxbore.design.poles import poles

POLE_UNIT = 100.0
"""rad/s, near the middle of the loop's poles."""


@dataclass(frozen=True, slots=True)
class StepFigures:
    """t63, t98 : when the force has come to 1 - 1/e and to 98 % of its end value (s). error : its end less the
    reference (N). overshoot : of the end value, as a share of it."""

    t63: float
    t98: float
    error: float
    overshoot: float


def step_figures(run: ForceStep) -> StepFigures:
    """Of a run that has come to its end value (N), which must not be zero."""
    end = float(run.force[-1])
    overshoot = max(0.0, float(np.max(run.force / end)) - 1)
    return StepFigures(_reached(run, 1 - math.exp(-1)), _reached(run, 0.98), end - run.reference, overshoot)


def dominant_pole(
    plant: SeriesElastic,
    environment: Environment,
    controller: ForceController,
    force: float = 0.0,
    observer_speed: str = UNFILTERED,
) -> complex:
    """The pole (1/s) with the largest real part, linearised at a spring force (N)."""
    loop = force_loop(plant, environment, controller, force)
    return complex(poles(force_characteristic(loop, observer_speed), POLE_UNIT)[0])


def _reached(run: ForceStep, share: float) -> float:
    """The first time (s) at a share of the end value, between two samples on their line."""
    progress: NDArray[np.float64] = run.force / run.force[-1]
    after = int(np.argmax(progress >= share))
    if after == 0:
        return float(run.time[0])
    low, high = progress[after - 1], progress[after]
    return float(run.time[after - 1] + (share - low) / (high - low) * (run.time[after] - run.time[after - 1]))
