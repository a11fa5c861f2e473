"""Steps of the reference force, in simulated time: the plant between the samples of its controller.

The plant moves on in steps, a whole number of them to each control period: its linear part exactly (`series_elastic`),
the spring's memory and the guides' bristles exactly for the motion of the step, and what is not linear on the line
through its last two values. The controller sees encoder readings at its samples and holds its current until the next.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.disturbance_observer import streamed
from fluxbore.design.dynamics.force_control import ForceController, angle_reference, check_reference
from fluxbore.design.dynamics.guides import Guides, rubbing_of
from fluxbore.design.dynamics.linearised import FILTERED
from fluxbore.design.dynamics.magnetic_hysteresis import HysteresisSpring
from fluxbore.design.dynamics.magnetic_spring import SpringLaw
from fluxbore.design.dynamics.screw_hold import holds, lost
from fluxbore.design.dynamics.series_elastic import Environment, SeriesElastic, exact_step
from fluxbore.design.dynamics.stepped_spring import initial_stiffness, stepped
from fluxbore.design.errors import DesignError

Floats = NDArray[np.float64]


def undistorted(angle: float, position: float) -> float:
    """x_d0 (m) of poles that stand where they should."""
    return 0.0


@dataclass(frozen=True, slots=True)
class Stand:
    """The plant as it is, which the controller need not know: spring, guides, zero-force line, encoders.

    distortion : x_d0 (m) over the rotor's angle (rad) and the mover's position (m).
    angle_count (rad), position_count (m) : one count of either encoder; zero reads exactly.
    """

    plant: SeriesElastic
    environment: Environment
    spring: SpringLaw | HysteresisSpring
    guides: Guides = field(default_factory=Guides)
    distortion: Callable[[float, float], float] = field(default=undistorted)
    angle_count: float = 0.0
    position_count: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class ForceStep:
    """One run, read at the start of every control period and at the end, (n,) each, SI units.

    force : F_l, by which the mover presses on its environment.
    """

    reference: float
    time: Floats
    force: Floats
    spring_force: Floats
    angle: Floats
    position: Floats
    current: Floats


def simulate_step(
    stand: Stand, controller: ForceController, reference: float, duration: float, step: float | None = None
) -> ForceStep:
    """From rest without force to a reference force (N) at time zero, over a duration (s).

    step : of the plant (s), a whole share of the control period; that period itself where it is not given. Raises
    DesignError where it is no such share, for a force that the screw cannot hold, a duration that is not above zero,
    where the control does not hold the rotor, and where the screw slips.
    """
    check_reference(controller, reference)
    period = controller.period
    step = period if step is None else step
    if not (math.isfinite(duration) and duration > 0):
        raise DesignError(f"The duration of a run must be finite and above 0 s; got {duration:g} s.")
    count = round(period / step) if math.isfinite(step) and step > 0 else 0
    if count < 1 or not math.isclose(count * step, period, rel_tol=1e-9):
        raise DesignError(f"The step must be a whole share of the control period {period:g} s; got {step:g} s.")
    periods = math.ceil(duration / period - 1e-9)
    record = np.empty((periods + 1, 5))
    _run(stand, controller, reference, count, record)
    environment = stand.environment
    angle, position, velocity, spring, current = record.T.copy()
    force = environment.stiffness * position + environment.damping * velocity
    time = period * np.arange(periods + 1, dtype=np.float64)
    return ForceStep(reference, time, force, spring, angle, position, current)


def _run(stand: Stand, controller: ForceController, reference: float, count: int, record: Floats) -> None:
    """Fills the record with angle, position, velocity, spring force and current at every control sample.

    Written out in floats: the loop is closed over the force, so that it goes one step after the other, and small arrays
    would cost ten times as much.
    """
    period, h = controller.period, stand.plant.transfer_ratio
    stiffness = initial_stiffness(stand.spring)
    exact = exact_step(stand.plant, stand.environment, stiffness, period / count)
    (k00, k01, k02, k03), (k10, k11, k12, k13), (k20, k21, k22, k23), (k30, k31, k32, k33) = exact.kept.tolist()
    (t0, r0, f0), (t1, r1, f1), (t2, r2, f2), (t3, r3, f3) = exact.held.tolist()
    (_, d0, e0), (_, d1, e1), (_, d2, e2), (_, d3, e3) = exact.sloped.tolist()
    force_of, distortion = stepped(stand.spring), stand.distortion
    straight = distortion is undistorted
    rub = rubbing_of(stand.guides)
    slip = math.pi * h
    control = _controlling(stand, controller, reference)
    torque_constant = controller.observer.torque_constant
    angle = speed = position = velocity = 0.0
    spring = force_of(-distortion(0.0, 0.0))
    rest = rest_before = spring
    rubbing = rubbing_before = 0.0
    current = 0.0
    for sample in range(len(record) - 1):
        if not holds(angle, h * angle - position, slip):
            raise lost(angle, slip, period, sample)
        current = control(angle, position)
        record[sample] = angle, position, velocity, spring, current
        torque = torque_constant * current
        for _ in range(count):
            rise, more = rest - rest_before, rubbing - rubbing_before
            rest_before, rubbing_before = rest, rubbing
            start = position
            angle, speed, position, velocity = (
                k00 * angle + k01 * speed + k02 * position + k03 * velocity
                + t0 * torque + r0 * rest + d0 * rise + f0 * rubbing + e0 * more,
                k10 * angle + k11 * speed + k12 * position + k13 * velocity
                + t1 * torque + r1 * rest + d1 * rise + f1 * rubbing + e1 * more,
                k20 * angle + k21 * speed + k22 * position + k23 * velocity
                + t2 * torque + r2 * rest + d2 * rise + f2 * rubbing + e2 * more,
                k30 * angle + k31 * speed + k32 * position + k33 * velocity
                + t3 * torque + r3 * rest + d3 * rise + f3 * rubbing + e3 * more,
            )  # fmt: skip
            displacement = h * angle - position
            spring = force_of(displacement if straight else displacement - distortion(angle, position))
            rest = spring - stiffness * displacement
            rubbing = rub(position - start, velocity)
    record[-1] = angle, position, velocity, spring, current


def _controlling(stand: Stand, controller: ForceController, reference: float) -> Callable[[float, float], float]:
    """The controller at its samples: the current (A) by the rotor's angle (rad) and the mover's position (m)."""
    period, position_gain, speed_gain = controller.period, controller.position_gain, controller.speed_gain
    kept = math.exp(-controller.speed_cutoff * period)
    gained = (1 - kept) / period
    observe = streamed(controller.observer, period)
    filtered = controller.observer_speed == FILTERED
    torque_constant = controller.observer.torque_constant
    angle_count, position_count = stand.angle_count, stand.position_count
    angle_before = position_before = speed = velocity = current = 0.0

    def control(angle: float, position: float) -> float:
        nonlocal angle_before, position_before, speed, velocity, current
        if angle_count:
            angle = angle_count * math.floor(angle / angle_count + 0.5)
        if position_count:
            position = position_count * math.floor(position / position_count + 0.5)
        turned = angle - angle_before
        speed = kept * speed + gained * turned
        velocity = kept * velocity + gained * (position - position_before)
        angle_before, position_before = angle, position
        disturbance = observe(current, speed if filtered else turned / period)
        wanted = angle_reference(controller, reference, position, velocity, angle)
        current = speed_gain * (position_gain * (wanted - angle) - speed) + disturbance / torque_constant
        return current

    return control
