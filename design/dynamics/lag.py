"""Dead times and first-order lags of commands that a controller holds between its periods."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

Floats = NDArray[np.float64]


def held(command: Floats, steps: int, delay: float, before: float) -> Floats:
    """Mean over each step of a command that is held for `steps` steps and comes later by `delay` steps.

    command : (periods,). before : its value before the first period. Returns (periods steps,). Delays that are not
    whole steps share the step between two values, so that the mean is exact.
    """
    whole = math.floor(delay)
    share = delay - whole
    record = np.repeat(command, steps)
    count = len(record)
    padded = np.concatenate((np.full(whole + 1, before), record))
    early, late = padded[1 : count + 1], padded[:count]
    return early if share == 0 else np.asarray((1 - share) * early + share * late)


def lagged(mean: Floats, time_constant: float, step: float, start: float) -> Floats:
    """x at the ends of the steps of T x' + x = u, for u constant over each step: exact.

    mean : (n,) u of each step. time_constant, step : T and the step (s). Returns (n + 1,), its first the start. A time
    constant of zero gives the command itself, from the end of the first step on.
    """
    kept = math.exp(-step / time_constant) if time_constant > 0 else 0.0
    after, _ = lfilter([1 - kept], [1.0, -kept], mean, zi=[kept * start])
    return np.concatenate(([start], after))
