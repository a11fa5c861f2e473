"""Routh's count against the roots themselves."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.poles import poles
from fluxbore.design.routh_hurwitz import first_column, routh_table, sign_changes

ROOTS = st.lists(st.integers(-9, 9).filter(bool), min_size=1, max_size=6)


@given(ROOTS)
def test_the_count_is_that_of_the_roots(roots):
    """Exactly, with integers; where the rule leaves the count open it says so."""
    polynomial = np.polynomial.polynomial.polyfromroots(roots)
    column = first_column(tuple(Fraction(round(c)) for c in polynomial))
    if all(isinstance(entry, Fraction) and entry for entry in column):
        changes = sum((a > 0) != (b > 0) for a, b in pairwise(column))
        assert changes == sum(root > 0 for root in roots)


def test_a_table_from_a_textbook():
    """s^4 + 2 s^3 + 3 s^2 + 4 s + 5: two roots in the right half plane (Ogata, Modern Control Engineering)."""
    table = routh_table((5.0, 4.0, 3.0, 2.0, 1.0))
    assert [row[0] for row in table] == [1, 2, 1, -6, 5]
    assert table[2] == [1, 5]
    assert sign_changes((5.0, 4.0, 3.0, 2.0, 1.0)) == 2


def test_a_grid_is_counted_at_once():
    """s^3 + 3 s^2 + 3 s + 1 + K becomes unstable above K = 8, where it stands on the axis."""
    gains = np.array([-2.0, 0.0, 7.9, 8.0, 8.1])
    polynomial = (1.0 + gains, 3.0, 3.0, 1.0)
    assert sign_changes(polynomial) == pytest.approx([1, 0, 0, np.nan, 2], nan_ok=True)
    assert (poles(polynomial).real > 1e-9).sum(axis=-1).tolist() == [1, 0, 0, 0, 2]


def test_a_pole_at_zero_leaves_the_count_open():
    assert np.isnan(sign_changes((0.0, 1.0, 1.0)))


def test_a_constant_has_no_poles():
    with pytest.raises(ValueError, match="no poles"):
        routh_table((1.0,))
