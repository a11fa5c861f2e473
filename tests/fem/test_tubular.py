"""A machine's figures from its field: densities and shares, on made-up fields whose answer is known."""

from dataclasses import replace

import numpy as np
import pytest

from fluxbore.design.materials import Library, standard
from fluxbore.design.spec import Spec
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.reluctivity import VACUUM_PERMEABILITY, VACUUM_RELUCTIVITY
from fluxbore.fem.tubular import (
    TubularSolution,
    demagnetised_fraction,
    magnetic_material,
    shell_flux_density,
    solve_currents,
    stray_field,
    tube_flux_density,
)
from fluxbore.geometry.cross_section import AIR, Region

LIBRARY: Library = standard()


def with_field(item: TubularSolution, psi: np.ndarray) -> TubularSolution:
    solution = item.solution
    made = Solution(solution.problem, psi, solution.convergence, solution.system, solution.method, None)
    return replace(item, solution=made)


@pytest.fixture(scope="module")
def slanted(mid_stroke: TubularSolution) -> TubularSolution:
    """ψ = s (1 + 10 z): B_z = 1 + 10 z, B_r = −5 r."""
    s, z = mid_stroke.solution.problem.mesh.nodes.T
    return with_field(mid_stroke, s * (1 + 10 * z))


def test_stray_field_of_a_polynomial(slanted: TubularSolution) -> None:
    """Catches a range that is cut at nodes, or another radius: the largest |B| is at the far end of the range."""
    radius = 18.5e-3
    exact = np.hypot(5 * radius, 1 + 10 * 0.1513)
    assert stray_field(slanted, radius, (0.0, 0.1513)) == pytest.approx(exact, rel=1e-4)


def test_tube_flux_density_of_a_polynomial(slanted: TubularSolution) -> None:
    """Catches a flux over the wrong area: the mean of B_z over a tube is B_z, at the range's upper end."""
    found = tube_flux_density(slanted, (12.5e-3, 13.5e-3), (0.0, 0.18))
    assert 1 + 10 * 0.17 < found <= 1 + 10 * 0.18


def test_shell_flux_density_of_a_polynomial(slanted: TubularSolution) -> None:
    """Catches a shell's area without its radius: |B_r| = 5 r, whatever the range."""
    for z_range in ((0.01, 0.02), (0.0501, 0.0513)):
        assert shell_flux_density(slanted, 10e-3, z_range) == pytest.approx(0.05, rel=1e-6)


@pytest.mark.parametrize("field", [1.0, -1.0])
def test_demagnetised_fraction(mid_stroke: TubularSolution, field: float) -> None:
    """Catches a sign of the magnetisation: in a uniform axial field just half of the magnets stand against it."""
    item = with_field(mid_stroke, field * mid_stroke.solution.problem.mesh.nodes[:, 0])
    # H against the magnetisation is ν (1.4 T − B): beyond ν · 1.4 T only where B is opposed.
    assert demagnetised_fraction(item, VACUUM_RELUCTIVITY / 1.05 * 1.4) == pytest.approx(0.5)
    assert demagnetised_fraction(item, 1e9) == 0.0
    assert demagnetised_fraction(item, -1e9) == 1.0


def test_force_of_a_polynomial(mid_stroke: TubularSolution) -> None:
    """Catches a factor of the stress integral: ψ = s z gives F = −(2π/μ0) ∫∫ s z ds dz / (s_o − s_i) in closed form."""
    s, z = mid_stroke.solution.problem.mesh.nodes.T
    item = with_field(mid_stroke, s * z)
    inner, outer = (r**2 / 2 for r in item.section.force_annulus)
    exact = -2 * np.pi / VACUUM_PERMEABILITY * (outer + inner) / 2 * (z.max() ** 2 - z.min() ** 2) / 2
    assert item.cogging_force() == pytest.approx(exact, rel=1e-9)


def test_force_gradient_is_the_derivative(mid_stroke: TubularSolution) -> None:
    """Catches a gradient that is half or twice: the force is quadratic in ψ, so central differences are exact."""
    psi = mid_stroke.solution.psi
    along = psi * np.random.default_rng(1).uniform(-1, 1, psi.size)
    ahead, behind = (with_field(mid_stroke, psi + sign * along).cogging_force() for sign in (1, -1))
    assert mid_stroke.pull @ along == pytest.approx((ahead - behind) / 2, rel=1e-9)


def test_incremental_thrust_against_the_forward_solve(mid_stroke: TubularSolution) -> None:
    """Catches an adjoint on the wrong side: one solve per phase and the gradient give the same as one for all."""
    solution = mid_stroke.solution
    forward = [mid_stroke.pull @ solution.response(circuit.density) for circuit in solution.problem.circuits]
    assert mid_stroke.thrust_constants() == pytest.approx(forward, rel=1e-8)


def test_materials_as_the_solver_sees_them(spec: Spec) -> None:
    """Catches a conductor with a reluctivity of its own, or a magnet without its recoil line."""
    assert magnetic_material(AIR).reluctivity == VACUUM_RELUCTIVITY
    assert magnetic_material(Region("tube", LIBRARY["aluminium 6061"])).curve is None
    magnet = magnetic_material(Region("magnet", LIBRARY["N48"], -1.4, 1.05))
    assert magnet.remanence == pytest.approx((0.0, -1.4), rel=1e-15)
    assert magnet.reluctivity == pytest.approx(VACUUM_RELUCTIVITY / 1.05)
    iron = magnetic_material(Region("yoke", LIBRARY["1010"]))
    assert iron.curve is magnetic_material(Region("ring", LIBRARY["1010"])).curve, "one spline for both"


def test_currents_against_the_thrust_constants(mid_stroke: TubularSolution) -> None:
    """Catches a current on another phase, or one that is not applied: 0.01 A against the incremental constants."""
    position, section = mid_stroke.position, mid_stroke.section
    idle = solve_currents(section, position, {})
    assert idle.solution.psi == pytest.approx(mid_stroke.solution.psi, abs=1e-9 * np.abs(idle.solution.psi).max())
    for k, phase in enumerate("UVW"):
        ahead, behind = (solve_currents(section, position, {phase: i}).cogging_force() for i in (0.01, -0.01))
        assert (ahead - behind) / 0.02 == pytest.approx(mid_stroke.thrust_constants()[k], rel=1e-3, abs=1e-4)
