"""The designs' open boundary: fields that it lets out whole, a matrix that stays positive definite, what it gains."""

from dataclasses import replace

import numpy as np
import pytest

from fluxbore.design.spec import Spec
from fluxbore.fem.asymptotic import across_end, across_shell, open_rim
from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.coil_windows import circuits
from fluxbore.fem.factors import SingularMatrixError
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.magnetostatics import Solution, solve
from fluxbore.fem.mapped import MappedMesh, Subdivision, mapped_mesh
from fluxbore.fem.problem import Circuit, MagneticMaterial, Problem
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY
from fluxbore.fem.tubular import R_CELLS, Z_CELLS, TubularSolution, magnetic_material
from fluxbore.geometry.cross_section import Breakpoints, CoilWindow, CrossSection
from fluxbore.geometry.hybrid import cross_section

POLES = (-0.05, 0.11)


def rod(r: np.ndarray, z: np.ndarray, poles: tuple[float, float] = POLES) -> np.ndarray:
    """ψ of dipoles spread evenly between two poles, by quadrature over the dipoles."""
    x, w = np.polynomial.legendre.leggauss(60)
    half, middle = (poles[1] - poles[0]) / 2, (poles[1] + poles[0]) / 2
    distance = z[..., None] - middle - half * x
    return np.asarray(np.sum(w * r[..., None] ** 2 / (r[..., None] ** 2 + distance**2) ** 1.5, axis=-1))


def test_the_coefficients_are_the_fields_own() -> None:
    """Catches a sign or a factor of c0: both faces against differences of the dipoles' summed field."""
    step = 1e-6
    z = np.linspace(-0.15, 0.2, 11)
    r = np.full_like(z, 0.1)
    expected = -(rod(r + step, z) - rod(r - step, z)) / (2 * step) / rod(r, z)
    assert across_shell(0.1, z, POLES) == pytest.approx(expected, rel=1e-6, abs=1e-6)
    r = np.linspace(1e-3, 0.1, 7)
    for end, sign in ((0.2, 1), (-0.14, -1)):
        at = np.full_like(r, end)
        expected = -sign * (rod(r, at + step) - rod(r, at - step)) / (2 * step) / rod(r, at)
        near, far = sorted(abs(end - pole) for pole in POLES)
        assert across_end(r, (near, far)) == pytest.approx(expected, rel=1e-6)


def test_a_short_rod_is_a_dipole() -> None:
    """Catches a field that is none from far away: c = 3 r/R² − 2/r beside a dipole, 3 |z|/R² before it."""
    short = (-1e-4, 1e-4)
    z = np.linspace(-0.3, 0.3, 7)
    assert across_shell(0.2, z, short) == pytest.approx(3 * 0.2 / (0.04 + z**2) - 10, rel=1e-4, abs=1e-3)
    r = np.linspace(0.0, 0.2, 5)
    assert across_end(r, (0.3 - 1e-4, 0.3 + 1e-4)) == pytest.approx(0.9 / (0.09 + r**2), rel=1e-4)
    # On the axis 1 − cos θ would cancel to nothing.
    assert across_end(np.array([1e-12]), (0.1, 0.3)) == pytest.approx(2 * (1000 - 1 / 0.027) / (100 - 1 / 0.09))


def section(
    radius: float, z: tuple[float, ...], coils: tuple[CoilWindow, ...] = (), r: tuple[float, ...] = ()
) -> CrossSection:
    """Air with coils, all of one region."""
    radii = (0.0, *r, radius)
    return CrossSection(
        Breakpoints(radii, (*["r"] * len(r), "far")),
        Breakpoints(z, ("low", *["z"] * (len(z) - 3), "high")),
        (),
        np.zeros((len(z) - 1, len(radii) - 1), dtype=int),
        coils,
        (),
        (0.0, 0.0),
    )


def grid_of(found: CrossSection, cells: int, is_open: bool) -> MappedMesh:
    growth = 1.0 + 1.4 / cells
    near = {"r": Subdivision(cells), "z": Subdivision(cells)}
    r_cells = {**near, "far": Subdivision(2 * cells, growth, "start")}
    z_cells = {**near, "low": Subdivision(2 * cells, growth, "end"), "high": Subdivision(2 * cells, growth, "start")}
    return mapped_mesh(found, r_cells, z_cells, open_rim=is_open)


def test_edge_terms_are_the_boundarys_flux() -> None:
    """Catches an edge that is left out or on another element: matrices times 1 and ψ against ∮ c ψ²/r by quadrature."""
    grid = grid_of(section(0.1, (-0.1, -0.05, 0.11, 0.15)), 6, True)
    rim = open_rim(grid, POLES)
    s, z = grid.mesh.nodes.T
    psi = s * (1 + 3 * z)
    forces = np.zeros(psi.size)
    rim.add_forces(forces, psi)
    found = psi @ forces
    x, w = np.polynomial.legendre.leggauss(200)
    at, length = 0.025 + 0.125 * x, 0.125
    expected = length * w @ (across_shell(0.1, at, POLES) / 0.1 * (0.005 * (1 + 3 * at)) ** 2)
    r = 0.05 + 0.05 * x
    for end, distances in ((-0.1, (0.05, 0.21)), (0.15, (0.04, 0.2))):
        expected += 0.05 * w @ (across_end(r, distances) / r * (r**2 / 2 * (1 + 3 * end)) ** 2)
    assert found == pytest.approx(VACUUM_RELUCTIVITY * expected, rel=1e-5)
    on_rim = (s == s.max()) | (z == z.min()) | (z == z.max())
    assert np.array_equal(np.unique(rim.nodes), np.flatnonzero(on_rim))


def loop_solution(far: float, is_open: bool, cells: int = 5) -> Solution:
    """A coil of 1 A in air that ends ``far`` (m) beyond it."""
    coil = CoilWindow("coil", 1.0, (0.04, 0.05), (-0.01, 0.01))
    found = section(0.05 + far, (-0.01 - far, -0.01, 0.01, 0.01 + far), (coil,), (0.04, 0.05))
    grid = grid_of(found, cells, is_open)
    (idle,) = circuits(grid, (coil,))
    problem = Problem(grid.mesh, (MagneticMaterial(),), (Circuit(idle.name, idle.density, 1.0),))
    return solve(problem, system=CellSystem(problem, grid, open_rim(grid, found.ends) if is_open else None))


def test_a_coil_in_open_air() -> None:
    """Catches a condition that reflects: air of twice the coil's radius is then as good as of four times that."""
    exact = flux_linkages(loop_solution(0.8, True, 24))[0]
    closed, opened, farther = (
        flux_linkages(loop_solution(far, is_open, 12))[0] / exact - 1
        for far, is_open in ((0.1, False), (0.1, True), (0.4, False))
    )
    assert closed < -5e-3
    assert abs(opened) < abs(closed) / 100
    assert abs(opened) < abs(farther)


@pytest.mark.parametrize("length", [0.1, 2.0])
def test_iron_of_any_length_keeps_the_matrix_positive(length: float) -> None:
    """Catches a c0 that takes out more than the air holds: beside long iron a dipole in its middle does."""
    iron = CoilWindow("rod", 1.0, (0.0, 0.01), (-length / 2, length / 2))
    found = section(0.1, (-length / 2 - 0.1, -length / 2, length / 2, length / 2 + 0.1), (), (0.01,))
    found = replace(found, cells=np.array([[0, 0], [1, 0], [0, 0]]))
    grid = grid_of(found, 8, True)
    materials = (MagneticMaterial(), MagneticMaterial(1e-6 * VACUUM_RELUCTIVITY))

    def factor(poles: tuple[float, float]) -> None:
        system = CellSystem(Problem(grid.mesh, materials), grid, open_rim(grid, poles))
        system.tangents("banded")(np.zeros(grid.mesh.nodes.shape[0]))

    factor(iron.z)
    if length > 1:
        with pytest.raises(SingularMatrixError):
            factor((-1e-3, 1e-3))


def test_designs_are_open(mid_stroke: TubularSolution, spec: Spec) -> None:
    """Catches a design solved in a closed box: ψ does not vanish on the far edge, and more air changes little."""
    psi, grid = mid_stroke.solution.psi, mid_stroke.grid
    rim = np.abs(psi[grid.node(np.arange(grid.z_nodes.size), grid.r_nodes.size - 1)]).max()
    assert rim > 0
    assert not psi[grid.node(np.arange(grid.z_nodes.size), 0)].any()
    assert mid_stroke.section.ends == pytest.approx((spec.actuator.yoke_start, spec.actuator.yoke_end))


def test_less_air_will_do(spec: Spec) -> None:
    """Catches an open boundary that gains nothing: bare of its yoke, in a third of the air; edges of equal meshes.

    Cells in the air are those of a geometric row, so that shorter air is the same mesh cut off.
    """
    yoke = replace(spec.actuator.back_yoke, material="aluminium 6061")
    whole = cross_section(replace(spec.actuator, back_yoke=yoke), 0.027, spec.materials, 293.15)

    def linkage(r_cells: int, z_cells: int, is_open: bool) -> float:
        far = 0.081
        dr, dz = (
            far * (growth**n - 1) / (growth**whole_n - 1)
            for growth, n, whole_n in ((1.8, r_cells, 6), (1.6, z_cells, 7))
        )
        r = replace(whole.r, values=(*whole.r.values[:-1], whole.r.values[-2] + dr))
        z = whole.z.values
        cut = Breakpoints((z[1] - dz, *z[1:-1], z[-2] + dz), ("low", *whole.z.intervals[1:-1], "high"))
        found = replace(whole, r=r, z=cut)
        grid = mapped_mesh(
            found,
            {**R_CELLS, "far air": Subdivision(r_cells, 1.8, "start")},
            {**Z_CELLS, "low": Subdivision(z_cells, 1.6, "end"), "high": Subdivision(z_cells, 1.6, "start")},
            open_rim=is_open,
        )
        materials = tuple(magnetic_material(region) for region in found.regions)
        problem = Problem(grid.mesh, materials, circuits(grid, found.coils))
        rim = open_rim(grid, found.ends) if is_open else None
        solution = solve(problem, system=CellSystem(problem, grid, rim))
        assert solution.convergence.converged
        return float(np.linalg.norm(flux_linkages(solution)))

    exact = linkage(9, 11, False)
    closed, opened, whole_open = (linkage(*case) / exact - 1 for case in ((4, 5, False), (4, 5, True), (6, 7, True)))
    assert abs(opened) < abs(closed) / 4
    assert abs(whole_open) < 3e-5
