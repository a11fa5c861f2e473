"""The published motor, and small meshes that every test of this room can afford."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.spec import Spec, load
from fluxbore.fem.mapped import MappedMesh, Subdivision, mapped_mesh
from fluxbore.fem.tubular import TubularSolution, solve_positions
from fluxbore.geometry.cross_section import Breakpoints, CrossSection
from fluxbore.geometry.hybrid import cross_section


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
