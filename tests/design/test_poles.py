"""Roots that are known, over grids and along a parameter."""

import numpy as np
import pytest

from fluxbore.design.poles import loci, poles

KNOWN = np.array([-1.0, -3.0 + 400.0j, -3.0 - 400.0j, -1000.0])
POLYNOMIAL = tuple(np.poly(KNOWN).real[::-1])


@pytest.mark.parametrize("unit", [1.0, 100.0])
def test_known_roots_come_back_the_rightmost_first(unit):
    assert poles(POLYNOMIAL, unit) == pytest.approx(KNOWN, rel=1e-10)


def test_a_grid_is_what_each_point_is():
    stiffness = np.linspace(1.0, 9.0, 5)[:, np.newaxis]
    damping = np.array([0.0, 0.5, 7.0])
    found = poles((stiffness, damping, 1.0))
    assert found.shape == (5, 3, 2)
    for i, k in enumerate(stiffness[:, 0]):
        for j, d in enumerate(damping):
            assert np.sort_complex(found[i, j]) == pytest.approx(np.sort_complex(np.roots([1, d, k])), abs=1e-12)


def test_branches_are_followed_through_a_change_of_order():
    """Two real poles that pass one another: sorted by their real part they would swap branches."""
    shift = np.linspace(0.0, 4.0, 41)
    first, second = -1.0 - shift, np.full(41, -3.05)
    found = loci(poles((first * second, -(first + second), np.ones(41))))
    assert found.real == pytest.approx(np.stack([first, second], axis=-1), abs=1e-9)


def test_a_degree_that_vanishes_is_told():
    with pytest.raises(ValueError, match="leading coefficient"):
        poles((1.0, 2.0, np.array([1.0, 0.0])))
