"""Distributions of tolerances and of weighted sums of them, against closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.study import DISTRIBUTIONS, Tolerance
from fluxbore.optimize.tolerance_scatter import LinearSum, centre, deviations, sigma


def one(distribution, minus=-1.0, plus=1.0):
    return Tolerance("key", minus, plus, distribution)


def total(*parts):
    """A sum of (distribution, slope) with limits of +-1."""
    return LinearSum(tuple(one(kind) for kind, _ in parts), tuple(slope for _, slope in parts))


def irwin_hall(x, count):
    """P(sum of ``count`` uniform numbers from 0 to 1 <= x) (Irwin 1927, Hall 1927)."""
    terms = ((-1) ** k * math.comb(count, k) * max(x - k, 0.0) ** count for k in range(count + 1))
    return math.fsum(terms) / math.factorial(count)


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_samples_have_the_mean_and_the_spread_that_are_stated(distribution):
    """A width taken for a half width, or a distribution about the nominal value where its limits are unequal."""
    item = one(distribution, -0.02, 0.1)
    sample = deviations([item], 200_000, 1)[:, 0]
    assert centre(item) == pytest.approx(0.04)
    assert np.mean(sample) == pytest.approx(centre(item), abs=4 * sigma(item) / math.sqrt(200_000))
    assert np.std(sample) == pytest.approx(sigma(item), rel=0.01)
    if distribution != "normal":
        assert sample.min() >= item.minus
        assert sample.max() <= item.plus


def test_a_normal_tolerance_has_its_limits_at_three_standard_deviations():
    outside = LinearSum((one("normal"),), (1.0,)).below(-1.0)
    assert outside == pytest.approx(0.00134990, rel=1e-5)


def test_more_samples_begin_with_the_same_ones():
    """Checks of a longer run that would not find the shorter one's in the journal."""
    tolerances = [one("normal"), one("uniform")]
    assert np.array_equal(deviations(tolerances, 50, 7), deviations(tolerances, 500, 7)[:50])
    assert not np.array_equal(deviations(tolerances, 50, 7), deviations(tolerances, 50, 8))


@pytest.mark.parametrize("count", [2, 3, 6])
def test_sums_of_uniform_scatter_are_irwin_and_halls(count):
    made = total(*[("uniform", 1.0)] * count)
    for x in np.linspace(0.05, count - 0.05, 23):
        assert made.below(2 * x - count) == pytest.approx(irwin_hall(x, count), abs=1e-5)


def test_two_equal_uniform_parts_are_a_triangular_one():
    two, triangular = total(("uniform", 0.5), ("uniform", 0.5)), total(("triangular", 1.0))
    for x in (-0.9, -0.3, 0.0, 0.4, 0.99):
        assert two.below(x) == pytest.approx(triangular.below(x), abs=1e-5)
    assert two.variance == pytest.approx(triangular.variance)


def test_normal_parts_add_to_a_normal_one():
    made = total(("normal", 3.0), ("normal", -4.0))
    assert made.sigma == pytest.approx(5 / 3)
    assert made.below(5.0) == pytest.approx(1 - 0.00134990, abs=1e-8)


def test_normal_and_uniform_parts_convolve():
    """P(a n + u <= x) is the mean of the normal one over the uniform one's width; here by Simpson's rule."""
    made = total(("normal", 0.6), ("uniform", 1.0))
    steps = np.linspace(-1, 1, 2001)
    weights = np.where(np.arange(2001) % 2 == 1, 4.0, 2.0)
    weights[[0, -1]] = 1.0
    for x in (-1.2, -0.5, 0.0, 0.7, 1.4):
        exact = sum(w * (1 + math.erf((x - u) / 0.2 / math.sqrt(2))) / 2 for w, u in zip(weights, steps, strict=True))
        assert made.below(x) == pytest.approx(exact / weights.sum(), abs=1e-5)


_PARTS = st.lists(st.tuples(st.sampled_from(DISTRIBUTIONS), st.floats(0.05, 5.0)), min_size=1, max_size=5)


@given(parts=_PARTS, share=st.floats(0.001, 0.999))
def test_quantile_and_share_are_inverse(parts, share):
    made = total(*parts)
    assert made.below(made.quantile(share)) == pytest.approx(share, abs=1e-6)


@given(parts=_PARTS, which=st.integers(0, 4), room=st.floats(0.0, 5.0))
def test_halving_a_symmetric_tolerance_never_lowers_the_share_within_one_limit(parts, which, room):
    """True where scatter is symmetric about a nominal design that holds the limit (Wintner 1938: the rest is unimodal).

    It is not for asymmetric tolerances, whose mean moves, nor sample by sample.
    """
    index = which % len(parts)
    halved = [(kind, slope / 2 if i == index else slope) for i, (kind, slope) in enumerate(parts)]
    reach = room * total(*parts).sigma
    assert total(*halved).below(reach) >= total(*parts).below(reach) - 2e-5


def test_the_worst_case_has_every_key_at_its_worse_limit():
    made = LinearSum((one("normal", -1.0, 2.0), one("uniform", -3.0, 0.0)), (2.0, -1.0))
    assert made.worst == (-2.0, 7.0)
    assert made.mean == pytest.approx(2 * 0.5 + 1.5)


def test_nothing_scatters():
    still = LinearSum((one("normal"),), (0.0,))
    assert (still.below(-1e-9), still.below(0.0), still.quantile(0.99)) == (0.0, 1.0, 0.0)
