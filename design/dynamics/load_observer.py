"""The load's force from the spring's: a disturbance observer of the mover, less its friction, (27)-(29).

    F_l = (F_s + g_L M w) g_L/(s + g_L) - g_L M w - F_f(w),         w = g_v s/(s + g_v) x
    F_f(w) = gamma_1 tanh(gamma_2 w) + gamma_3 sign(w)

of the paper on the RotLin actuator, after Ohnishi's disturbance observer; w is the mover's speed. The mover moves by
M w' = F_s - F_l - F_f, so that the first two terms are F_s - M w' through a low-pass filter: load and friction. The
paper calls gamma_1 viscous; with tanh it is the smoothed share of a Coulomb friction.

Both filters are exact for signals that are straight between the samples, at any period. Sample by sample (`observe`)
and over a whole record (`observe_record`) they give the same to rounding.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.signal import lfilter

from fluxbore.design.errors import DesignError

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SmoothedCoulomb:
    """The mover's friction (29): gamma_1 (N), gamma_2 (s/m), gamma_3 (N)."""

    smooth: float = 0.8
    steepness: float = 200.0
    sharp: float = 0.05

    def __call__(self, speed: ArrayLike) -> Floats:
        """F_f (N) at speeds (m/s); the shape is kept."""
        v = np.asarray(speed, dtype=np.float64)
        return np.asarray(self.smooth * np.tanh(self.steepness * v) + self.sharp * np.sign(v))


@dataclass(frozen=True, slots=True)
class LoadObserver:
    """mass : M_n (kg). cutoff, speed_cutoff : g_L, g_v (rad/s). period : between samples (s).

    Raises DesignError where one is not above zero.
    """

    period: float
    mass: float = 2.55
    cutoff: float = 200.0
    speed_cutoff: float = 1000.0
    friction: SmoothedCoulomb = field(default_factory=SmoothedCoulomb)

    def __post_init__(self) -> None:
        for name in ("period", "mass", "cutoff", "speed_cutoff"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise DesignError(f"{name} of a load observer must be finite and above 0; got {value:g}.")


class Observed(NamedTuple):
    """Between two samples: the last position (m), speed (m/s), and the low-pass filter's input and output (N)."""

    position: float
    speed: float
    entered: float
    passed: float


def at_rest(spring_force: float, position: float) -> Observed:
    """Before the second sample: the mover at rest at the first, where the load is the spring's force."""
    return Observed(position, 0.0, spring_force, spring_force)


def observe(observer: LoadObserver, before: Observed, spring_force: float, position: float) -> tuple[Observed, float]:
    """One sample on: what to keep, and the load's force (N)."""
    kept, _ = _ramp_filter(observer.speed_cutoff, observer.period)
    speed = kept * before.speed + (1 - kept) * (position - before.position) / observer.period
    carried = observer.cutoff * observer.mass * speed
    kept, mean = _ramp_filter(observer.cutoff, observer.period)
    entered = spring_force + carried
    passed = kept * before.passed + (mean - kept) * before.entered + (1 - mean) * entered
    gamma = observer.friction
    friction = gamma.smooth * math.tanh(gamma.steepness * speed) + gamma.sharp * ((speed > 0) - (speed < 0))
    return Observed(position, speed, entered, passed), passed - carried - friction


def observe_record(observer: LoadObserver, spring_force: ArrayLike, position: ArrayLike) -> Floats:
    """The load's force (N), (n,), over a record of spring forces (N) and positions (m), (n,), that begins at rest."""
    force, x = (np.asarray(each, dtype=np.float64) for each in (spring_force, position))
    if len(x) == 0:
        return np.empty(0)
    speed = speed_record(observer, x)
    carried = observer.cutoff * observer.mass * speed
    kept, mean = _ramp_filter(observer.cutoff, observer.period)
    entered = force + carried
    # At rest the filter has passed what entered: its memory holds that much already.
    memory = [kept * entered[0] + (mean - kept) * entered[0]]
    passed, _ = lfilter([1 - mean, mean - kept], [1.0, -kept], entered, zi=memory)
    return np.asarray(passed - carried - observer.friction(speed))


def speed_record(observer: LoadObserver, position: Floats) -> Floats:
    """w (m/s), (n,), of (28), from rest at the first of (n,) positions (m)."""
    kept, _ = _ramp_filter(observer.speed_cutoff, observer.period)
    moved = np.diff(position, prepend=position[:1]) / observer.period
    return np.asarray(lfilter([1 - kept], [1.0, -kept], moved))


def _ramp_filter(cutoff: float, period: float) -> tuple[float, float]:
    """e^-x and (1 - e^-x)/x, x = g T: of y' = g (u - y) with u straight over the period,
    y_k = e^-x y_{k-1} + ((1 - e^-x)/x - e^-x) u_{k-1} + (1 - (1 - e^-x)/x) u_k."""
    x = cutoff * period
    return math.exp(-x), -math.expm1(-x) / x
