"""Heat to still air: published Nusselt numbers and the air of the tables."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.convection import STEFAN_BOLTZMANN, air, heat_transfer, nusselt


def test_churchill_and_chu_as_others_evaluate_it() -> None:
    """The value that the documentation of the library ht prints for Pr = 0.69, Gr = 2.63e9."""
    assert nusselt(0.69 * 2.63e9, 0.69) == pytest.approx(139.13493970073597, rel=1e-9)


@pytest.mark.parametrize(
    ("kelvin", "conductivity", "viscosity", "prandtl"),
    [(300, 26.3e-3, 15.89e-6, 0.707), (350, 30.0e-3, 20.92e-6, 0.700), (400, 33.8e-3, 26.41e-6, 0.690)],
)
def test_air_against_the_tables_of_a_textbook(
    kelvin: float, conductivity: float, viscosity: float, prandtl: float
) -> None:
    """Incropera and DeWitt, Fundamentals of Heat and Mass Transfer, table A.4."""
    gas = air(kelvin)
    assert gas.conductivity == pytest.approx(conductivity, rel=0.02)
    assert gas.kinematic_viscosity == pytest.approx(viscosity, rel=0.02)
    assert gas.prandtl == pytest.approx(prandtl, rel=0.03)


@given(surface=st.floats(250, 600), ambient=st.floats(250, 350))
def test_radiation_adds_the_law_of_stefan_and_boltzmann(surface: float, ambient: float) -> None:
    black, bright = (heat_transfer(0.027, surface, ambient, emissivity) for emissivity in (1.0, 0.0))
    radiated = (black - bright) * (surface - ambient)
    assert radiated == pytest.approx(STEFAN_BOLTZMANN * (surface**4 - ambient**4), rel=1e-6, abs=1e-6)


def test_a_finger_thick_rod_gives_off_what_handbooks_say() -> None:
    """5 to 10 W/(m^2 K) of natural convection, rising with the temperature; finite where there is no difference."""
    values = [heat_transfer(0.027, 293.15 + rise, 293.15, 0.0) for rise in (1e-9, 5, 20, 60, 100)]
    assert values == sorted(values)
    assert 0 < values[0] < 2
    assert 5 < values[2] < 10
    assert 5 < values[4] < 12
