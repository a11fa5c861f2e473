"""The stand in simulated time: its rotor follows a reference of the angle, its mover meets friction and a load.

    J theta'' = K_t i - h F_s                  (4), (6)
    M x''     = F_s - F_l - F_f                (5),      F_l = K_e x + D_e x'
    F_s       = (25), (26) at x_dn = h theta - x - x_d0(theta, x)
    F_f       = LuGre bristles of a constant level
    i         = K_v (K_p (theta_ref - theta) - w) + d/K_t,  w and the disturbance d from the counted angle

Between the controller's samples the plant goes on by half steps of position, a full step of speed, and half steps of
position again: of second order, and stable below 2/sqrt(K/M + h^2 K/J), 6 ms for the paper's actuator. Hysteresis and
bristles are taken along exactly within. The control loop closes over all of it, so the samples come one after the
other: plain floats, some 3 us a step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.bouc_wen import advance
from fluxbore.design.dynamics.force_parameters import ForceParameters
from fluxbore.design.dynamics.motion_log import MotionLog
from fluxbore.design.dynamics.screw_hold import holds, lost
from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity

Floats = NDArray[np.float64]

LEAST_STEPS = 2
"""Of the plant in a control period."""

RESOLVED = 0.25
"""Of a radian, that the plant's fastest motion may turn in a step: an eighth of what is stable."""

MOST_STEPS = 5_000_000
"""Of the plant in one run: a quarter of a minute."""


@dataclass(frozen=True, slots=True, eq=False)
class PlantRun:
    """At each control period, (n,): what the encoders count, and the truth.

    log : with the load F_l (N) as its force. angle (rad), position (m), speed (m/s) : without counts.
    """

    log: MotionLog
    load: Floats
    angle: Floats
    position: Floats
    speed: Floats


def run_plant(plant: ForceParameters, reference: Floats, *, steps: int | None = None, loaded: bool = True) -> PlantRun:
    """The plant from rest at zero over (n,) references of the rotor's angle (rad), a control period apart.

    steps : of the plant within a period; as many as it needs where not given. loaded : whether the mover presses
    against the load. Raises DesignError for a run of too many steps, where the control does not hold the rotor, and
    where the screw slips.
    """
    sin, exp, log1p, floor = math.sin, math.exp, math.log1p, math.floor
    T, J, M, h = plant.control_period, plant.inertia, plant.mass, plant.transfer_ratio
    K_t, K_p, K_v = plant.torque_constant, plant.position_gain, plant.speed_gain
    steps = steps or needed_steps(plant)
    check_length(plant, len(reference), steps)
    dt = T / steps
    half = dt / 2
    K_e, D_e = (plant.load_stiffness, plant.load_damping) if loaded else (0.0, 0.0)
    elastic, plastic = plant.elastic_share * plant.stall_force, (1 - plant.elastic_share) * plant.stall_force
    phi, rising, falling = plant.phi, plant.psi + plant.xi, plant.psi - plant.xi
    model, linear = plant.spring.memory, plant.eta == 1.0
    level, sigma_0, sigma_1 = plant.friction, plant.bristle_stiffness, plant.bristle_damping
    deflected, pull = level / sigma_0, (sigma_0 / level if level > 0 else 0.0)
    if level == 0:
        sigma_0 = sigma_1 = 0.0
    slip = math.pi * h
    a1, wave = plant.distortion, math.tau / plant.translator_wave
    a2, a6, a_t = (a1 * share for share in (plant.second_order, plant.sixth_order, plant.translator_order))
    count, angle_count, inverse = plant.position_count, plant.angle_count, 1 / h
    kept_w, kept_d = exp(-plant.speed_cutoff * T), exp(-plant.observer_cutoff * T)
    theta = w = x = v = z = memory = x_dn = 0.0
    counted = speed = current = torque = drag = 0.0
    rows: list[tuple[float, ...]] = []
    for wanted in reference.tolist():
        if not holds(theta, x_dn, slip):
            raise lost(theta, slip, T, len(rows))
        load = K_e * x + D_e * v
        angle = floor(theta / angle_count + 0.5) * angle_count if angle_count > 0 else theta
        rows.append((angle, floor(x / count + 0.5) * count if count > 0 else x, load, theta, x, v))
        before = speed
        speed = kept_w * speed + (1 - kept_w) * (angle - counted) / T
        counted = angle
        torque = kept_d * torque + (1 - kept_d) * K_t * current
        drag = kept_d * drag + (1 - kept_d) * J * (speed - before) / T
        current = K_v * (K_p * (wanted - angle) - speed) + (torque - drag) / K_t
        for _ in range(steps):
            theta += half * w
            x += half * v
            steady = deflected if v > 0 else -deflected
            z = steady + (z - steady) * exp(-abs(v) * pull * half)
            moved = -x_dn
            x_dn = h * theta - x - (a1 * sin(theta) + a2 * sin(2 * theta) + a6 * sin(6 * theta) + a_t * sin(wave * x))
            moved += x_dn
            if not linear:
                memory = advance(model, memory, moved)
            elif moved:
                # bouc_wen.advance for eta = 1, written out: a call each step would cost as much as all else here.
                y, u = (memory, moved) if moved > 0 else (-memory, -moved)
                if y < 0:
                    to_zero = log1p(-falling * y / phi) / falling if falling > 0 else -y / phi
                    if u <= to_zero:
                        gone = exp(-falling * u)
                        y = y * gone + (phi * (1 - gone) / falling if falling > 0 else phi * u)
                        u = 0.0
                    else:
                        y, u = 0.0, u - to_zero
                if u:
                    gone = exp(-rising * u)
                    y = y * gone + phi * (1 - gone) / rising
                memory = y if moved > 0 else -y
            F = elastic * sin(x_dn * inverse) + plastic * sin(memory * inverse)
            F_f = sigma_0 * z + sigma_1 * (v - abs(v) * pull * z)
            w += dt * (K_t * current - h * F) / J
            v += dt * (F - K_e * x - D_e * v - F_f) / M
            steady = deflected if v > 0 else -deflected
            z = steady + (z - steady) * exp(-abs(v) * pull * half)
            theta += half * w
            x += half * v
    columns = np.array(rows).T.copy()
    return PlantRun(MotionLog(T, columns[0], columns[1], columns[2], "the simulated run"), *columns[2:])


def needed_steps(plant: ForceParameters) -> int:
    """How many steps of the plant a control period takes, for its fastest motion to be resolved."""
    spring = plant.stall_force / plant.transfer_ratio
    pressed = spring + plant.load_stiffness + plant.bristle_stiffness
    rate = math.sqrt(pressed / plant.mass + plant.transfer_ratio**2 * spring / plant.inertia)
    damped = (plant.load_damping + plant.bristle_damping) / plant.mass
    return max(LEAST_STEPS, math.ceil(min(plant.control_period * max(rate, damped) / RESOLVED, MOST_STEPS + 1)))


def check_length(plant: ForceParameters, samples: float, steps: int) -> None:
    """Raises DesignError where a run has more than `MOST_STEPS`."""
    if not samples * steps <= MOST_STEPS:
        raise DesignError(
            f"A run must take at most {MOST_STEPS} steps in time; got {samples * steps:.6g}, {steps} in each control "
            f"period of {format_quantity(plant.control_period, 'time')}."
        )
