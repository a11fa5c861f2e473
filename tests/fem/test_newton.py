"""Newton's iteration: order, the tangent as a derivative, failures as values, starts near and far."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from fluxbore.design.bh_curve import BHCurve
from fluxbore.design.materials import SoftIron, lookup, standard
from fluxbore.fem import linear
from fluxbore.fem.conductors import Conductor, circuit
from fluxbore.fem.factors import Factor, SingularMatrixError
from fluxbore.fem.linear import Method, Tangents
from fluxbore.fem.magnetostatics import Settings, Solution, System, solve
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.newton import ROUGHEST, Convergence, newton
from fluxbore.fem.problem import Circuit, MagneticMaterial, Problem
from fluxbore.fem.reluctivity import reluctivity_curve


class Diagonal:
    """A factor for scalar equations."""

    def __init__(self, slope: np.ndarray) -> None:
        if not np.all(slope > 0):
            raise SingularMatrixError("not positive definite")
        self._slope = slope

    def solve(self, right: np.ndarray) -> np.ndarray:
        return right / self._slope


def cubic(x: np.ndarray) -> np.ndarray:
    return x + x**3 - 10


def cubic_slope(x: np.ndarray) -> Factor:
    return Diagonal(1 + 3 * x**2)


def test_root_of_a_cubic() -> None:
    """Catches a step in the wrong direction: x + x³ = 10 has the root 2."""
    x, convergence, factor = newton(cubic, cubic_slope, np.zeros(1), 10.0, 1e-12, 60)
    assert x == pytest.approx(2.0)
    assert convergence.converged
    assert convergence.residual <= 1e-12
    assert factor is not None


def test_convergence_is_quadratic(in_triangles: Solution) -> None:
    """Catches a tangent that is only nearly right: near the motor's solution each residual is the last one's square."""
    system = in_triangles.triangles
    problem = in_triangles.problem
    norms = [solve(problem, Settings(tolerance=0.0, max_iterations=k)).convergence.residual for k in range(1, 8)]
    assert system.iron_elements.size > 0
    logs = np.log([norm for norm in norms if norm > 1e-11][-3:])
    assert (logs[2] - logs[1]) / (logs[1] - logs[0]) > 1.8, norms


def test_tangent_is_the_derivative_of_the_residual(in_triangles: Solution) -> None:
    """Catches a lost term of the differential reluctivity: against central differences, to 1e-7."""
    system = in_triangles.triangles
    x = 0.9 * in_triangles.psi[system.inner]
    direction = np.random.default_rng(1).normal(size=x.size) * np.abs(x).max()
    image = system.pattern.multiply(system.tangent_values(x), direction)
    errors = []
    for h in (1e-5, 1e-6, 1e-7):
        differences = (system.residual(x + h * direction) - system.residual(x - h * direction)) / (2 * h)
        errors.append(np.linalg.norm(differences - image) / np.linalg.norm(image))
    assert min(errors) < 1e-7, errors


def test_residual_is_the_derivative_of_the_energy(in_triangles: Solution) -> None:
    """Catches a residual that solves another problem: against differences of the energy, iron by its own integral."""
    system, problem = in_triangles.triangles, in_triangles.problem

    def energy(x: np.ndarray) -> float:
        total = 0.5 * x @ system.pattern.multiply(system.linear, x) - system.load @ x
        squared = np.sum(np.einsum("mqkn,mn->mqk", system.iron_curl, system.spread(x)[system.iron_nodes]) ** 2, axis=-1)
        for index, part in system.iron:
            curve = problem.materials[index].curve
            assert curve is not None
            total += np.sum(system.iron_weight[part] * curve.energy_density(np.sqrt(squared[part])))
        return float(total)

    x = 0.9 * in_triangles.psi[system.inner]
    step = 1e-4
    along = x * np.random.default_rng(2).uniform(0.5, 1.5, x.size)
    slope = (energy(x + step * along) - energy(x - step * along)) / (2 * step)
    assert system.residual(x) @ along == pytest.approx(slope, rel=1e-6)


def test_iteration_limit_is_a_value(in_triangles: Solution) -> None:
    """Catches an exception, or a field that pretends: one step from nothing does not do, and says so."""
    solution = solve(in_triangles.problem, Settings(max_iterations=1))
    assert not solution.convergence.converged
    assert solution.convergence.status == "iteration limit"
    assert solution.convergence.iterations == 1
    assert solution.convergence.residual > 1e-8
    assert "iteration limit" in solution.convergence.sentence()
    assert np.all(np.isfinite(solution.psi))


def test_a_stop_before_the_first_step_is_a_value(in_triangles: Solution) -> None:
    """Catches a factor that is used although none was made: no step allowed, and a start that is the solution."""
    problem = in_triangles.problem
    none = solve(problem, Settings(max_iterations=0))
    assert none.convergence.status == "iteration limit"
    again = solve(problem, None, in_triangles.psi)
    assert again.convergence.converged
    assert again.convergence.iterations == 0
    assert again.last_factor is None
    right = np.ones(again.triangles.inner.size)
    np.testing.assert_allclose(again.tangent.solve(right), in_triangles.tangent.solve(right), rtol=1e-9)


@pytest.mark.filterwarnings("error")
def test_a_load_that_is_not_a_number_is_a_value(in_triangles: Solution) -> None:
    """Catches a traceback, a warning or an endless search for a field that does not exist."""
    problem = in_triangles.problem
    broken = replace(problem, circuits=(replace(problem.circuits[0], current=float("nan")),))
    solution = solve(broken)
    assert not solution.convergence.converged
    assert solution.convergence.status == "stalled"
    assert solution.convergence.sentence()


@pytest.mark.filterwarnings("error")
def test_a_start_that_is_not_a_number_is_a_value(in_triangles: Solution) -> None:
    """Catches a cast of NaN to a table's index in the iron."""
    start = np.full(in_triangles.psi.size, np.nan)
    solution = solve(in_triangles.problem, None, start)
    assert solution.convergence.status == "stalled"


@pytest.mark.parametrize("method", ["banded", "superlu"])
def test_a_singular_matrix_is_a_value(in_triangles: Solution, method: str) -> None:
    """Catches a traceback from the factorisation: a material of no reluctivity leaves the field free."""
    problem = in_triangles.problem
    free = replace(problem, materials=tuple(MagneticMaterial(0.0) for _ in problem.materials))
    loaded = replace(free, circuits=(replace(problem.circuits[0], current=1.0),))
    solution = solve(loaded, Settings(method="superlu" if method == "superlu" else "banded"))
    assert solution.convergence.status == "singular matrix"
    assert solution.last_factor is None


def test_a_step_that_does_not_help_is_a_value() -> None:
    """Catches an endless backtracking: a tangent of the wrong sign stalls."""
    x, convergence, _ = newton(lambda x: -x - 1, lambda x: Diagonal(np.ones(1)), np.zeros(1), 1.0, 1e-12, 60)
    assert convergence.status == "stalled"
    assert x == pytest.approx(0.0)


def test_no_load_has_no_field() -> None:
    """Catches a division by a load of zero, from nothing and from a neighbour's field."""
    for start in (np.zeros(3), np.ones(3)):
        x, convergence, _ = newton(lambda x: 3 * x, lambda x: Diagonal(np.full(3, 3.0)), start, 0.0, 1e-8, 60)
        assert convergence.converged
        assert x == pytest.approx(0.0, abs=1e-8)


def test_failures_without_a_load_are_values_too() -> None:
    """Catches a division by zero in the report of a failure."""

    def singular(x: np.ndarray) -> Factor:
        raise SingularMatrixError("on purpose")

    _, convergence, factor = newton(lambda x: x, singular, np.ones(2), 0.0, 1e-8, 60)
    assert convergence.status == "singular matrix"
    assert factor is None


def test_a_large_current_saturates_and_converges(in_triangles: Solution) -> None:
    """Catches overshoot: 10,000 A in one phase, three orders beyond the winding's, within 60 steps."""
    problem = in_triangles.problem
    first = problem.circuits[0]
    mad = replace(problem, circuits=(Circuit(first.name, first.density, 1e4), *problem.circuits[1:]))
    solution = solve(mad)
    assert solution.convergence.converged, solution.convergence.sentence()


def test_assembly_is_the_sum_of_all_elements(in_triangles: Solution) -> None:
    """Catches an iron element that is lost or counted twice when only the iron is assembled anew."""
    from fluxbore.fem.element import stiffness

    system = in_triangles.triangles
    problem = in_triangles.problem
    # At no field iron is linear: ν(0), no slope.
    nu = np.array(
        [m.reluctivity if m.curve is None else m.curve.reluctivity(np.zeros(1))[0][0] for m in problem.materials]
    )[problem.mesh.region]
    matrices = stiffness(system.kernel.curl, system.kernel.weight * nu[:, None])
    if problem.edges is not None:
        np.add.at(matrices, problem.edges.elements, problem.edges.matrices)
    whole = system.pattern.assemble(matrices)
    values = system.tangent_values(np.zeros(system.inner.size))
    assert np.abs(values - whole).max() < 1e-12 * np.abs(whole).max()


def magnetised_bar(grid: MappedMesh, current: float) -> System:
    """Steel that carries its own current, to beyond saturation: the hardest start from no field."""
    steel = lookup("1010", "iron", standard(), SoftIron).curve
    assert isinstance(steel, BHCurve)
    coil = circuit(grid.mesh, "bar", [Conductor(0, 1 / 0.02)], current)
    return System(Problem(grid.mesh, (MagneticMaterial(curve=reluctivity_curve(steel)),), (coil,)))


def steps(system: System, method: Method) -> tuple[np.ndarray, Convergence]:
    """Newton's with neighbouring factors."""
    tangents = Tangents(system.pattern, system.tangent_values, method)
    start, scale = np.zeros(system.inner.size), float(np.linalg.norm(system.load))
    x, convergence, _ = newton(system.residual, tangents, start, scale, 1e-8, 60)
    return x, convergence


def test_steps_do_not_grow_with_the_mesh(block: Callable[..., MappedMesh]) -> None:
    """Catches a line search that allows ever shorter steps on finer meshes, far beyond saturation."""
    for current in (1e3, 1e5):
        counts = []
        for cells in (8, 16, 32):
            _, convergence = steps(magnetised_bar(block(cells), current), "banded")
            assert convergence.converged
            counts.append(convergence.iterations)
        assert max(counts) <= 16, counts
        assert counts[2] <= counts[1] + 4, counts


@pytest.mark.parametrize("method", ["superlu", "multigrid"])
def test_neighbouring_factors_lead_to_the_same_field(
    block: Callable[..., MappedMesh], method: Method, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Catches steps too rough to converge, a field that differs by them, and a factorisation at every step."""
    system = magnetised_bar(block(24), 1e3)
    exact, reference = steps(system, "banded")
    made = []
    factorise = linear.factorise
    monkeypatch.setattr(linear, "factorise", lambda *arguments: made.append(1) or factorise(*arguments))
    found, convergence = steps(system, method)
    assert convergence.converged
    assert convergence.iterations <= reference.iterations + 3
    assert len(made) <= 0.7 * convergence.iterations
    assert np.abs(found - exact).max() < 1e-8 * np.abs(exact).max()


class Rough:
    """Solves within the tolerance asked for and no better; remembers what was asked."""

    def __init__(self, asked: list[float], slope: float) -> None:
        self.asked, self.slope = asked, slope

    def solve(self, right: np.ndarray) -> np.ndarray:
        return self.within(right, 0.0)

    def within(self, right: np.ndarray, tolerance: float) -> np.ndarray:
        self.asked.append(tolerance)
        return (1 - tolerance) * right / self.slope


def test_rough_steps_become_fine() -> None:
    """Catches steps that stay rough, which would make the convergence linear, and ones finer than anyone needs."""
    asked: list[float] = []
    x, convergence, _ = newton(
        cubic, lambda x: Rough(asked, 1 + 3 * float(x[0]) ** 2), np.full(1, 3.0), 10.0, 1e-10, 60
    )
    assert convergence.converged
    assert x == pytest.approx(2.0)
    assert asked[0] == ROUGHEST
    assert asked[-1] < 1e-3
    assert min(asked) > 1e-13
    assert len(asked) <= 7


def test_a_linear_problem_takes_one_step() -> None:
    """Catches a linear problem that is solved roughly, and again."""
    asked: list[float] = []
    _, convergence, _ = newton(
        lambda x: 2 * x - 4, lambda x: Rough(asked, 2.0), np.zeros(1), 4.0, 1e-8, 60, forcing=0.0
    )
    assert convergence.converged
    assert convergence.iterations == 1
