"""Rates of convergence, not values: a manufactured smooth field, and the motor with its edges and corners."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from nodal_field import nodal_flux_density

from fluxbore.design.spec import load
from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.cells import Cells
from fluxbore.fem.coil_windows import circuits
from fluxbore.fem.magnetostatics import Solution, solve
from fluxbore.fem.mapped import MappedMesh, Subdivision, mapped_mesh
from fluxbore.fem.problem import Circuit, MagneticMaterial, Problem
from fluxbore.fem.tubular import solve_positions, space_vector
from fluxbore.geometry.cross_section import Breakpoints, CoilWindow, CrossSection
from fluxbore.geometry.hybrid import cross_section

RADIUS, LENGTH = 0.1, 0.2
TOP = RADIUS**2 / 2
CELLS = (8, 16, 32)


def exact(s: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """ψ = sin(πs/S) sin(πz/L), which vanishes on the rim, with ∂ψ/∂s and the load −ψ_ss − ψ_zz/(2s), ν = 1."""
    a, b = np.pi / TOP, np.pi / LENGTH
    wave = np.sin(a * s) * np.sin(b * z)
    return wave, a * np.cos(a * s) * np.sin(b * z), (a**2 + b**2 / (2 * s)) * wave


def manufactured(cells: int, order: int = 2) -> tuple[MappedMesh, Solution]:
    """The field of that load on cells by cells rectangles, graded so that no symmetry helps."""
    section = CrossSection(
        Breakpoints((0.0, RADIUS), ("r",)), Breakpoints((0.0, LENGTH), ("z",)), (), np.zeros((1, 1), dtype=int), (), (),
        (0.0, 0.0),
    )  # fmt: skip
    first = 4 if order == 2 else 1
    division = Subdivision(first, 1.3, "start")
    grid = mapped_mesh(section, {"r": division}, {"z": division}, cells // first, order=order)
    bare = Cells(grid)
    nodes, values = grid.mesh.nodes[bare.nodes], bare.square.values
    shares = (exact(nodes[..., 0] @ values, nodes[..., 1] @ values)[2] * bare.weight) @ values.T
    load = np.bincount(bare.nodes.ravel(), shares.ravel(), grid.mesh.nodes.shape[0])
    problem = Problem(grid.mesh, (MagneticMaterial(1.0),), (Circuit("source", load, 1.0),))
    return grid, solve(problem, system=CellSystem(problem, grid))


@pytest.fixture(scope="module")
def fields() -> list[Solution]:
    return [manufactured(cells)[1] for cells in CELLS]


def energy_errors(fields: list[Solution]) -> list[float]:
    x, w = np.polynomial.legendre.leggauss(30)
    s, z = np.meshgrid(TOP * (x + 1) / 2, LENGTH * (x + 1) / 2)
    wave, _, load = exact(s, z)
    true = TOP * LENGTH / 4 * np.einsum("i,j,ij->", w, w, load * wave)
    return [abs(float(field.system.load @ field.psi) / true - 1) for field in fields]


def rates(errors: list[float]) -> np.ndarray:
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))


def test_energy_converges_with_the_fourth_power(fields: list[Solution]) -> None:
    """Catches a lost order anywhere: element, quadrature, 1/r next to the axis. Asserts a rate of at least 3.8."""
    errors = energy_errors(fields)
    assert np.all(rates(errors) > 3.8), errors


def test_energy_of_the_fourth_order_converges_with_the_eighth_power() -> None:
    """Catches a lost order of the designs' own cells: shape functions, quadrature, condensation."""
    errors = energy_errors([manufactured(cells, order=4)[1] for cells in (4, 8, 16)])
    assert rates(errors)[0] > 7.0, errors
    assert errors[-1] < 3e-11, "rounding"


def test_flux_density_converges_alike_on_the_axis_and_beside_it(fields: list[Solution]) -> None:
    """Catches the axis losing an order, where people look first: recovered B_z has a rate of about two on both."""
    on_axis, beside = [], []
    for field in fields:
        mesh = field.problem.mesh
        nodes, found = nodal_flux_density(field, np.arange(mesh.elements.shape[0]))
        s, z = mesh.nodes[nodes].T
        miss = np.abs(found[:, 1] - exact(np.maximum(s, 1e-30), z)[1]) * TOP / np.pi
        on_axis.append(float(np.sqrt(np.mean(miss[s == 0] ** 2))))
        beside.append(float(np.sqrt(np.mean(miss[s > 0] ** 2))))
    assert np.all(rates(on_axis) > 1.7), on_axis
    assert np.all(rates(beside) > 1.7), beside
    assert on_axis[-1] < 3 * beside[-1]


def test_linkage_of_a_window_converges_fast() -> None:
    """Catches a window integral of low order, its ends inside cells: a mean rate of at least 3."""
    window = CoilWindow("coil", 1.0, (0.0, RADIUS), (0.0437, 0.1113))
    x, w = np.polynomial.legendre.leggauss(40)
    r = RADIUS * (x + 1) / 2
    b = np.pi / LENGTH
    axial = (np.cos(b * window.z[0]) - np.cos(b * window.z[1])) / b
    true = RADIUS / 2 * float(w @ np.sin(np.pi * r**2 / 2 / TOP)) * axial / window.area
    solved = [manufactured(cells) for cells in CELLS]
    errors = [abs(float(circuits(grid, [window])[0].density @ field.psi) / true - 1) for grid, field in solved]
    assert rates(errors).mean() > 3, errors


def test_motor_force_and_linkage_have_converged() -> None:
    """Catches a motor whose meshes do not approach one another: on the mesh itself and refined, to 1e-4.

    Magnet edges and iron corners limit the rate; values are in docs/validation/fem.md.
    """
    spec = load(Path(__file__).parents[2] / "examples" / "ipehla.toml")
    found = []
    for refinement in (1, 2, 3):
        (item,) = solve_positions(
            lambda z: cross_section(spec.actuator, z, spec.materials, 293.15), [0.027], None, refinement
        )
        found.append([abs(space_vector(item.thrust_constants())), abs(space_vector(item.flux_linkages()))])
    assert np.abs(np.array(found) / found[-1] - 1).max() < 1e-4, found


@pytest.mark.parametrize(("stroke", "sets", "within"), [(88e-3, 8, 0.02), (200e-3, 13, 0.12)])
def test_inductance_of_coils_beside_the_mover(stroke: float, sets: int, within: float) -> None:
    """Catches ends whose cells are too long for the field of the coils in them: against the mesh refined twice."""
    spec = load(Path(__file__).parents[2] / "examples" / "ipehla.toml")
    actuator = spec.actuator
    actuator = replace(
        actuator,
        mover=replace(actuator.mover, stroke=stroke),
        winding=replace(actuator.winding, sets_per_phase=sets, turns=73.0 * sets),
    )
    coarse, fine = (
        solve_positions(
            lambda z: cross_section(actuator, z, spec.materials, 293.15), [actuator.mid_stroke], None, refinement
        )[0].synchronous_inductance()
        for refinement in (1, 2)
    )
    assert coarse == pytest.approx(fine, rel=within)


@pytest.mark.parametrize(("part", "within"), [("shaft", 0.005), ("cylinder", 0.03)])
def test_soft_iron_beside_the_magnets(part: str, within: float) -> None:
    """Catches a single cell across iron that shorts the magnets: the force constant against the mesh refined twice."""
    spec = load(Path(__file__).parents[2] / "examples" / "ipehla.toml")
    actuator = replace(spec.actuator, **{part: replace(getattr(spec.actuator, part), material="1010")})
    coarse, fine = (
        abs(
            space_vector(
                solve_positions(
                    lambda z: cross_section(actuator, z, spec.materials, 293.15), [0.027], None, refinement
                )[0].thrust_constants()
            )
        )
        for refinement in (1, 2)
    )
    assert coarse == pytest.approx(fine, rel=within)
