"""Reverse field in a lead screw's magnets, and the flux along its iron: by other routes on the same fields."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from lead_screws import PITCH, table_i

from fluxbore.design.helical_field import GAP, ROTOR, TRANSLATOR, gap_field, harmonics, pattern, stack
from fluxbore.design.lead_screw_figures import along_iron, back_iron_flux_density
from fluxbore.design.materials import standard
from fluxbore.design.radial_stack import solve as closed
from fluxbore.fem.element import positions
from fluxbore.fem.helical import HelicalSolution, solve
from fluxbore.fem.helical_flux import flux_function
from fluxbore.fem.helical_iron_flux import layer_flux
from fluxbore.fem.helical_magnets import demagnetised_fraction, mean_load, reverse_load
from fluxbore.fem.reluctivity import VACUUM_PERMEABILITY
from fluxbore.geometry.lead_screw import helical_section

SCREW = table_i()


@pytest.fixture(scope="module")
def slipping() -> HelicalSolution:
    """Ideal iron, half a pitch from rest; layers: translator magnets, gap, rotor magnets."""
    return solve(helical_section(SCREW, PITCH / 2))


def test_the_load_is_that_of_the_flux_density(slipping: HelicalSolution) -> None:
    """H by the recoil line, (B − B_rem)/(μ0 μ_r), with its sign; catches a field that helps counted as one against."""
    weight, load = reverse_load(slipping, {0: 2.0, 2: 2.0})
    elements = np.flatnonzero(np.isin(slipping.system.grid.layer, (0, 2)))
    remanence = slipping.system.remanence[elements]
    h = (slipping.flux_density(elements)[..., 0] - remanence) / (1.05 * VACUUM_PERMEABILITY)
    expected = np.sort((-np.sign(remanence) * h / 2.0).ravel())
    assert np.allclose(np.sort(load), expected, rtol=1e-9, atol=1e-3)
    inner, outer, bore, rim = SCREW.radii
    # Half a period of both rings, per radian.
    assert weight.sum() == pytest.approx((outer**2 - inner**2 + rim**2 - bore**2) / 2 * PITCH / 2, rel=1e-12)


def test_spaces_between_magnets_are_left_out() -> None:
    magnets = replace(SCREW.translator, magnet_width=PITCH / 4)
    found = solve(helical_section(replace(SCREW, translator=magnets), PITCH / 2))
    weight, _ = reverse_load(found, {0: 1e6})
    inner, outer, _, _ = SCREW.radii
    assert weight.sum() == pytest.approx((outer**2 - inner**2) / 2 * PITCH / 4, rel=1e-12)


def test_slipping_is_worse_than_rest(slipping: HelicalSolution) -> None:
    """Equal poles face each other only half a pitch on; each member on its own bears more there."""
    rest = solve(helical_section(SCREW, 0.0))
    for layer in (0, 2):
        opposed, helped = (mean_load(*reverse_load(item, {layer: 1e6}), 8.0) for item in (slipping, rest))
        assert opposed > 1.1 * helped


def test_mean_reverse_field_in_closed_form(slipping: HelicalSolution) -> None:
    """The mean over a magnet's faces of the field against it, from the harmonics' potentials: ∫ r H_r dr of the closed
    form, integrated by parts in the radius alone, against the same integral of the elements."""
    wave, order = harmonics(SCREW, across=False)
    field = closed(stack(SCREW), wave, order)
    count = len(wave)
    own, other = (pattern(SCREW, member, count) for member in (SCREW.translator, SCREW.rotor))
    # Over the translator's north magnet, cos(k ζ) has the mean sin(k w/2)/(k w/2); the rotor's poles are reversed.
    shape = np.sin(wave * PITCH / 4) / (wave * PITCH / 4)
    potentials = field.potentials(TRANSLATOR) * own[:, None] - field.potentials(ROTOR) * other[:, None]
    # ∫ H_r dr over the layer is the drop of the potential.
    drop = float(np.sum(shape * (potentials[:, TRANSLATOR] - potentials[:, GAP])))
    elements = np.flatnonzero(slipping.system.grid.layer == 0)
    remanence = slipping.system.remanence[elements]
    r = positions(slipping.system.mesh, elements)[..., 0]
    area = slipping.system.kernel.weight[elements] / r
    against = np.sign(remanence) * slipping.field_strength(elements)[..., 0]
    assert float(np.sum(area * against) / (PITCH / 2)) == pytest.approx(drop, rel=2e-3)
    assert drop < 0
    radius = SCREW.translator_radius + SCREW.gap / 2
    assert abs(gap_field(SCREW, radius, 0.0, PITCH / 2)[0]) < abs(gap_field(SCREW, radius, 0.0, 0.0)[0])


def test_the_share_beyond_counts_volume() -> None:
    weight, load = np.array([1.0, 2.0, 5.0]), np.array([0.5, 1.5, -3.0])
    assert demagnetised_fraction(weight, load) == pytest.approx(0.25)
    assert mean_load(weight, load, 2.0) == pytest.approx(((0.25 + 2 * 2.25) / 8) ** 0.5)
    assert mean_load(weight, -np.abs(load), 8.0) == 0.0


def test_flux_along_thick_iron_in_closed_form() -> None:
    """Against iron of infinite permeability by Bessel functions; catches another layer, or a helix taken for rings."""
    screw = replace(SCREW, starts=6)
    steel = standard()["1010"].curve
    found = solve(helical_section(screw, 0.0, steel, steel))
    psi = flux_function(found)
    for layer, expected in zip((1, 5), back_iron_flux_density(screw), strict=True):
        inner, outer = found.section.radii[layer : layer + 2]
        assert along_iron(screw, layer_flux(found, psi, layer), inner, outer) == pytest.approx(expected, rel=0.01)
