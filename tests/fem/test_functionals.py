"""Figures read off a field as functionals: their values, and their derivatives by field, mesh lines and limits."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_motor import difference, small_section, solved, with_lines

from fluxbore.fem import functionals
from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.functionals import EXPONENT, Functional, clipped_integral, norm
from fluxbore.fem.mapped import by_lines
from fluxbore.fem.problem import MagneticMaterial
from fluxbore.fem.tubular import (
    TubularSolution,
    mean_reverse_field,
    shell_flux_density,
    stray_field,
    tube_flux_density,
)

Array = np.ndarray
LIMITS = {"stray": (-0.0213, 0.0558), "ring": (0.0161, 0.0247)}
NAMES = ("yoke", "stray", "ring", "reverse")


@pytest.fixture(scope="module")
def tubular() -> TubularSolution:
    return solved(small_section())


def made(tubular: TubularSolution, name: str, limits: tuple[float, float], exponent: float = EXPONENT) -> Functional:
    """One figure; its place is that of the motor's parts, whatever the grid's lines have been moved by."""
    yoke = tubular.section.r.intervals.index("back yoke")
    radii = [float(tubular.grid.r_lines[np.argmin(np.abs(tubular.grid.r_lines - r))]) for r in tubular.section.r.values]
    low, high = tubular.section.ends
    if name == "yoke":
        return functionals.tube_norm(tubular, (radii[yoke], radii[yoke + 1]), (low - 1e-4, high + 1e-4), exponent)
    if name == "stray":
        return functionals.line_norm(tubular, radii[yoke + 2], limits, exponent)
    if name == "ring":
        return functionals.shell_mean(tubular, radii[2], limits)
    return functionals.reverse_norm(tubular, exponent)


def with_field(tubular: TubularSolution, psi: Array) -> TubularSolution:
    return replace(tubular, solution=replace(tubular.solution, psi=psi))


def on_other_lines(tubular: TubularSolution, s: Array, z: Array) -> TubularSolution:
    """The same ψ at the nodes of a moved mesh."""
    grid = with_lines(tubular.grid, s, z)
    problem = replace(tubular.solution.problem, mesh=grid.mesh)
    solution = replace(tubular.solution, problem=problem, system=CellSystem(problem, grid))
    return replace(tubular, grid=grid, solution=solution)


@pytest.mark.parametrize("name", NAMES)
def test_by_the_field(tubular: TubularSolution, name: str) -> None:
    """Catches a derivative that is zero where it is small: by ψ at nodes near the place, and along any direction."""
    limits = LIMITS.get(name, (0.0, 0.0))
    found = made(tubular, name, limits)
    psi = tubular.solution.psi
    rng = np.random.default_rng(1)
    direction = np.abs(psi).max() * rng.uniform(-1, 1, psi.size)
    expected = difference(lambda step: made(with_field(tubular, psi + step * direction), name, limits).value, 1e-6)
    assert found.by_psi @ direction == pytest.approx(float(expected), rel=1e-6)
    assert 0 < np.count_nonzero(found.by_psi) < psi.size / 2


@pytest.mark.parametrize("name", NAMES)
def test_by_the_mesh_lines(tubular: TubularSolution, name: str) -> None:
    """Catches a part of the mesh that does not take its points along: every line of s and z, ψ staying at its nodes."""
    limits = LIMITS.get(name, (0.0, 0.0))
    found = made(tubular, name, limits)
    s, z = tubular.grid.r_lines**2 / 2, tubular.grid.z_lines
    for axis, (lines, own) in enumerate(((s, found.s), (z, found.z))):
        for k in range(1 - axis, lines.size):
            reach = float(np.diff(lines)[max(k - 1, 0) : k + 1].min())

            def at(step: float, k: int = k, axis: int = axis, reach: float = reach) -> float:
                moved = [s.copy(), z.copy()]
                moved[axis][k] += step * reach
                return made(on_other_lines(tubular, *moved), name, limits).value

            expected = float(difference(at, 1e-4)) / reach
            assert own[k] == pytest.approx(expected, rel=1e-6, abs=1e-7 * found.value / reach), (axis, k)


@pytest.mark.parametrize("name", list(LIMITS))
def test_by_its_limits(tubular: TubularSolution, name: str) -> None:
    """Catches an end of the wrong sign, or a length that the mean is not divided by."""
    low, high = LIMITS[name]
    found = made(tubular, name, (low, high))
    expected = [
        float(difference(lambda step: made(tubular, name, (low + step, high)).value, 1e-6)),
        float(difference(lambda step: made(tubular, name, (low, high + step)).value, 1e-6)),
    ]
    assert found.limits == pytest.approx(expected, rel=1e-6)
    assert not made(tubular, "yoke", (low, high)).limits.any()


def test_by_the_magnets(tubular: TubularSolution) -> None:
    """Catches a remanence that does not shift what opposes it: reluctivity and coercivity of each magnet, ψ fixed."""
    found = made(tubular, "reverse", (0.0, 0.0))
    assert found.reluctivity is not None
    assert found.coercivity is not None
    problem = tubular.solution.problem
    for k, material in enumerate(problem.materials):
        if not material.remanence[1]:
            assert found.reluctivity[k] == found.coercivity[k] == 0
            continue
        nu, h_c = material.components[0], material.coercivity[1]

        def at(step: float, by_nu: bool, k: int = k, nu: float = nu, h_c: float = h_c) -> float:
            changed = MagneticMaterial(nu + step * by_nu, (0.0, h_c + step * (not by_nu)))
            materials = (*problem.materials[:k], changed, *problem.materials[k + 1 :])
            other = replace(tubular.solution, problem=replace(problem, materials=materials))
            return made(replace(tubular, solution=other), "reverse", (0.0, 0.0)).value

        by_nu = float(difference(lambda step: at(step, True), 1e-4 * nu))
        by_h = float(difference(lambda step: at(step, False), 1e-4 * abs(h_c)))
        assert found.reluctivity[k] == pytest.approx(by_nu, rel=1e-6)
        assert found.coercivity[k] == pytest.approx(by_h, rel=1e-6)


def test_norms_come_up_to_the_maxima(tubular: TubularSolution) -> None:
    """Catches a norm of other numbers than the figure's: below it, and within 2 % of it at an exponent of 500."""
    low, high = tubular.section.ends
    yoke = tubular.section.r.intervals.index("back yoke")
    r = tubular.section.r.values
    pairs = {
        "yoke": tube_flux_density(tubular, (r[yoke], r[yoke + 1]), (low - 1e-4, high + 1e-4)),
        "stray": stray_field(tubular, r[yoke + 2], LIMITS["stray"]),
    }
    for name, largest in pairs.items():
        values = [made(tubular, name, LIMITS["stray"], exponent).value for exponent in (8.0, 32.0, 500.0)]
        assert values[0] < values[1] < values[2] <= largest * (1 + 1e-12)
        assert values[2] > 0.98 * largest


def test_values_are_the_evaluations(tubular: TubularSolution) -> None:
    """Catches two definitions of one figure: by the functional and by the evaluation."""
    radius = tubular.section.r.values[2]
    assert made(tubular, "ring", LIMITS["ring"]).value == pytest.approx(
        shell_flux_density(tubular, radius, LIMITS["ring"]), rel=1e-14
    )
    for exponent in (8.0, 32.0):
        assert functionals.reverse_norm(tubular, exponent).value == pytest.approx(
            mean_reverse_field(tubular, exponent), rel=1e-13
        )


@given(st.lists(st.floats(0.01, 100.0), min_size=1, max_size=12), st.sampled_from([2.0, 8.0, 32.0]))
def test_a_norm_lies_between_mean_and_maximum(samples: list[float], exponent: float) -> None:
    """Catches a sum in place of a mean, an overflow at large exponents, and a derivative that is not homogeneous."""
    x = np.array(samples)
    value, by_sample = norm(x, exponent)
    assert x.mean() * (1 - 1e-12) <= value <= x.max() * (1 + 1e-12)
    assert by_sample @ x == pytest.approx(value, rel=1e-12)  # Euler's, of degree one
    k = int(np.argmax(x))

    def at(step: float) -> float:
        moved = x.copy()
        moved[k] *= 1 + step
        return norm(moved, exponent)[0]

    assert by_sample[k] * x[k] == pytest.approx(float(difference(at, 1e-4)), rel=1e-7, abs=1e-12 * value)


def test_a_norm_of_nothing() -> None:
    """Catches a division by the largest of zeros."""
    value, by_sample = norm(np.zeros(3), 32.0)
    assert value == 0.0
    assert not by_sample.any()
    assert norm(np.full(4, 1e200), 32.0)[0] == pytest.approx(1e200)


@given(st.floats(-1.4, -0.1), st.floats(0.1, 1.4))
def test_a_clipped_integral(low: float, high: float) -> None:
    """Catches a hat that is cut wrongly: against fine quadrature, and its derivatives against differences."""
    x, f = np.array([-1.5, -0.7, 0.05, 0.4, 1.5]), np.array([1.0, 3.0, -2.0, 0.5, 4.0])
    value, by_f, by_x, by_limits = clipped_integral(x, f, (low, high))
    fine = np.unique(np.concatenate((x[(x > low) & (x < high)], [low, high])))
    assert value == pytest.approx(float(np.trapezoid(np.interp(fine, x, f), fine)), abs=1e-13)
    assert by_f @ f == pytest.approx(value, abs=1e-13)
    # To stretch all lengths by a factor stretches the integral by it.
    assert by_x @ x + by_limits @ (low, high) == pytest.approx(value, abs=1e-12)
    # Next to a corner of f or a limit at a node, a difference is one-sided.
    apart = np.min(np.abs(np.subtract.outer([low, high], x))) > 1e-3
    for k in range(1, 4) if apart else ():

        def at(step: float, k: int = k) -> float:
            moved = x.copy()
            moved[k] += step
            return clipped_integral(moved, f, (low, high))[0]

        assert by_x[k] == pytest.approx(float(difference(at, 1e-4)), abs=1e-9)


def test_nodes_by_lines(tubular: TubularSolution) -> None:
    """Catches middles that move with one neighbour: a function of the nodes, by its lines."""
    grid = tubular.grid
    rng = np.random.default_rng(3)
    by_nodes = rng.uniform(-1, 1, (grid.mesh.nodes.shape[0], 2))
    lattice = by_nodes.reshape(grid.z_nodes.size, grid.r_nodes.size, 2)
    s, z = by_lines(lattice[..., 0].sum(axis=0), grid.order), by_lines(lattice[..., 1].sum(axis=1), grid.order)
    move_s, move_z = rng.uniform(0, 1, grid.r_lines.size), rng.uniform(-1, 1, grid.z_lines.size)
    moved = with_lines(grid, grid.r_lines**2 / 2 + 1e-9 * move_s, grid.z_lines + 1e-9 * move_z)
    expected = np.sum(by_nodes * (moved.mesh.nodes - grid.mesh.nodes)) / 1e-9
    assert s @ move_s + z @ move_z == pytest.approx(expected, rel=1e-5)
