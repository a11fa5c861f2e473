"""The equations of a mapped mesh's cells: derivatives of one another, condensation, fast and plain paths."""

from dataclasses import replace

import cell_energy
import numpy as np
import pytest
from stress_force import axial_force

from fluxbore.design.spec import Spec
from fluxbore.fem.cell_matrices import inverted
from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.factors import SingularMatrixError
from fluxbore.fem.magnetostatics import Settings, solve
from fluxbore.fem.problem import MagneticMaterial, Problem
from fluxbore.fem.refined import Refined
from fluxbore.fem.tubular import TubularSolution, solve_positions
from fluxbore.geometry.hybrid import cross_section


@pytest.fixture(scope="module")
def system(mid_stroke: TubularSolution) -> CellSystem:
    found = mid_stroke.solution.system
    assert isinstance(found, CellSystem)
    return found


def test_residual_is_the_derivative_of_the_energy(mid_stroke: TubularSolution, system: CellSystem) -> None:
    """Catches a residual that solves another problem: against differences of the energy, with magnets and the rim."""
    psi = 0.9 * mid_stroke.solution.psi
    step = 1e-4
    along = psi * np.random.default_rng(2).uniform(0.5, 1.5, psi.size)
    ahead, behind = (cell_energy.energy(system, psi + sign * step * along) for sign in (1, -1))
    assert system.residual(psi) @ along == pytest.approx((ahead - behind) / (2 * step), rel=1e-6)


def test_tangent_is_the_derivative_of_the_residual(mid_stroke: TubularSolution, system: CellSystem) -> None:
    """Catches a lost term of the differential reluctivity: against central differences, to 1e-7."""
    psi = 0.9 * mid_stroke.solution.psi
    direction = psi * np.random.default_rng(1).normal(size=psi.size)
    image = system.tangent_product(psi, direction[:, None])[:, 0]
    errors = []
    for h in (1e-4, 1e-5, 1e-6):
        differences = (system.residual(psi + h * direction) - system.residual(psi - h * direction)) / (2 * h)
        errors.append(np.linalg.norm(differences - image) / np.linalg.norm(image))
    assert min(errors) < 1e-7, errors


@pytest.mark.parametrize("precision", [np.float32, np.float64])
def test_factors_are_the_tangents(
    mid_stroke: TubularSolution, system: CellSystem, precision: type[np.float32] | type[np.float64]
) -> None:
    """Catches a condensed matrix that is another than the product's: A⁻¹ A x = x, as good as the precision allows."""
    psi = mid_stroke.solution.psi
    factor = system._factor(system._at(psi).tensor, precision, system._remembered())
    x = psi * np.random.default_rng(3).uniform(-1, 1, psi.size)
    found = factor.solve(system.tangent_product(psi, x[:, None])[:, 0])
    assert np.abs(found - x).max() < (1e-2 if precision == np.float32 else 1e-8) * np.abs(x).max()


def test_inverses_all_at_once() -> None:
    """Catches a pivot that is not divided out; and a matrix that is not definite, although its diagonal is positive."""
    rng = np.random.default_rng(5)
    roots = rng.normal(size=(7, 9, 9))
    matrices = roots @ roots.transpose(0, 2, 1)
    assert inverted(matrices) @ matrices == pytest.approx(np.broadcast_to(np.eye(9), matrices.shape), abs=1e-8)
    matrices[3] = np.ones((9, 9)) + np.eye(9) * 1e-3
    matrices[3, 0, 1] = matrices[3, 1, 0] = 5.0
    with pytest.raises(SingularMatrixError):
        inverted(matrices)


def test_refinement_against_the_plain_factor(mid_stroke: TubularSolution, system: CellSystem) -> None:
    """Catches a response left at five digits: single precision refined against SuperLU, several at once."""
    psi = mid_stroke.solution.psi
    loads = np.column_stack([circuit.density for circuit in mid_stroke.solution.problem.circuits])
    found = mid_stroke.solution.response(loads)
    exact = system.response(system.tangent_at(psi, None, "superlu"), loads, 0.0)
    assert np.abs(found - exact).max() < 1e-9 * np.abs(exact).max()


def test_a_factor_too_rough_is_replaced(system: CellSystem) -> None:
    """Catches sweeps that do not converge and are taken for a solution."""

    class Wrong:
        def solve(self, right: np.ndarray) -> np.ndarray:
            return -right

    class Right:
        def solve(self, right: np.ndarray) -> np.ndarray:
            return right / 3.0

    made: list[int] = []
    refined = Refined(lambda x: 3.0 * x, Wrong(), lambda: made.append(1) or Right())
    assert refined.solve(np.ones(4)) == pytest.approx(1 / 3)
    assert refined.solve(np.ones((4, 2))) == pytest.approx(1 / 3)
    assert made == [1]


def test_fast_and_plain_path_agree(spec: Spec) -> None:
    """Catches a fast path that solves another problem: SuperLU takes whole matrices and no condensation."""
    places = [spec.actuator.mid_stroke + step for step in (0.0, 3e-3)]
    fast, plain = (
        solve_positions(
            lambda z: cross_section(spec.actuator, z, spec.materials, 293.15), places, Settings(1e-11, 60, method)
        )
        for method in ("banded", "superlu")
    )
    for one, other in zip(fast, plain, strict=True):
        assert one.thrust_constants() == pytest.approx(other.thrust_constants(), rel=1e-9)
        assert one.flux_linkages() == pytest.approx(other.flux_linkages(), rel=1e-9)
        assert one.cogging_force() == pytest.approx(other.cogging_force(), rel=1e-9, abs=1e-9)
        assert one.synchronous_inductance() == pytest.approx(other.synchronous_inductance(), rel=1e-9)
        psi = other.solution.psi
        assert one.solution.psi == pytest.approx(psi, rel=1e-9, abs=1e-9 * np.abs(psi).max())


def test_two_solvers_of_one_problem(mid_stroke: TubularSolution, system: CellSystem) -> None:
    """Catches cells that solve another problem than triangles do: cogging and linkage of either element, closed box."""
    problem = mid_stroke.solution.problem
    fourth = solve(problem, system=CellSystem(problem, mid_stroke.grid))
    triangles = solve(problem)
    annulus = mid_stroke.section.force_annulus
    # On the same lattice, on which triangles are of a lower order.
    assert axial_force(triangles, annulus) == pytest.approx(axial_force(fourth, annulus), abs=0.1)
    for circuit in problem.circuits:
        assert circuit.density @ triangles.psi == pytest.approx(circuit.density @ fourth.psi, rel=0.02, abs=1e-5)


def test_reluctivity_with_a_direction(mid_stroke: TubularSolution, system: CellSystem) -> None:
    """Catches ν_r and ν_z in each other's place: fast and plain alike, and other than with a single one."""
    problem = mid_stroke.solution.problem
    air = replace(problem.materials[0], reluctivity=(1e6, 3e6))
    uneven = replace(problem, materials=(air, *problem.materials[1:]))
    fields = [
        solve(uneven, Settings(1e-11, 60, method), system=CellSystem(uneven, mid_stroke.grid, system.rim)).psi
        for method in ("banded", "superlu")
    ]
    assert fields[0] == pytest.approx(fields[1], rel=1e-8, abs=1e-9 * np.abs(fields[1]).max())
    assert np.abs(fields[0] - mid_stroke.solution.psi).max() > 1e-3 * np.abs(fields[1]).max()


def test_what_cells_do_not_know_is_refused(mid_stroke: TubularSolution) -> None:
    """Catches a magnet along r, whose load would be dropped without a word."""
    problem = mid_stroke.solution.problem
    radial = replace(problem.materials[0], coercivity=(1.0, 0.0))
    with pytest.raises(AssertionError):
        CellSystem(Problem(problem.mesh, (radial, *problem.materials[1:])), mid_stroke.grid)


def test_a_singular_matrix_is_a_value(mid_stroke: TubularSolution) -> None:
    """Catches a traceback from the factorisation: a material of no reluctivity leaves the field free."""
    problem = mid_stroke.solution.problem
    free = replace(problem, materials=tuple(MagneticMaterial(0.0) for _ in problem.materials))
    loaded = replace(free, circuits=(replace(problem.circuits[0], current=1.0),))
    for method in ("banded", "superlu"):
        solution = solve(loaded, Settings(method=method), system=CellSystem(loaded, mid_stroke.grid))
        assert solution.convergence.status == "singular matrix"


@pytest.mark.filterwarnings("error")
def test_what_is_not_a_number_is_a_value(mid_stroke: TubularSolution, system: CellSystem) -> None:
    """Catches a traceback, a warning or an endless search for a field that does not exist."""
    problem = mid_stroke.solution.problem
    broken = replace(problem, circuits=(replace(problem.circuits[0], current=float("nan")),))
    assert solve(broken, system=CellSystem(broken, mid_stroke.grid)).convergence.status == "stalled"
    start = np.full(mid_stroke.solution.psi.size, np.nan)
    assert solve(problem, None, start, CellSystem(problem, mid_stroke.grid)).convergence.status == "stalled"
