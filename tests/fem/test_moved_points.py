"""Sums over points of elements by single nodes: elements whose nodes move each for itself, curved ones too."""

import numpy as np
import pytest
from small_motor import difference, small_section, solved

from fluxbore.fem.element import QUADRATURE_POINTS, kernel, shape
from fluxbore.fem.field import CORNERS_AND_MIDDLES
from fluxbore.fem.mesh import Mesh
from fluxbore.fem.moved_points import node_derivative

Array = np.ndarray


class Case:
    """Two fields on some elements away from the axis."""

    def __init__(self) -> None:
        self.mesh = solved(small_section()).grid.mesh
        s = self.mesh.nodes[:, 0]
        rng = np.random.default_rng(5)
        self.psi, self.phi = s * rng.uniform(-1, 1, s.size), s * rng.uniform(-1, 1, s.size)
        self.elements = np.flatnonzero(s[self.mesh.elements].min(axis=1) > 1e-6)[::7]
        self.nodes = np.unique(self.mesh.elements[self.elements])[::5]

    def moved(self, node: int, axis: int, step: float) -> Mesh:
        nodes = self.mesh.nodes.copy()
        nodes[node, axis] += step
        return Mesh(self.mesh.chart, nodes, self.mesh.region, self.mesh.topology)

    def fields(self, mesh: Mesh, points: Array) -> tuple[Array, Array, Array, Array]:
        """Rows (m, 2 q, 6), weight (m, q) and the fields' rows (m, q, 2) at points of the elements."""
        found = kernel(mesh, self.elements, points)
        places = mesh.elements[self.elements]
        psi, phi = (np.einsum("mqkn,mn->mqk", found.curl, field[places]) for field in (self.psi, self.phi))
        return found.curl.reshape(self.elements.size, -1, 6), found.weight, psi, phi

    def check(self, found: Array, value_of: object) -> None:
        """Against differences by some nodes; nodes far from the elements have none."""
        assert callable(value_of)
        reach = np.ptp(self.mesh.nodes[self.mesh.elements[self.elements]], axis=1).min(axis=0)
        for node in self.nodes:
            for axis in range(2):
                expected = float(difference(lambda h: value_of(self.moved(node, axis, h)), 1e-3 * reach[axis]))  # noqa: B023
                assert found[node, axis] == pytest.approx(expected, rel=1e-6, abs=1e-8 * np.abs(found[:, axis]).max())
        apart = np.setdiff1d(np.arange(found.shape[0]), self.mesh.elements[self.elements])
        assert not found[apart].any()


@pytest.fixture(scope="module")
def case() -> Case:
    return Case()


def test_an_integral(case: Case) -> None:
    """Catches an area that stays: ∫ B(ψ)·B(φ) + (B(ψ)·B(ψ))², whose points carry their weights along."""

    def density(psi: Array, phi: Array) -> Array:
        return np.sum(psi * phi, axis=-1) + np.sum(psi**2, axis=-1) ** 2

    def value(mesh: Mesh) -> float:
        _, weight, psi, phi = case.fields(mesh, QUADRATURE_POINTS)
        return float(np.sum(weight * density(psi, phi)))

    rows, weight, psi, phi = case.fields(case.mesh, QUADRATURE_POINTS)
    by_psi = phi + 4 * np.sum(psi**2, axis=-1, keepdims=True) * psi
    pairs = ((by_psi, psi), (psi, phi))
    found = node_derivative(case.mesh, case.elements, rows, weight, shape(QUADRATURE_POINTS), pairs, density(psi, phi))
    case.check(found, value)


def test_a_sum_of_samples(case: Case) -> None:
    """Catches weights that grow where points are only asked: Σ |B|² at corners and middles."""

    def value(mesh: Mesh) -> float:
        return float(np.sum(case.fields(mesh, CORNERS_AND_MIDDLES)[2] ** 2))

    rows, _, psi, _ = case.fields(case.mesh, CORNERS_AND_MIDDLES)
    ones = np.ones(psi.shape[:2])
    found = node_derivative(case.mesh, case.elements, rows, ones, shape(CORNERS_AND_MIDDLES), ((2 * psi, psi),))
    case.check(found, value)
