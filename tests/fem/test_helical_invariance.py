"""What no figure may depend on: the cut, the origin, whole periods, half a mesh or all of it, where a start was."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from rotlin_section import PERIOD, backed, ideal

from fluxbore.design.materials import standard
from fluxbore.fem.helical import solve, solve_displacements
from fluxbore.fem.helical_force import coenergy, force
from fluxbore.fem.magnetostatics import Settings
from fluxbore.geometry.helical_bands import Bands, Segment, alternating

BANDS = alternating(1.25)
STEEL = standard()["1010"].curve
TIGHT = Settings(tolerance=1e-11, method="auto")
UNLIKE = Bands((Segment(0.0, 0.4, 1.2, 1.2), Segment(0.4, 1.0, -0.8, -0.8)))


def test_half_a_period_and_all_of_it_agree() -> None:
    """Catches a sign or a factor of two of the mirrored mesh: a screw with a touch of asymmetry is solved whole."""
    touched = Bands((Segment(-0.25, 0.25, 1.25, 1.25), Segment(0.25, 0.75, -1.25, -1.25 * (1 + 1e-7))))
    half, whole = (solve(backed(bands, curve=STEEL, thickness=1e-3)) for bands in (BANDS, touched))
    assert (half.system.grid.copies, whole.system.grid.copies) == (2, 1)
    assert force(half) == pytest.approx(force(whole), rel=1e-6)
    assert coenergy(half) == pytest.approx(coenergy(whole), rel=1e-6)


@pytest.mark.parametrize("profile", [BANDS, UNLIKE])
@pytest.mark.parametrize("cut", [1, 10, -3])
def test_no_figure_depends_on_the_cut(profile: Bands, cut: int) -> None:
    """Catches a fold that is not one: every line is as good as any to cut the period along."""
    section = backed(profile, curve=STEEL, thickness=0.4e-3, displacement=0.17 * PERIOD)
    first, other = solve(section, settings=TIGHT), solve(section, settings=TIGHT, cut=cut)
    assert force(other) == pytest.approx(force(first), rel=1e-9)
    assert coenergy(other) == pytest.approx(coenergy(first), rel=1e-11)


def test_no_figure_depends_on_the_origin() -> None:
    """Catches a displacement of both members that is not one of the whole screw, by a share of a cell."""
    forces = [
        force(solve(ideal(alternating(1.2, 0.7, at), alternating(1.2, 0.9, at), 0.2 * PERIOD)))
        for at in (0.0, 0.0137, 0.61)
    ]
    assert np.ptp(forces) < 1e-9 * forces[0]


def test_a_period_on_the_force_is_the_same() -> None:
    """Catches a displacement that is lost or doubled in whole cells."""
    shifted = [force(solve(ideal(BANDS, BANDS, (0.23 + n) * PERIOD), settings=TIGHT)) for n in (0, 1, -3)]
    assert np.ptp(shifted) < 1e-9 * shifted[0]


def test_each_displacement_begins_from_the_one_before() -> None:
    """Catches a start that changes the result, and one that is never used."""
    section = backed(BANDS, curve=STEEL, thickness=1e-3)
    steps = [0.2 * PERIOD, 0.2001 * PERIOD, 0.2002 * PERIOD]
    found = solve_displacements(section, steps)
    assert [item.section.displacement for item in found] == steps
    assert found[1].convergence.iterations < found[0].convergence.iterations
    alone = solve(replace(section, displacement=steps[2]))
    assert force(found[2]) == pytest.approx(force(alone), rel=1e-7)


def test_a_failure_is_told() -> None:
    """Catches an iteration that ran out and passes for a field."""
    section = backed(BANDS, curve=STEEL, thickness=0.2e-3)
    found = solve_displacements(section, [0.0, 0.1e-3], settings=Settings(max_iterations=1, method="auto"))
    assert len(found) == 1
    assert "iteration limit" in found[0].convergence.sentence()
