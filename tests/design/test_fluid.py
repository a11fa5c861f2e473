"""The fluid: its energy balance against quadrature, its limits, and what a wrong datum says."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from fluxbore.design.errors import DesignError
from fluxbore.design.fluid import (
    Fluid,
    bulk_modulus,
    check_cavitation,
    density,
    specific_enthalpy,
    state_of,
    stored_energy,
    viscosity,
    volume_ratio,
)
from fluxbore.design.units import STANDARD_ATMOSPHERE

FLUID = Fluid(1070.0, 2.8e9, 2.8e-3, 0.95e-3, 299.85, 344.25, air_fraction=0.01)


@pytest.mark.parametrize("exponent", [1.0, 1.2, 1.4])
@pytest.mark.parametrize("pressure", [-0.6e5, 1e5, 26e5, 350e5])
def test_enthalpy_is_the_integral_of_volume(exponent: float, pressure: float) -> None:
    """Would catch a wrong exponent in either closed form, the isothermal one included."""
    fluid = replace(FLUID, air_exponent=exponent)
    exact, _ = quad(lambda p: volume_ratio(fluid, p), 0.0, pressure, epsabs=0, epsrel=1e-11)
    assert specific_enthalpy(fluid, pressure) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("pressure", [-0.5e5, 0.0, 3e5, 70e5])
def test_modulus_is_that_of_the_volume(pressure: float) -> None:
    step = 10.0
    slope = (volume_ratio(FLUID, pressure + step) - volume_ratio(FLUID, pressure - step)) / (2 * step)
    assert bulk_modulus(FLUID, pressure) == pytest.approx(-volume_ratio(FLUID, pressure) / slope, rel=1e-6)


@pytest.mark.parametrize("exponent", [1.0, 1.4])
def test_all_at_once_is_one_by_one(exponent: float) -> None:
    fluid, p = replace(FLUID, air_exponent=exponent), np.array([-0.8e5, 0.0, 2e5, 70e5])
    found = state_of(fluid, p)
    np.testing.assert_allclose(found.ratio, volume_ratio(fluid, p), rtol=1e-14)
    np.testing.assert_allclose(found.enthalpy, specific_enthalpy(fluid, p), rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(found.modulus, bulk_modulus(fluid, p), rtol=1e-13)


def test_stored_energy_is_the_work_of_compression() -> None:
    """-int p ds, which is never negative on either side of the atmosphere's pressure."""
    p = np.linspace(0.0, 26e5, 4001)
    work = -np.trapezoid(p, volume_ratio(FLUID, p))
    assert stored_energy(FLUID, 26e5) == pytest.approx(work, rel=1e-5)
    assert np.all(stored_energy(FLUID, np.linspace(-0.9e5, 100e5, 50)) >= -1e-9)


def test_air_softens_at_low_pressure_and_is_gone_at_high() -> None:
    """Merritt's limits: n P/a of the air alone at the atmosphere, the liquid's own modulus at last."""
    soft = replace(FLUID, bulk_modulus=1e13)
    assert bulk_modulus(soft, 0.0) == pytest.approx(1.4 * STANDARD_ATMOSPHERE / 0.01, rel=1e-3)
    dry = replace(FLUID, air_fraction=0.0)
    assert bulk_modulus(FLUID, 1000e5) == pytest.approx(bulk_modulus(dry, 1000e5), rel=0.01)
    assert bulk_modulus(FLUID, 26e5) < 0.8 * bulk_modulus(dry, 26e5)


def test_viscosity_passes_through_its_points_and_between_others() -> None:
    """Half glycol by volume: 1.5 mPa s at 48.9 degC in the same table, within a tenth."""
    assert viscosity(FLUID, 299.85) == pytest.approx(2.8e-3)
    assert viscosity(FLUID, 344.25) == pytest.approx(0.95e-3)
    assert viscosity(FLUID, 322.05) == pytest.approx(1.5e-3, rel=0.1)


def test_density_rises_with_pressure_and_falls_with_heat() -> None:
    fluid = replace(FLUID, air_fraction=0.0, expansion=5e-4)
    assert density(fluid, 299.85) == pytest.approx(1070.0)
    assert density(fluid, 299.85, 100e5) == pytest.approx(1070 * (1 + 100e5 / 2.8e9), rel=1e-4)
    assert density(fluid, 319.85) == pytest.approx(1070 / 1.01)


def test_wrong_data_are_told() -> None:
    with pytest.raises(DesignError, match=r"actuator.fluid.density must be finite and above 0; got 0\."):
        replace(FLUID, density=0.0)
    with pytest.raises(DesignError, match=r"actuator.fluid.air_fraction must be from 0 to 0.5; got 0.7\."):
        replace(FLUID, air_fraction=0.7)
    with pytest.raises(DesignError, match=r"hot_temperature must exceed"):
        replace(FLUID, hot_temperature=280.0)
    with pytest.raises(DesignError, match=r"actuator.fluid.viscosity must be finite"):
        replace(FLUID, viscosity=math.nan)


def test_cavitation_is_told() -> None:
    check_cavitation(FLUID, -0.98e5, "The pressure")
    with pytest.raises(DesignError, match=r"must not fall below the fluid's vapour pressure, -0.09903"):
        check_cavitation(FLUID, -0.995e5, "The pressure of the output cylinder")
