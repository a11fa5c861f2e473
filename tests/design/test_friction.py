"""The seals' friction: the paper's numbers."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.friction import SealFriction, kinetic_friction

TABLE_IV = SealFriction(0.182, 0.127, 20.5, 0.00132, 0.0)


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
    assert kinetic_friction(TABLE_IV, 20.6e-6, pressure, speed) == pytest.approx(force, rel=1e-9)


@given(pressure=st.floats(0, 1e6), slow=st.floats(0, 0.01), faster=st.floats(0, 0.01))
def test_friction_falls_with_speed_and_grows_with_pressure(pressure: float, slow: float, faster: float) -> None:
    """Catches swapped coefficients and a pressure that relieves the seal."""

    def friction(at_pressure: float, speed: float) -> float:
        return kinetic_friction(TABLE_IV, 20.6e-6, at_pressure, speed)

    assert friction(pressure, slow) >= friction(pressure, slow + faster)
    assert friction(pressure + 1e5, slow) > friction(pressure, slow)


def test_the_viscous_part_adds() -> None:
    law = SealFriction(0.182, 0.127, 20.5, 0.00132, 3.0)
    assert kinetic_friction(law, 0.0, 0.0, 0.5) - kinetic_friction(TABLE_IV, 0.0, 0.0, 0.5) == pytest.approx(1.5)
