"""The stand-in plant in simulated time: its rotor follows a reference, its mover meets friction and foam.

    J theta'' = K_t i - h F_s                  (4), (6)
    M x''     = F_s - F_l - F_f                (5),      F_l = K_e x + D_e x'
    F_s       = (25), (26) at x_dn = h theta - x - x_d0(theta, x)
    F_f       = LuGre bristles of a constant level
    i         = K_v (K_p (theta_ref - theta) - w) + d/K_t,  w and the disturbance d from the counted angle

Between the controller's samples the plant goes on by half steps of position, a full step of speed, and half steps of
position again: of second order, and stable below 2/sqrt(K/M + h^2 K/J), 6 ms here. Hysteresis and bristles are
taken along exactly within. The control loop closes over all of it, so the samples come one after the other: plain
floats, some 3 us a step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.estimation_plant import RotLinPlant
from fluxbore.design.dynamics.motion_log import MotionLog

Floats = NDArray[np.float64]


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


def run_plant(plant: RotLinPlant, reference: Floats, *, steps: int = 2, loaded: bool = True) -> PlantRun:
    """The plant from rest at zero over (n,) references of the rotor's angle (rad), a control period apart.

    steps : of the plant within a period. loaded : whether the mover presses against the load.
    """
    sin, exp, log1p, floor = math.sin, math.exp, math.log1p, math.floor
    T, J, M, h = plant.control_period, plant.inertia, plant.mass, plant.transfer_ratio
    K_t, K_p, K_v = plant.torque_constant, plant.position_gain, plant.speed_gain
    dt = T / steps
    half = dt / 2
    K_e, D_e = (plant.load_stiffness, plant.load_damping) if loaded else (0.0, 0.0)
    elastic, plastic = plant.weight * plant.stall_force, (1 - plant.weight) * plant.stall_force
    phi, rising, falling = plant.phi, plant.psi + plant.xi, plant.psi - plant.xi
    level, sigma_0, sigma_1 = plant.friction, plant.bristle_stiffness, plant.bristle_damping
    deflected, pull = level / sigma_0, sigma_0 / level
    a1, wave = plant.distortion, math.tau / plant.translator_wave
    a2, a6, a_t = (a1 * share for share in (plant.second_order, plant.sixth_order, plant.translator_order))
    count, angle_count, inverse = plant.position_count, plant.angle_count, 1 / h
    kept_w, kept_d = exp(-plant.speed_cutoff * T), exp(-plant.observer_cutoff * T)
    theta = w = x = v = z = memory = x_dn = 0.0
    counted = speed = current = torque = drag = 0.0
    rows = []
    for wanted in reference.tolist():
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
            if moved:
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
