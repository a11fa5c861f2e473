"""Forces by the stress tensor: their gradient, the slope of the energy they stand for, and Lorentz' law."""

import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import air_coils, conductors, iron, magnets
from cases.exterior import with_exterior
from manufactured import solved_levels

from fluxbore.fem.body_force import Component, lorentz_force, stress_force, stress_gradient, stress_scale
from fluxbore.fem.energy import energies
from fluxbore.fem.magnetostatics import Solution, System
from fluxbore.fem.mesh import Mesh
from fluxbore.fem.weight import layer_weight, smooth_weight

CASES = {
    "tube": conductors.confined_wire,
    "torque": magnets.torque_on_a_cylinder,
    "coils": air_coils.two_coils,
    "ball": iron.ball_and_coil,
}


@cache
def solved(name: str) -> Solution:
    return solved_levels(CASES[name]().model, 1)[0]


COMPONENTS: list[tuple[str, Component]] = [
    ("tube", "x"), ("tube", "y"), ("torque", "torque"), ("coils", "z"), ("ball", "z"),
]  # fmt: skip


@pytest.mark.parametrize("name, component", COMPONENTS)
def test_gradient(name: str, component: Component) -> None:
    """Catches a gradient that forgets the coils or a factor, on which refinement for a force rests."""
    solution = solved(name)
    region = next(k for k, label in enumerate(CASES[name]().model.labels) if label.group == 1)
    weight = smooth_weight(solution.problem, (region,))
    direction = np.random.default_rng(3).normal(size=solution.psi.size) * np.abs(solution.psi).max()
    column = {"x": 0, "y": 1, "z": 1}.get(component)

    def along(step: float) -> float:
        found = stress_force(replace(solution, psi=solution.psi + step * direction), weight)
        return found.torque if column is None else found.force[column]

    slope = (along(1e-3) - along(-1e-3)) / 2e-3
    assert stress_gradient(solution, weight, component) @ direction == pytest.approx(slope, rel=1e-6)


def test_layer_force_is_the_slope_of_the_discrete_energy() -> None:
    """Catches a wrong sign or factor, whatever the field: nodes moved by the weight at fixed ψ change the energy by −F.

    The ball of iron in a coil's field: F = −∂W/∂z at constant flux, and ψ at the nodes is the flux.
    """
    solution = solved("ball")
    weight = layer_weight(solution.problem, (0,))
    step = 1e-7

    def energy(shift: float) -> float:
        mesh = solution.problem.mesh
        nodes = mesh.nodes + np.column_stack((np.zeros(mesh.nodes.shape[0]), shift * weight.nodal))
        moved = replace(solution.problem, mesh=Mesh(mesh.chart, nodes, mesh.region, mesh.topology))
        return energies(replace(solution, problem=moved, system=System(moved)))[0]

    slope = (energy(step) - energy(-step)) / (2 * step)
    assert stress_force(solution, weight).force[1] == pytest.approx(-slope, rel=2e-3)


@pytest.mark.parametrize("name", ["tube", "coils"])
def test_lorentz_and_stress_agree(name: str) -> None:
    """Catches a coil's force that differs by route: J × B over the coil, the stress over the air."""
    solution = solved_levels(CASES[name]().model, 2)[-1]
    lorentz = lorentz_force(solution, (0,))
    assert lorentz is not None
    stress = stress_force(solution, smooth_weight(solution.problem, (0,)))
    assert stress.force == pytest.approx(lorentz.force, rel=5e-3, abs=5e-3 * float(np.hypot(*lorentz.force)))


def test_lorentz_is_for_coils_only() -> None:
    """Catches J × B given for iron or a magnet, whose own force it leaves out."""
    assert lorentz_force(solved("ball"), (0,)) is None
    assert lorentz_force(solved("torque"), (0,)) is None


def test_radial_force_around_the_axis_is_nothing() -> None:
    """Catches the sum of radial pulls, which cancel all the way round, given as a force."""
    solution = solved("coils")
    assert stress_force(solution, smooth_weight(solution.problem, (0,))).force[0] == 0.0


def test_reaction() -> None:
    """Catches a force without its reaction: two coils in all of space together are pulled by nothing."""
    solution = solved_levels(with_exterior(air_coils.two_coils().model), 2)[-1]
    a, b = (stress_force(solution, smooth_weight(solution.problem, (k,))).force[1] for k in (0, 1))
    assert abs(a + b) < 5e-3 * abs(a)


def test_scale_is_no_less_than_the_force() -> None:
    """Catches a scale that lets a force of zero pass as accurate."""
    solution = solved("tube")
    weight = smooth_weight(solution.problem, (0,))
    own, whole = stress_scale(solution, weight, "x")
    assert whole >= own >= abs(stress_force(solution, weight).force[0])
    assert stress_scale(solution, weight, "y")[0] > 100 * abs(stress_force(solution, weight).force[1])
