"""The hybrid actuator's cross-section: every part in its place at every position."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.design.errors import MaterialError
from fluxbore.design.spec import Spec, load
from fluxbore.geometry.cross_section import CrossSection
from fluxbore.geometry.hybrid import FAR_DIAMETERS, STRAY_DISTANCE, cross_section

EXAMPLE = Path(__file__).parents[2] / "examples" / "ipehla.toml"
SPEC: Spec = load(EXAMPLE)
ROOM = 293.15


def section_of(spec: Spec, position: float) -> CrossSection:
    return cross_section(spec.actuator, position, spec.materials, ROOM)


def region_at(section: CrossSection, r: float, z: float) -> str:
    i = int(np.searchsorted(section.z.values, z)) - 1
    j = int(np.searchsorted(section.r.values, r)) - 1
    return section.regions[section.cells[i, j]].name


def test_radii_are_the_dimensions() -> None:
    """Catches a diameter for a radius, and a clearance that is lost; the winding's own, 24.2 mm, needs no line."""
    section = section_of(SPEC, 0.027)
    radii = np.array([0, 8, 15.9, 16.1, 20, 25, 27, 37, 37 + 2 * 27 * FAR_DIAMETERS]) / 2e3
    assert section.r.values == pytest.approx(radii)
    assert pytest.approx(5e-3) == STRAY_DISTANCE


def test_parts_lie_where_the_position_puts_them() -> None:
    """Catches a mover that is measured from its middle, or that moves the other way: z is the array's cap-side face."""
    section = section_of(SPEC, 0.030)
    magnet_r, yoke_r = 6e-3, 13e-3
    assert region_at(section, magnet_r, 0.0299) == "air"
    assert region_at(section, magnet_r, 0.0301) == "ring"
    assert region_at(section, magnet_r, 0.0309) == "magnet 1"
    assert region_at(section, magnet_r, 0.030 + 12e-3) == "ring"
    assert region_at(section, magnet_r, 0.030 + 18e-3) == "magnet 2"
    assert region_at(section, magnet_r, 0.030 + 95.9e-3) == "ring"
    assert region_at(section, magnet_r, 0.030 + 96.1e-3) == "air"
    assert region_at(section, yoke_r, -0.0139) == "back yoke"
    assert region_at(section, yoke_r, -0.0141) == "air"
    assert region_at(section, yoke_r, 0.1909) == "back yoke"
    assert region_at(section, yoke_r, 0.1911) == "air"
    for r in (2e-3, 9e-3, 11e-3, 12.3e-3, 16e-3):
        assert region_at(section, r, 0.08) == "air"


def test_magnets_alternate() -> None:
    """Catches two neighbours that point the same way: the sum of all eight is zero, the first points to the rod end."""
    remanences = [region.remanence for region in section_of(SPEC, 0.03).regions if region.remanence]
    assert remanences == pytest.approx([1.4, -1.4] * 4)


def test_warm_magnets_are_weaker() -> None:
    """Catches a temperature that does not reach the magnets: about −0.11 %/K."""
    warm = cross_section(SPEC.actuator, 0.03, SPEC.materials, ROOM + 60)
    strongest = max(region.remanence for region in warm.regions)
    assert 0.92 < strongest / 1.4 < 0.945


def test_coils_stand_side_by_side() -> None:
    """Catches another order than U V W U V W, gaps between coils, and a first U coil that is not centred on z = 0."""
    coils = section_of(SPEC, 0.03).coils
    assert [coil.circuit for coil in coils] == ["U", "V", "W"] * 8
    assert sum(coils[0].z) == pytest.approx(0.0)
    for one, two in pairwise(coils):
        assert one.z[1] == pytest.approx(two.z[0])
    assert sum(coil.turns for coil in coils) == pytest.approx(3 * 584)
    assert {coil.r for coil in coils} == {(10e-3, 12.1e-3)}
    assert coils == section_of(SPEC, 0.05).coils, "coils stand still"


def test_air_reaches_far_all_round() -> None:
    """Catches a boundary that comes near at an end of the stroke."""
    far = FAR_DIAMETERS * 27e-3
    for position in (0.0, 0.044, 0.088):
        section = section_of(SPEC, position)
        assert section.z.values[0] == pytest.approx(-0.014 - far)
        assert section.z.values[-1] == pytest.approx(0.191 + far)


def test_no_rings() -> None:
    """Catches an interval of no length: without rings the magnets touch, and half rings vanish too."""
    section = section_of(SPEC.with_values({"actuator.mover.ring_width": 0.0}), 0.03)
    assert not any(name.endswith("ring") for name in section.z.intervals)
    assert section.z.intervals.count("magnet") == 8


@given(st.floats(0.0, 0.088), st.floats(0.0, 11.9e-3), st.floats(0.1e-3, 2.3e-3))
@settings(max_examples=60, deadline=None)
def test_every_design_is_a_stack(position: float, ring: float, thickness: float) -> None:
    """Catches breakpoints out of order, edges off the breakpoints, and a force shell that is not all air."""
    spec = SPEC.for_study().with_values({"actuator.mover.ring_width": ring, "actuator.back_yoke.thickness": thickness})
    section = section_of(spec, position)
    for rectangle in section.rectangles:
        for edge, values in ((rectangle.r, section.r.values), (rectangle.z, section.z.values)):
            assert all(min(abs(x - v) for v in values) < 2e-9 for x in edge)
    inner, outer = section.force_annulus
    middle = (np.array(section.r.values[1:]) + np.array(section.r.values[:-1])) / 2
    assert np.all(section.cells[:, (inner < middle) & (middle < outer)] == 0)
    names = set(section.z.intervals)
    assert names <= {"ring", "half ring", "magnet", "cap end", "rod end", "beyond cap end", "beyond rod end"}


def test_magnetic_shaft_and_cylinder_are_laid_down() -> None:
    """Catches iron that the field does not see, or a force shell that runs through it."""
    iron = SPEC.with_values({"actuator.shaft.material": "1010", "actuator.cylinder.material": "1018"})
    section = section_of(iron, 0.03)
    assert region_at(section, 2e-3, 0.08) == "shaft"
    assert region_at(section, 2e-3, 0.0219) == "air"
    assert region_at(section, 2e-3, 0.0221) == "shaft"
    assert region_at(section, 9e-3, 0.08) == "cylinder"
    assert section.force_annulus == pytest.approx((7.95e-3, 8.05e-3))
    assert section_of(SPEC, 0.03).force_annulus == pytest.approx((7.95e-3, 10e-3))


@pytest.mark.parametrize("part", ["piston", "end_caps"])
def test_magnetic_ends_are_refused(part: str) -> None:
    """Catches a part of iron that the model would silently take for air."""
    with pytest.raises(MaterialError, match=f"actuator.{part}.material must name a non-magnetic material"):
        load(EXAMPLE, {f"actuator.{part}.material": "1010"})
