"""Parts that follow a helix: volumes, centres, gaps and overlaps by hand, and triangles against the closed volume."""

import itertools
import math

import numpy as np
import pytest

from fluxbore.design.errors import DesignError
from fluxbore.geometry import helical_clearance, helical_part, helix, unrolled
from fluxbore.geometry.helical_mesh import triangles
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.unrolled import Outline

MM = 1e-3
LEAD, WIDTH, LENGTH = 5 * MM, 2 * MM, 23 * MM
INNER, OUTER = 15 * MM, 17.5 * MM
ARC = math.radians(58)


def part(outline: Outline, inner: float = INNER, outer: float = OUTER, name: str = "block") -> HelicalPart:
    return HelicalPart(name, "block", "stator", "N42", (0.5, 0.5, 0.5), inner, outer, outline)


BAND = part(helix.band(LEAD, WIDTH, 0.3 * MM, LENGTH))
STEP = part(helix.arc(0.0, WIDTH, ARC, 0.4, 3 * MM))
SLANTED = part(helix.arc(LEAD, WIDTH, ARC, 0.4, 3 * MM))
LEFT = part(helix.arc(-3 * LEAD, WIDTH, 5.0, -9.0, 0.0))
KINDS = {"band": BAND, "step": STEP, "slanted": SLANTED, "left-handed": LEFT}


def test_volumes_by_hand() -> None:
    """A band takes its share of the pitch of the whole ring, whatever its ends; an arc is as large at any lead."""
    ring = math.pi * (OUTER**2 - INNER**2)
    assert helical_part.volume(BAND) == pytest.approx(ring * LENGTH * WIDTH / LEAD, rel=1e-13)
    for arc in (STEP, SLANTED):
        assert helical_part.volume(arc) == pytest.approx(ring * WIDTH * ARC / (2 * math.pi), rel=1e-13)


@pytest.mark.parametrize("kind", KINDS)
def test_centre_is_that_of_many_small_pieces(kind: str) -> None:
    """Against Gauss-Legendre in strips between the corners: catches any term of Green's theorem."""
    one = KINDS[kind]
    corners = sorted({theta for theta, _ in one.outline})
    nodes, weights = np.polynomial.legendre.leggauss(60)
    moments = np.zeros(4)
    lower, upper = unrolled.chains(one.outline)
    for a, b in itertools.pairwise(corners):
        pieces = math.ceil(b - a)
        for i in range(pieces):
            start, half = a + (b - a) * i / pieces, (b - a) / pieces / 2
            theta = start + half * (1 + nodes)
            low, high = (np.interp(theta, *np.transpose(chain)) for chain in (lower, upper))
            tall = half * weights * (high - low)
            moments += [np.sum(tall * f) for f in (np.ones(60), np.cos(theta), np.sin(theta), (low + high) / 2)]
    radius = 2 / 3 * (OUTER**3 - INNER**3) / (OUTER**2 - INNER**2)
    expected = radius * moments[1] / moments[0], radius * moments[2] / moments[0], moments[3] / moments[0]
    assert helical_part.centre_of_mass(one) == pytest.approx(expected, rel=1e-11, abs=1e-15)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("opening", [0.0, math.pi / 2])
def test_triangles_enclose_the_part(kind: str, opening: float) -> None:
    """By the divergence theorem: catches a face that is missing or turned inside out, and a wrong sector left out."""
    one = KINDS[kind]
    step = 0.02
    points, faces = triangles(one, 1.0, step, opening)
    a, b, c = (points[faces[:, i]] for i in range(3))
    found = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    outlines = [one.outline]
    if opening:
        outlines = [
            unrolled.between(one.outline, turn * unrolled.TURN + opening, (turn + 1) * unrolled.TURN)
            for turn in range(-20, 20)
        ]
    exact = (OUTER**2 - INNER**2) / 2 * sum(unrolled.area(outline) for outline in outlines if outline)
    assert found == pytest.approx(exact, rel=step**2 / 4)
    angles = np.mod(np.arctan2(points[:, 1], points[:, 0]), unrolled.TURN)
    assert not np.any((angles > 1e-9) & (angles < opening - 1e-9))


def test_no_lead_is_the_limit_of_little() -> None:
    """h to 0: a step is an arc without a lead, in its volume, its centre and its gap to a neighbour."""
    flat, little = part(helix.arc(0.0, WIDTH, ARC, 0.4, 0.0)), part(helix.arc(1e-12, WIDTH, ARC, 0.4, 0.0))
    beside = part(helix.arc(0.0, WIDTH, ARC, 0.5, WIDTH + 0.25 * MM))
    assert helical_part.volume(little) == pytest.approx(helical_part.volume(flat), rel=1e-14)
    assert helical_part.centre_of_mass(little) == pytest.approx(helical_part.centre_of_mass(flat), abs=1e-13)
    gaps = [helical_clearance.axial_gap(one, beside) for one in (flat, little)]
    assert gaps == pytest.approx([0.25 * MM] * 2, abs=1e-12)


def test_gaps_by_hand() -> None:
    """Bands half a lead apart, arcs end to end on the helix and a turn on, and another member around them."""
    other = part(helix.band(LEAD, WIDTH, 0.3 * MM + LEAD / 2, LENGTH))
    assert helical_clearance.axial_gap(BAND, other) == pytest.approx(LEAD / 2 - WIDTH, rel=1e-9)
    turn = math.radians(60)
    following = part(helix.arc(LEAD, WIDTH, ARC, 0.4 + turn, 3 * MM + LEAD / 6))
    assert math.isinf(helical_clearance.axial_gap(SLANTED, following))
    assert helical_clearance.angular_gap(SLANTED, following) == pytest.approx(turn - ARC, rel=1e-9)
    onwards = part(helix.arc(LEAD, WIDTH, ARC, 0.4 + unrolled.TURN, 3 * MM + LEAD))
    assert helical_clearance.axial_gap(SLANTED, onwards) == pytest.approx(LEAD - WIDTH, rel=1e-9)
    assert math.isinf(helical_clearance.angular_gap(SLANTED, onwards))
    around = part(BAND.outline, OUTER + 0.8 * MM, OUTER + 3 * MM)
    assert helical_clearance.radial_gap(around, BAND) == pytest.approx(0.8 * MM)
    assert helical_clearance.overlap(around, BAND) == 0.0
    assert helical_clearance.narrowest([SLANTED, following, around]) == pytest.approx((0.8 * MM, math.inf, turn - ARC))


def test_what_touches_does_not_overlap() -> None:
    """Catches rounding taken for an overlap, along a helix, at ends, at corners, and many turns away."""
    for turns in (0, 7):
        beside = [
            helix.arc(LEAD, WIDTH, ARC, 0.4 + unrolled.TURN * turns, 3 * MM + WIDTH),
            helix.arc(LEAD, WIDTH, ARC, 0.4 + ARC + unrolled.TURN * turns, 3 * MM + LEAD * ARC / unrolled.TURN),
            helix.arc(LEAD, WIDTH, ARC, 0.4 + ARC - unrolled.TURN * turns, 3 * MM + WIDTH),
        ]
        for outline in beside:
            assert helical_clearance.overlap(SLANTED, part(outline)) == 0.0
    assert helical_clearance.axial_gap(SLANTED, part(helix.arc(LEAD, WIDTH, ARC, 0.4, 3 * MM + WIDTH))) == 0.0


@pytest.mark.parametrize("turns", [0, -3])
def test_overlaps_by_hand(turns: int) -> None:
    """A neighbour pushed in by a tenth of a millimetre along the axis or a degree around it, whole turns away too."""
    area = (OUTER**2 - INNER**2) / 2
    pushed = part(helix.arc(LEAD, WIDTH, ARC, 0.4 + unrolled.TURN * turns, 3 * MM + WIDTH - 0.1 * MM))
    assert helical_clearance.overlap(SLANTED, pushed) == pytest.approx(area * ARC * 0.1 * MM, rel=1e-9)
    assert helical_clearance.axial_gap(SLANTED, pushed) == 0.0
    degree = math.radians(1)
    turned = ARC - degree
    twisted = part(
        helix.arc(LEAD, WIDTH, ARC, 0.4 + turned + unrolled.TURN * turns, 3 * MM + LEAD * turned / unrolled.TURN)
    )
    assert helical_clearance.overlap(SLANTED, twisted) == pytest.approx(area * degree * WIDTH, rel=1e-9)
    assert helical_clearance.angular_gap(SLANTED, twisted) == 0.0


def test_a_thin_wedge_is_an_overlap() -> None:
    """Helices of different leads cross: catches a test for overlap by corners alone."""
    steep = part(helix.arc(1.2 * LEAD, WIDTH, ARC, 0.4, 3 * MM + WIDTH))
    assert helical_clearance.overlap(SLANTED, steep) > 0
    assert helical_clearance.axial_gap(SLANTED, steep) == 0.0


@pytest.mark.parametrize(
    ("outline", "radii", "sentence"),
    [
        (helix.band(LEAD, 1.01 * LEAD, 0.0, LENGTH), (INNER, OUTER), "must not run into itself"),
        (helix.arc(0.0, WIDTH, 6.4, 0.0, 0.0), (INNER, OUTER), "must not run into itself"),
        (helix.arc(0.0, WIDTH, ARC, 0.0, 0.0)[::-1], (INNER, OUTER), "convex and counter-clockwise"),
        (helix.arc(0.0, WIDTH, math.nan, 0.0, 0.0), (INNER, OUTER), "convex and counter-clockwise"),
        (((0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)), (INNER, OUTER), "convex and counter-clockwise"),
        (helix.arc(0.0, WIDTH, ARC, 0.0, 0.0), (OUTER, INNER), "must have an outer radius beyond its inner one"),
        (helix.arc(0.0, WIDTH, ARC, 0.0, 0.0), (0.0, INNER), "both off the axis"),
    ],
)
def test_what_is_no_body_is_refused(outline: Outline, radii: tuple[float, float], sentence: str) -> None:
    with pytest.raises(DesignError, match=rf"^The .*block.*{sentence}[^\n]*\.$"):
        part(outline, *radii)


def test_a_band_as_wide_as_its_lead_meets_itself_without_overlap() -> None:
    whole = part(helix.band(LEAD, LEAD, 0.0, LENGTH))
    assert helical_part.volume(whole) == pytest.approx(math.pi * (OUTER**2 - INNER**2) * LENGTH, rel=1e-13)


def test_a_generator_crosses_a_band_once_a_lead() -> None:
    spans = unrolled.spans(BAND.outline, 0.0)
    middles = [(low + high) / 2 for low, high in spans[1:-1]]
    assert np.diff(middles) == pytest.approx([LEAD] * (len(middles) - 1))
    assert sum(high - low for low, high in spans) == pytest.approx(LENGTH * WIDTH / LEAD, abs=WIDTH)
    assert (spans[0][0], spans[-1][1]) >= (-LENGTH / 2, 0.0)
    assert min(high - low for low, high in spans) > 0
    # Where one arc ends and the next begins the generator belongs to the next alone.
    first, following = helix.arc(0.0, WIDTH, 1.0, 0.5, 0.0), helix.arc(0.0, WIDTH, 1.0, 1.5, 0.0)
    assert [len(unrolled.spans(outline, 1.0)) for outline in (first, following)] == [0, 1]
