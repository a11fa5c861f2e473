"""Parts as turned polygons: volumes, centres of mass, overlaps and clearances against closed forms."""

import math

import pytest
from scipy import integrate

from fluxbore.design.errors import DesignError
from fluxbore.geometry import assembly as geometry
from fluxbore.geometry import outline
from fluxbore.geometry import part as parts_of
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Hole, Part

GREY = (0.5, 0.5, 0.5)


def turned(profile: outline.Profile, *holes: Hole, name: str = "thing") -> Part:
    return Part(name, "thing", "stator", "steel", GREY, profile, holes)


def test_the_volume_of_a_ring_and_a_cone_are_the_textbooks() -> None:
    """Catches a wrong moment in the boundary integral, also far from z = 0, where differences cancel."""
    ring = turned(rectangle(0.004, 0.008, 5.0, 5.01))
    assert parts_of.volume(ring) == pytest.approx(math.pi * (0.008**2 - 0.004**2) * 0.01, rel=1e-12)
    assert parts_of.centre_of_mass(ring) == pytest.approx((0, 0, 5.005), abs=1e-12)
    cone = turned(((0, 0), (0.01, 0), (0, 0.03)))
    assert parts_of.volume(cone) == pytest.approx(math.pi * 0.01**2 * 0.03 / 3, rel=1e-14)
    assert parts_of.centre_of_mass(cone) == pytest.approx((0, 0, 0.03 / 4), abs=1e-15)
    assert parts_of.mass(cone, 7850) == pytest.approx(7850 * math.pi * 1e-6, rel=1e-14)


def test_a_drilling_as_wide_as_its_rod_takes_half_of_steinmetz_solid() -> None:
    """Two cylinders of radius R share 16/3 R^3 (Archimedes); drilled to the axis, half of it. Worst case at the rim."""
    rod, radius = rectangle(0, 0.01, -0.03, 0.03), 0.01
    gone = parts_of.volume(turned(rod)) - parts_of.volume(turned(rod, Hole(0.002, 2 * radius)))
    assert gone == pytest.approx(8 / 3 * radius**3, rel=1e-7)


@pytest.mark.parametrize("bottom", [0.0, 0.003, 0.0047, 0.007])
def test_the_quadrature_of_a_drilling_is_good_to_a_millionth(bottom: float) -> None:
    """Against adaptive quadrature of the chord, with the bottom in the bore, in its curve and in the wall."""
    bore, outside, half = 0.005, 0.012, 0.0025

    def chord(y: float, _z: float) -> float:
        return math.sqrt(outside**2 - y**2) - max(bottom, math.sqrt(bore**2 - y**2))

    def rim(z: float) -> float:
        return math.sqrt(half**2 - z**2)

    expected, _ = integrate.dblquad(chord, -half, half, lambda z: -rim(z), rim, epsabs=0, epsrel=1e-9)
    tube = rectangle(bore, outside, 0, 0.04)
    gone = parts_of.volume(turned(tube)) - parts_of.volume(turned(tube, Hole(0.02, 2 * half, 1.0, bottom)))
    assert gone == pytest.approx(expected, rel=1e-6)


def test_a_drilling_moves_the_centre_of_mass_away_from_itself() -> None:
    """A narrow hole is a pin of known volume and centre; catches a sign or an angle the wrong way round."""
    rod, narrow, angle = rectangle(0, 0.01, 0, 0.04), 2e-4, 2.0
    pin = math.pi * (narrow / 2) ** 2 * 0.01
    x, y, z = parts_of.centre_of_mass(turned(rod, Hole(0.03, narrow, angle)))
    left = parts_of.volume(turned(rod)) - pin
    assert x == pytest.approx(-math.cos(angle) * pin * 0.005 / left, rel=1e-3)
    assert y == pytest.approx(-math.sin(angle) * pin * 0.005 / left, rel=1e-3)
    assert z - 0.02 == pytest.approx(-pin * 0.01 / left, rel=1e-3)


def test_the_shared_volume_of_crossing_profiles_is_exact() -> None:
    """A rod through a cone; catches slabs that are cut at vertices only and not where edges cross."""
    cone, rod = ((0.0, 0.0), (0.01, 0.0), (0.0, 0.01)), rectangle(0, 0.004, -1, 1)
    expected = math.pi * 0.004**2 * 0.006 + math.pi * 0.004**3 / 3
    assert outline.overlap(cone, rod) == pytest.approx(expected, rel=1e-13)
    assert outline.overlap(rod, cone) == pytest.approx(expected, rel=1e-13)
    assert outline.overlap(cone, cone) == pytest.approx(math.pi * 1e-6 / 3, rel=1e-13)


def test_a_profile_with_a_recess_holds_another_without_sharing_it() -> None:
    """Catches an even-odd rule that fills the recess of a profile that is not convex."""
    cup = ((0.0, 0.0), (0.01, 0.0), (0.01, 0.02), (0.008, 0.02), (0.008, 0.002), (0.0, 0.002))
    assert outline.overlap(cup, rectangle(0, 0.008, 0.002, 0.03)) == 0
    deeper = outline.overlap(cup, rectangle(0, 0.008, 0.001, 0.03))
    assert deeper == pytest.approx(math.pi * 0.008**2 * 0.001, rel=1e-12)


def test_clearance_is_the_shortest_way_and_zero_where_parts_touch() -> None:
    ring = turned(rectangle(0.005, 0.008, 0, 0.01))
    assert geometry.clearance(ring, turned(rectangle(0, 0.0049, -1, 1))) == pytest.approx(1e-4)
    assert geometry.clearance(ring, turned(rectangle(0.011, 0.02, 0.014, 0.02))) == pytest.approx(0.005)
    assert geometry.clearance(ring, turned(rectangle(0.005, 0.008, 0.01, 0.02))) == 0
    assert geometry.clearance(ring, turned(rectangle(0.006, 0.007, 0.002, 0.003))) == 0


def test_interferences_tell_designed_squeezes_from_mistakes() -> None:
    """Catches a whitelist that depends on the order of the names, or that hides what it allows."""
    tube = turned(rectangle(0.005, 0.008, 0, 0.01), name="tube")
    seal = turned(rectangle(0.004, 0.0051, 0.004, 0.006), name="seal")
    rod = turned(rectangle(0, 0.0045, -1, 1), name="rod")
    found = geometry.interferences(Assembly("a", (tube, seal, rod), 0.0, (("seal", "tube"),)))
    assert [(one.first, one.second, one.designed) for one in found] == [("tube", "seal", True), ("seal", "rod", False)]
    assert found[0].volume == pytest.approx(math.pi * (0.0051**2 - 0.005**2) * 0.002)


@pytest.mark.parametrize(
    "profile",
    [
        ((0.0, 0.0), (0.0, 0.01), (0.01, 0.0)),  # clockwise
        ((0.0, 0.0), (0.01, 0.0), (0.0, 0.01), (0.01, 0.01)),  # a bow tie
        ((-0.001, 0.0), (0.01, 0.0), (0.0, 0.01)),  # across the axis
        ((0.0, 0.0), (0.01, 0.0), (0.01, 0.0), (0.0, 0.01)),  # a vertex twice
        ((0.0, 0.0), (0.01, 0.0), (0.01, 0.01), (0.005, 0.0), (0.0, 0.01)),  # touches itself
        ((0.0, 0.0), (0.01, float("nan")), (0.0, 0.01)),
        ((0.0, 0.0), (0.01, 0.0)),
    ],
)
def test_an_outline_that_is_no_simple_polygon_is_refused(profile: outline.Profile) -> None:
    with pytest.raises(DesignError, match="outline of the thing"):
        turned(profile)
