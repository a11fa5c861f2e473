"""Pressure drops: Hagen-Poiseuille, Haaland against Colebrook, the orifice's own equation, and no jumps between."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from fluxbore.design.errors import DesignError
from fluxbore.design.flow_resistance import Orifice, friction_factor, hose_resistance, orifice_resistance

RHO, MU = 1070.0, 2.8e-3


def test_slow_flow_is_hagen_poiseuille() -> None:
    R = hose_resistance(6e-3, 0.5, 1e-6, 1e-6, RHO, MU)
    assert pytest.approx(128 * MU * 0.5 / (math.pi * 6e-3**4)) == R
    assert hose_resistance(6e-3, 0.5, 1e-6, 0.0, RHO, MU) == R


@pytest.mark.parametrize("reynolds", [4e3, 1e4, 1e5, 1e7])
@pytest.mark.parametrize("roughness", [0.0, 1e-3, 1e-2])
def test_turbulent_factor_is_near_colebrooks(reynolds: float, roughness: float) -> None:
    """Haaland (1983) is within 2 % of the implicit equation over its range."""

    def colebrook(f: float) -> float:
        return 1 / math.sqrt(f) + 2 * math.log10(roughness / 3.7 + 2.51 / (reynolds * math.sqrt(f)))

    assert friction_factor(reynolds, roughness) == pytest.approx(brentq(colebrook, 1e-3, 1.0), rel=0.021)


def test_no_jump_from_laminar_to_turbulent() -> None:
    """A jump of the drop would stop an implicit solver."""
    for Re in (2000.0, 4000.0):
        assert friction_factor(Re * (1 + 1e-9), 1e-4) == pytest.approx(friction_factor(Re * (1 - 1e-9), 1e-4), rel=1e-7)
    flow = np.linspace(1e-7, 2e-4, 500)
    drop = [hose_resistance(6e-3, 0.5, 1e-6, float(q), RHO, MU) * q for q in flow]
    assert np.all(np.diff(drop) > 0)


@pytest.mark.parametrize("flow", [1e-8, 1e-6, 7e-5, -7e-5])
def test_orifice_solves_its_equation(flow: float) -> None:
    orifice = Orifice(4.5e-3)
    drop = orifice_resistance(orifice, flow, RHO, MU) * flow
    area, C_d, Re_cr = math.pi / 4 * 4.5e-3**2, 0.7, 12.0
    critical = RHO / 2 * (Re_cr * MU / RHO / (C_d * 4.5e-3)) ** 2
    back = C_d * area * math.sqrt(2 / RHO) * drop / (drop**2 + critical**2) ** 0.25
    assert back == pytest.approx(flow, rel=1e-9)


def test_orifices_in_a_row_add() -> None:
    one, three = Orifice(4e-3), Orifice(4e-3, count=3)
    assert orifice_resistance(three, 5e-5, RHO, MU) == pytest.approx(3 * orifice_resistance(one, 5e-5, RHO, MU))


def test_wrong_data_are_told() -> None:
    with pytest.raises(DesignError, match=r"diameter of an orifice must be finite and above 0 m; got -0.001 m"):
        Orifice(-1e-3)
    with pytest.raises(DesignError, match=r"discharge coefficient"):
        Orifice(1e-3, 1.5)
