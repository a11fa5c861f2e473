"""The electro-hydrostatic actuator in simulated time: force loop, velocity loop, motor, fluid, pistons, return element.

    force loop (sampled, delayed)   v_w = (dF_ref/dt)/k + k_p (F_ref - F_out)                    (3) and Fig. 4
    velocity loop (in the drive)    F_m = K_p (v_w - v_1) + K_i int (v_w - v_1) dt,  within the motor's peak torque

of the paper on the PREHydrA; the plant is `hydrostatic_network`'s chain, stepped by `hydrostatic_step`. F_out is what
the load cell reads, the force of return element and series spring; the load is held. K_p is the reflected mass times
the loop's bandwidth. k is the return element's slope where it has the reference force.

A command is a sample's, held for a period; it comes later by the drive's delay, which need not be whole steps: a step
that it splits takes the mean. The wanted speed is limited to the motor's. There are no end stops: a stroke that is
exceeded ends the run with its reason, as a cavity does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.force_reference import ForceReference, rate, value
from fluxbore.design.dynamics.hydrostatic_network import Network, network
from fluxbore.design.dynamics.hydrostatic_step import Loop, Motion, stepper
from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.units import STANDARD_ATMOSPHERE

Floats = NDArray[np.float64]

STEP = 125e-6
"""s, the longest without being asked; half of it changes tracking errors by less than 0.5 %."""

OVERTRAVEL = 1e-3
"""m, by which the output piston may pass its ends: a loop without end stops swings about them."""


@dataclass(frozen=True, slots=True, eq=False)
class DriveRun:
    """One run, SI units: k steps of `step` seconds.

    At the steps' ends, from the start on: time (k + 1,), velocity and way (k + 1, 2) of both pistons, content
    (k + 1, 3) of the volumes, reference and force (k + 1,), F_ref and F_out. Means of the steps: pressure (k, 3) gauge,
    flow (k, 2) of the links, friction (k, 2) of the input piston with the screw and of the output piston, motor_force
    (k,) at the input piston.
    """

    network: Network
    signal: ForceReference
    step: float
    time: Floats
    velocity: Floats
    way: Floats
    content: Floats
    pressure: Floats
    flow: Floats
    friction: Floats
    motor_force: Floats
    reference: Floats
    force: Floats


def velocity_loop(actuator: HydrostaticActuator) -> Loop:
    """Of the drive, at the input piston."""
    gain = actuator.reflected_mass * actuator.drive.bandwidth
    return Loop(gain, gain / actuator.drive.integral_time, actuator.motor.peak_torque / actuator.ball_screw.ratio)


def longest_step(actuator: HydrostaticActuator) -> float:
    """s, below which each piston's equation has one solution for sure: 2 m over how steeply its friction falls."""
    longest = math.inf
    for cylinder, mass in (
        (actuator.input_cylinder, actuator.reflected_mass),
        (actuator.output_cylinder, actuator.output_cylinder.moving_mass),
    ):
        law = cylinder.friction
        fall = law.stribeck_force * law.stribeck_decay - law.viscous_coefficient
        if fall > 0:
            longest = min(longest, 2 * mass / fall)
    return longest


def simulate(
    actuator: HydrostaticActuator, signal: ForceReference, duration: float, *, step: float | None = None
) -> DriveRun:
    """A run from rest over a duration (s), rounded up to whole control periods.

    step : a whole share of the control period (s); `STEP`, or half of `longest_step` where that is less, without it.
    Raises DesignError for a step that is none or too long, a reference beyond the return element, a stroke that is
    exceeded, and cavitation, with the time of it.
    """
    period, longest = actuator.drive.force_period, longest_step(actuator)
    if step is None:
        step = period / max(math.ceil(period / min(STEP, longest / 2) - 1e-9), 1)
    steps = round(period / step) if math.isfinite(step) and step > 0 else 0
    if steps < 1 or not math.isclose(steps * step, period, rel_tol=1e-9):
        raise DesignError(f"The step must be a whole share of the control period {period:g} s; got {step:g} s.")
    if step > longest:
        raise DesignError(
            f"The step must be at most {longest:.4g} s for friction that falls so steeply on so little mass; "
            f"got {step:g} s."
        )
    if not (math.isfinite(duration) and duration > 0):
        raise DesignError(f"The duration of a run must be finite and above 0 s; got {duration:g} s.")
    chain = network(actuator)
    periods = math.ceil(duration / period - 1e-9)
    count = periods * steps
    h = period / steps
    record = _run(chain, signal, periods, steps, h)
    motion, means = np.array(record.motion), np.array(record.means)
    time = h * np.arange(count + 1, dtype=np.float64)
    return DriveRun(
        chain,
        signal,
        h,
        time,
        motion[:, :2],
        motion[:, 2:],
        np.array(record.content),
        means[:, :3],
        means[:, 3:5],
        means[:, 5:7],
        means[:, 7],
        value(signal, time),
        _read(chain, motion[:, 3]),
    )


def feed_forward(chain: Network, signal: ForceReference, time: Floats) -> Floats:
    """(dF_ref/dt)/k (m/s) of the output piston at times (s): equation (3), k where the element has the reference force.

    Raises DesignError where the return element does not stiffen, or not to the reference's largest force within the
    stroke.
    """
    stroke = chain.actuator.output_cylinder.stroke
    ways = np.linspace(0.0, stroke, 401)
    forces = _read(chain, ways)
    if not np.all(np.diff(forces) > 0):
        raise DesignError(
            "actuator.return_spring must grow stiffer with the stroke for a force that the load sees to follow the "
            "piston; a constant force is the same wherever the piston stands."
        )
    if signal.peak > forces[-1] * (1 + 1e-9):
        raise DesignError(
            f"The reference must not exceed the return element's force at the end of actuator.output_cylinder.stroke, "
            f"{forces[-1]:.4g} N; got {signal.peak:.4g} N."
        )
    slopes = np.array([chain.return_stiffness(float(way)) for way in ways])
    return np.asarray(rate(signal, time) / np.interp(value(signal, time), forces, slopes))


def resting(chain: Network) -> Motion:
    """The retracted actuator at rest, held by the motor, friction aside."""
    loop, p = velocity_loop(chain.actuator), chain.resting_pressure()
    held = chain.actuator.input_cylinder.area * p
    content = chain.content(np.full(3, p), chain.volume(0.0, 0.0)).tolist()
    mean = (p, p, p, 0.0, 0.0, 0.0, 0.0)
    return Motion(0.0, 0.0, 0.0, 0.0, held / loop.integral_gain, tuple(content), mean, mean, force=held)


def _read(chain: Network, way: Floats) -> Floats:
    """F_out (N) at the output piston's ways (m)."""
    return np.array([chain.return_force(float(x)) for x in way])


@dataclass(frozen=True, slots=True, eq=False)
class _Record:
    """What `DriveRun` holds, step by step: speeds and ways, contents, and means."""

    motion: list[tuple[float, ...]]
    content: list[tuple[float, ...]]
    means: list[tuple[float, ...]]


def _run(chain: Network, signal: ForceReference, periods: int, steps: int, h: float) -> _Record:
    """Control period by control period."""
    actuator = chain.actuator
    drive, period = actuator.drive, actuator.drive.force_period
    times = period * np.arange(periods, dtype=np.float64)
    ahead, wanted_force = feed_forward(chain, signal, times).tolist(), value(signal, times).tolist()
    lower, fastest = 1 / actuator.hydraulic_ratio, actuator.maximum_velocity
    stroke, motion = actuator.output_cylinder.stroke, resting(chain)
    advance = stepper(chain, velocity_loop(actuator), h)
    commands: list[float] = []
    whole, late = divmod(drive.delay / h, steps)
    whole = int(whole)
    lowest = actuator.fluid.vapour_pressure - STANDARD_ATMOSPHERE
    record = _Record([(motion.first, motion.second, motion.way_1, motion.way_2)], [motion.content], [])
    for sample in range(periods):
        way = motion.way_2
        _check_stroke(stroke, way, times[sample])
        error = wanted_force[sample] - chain.return_force(way)
        commands.append(min(max(lower * (ahead[sample] + drive.force_gain * error), -fastest), fastest))
        now = commands[sample - whole] if sample >= whole else 0.0
        before = commands[sample - whole - 1] if sample > whole else 0.0
        for k in range(sample * steps, (sample + 1) * steps):
            share = min(max(k - sample * steps + 1 - late, 0.0), 1.0)
            advance(motion, before + share * (now - before))
            if min(motion.mean[:3]) < lowest:
                chain.check_pressures(np.array(motion.mean[:3]), h * k)
            record.motion.append((motion.first, motion.second, motion.way_1, motion.way_2))
            record.content.append(motion.content)
            record.means.append((*motion.mean[:5], motion.friction_1, motion.friction_2, motion.force))
    return record


def _check_stroke(stroke: float, way: float, time: float) -> None:
    if not -OVERTRAVEL <= way <= stroke + OVERTRAVEL:
        raise DesignError(
            f"The output piston must stay within actuator.output_cylinder.stroke {stroke * 1e3:.4g} mm; "
            f"got {way * 1e3:.4g} mm at {time:.4g} s."
        )
