"""Rates around the axis: energies, linkages, and the field where the elements touch it."""

from __future__ import annotations

from functools import cache

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
    misses,
    over_disc,
    rates,
    slope,
)

from fluxbore.fem.energy import energies
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats
from fluxbore.fem.outline import Curve, Outline, Seed
from fluxbore.fem.problem import MagneticMaterial

# A ball about the axis: ψ = s (1 − r² − z²) exp(z), s = r²/2.


def ball_potential(points: Floats) -> Floats:
    r, z = points[..., 0], points[..., 1]
    return np.asarray(r**2 / 2 * (1 - r**2 - z**2) * np.exp(z))


def ball_field(points: Floats) -> Floats:
    """(−(∂ψ/∂z)/r, ∂ψ/∂s)."""
    r, z = points[..., 0], points[..., 1]
    rest = 1 - r**2 - z**2
    return np.stack((-r / 2 * (rest - 2 * z), rest - r**2), axis=-1) * np.exp(z)[..., None]


def ball_density(points: Floats) -> Floats:
    """J/r = −∂²ψ/∂s² − (∂²ψ/∂z²)/(2s)."""
    r, z = points[..., 0], points[..., 1]
    return np.asarray((4 - (1 - r**2 - z**2 - 4 * z - 2) / 2) * np.exp(z))


SPHERE = Curve(1, 2, np.pi)
DOUBLE_CONE = Curve(1, 4), Curve(4, 2, 1.2)
"""A sloped and a curved face that meet the axis."""


def ball(*body: Curve) -> Outline:
    """A half disc, region 0; a body on the axis, 1; a round coil beside it, 2."""
    points = [(0, -1), (0, -0.4), (0, 0.4), (0, 1), (0.4, 0.1), (0.55, -0.3), (0.75, -0.3)]
    lines = Curve(0, 1), Curve(1, 2), Curve(2, 3), *body, *circle(5), Curve(0, 3, np.pi, condition=0)
    seeds = Seed((0.7, 0.4), 0), Seed((0.1, 0.0), 1), Seed((0.65, -0.3), 2)
    return Outline("axisymmetric", np.array(points, dtype=float), lines, seeds)


@cache
def around_axis() -> list[Solution]:
    return [manufactured(level, VACUUM * 3, ball_density, 2) for level in levels(ball(SPHERE), NOTHING, 4)]


@pytest.mark.full
def test_energy_and_linkage_around_the_axis() -> None:
    """Catches an order lost in 1/r, on curved edges that touch the axis, on the sphere around, or in a round coil."""
    stored = 2 * np.pi * over_disc(lambda p: np.sum(ball_field(p) ** 2, axis=-1) / 2 * p[..., 0], (0, 0), 1, half=True)
    errors = np.array([(energies(s)[0] / stored - 1, linkage_error(s)) for s in around_axis()])
    assert slope(errors[:, 0]) > ENERGY_RATE, errors
    assert slope(errors[:, 1]) > ENERGY_RATE - 0.3, errors
    assert slope([field_error(s, ball_field) for s in around_axis()]) > FIELD_RATE - 0.05


def linkage_error(solution: Solution) -> float:
    """Of the round coil, relative."""
    exact = 2 * np.pi * over_disc(ball_potential, (0.65, -0.3), 0.1)
    return float(flux_linkages(solution)[0]) / exact - 1


def errors_by_ring(solutions: list[Solution]) -> tuple[list[float], list[float], list[float]]:
    """Root mean squares of |B_h − B| in elements that touch the axis, in their neighbours, and in all others."""
    found: tuple[list[float], list[float], list[float]] = [], [], []
    for solution in solutions:
        miss, weight = misses(solution, ball_field)
        corners = solution.problem.mesh.elements[:, :3]
        touching = np.any(solution.problem.mesh.nodes[corners, 0] <= 0, axis=1)
        beside = np.any(np.isin(corners, corners[touching]), axis=1) & ~touching
        for part, errors in zip((touching, beside, ~touching & ~beside), found, strict=True):
            errors.append(float(np.sqrt(np.sum((weight * miss)[part]) / np.sum(weight[part]))))
    return found


def test_field_on_the_axis_is_as_good_as_elsewhere() -> None:
    """Catches elements of low order where people look first: those in (r, z) have a rate of one."""
    on_axis, _, away = errors_by_ring(around_axis())
    assert slope(on_axis) > FIELD_RATE - 0.1, on_axis
    assert slope(away) > FIELD_RATE - 0.1, away
    assert on_axis[-1] < 2 * away[-1]


def test_field_near_the_axis_keeps_its_order() -> None:
    """Catches elements on the axis, or their neighbours, losing an order: the last rates, where it shows."""
    for errors in errors_by_ring(around_axis()):
        assert rates(errors)[-1] > FIELD_RATE - 0.05, errors


def driven_by_magnets(outline: Outline, reluctivities: tuple[float, ...], count: int) -> list[Solution]:
    """The ball's field in materials that jump, kept up by magnets with H_c = ν B, so that H = 0 everywhere."""

    def magnet(reluctivity: float) -> MagneticMaterial:
        return MagneticMaterial(reluctivity, lambda points: reluctivity * ball_field(points))

    materials = [magnet(reluctivity) for reluctivity in reluctivities]
    return [manufactured(level, materials, None, 2) for level in levels(outline, NOTHING, count)]


def test_iron_with_sloped_and_curved_faces_on_the_axis() -> None:
    """Catches faces of iron, 1000 to one, that cost an order. In the one element at the tip of each it is the first."""
    solved = driven_by_magnets(ball(*DOUBLE_CONE), (1.0, 1e-3, 1.0), 3)
    assert slope([field_error(s, ball_field) for s in solved]) > FIELD_RATE - 0.05
    on_axis, _, _ = errors_by_ring(solved)
    assert slope(on_axis) > 1.4, on_axis


def test_linkage_of_a_coil_keeps_its_order() -> None:
    """Catches what little of the order is lost near the axis, with and without iron there."""
    magnetic = driven_by_magnets(ball(*DOUBLE_CONE), (1.0, 1e-3, 1.0), 4)
    for solved in (around_axis(), magnetic):
        assert slope([linkage_error(s) for s in solved]) > ENERGY_RATE
