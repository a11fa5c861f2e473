"""The seals' friction: the paper's numbers, signs and limits."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.errors import DesignError
from fluxbore.design.friction import (
    SealFriction,
    check_pressure,
    contact_force,
    kinetic_friction,
    seal_friction,
    sliding_level,
    stribeck_friction,
)

TABLE_IV = SealFriction(0.182, 0.127, 20.5, 0.00132, 0.0)
AREA = 20.6e-6


@pytest.mark.parametrize(
    ("pressure", "speed", "force"),
    [
        (0.0, 0.0, 0.182 * 20.5),  # breaking away
        (0.0, 1.0, 0.127 * 20.5),  # far above the Stribeck speed
        (0.6e6, 0.0, 0.182 * (20.6 * 0.6 + 20.5)),
        (0.6e6, 1.0, 0.127 * (20.6 * 0.6 + 20.5)),
        (0.3e6, 0.00132, (0.127 + 0.055 / 2.718281828) * (20.6 * 0.3 + 20.5)),
    ],
)
def test_equation_6_at_its_limits(pressure: float, speed: float, force: float) -> None:
    assert kinetic_friction(TABLE_IV, AREA, pressure, speed) == pytest.approx(force, rel=1e-9)
    if speed > 0:
        assert seal_friction(TABLE_IV, AREA, pressure, speed) == pytest.approx(force, rel=1e-9)
        assert seal_friction(TABLE_IV, AREA, pressure, -speed) == pytest.approx(-force, rel=1e-9)


@given(pressure=st.floats(0, 1e6), slow=st.floats(0, 0.01), faster=st.floats(0, 0.01))
def test_friction_falls_with_speed_and_grows_with_pressure(pressure: float, slow: float, faster: float) -> None:
    """Catches swapped coefficients and a pressure that relieves the seal."""

    def friction(at_pressure: float, speed: float) -> float:
        return kinetic_friction(TABLE_IV, AREA, at_pressure, speed)

    assert friction(pressure, slow) >= friction(pressure, slow + faster)
    assert friction(pressure + 1e5, slow) > friction(pressure, slow)


@given(pressure=st.floats(0, 1e6), velocity=st.floats(-0.1, 0.1), viscous=st.floats(0, 100))
def test_equation_6_is_equation_3_at_that_contact_force(pressure: float, velocity: float, viscous: float) -> None:
    """And both are odd in the velocity, and never help the motion."""
    law = SealFriction(0.182, 0.127, 20.5, 0.00132, viscous)
    normal = AREA * pressure + 20.5
    force = float(seal_friction(law, AREA, pressure, velocity))
    assert force == pytest.approx(
        float(stribeck_friction(0.127 * normal, 0.182 * normal, 0.00132, viscous, velocity)), rel=1e-12
    )
    assert force == -float(seal_friction(law, AREA, pressure, -velocity))
    assert force * velocity >= 0
    if velocity:
        assert abs(force) == pytest.approx(kinetic_friction(law, AREA, pressure, abs(velocity)), rel=1e-12)


def test_the_viscous_part_adds() -> None:
    law = SealFriction(0.182, 0.127, 20.5, 0.00132, 3.0)
    assert kinetic_friction(law, 0.0, 0.0, 0.5) - kinetic_friction(TABLE_IV, 0.0, 0.0, 0.5) == pytest.approx(1.5)
    assert seal_friction(law, 0.0, 0.0, -0.5) - seal_friction(TABLE_IV, 0.0, 0.0, -0.5) == pytest.approx(-1.5)


def test_records_and_numbers_give_the_same() -> None:
    pressures, velocities = np.array([0.0, 0.2e6, 0.6e6])[:, np.newaxis], np.array([-7e-3, -1e-3, 0.0, 2e-3])
    table = seal_friction(TABLE_IV, AREA, pressures, velocities)
    assert table.shape == (3, 4)
    for row, pressure in zip(table, pressures[:, 0], strict=True):
        assert row == pytest.approx([float(seal_friction(TABLE_IV, AREA, pressure, v)) for v in velocities], rel=1e-14)
    assert table[:, 2].tolist() == [0.0, 0.0, 0.0]
    assert isinstance(kinetic_friction(TABLE_IV, AREA, 0.0, 0.0), float)


def test_suction_lifts_the_fin_and_never_pulls_it() -> None:
    """Contact pressed by less than nothing would push the mover on."""
    loose = SealFriction(0.182, 0.127, 1.0, 0.00132, 0.0)
    assert contact_force(loose, AREA, np.array([-0.1e6, 0.0])).tolist() == [0.0, 1.0]
    assert float(sliding_level(loose, AREA, -0.1e6, 0.001)) == 0.0


def test_a_stribeck_speed_next_to_nothing_leaves_coulombs_force() -> None:
    law = SealFriction(0.182, 0.127, 20.5, 1e-310, 0.0)
    assert kinetic_friction(law, AREA, 0.0, 1e-3) == pytest.approx(0.127 * 20.5)


@pytest.mark.parametrize("pressure", [-1.0, [0.0, 1e5, -1e4], math.nan, [0.0, math.nan]])
def test_suction_is_refused_by_name(pressure: float | list[float]) -> None:
    with pytest.raises(DesignError, match=r"^operating_point\.pressure must be 0 MPa gauge or above .*; got .+\.$"):
        check_pressure(pressure, "operating_point.pressure")


def test_the_atmosphere_and_above_are_accepted() -> None:
    check_pressure(0.0, "p")
    check_pressure(np.array([0.0, 6e5]), "p")
    check_pressure([], "p")


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ((0.182, 0.127, 20.5, 0.0, 0.0), "actuator.seal.stribeck_speed must be finite and above 0; got 0."),
        ((0.182, 0.127, 20.5, -1.0, 0.0), "actuator.seal.stribeck_speed must be finite and above 0; got -1."),
        ((0.182, 0.127, -20.5, 0.1, 0.0), "actuator.seal.contact_force must be finite and 0 or above; got -20.5."),
        ((math.nan, 0.1, 20.5, 0.1, 0.0), "actuator.seal.static_coefficient must be finite and 0 or above; got nan."),
        ((0.2, math.inf, 20.5, 0.1, 0.0), "actuator.seal.coulomb_coefficient must be finite and 0 or above; got inf."),
    ],
)
def test_a_law_that_cannot_be(values: tuple[float, float, float, float, float], sentence: str) -> None:
    with pytest.raises(DesignError) as caught:
        SealFriction(*values)
    assert str(caught.value) == sentence
