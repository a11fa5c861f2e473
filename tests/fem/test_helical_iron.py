"""Permeability by field strength: the same curve as for vector potentials, the other way round."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.design.materials import standard
from fluxbore.fem.helical_iron import coenergy_density, flux_density, permeability
from fluxbore.fem.reluctivity import VACUUM_PERMEABILITY, ReluctivityCurve, reluctivity_curve

CURVES = {name: reluctivity_curve(m.curve) for name, m in standard().items() if m.curve is not None}
H = np.concatenate(([0.0], np.geomspace(1e-6, 1e7, 4000)))


@pytest.mark.parametrize("name", CURVES)
def test_b_of_h_undoes_h_of_b(name: str) -> None:
    """Catches a root that was not found: on the steepest piece of a table, at its knee, and beyond its end."""
    curve = CURVES[name]
    b, slope = flux_density(curve, H)
    assert np.allclose(curve.field_strength(b), H, rtol=1e-12, atol=1e-9)
    assert np.all(np.diff(b) > 0)
    assert slope[-1] == pytest.approx(VACUUM_PERMEABILITY, rel=1e-12)


def test_b_at_a_knot() -> None:
    """Catches a knot that belongs to neither of its intervals."""
    curve = CURVES["1010"]
    b, _ = flux_density(curve, curve.coefficients[0])
    assert np.allclose(b, curve.step * np.arange(b.size), rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", CURVES)
def test_slope_is_the_derivative_of_the_permeability(name: str) -> None:
    """Catches a Newton's tangent that is not that of the residual."""
    squared = np.geomspace(1e2, 1e12, 400)
    step = 1e-5 * squared
    _, slope = permeability(CURVES[name], squared)
    ahead, behind = (permeability(CURVES[name], squared + part)[0] for part in (step, -step))
    mu, _ = permeability(CURVES[name], squared)
    assert np.allclose(slope * squared, (ahead - behind) / 2e-5, rtol=2e-3, atol=2e-5 * mu)


def test_the_differential_permeability_is_positive() -> None:
    """Catches a tangent that is not positive definite: μ + 2 H² dμ/d(H²) = dB/dH."""
    for curve in CURVES.values():
        mu, slope = permeability(curve, H**2)
        assert np.all(mu + 2 * H**2 * slope > 0)


def test_coenergy_is_what_b_adds_up_to() -> None:
    """Catches energy taken for coenergy: d/dH of it is B, and with the energy it makes up B H."""
    curve: ReluctivityCurve = CURVES["1010"]
    h = np.geomspace(1.0, 1e6, 300)
    b, _ = flux_density(curve, h)
    ahead, behind = (coenergy_density(curve, (h * (1 + part)) ** 2) for part in (1e-5, -1e-5))
    assert np.allclose((ahead - behind) / (2e-5 * h), b, rtol=1e-5)
    assert np.allclose(coenergy_density(curve, h**2), curve.coenergy_at(h), rtol=1e-6)
