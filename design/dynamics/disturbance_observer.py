"""The torque that disturbs a rotor, from its current and speed through a first-order filter.

After Ohnishi and others, as the RotLin paper's position control has it (Sec. IV-C, Fig. 22):

    d = g_D/(s + g_D) (K_t i + g_D J omega) - g_D J omega  =  g_D/(s + g_D) (K_t i - J omega')

in which the speed need not be differentiated. Sampled with a current that is held between samples and a speed taken on
a line between them, the filter's state moves as

    q_k = a q_{k-1} + (1 - a) K_t i_{k-1} + (p_0 omega_{k-1} + p_1 omega_k) g_D J,    d_k = q_k - g_D J omega_k

with a = e^{-x}, x = g_D T, p_1 = 1 - (1 - a)/x and p_0 = 1 - a - p_1: exact, at any period T.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import DesignError

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class DisturbanceObserver:
    """torque_constant : K_tn (N m/A). inertia : J_n (kg m^2). cutoff : g_D (rad/s). Nominal values: the observer's own.

    Raises DesignError where one is not above zero.
    """

    torque_constant: float
    inertia: float
    cutoff: float

    def __post_init__(self) -> None:
        for name, value, unit in (
            ("torque constant", self.torque_constant, "N m/A"),
            ("inertia", self.inertia, "kg m^2"),
            ("cut-off frequency", self.cutoff, "rad/s"),
        ):
            if not (math.isfinite(value) and value > 0):
                raise DesignError(f"The observer's {name} must be finite and above 0 {unit}; got {value:g} {unit}.")


@dataclass(frozen=True, slots=True)
class Weights:
    """a, 1 - a times K_t, and p_0 and p_1 times g_D J; `direct` is g_D J."""

    kept: float
    current: float
    speed_before: float
    speed_now: float
    direct: float


def weights(observer: DisturbanceObserver, period: float) -> Weights:
    """Of the sampled observer above, at a period (s)."""
    x = observer.cutoff * period
    gone = -math.expm1(-x)
    direct = observer.cutoff * observer.inertia
    now = 1 - gone / x
    return Weights(1 - gone, gone * observer.torque_constant, (gone - now) * direct, now * direct, direct)


def streamed(observer: DisturbanceObserver, period: float) -> Callable[[float, float], float]:
    """For a control loop: called each period with the current (A) held since the call before and the speed (rad/s)
    now, it gives the disturbing torque (N m). The rotor rests before the first call."""
    w = weights(observer, period)
    state = speed_before = 0.0

    def step(current: float, speed: float) -> float:
        nonlocal state, speed_before
        state = w.kept * state + w.current * current + w.speed_before * speed_before + w.speed_now * speed
        speed_before = speed
        return state - w.direct * speed

    return step


def observed(observer: DisturbanceObserver, current: Floats, speed: Floats, period: float) -> Floats:
    """For a log: the disturbing torque (N m) at every sample, (n,).

    current : (n,) A, held since the sample before. speed : (n,) rad/s. The rotor rests before the first.
    """
    from scipy.signal import lfilter

    w = weights(observer, period)
    before = np.concatenate(([0.0], speed[:-1]))
    added = w.current * current + w.speed_before * before + w.speed_now * speed
    return np.asarray(lfilter([1.0], [1.0, -w.kept], added) - w.direct * speed)
