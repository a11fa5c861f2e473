"""Arcs: the averaged helix against its own field, and ripple that takes no work out of nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from helical_bessel import exact_force
from rotlin_section import PERIOD, ideal

from fluxbore.design.errors import DesignError
from fluxbore.design.lead_screw import Arcs
from fluxbore.design.materials import standard
from fluxbore.fem.helical import solve
from fluxbore.fem.helical_arcs import ArcHarmonic, arc_force, arc_harmonics, arc_torque
from fluxbore.fem.helical_force import force
from fluxbore.geometry.helical_arcs import averaged
from fluxbore.geometry.helical_bands import Wave, alternating

BANDS = alternating(1.0)
SECTION = ideal(BANDS, BANDS)
SIXTY = Arcs(np.pi / 3, 6, stepped=True)
ANGLES = np.linspace(0, 2 * np.pi, 361)


@pytest.fixture(scope="module")
def stepped() -> tuple[ArcHarmonic, ...]:
    """Both members of arcs of 60 degrees."""
    return arc_harmonics(SECTION, SIXTY, SIXTY)


def test_the_average_is_the_field_of_the_averaged_bands(stepped: tuple[ArcHarmonic, ...]) -> None:
    """Catches a wave with a wrong weight or lead: the trapezoid's own field has all of its harmonics at once."""
    mean = averaged(BANDS, SIXTY, 1.0)
    steady = [part for part in stepped if part.ripple == 0]
    for share in (0.1, 0.25):
        found = force(solve(ideal(mean, mean, share * PERIOD)))
        assert arc_force(steady, PERIOD, share * PERIOD, 0.0) == pytest.approx(found, rel=1e-3)


def test_the_average_over_a_turn_is_the_averaged_helix(stepped: tuple[ArcHarmonic, ...]) -> None:
    """Catches a ripple with a mean."""
    steady = [part for part in stepped if part.ripple == 0]
    over_a_turn = arc_force(stepped, PERIOD, PERIOD / 5, ANGLES[:-1]).mean()
    assert over_a_turn == pytest.approx(float(arc_force(steady, PERIOD, PERIOD / 5, 0.0)), rel=1e-12)


def test_fundamental_of_sixty_degrees(stepped: tuple[ArcHarmonic, ...]) -> None:
    """Catches a factor that counts one member only: both lose 3/π, of the exact field of the fundamental."""
    wave = Wave(4 / np.pi)
    exact = exact_force(ideal(wave, wave, PERIOD / 4), range(1, 2))
    main = next(part for part in stepped if (part.order, part.ripple) == (1, 0))
    assert main.amplitude == pytest.approx((3 / np.pi) ** 2 * exact, rel=1e-3)
    assert main.transfer == pytest.approx(SECTION.transfer_ratio, rel=1e-14)


@pytest.mark.parametrize("azimuthal", [-5, 7])
def test_ripple_of_sixty_degrees(stepped: tuple[ArcHarmonic, ...], azimuthal: int) -> None:
    """Catches a ripple solved with the screw's own lead: the exact field of a helix of lead ν times the period."""
    wave = Wave(4 / np.pi)
    exact = exact_force(ideal(wave, wave, PERIOD / 4, azimuthal * PERIOD), range(1, 2))
    part = next(part for part in stepped if (part.order, part.azimuthal) == (1, azimuthal))
    assert part.ripple == 1 - azimuthal
    assert part.amplitude == pytest.approx((3 / np.pi / azimuthal) ** 2 * exact, rel=1e-3)


def test_ripple_takes_no_work_out_of_nothing(stepped: tuple[ArcHarmonic, ...]) -> None:
    """Catches a torque that is h times the force for each wave: over a closed path of x and α no work is done.

    The outer member's displacement along ζ is x = z − h α; the axial force on it is the opposite of that on the inner.
    """
    h = SECTION.transfer_ratio
    z, alpha, step = 0.13 * PERIOD, 0.4, 1e-6

    def on_outer(axial: float, angle: float) -> tuple[float, float]:
        moved = axial - h * angle
        return -float(arc_force(stepped, PERIOD, moved, angle)), float(arc_torque(stepped, PERIOD, moved, angle))

    by_angle = (on_outer(z, alpha + step)[0] - on_outer(z, alpha - step)[0]) / (2 * step)
    by_axial = (on_outer(z + step * PERIOD, alpha)[1] - on_outer(z - step * PERIOD, alpha)[1]) / (2 * step * PERIOD)
    assert by_angle == pytest.approx(by_axial, rel=1e-6)


def test_one_member_of_arcs_does_not_ripple() -> None:
    """Catches ripple from waves that the other member does not have; the mean loses 3/π once."""
    single = arc_harmonics(SECTION, SIXTY, None)
    assert {part.ripple for part in single} == {0}
    found = force(solve(ideal(averaged(BANDS, SIXTY, 1.0), BANDS, PERIOD / 4)))
    assert arc_force(single, PERIOD, PERIOD / 4, 1.0) == pytest.approx(found, rel=1e-3)


def test_unlike_counts_share_few_waves() -> None:
    """Catches waves of one member paired with others: 6 and 8 arcs in a turn ripple 24 times."""
    found = arc_harmonics(SECTION, SIXTY, Arcs(np.pi / 4, 8, stepped=True), orders=(1,), reach=1)
    assert [part.ripple for part in found] == [-24, 0, 24]
    assert max(abs(part.amplitude) for part in found if part.ripple) < 1e-3 * found[1].amplitude


def test_iron_is_taken_as_linear() -> None:
    """Catches waves added up in saturated iron: its largest permeability is used, which is all but ideal."""
    layers = SECTION.layers
    steel = standard()["1010"].curve
    assert steel is not None
    backs = replace(layers[1], name="iron", curve=steel)
    inside = replace(backs, outer_radius=14.95e-3)
    outside = replace(backs, outer_radius=24e-3)
    section = replace(SECTION, inner_radius=11e-3, layers=(inside, *layers, outside), gap=2)
    found = arc_harmonics(section, SIXTY, SIXTY, orders=(1,), reach=0)[0]
    ideal_one = arc_harmonics(SECTION, SIXTY, SIXTY, orders=(1,), reach=0)[0]
    assert found.amplitude == pytest.approx(ideal_one.amplitude, rel=1e-3)
    assert found.amplitude < ideal_one.amplitude


def test_a_lead_that_arcs_cannot_close() -> None:
    """Catches arcs that do not meet after a turn."""
    section = replace(SECTION, lead=1.5 * PERIOD)
    with pytest.raises(DesignError, match=r"whole number of periods of 5.1429 mm; got 7.71435 mm"):
        arc_harmonics(section, SIXTY, None)
