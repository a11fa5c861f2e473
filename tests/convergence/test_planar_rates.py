"""Rates on planar meshes with curved edges, against manufactured fields."""

from __future__ import annotations

from functools import cache

import numpy as np
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
    rates,
    slope,
)
from planar_wave import INNER, square, wave, wave_density, wave_field

from fluxbore.fem.energy import energies
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats
from fluxbore.fem.outline import Outline, Seed


@cache
def planar() -> list[Solution]:
    return [manufactured(level, VACUUM * 2, wave_density, 1) for level in levels(square(), NOTHING, 4)]


def test_energy_and_linkage_of_a_planar_mesh() -> None:
    """Catches a lost order of the element, of its numbering on general meshes, or of a coil with a round border."""
    stored = over_rectangle(lambda p: np.sum(wave_field(p) ** 2, axis=-1) / 2, (0, 1), (0, 1))
    linked = over_disc(wave, *INNER)
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in planar()])
    assert np.all(rates(errors[:, 0]) > ENERGY_RATE), errors
    assert np.all(rates(errors[:, 1]) > ENERGY_RATE), errors
    assert np.all(rates([field_error(s, wave_field) for s in planar()]) > FIELD_RATE)


def test_recovered_field_is_better_than_the_elements_own() -> None:
    """Catches a recovery of low order, on which every estimate rests: half an order more, and half of the error."""
    own, better = ([field_error(s, wave_field, recovers) for s in planar()] for recovers in (False, True))
    assert slope(better) > FIELD_RATE + 0.5, better
    assert better[-1] < own[-1] / 2


# The same on a disc, so that the rim is curved: A = (1 − r²) exp(x).


def hill(points: Floats) -> Floats:
    x, y = points[..., 0], points[..., 1]
    return np.asarray((1 - x**2 - y**2) * np.exp(x))


def hill_field(points: Floats) -> Floats:
    x, y = points[..., 0], points[..., 1]
    return np.stack((-2 * y, 2 * x - (1 - x**2 - y**2)), axis=-1) * np.exp(x)[..., None]


def hill_density(points: Floats) -> Floats:
    x, y = points[..., 0], points[..., 1]
    return np.asarray((4 + 4 * x - (1 - x**2 - y**2)) * np.exp(x))


def test_curved_boundary_keeps_the_order() -> None:
    """Catches straight edges on arcs, which would make these rates two and three halves."""
    points = np.array([(-1, 0), (1, 0), (0.1, 0.3), (0.5, 0.3)], dtype=float)
    outline = Outline("planar", points, (*circle(0, 0), *circle(2)), (Seed((0, -0.5), 0), Seed((0.3, 0.3), 1)))
    stored = over_disc(lambda p: np.sum(hill_field(p) ** 2, axis=-1) / 2, (0, 0), 1)
    linked = over_disc(hill, (0.3, 0.3), 0.2)
    solved = [manufactured(level, VACUUM * 2, hill_density, 1) for level in levels(outline, NOTHING, 3)]
    errors = np.array([(energies(s)[0] / stored - 1, flux_linkages(s)[0] / linked - 1) for s in solved])
    assert np.all(rates(errors[:, 0]) > ENERGY_RATE), errors
    assert np.all(rates(errors[:, 1]) > ENERGY_RATE), errors
    assert np.all(rates([field_error(s, hill_field) for s in solved]) > FIELD_RATE)
