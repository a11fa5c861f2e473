"""Fields of lead screws: of linear layers, against Bessel functions and published figures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from helical_bessel import exact_force, harmonic_force
from rotlin_section import PERIOD, POLES, backed, ideal

from fluxbore.fem.helical import solve
from fluxbore.fem.helical_force import force
from fluxbore.geometry.helical_bands import Bands, Profile, Segment, Wave, alternating
from fluxbore.geometry.helical_section import HelicalSection, Layer

BANDS = alternating(1.25)
WITHIN = 1e-3
"""Of the force: what is asked of the default mesh."""


@pytest.mark.parametrize("starts", [0, 1, -1, 8, 25])
@pytest.mark.parametrize("displacement", [0.05, 0.25, 0.4])
def test_force_of_linear_layers(starts: int, displacement: float) -> None:
    """Catches a wrong tensor, above all at long leads where h²/r² is 1.3: against modified Bessel functions."""
    section = ideal(BANDS, BANDS, displacement * PERIOD, starts * PERIOD)
    assert force(solve(section)) == pytest.approx(exact_force(section), rel=WITHIN)


@pytest.mark.parametrize("permeability", [1.0, 20.0, 1e4])
@pytest.mark.parametrize("starts", [1, 12])
def test_force_with_linear_iron(permeability: float, starts: int) -> None:
    """Catches a face between two permeabilities, and rims that let flux through."""
    section = backed(BANDS, permeability, thickness=0.5e-3, lead=starts * PERIOD)
    assert force(solve(section)) == pytest.approx(exact_force(section), rel=WITHIN)


def test_force_of_narrow_bands_of_unlike_members() -> None:
    """Catches spaces that are not air, and edges of the members that are not lines; permeability 1 all over."""
    layers = tuple(replace(layer, permeability=1.0) for layer in ideal(BANDS, BANDS).layers)
    profiles = alternating(1.2, 0.8, 0.1), alternating(1.3, 0.55)
    layers = (replace(layers[0], magnets=profiles[0]), layers[1], replace(layers[2], magnets=profiles[1]))
    section = replace(ideal(BANDS, BANDS, 0.3 * PERIOD), layers=layers)
    assert force(solve(section)) == pytest.approx(exact_force(section, range(1, 40)), rel=WITHIN)


def test_force_of_bands_that_do_not_mirror() -> None:
    """Catches a whole period folded with the wrong sign, and even harmonics that are lost."""
    unlike = Bands((Segment(0.0, 0.4, 1.2, 1.2), Segment(0.4, 1.0, -0.8, -0.8)))
    section = ideal(unlike, unlike, 0.2 * PERIOD)
    found = solve(section)
    assert found.system.grid.copies == 1
    assert force(found) == pytest.approx(exact_force(section, range(1, 40)), rel=WITHIN)
    assert abs(harmonic_force(section, 2)) > 1e-2 * force(found)


def test_down_to_the_axis() -> None:
    """Catches 1/r² on the axis: a solid shaft and ten starts, whose first harmonic is of order ten there."""
    section = replace(backed(BANDS, 5.0, lead=10 * PERIOD), inner_radius=0.0)
    assert force(solve(section)) == pytest.approx(exact_force(section), rel=WITHIN)


def test_rings_are_the_limit_of_short_leads() -> None:
    """Catches a term of first order in h: the force departs from that of rings as h², and at h = 0 not at all."""
    rings = force(solve(ideal(BANDS, BANDS, PERIOD / 4, 0.0)))
    departures = np.array(
        [1 - force(solve(ideal(BANDS, BANDS, PERIOD / 4, lead * PERIOD))) / rings for lead in (1 / 4, 1 / 2, 1)]
    )
    assert np.allclose(departures[1:] / departures[:-1], 4, rtol=0.01)
    assert departures[-1] == pytest.approx(0.002, rel=0.1)


def test_published_force_per_remanence() -> None:
    """Catches a factor of periods: 131.8 N of fundamental per T² over the rotor's four poles, by a 1-D route."""
    fundamental = Wave(4 / np.pi)
    found = force(solve(ideal(fundamental, fundamental, PERIOD / 4))) * POLES / 2
    assert found == pytest.approx(131.8, rel=5e-4)


def test_published_harmonic_ratios() -> None:
    """Catches harmonics that come from the mesh: K2/K1 and K3/K1 of the paper, 1.58 % and 0.08 %, from the force curve.

    Harmonics 1, 3 and 5 of the force over a period, by sums over equal steps.
    """
    shares = (np.arange(12) + 0.5) / 24
    curve = [force(solve(ideal(BANDS, BANDS, share * PERIOD), refinement=2)) for share in shares]
    first, third, fifth = (np.dot(curve, np.sin(2 * np.pi * n * shares)) for n in (1, 3, 5))
    assert abs(third / first) == pytest.approx(0.0158, abs=2e-4)
    assert abs(fifth / first) == pytest.approx(0.00080, abs=2e-5)


def test_magnets_of_one_member_exert_no_force_on_themselves() -> None:
    """Catches a gap whose shear makes a force: what is left is the mesh's error, and falls with it.

    Half a cell of shear on either mesh, or it would fall with the shear as well; at order two at least.
    """

    def alone(profile: Profile, refinement: int) -> float:
        layers = ideal(profile, profile).layers
        bare = (layers[0], layers[1], replace(layers[2], magnets=None), Layer("air", 26e-3))
        section = HelicalSection(14.95e-3, bare, 1, PERIOD, PERIOD, 9.5 / 32 * PERIOD)
        return abs(force(solve(section, refinement)))

    assert alone(BANDS, 1) < 1e-4 * exact_force(ideal(BANDS, BANDS, 0.3 * PERIOD))
    wave = Wave(1.25)
    assert alone(wave, 3) < alone(wave, 1) / 9
