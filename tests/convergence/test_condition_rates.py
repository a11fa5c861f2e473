"""Rates under periodic, antiperiodic and mixed conditions."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from manufactured import (
    ENERGY_RATE,
    FIELD_RATE,
    NOTHING,
    VACUUM,
    circle,
    field_error,
    levels,
    manufactured,
    over_disc,
    over_rectangle,
    slope,
)
from planar_wave import INNER, square

from fluxbore.fem.conditions import Conditions, Mixed
from fluxbore.fem.energy import energies
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.mesh import Floats
from fluxbore.fem.outline import Curve, Outline, Pair, Seed


def striped(sign: int) -> tuple[Callable[[Floats], Floats], Callable[[Floats], Floats], Callable[[Floats], Floats]]:
    """A, B and J of a field that repeats after one metre along x, or turns round: A = sin(kx + 0.4) sin(πy) eʸ."""
    k = 2 * np.pi if sign > 0 else np.pi

    def parts(points: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        x, y = points[..., 0], points[..., 1]
        g, slope_ = np.sin(np.pi * y), np.pi * np.cos(np.pi * y)
        return np.sin(k * x + 0.4), k * np.cos(k * x + 0.4), g * np.exp(y), (g + slope_) * np.exp(y)

    def potential(points: Floats) -> Floats:
        f, _, g, _ = parts(points)
        return np.asarray(f * g)

    def field(points: Floats) -> Floats:
        f, df, g, dg = parts(points)
        return np.stack((f * dg, -df * g), axis=-1)

    def density(points: Floats) -> Floats:
        f, _, g, dg = parts(points)
        return np.asarray(f * (k**2 * g - (2 * dg - (1 + np.pi**2) * g)))

    return potential, field, density


@pytest.mark.parametrize("sign", [1, -1], ids=["periodic", "antiperiodic"])
@pytest.mark.parametrize("turned", [False, True])
def test_periodic_sides_keep_the_order(sign: int, turned: bool) -> None:
    """Catches mates that do not face each other, or a sign lost on the way; the right side drawn down or up."""
    potential, field, density = striped(sign)
    right = Curve(2, 1) if turned else Curve(1, 2)
    curves = Curve(0, 1, condition=0), right, Curve(2, 3, condition=0), Curve(3, 0), *circle(4, size=0.1)
    # The left side, number 3, is drawn downwards.
    pair = (Pair(3, 1, sign, not turned),)
    drawn = square()
    outline = Outline("planar", drawn.points, curves, drawn.seeds, pair)
    stored = over_rectangle(lambda p: np.sum(field(p) ** 2, axis=-1) / 2, (0, 1), (0, 1))
    linked = over_disc(potential, *INNER)
    solved = [manufactured(level, VACUUM * 2, density, 1) for level in levels(outline, NOTHING, 3)]
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in solved])
    assert slope(errors[:, 0]) > ENERGY_RATE, errors
    assert slope(errors[:, 1]) > ENERGY_RATE, errors


def test_mixed_condition_on_a_circle() -> None:
    """Catches a wrong sign, c0 or arc length on a curved edge: ν ∂A/∂n + c0 A + c1 = 0 on the rim of a disc."""
    c0, c1 = 1.5, 0.7
    bend = (1 + c0) / (3 + c0)  # of x (1 − bend r²), whose ∂/∂r is −c0 times itself at r = 1

    def potential(points: Floats) -> Floats:
        """The constant meets c1, and a r² − 2a/c0 − a, which has no effect there, drives a current everywhere."""
        x, square_ = points[..., 0], np.sum(points**2, axis=-1)
        return np.asarray(x * (1 - bend * square_) - c1 / c0 + square_ - 2 / c0 - 1)

    def field(points: Floats) -> Floats:
        x, y = points[..., 0], points[..., 1]
        return np.stack((-2 * bend * x * y + 2 * y, -(1 - bend * (3 * x**2 + y**2)) - 2 * x), axis=-1)

    def density(points: Floats) -> Floats:
        return np.asarray(8 * bend * points[..., 0] - 4)

    points = np.array([(-1, 0), (1, 0), (0.1, 0.3), (0.5, 0.3)], dtype=float)
    outline = Outline("planar", points, (*circle(0, 0), *circle(2)), (Seed((0, -0.5), 0), Seed((0.3, 0.3), 1)))
    stored = over_disc(lambda p: np.sum(field(p) ** 2, axis=-1) / 2, (0, 0), 1)
    linked = over_disc(potential, (0.3, 0.3), 0.2)
    rim = Conditions([Mixed(c0, c1)])
    solved = [manufactured(level, VACUUM * 2, density, 1) for level in levels(outline, rim, 3)]
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in solved])
    assert slope(errors[:, 0]) > ENERGY_RATE, errors
    assert slope(errors[:, 1]) > ENERGY_RATE, errors


def test_mixed_condition_around_the_axis() -> None:
    """Catches a factor of the radius on a cylinder: H_t = −H_z there, with ψ = s² − g s and B_z = 2s − g."""
    c0, g = 2.0, 0.5
    c1 = -(1 - g) - c0 * (1 / 4 - g / 2)  # at r = 1, walked upwards with the inside on the left

    def field(points: Floats) -> Floats:
        r = points[..., 0]
        return np.stack((np.zeros_like(r), r**2 - g), axis=-1)

    def density(points: Floats) -> Floats:
        return np.full(points.shape[:-1], -2.0)

    points = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
    curves = Curve(0, 1), Curve(1, 2, condition=0), Curve(2, 3), Curve(3, 0)
    outline = Outline("axisymmetric", points, curves, (Seed((0.3, 0.3), 0),))
    solved = [manufactured(level, VACUUM, density) for level in levels(outline, Conditions([Mixed(c0, c1)]), 3)]
    errors = [field_error(s, field) for s in solved]
    assert slope(errors) > FIELD_RATE or errors[-1] < 1e-9, errors
