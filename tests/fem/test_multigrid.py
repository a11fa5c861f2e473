"""Multigrid: against a factorisation, where the matrix jumps, is stretched, tied or unsound; iterations and size."""

from collections.abc import Callable

import numpy as np
import pytest

from fluxbore.fem.element import kernel, stiffness
from fluxbore.fem.factors import BandedCholesky, SingularMatrixError, SuperLU
from fluxbore.fem.linear import Corrected, choose, factorise
from fluxbore.fem.magnetostatics import Settings, Solution, solve
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Mesh, Topology
from fluxbore.fem.multigrid import Multigrid
from fluxbore.fem.pattern import Pattern, near_numbering

IRON = 1e-4
"""Reluctivity relative to that of air."""


def shaken(grid: MappedMesh, seed: int) -> Mesh:
    """The grid's mesh as a mesher's: corners moved, middles between them again, nodes numbered at random."""
    rng = np.random.default_rng(seed)
    mesh = grid.mesh
    nodes = mesh.nodes.copy()
    inner = mesh.topology.freedom >= 0
    spacing = np.array([np.diff(grid.r_nodes).min(), np.diff(grid.z_nodes).min()])
    nodes[inner] += rng.uniform(-0.4, 0.4, (np.count_nonzero(inner), 2)) * spacing
    corners = mesh.elements[:, :3]
    nodes[mesh.elements[:, 3:]] = (nodes[corners] + nodes[np.roll(corners, -1, axis=1)]) / 2
    place = rng.permutation(nodes.shape[0])
    moved, free = np.empty_like(nodes), np.empty_like(inner)
    moved[place], free[place] = nodes, inner
    freedom = np.where(free, np.cumsum(free) - 1, -1)
    return Mesh(mesh.chart, moved, mesh.region, Topology(place[mesh.elements], freedom))


def matrix_with_iron(mesh: Mesh) -> Floats:
    """(nnz,) with a ring of iron in the mesh's middle."""
    middle = mesh.nodes[mesh.elements[:, :3]].mean(axis=1)
    low, high = 0.25 * mesh.nodes.max(axis=0), 0.6 * mesh.nodes.max(axis=0)
    iron = np.all((middle > low) & (middle < high), axis=1)
    assert 0 < np.count_nonzero(iron) < iron.size
    parts = kernel(mesh)
    return mesh.topology.pattern.assemble(stiffness(parts.curl, parts.weight * np.where(iron, IRON, 1.0)[:, None]))


def noise(pattern: Pattern, columns: int | None = None) -> Floats:
    return np.random.default_rng(3).normal(size=(pattern.unknowns, *([] if columns is None else [columns])))


@pytest.mark.parametrize("columns", [None, 2])
def test_equals_a_factorisation(block: Callable[..., MappedMesh], columns: int | None) -> None:
    """Catches an iteration that stops early, and one that spoils its right side."""
    mesh = shaken(block(16), 0)
    pattern, values = mesh.topology.pattern, matrix_with_iron(mesh)
    right = noise(pattern, columns)
    kept = right.copy()
    exact = SuperLU(pattern, values).solve(right)
    assert np.abs(Multigrid(pattern, values).solve(right) - exact).max() < 1e-8 * np.abs(exact).max()
    assert np.array_equal(right, kept)
    assert Multigrid(pattern, values).solve(np.zeros_like(right)) == pytest.approx(np.zeros_like(right))


def test_iterations_hardly_depend_on_the_size(block: Callable[..., MappedMesh]) -> None:
    """Catches coarse grids that carry nothing: conjugate gradients alone would double with each refinement."""
    counts = []
    for cells in (16, 32, 64):
        mesh = shaken(block(cells), cells)
        pattern = mesh.topology.pattern
        hierarchy = Multigrid(pattern, matrix_with_iron(mesh))
        hierarchy.solve(noise(pattern))
        counts.append(hierarchy.iterations)
    assert max(counts) < 40
    assert counts[2] <= counts[1] + 4


def test_stretched_cells(in_triangles: Solution) -> None:
    """Catches aggregation across weak couplings: the motor's cells are far from square."""
    system = in_triangles.triangles
    values = system.tangent_values(in_triangles.psi[system.inner])
    hierarchy = Multigrid(system.pattern, values)
    found = hierarchy.solve(system.load)
    exact = BandedCholesky(system.pattern, values).solve(system.load)
    assert hierarchy.iterations < 50
    assert np.abs(found - exact).max() < 1e-8 * np.abs(exact).max()


def test_antiperiodic_pairs(block: Callable[..., MappedMesh]) -> None:
    """Catches coarse grids that take neighbours across an antiperiodic boundary for equal."""
    grid = block(24)
    mesh = grid.mesh
    rows, columns = grid.z_nodes.size, grid.r_nodes.size
    freedom = np.full(rows * columns, -1)
    j = np.arange(1, columns - 1)
    freedom[grid.node(np.arange(rows)[:, None], j)] = np.arange(rows * j.size).reshape(rows, -1)
    sign = np.ones(rows * columns, dtype=int)
    freedom[grid.node(rows - 1, j)] = freedom[grid.node(0, j)]
    sign[grid.node(rows - 1, j)] = -1
    tied = Mesh(mesh.chart, mesh.nodes, mesh.region, Topology(mesh.elements, freedom, sign))
    pattern, values = tied.topology.pattern, matrix_with_iron(tied)
    hierarchy = Multigrid(pattern, values)
    right = noise(pattern)
    found, exact = hierarchy.solve(right), SuperLU(pattern, values).solve(right)
    assert hierarchy.iterations < 40
    assert np.abs(found - exact).max() < 1e-8 * np.abs(exact).max()


def test_the_same_digits_twice(block: Callable[..., MappedMesh]) -> None:
    """Catches a hierarchy that depends on random numbers."""
    mesh = shaken(block(16), 1)
    pattern, values = mesh.topology.pattern, matrix_with_iron(mesh)
    first, second = (Multigrid(pattern, values).solve(noise(pattern)) for _ in range(2))
    assert np.array_equal(first, second)


@pytest.mark.parametrize("change", [1e-6, 0.3])
def test_a_neighbour_keeps_its_hierarchy(block: Callable[..., MappedMesh], change: float) -> None:
    """Catches a solution that belongs to the neighbour's matrix, and a neighbour too far away: iron turned to air."""
    mesh = shaken(block(16), 2)
    pattern, values = mesh.topology.pattern, matrix_with_iron(mesh)
    parts = kernel(mesh)
    near = 1.01 * values + change * pattern.assemble(stiffness(parts.curl, parts.weight))
    right = noise(pattern)
    exact = SuperLU(pattern, near).solve(right)
    found = Corrected(pattern, near, Multigrid(pattern, values), "multigrid").solve(right)
    assert np.abs(found - exact).max() < 1e-8 * np.abs(exact).max()
    assert np.abs(SuperLU(pattern, values).solve(right) - exact).max() > 1e-3 * np.abs(exact).max()


def test_newton_by_multigrid_equals_newton_by_factors(in_triangles: Solution) -> None:
    """Catches steps too inexact for Newton's method."""
    problem = in_triangles.problem
    start = 0.99 * in_triangles.psi
    one, other = (solve(problem, Settings(1e-10, method=method), start) for method in ("banded", "multigrid"))
    assert one.convergence.converged
    assert other.convergence.converged
    assert other.convergence.iterations <= one.convergence.iterations + 1
    assert np.abs(one.psi - other.psi).max() < 1e-8 * np.abs(other.psi).max()


def indefinite(block: Callable[..., MappedMesh]) -> tuple[Pattern, Floats]:
    """A matrix with a positive diagonal and a negative eigenvalue."""
    mesh = shaken(block(8), 3)
    pattern, values = mesh.topology.pattern, matrix_with_iron(mesh)
    values = np.where(pattern.rows == pattern.columns, values * 0.7, values)
    assert np.linalg.eigvalsh(pattern.matrix(values).toarray())[0] < 0
    return pattern, values


def test_an_indefinite_matrix_is_refused(block: Callable[..., MappedMesh]) -> None:
    """Catches a field from a matrix that has no minimum of energy."""
    pattern, values = indefinite(block)
    with pytest.raises(SingularMatrixError):
        Multigrid(pattern, values).solve(noise(pattern))


def test_a_matrix_without_diagonal_is_refused(block: Callable[..., MappedMesh]) -> None:
    """Catches a division by zero in the smoother."""
    pattern = block(4).mesh.topology.pattern
    with pytest.raises(SingularMatrixError, match="diagonal"):
        Multigrid(pattern, np.zeros(pattern.nonzeros))


def test_a_factorisation_steps_in(block: Callable[..., MappedMesh], monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a model that a factorisation could solve and that is given up; and a rescue nobody asked for."""
    mesh = shaken(block(16), 4)
    pattern, values = mesh.topology.pattern, matrix_with_iron(mesh)
    right = noise(pattern)
    monkeypatch.setattr(Multigrid, "LIMIT", 3)
    assert Multigrid(pattern, values, rescue=True).solve(right) == pytest.approx(SuperLU(pattern, values).solve(right))
    with pytest.raises(SingularMatrixError, match="3 iterations"):
        Multigrid(pattern, values).solve(right)


def test_the_default_follows_band_and_size(block: Callable[..., MappedMesh], monkeypatch: pytest.MonkeyPatch) -> None:
    """Catches a narrow band that is not used, a wide one that is, and a large system that is factorised."""
    mapped, general = block(24).mesh.topology.pattern, shaken(block(24), 5)
    assert choose(mapped) == "banded"
    assert choose(general.topology.pattern) == "superlu"
    values = matrix_with_iron(general)
    assert isinstance(factorise(general.topology.pattern, values, "auto"), SuperLU)
    monkeypatch.setattr("fluxbore.fem.linear.LARGE", 1000)
    assert choose(general.topology.pattern) == "multigrid"
    assert isinstance(factorise(general.topology.pattern, values, "auto"), Multigrid)


def test_near_numbering_is_a_numbering_that_brings_neighbours_together(block: Callable[..., MappedMesh]) -> None:
    """Catches a node that is lost or counted twice, and an order no better than the mesher's."""
    elements = shaken(block(24), 6).elements
    nodes = int(elements.max()) + 1
    place = near_numbering(elements, nodes)
    assert np.array_equal(np.sort(place), np.arange(nodes))
    before, after = np.ptp(elements, axis=1).max(), np.ptp(place[elements], axis=1).max()
    assert after < 6 * np.sqrt(nodes) < before / 4


def test_rough_solutions_cost_less(block: Callable[..., MappedMesh]) -> None:
    """Catches a tolerance that is not kept, or not made use of."""
    mesh = shaken(block(24), 7)
    pattern, values = mesh.topology.pattern, matrix_with_iron(mesh)
    hierarchy, right = Multigrid(pattern, values), noise(pattern)
    hierarchy.solve(right)
    full = hierarchy.iterations
    rough = hierarchy.within(right, 1e-2)
    assert np.linalg.norm(pattern.multiply(values, rough) - right) <= 1e-2 * np.linalg.norm(right)
    assert hierarchy.iterations < full / 2


def test_a_hierarchy_that_no_longer_serves_is_replaced(block: Callable[..., MappedMesh]) -> None:
    """Catches what was gained before the change being lost or counted twice: the tolerance is the whole's."""
    mesh = shaken(block(24), 8)
    pattern, values = mesh.topology.pattern, matrix_with_iron(mesh)
    parts = kernel(mesh)
    air = pattern.assemble(stiffness(parts.curl, parts.weight))
    first = Multigrid(pattern, air)
    other, right = first.renewed(values), noise(pattern)
    for tolerance in (1e-3, 1e-8):
        found = other.within(right, tolerance)
        assert np.linalg.norm(pattern.multiply(values, found) - right) <= 1.001 * tolerance * np.linalg.norm(right)
    assert other._cycle is not first._cycle
