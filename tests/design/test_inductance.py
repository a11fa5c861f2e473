"""The winding's own field: Bessel functions of another maker, the planar limit, and the sheet's equation in steps."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_bvp
from scipy.special import ive, kve

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.inductance import phase_inductance, scaled_i, scaled_k, sheet_potential
from fluxbore.design.winding import electric_loading


@given(x=st.floats(0.01, 1e4), order=st.sampled_from([0, 1]))
def test_bessel_functions_against_scipys(x: float, order: int) -> None:
    assert scaled_i(order, x) == pytest.approx(ive(order, x), rel=1e-12, abs=1e-300)
    assert scaled_k(order, x) == pytest.approx(kve(order, x), rel=1e-12)


@given(gap=st.floats(0.05, 3.0))
def test_a_large_radius_is_planar(gap: float) -> None:
    """Catches a wrong sign between the two Bessel functions: mu_0/k / (1 + tanh(k h)) of a sheet below a plate."""
    wave, radius = 250.0, 40.0
    planar = MU_0 / wave / (1 + math.tanh(gap))
    assert sheet_potential(wave, radius, radius + gap / wave) == pytest.approx(planar, rel=1e-3)


def test_the_sheets_field_by_integration() -> None:
    """(1/r (r A)')' = k^2 A on both sides of the sheet, whose current is the jump of (r A)'/r; no Bessel functions."""
    wave, sheet, yoke = math.pi / 0.012, 11.05e-3, 12.5e-3

    def slopes(s, y):
        # s runs from 0 to 1 in both regions: y = A, (r A)'/r inside, then the same two outside.
        inner, outer = 1e-5 + s * (sheet - 1e-5), sheet + s * (yoke - sheet)
        return np.vstack([
            (y[1] - y[0] / inner) * (sheet - 1e-5), wave**2 * y[0] * (sheet - 1e-5),
            (y[3] - y[2] / outer) * (yoke - sheet), wave**2 * y[2] * (yoke - sheet),
        ])  # fmt: skip

    def ends(a, b):
        return np.array([a[0] - a[1] * 0.5e-5, b[0] - a[2], b[1] - a[3] - MU_0, b[3]])

    grid = np.linspace(0, 1, 400)
    guess = np.full((4, 400), 1e-9)
    solved = solve_bvp(slopes, ends, grid, guess, tol=1e-8, max_nodes=200_000)
    assert solved.success
    assert sheet_potential(wave, sheet, yoke) == pytest.approx(solved.sol(1.0)[0], rel=1e-5)


def test_energy_of_the_winding(table_ii: HybridActuator) -> None:
    """Catches a factor 3/2 or a winding factor too many: 3/2 L I^2/2 is the energy 1/2 of A K over the sheet."""
    wave, radius = math.pi / 0.012, 11.05e-3
    loading = electric_loading(table_ii, 1.0)
    potential = sheet_potential(wave, radius, 12.5e-3) * loading
    energy = 0.5 * potential * loading / 2 * 2 * math.pi * radius * 0.192
    assert 0.75 * phase_inductance(table_ii) == pytest.approx(energy, rel=1e-9)
