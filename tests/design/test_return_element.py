"""Return elements: energy is the integral of force, stiffness its slope; rubber at its limits."""

import math

import pytest
from scipy.integrate import quad

from fluxbore.design.errors import DesignError
from fluxbore.design.return_element import ConstantReturn, CordReturn, LinearReturn, ReturnElement

ELEMENTS = [LinearReturn(2840.0, 45.0), ConstantReturn(100.0), CordReturn(0.2, 1e-4, 1.1, 0.2e6, 0.05e6)]


@pytest.mark.parametrize("element", ELEMENTS, ids=lambda e: type(e).__name__)
@pytest.mark.parametrize("extension", [0.01, 0.1, 0.15])
def test_energy_force_and_stiffness_agree(element: ReturnElement, extension: float) -> None:
    work, _ = quad(element.force, 0.0, extension)
    assert element.energy(extension) == pytest.approx(work, rel=1e-9)
    step = 1e-6
    slope = (element.force(extension + step) - element.force(extension - step)) / (2 * step)
    assert element.stiffness(extension) == pytest.approx(slope, rel=1e-6, abs=1e-6)


def test_rubber_starts_with_its_youngs_modulus() -> None:
    """E = 6 (C_1 + C_2) of an incompressible rubber."""
    cord = CordReturn(0.2, 1e-4, 1.0, 0.2e6, 0.05e6)
    assert cord.stiffness(0.0) == pytest.approx(6 * 0.25e6 * 1e-4 / 0.2)
    assert cord.force(0.0) == 0.0


def test_wrong_data_are_told() -> None:
    with pytest.raises(DesignError, match=r"actuator.return_spring.rate must be finite and above 0 N/m; got -1 N/m\."):
        LinearReturn(-1.0)
    with pytest.raises(DesignError, match=r"cord's stretch at 3 or below; got 3.1"):
        CordReturn(0.1, 1e-4, 1.1, 0.2e6, 0.0).force(0.2)
    with pytest.raises(DesignError, match=r"rate must be finite"):
        LinearReturn(math.inf)
