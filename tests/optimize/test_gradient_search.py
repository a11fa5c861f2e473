"""One run of a gradient search: published optima, points without figures, whatever the function raises."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluxbore.optimize.gradient_search import NO_START, View, minimise
from fluxbore.optimize.optimality import multipliers

ALGORITHMS = ("SLSQP", "MMA", "CCSAQ")


def hock_schittkowski_71(u):
    """Problem 71 of Hock and Schittkowski (1981), its equality as the inequality that binds; x = 1 + 4 u."""
    a, b, c, d = (1 + 4 * value for value in u)
    loss = a * d * (a + b + c) + c
    slope = (d * (2 * a + b + c), a * d, a * d + 1, a * (a + b + c))
    product, square = (-b * c * d, -a * c * d, -a * b * d, -a * b * c), (2 * a, 2 * b, 2 * c, 2 * d)
    misses = (25 - a * b * c * d) / 25, (a * a + b * b + c * c + d * d - 40) / 40
    return View(
        loss / 17,
        misses,
        tuple(4 / 17 * value for value in slope),
        (tuple(4 / 25 * value for value in product), tuple(4 / 40 * value for value in square)),
    )


def run(function, start, size, **options):
    """The ending, and the best point without a miss above 1e-6."""
    seen = []

    def watched(x):
        view = function(x)
        if view is not None and max(view.misses, default=0.0) <= 1e-6:
            seen.append((view.loss, x))
        return view

    ending = minimise(
        watched, start, (0.0,) * size, (1.0,) * size, objective_tolerance=1e-8, variable_tolerance=1e-8, **options
    )
    return ending, min(seen, default=None)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_it_finds_the_optimum_of_hock_and_schittkowski_71(algorithm):
    """Catches derivatives that are handed over transposed, unscaled or with the wrong sign."""
    ending, best = run(hock_schittkowski_71, (0.0, 0.9, 0.7, 0.1), 4, algorithm=algorithm)
    assert ending.stopped_by is None
    assert "converged" in ending.reason
    assert 17 * best[0] == pytest.approx(17.0140173, rel=1e-5)
    assert [1 + 4 * u for u in best[1]] == pytest.approx([1, 4.7429994, 3.8211503, 1.3794082], abs=5e-3)


def test_the_multipliers_of_hock_and_schittkowski_71_are_the_published_ones():
    """Published: 0.5523 of the product, 0.1615 of the squares, 1.0879 of the bound x1 >= 1 (objective per unit)."""
    _, (_, point) = run(hock_schittkowski_71, (0.0, 1.0, 1.0, 0.0), 4)
    found, left = multipliers(hock_schittkowski_71(point), point)
    assert left < 1e-5
    assert [found[0] * 17 / 25, found[1] * 17 / 40, found[2] * 17 / 4] == pytest.approx(
        [0.5522937, 0.1614686, 1.0878712], rel=1e-4
    )
    assert found[3:] == pytest.approx([0.0] * 7, abs=1e-8)


def test_a_point_that_is_no_optimum_has_a_residual():
    """Catches a residual that is small everywhere."""
    view = hock_schittkowski_71((0.0, 0.9, 0.75, 0.1))
    assert multipliers(view, (0.0, 0.9, 0.75, 0.1))[1] > 0.05


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_active_bounds_of_a_quadratic(algorithm):
    """min |x - (-1, 2, 0.5)|^2 in the unit box: at (0, 1, 0.5) with multipliers 2 and 2."""

    def quadratic(x):
        top = (-1.0, 2.0, 0.5)
        return View(
            sum((a - b) ** 2 for a, b in zip(x, top, strict=True)),
            (),
            tuple(2 * (a - b) for a, b in zip(x, top, strict=True)),
            (),
        )

    _, (_, point) = run(quadratic, (0.3, 0.4, 0.9), 3, algorithm=algorithm)
    assert point == pytest.approx((0.0, 1.0, 0.5), abs=1e-4)
    found, left = multipliers(quadratic(point), point)
    assert left < 1e-3
    assert (found[0], found[4]) == pytest.approx((2.0, 2.0), rel=1e-3)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@settings(max_examples=30, deadline=None)
@given(cut=st.floats(0.35, 0.95), angle=st.floats(0, 2 * math.pi))
def test_points_without_figures_are_survived(algorithm, cut, angle):
    """Half of the plane has nothing; catches a crash, a NaN that spreads, and an end that is worse than the start."""
    normal = math.cos(angle), math.sin(angle)

    def bowl(x):
        if normal[0] * (x[0] - 0.5) + normal[1] * (x[1] - 0.5) > cut - 0.3:
            return None
        return View((x[0] - 0.9) ** 2 + (x[1] - 0.2) ** 2, (), (2 * (x[0] - 0.9), 2 * (x[1] - 0.2)), ())

    ending, best = run(bowl, (0.5, 0.5), 2, algorithm=algorithm)
    assert ending.stopped_by is None
    assert ending.reason.endswith(".")
    assert best[0] <= bowl((0.5, 0.5)).loss
    if bowl((0.9, 0.2)) is not None:
        assert best[0] < 1e-3


def test_no_sound_start_is_said():
    ending, best = run(lambda x: None, (0.5,), 1)
    assert (ending.reason, ending.stopped_by, best) == (NO_START, None, None)


@pytest.mark.parametrize("error", [KeyboardInterrupt(), MemoryError(), ValueError("x")])
@pytest.mark.parametrize("after", [0, 3])
def test_what_the_function_raises_comes_back(error, after):
    """Catches an exception that NLopt's C code swallows, or that passes through it."""
    calls = []

    def raising(x):
        calls.append(x)
        if len(calls) > after:
            raise error
        return hock_schittkowski_71(x)

    ending, _ = run(raising, (0.0, 1.0, 1.0, 0.0), 4)
    assert ending.stopped_by is error
    assert len(calls) == after + 1
