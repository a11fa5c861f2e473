"""A lead screw's field by elements and in closed form: two routes with nothing but the parameters in common."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from lead_screws import ARCS, PITCH, table_i

from fluxbore.design.helical_field import force_series
from fluxbore.design.lead_screw import LeadScrew
from fluxbore.design.materials import standard
from fluxbore.design.step_ripple import stepped_series
from fluxbore.fem.helical import solve
from fluxbore.fem.helical_arcs import arc_force, arc_harmonics, arc_torque
from fluxbore.fem.helical_force import force, torque
from fluxbore.geometry.lead_screw import helical_section

WITHIN = 1e-3
STEEL = standard()["1010"].curve


def periods(screw: LeadScrew) -> float:
    return screw.poles / 2


@pytest.mark.parametrize("irons", [(True, True), (True, False), (False, False)])
@pytest.mark.parametrize("starts", [1, 6])
def test_force_and_torque_of_the_three_irons(irons: tuple[bool, bool], starts: int) -> None:
    """Catches a member, a rim or a length that means something else in one of the two."""
    screw = replace(table_i(*irons), starts=starts)
    series = force_series(screw)
    for share in (0.08, 0.25):
        found = solve(helical_section(screw, share * PITCH))
        expected = float(series.force(share * PITCH))
        assert force(found) * periods(screw) == pytest.approx(expected, rel=WITHIN)
        assert torque(found) * periods(screw) == pytest.approx(screw.h * expected, rel=WITHIN)


@pytest.mark.parametrize("stepped", [True, False])
def test_averaged_arcs(stepped: bool) -> None:
    """Catches a mean over the wrong angle: the translator's poles of five arcs of 60 degrees, the rotor's whole."""
    screw = table_i()
    screw = replace(screw, translator=replace(screw.translator, arcs=replace(ARCS, per_turn=5, stepped=stepped)))
    found = force(solve(helical_section(screw, PITCH / 4))) * periods(screw)
    assert found == pytest.approx(float(force_series(screw).force(PITCH / 4)), rel=WITHIN)


def test_ripple_of_arcs_on_both_members() -> None:
    """Catches the sign of an angle, a lead of a wave or a weight of it: against closed forms, over a turn."""
    screw = table_i()
    arcs = replace(ARCS, angle=math.radians(55.0))
    stepped = replace(screw, translator=replace(screw.translator, arcs=arcs), rotor=replace(screw.rotor, arcs=arcs))
    series = stepped_series(stepped)
    waves = arc_harmonics(helical_section(screw), arcs, arcs, orders=(1, 3, 5), reach=9)
    angles = np.linspace(0, 1.5, 40)
    for share in (0.0, 0.11, 0.25):
        expected = series.force(share * PITCH, angles)
        # The closed form counts the rotor's angle the way the paper does, x_d = h θ − x: against ours.
        found = arc_force(waves, PITCH, share * PITCH, -angles) * periods(screw)
        assert np.allclose(found, expected, rtol=0, atol=WITHIN * 130)
        twist = arc_torque(waves, PITCH, share * PITCH, -angles) * periods(screw)
        # Waves beyond the reach, of little force and much angle, are left out.
        assert np.allclose(twist, series.torque(share * PITCH, angles), rtol=0, atol=0.01 * 130 * screw.h)


def test_real_iron_behind_both_members() -> None:
    """Catches iron that is left out or as thick as the rim: 5 mm of steel 1010 are all but ideal, 0.2 mm are not."""
    screw = table_i()
    ideal = force(solve(helical_section(screw, PITCH / 4)))
    steel = force(solve(helical_section(screw, PITCH / 4, STEEL, STEEL)))
    assert ideal * (1 - 5e-4) < steel < ideal
    thin = replace(
        screw,
        translator=replace(screw.translator, iron_thickness=0.2e-3),
        rotor=replace(screw.rotor, iron_thickness=0.2e-3),
    )
    saturated = force(solve(helical_section(thin, PITCH / 4, STEEL, STEEL)))
    none = force(solve(helical_section(table_i(False, False), PITCH / 4)))
    assert none < saturated < 0.99 * steel


def test_air_computed_is_enough() -> None:
    """Catches a rim too near: another pitch of air, within and outside, changes nothing that counts."""
    section = helical_section(table_i(False, False), PITCH / 4)
    wider = replace(
        section,
        inner_radius=section.inner_radius - PITCH,
        layers=(*section.layers[:-1], replace(section.layers[-1], outer_radius=section.radii[-1] + PITCH)),
    )
    near, far = (force(solve(part, refinement=2)) for part in (section, wider))
    assert near == pytest.approx(far, rel=3e-5)
