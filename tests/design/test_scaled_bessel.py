"""Scaled Bessel functions: the Wronskian, the differential equation, and the two ways where both hold."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial
from scipy.special import iv, ivp, kv, kvp

from fluxbore.design.scaled_bessel import ScaledBessel, _polynomials, scaled_bessel, scaled_slopes

orders = st.one_of(st.floats(0, 20), st.floats(0, 1e5))
arguments = st.floats(-3, 6).map(lambda exponent: 10.0**exponent)


@given(order=st.floats(0, 30, allow_subnormal=False), x=st.floats(0.1, 300))
def test_it_is_the_function_in_the_range_of_doubles(order: float, x: float) -> None:
    found, slopes = both(order, x)
    grown = np.exp(found.s)
    assert float(found.i[0] * grown[0]) == pytest.approx(iv(order, x), rel=1e-11)
    assert float(found.k[0] / grown[0]) == pytest.approx(kv(order, x), rel=1e-11)
    assert float(slopes.i[0] * grown[0]) == pytest.approx(ivp(order, x) if order >= 1 else _slope(order, x), rel=1e-11)
    assert float(slopes.k[0] / grown[0]) == pytest.approx(kvp(order, x), rel=1e-11)


def both(order: float, x: float) -> tuple[ScaledBessel, ScaledBessel]:
    return scaled_bessel(np.array([order]), np.array([x])), scaled_slopes(np.array([order]), np.array([x]))


def _slope(order: float, x: float) -> float:
    """I_p', without the I_{p-1} of the library's formula, which cancels for small orders."""
    return float(iv(order + 1, x) + order / x * iv(order, x))


def test_an_order_too_small_to_be_normal_is_none() -> None:
    """Of which the library makes nan."""
    for tiny, none in zip(both(5e-324, 1.0), both(0.0, 1.0), strict=True):
        assert (tiny.i[0], tiny.k[0]) == (none.i[0], none.k[0])


@given(order=orders, x=arguments)
def test_wronskian(order: float, x: float) -> None:
    """I'K - IK' = 1/x, at orders and arguments where neither function is a double; both terms are positive."""
    found, slopes = both(order, x)
    assert float(slopes.i[0] * found.k[0] - found.i[0] * slopes.k[0]) * x == pytest.approx(1.0, rel=1e-10)
    assert min(found.i[0], found.k[0], slopes.i[0], -slopes.k[0]) > 0


@pytest.mark.parametrize(
    ("order", "ratio"), [(100.0, 0.05), (100.0, 0.3), (100.0, 1.0), (100.0, 5.0), (300.0, 0.3), (300.0, 3.0)]
)
def test_both_ways_meet(order: float, ratio: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Debye's expansions against the library's functions, at orders where both can be had."""
    by_library = both(order, ratio * order)
    monkeypatch.setattr("fluxbore.design.scaled_bessel.FAINTEST", np.inf)
    for exact, series in zip(by_library, both(order, ratio * order), strict=True):
        assert float(exact.i[0]) == pytest.approx(float(series.i[0]), rel=1e-12)
        assert float(exact.k[0]) == pytest.approx(float(series.k[0]), rel=1e-12)
        assert (exact.i[0], exact.k[0]) != (series.i[0], series.k[0])  # two ways indeed


def test_where_the_library_leaves_off() -> None:
    """Across the order where ive is too faint, the scaled functions go on smoothly."""
    p = np.linspace(100, 700, 6001)
    x = np.full_like(p, 20.0)
    for found in (scaled_bessel(p, x), scaled_slopes(p, x)):
        for values in (found.i, found.k):
            steps = np.diff(np.log(np.abs(values)))
            assert np.max(np.abs(np.diff(steps))) < 1e-6


def test_the_polynomials_are_debyes() -> None:
    """DLMF 10.41.10 and 10.41.11, from the table there."""
    u, v = _polynomials()
    assert u[1].coef == pytest.approx((Polynomial([0, 3, 0, -5]) / 24).coef)
    assert u[2].coef == pytest.approx((Polynomial([0, 0, 81, 0, -462, 0, 385]) / 1152).coef)
    assert v[1].coef == pytest.approx((Polynomial([0, -9, 0, 7]) / 24).coef)
    assert v[2].coef == pytest.approx((Polynomial([0, 0, -135, 0, 594, 0, -455]) / 1152).coef)
