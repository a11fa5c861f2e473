"""An actuator whose rotor drives its mover through a magnetic spring: equations (2)-(6) of the paper on the RotLin
actuator, against an environment (34).

    x_d = h theta - x                                                  (2)
    J theta'' = T - h F_s                                              (4), (6)
    M x''     = F_s - F_f - K_e x - D_e x'                             (5), with the friction of (30)

The spring's force is taken as K_0 x_d + r: with one stiffness K_0 everything but the rest r and the friction is linear,
and is stepped exactly. r and F_f are carried over a step on the line through their last two values, so that a step is
of second order in what is not linear, and has no limit of stability from the springs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.errors import DesignError

Floats = NDArray[np.float64]

STATES = 4
"""theta (rad), omega (rad/s), x (m), v (m/s), in this order."""


@dataclass(frozen=True, slots=True)
class SeriesElastic:
    """inertia : J of the rotor (kg m^2). mass : M of the mover (kg). transfer_ratio : h (m/rad), (3).

    Raises DesignError where one is not above zero.
    """

    inertia: float
    mass: float
    transfer_ratio: float

    def __post_init__(self) -> None:
        for name, value, unit in (
            ("rotor's inertia", self.inertia, "kg m^2"),
            ("mover's mass", self.mass, "kg"),
            ("transfer ratio", self.transfer_ratio, "m/rad"),
        ):
            if not (math.isfinite(value) and value > 0):
                raise DesignError(f"The {name} must be finite and above 0 {unit}; got {value:g} {unit}.")


@dataclass(frozen=True, slots=True)
class Environment:
    """What the mover presses against: stiffness K_e (N/m) and damping D_e (N s/m), (34).

    Raises DesignError where one is below zero.
    """

    stiffness: float
    damping: float

    def __post_init__(self) -> None:
        for name, value, unit in (
            ("stiffness", self.stiffness, "N/m"),
            ("damping", self.damping, "N s/m"),
        ):
            if not (math.isfinite(value) and value >= 0):
                raise DesignError(
                    f"The environment's {name} must be finite and 0 {unit} or above; got {value:g} {unit}."
                )


@dataclass(frozen=True, slots=True, eq=False)
class ExactStep:
    """y after a step: kept y + held u + sloped (u - u before), u = (T, r, F_f); exact for u on a line over the step.

    kept : (4, 4). held, sloped : (4, 3). The torque T is held by the controller: its second term is zero.
    """

    kept: Floats
    held: Floats
    sloped: Floats


def rates(plant: SeriesElastic, environment: Environment, stiffness: float) -> tuple[Floats, Floats]:
    """A (4, 4) and B (4, 3) of y' = A y + B u, with y = (theta, omega, x, v), u = (T, r, F_f), K_0 = stiffness."""
    h, inertia, mass = plant.transfer_ratio, plant.inertia, plant.mass
    a = np.array(
        [
            [0.0, 1.0, 0.0, 0.0],
            [-(h**2) * stiffness / inertia, 0.0, h * stiffness / inertia, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [h * stiffness / mass, 0.0, -(stiffness + environment.stiffness) / mass, -environment.damping / mass],
        ]
    )
    b = np.array([[0.0, 0.0, 0.0], [1 / inertia, -h / inertia, 0.0], [0.0, 0.0, 0.0], [0.0, 1 / mass, -1 / mass]])
    return a, b


def exact_step(plant: SeriesElastic, environment: Environment, stiffness: float, step: float) -> ExactStep:
    """The linear part over a step (s): the exponential of the system with its inputs and their slopes as states
    (Van Loan 1978)."""
    from scipy.linalg import expm

    a, b = rates(plant, environment, stiffness)
    inputs = b.shape[1]
    whole = np.zeros((STATES + 2 * inputs, STATES + 2 * inputs))
    whole[:STATES, :STATES] = a * step
    whole[:STATES, STATES : STATES + inputs] = b * step
    whole[STATES : STATES + inputs, STATES + inputs :] = np.eye(inputs)
    moved = expm(whole)
    return ExactStep(
        moved[:STATES, :STATES], moved[:STATES, STATES : STATES + inputs], moved[:STATES, STATES + inputs :]
    )


def energy(plant: SeriesElastic, environment: Environment, stiffness: float, states: Floats) -> Floats:
    """Kinetic energy and that of the linear spring and the environment (J), of states (..., 4)."""
    angle, speed, position, velocity = np.moveaxis(states, -1, 0)
    displacement = plant.transfer_ratio * angle - position
    return (
        np.asarray(
            plant.inertia * speed**2
            + plant.mass * velocity**2
            + stiffness * displacement**2
            + environment.stiffness * position**2
        )
        / 2
    )
