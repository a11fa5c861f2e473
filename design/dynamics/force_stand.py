"""The test stand of a lead screw's force and its controller, from the benchmark's parameters."""

from __future__ import annotations

import math
from collections.abc import Callable

from fluxbore.design.dynamics.disturbance_observer import DisturbanceObserver
from fluxbore.design.dynamics.force_control import ForceController, MoverFriction, no_distortion
from fluxbore.design.dynamics.force_parameters import ForceParameters
from fluxbore.design.dynamics.force_step import Stand, undistorted
from fluxbore.design.dynamics.guides import Guides
from fluxbore.design.dynamics.linearised import FILTERED
from fluxbore.design.dynamics.load_observer import LoadObserver, SmoothedCoulomb
from fluxbore.design.dynamics.series_elastic import Environment, SeriesElastic


def stand_of(parameters: ForceParameters, distorted: bool = True) -> Stand:
    """The actuator pressing on its load: hysteresis, friction, encoders, and poles distorted, unless unwanted."""
    p = parameters
    return Stand(
        distortion=_zero_force_line(p) if distorted and p.distortion > 0 else undistorted,
        plant=SeriesElastic(p.inertia, p.mass, p.transfer_ratio),
        environment=Environment(p.load_stiffness, p.load_damping),
        spring=p.spring,
        guides=Guides(p.friction, p.bristle_stiffness, p.bristle_damping),
        angle_count=p.angle_count,
        position_count=p.position_count,
    )


def controller_of(
    parameters: ForceParameters,
    observer_speed: str = FILTERED,
    distortion: Callable[[float], float] = no_distortion,
) -> ForceController:
    """Fig. 22, sampled. distortion : x_d0 (m) over the angle (rad), as far as the controller knows it."""
    p = parameters
    return ForceController(
        position_gain=p.position_gain,
        speed_gain=p.speed_gain,
        speed_cutoff=p.speed_cutoff,
        observer=DisturbanceObserver(p.torque_constant, p.inertia, p.observer_cutoff),
        stall_force=p.stall_force,
        transfer_ratio=p.transfer_ratio,
        period=p.control_period,
        friction=MoverFriction(p.smooth_friction, p.friction_sharpness, p.friction_jump),
        distortion=distortion,
        observer_speed=observer_speed,
    )


def load_observer_of(parameters: ForceParameters) -> LoadObserver:
    """(27) to (29)."""
    p = parameters
    return LoadObserver(
        p.control_period,
        p.mass,
        p.load_cutoff,
        p.speed_cutoff,
        SmoothedCoulomb(p.smooth_friction, p.friction_sharpness, p.friction_jump),
    )


def _zero_force_line(p: ForceParameters) -> Callable[[float, float], float]:
    """`ForceParameters.zero_force_line` for one angle and position at a time."""
    sin, wave = math.sin, math.tau / p.translator_wave
    a1 = p.distortion
    a2, a6, a_t = (a1 * share for share in (p.second_order, p.sixth_order, p.translator_order))
    return lambda angle, position: (
        a1 * sin(angle) + a2 * sin(2 * angle) + a6 * sin(6 * angle) + a_t * sin(wave * position)
    )
