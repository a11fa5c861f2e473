"""A coil in air and a saturable pot magnet as FEMM files: an independent solver's figures, exact ones, and its own.

The other solver has linear triangles, 46,000 for the coil and 61,000 for the magnet, refined near the parts only: its
energies and linkages are good to 0.3 %, its forces to 0.5 %. Its field is not held against ours, since it is off by
2 % on the axis of the coil, where the exact field is known.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "validation"))

from exact.coils import Coil, coil_flux_density, inductance

from fluxbore.fem.femm_reader import read_model
from fluxbore.fem.femm_solution import FemmSolution, solve_model

DATA = Path(__file__).parents[1] / "data"
MM = 1e-3

AIR_COIL = ((0.0, 0.0), (5.0, 0.0), (0.0, 20.0), (25.0, 0.0), (45.0, 5.0))
PLUNGER = ((4.0, 1.5), (4.0, -12.0), (22.5, 0.0), (4.0, 20.0), (8.5, 33.0), (15.0, 0.0))
"""Working gap, plunger, shell, plunger, collar's gap, winding; all away from corners (mm)."""


@cache
def air_coil() -> FemmSolution:
    return solve_model(read_model(DATA / "aircoil.fem"), (), AIR_COIL)


@cache
def plunger(accuracy: float | None = None) -> FemmSolution:
    return solve_model(read_model(DATA / "plunger.fem"), (1,), PLUNGER, accuracy)


def test_air_coil_by_another_solver() -> None:
    """Catches a factor of 2π or of the turns: 400 turns, 2 A."""
    solved = air_coil()
    assert solved.adapted.reached
    assert solved.linkages == pytest.approx([0.01460415], rel=3e-3)
    assert solved.energies == pytest.approx((0.01460122, 0.01460122), rel=3e-3)


def test_air_coil_exactly() -> None:
    """Catches what two solvers might share: the coil without its box, which takes 3e-4, by integrals of Bessel's."""
    coil = Coil(400, 2.0, 0.02, 0.03, -0.01, 0.01)
    assert air_coil().linkages == pytest.approx([2 * inductance(coil, coil)], rel=3e-3)
    found = air_coil().probe(np.array(AIR_COIL)).flux_density
    for at, b in zip(AIR_COIL, found, strict=True):
        exact = coil_flux_density((coil,), at[0] * MM, at[1] * MM)
        assert np.hypot(*(b - exact)) < 3e-3 * np.hypot(*exact), at


SIZES = (0.4, 0.35, 0.45, 0.225, 0.9, 5.0)
"""Of the other solver's mesh, by label (mm)."""


@pytest.mark.full
def test_plunger_by_another_solver() -> None:
    """Catches a steel, a circuit or a force that another program reads differently: 1000 turns, 1.5 A, 1.2 T.

    On its own mesh sizes; the converged linkage is another 0.05 % further from its coarser elements' value.
    """
    model = read_model(DATA / "plunger.fem")
    labels = tuple(replace(label, size=size) for label, size in zip(model.labels, SIZES, strict=True))
    solved = solve_model(replace(model, labels=labels), (1,))
    assert solved.adapted.reached
    assert solved.linkages == pytest.approx([0.18847261], rel=3e-3)
    assert solved.energies == pytest.approx((0.14118090, 0.14156831), rel=3e-3)
    force = solved.force(1)
    assert force.by_stress.force[1] == pytest.approx(-26.478941, rel=5e-3)
    assert force.error < 0.01 * abs(force.by_stress.force[1])


def test_plunger_by_a_finer_mesh() -> None:
    """Catches a default accuracy that does not hold what it says, on corners of saturated iron."""
    coarse, fine = plunger(), plunger(1e-4)
    assert fine.adapted.levels[-1].unknowns > 2 * coarse.adapted.levels[-1].unknowns
    assert coarse.linkages == pytest.approx(fine.linkages, rel=1.5e-3)
    assert coarse.energies == pytest.approx(fine.energies, rel=1.5e-3)
    assert coarse.force(1).by_stress.force[1] == pytest.approx(fine.force(1).by_stress.force[1], rel=2.5e-3)
    a, b = (solved.probe(np.array(PLUNGER)).flux_density for solved in (coarse, fine))
    assert np.all(np.hypot(*(a - b).T) < 3e-3 * np.hypot(*b.T))


def test_plunger_force_is_the_slope_of_its_coenergy() -> None:
    """Catches a force that is no derivative of the field's energy: I dλ/dz − dW/dz between two positions."""
    model = read_model(DATA / "plunger.fem")
    step = 0.2
    energies = []
    for shift in (-step, step):
        moved = tuple(
            replace(node, y=node.y + shift) if node.x in (0.0, 8.0) and node.y in (3.0, 60.0) else node
            for node in model.nodes
        )
        energies.append(solve_model(replace(model, nodes=moved), (), (), 1e-4).energies[1])
    slope = (energies[1] - energies[0]) / (2 * step * MM)
    assert plunger(1e-4).force(1).by_stress.force[1] == pytest.approx(slope, rel=1e-2)
