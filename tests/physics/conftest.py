"""Magnets, iron and coils in free space on a mapped mesh: problems with an exact answer."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.hybrid_values import positions
from fluxbore.design.spec import Spec, load
from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.coil_windows import circuits
from fluxbore.fem.magnetostatics import Solution, solve
from fluxbore.fem.mapped import MappedMesh, Subdivision, mapped_mesh
from fluxbore.fem.problem import MagneticMaterial, Problem
from fluxbore.fem.tubular import TubularSolution, solve_positions
from fluxbore.geometry.cross_section import Breakpoints, CoilWindow, CrossSection, Rectangle, Region, paint
from fluxbore.geometry.hybrid import cross_section

Part = tuple[MagneticMaterial, tuple[float, float], tuple[float, float]]
"""Material, r and z from lower to upper (m)."""


@dataclass(frozen=True)
class Free:
    """A problem in free space and its field with the given currents."""

    grid: MappedMesh
    solution: Solution


@pytest.fixture(scope="session")
def free_space() -> Callable[..., Free]:
    """Solve parts and coils in air that ends ``far`` (m) away, all edges of parts and coils' radii being mesh lines."""

    def build(
        parts: Sequence[Part],
        coils: Sequence[CoilWindow] = (),
        far: float = 1.0,
        currents: Sequence[float] = (),
        cells: int = 8,
        refinement: int = 1,
        more_r: Sequence[float] = (),
        more_z: Sequence[float] = (),
    ) -> Free:
        r = sorted({0.0, *more_r, *(x for part in parts for x in part[1]), *(x for coil in coils for x in coil.r)})
        edges = [*more_z, *(x for part in parts for x in part[2])] or [x for coil in coils for x in coil.z]
        z = sorted(set(edges))
        r_points = Breakpoints((*r, r[-1] + far), (*["near"] * (len(r) - 1), "beyond"))
        z_points = Breakpoints((z[0] - far, *z, z[-1] + far), ("before", *["near"] * (len(z) - 1), "beyond"))
        near = Subdivision(cells, 1.3)
        subdivisions = {
            "near": near,
            "beyond": Subdivision(2 * cells, 1.35, "start"),
            "before": Subdivision(2 * cells, 1.35, "end"),
        }
        rectangles = [Rectangle(Region(f"part {i}", None), part[1], part[2]) for i, part in enumerate(parts)]
        regions, cell_regions = paint(r_points, z_points, rectangles)
        section = CrossSection(r_points, z_points, regions, cell_regions, tuple(coils), tuple(rectangles), (0.0, 0.0))
        grid = mapped_mesh(section, subdivisions, subdivisions, refinement)
        materials = (MagneticMaterial(), *(part[0] for part in parts))
        loaded = circuits(grid, coils)
        if currents:
            loaded = tuple(
                type(circuit)(circuit.name, circuit.density, current)
                for circuit, current in zip(loaded, currents, strict=True)
            )
        problem = Problem(grid.mesh, materials, loaded)
        return Free(grid, solve(problem, system=CellSystem(problem, grid)))

    return build


@pytest.fixture(scope="session")
def spec() -> Spec:
    """Nakata and Noda (2023), Table II."""
    return load(Path(__file__).parents[2] / "examples" / "ipehla.toml")


@pytest.fixture(scope="session")
def motor(spec: Spec) -> Callable[..., list[TubularSolution]]:
    """The published motor's field at no current at given positions (m)."""

    def at(positions: Sequence[float], refinement: int = 1) -> list[TubularSolution]:
        return solve_positions(
            lambda z: cross_section(spec.actuator, z, spec.materials, 293.15), positions, None, refinement
        )

    return at


@pytest.fixture(scope="session")
def window(spec: Spec, motor: Callable[..., list[TubularSolution]]) -> list[TubularSolution]:
    """The published motor over its window of eight positions."""
    solved = motor(positions(spec.values))
    assert len(solved) == 8
    assert all(item.convergence.converged for item in solved)
    return solved


@pytest.fixture(scope="session")
def loops() -> Callable[[float, float, np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """Maxwell's mutual inductance (H) and force per A² (N, attraction positive) of coaxial loops a, b at distance z."""

    def pair(a: float, b: float, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        from scipy.special import ellipe, ellipkm1

        mu_0 = 4e-7 * np.pi
        z = np.abs(np.asarray(z, dtype=float))
        square = 4 * a * b / ((a + b) ** 2 + z**2)
        k = np.sqrt(square)
        rest = ((a - b) ** 2 + z**2) / ((a + b) ** 2 + z**2)  # 1 − k², without cancellation
        first, second = ellipkm1(rest), ellipe(square)
        mutual = mu_0 * np.sqrt(a * b) * ((2 / k - k) * first - 2 / k * second)
        force = mu_0 * z * k / (4 * np.sqrt(a * b)) * ((2 - square) / rest * second - 2 * first)
        return mutual, force

    return pair
