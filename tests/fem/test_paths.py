"""Paths: places, directions and integrals against circles and Stokes."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.fem.mesh import Floats
from fluxbore.fem.paths import Path, Stations, integrate


@pytest.mark.parametrize("turn", [np.pi / 2, -np.pi / 2, np.pi, -np.pi, 1.9 * np.pi, 1e-9])
def test_an_arc_lies_on_its_circle(turn: float) -> None:
    """Catches an arc that bends to the wrong side, and places that are unevenly spaced."""
    radius = 0.5 / abs(np.sin(turn / 2))
    path = Path.through([(0, 0), (0, 1)], [turn])
    assert path.length == pytest.approx(radius * abs(turn))
    places = path.sample(101)
    if abs(turn) > 0.1:
        # Northwards, a turn to the left has its centre in the west, if it is less than half a circle.
        centre = np.array([-np.sign(turn) * radius * np.cos(turn / 2), 0.5])
        arm = places.points - centre
        assert np.hypot(*arm.T) == pytest.approx(radius)
        assert np.sum(arm * places.tangents, axis=1) == pytest.approx(0, abs=1e-12)
        assert arm / radius == pytest.approx(-np.sign(turn) * places.normals, abs=1e-12)
    assert places.points[[0, -1]] == pytest.approx(np.array([[0, 0], [0, 1]]), abs=1e-12)
    steps = np.hypot(*np.diff(places.points, axis=0).T)
    assert steps == pytest.approx(steps[0])


@given(st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9), st.floats(-5.0, 5.0)), min_size=2, max_size=5))
@settings(max_examples=50, deadline=None)
def test_tangents_are_the_points_derivative(corners: list[tuple[int, int, float]]) -> None:
    """Catches a tangent or a length that does not belong to the points, and a normal on the right."""
    places = [(float(x), float(y)) for x, y, _ in corners]
    if any(a == b for a, b in pairwise(places)):
        with pytest.raises(ValueError, match="no length"):
            Path.through(places)
        return
    path = Path.through(places, [turn for _, _, turn in corners[:-1]])
    inside = (path.ends[:-1, None] + np.diff(path.ends)[:, None] * np.array([0.01, 0.4, 0.98])).ravel()
    step = 1e-6 * path.length
    slope = (path.at(inside + step).points - path.at(inside - step).points) / (2 * step)
    at = path.at(inside)
    assert slope == pytest.approx(at.tangents, abs=1e-3)
    cross = at.tangents[:, 0] * at.normals[:, 1] - at.tangents[:, 1] * at.normals[:, 0]
    assert cross == pytest.approx(1)


def test_corners_join_the_pieces() -> None:
    """Catches a piece that does not start where the last one ended."""
    path = Path.through([(0, 0), (1, 0), (1, 2), (-1, 2)], [0, np.pi, -1.0])
    assert path.at(path.ends).points == pytest.approx(path.corners)
    before = path.at(path.ends[1:] * (1 - 1e-12))
    assert before.points == pytest.approx(path.corners[1:], abs=1e-10)


def test_flux_is_the_potentials_difference() -> None:
    """Catches a normal on the other side: flux of B = (∂A/∂y, −∂A/∂x) through a path is A(start) − A(end)."""

    def potential(points: Floats) -> Floats:
        return np.asarray(np.sin(3 * points[:, 0]) * points[:, 1] ** 2)

    def normal(at: Stations) -> Floats:
        x, y = at.points.T
        field = np.column_stack((2 * y * np.sin(3 * x), -3 * np.cos(3 * x) * y**2))
        return np.asarray(np.sum(field * at.normals, axis=1))

    path = Path.through([(0.1, 0.2), (1, 0.5), (0.3, 1.4)], [0, 2.0])
    value, error = integrate(path, normal, 1e-9)
    start, end = potential(path.corners[[0, -1]])
    assert value == pytest.approx(start - end, rel=1e-9)
    assert error < 1e-8


def test_circulation_is_the_current_within() -> None:
    """Ampère: H = I/(2πd) around a wire, whatever the path. Catches arcs that miss a part of the round."""

    def along(at: Stations) -> Floats:
        x, y = at.points.T
        field = np.column_stack((-y, x)) / (2 * np.pi * (x**2 + y**2))[:, None]
        return np.asarray(np.sum(field * at.tangents, axis=1))

    around = Path.through([(1, 0), (-1, 0.3), (0, -1), (1, 0)], [np.pi, 0.5, 0.0])
    beside = Path.through([(1, 0), (2, 0), (2, 2), (1, 0)], [1.0, 0, 0])
    assert integrate(around, along, 1e-9)[0] == pytest.approx(1)
    assert integrate(beside, along, 1e-9)[0] == pytest.approx(0, abs=1e-9)


@given(st.floats(0.001, 0.999))
@settings(max_examples=100, deadline=None)
def test_jumps_are_found(place: float) -> None:
    """Catches a rule that trusts smoothness: a field that jumps at an interface, and one that kinks."""
    path = Path.through([(0, 0), (1, 0)])

    def steps(at: Stations) -> Floats:
        x = at.points[:, 0]
        return np.column_stack((np.where(x < place, 1.0, 3.0), np.abs(x - place)))

    value, error = integrate(path, steps)
    exact = np.array([3 - 2 * place, (place**2 + (1 - place) ** 2) / 2])
    assert value == pytest.approx(exact, rel=1e-6)
    assert np.all(error < 1e-5)


def test_what_cannot_be_integrated_ends() -> None:
    """Catches an endless halving: a field that is NaN outside the mesh, one with a pole, and noise."""
    path = Path.through([(0, 0), (1, 0)])
    assert np.isnan(integrate(path, lambda at: np.where(at.distance > 0.7, np.nan, 1.0))[0])
    _, error = integrate(path, lambda at: 1 / (np.abs(at.distance - np.sqrt(0.5)) + 1e-30))
    assert error > 0
    rng = np.random.default_rng(0)
    value, error = integrate(path, lambda at: rng.random(at.distance.size))
    assert value == pytest.approx(0.5, abs=0.01)
    assert error > 0.01


def test_a_path_needs_two_corners() -> None:
    """Catches a path of one point, or of too few turns."""
    with pytest.raises(ValueError, match="1 corners"):
        Path.through([(0, 0)])
    with pytest.raises(ValueError, match="3 corners has 1 pieces"):
        Path.through([(0, 0), (1, 0), (2, 0)], [0.0])
