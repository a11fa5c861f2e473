"""The field where one asks for it."""

from dataclasses import replace

import numpy as np
import pytest

from fluxbore.fem.field import flux_map, nodal_flux_density
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
    """Catches triangles in another order than their values, and a lost region."""
    picture = flux_map(polynomial.solution)
    mesh = polynomial.solution.problem.mesh
    assert picture.triangles.shape == (4 * mesh.elements.shape[0], 3)
    corners = np.column_stack((picture.r**2 / 2, picture.z))[picture.triangles]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / 2
    s, z = mesh.nodes.T
    assert area.sum() == pytest.approx(s.max() * (z.max() - z.min()))
    middle = corners.mean(axis=1)
    np.testing.assert_allclose(picture.flux_density, np.hypot(5 * np.sqrt(2 * middle[:, 0]), 1 + 10 * middle[:, 1]))
    assert np.array_equal(picture.region[::4], mesh.region)
    assert picture.flux is polynomial.solution.psi


def test_flux_map_has_both_components(polynomial: TubularSolution) -> None:
    """Catches components exchanged, of another sign, or of other triangles than their middles."""
    picture = flux_map(polynomial.solution)
    s, z = (axis[picture.triangles].mean(axis=1) for axis in (picture.r**2 / 2, picture.z))
    np.testing.assert_allclose(picture.components[:, 0], -5 * np.sqrt(2 * s), atol=1e-8)
    np.testing.assert_allclose(picture.components[:, 1], 1 + 10 * z, rtol=1e-6)
    np.testing.assert_allclose(np.hypot(*picture.components.T), picture.flux_density)
