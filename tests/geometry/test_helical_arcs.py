"""Bands built of arcs: against an arc-by-arc map of the remanence over angle and length."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.design.errors import DesignError
from fluxbore.geometry.helical_arcs import Arcs, averaged
from fluxbore.geometry.helical_bands import Bands, alternating

BANDS = alternating(1.0, 0.8, 0.075)
"""Edges on the lines of the maps below, so that these are good to 1e-4."""


def drawn(bands: Bands, arcs: Arcs, starts: int, angles: int = 3600, lengths: int = 720) -> np.ndarray:
    """(lengths, angles) remanence at z/period and θ, each arc drawn square to the axis where its middle belongs."""
    theta = 2 * np.pi * (np.arange(angles) + 0.5) / angles
    z = (np.arange(lengths) + 0.5) / lengths
    pitch = 2 * np.pi / arcs.count
    middle = np.round(theta / pitch) * pitch
    filled = np.abs(theta - middle) < arcs.angle / 2
    return np.asarray(bands.remanence(z[:, None] - starts * middle / (2 * np.pi)) * filled)


@pytest.mark.parametrize(("count", "degrees", "starts"), [(6, 60.0, 1), (8, 40.0, 1), (9, 40.0, -2)])
def test_waves_are_those_of_drawn_arcs(count: int, degrees: float, starts: int) -> None:
    """Catches a wrong order ν, a sinc of the wrong angle, and a weight that forgets how full the turn is."""
    arcs = Arcs(count, np.radians(degrees))
    image = drawn(BANDS, arcs, starts)
    lengths, angles = image.shape
    z = (np.arange(lengths) + 0.5) / lengths
    theta = 2 * np.pi * (np.arange(angles) + 0.5) / angles
    for order in (1, 3):
        for step in (-2, -1, 0, 1, 2):
            nu = order * starts - step * count
            along, around = np.exp(-2j * np.pi * order * z), np.exp(1j * nu * theta)
            found = 2 * along @ image @ around / image.size
            assert found == pytest.approx(BANDS.harmonic(order) * arcs.weight(nu), abs=2e-4)


def test_sixty_degrees_keep_three_over_pi() -> None:
    """Catches an average over the wrong width: six arcs of 60 degrees lose 4.5 % of the fundamental."""
    arcs = Arcs(6, np.pi / 3)
    assert arcs.weight(1) == pytest.approx(3 / np.pi, rel=1e-14)
    assert arcs.weight(-5) == pytest.approx(arcs.weight(1) / 5, rel=1e-12)
    assert arcs.weight(7) == pytest.approx(-arcs.weight(1) / 7, rel=1e-12)


@pytest.mark.parametrize("starts", [1, 2, 0])
@pytest.mark.parametrize("bands", [alternating(1.0), BANDS])
def test_the_average_has_the_waves_that_do_not_ripple(bands: Bands, starts: int) -> None:
    """Catches a trapezoid with the wrong corners or slopes: every harmonic is the bands' times its weight."""
    arcs = Arcs(6, np.radians(50))
    mean = averaged(bands, arcs, starts)
    assert mean.antisymmetric
    for order in (1, 3, 5, 7):
        expected = bands.harmonic(order) * arcs.weight(order * starts)
        assert mean.harmonic(order) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(("count", "degrees"), [(6, 60.1), (7, 60.0), (6, 0.0), (0, 60.0), (6, float("nan"))])
def test_arcs_that_overlap(count: int, degrees: float) -> None:
    """Catches arcs that overlap, with a sentence that names the limit and the value."""
    with pytest.raises(DesignError, match=r"they overlap; got|at least one magnet arc in a turn; got 0"):
        Arcs(count, np.radians(degrees))
