"""The operating range: which sinusoidal forces an electro-hydrostatic actuator can make at which frequency.

A reference F_0 + F (1 + cos 2 pi f t), from the least force F_0 to F_0 + 2 F, asks at the same time for

    speed      2 pi f F/k                              up to the motor's                                  (4)
    stroke     the return element's way to F_0 + 2 F   up to the output cylinder's
    pressure   (F_0 + 2 F + F_f)/A                     up to the rated one
    torque     i/eta (force at the input piston) + J acceleration      largest to the motor's peak torque, rms to its
                                                       continuous one
    power      torque times speed                      mean of its size over the period, up to the rated power

k, stiffness with the load held, is taken at the middle of the force; F_f at the largest speed and at the top force's
pressure, which errs to the safe side. Line pressure drops are in the torque. Quasi-static but for the motor's own
inertia: resonances of column and mass lie at hundreds of hertz.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.cylinder_friction import cylinder_friction
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.hydrostatic_figures import line_pressure_drop, maximum_velocity, stiffness

Floats = NDArray[np.float64]

LIMITS = ("speed", "stroke", "pressure", "torque", "power")

SAMPLES = 90
"""Of a period at which torque and power are read: the largest is missed by less than 0.1 %."""


@dataclass(frozen=True, slots=True)
class Demand:
    """What a sinusoid asks for over what there is, one number for each of `LIMITS`; above one it cannot be made."""

    speed: float
    stroke: float
    pressure: float
    torque: float
    power: float

    @property
    def limit(self) -> str | None:
        """The limit that is exceeded most, or None."""
        worst = max(LIMITS, key=lambda name: float(getattr(self, name)))
        return worst if getattr(self, worst) > 1 + 1e-9 else None


def demand(actuator: HydrostaticActuator, amplitude: float, frequency: float, least_force: float) -> Demand:
    """Of an amplitude F (N, half the distance between peaks), a frequency (Hz) and the least force F_0 (N)."""
    cylinder = actuator.output_cylinder
    middle = extension_at(actuator, least_force + amplitude)
    k = stiffness(actuator, middle)
    if k <= 0:  # a constant force asks for no way at all
        return Demand(0.0, 0.0, (least_force + 2 * amplitude) / (cylinder.area * cylinder.rated_pressure), 0.0, 0.0)
    omega = math.tau * frequency
    speed = omega * amplitude / k
    top = least_force + 2 * amplitude
    pressure = top / cylinder.area
    pressure = (top + float(cylinder_friction(cylinder.friction, speed, pressure))) / cylinder.area
    motor = actuator.motor
    torque, power = _motor(actuator, amplitude, omega, k, least_force)
    effective = float(np.sqrt(np.mean(torque**2)))
    return Demand(
        speed / maximum_velocity(actuator),
        _way(actuator, top) / cylinder.stroke,
        pressure / cylinder.rated_pressure,
        max(float(np.max(np.abs(torque))) / motor.peak_torque, effective / motor.continuous_torque),
        float(np.mean(np.abs(power))) / motor.rated_power if motor.rated_power is not None else 0.0,
    )


def largest_amplitude(actuator: HydrostaticActuator, frequency: float, least_force: float) -> tuple[float, str]:
    """The largest amplitude (N) at a frequency (Hz) from a least force (N), and the limit that sets it.

    Zero where even that of a millinewton cannot be made.
    """
    low, high = 0.0, 1.0
    while demand(actuator, high, frequency, least_force).limit is None and high < 1e9:
        low, high = high, 2 * high
    for _ in range(50):
        middle = (low + high) / 2
        if demand(actuator, middle, frequency, least_force).limit is None:
            low = middle
        else:
            high = middle
    return low, demand(actuator, high, frequency, least_force).limit or LIMITS[0]


def operating_map(
    actuator: HydrostaticActuator, frequencies: ArrayLike, amplitudes: ArrayLike, least_force: float
) -> tuple[Floats, NDArray[np.str_]]:
    """For frequencies (f,) in Hz and amplitudes (a,) in N: the largest demand (f, a), and its limit's name, empty where
    it is within all of them."""
    f, a = np.atleast_1d(np.asarray(frequencies, float)), np.atleast_1d(np.asarray(amplitudes, float))
    largest = np.empty((len(f), len(a)))
    names = np.empty((len(f), len(a)), dtype="<U8")
    for i, frequency in enumerate(f):
        for j, amplitude in enumerate(a):
            found = demand(actuator, float(amplitude), float(frequency), least_force)
            largest[i, j] = max(getattr(found, name) for name in LIMITS)
            names[i, j] = found.limit or ""
    return largest, names


def extension_at(actuator: HydrostaticActuator, force: float) -> float:
    """Of the return element at a force (N), within the stroke (m)."""
    element, stroke = actuator.return_element, actuator.output_cylinder.stroke

    def beyond(x: float) -> float:
        return element.force(x) + (actuator.series_stiffness or 0.0) * x - force

    if beyond(0.0) >= 0 or beyond(stroke) <= 0:
        return 0.0 if beyond(0.0) >= 0 else stroke
    from scipy.optimize import brentq

    return float(brentq(beyond, 0.0, stroke))


def _way(actuator: HydrostaticActuator, force: float) -> float:
    """Of the return element from its retracted end to a force (m); beyond the stroke with its stiffness there."""
    stroke = actuator.output_cylinder.stroke
    end = actuator.return_element.force(stroke) + (actuator.series_stiffness or 0.0) * stroke
    return extension_at(actuator, force) + max(force - end, 0.0) / stiffness(actuator, stroke)


def _motor(
    actuator: HydrostaticActuator, amplitude: float, omega: float, k: float, least_force: float
) -> tuple[Floats, Floats]:
    """Torque (N m) and power (W) over the period."""
    phase = math.tau / SAMPLES * np.arange(SAMPLES)
    ratio, area = actuator.hydraulic_ratio, actuator.output_cylinder.area
    velocity = -omega * amplitude / k * np.sin(phase)
    acceleration = -(omega**2) * amplitude / k * np.cos(phase)
    force = least_force + amplitude * (1 + np.cos(phase))
    out, into = actuator.output_cylinder, actuator.input_cylinder
    pressed = force + out.moving_mass * acceleration + cylinder_friction(out.friction, velocity, force / area)
    drop = np.array([line_pressure_drop(actuator, float(v)) for v in velocity])
    pressure = pressed / area + drop
    piston = pressure * into.area + cylinder_friction(into.friction, velocity / ratio, pressure)
    forward = piston * velocity >= 0
    screw = actuator.ball_screw
    carried = np.where(forward, piston / screw.efficiency, piston * screw.efficiency)
    torque = screw.ratio * (carried + actuator.reflected_mass * acceleration / ratio)
    return torque, torque * velocity / ratio / screw.ratio
