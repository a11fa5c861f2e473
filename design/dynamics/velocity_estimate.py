"""Velocity as a controller knows it: the difference of an encoder's counts, through a first-order filter."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class VelocityEstimate:
    """resolution : one count (m). period : between readings (s). time_constant : of the filter (s), zero for none."""

    resolution: float
    period: float
    time_constant: float

    def __call__(self, position: Floats, phase: float) -> Floats:
        """(n,) m/s at readings of (n,) positions (m).

        phase : where within a count position zero lies, 0 to 1. The mover rests before the first reading.
        """
        counts = np.floor(position / self.resolution + phase)
        moved = np.diff(counts, prepend=0.0) * (self.resolution / self.period)
        kept = math.exp(-self.period / self.time_constant) if self.time_constant > 0 else 0.0
        return np.asarray(lfilter([1 - kept], [1.0, -kept], moved))
