"""Rates of forces and energies of lead screws: four, that of energies of quadratic elements."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from helical_bessel import exact_force
from manufactured import ENERGY_RATE
from periodic_rings import rings_force
from rotlin_section import PERIOD, backed, ideal

from fluxbore.design.materials import standard
from fluxbore.fem.helical import solve
from fluxbore.fem.helical_force import coenergy, force
from fluxbore.fem.magnetostatics import Settings
from fluxbore.geometry.helical_bands import Profile, Wave, alternating

TIGHT = Settings(tolerance=1e-11, method="auto")


def rates(errors: list[float]) -> np.ndarray:
    """(k − 1,) rates from each mesh to one of half its cells."""
    size = np.abs(errors)
    return np.asarray(np.log2(size[:-1] / size[1:]))


@pytest.mark.parametrize("profile", [Wave(1.2), alternating(1.2)])
@pytest.mark.parametrize("starts", [0, 1, 20])
def test_force_against_bessel_functions(profile: Profile, starts: int) -> None:
    """Catches an order lost to a weight that is integrated too coarsely, or to the folds.

    Bands have a logarithm at their edges; the lines are fine enough there for it not to show on these meshes.
    """
    section = ideal(profile, profile, 0.25 * PERIOD, starts * PERIOD)
    exact = exact_force(section)
    errors = [force(solve(section, refinement)) / exact - 1 for refinement in (1, 2, 4)]
    assert abs(errors[0]) < 1e-3
    assert rates(errors).min() > ENERGY_RATE, errors


def test_sheared_cells_keep_the_order() -> None:
    """Catches a gap whose cells lose an order where whole cells of displacement do not fit."""
    section = ideal(Wave(1.2), Wave(1.2), 0.2171 * PERIOD)
    exact = exact_force(section)
    errors = [force(solve(section, refinement)) / exact - 1 for refinement in (1, 2, 4)]
    assert rates(errors).min() > ENERGY_RATE - 0.3, errors


def test_force_to_the_axis() -> None:
    """Catches an order lost on the axis, where h²/r² has no bound."""
    section = replace(backed(Wave(1.2), 3.0, lead=4 * PERIOD), inner_radius=0.0)
    exact = exact_force(section)
    errors = [force(solve(section, refinement)) / exact - 1 for refinement in (1, 2)]
    assert rates(errors).min() > ENERGY_RATE, errors


def test_rings_against_the_axisymmetric_solver() -> None:
    """Catches a limit of short leads that is off by a constant: both solvers' forces meet at the elements' rate."""
    section = replace(backed(alternating(1.2), 200.0, lead=0.0, thickness=1e-3), outside="iron")
    apart = [force(solve(section, refinement)) / rings_force(section, refinement) - 1 for refinement in (1, 2)]
    assert abs(apart[0]) < 1e-3
    assert rates(apart).min() > 3.4, apart


@pytest.mark.full
def test_force_and_coenergy_of_saturated_iron() -> None:
    """Catches a nonlinear law integrated too coarsely: from its steps on meshes of 1, 2 and 3 times the cells.

    With an error of order p the steps' ratio is (1 − 2⁻ᵖ)/(2⁻ᵖ − 3⁻ᵖ): 5.4 at order two, 10 at three, 18.7 at four.
    """
    section = backed(Wave(1.25), curve=standard()["1010"].curve, thickness=0.5e-3)
    found = [solve(section, refinement, TIGHT) for refinement in (1, 2, 3)]
    for figure in (force, coenergy):
        steps = np.diff([figure(item) for item in found])
        assert steps[0] / steps[1] > 16, (figure, steps)
