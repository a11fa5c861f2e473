"""Remanence over a period: bands, their spaces, and their Fourier series."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.design.errors import DesignError
from fluxbore.geometry.helical_bands import Bands, Segment, Wave, alternating


def sampled(profile: Bands | Wave, order: int, points: int = 100_000) -> complex:
    """c of the part Re c exp(2πi n u), by the midpoint rule."""
    u = (np.arange(points) + 0.5) / points
    return complex(2 * np.mean(profile.remanence(u) * np.exp(-2j * np.pi * order * u)))


@pytest.mark.parametrize(
    "profile",
    [
        alternating(1.2),
        alternating(1.2, 0.7, 0.13),
        Wave(0.9, 3, 0.2),
        Bands((Segment(-0.1, 0.3, 1.0, 0.4), Segment(0.3, 0.9, -0.2, -1.3))),
    ],
)
def test_harmonics_are_those_of_the_profile(profile: Bands | Wave) -> None:
    """Catches a wrong sign or factor of the exact integral of a sloping segment: against a sum over samples."""
    for order in (1, 2, 3, 7):
        assert profile.harmonic(order) == pytest.approx(sampled(profile, order), abs=2e-5)


def test_square_wave() -> None:
    """Catches bands whose middles are not half a period apart: 4/π of the fundamental, no even harmonics."""
    bands = alternating(1.0)
    assert bands.harmonic(1) == pytest.approx(4 / np.pi, rel=1e-14)
    assert bands.harmonic(3) == pytest.approx(-4 / (3 * np.pi), rel=1e-13)
    assert abs(bands.harmonic(2)) < 1e-15


def test_spaces_hold_no_magnet() -> None:
    """Catches spaces that keep a magnet's permeability, and bands out of place, in any period."""
    bands = alternating(1.0, 0.5, phase=0.1)
    u = np.array([0.1, 0.22, 0.23, 0.6, 0.85]) + np.array([[0.0], [-3.0], [4.0]])
    assert bands.magnets(u).tolist() == [[True, True, False, True, False]] * 3
    assert bands.remanence(u).tolist() == [[1.0, 1.0, 0.0, -1.0, 0.0]] * 3


def test_antisymmetry_is_seen() -> None:
    """Catches half a mesh for a field that does not repeat with its sign changed."""
    assert alternating(1.2).antisymmetric
    assert alternating(1.2, 0.6, 0.3).antisymmetric
    assert Wave(1.0, 3).antisymmetric
    assert not Wave(1.0, 2).antisymmetric
    assert not Bands((Segment(0.0, 0.5, 1.0, 1.0), Segment(0.5, 1.0, -0.9, -0.9))).antisymmetric
    assert not Bands((Segment(0.0, 0.4, 1.0, 1.0), Segment(0.4, 1.0, -1.0, -1.0))).antisymmetric
    assert not Bands((Segment(0.0, 0.5, 1.0, 0.5), Segment(0.5, 1.0, -0.5, -1.0))).antisymmetric


@pytest.mark.parametrize("fraction", [0.0, -0.1, 1.01, float("nan")])
def test_fraction_out_of_range(fraction: float) -> None:
    """Catches bands that overlap or vanish."""
    with pytest.raises(DesignError, match="at most all of its half period; got"):
        alternating(1.0, fraction)
