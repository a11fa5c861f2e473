"""The force controller: (31) solves (30), and what it cannot reach is told."""

import math
from dataclasses import replace

import pytest
from rotlin_stand import ROTLIN

from fluxbore.design.dynamics.force_control import (
    MoverFriction,
    angle_reference,
    check_reference,
    force_loop,
    static_balance,
)
from fluxbore.design.dynamics.force_stand import controller_of, stand_of
from fluxbore.design.errors import DesignError

PARAMETERS = ROTLIN
STAND = stand_of(PARAMETERS)


def wavy(angle):
    return 2e-5 * math.sin(angle)


CONTROLLER = replace(controller_of(PARAMETERS), distortion=wavy)


@pytest.mark.parametrize("force", [-150.0, -20.0, 0.0, 50.0, 100.0, 190.0])
@pytest.mark.parametrize("velocity", [-0.02, 0.0, 0.003])
def test_the_reference_angle_solves_the_balance(force, velocity):
    """(31) into (30): the zero-force line is read where the rotor stands, so it is iterated to its own angle."""
    position, angle = 0.012, 14.0
    for _ in range(60):
        angle = angle_reference(CONTROLLER, force, position, velocity, angle)
    assert static_balance(CONTROLLER, angle, position, force, velocity) == pytest.approx(0.0, abs=1e-9)


def test_the_balance_has_its_slopes():
    """dF/dtheta of (30) is h K_l* of (32); catches a sign of x or of the distortion."""
    plain = controller_of(PARAMETERS)
    h, angle, position, nudge = plain.transfer_ratio, 0.5, 1e-5, 1e-6
    turned = angle - position / h
    slope = (
        static_balance(plain, angle + nudge, position, 80.0) - static_balance(plain, angle - nudge, position, 80.0)
    ) / (2 * nudge)
    assert slope == pytest.approx(plain.stall_force * math.cos(turned), rel=1e-6)
    held = force_loop(STAND.plant, STAND.environment, plain, plain.stall_force * math.sin(turned))
    assert slope == pytest.approx(h * held.K_l, rel=1e-6)


def test_a_force_beyond_stall_turns_no_further_than_a_quarter_pitch():
    plain = controller_of(PARAMETERS)
    assert angle_reference(plain, 500.0, 0.0, 0.0, 0.0) == pytest.approx(math.pi / 2)
    assert angle_reference(plain, -500.0, 0.0, 0.0, 0.0) == pytest.approx(-math.pi / 2)


def test_friction_has_its_signs_and_its_level():
    friction = MoverFriction(0.8, 200.0, 0.05)
    assert friction(0.0) == 0.0
    assert friction(1.0) == pytest.approx(friction.level)
    assert friction(-1.0) == -friction(1.0)
    assert friction(1e-9) == pytest.approx(0.05, rel=1e-4)
    assert friction(0.005) == pytest.approx(0.8 * math.tanh(1.0) + 0.05)


def test_what_cannot_be_reached_or_built_is_told():
    check_reference(CONTROLLER, 191.0)
    for force in (191.2, -191.2, math.nan):
        with pytest.raises(DesignError, match=r"at most the stall force less the friction, 191\.15 N, in size; got"):
            check_reference(CONTROLLER, force)
    with pytest.raises(DesignError, match="position gain must be finite and above 0 1/s; got 0 1/s"):
        replace(CONTROLLER, position_gain=0.0)
    with pytest.raises(DesignError, match="one of unfiltered, filtered; got both"):
        replace(CONTROLLER, observer_speed="both")
