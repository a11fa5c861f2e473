"""The field where one asks for it."""

from dataclasses import replace

import numpy as np
import pytest
from nodal_field import nodal_flux_density

from fluxbore.fem.cell_picture import flux_map
from fluxbore.fem.line_field import along_radius
from fluxbore.fem.tubular import TubularSolution


@pytest.fixture(scope="module")
def polynomial(mid_stroke: TubularSolution) -> TubularSolution:
    """The motor's mesh with a made-up field: ψ = s (1 + 10 z), so B_z = 1 + 10 z and B_r = −10 s/r = −5 r."""
    s, z = mid_stroke.solution.problem.mesh.nodes.T
    return replace(mid_stroke, solution=replace(mid_stroke.solution, psi=s * (1 + 10 * z)))


def test_nodal_field_of_a_polynomial(polynomial: TubularSolution) -> None:
    """Catches a sign of B_r, exchanged components, and an axis that is not like the rest."""
    mesh = polynomial.solution.problem.mesh
    nodes, field = nodal_flux_density(polynomial.solution, np.arange(mesh.elements.shape[0]))
    r, z = mesh.positions[nodes].T
    np.testing.assert_allclose(field[:, 0], -5 * r, atol=1e-8)
    np.testing.assert_allclose(field[:, 1], 1 + 10 * z, atol=1e-8)


def test_nodal_field_of_some_elements(polynomial: TubularSolution) -> None:
    """Catches node numbers that belong to other values."""
    mesh = polynomial.solution.problem.mesh
    chosen = np.array([100, 7])
    nodes, field = nodal_flux_density(polynomial.solution, chosen)
    assert set(nodes) == set(mesh.elements[chosen].ravel())
    np.testing.assert_allclose(field[:, 1], 1 + 10 * mesh.nodes[nodes, 1], atol=1e-9)


@pytest.mark.parametrize("outside", [True, False])
@pytest.mark.parametrize("radius", [7.95e-3, 10e-3, 18.5e-3])
def test_field_along_a_line(polynomial: TubularSolution, radius: float, outside: bool) -> None:
    """Catches the wrong strip of elements, and z that do not rise."""
    z, field = along_radius(polynomial.grid, polynomial.solution.psi, radius, outside)
    assert np.all(np.diff(z) > 0)
    assert z.size == polynomial.grid.z_nodes.size
    np.testing.assert_allclose(field, np.column_stack((np.full(z.size, -5 * radius), 1 + 10 * z)), atol=1e-8)


def test_sides_of_an_iron_face_differ_as_they_must(mid_stroke: TubularSolution) -> None:
    """Catches averaging across an interface: at the yoke's bore B_r goes through, H_z does, so B_z jumps."""
    bore = 12.5e-3
    z, air = along_radius(mid_stroke.grid, mid_stroke.solution.psi, bore, outside=False)
    _, iron = along_radius(mid_stroke.grid, mid_stroke.solution.psi, bore, outside=True)
    inner = (z > 0.0) & (z < 0.18)
    assert np.abs(iron[inner, 1]).max() > 20 * np.abs(air[inner, 1]).max()
    assert np.array_equal(iron[:, 0], air[:, 0])


def test_flux_map_of_a_polynomial(polynomial: TubularSolution) -> None:
    """Catches triangles in another order than their values, a hole, and components exchanged or of another sign."""
    picture = flux_map(polynomial)
    corners = np.stack((picture.r, picture.z), axis=-1)[picture.triangles]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / 2
    assert np.all(area > 0)
    assert area.sum() == pytest.approx(picture.r.max() * np.ptp(picture.z))
    r, z = corners.mean(axis=1).T
    np.testing.assert_allclose(picture.components, np.column_stack((-5 * r, 1 + 10 * z)), atol=1e-8)
    np.testing.assert_allclose(np.hypot(*picture.components.T), picture.flux_density)
    np.testing.assert_allclose(picture.flux, picture.r**2 / 2 * (1 + 10 * picture.z), atol=1e-12)


def test_flux_map_keeps_the_regions(mid_stroke: TubularSolution) -> None:
    """Catches a triangle across a face, or in its neighbour's colour: each region has its own volume."""
    picture, cells = flux_map(mid_stroke), mid_stroke.cells
    s = (picture.r**2 / 2)[picture.triangles]
    z = picture.z[picture.triangles]
    area = np.abs((s[:, 1] - s[:, 0]) * (z[:, 2] - z[:, 0]) - (s[:, 2] - s[:, 0]) * (z[:, 1] - z[:, 0])) / 2
    found = np.bincount(picture.region, area)
    expected = np.bincount(cells.region, cells.weight.sum(axis=1))
    assert found == pytest.approx(expected, rel=1e-9)
