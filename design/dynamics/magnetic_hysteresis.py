"""A magnetic spring that remembers: its law shared between the displacement and the state of Bouc-Wen hysteresis.

    F_s = w law(x_d) + (1 - w) law(x_s),        x_s by `bouc_wen`

With the sine this is the paper's (17); with k_1 x + k_3 x^3 it is (15), for one joint. The bound of x_s keeps (17)
below the stall force: it peaks at F_stall (w + (1 - w) sin(x_s/h)), 186.6 N of 192 N with the paper's Table II.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.dynamics.bouc_wen import BoucWen, advance, states
from fluxbore.design.dynamics.magnetic_spring import SineSpring, SpringLaw
from fluxbore.design.errors import DesignError

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class HysteresisSpring:
    """law : what both shares follow. weight : w, from 0 (all of it plastic) to 1 (none). memory : of x_s.

    Raises DesignError for a weight outside.
    """

    law: SpringLaw
    weight: float
    memory: BoucWen = field(default_factory=BoucWen)

    def __post_init__(self) -> None:
        if not 0 <= self.weight <= 1:
            raise DesignError(f"The weight of the hysteresis must be from 0 to 1; got {self.weight:g}.")

    def at(self, displacement: ArrayLike, state: ArrayLike) -> Floats:
        """F_s (N) at displacements x_d and states x_s (m); they broadcast."""
        return np.asarray(self.weight * self.law.force(displacement) + (1 - self.weight) * self.law.force(state))


@dataclass(frozen=True, slots=True)
class Loop:
    """A closed loop about zero: height (N) at no displacement, area (J), peak (N) at its tip."""

    height: float
    area: float
    peak: float


def force_record(spring: HysteresisSpring, displacement: ArrayLike, start: float = 0.0) -> Floats:
    """F_s (N), (n,), along a record of displacements (m), (n,), from the state x_s = start (m)."""
    return spring.at(displacement, states(spring.memory, displacement, start))


def step(spring: HysteresisSpring, state: float, before: float, after: float) -> tuple[float, float]:
    """From displacement `before` to `after` (m) in one direction: the new x_s (m), and F_s (N) there."""
    state = advance(spring.memory, state, after - before)
    return state, float(spring.at(after, state))


def steady_loop(spring: HysteresisSpring, amplitude: float, points: int = 2001) -> Loop:
    """The loop between -amplitude and amplitude (m) after it has closed.

    points : on either branch, an odd number; height and peak are exact, the area is by Simpson's rule.
    """
    from scipy.integrate import simpson

    way, up, down = steady_branches(spring, amplitude, points)
    middle = points // 2
    return Loop(float(up[middle] - down[middle]), float(simpson(up - down, x=way)), float(up[-1]))


def steady_branches(spring: HysteresisSpring, amplitude: float, points: int) -> tuple[Floats, Floats, Floats]:
    """Displacements (m) from -amplitude to amplitude, and the forces (N) of the closed loop there: rising, falling."""
    state = 0.0
    for _ in range(1000):  # a round trip contracts; in rounding it comes to a stand
        following = advance(spring.memory, advance(spring.memory, state, 2 * amplitude), -2 * amplitude)
        if following == state:
            break
        state = following
    way = np.linspace(-amplitude, amplitude, points)
    tip = advance(spring.memory, state, 2 * amplitude)
    return way, force_record(spring, way, state), force_record(spring, way[::-1], tip)[::-1]


def peak_force(spring: HysteresisSpring) -> float:
    """The largest force (N) of a `SineSpring` with memory: a quarter of the pitch on, x_s as far as its bound lets.

    A long stretch of motion in one direction comes near to it: within e^-5 of the hysteresis' share after 5/(psi + xi).
    Raises DesignError for another law, which may have no peak.
    """
    if not isinstance(spring.law, SineSpring):
        raise DesignError("The peak of a spring with hysteresis must be asked of a sinusoidal law.")
    held = min(spring.memory.bound, spring.law.transfer_ratio * math.pi / 2)
    return float(spring.at(spring.law.transfer_ratio * math.pi / 2, held))
