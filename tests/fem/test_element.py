"""The quadratic triangle: reproduction of polynomials, quadrature, kernel derivatives, element matrices."""

from collections.abc import Callable
from math import factorial

import numpy as np
import pytest

from fluxbore.fem.element import (
    QUADRATURE_POINTS,
    QUADRATURE_WEIGHTS,
    flux_density_squared,
    kernel,
    shape,
    shape_derivatives,
    stiffness,
)
from fluxbore.fem.linear import factorise
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Mesh, Topology

Build = Callable[..., MappedMesh]

NODES = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.5, 0.5, 0], [0, 0.5, 0.5], [0.5, 0, 0.5]])


def crooked_triangle(chart: str) -> Mesh:
    """One element with curved edges, off the axis."""
    nodes = np.array([[0.2, 0.1], [1.1, 0.3], [0.4, 1.2], [0.7, 0.12], [0.8, 0.8], [0.33, 0.6]])
    topology = Topology(np.arange(6)[None], np.arange(6))
    return Mesh("planar" if chart == "planar" else "axisymmetric", nodes, np.zeros(1, dtype=int), topology)


def test_shape_functions_are_one_at_their_own_node() -> None:
    """Catches an exchange of nodes: edge middles in another order than the mesh's."""
    assert shape(NODES) == pytest.approx(np.eye(6))


def test_shape_derivatives_against_differences() -> None:
    """Catches a wrong derivative of any shape function."""
    b = np.random.default_rng(1).dirichlet((1, 1, 1), 10)
    step = 1e-6
    for k, along in enumerate(([-1, 1, 0], [-1, 0, 1])):
        move = step * np.array(along)
        differences = (shape(b + move) - shape(b - move)) / (2 * step)
        assert shape_derivatives(b)[..., k] == pytest.approx(differences, abs=1e-9)


@pytest.mark.parametrize("degree", range(6))
def test_quadrature_is_exact_to_degree_five(degree: int) -> None:
    """Catches a digit in a point or weight: ∫ b^i c^j over the unit triangle is i! j! / (i + j + 2)!."""
    for i in range(degree + 1):
        j = degree - i
        rule = QUADRATURE_WEIGHTS @ (QUADRATURE_POINTS[:, 1] ** i * QUADRATURE_POINTS[:, 2] ** j) / 2
        assert rule == pytest.approx(factorial(i) * factorial(j) / factorial(i + j + 2), rel=1e-14)


def test_quadrature_is_not_exact_beyond_degree_five() -> None:
    """Catches a test of degree that would pass with anything."""
    rule = QUADRATURE_WEIGHTS @ QUADRATURE_POINTS[:, 1] ** 6 / 2
    assert rule != pytest.approx(factorial(6) / factorial(8), rel=1e-6)


@pytest.mark.parametrize("chart", ["planar", "axisymmetric"])
def test_kernel_is_the_derivative_of_psi(chart: str) -> None:
    """Catches a transposed Jacobian or a lost 1/r, on a curved element: B against differences of ψ in space."""
    mesh = crooked_triangle(chart)
    psi = np.random.default_rng(2).normal(size=6)
    point = np.array([[0.3, 0.45, 0.25]])
    curl = kernel(mesh, None, point).curl[0, 0]
    base = shape_derivatives(point)[0]
    jacobian = mesh.nodes.T @ base  # chart by reference
    step = 1e-6

    def value(offset: np.ndarray) -> float:
        """ψ a small step away in the chart: the reference point follows by Newton's method."""
        target = shape(point)[0] @ mesh.nodes + offset
        bc = point[0, 1:].copy()
        for _ in range(20):
            here = np.array([[1 - bc.sum(), *bc]])
            bc -= np.linalg.solve(jacobian, shape(here)[0] @ mesh.nodes - target)
        return float(shape(np.array([[1 - bc.sum(), *bc]]))[0] @ psi)

    along = [(value(step * e) - value(-step * e)) / (2 * step) for e in np.eye(2)]
    if chart == "axisymmetric":
        along[1] /= np.sqrt(2 * (shape(point)[0] @ mesh.nodes)[0])
    assert curl @ psi == pytest.approx(along, rel=1e-7)


@pytest.mark.parametrize("chart", ["planar", "axisymmetric"])
def test_weights_sum_to_the_area(chart: str) -> None:
    """Catches a lost half or determinant, on straight elements."""
    mesh = crooked_triangle(chart)
    a, b, c = mesh.nodes[:3]
    middles = [(a + b) / 2, (b + c) / 2, (c + a) / 2]
    straight = Mesh(mesh.chart, np.vstack((a, b, c, *middles)), mesh.region, mesh.topology)
    area = abs((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]) / 2
    assert kernel(straight).weight.sum() == pytest.approx(area)


@pytest.mark.parametrize("growth", [1.0, 1.5])
def test_uniform_field_is_exact_up_to_the_axis(block: Build, growth: float) -> None:
    """Patch test: ψ = B s prescribed on the rim gives B_z = B, B_r = 0 in every element, those at the axis too."""
    mesh = block(5, growth).mesh
    topology = mesh.topology
    exact = 1.3 * mesh.nodes[:, 0]
    element = kernel(mesh)
    matrices = stiffness(element.curl, element.weight)
    rim = np.where(topology.freedom < 0, exact, 0.0)
    pull = np.einsum("mij,mj->mi", matrices, rim[topology.elements])
    load = -np.bincount(topology.elements.ravel(), pull.ravel(), rim.size)[topology.nodes_of_freedom]
    psi = rim.copy()
    psi[topology.nodes_of_freedom] = factorise(topology.pattern, topology.pattern.assemble(matrices)).solve(load)
    field, squared = flux_density_squared(element.curl, psi[topology.elements])
    assert field[..., 0] == pytest.approx(1.3, rel=1e-10)
    assert field[..., 1] == pytest.approx(0.0, abs=1e-9)
    assert squared == pytest.approx(1.69, rel=1e-9)


def test_planar_linear_potential_is_exact(block: Build) -> None:
    """Patch test in the planar chart: A = p x + q y gives B = (q, −p), which the frame holds as (p, q)."""
    grid = block(3)
    mesh = Mesh("planar", grid.mesh.nodes, grid.mesh.region, grid.mesh.topology)
    a = 0.4 * mesh.nodes[:, 0] - 0.7 * mesh.nodes[:, 1]
    field, _ = flux_density_squared(kernel(mesh).curl, a[mesh.elements])
    assert field == pytest.approx(np.broadcast_to([0.4, -0.7], field.shape), abs=1e-12)


@pytest.mark.parametrize("chart", ["planar", "axisymmetric"])
def test_element_matrices_are_symmetric_and_do_not_see_a_constant(chart: str) -> None:
    """Catches a kernel that mixes up trial and test function, or a field from a constant ψ."""
    element = kernel(crooked_triangle(chart))
    factor = element.weight * np.random.default_rng(3).uniform(0.5, 2, element.weight.shape)
    (matrix,) = stiffness(element.curl, factor)
    assert matrix == pytest.approx(matrix.T, rel=1e-13)
    assert matrix @ np.ones(6) == pytest.approx(np.zeros(6), abs=1e-12 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix)[1] > 0


def test_stiffness_is_the_energy(block: Build) -> None:
    """Catches a factor in the element matrices: ψᵀ K ψ is ∫ ν |B|² by the same quadrature."""
    mesh = block(3).mesh
    element = kernel(mesh)
    psi = np.random.default_rng(4).normal(size=mesh.nodes.shape[0])[mesh.elements]
    nu = np.random.default_rng(5).uniform(1, 2, element.weight.shape)
    energy = np.einsum("mi,mij,mj->", psi, stiffness(element.curl, nu * element.weight), psi)
    assert energy == pytest.approx(np.sum(nu * element.weight * flux_density_squared(element.curl, psi)[1]))


def test_some_elements_and_some_points(block: Build) -> None:
    """Catches a kernel of chosen elements that belongs to others, and a division by zero on the axis itself."""
    mesh = block(3).mesh
    chosen = np.array([7, 2])
    assert kernel(mesh, chosen).curl == pytest.approx(kernel(mesh).curl[chosen])
    assert np.all(np.isfinite(kernel(mesh, None, NODES).curl))
