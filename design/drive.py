"""What the drive sees of the motor: back-EMF, terminal voltage, and the speeds that a supply allows.

All phase quantities are amplitudes; the current stands on the q axis. From the balance of power, 3/2 E I = K I v,

    E = k v,   k = 2/3 K                                  back-EMF; K is the force constant per ampere of amplitude
    U^2 = (R I + k v)^2 + (x v I)^2,   x = pi L / tau     at the electrical angular speed omega = pi v / tau

(any text on permanent-magnet synchronous machines, such as Hendershot and Miller 2010; a slotless tubular motor has no
saliency, so that one L serves both axes). Valid in steady state for sinusoidal waves; the inverter's dead times and
drops are left out. An inverter on a direct voltage U_dc gives phase amplitudes up to U_dc/sqrt(3) by space-vector
modulation without overmodulation (van der Broeck et al. 1988, IEEE Trans. Ind. Appl. 24, 142).
"""

from __future__ import annotations

import math


def back_emf(force_constant: float, speed: float) -> float:
    """Amplitude of a phase's back-EMF (V) for a force constant in N/A and a speed in m/s."""
    return 2 / 3 * force_constant * speed


def voltage_demand(
    force_constant: float, resistance: float, inductance: float, pole_pitch: float, current: float, speed: float
) -> float:
    """Amplitude of a phase's terminal voltage (V): SI units, current as amplitude.

    inductance : L (H), self less mutual; zero where it is not known, which misses the second term alone.
    """
    direct = math.pi * speed / pole_pitch * inductance * current
    return math.hypot(resistance * current + back_emf(force_constant, speed), direct)


def phase_voltage(supply: float) -> float:
    """Largest phase amplitude (V) of an inverter on a direct voltage (V)."""
    return supply / math.sqrt(3)


def speed_limit(
    force_constant: float, resistance: float, inductance: float, pole_pitch: float, current: float, voltage: float
) -> float | None:
    """The speed (m/s) at which the voltage demand of a current (A) reaches the voltage (V, phase amplitude).

    The root of U^2 = (R I + k v)^2 + (x I v)^2 that is U/k without current. Below zero, R I alone exceeds U, and only a
    motor that is dragged backwards could carry the current. Where not even that helps, for the reactance takes too much
    at any speed, it is (U^2 - (R I)^2)/(k R I): no speed, but a measure of how far the supply is from it, which joins
    on where the root ends and falls as R I grows. None where there is no force.
    """
    k, x, drop = 2 / 3 * force_constant, math.pi * inductance / pole_pitch * current, resistance * current
    free = voltage**2 - drop**2
    square = (k * voltage) ** 2 + x**2 * free
    if k <= 0:
        return None
    return free / (k * drop + math.sqrt(max(square, 0.0)))
