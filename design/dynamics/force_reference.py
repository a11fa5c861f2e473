"""The force references of the paper on the PREHydrA (Sec. IV): a skewed sine step, then a cosine.

    ramp     F = F_s + (F_p - F_s)(t/T - sin(2 pi t/T)/2 pi)         0 <= t < T = 2 s
    cosine   F = F_p - A + A cos(2 pi f (t - T))                     t >= T

Both meet with the same value and slope. F_s is the force at rest. The paper's "amplitude" is read in two ways: as A,
half the distance between the peaks, or as the whole distance 2 A. Its equation (4) needs the first, 300 N within 152 mm
of stroke need the second. In both the least force is the offset, 45 N, and the largest F_p is 45 N + 2 A.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.errors import DesignError, shown

Floats = NDArray[np.float64]

HALF, WHOLE = READINGS = ("half", "peak-to-peak")
RAMP = 2.0
"""s."""


@dataclass(frozen=True, slots=True)
class ForceReference:
    """start : F_s (N). least : smallest force of the cosine (N). swing : A (N). frequency (Hz). ramp (s)."""

    start: float
    least: float
    swing: float
    frequency: float
    ramp: float = RAMP

    def __post_init__(self) -> None:
        for name, unit in (("swing", "N"), ("frequency", "Hz"), ("ramp", "s")):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise DesignError(f"The reference's {name} must be finite and above 0 {unit}; got {value:g} {unit}.")

    @property
    def peak(self) -> float:
        """F_p (N)."""
        return self.least + 2 * self.swing


def force_reference(
    amplitude: float, frequency: float, reading: str, start: float, least: float, ramp: float = RAMP
) -> ForceReference:
    """That of a published amplitude (N), by one of `READINGS`. Raises DesignError for another."""
    if reading not in READINGS:
        raise DesignError(f'The reading of an amplitude must be "{HALF}" or "{WHOLE}"; got {shown(reading)}.')
    return ForceReference(start, least, amplitude if reading == HALF else amplitude / 2, frequency, ramp)


def value(reference: ForceReference, time: ArrayLike) -> Floats:
    """F (N) at times (s) from zero on."""
    t = np.asarray(time, dtype=np.float64)
    share = np.clip(t / reference.ramp, 0.0, 1.0)
    rise = reference.start + (reference.peak - reference.start) * (share - np.sin(math.tau * share) / math.tau)
    turn = math.tau * reference.frequency * (t - reference.ramp)
    return np.where(t < reference.ramp, rise, reference.peak - reference.swing * (1 - np.cos(turn)))


def rate(reference: ForceReference, time: ArrayLike) -> Floats:
    """dF/dt (N/s)."""
    t = np.asarray(time, dtype=np.float64)
    share = np.clip(t / reference.ramp, 0.0, 1.0)
    rise = (reference.peak - reference.start) * (1 - np.cos(math.tau * share)) / reference.ramp
    omega = math.tau * reference.frequency
    return np.where(t < reference.ramp, rise, -reference.swing * omega * np.sin(omega * (t - reference.ramp)))
