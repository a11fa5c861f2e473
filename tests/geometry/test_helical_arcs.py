"""Bands built of arcs: against an arc-by-arc map of the remanence over angle and length."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.design.lead_screw import Arcs
from fluxbore.geometry.helical_arcs import averaged, wave_weight
from fluxbore.geometry.helical_bands import Bands, alternating

BANDS = alternating(1.0, 0.8, 0.075)
"""Edges on the lines of the maps below, so that these are good to 1e-4."""


def drawn(bands: Bands, arcs: Arcs, starts: int, angles: int = 3600, lengths: int = 720) -> np.ndarray:
    """(lengths, angles) remanence at z/period and θ, each arc where it belongs."""
    theta = 2 * np.pi * (np.arange(angles) + 0.5) / angles
    z = (np.arange(lengths) + 0.5) / lengths
    pitch = 2 * np.pi / arcs.per_turn
    middle = np.round(theta / pitch) * pitch
    filled = np.abs(theta - middle) < arcs.angle / 2
    height = middle if arcs.stepped else theta
    return np.asarray(bands.remanence(z[:, None] - starts * height / (2 * np.pi)) * filled)


@pytest.mark.parametrize(
    ("count", "degrees", "starts", "stepped"), [(6, 60.0, 1, True), (8, 40.0, 1, False), (9, 40.0, -2, True)]
)
def test_waves_are_those_of_drawn_arcs(count: int, degrees: float, starts: int, stepped: bool) -> None:
    """Catches a wrong order ν, a sinc of the wrong angle, and a weight that forgets how full the turn is."""
    arcs = Arcs(np.radians(degrees), count, stepped)
    image = drawn(BANDS, arcs, starts)
    tolerance = 2e-4 if stepped else 2e-3  # edges that follow the helix cross the map's lines
    lengths, angles = image.shape
    z = (np.arange(lengths) + 0.5) / lengths
    theta = 2 * np.pi * (np.arange(angles) + 0.5) / angles
    for order in (1, 3):
        for step in (-2, -1, 0, 1, 2):
            nu = order * starts - step * count
            along, around = np.exp(-2j * np.pi * order * z), np.exp(1j * nu * theta)
            found = 2 * along @ image @ around / image.size
            assert found == pytest.approx(BANDS.harmonic(order) * wave_weight(arcs, nu, step * count), abs=tolerance)


def test_sixty_degrees_keep_three_over_pi() -> None:
    """Catches an average over the wrong width: six arcs of 60 degrees lose 4.5 % of the fundamental."""
    arcs = Arcs(np.pi / 3, 6, stepped=True)
    assert wave_weight(arcs, 1, 0) == pytest.approx(3 / np.pi, rel=1e-14)
    assert wave_weight(arcs, -5, 6) == pytest.approx(3 / (5 * np.pi), rel=1e-12)
    assert wave_weight(arcs, 7, -6) == pytest.approx(-3 / (7 * np.pi), rel=1e-12)


@pytest.mark.parametrize("stepped", [True, False])
@pytest.mark.parametrize("starts", [1, 2, 0])
@pytest.mark.parametrize("bands", [alternating(1.0), BANDS])
def test_the_average_has_the_waves_that_do_not_ripple(bands: Bands, starts: int, stepped: bool) -> None:
    """Catches a trapezoid with the wrong corners or slopes: every harmonic is the bands' times its weight."""
    arcs = Arcs(np.radians(50), 6, stepped)
    mean = averaged(bands, arcs, starts)
    assert mean.antisymmetric
    for order in (1, 3, 5, 7):
        expected = bands.harmonic(order) * wave_weight(arcs, order * starts, 0)
        assert mean.harmonic(order) == pytest.approx(expected, abs=1e-12)
