"""Conjugate gradients: the tolerance kept, endings told apart, exact preconditioners."""

import numpy as np
import pytest

from fluxbore.fem.conjugate_gradients import FAIR_TRIAL, Floats, conjugate_gradients


def spread(condition: float, size: int = 60) -> Floats:
    """A diagonal, evenly spread in the logarithm."""
    return np.geomspace(1.0, condition, size)


def noise(size: int = 60) -> Floats:
    return np.random.default_rng(1).normal(size=size)


@pytest.mark.parametrize("tolerance", [0.1, 1e-6, 1e-12])
def test_the_tolerance_is_kept(tolerance: float) -> None:
    """Catches a residual that drifts away from the one that is told, and an x of the step before."""
    a, b = spread(100.0), noise()
    found = conjugate_gradients(lambda x: a * x, lambda r: r, b, tolerance, 200)
    assert found.reached
    assert np.linalg.norm(b - a * found.x) <= 1.001 * tolerance * np.linalg.norm(b)
    assert found.residual == pytest.approx(b - a * found.x, abs=1e-11)


def test_an_exact_preconditioner_takes_one_iteration() -> None:
    """Catches a preconditioner that is not used."""
    a, b = spread(1e6), noise()
    found = conjugate_gradients(lambda x: a * x, lambda r: r / a, b, 1e-9, 10)
    assert (found.reached, found.iterations) == (True, 1)


def test_the_limit_is_an_ending() -> None:
    """Catches an endless iteration, and one that pretends."""
    a = spread(1e6)
    found = conjugate_gradients(lambda x: a * x, lambda r: r, noise(), 1e-12, 7)
    assert (found.reached, found.definite, found.iterations) == (False, True, 7)


def test_no_prospects_is_an_early_ending() -> None:
    """Catches iterations wasted on a neighbour too far away, and one given up that would have served."""
    far, near = spread(1e6), spread(1.5)
    found = conjugate_gradients(lambda x: far * x, lambda r: r, noise(), 1e-12, 40, prospects=True)
    assert (found.reached, found.iterations) == (False, FAIR_TRIAL)
    assert conjugate_gradients(lambda x: near * x, lambda r: r, noise(), 1e-12, 40, prospects=True).reached


def test_nothing_gives_nothing() -> None:
    """Catches a division by a right side of zero."""
    found = conjugate_gradients(lambda x: x, lambda r: r, np.zeros(3), 0.0, 5, prospects=True)
    assert found.reached
    assert np.array_equal(found.x, np.zeros(3))


@pytest.mark.parametrize("sign", [(-1, 1), (1, -1)])
def test_an_indefinite_matrix_or_preconditioner_is_told(sign: tuple[int, int]) -> None:
    """Catches a saddle taken for a minimum."""
    found = conjugate_gradients(lambda x: sign[0] * x, lambda r: sign[1] * r, noise(), 1e-6, 5)
    assert (found.reached, found.definite) == (False, False)
