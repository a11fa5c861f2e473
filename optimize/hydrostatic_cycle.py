"""Pressures and losses of an electro-hydrostatic actuator over one period of a sinusoidal force, in closed form.

    p_out = (F + m a + F_f(v, p_out))/A,     p_in = p_out + R q        with q = A v and R that of ports, hose and block
    loss  = mean of F_f v of both pistons and R q^2

The force is made exactly and the fluid neither gives nor is it late: what `hydrostatic_drive` simulates, without its
loops. m is small enough that the column's own resonance, at hundreds of hertz, stands still.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from fluxbore.design.hydrostatic import HydraulicCylinder, HydrostaticActuator

SAMPLES = 180
"""Of the period, a multiple of four: rest and top speed are among them."""


@dataclass(frozen=True, slots=True)
class Cycle:
    """SI units. way : of the output piston between its ends. speed : its largest. peak_output, peak_input, least :
    gauge pressures in the output and the input cylinder, and the least in either. drop : from one to the other at the
    largest speed. middle : the pressure that balances the middle force. loss : mean power that warms fluid and seals.
    """

    way: float
    speed: float
    peak_output: float
    peak_input: float
    least: float
    drop: float
    middle: float
    loss: float


def cycle(actuator: HydrostaticActuator, amplitude: float, frequency: float, least_force: float) -> Cycle:
    """Of an amplitude (N, half the distance between peaks), a frequency (Hz) and the least force (N).

    Where the return element does not stiffen, nothing moves.
    """
    import numpy as np

    from fluxbore.design.cylinder_friction import cylinder_friction
    from fluxbore.design.hydrostatic_figures import line_pressure_drop, stiffness
    from fluxbore.design.hydrostatic_range import extension_at

    out, into, ratio = actuator.output_cylinder, actuator.input_cylinder, actuator.hydraulic_ratio
    middle = least_force + amplitude
    k = stiffness(actuator, extension_at(actuator, middle))
    way, omega = (amplitude / k if k > 0 else 0.0), math.tau * frequency
    phase = math.tau / SAMPLES * np.arange(SAMPLES)
    velocity, acceleration = -omega * way * np.sin(phase), -(omega**2) * way * np.cos(phase)
    force = middle + amplitude * np.cos(phase)
    second = _piston_pressure(out, force + out.moving_mass * acceleration, velocity)
    friction = cylinder_friction(out.friction, velocity, second)
    drop = np.array([line_pressure_drop(actuator, float(v)) for v in velocity])
    first = second + drop
    seal = cylinder_friction(into.friction, velocity / ratio, first)
    loss = np.mean((friction + drop * out.area + seal / ratio) * velocity)
    # Next to rest, where static friction is in full: at the top the piston may have come slowly, at the foot it is due.
    slow = out.friction.linear_speed
    top = float(_piston_pressure(out, middle + amplitude, slow))
    foot = float(_piston_pressure(out, least_force + out.moving_mass * omega**2 * way, -slow))
    return Cycle(
        2 * way,
        omega * way,
        max(float(np.max(second)), top),
        max(float(np.max(first)), top),
        min(float(np.min(first)), float(np.min(second)), foot),
        line_pressure_drop(actuator, omega * way),
        middle / out.area,
        float(loss),
    )


def _piston_pressure(cylinder: HydraulicCylinder, force: Any, velocity: Any) -> Any:
    """p (Pa) with A p = F + F_f(v, p): friction is linear in the pressure, and knows none below zero."""
    import numpy as np

    from fluxbore.design.cylinder_friction import cylinder_friction

    law = cylinder.friction
    carried = force + cylinder_friction(law, velocity, 0.0)
    share = law.pressure_coefficient * np.clip(np.asarray(velocity) / law.linear_speed, -1.0, 1.0)
    return np.where(carried > 0, carried / (cylinder.area - share), carried / cylinder.area)
