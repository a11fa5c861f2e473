"""The flux function of a helical field: its level lines are field lines, its differences are fluxes."""

from dataclasses import replace

import numpy as np
import pytest
from lead_screws import table_i

from fluxbore.design.helical_field import gap_field
from fluxbore.fem.element import kernel, positions
from fluxbore.fem.helical import HelicalSolution, solve
from fluxbore.fem.helical_flux import flux_function, flux_map
from fluxbore.geometry.lead_screw import helical_section

SCREW = table_i()
APART = SCREW.pitch / 5


@pytest.fixture(scope="module")
def solved() -> HelicalSolution:
    return solve(helical_section(SCREW, APART))


def test_flux_through_the_gap_is_that_of_the_closed_form(solved: HelicalSolution) -> None:
    mesh, psi = solved.system.mesh, flux_function(solved)
    radius = SCREW.radii[1] + SCREW.gap / 2
    on = np.flatnonzero(np.abs(mesh.nodes[:, 0] - radius) < 1e-9)
    assert on.size > 20
    on = on[np.argsort(mesh.nodes[on, 1])]
    zeta = np.linspace(mesh.nodes[on[0], 1], mesh.nodes[on[-1], 1], 4001)
    radial, _, _ = gap_field(SCREW, radius, zeta, APART)
    passed = np.concatenate(([0.0], np.cumsum((radial[1:] + radial[:-1]) / 2 * np.diff(zeta))))
    exact = psi[on[0]] - radius * np.interp(mesh.nodes[on, 1], zeta, passed)
    assert np.ptp(exact) > 1e-5
    np.testing.assert_allclose(psi[on], exact, atol=1e-3 * np.ptp(exact))


def test_a_long_lead_has_field_lines_along_the_helix_too() -> None:
    """h a third of the radius: B_θ counts for a tenth of |B|², and both equations of ψ hold with it."""
    long = replace(SCREW, starts=8)
    found = solve(helical_section(long, APART), 2)
    mesh, psi, b = found.system.mesh, flux_function(found), found.flux_density()
    slopes = np.einsum("mqkn,mn->mqk", kernel(mesh).curl, psi[mesh.elements])
    r, weight = positions(mesh)[..., 0], kernel(mesh).weight
    misses = (slopes[..., 0] - r * b[..., 2] + long.h * b[..., 1], slopes[..., 1] + r * b[..., 0])
    share = sum(float(np.sum(weight * miss**2)) for miss in misses) / float(
        np.sum(weight * (r * np.linalg.norm(b, axis=-1)) ** 2)
    )
    assert np.sqrt(share) < 0.01
    without = slopes[..., 0] - r * b[..., 2]
    assert np.sqrt(np.sum(weight * without**2)) > 5 * np.sqrt(np.sum(weight * misses[0] ** 2))


def test_map_covers_the_window_and_repeats_with_the_pitch(solved: HelicalSolution) -> None:
    start, end = -0.3 * SCREW.pitch, 1.9 * SCREW.pitch
    field = flux_map(solved, start, end)
    assert field.z.min() <= start
    assert field.z.max() >= end
    middles = np.column_stack((field.r[field.triangles].mean(axis=1), field.z[field.triangles].mean(axis=1)))
    grain = 1e-8
    seen = {tuple(place): b for place, b in zip(np.rint(middles / grain).astype(int), field.flux_density, strict=True)}
    assert len(seen) == len(middles)  # no place twice
    turned = np.rint((middles + [0.0, SCREW.pitch]) / grain).astype(int)
    again = [(b, seen.get(tuple(place))) for place, b in zip(turned, field.flux_density, strict=True)]
    pairs = [(b, other) for b, other in again if other is not None]
    assert len(pairs) > len(middles) / 3
    np.testing.assert_allclose([b for b, _ in pairs], [other for _, other in pairs], rtol=1e-9)


def test_magnitude_is_the_solution_s_own(solved: HelicalSolution) -> None:
    """The energy-like mean of |B|² over the mesh, from ψ and from φ."""
    mesh = solved.system.mesh
    field = flux_map(solved, *(float(end(mesh.nodes[:, 1])) for end in (np.min, np.max)))
    corners = np.column_stack((field.r, field.z))[field.triangles]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    mean = np.sum(area * field.flux_density**2) / np.sum(area)
    weight, b = kernel(mesh).weight, solved.flux_density()
    assert mean == pytest.approx(np.sum(weight * np.sum(b**2, axis=-1)) / np.sum(weight), rel=0.01)


def test_components_give_the_magnitude_with_the_helix(solved: HelicalSolution) -> None:
    """Catches components of another sign or order: with B_θ = −(h/r) B_z they give |B|, and field lines follow them."""
    mesh = solved.system.mesh
    field = flux_map(solved, *(float(end(mesh.nodes[:, 1])) for end in (np.min, np.max)))
    places = np.column_stack((field.r, field.z))[field.triangles]
    radial, axial = field.components.T
    around = SCREW.h / places[..., 0].mean(axis=1) * axial
    np.testing.assert_allclose(np.sqrt(radial**2 + axial**2 + around**2), field.flux_density, rtol=0.02)
    # r B_r = −∂ψ/∂ζ in each small triangle.
    (r1, z1), (r2, z2) = (places[:, 1] - places[:, 0]).T, (places[:, 2] - places[:, 0]).T
    psi = field.flux[field.triangles]
    d1, d2 = psi[:, 1] - psi[:, 0], psi[:, 2] - psi[:, 0]
    slope = (r1 * d2 - r2 * d1) / (r1 * z2 - r2 * z1)
    found = -slope / places[..., 0].mean(axis=1)
    assert np.sqrt(np.mean((found - radial) ** 2)) < 0.1 * np.sqrt(np.mean(radial**2))
