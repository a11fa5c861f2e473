"""Rates in planar iron: a round face, and saturation."""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path
from unittest.mock import patch

import numpy as np
from manufactured import (
    ENERGY_RATE,
    FIELD_RATE,
    NOTHING,
    VACUUM,
    circle,
    field_error,
    levels,
    manufactured,
    over_disc,
    over_rectangle,
    rates,
    slope,
)
from planar_wave import INNER, square, wave, wave_field

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from exact import layers, transverse

from fluxbore.design.bh_curve import BHCurve
from fluxbore.fem.conditions import Conditions, Prescribed
from fluxbore.fem.energy import energies
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.mesh import Floats
from fluxbore.fem.outline import Outline, Seed
from fluxbore.fem.problem import MagneticMaterial
from fluxbore.fem.reluctivity import STEP, ReluctivityCurve, reluctivity_curve


def test_cylinder_in_a_uniform_field() -> None:
    """Catches a round face of planar iron, or prescribed A on a round rim, that costs an order; μ_r = 500."""

    def exact(points: Floats) -> Floats:
        flat = (points[..., 0] + 1j * points[..., 1]).ravel()
        field = np.array([transverse.iron_cylinder(500, 1.0, 0.4, 1.0, complex(z)) for z in flat])
        return np.stack((field.real, field.imag), axis=-1).reshape(points.shape)

    points = np.array([(-1, 0), (1, 0), (-0.4, 0), (0.4, 0)], dtype=float)
    outline = Outline("planar", points, (*circle(0, 0), *circle(2)), (Seed((0.7, 0.1), 0), Seed((0.1, 0.1), 1)))
    rim = Conditions([Prescribed(lambda at: at[:, 1])])
    solved = [manufactured(level, (*VACUUM, MagneticMaterial(1 / 500))) for level in levels(outline, rim, 3)]
    assert slope([field_error(s, exact) for s in solved]) > FIELD_RATE


@cache
def steel() -> ReluctivityCurve:
    """A steel that saturates at 2 T, from a table as dense as its knots: the interpolant's kinks vanish."""
    law, b = layers.Steel(2.0, 50.0), np.arange(0.0, 2.2, STEP)
    with patch("fluxbore.fem.reluctivity._step", return_value=STEP):
        return reluctivity_curve(BHCurve("steel", tuple(b.tolist()), tuple(law.field(float(x)) for x in b), "a test"))


def test_saturated_steel_keeps_the_order() -> None:
    """Catches a tangent or an energy that is not the curve's: J = −div ν(|grad A|²) grad A, up to 1.9 T."""
    curve, size = steel(), 0.2

    def field(points: Floats) -> Floats:
        return size * wave_field(points)

    def density(points: Floats) -> Floats:
        x, y = points[..., 0], points[..., 1]
        s, c, sine, cosine = np.sin(np.pi * x), np.cos(np.pi * x), np.sin(np.pi * y), np.cos(np.pi * y)
        grown = size * np.exp(x)
        xx = ((1 - np.pi**2) * s + 2 * np.pi * c) * sine * grown
        xy = (np.pi * c + s) * np.pi * cosine * grown
        yy = -(np.pi**2) * s * sine * grown
        along, across = np.moveaxis(field(points), -1, 0)  # (∂A/∂y, −∂A/∂x)
        nu, steepness = curve.reluctivity(along**2 + across**2)
        bent = across**2 * xx - 2 * across * along * xy + along**2 * yy
        return np.asarray(-(nu * (xx + yy) + 2 * steepness * bent))

    stored = over_rectangle(lambda p: curve.energy_density(np.linalg.norm(field(p), axis=-1)), (0, 1), (0, 1))
    linked = size * over_disc(wave, *INNER)
    material = MagneticMaterial(curve=curve)
    solved = [manufactured(level, (material,) * 2, density, 1) for level in levels(square(), NOTHING, 4)]
    assert all(s.convergence.converged for s in solved)
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in solved])
    assert slope(errors[:, 0]) > ENERGY_RATE, errors
    assert rates(errors[:, 1])[-1] > ENERGY_RATE, errors  # it changes its sign on the coarser meshes
    assert np.all(rates([field_error(s, field) for s in solved]) > FIELD_RATE)
