"""Force control of a magnetic-lead-screw actuator: a load force becomes a rotor angle, which a position control holds.

The RotLin paper, Sec. IV-C and Fig. 22. At rest the mover's forces balance,

    F_stall sin((h theta - x - x_d0)/h) - F_l - F_f = 0                                       (30)

and solved for the angle that is the force controller,

    theta_ref = arcsin((F_l_ref + F_f_est)/F_stall) + (x + x_d0)/h                            (31)

with the friction (29) at the mover's estimated speed and the zero-force line x_d0(theta), as far as it is known.
(31) is the inverse of the sine (14) alone: what the spring holds back by its hysteresis stays as an error of the force.

The rotor follows by proportional controllers with a disturbance observer, sampled once a control period:

    omega_hat = g_v s/(s + g_v) theta                                                         (28), exact on lines
    i = K_v (K_p (theta_ref - theta) - omega_hat) + d/K_t
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from fluxbore.design.dynamics.disturbance_observer import DisturbanceObserver
from fluxbore.design.dynamics.linearised import FILTERED, OBSERVER_SPEEDS, ForceLoop
from fluxbore.design.dynamics.series_elastic import Environment, SeriesElastic
from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity


@dataclass(frozen=True, slots=True)
class MoverFriction:
    """F_f = gamma_1 tanh(gamma_2 v) + gamma_3 sgn v (29): smoothed Coulomb friction and a jump, neither viscous.

    smooth : gamma_1 (N). sharpness : gamma_2 (s/m). jump : gamma_3 (N).
    """

    smooth: float
    sharpness: float
    jump: float

    @property
    def level(self) -> float:
        """What it tends to at speed (N)."""
        return self.smooth + self.jump

    def __call__(self, velocity: float) -> float:
        """F_f (N) at a velocity (m/s), with its sign; zero at rest."""
        if velocity == 0.0:
            return 0.0
        return self.smooth * math.tanh(self.sharpness * velocity) + math.copysign(self.jump, velocity)


NO_FRICTION = MoverFriction(0.0, 1.0, 0.0)


def no_distortion(angle: float) -> float:
    """x_d0 (m) of poles that stand where they should."""
    return 0.0


@dataclass(frozen=True, slots=True)
class ForceController:
    """What the controller knows and does, SI units.

    position_gain : K_p (1/s). speed_gain : K_v (A s/rad). speed_cutoff : g_v (rad/s). observer : of the rotor, and
    `observer_speed` what it reads, one of `linearised.OBSERVER_SPEEDS`; sampled, the unfiltered speed is the difference
    over one control period. stall_force (N), transfer_ratio (m/rad), friction, distortion (m over rad) : of (31).
    period : of control (s).

    Raises DesignError where a gain, frequency, force, ratio or period is not above zero, or for another speed.
    """

    position_gain: float
    speed_gain: float
    speed_cutoff: float
    observer: DisturbanceObserver
    stall_force: float
    transfer_ratio: float
    period: float
    friction: MoverFriction = NO_FRICTION
    distortion: Callable[[float], float] = field(default=no_distortion)
    observer_speed: str = FILTERED

    def __post_init__(self) -> None:
        for name, value, unit in (
            ("position gain", self.position_gain, "1/s"),
            ("speed gain", self.speed_gain, "A s/rad"),
            ("speed cut-off frequency", self.speed_cutoff, "rad/s"),
            ("stall force", self.stall_force, "N"),
            ("transfer ratio", self.transfer_ratio, "m/rad"),
            ("period", self.period, "s"),
        ):
            if not (math.isfinite(value) and value > 0):
                raise DesignError(f"The controller's {name} must be finite and above 0 {unit}; got {value:g} {unit}.")
        if self.observer_speed not in OBSERVER_SPEEDS:
            raise DesignError(
                f"The speed of the disturbance observer must be one of {', '.join(OBSERVER_SPEEDS)}; "
                f"got {self.observer_speed}."
            )


def static_balance(
    controller: ForceController, angle: float, position: float, load_force: float, velocity: float = 0.0
) -> float:
    """What is left over of the forces (N): the left side of (30), at an angle (rad), a position (m), a load (N)."""
    h = controller.transfer_ratio
    turned = (h * angle - position - controller.distortion(angle)) / h
    return controller.stall_force * math.sin(turned) - load_force - controller.friction(velocity)


def angle_reference(
    controller: ForceController, reference: float, position: float, velocity: float, angle: float
) -> float:
    """theta_ref (rad) of (31), for a force (N) at the mover's position (m) and velocity (m/s).

    angle : the rotor's (rad), where the zero-force line is read. A force beyond F_stall is taken as F_stall, a
    quarter of the pitch: further on the screw would slip.
    """
    share = (reference + controller.friction(velocity)) / controller.stall_force
    return math.asin(min(1.0, max(-1.0, share))) + (position + controller.distortion(angle)) / controller.transfer_ratio


def check_reference(controller: ForceController, reference: float) -> None:
    """Raises DesignError for a force (N) that (31) cannot reach together with the friction."""
    most = controller.stall_force - controller.friction.level
    if not abs(reference) <= most:
        raise DesignError(
            "A reference force must be at most the stall force less the friction, "
            f"{format_quantity(most, 'force', 6)}, in size; got {format_quantity(reference, 'force', 6)}."
        )


def force_loop(
    plant: SeriesElastic, environment: Environment, controller: ForceController, force: float = 0.0
) -> ForceLoop:
    """The linearised loop about a spring force (N), with K_l* of (32).

    Its nominal inertia and torque constant are the observer's: the derivation takes them for the plant's own.
    """
    slope = controller.stall_force / controller.transfer_ratio
    return ForceLoop(
        J=plant.inertia,
        M=plant.mass,
        h=plant.transfer_ratio,
        K_l=slope * math.sqrt(max(0.0, 1 - (force / controller.stall_force) ** 2)),
        K_e=environment.stiffness,
        D_e=environment.damping,
        K_p=controller.position_gain,
        K_v=controller.speed_gain,
        K_t=controller.observer.torque_constant,
        g_D=controller.observer.cutoff,
        g_v=controller.speed_cutoff,
    )
