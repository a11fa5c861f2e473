"""Derivatives of the discrete equations by the mesh lines: differences of residual and tangent at fields that solve
nothing, so that no cancellation hides a term."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_motor import COARSE_R, COARSE_Z, cubic_iron, difference, small_section, solved, with_lines

from fluxbore.design.materials import standard
from fluxbore.fem.adjoint import Linearisation
from fluxbore.fem.asymptotic import OpenRim, open_rim
from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.cells import Cells
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mapped import MappedMesh, breakpoint_derivative, mapped_mesh
from fluxbore.fem.newton import Convergence
from fluxbore.fem.problem import MagneticMaterial, Problem
from fluxbore.fem.reluctivity import reluctivity_curve

Array = np.ndarray


class Case:
    """A motor's mesh and materials without coils and edges, any ψ on it, and test fields."""

    def __init__(self) -> None:
        tubular = solved(small_section(shaft="1010"))
        self.grid: MappedMesh = tubular.grid
        self.materials: tuple[MagneticMaterial, ...] = tubular.solution.problem.materials
        rng = np.random.default_rng(4)
        s = self.grid.mesh.nodes[:, 0]
        free = self.grid.mesh.topology.freedom >= 0
        # ψ as of a tesla or so in all places, rough enough for every term to count.
        self.psi = np.where(free, s * rng.uniform(0.5, 1.5, s.size), 0.0)
        self.tests = [np.where(free, s * rng.uniform(-1.0, 1.0, s.size), 0.0) for _ in range(3)]

    def solution(self, grid: MappedMesh, materials: tuple[MagneticMaterial, ...], psi: Array) -> Solution:
        problem = Problem(grid.mesh, materials)
        return Solution(problem, psi, Convergence("converged", 0, 0.0), CellSystem(problem, grid), "banded", None)

    def products(self, solution: Solution) -> Array:
        """μᵀR of the three test fields, then xᵀ K_T y of the first two."""
        system = solution.system
        assert isinstance(system, CellSystem)
        residual = system.residual(solution.psi)
        x, y, _ = self.tests
        tangent = system.tangent_product(solution.psi, y[:, None])[:, 0]
        return np.array([*(field @ residual for field in self.tests), x @ tangent])


@pytest.fixture(scope="module")
def case() -> Case:
    return Case()


@pytest.fixture(scope="module")
def linearised(case: Case) -> Linearisation:
    return Linearisation(case.solution(case.grid, case.materials, case.psi), Cells(case.grid))


def test_by_every_mesh_line(case: Case, linearised: Linearisation) -> None:
    """Catches a wrong stretch, lever or share of any cell: μᵀR and xᵀKy with one line moved."""
    residual = linearised.residual(np.column_stack(case.tests))
    tangent, _ = linearised.tangent(*case.tests[:2])
    s, z = case.grid.r_lines**2 / 2, case.grid.z_lines
    for lines, by_residual, by_tangent, axis in ((s, residual.s, tangent.s, 0), (z, residual.z, tangent.z, 1)):
        for k in range(1 - axis, lines.size):  # the axis stays
            reach = np.diff(lines)[max(k - 1, 0) : k + 1].min()

            def at(step: float, k: int = k, axis: int = axis, reach: float = reach) -> Array:
                moved = [s.copy(), z.copy()]
                moved[axis][k] += step * reach
                return case.products(case.solution(with_lines(case.grid, *moved), case.materials, case.psi))

            expected = difference(at, 2e-3) / reach
            found = np.array([*by_residual[k], by_tangent[k, 0]])
            assert found == pytest.approx(expected, rel=1e-7, abs=1e-7 * np.abs(expected).max()), (axis, k)


def test_by_the_magnets(case: Case, linearised: Linearisation) -> None:
    """Catches a magnet's share that is missing or another's: reluctivity and coercivity of each."""
    residual = linearised.residual(np.column_stack(case.tests))
    tangent, _ = linearised.tangent(*case.tests[:2])
    magnets = [k for k, material in enumerate(case.materials) if material.remanence[1]]
    assert len(magnets) == 2
    for k, material in enumerate(case.materials):
        if k not in magnets:
            assert not residual.reluctivity[k].any()
            assert not residual.coercivity[k].any()
            continue
        nu, h_c = material.components[0], material.coercivity[1]

        def at(step: float, by_nu: bool, k: int = k, nu: float = nu, h_c: float = h_c) -> Array:
            changed = MagneticMaterial(nu + step * by_nu, (0.0, h_c + step * (not by_nu)))
            materials = (*case.materials[:k], changed, *case.materials[k + 1 :])
            return case.products(case.solution(case.grid, materials, case.psi))

        expected = difference(lambda step: at(step, True), 1e-2 * nu)
        found = np.array([*residual.reluctivity[k], tangent.reluctivity[k, 0]])
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-8 * np.abs(expected).max())
        expected = difference(lambda step: at(step, False), 1e-2 * abs(h_c))
        assert residual.coercivity[k] == pytest.approx(expected[:3], rel=1e-7, abs=1e-12 * np.abs(expected).max())
        assert expected[3] == pytest.approx(0.0, abs=1e-9 * np.abs(expected).max())
        assert not tangent.coercivity[k].any()


def test_the_tangent_by_the_field(case: Case, linearised: Linearisation) -> None:
    """Catches a third derivative of the iron's energy that is off: x, y and a direction of ψ may change places."""
    x, y, direction = case.tests
    _, by_psi = linearised.tangent(x, y)

    def at(step: float) -> Array:
        return case.products(case.solution(case.grid, case.materials, case.psi + step * direction))[3:]

    expected = difference(at, 1e-3)[0]
    assert by_psi @ direction == pytest.approx(expected, rel=1e-8)
    for a, b, along in ((y, x, direction), (x, direction, y), (direction, y, x)):
        assert linearised.tangent(a, b)[1] @ along == pytest.approx(expected, rel=1e-8)


def test_the_tangent_is_the_residuals(case: Case) -> None:
    """Catches a case that differentiates other equations than Newton solves."""
    y = case.tests[1]

    def at(step: float) -> Array:
        return case.products(case.solution(case.grid, case.materials, case.psi + step * y))[:1]

    solution = case.solution(case.grid, case.materials, case.psi)
    assert difference(at, 1e-3)[0] == pytest.approx(case.products(solution)[3], rel=1e-8)


@given(st.lists(st.floats(-3, 3), min_size=3, max_size=3))
def test_linear_in_the_adjoint(case: Case, linearised: Linearisation, weights: list[float]) -> None:
    """Catches adjoints that share a buffer or a sign: three at once, and their sum alone."""
    fields = np.column_stack(case.tests)
    apart, whole = linearised.residual(fields), linearised.residual(fields @ np.array(weights)[:, None])
    for name in ("s", "z", "reluctivity", "coercivity"):
        several, one = getattr(apart, name), getattr(whole, name)[:, 0]
        assert one == pytest.approx(several @ weights, abs=1e-10 * (np.abs(several).max() * 3))


def test_the_open_rim(case: Case) -> None:
    """Catches an edge term that stays while its line, a corner or a pole moves: uᵀ C v with each of them moved."""
    poles = (-0.02, 0.05)
    u, v = (field / np.abs(field).max() for field in case.tests[:2])
    found = OpenRim(case.grid, poles).derivative(u[:, None], v[:, None])
    s, z = case.grid.r_lines**2 / 2, case.grid.z_lines

    def at(s: Array, z: Array, poles: tuple[float, float]) -> float:
        grid = with_lines(case.grid, s, z)
        rim = open_rim(grid, poles)
        return float(np.einsum("kij,ki,kj->", rim.matrices, u[rim.nodes], v[rim.nodes]))

    def moved(lines: Array, k: int, step: float) -> Array:
        return lines + step * (np.arange(lines.size) == k)

    for k in range(1, s.size):
        reach = 1e-3 * np.diff(s)[max(k - 1, 0) : k + 1].min()
        expected = difference(lambda h: at(moved(s, k, h), z, poles), reach)  # noqa: B023
        assert found.s[k, 0] == pytest.approx(float(expected), rel=1e-6, abs=1e-7 * np.abs(found.s).max())
    for k in range(z.size):
        expected = difference(lambda h: at(s, moved(z, k, h), poles), 1e-6)  # noqa: B023
        assert found.z[k, 0] == pytest.approx(float(expected), rel=1e-6, abs=1e-7 * np.abs(found.z).max())
    expected = np.array(
        [
            float(difference(lambda h: at(s, z, (poles[0] + h, poles[1])), 1e-5)),
            float(difference(lambda h: at(s, z, (poles[0], poles[1] + h)), 1e-5)),
        ]
    )
    assert found.poles[:, 0] == pytest.approx(expected, rel=1e-7)


def test_lines_by_breakpoints() -> None:
    """Catches a line that moves with one breakpoint only: any weights on lines, by each breakpoint."""
    section = small_section()
    tubular = solved(section)
    rng = np.random.default_rng(6)
    on_s, on_z = (rng.uniform(-1, 1, (lines.size, 1)) for lines in (tubular.grid.r_lines, tubular.grid.z_lines))
    by_r, by_z = breakpoint_derivative(tubular.grid, section, on_s, on_z)

    def at(r: tuple[float, ...], z: tuple[float, ...]) -> float:
        other = replace(section, r=replace(section.r, values=r), z=replace(section.z, values=z))
        grid = mapped_mesh(other, COARSE_R, COARSE_Z, open_rim=True)
        return float(on_s[:, 0] @ (grid.r_lines**2 / 2) + on_z[:, 0] @ grid.z_lines)

    r, z = section.r.values, section.z.values
    for k in range(1, len(r)):
        expected = difference(lambda h: at((*r[:k], r[k] + h, *r[k + 1 :]), z), 1e-6)  # noqa: B023
        assert by_r[k, 0] == pytest.approx(float(expected), rel=1e-6, abs=1e-9)
    for k in range(len(z)):
        expected = difference(lambda h: at(r, (*z[:k], z[k] + h, *z[k + 1 :])), 1e-6)  # noqa: B023
        assert by_z[k, 0] == pytest.approx(float(expected), rel=1e-6, abs=1e-9)


def test_the_curves_second_derivative() -> None:
    """Catches d²ν/d(B²)² that is not dν/d(B²)'s: steel 1010 from its first interval to beyond its table's end."""
    iron = standard()["1010"]
    assert iron.curve is not None
    curve = reluctivity_curve(iron.curve)
    b = np.array([0.003, 0.0234, 0.3021, 0.9537, 1.5512, 1.8034, 2.3011, 2.9])
    expected = difference(lambda h: curve.reluctivity(b**2 + h * b**2)[1], 1e-5) / b**2
    size = curve.reluctivity(b**2)[0] / b**4
    assert curve.curvature(b**2) == pytest.approx(expected, abs=1e-7 * size.max(), rel=1e-5)
    # H is C2, so that the second derivative has no jump where the pieces meet.
    knots = curve.step * np.arange(2, curve.coefficients.shape[1] - 1)
    below, above = (curve.curvature((knots * (1 + side * 1e-9)) ** 2) for side in (-1, 1))
    assert below == pytest.approx(above, rel=1e-5, abs=1e-5 * np.abs(above).max())


def test_a_cubic_laws_second_derivative() -> None:
    """Catches a curvature where ν = a + b B² has none."""
    assert not cubic_iron().curvature(np.linspace(0.0, 9.0, 7)).any()
