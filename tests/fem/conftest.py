"""The published motor, and small meshes that every test of this room can afford."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.spec import Spec, load
from fluxbore.fem.coil_windows import circuits
from fluxbore.fem.magnetostatics import Solution, solve
from fluxbore.fem.mapped import MappedMesh, Subdivision, mapped_mesh
from fluxbore.fem.problem import Problem
from fluxbore.fem.tubular import TubularSolution, magnetic_material, solve_positions
from fluxbore.geometry.cross_section import Breakpoints, CrossSection
from fluxbore.geometry.hybrid import cross_section

TRIANGLES_R = {
    **dict.fromkeys(("shaft", "cylinder", "winding", "back yoke"), Subdivision(3)),
    "magnet": Subdivision(5, 1.3),
    "clearance": Subdivision(1),
    "near air": Subdivision(3, 1.5, "start"),
    "far air": Subdivision(6, 1.8, "start"),
}
TRIANGLES_Z = {
    "ring": Subdivision(6, 1.6),
    "half ring": Subdivision(3),
    "magnet": Subdivision(6, 1.8),
    "cap end": Subdivision(10, 1.35, "end"),
    "rod end": Subdivision(10, 1.35, "start"),
    "beyond cap end": Subdivision(7, 1.6, "end"),
    "beyond rod end": Subdivision(7, 1.6, "start"),
}
"""Cells nearer to squares than the designs' own, for solvers that mind."""


@pytest.fixture(scope="session")
def spec() -> Spec:
    """Nakata and Noda (2023), Table II."""
    return load(Path(__file__).parents[2] / "examples" / "ipehla.toml")


@pytest.fixture(scope="session")
def mid_stroke(spec: Spec) -> TubularSolution:
    """The published motor with its mover in the middle."""
    actuator = spec.actuator
    return solve_positions(lambda z: cross_section(actuator, z, spec.materials, 293.15), [actuator.mid_stroke])[0]


@pytest.fixture(scope="session")
def in_triangles(spec: Spec) -> Solution:
    """The same in a closed box by the general solver, on quadratic triangles."""
    section = cross_section(spec.actuator, spec.actuator.mid_stroke, spec.materials, 293.15)
    grid = mapped_mesh(section, TRIANGLES_R, TRIANGLES_Z)
    materials = tuple(magnetic_material(region) for region in section.regions)
    return solve(Problem(grid.mesh, materials, circuits(grid, section.coils)))


@pytest.fixture(scope="session")
def block() -> Callable[..., MappedMesh]:
    """A cylinder of air from the axis to r = 0.1 m, z = 0 to 0.2 m, in cells by cells rectangles."""

    def build(cells: int, growth: float = 1.0) -> MappedMesh:
        section = CrossSection(
            Breakpoints((0.0, 0.1), ("r",)),
            Breakpoints((0.0, 0.2), ("z",)),
            (),
            np.zeros((1, 1), dtype=int),
            (),
            (),
            (0.04, 0.06),
        )
        return mapped_mesh(section, {"r": Subdivision(cells, growth)}, {"z": Subdivision(cells, growth)})

    return build
