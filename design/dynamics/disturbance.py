"""A triangular disturbance as a position-controlled load actuator carries it out, in closed form.

The command u starts at zero, goes back by the stroke and returns, at a constant speed 2 f stroke, for whole round
trips (Nakata and Noda 2023, Sec. IV-A, Fig. 12). The load actuator follows it as

    x'' + 2 zeta w x' + w^2 x = w^2 u,   w = 2 pi f_load,   0 < zeta < 1

from rest, whatever force it meets. On a ramp u = u_0 + s t the answer is the line u_0 + s (t - 2 zeta/w) and a decaying
oscillation about it; the state at each corner sets the next. The paper publishes no more of its load actuator than
its name, so the second order is an assumption.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class LoadActuator:
    """Natural frequency (Hz) and damping ratio, below one, of the position control."""

    frequency: float
    damping: float


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """What the mover is made to do, at (n,) times (s): position (m, zero before), velocity (m/s), acceleration."""

    time: Floats
    position: Floats
    velocity: Floats
    acceleration: Floats


def triangle(time: Floats, stroke: float, frequency: float) -> Floats:
    """The command (m) at times (s) of zero or more: from zero to -stroke and back, `frequency` times a second."""
    phase = np.mod(time * frequency, 1.0)
    return np.asarray(-stroke * (1.0 - np.abs(1.0 - 2.0 * phase)))


def followed(load: LoadActuator, time: Floats, stroke: float, frequency: float) -> Motion:
    """The load actuator's answer to `triangle`, exact at every time (s), which are ascending from zero."""
    ramp, speed = 0.5 / frequency, 2.0 * frequency * stroke
    angular = 2 * math.pi * load.frequency
    decay, ringing = load.damping * angular, angular * math.sqrt(1 - load.damping**2)
    behind = 2 * load.damping / angular
    segment = np.floor_divide(time, ramp).astype(np.intp)
    since = time - segment * ramp
    down = segment % 2 == 0
    slope = np.where(down, -speed, speed)
    starts = _corners(int(segment[-1]) + 1, ramp, speed, behind, decay, ringing)
    first, rate = starts[segment, 0], starts[segment, 1]
    along = (rate + decay * first) / ringing
    fade, sine, cosine = np.exp(-decay * since), np.sin(ringing * since), np.cos(ringing * since)
    off = fade * (first * cosine + along * sine)
    off_rate = fade * (rate * cosine - (decay * along + ringing * first) * sine)
    line = np.where(down, 0.0, -stroke) + slope * (since - behind)
    return Motion(time, line + off, slope + off_rate, -2 * decay * off_rate - angular**2 * off)


def _corners(count: int, ramp: float, speed: float, behind: float, decay: float, ringing: float) -> Floats:
    """(count, 2) distance from the line (m) and its rate (m/s) at the start of each ramp."""
    fade, sine, cosine = math.exp(-decay * ramp), math.sin(ringing * ramp), math.cos(ringing * ramp)
    states = np.empty((count, 2))
    slope, off, rate = -speed, speed * -behind, speed
    for segment in range(count):
        states[segment] = off, rate
        along = (rate + decay * off) / ringing
        off, rate = (
            fade * (off * cosine + along * sine),
            fade * (rate * cosine - (decay * along + ringing * off) * sine),
        )
        # At a corner position and velocity go on, and the line turns round: u_0 is the same from either side.
        off, rate = off - 2 * slope * behind, rate + 2 * slope
        slope = -slope
    return states
