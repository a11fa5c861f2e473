"""Rates of figures of the validation's cases: linkages in all of space, forces and torques."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from manufactured import ENERGY_RATE, slope, solved_levels

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from cases import Case, air_coils, conductors, iron, magnets
from cases.exterior import with_exterior

from fluxbore.fem.body_force import stress_force
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.weight import layer_weight, smooth_weight

FORCE = 2.5
"""Least rate of forces."""


def figures(case: Case, count: int, read: Callable[[Solution], float]) -> list[float]:
    model = with_exterior(case.model) if case.open_boundary else case.model
    return [read(solution) for solution in solved_levels(model, count)]


def exact_of(case: Case, *path: str | int) -> float:
    return next(check.exact for check in case.checks if check.path == path)


def test_planar_exterior_keeps_the_order() -> None:
    """Catches a seam of two circles that is not conformal: two wires in all of the plane."""
    case = conductors.two_wires_in_two_discs()
    exact = exact_of(case, "circuits", "line", "flux_linkage")
    found = figures(case, 2, lambda s: float(flux_linkages(s)[0]))
    assert slope(np.array(found) / exact - 1) > ENERGY_RATE, found


def test_axisymmetric_exterior_converges() -> None:
    """Catches a wrong factor on ν in the exterior ball. Third order: at infinity ψ of a dipole is no polynomial."""
    case = air_coils.kelvin_exterior()
    exact = exact_of(case, "circuits", "coil", "flux_linkage")
    found = figures(case, 3, lambda s: float(flux_linkages(s)[0]))
    assert slope(np.array(found) / exact - 1) > 2.8, found


FORCES = {
    "wire in a tube": (conductors.confined_wire, 0, 3),
    "wires beside iron": (iron.wires_beside_iron, 0, 2),
    "two coils": (air_coils.two_coils, 1, 3),
    "ball and coil": (iron.ball_and_coil, 1, 3),
}
"""Case, axis, and number of meshes."""


@pytest.mark.parametrize("name", FORCES)
def test_force_converges(name: str) -> None:
    """Catches a force whose order is that of its worst element: by the stress tensor over all of the air between."""
    build, axis, count = FORCES[name]
    case = build()
    exact = exact_of(case, "groups", "1", "force", axis)
    found = figures(case, count, lambda s: stress_force(s, smooth_weight(s.problem, (0,))).force[axis])
    assert slope(np.array(found) / exact - 1) > FORCE, found


def test_torque_converges() -> None:
    """Catches an arm about another point than the origin, and a torque of low order."""
    case = magnets.torque_on_a_cylinder()
    exact = exact_of(case, "groups", "1", "torque")
    found = figures(case, 3, lambda s: stress_force(s, smooth_weight(s.problem, (0,))).torque)
    assert slope(np.array(found) / exact - 1) > FORCE, found


def test_layer_force_converges() -> None:
    """Catches a virtual displacement of the layer alone that loses the order of the smooth one: a wire in a tube."""
    case = conductors.confined_wire()
    exact = exact_of(case, "groups", "1", "force", 0)
    found = figures(case, 3, lambda s: stress_force(s, layer_weight(s.problem, (0,))).force[0])
    assert slope(np.array(found) / exact - 1) > FORCE, found
