"""The derived transfer function against the paper's appendix, its poles, and the grid of its loci."""

from dataclasses import fields, replace
from fractions import Fraction
from random import Random

import numpy as np
import pytest
from force_loop_appendix import published_denominator, published_numerator
from rotlin_stand import ROTLIN

from fluxbore.design.dynamics.force_control import force_loop
from fluxbore.design.dynamics.force_stand import controller_of, stand_of
from fluxbore.design.dynamics.linearised import (
    FILTERED,
    OBSERVER_SPEEDS,
    UNFILTERED,
    ForceLoop,
    diagram,
    force_characteristic,
    force_transfer,
)
from fluxbore.design.poles import poles
from fluxbore.design.routh_hurwitz import sign_changes

STAND = stand_of(ROTLIN)
NOMINAL = force_loop(STAND.plant, STAND.environment, controller_of(ROTLIN))
UNIT = 100.0

# As the paper draws its loci: K_e to 5000 kN/m, K_l* to 10 000 kN/m; D_e of the load, none, and more of it.
STIFFNESSES = np.linspace(0, 5e6, 76)[1:, np.newaxis, np.newaxis]
SLOPES = np.linspace(0, 10e6, 61)[1:, np.newaxis]
DAMPINGS = np.array([0.0, 0.1, 10.0, 1000.0])
GRID = replace(NOMINAL, K_e=STIFFNESSES, K_l=SLOPES, D_e=DAMPINGS)


def drawn(seed):
    """A loop of random whole numbers, as fractions: polynomials that agree there agree everywhere, but for chance."""
    random = Random(seed)
    return ForceLoop(**{field.name: Fraction(random.randint(1, 10**9)) for field in fields(ForceLoop)})


@pytest.mark.parametrize("seed", range(5))
def test_the_derived_transfer_function_is_the_appendix(seed):
    """A block, sign or filter of Fig. 22 read otherwise, or a misprint of (36) or (37): no difference at all.

    The coefficients are of degree ten at most, so that a difference would vanish at such numbers once in 10^8.
    """
    loop = drawn(seed)
    ratio = force_transfer(loop)
    assert ratio.numerator == published_numerator(loop)
    assert ratio.denominator == published_denominator(loop)


@pytest.mark.parametrize("seed", range(5))
def test_a_filtered_observer_changes_three_coefficients(seed):
    """What the published denominator leaves out of a controller that can be built."""
    k = drawn(seed)
    ratio = force_transfer(k, FILTERED)
    found = [ours - theirs for ours, theirs in zip(ratio.denominator, published_denominator(k), strict=True)]
    assert found == [0, 0, 0, -k.J * k.g_D * (k.K_e + k.K_l), -k.D_e * k.J * k.g_D, -k.J * k.M * k.g_D, 0]
    assert ratio.numerator == published_numerator(k)


@pytest.mark.parametrize("observer_speed", OBSERVER_SPEEDS)
def test_the_force_comes_to_its_reference(observer_speed):
    ratio = force_transfer(NOMINAL, observer_speed)
    assert ratio.numerator[0] == pytest.approx(ratio.denominator[0], rel=1e-12)


def test_the_nominal_poles():
    found = poles(force_characteristic(NOMINAL), UNIT)
    assert found[0] == pytest.approx(-0.954, abs=5e-4)
    assert found[1:3] == pytest.approx([-27.3 + 334.6j, -27.3 - 334.6j], abs=0.05)
    assert found[3:] == pytest.approx([-345.3, -599.2, -1000.0], abs=0.1)


def test_the_dominant_pole_is_the_position_gain_over_two_springs():
    """-K_p K_e/(K_e + K_l*), the rotor held and the masses left out, to a tenth."""
    rough = -NOMINAL.K_p * NOMINAL.K_e / (NOMINAL.K_e + NOMINAL.K_l)
    assert poles(force_characteristic(NOMINAL), UNIT)[0].real == pytest.approx(rough, rel=0.1)


def test_no_pole_of_the_published_loop_is_in_the_right_half_plane():
    """By the poles and by Routh-Hurwitz, on 18 000 points."""
    polynomial = force_characteristic(GRID)
    found = poles(polynomial, UNIT)
    assert found.shape == (75, 60, 4, 6)
    assert found.real.max() < 0
    assert np.all(sign_changes(polynomial) == 0)


def test_the_loop_that_can_be_built_is_unstable_against_a_stiff_wall():
    """Poles and Routh-Hurwitz agree on where: only where the environment is stiff and hardly damped."""
    polynomial = force_characteristic(GRID, FILTERED)
    unstable = poles(polynomial, UNIT)[..., 0].real > 0
    assert np.array_equal(unstable, sign_changes(polynomial) > 0)
    assert unstable[..., :2].any()
    assert not unstable[..., 2:].any()
    at_end = poles(force_characteristic(replace(NOMINAL, K_e=5e6), FILTERED), UNIT)[0]
    assert at_end.real == pytest.approx(0.14, abs=5e-3)
    assert poles(force_characteristic(replace(NOMINAL, K_e=5e6)), UNIT)[0].real < 0


@pytest.mark.parametrize("observer_speed", OBSERVER_SPEEDS)
def test_nothing_to_press_against_is_a_pole_at_zero(observer_speed):
    polynomial = force_characteristic(replace(NOMINAL, K_e=0.0), observer_speed)
    assert polynomial[0] == 0
    found = poles(polynomial, UNIT)
    assert abs(found[0]) < 1e-9
    assert found[1:].real.max() < 0
    assert np.isnan(sign_changes(polynomial))


def test_the_locus_begins_at_no_slope():
    """K_l* of zero, where (31) has no slope but the poles are still those of the loop."""
    assert poles(force_characteristic(replace(NOMINAL, K_l=0.0)), UNIT).real.max() < 0


def test_another_speed_is_told():
    with pytest.raises(ValueError, match="unfiltered, filtered; got twice"):
        diagram(NOMINAL, "twice")
    assert set(diagram(NOMINAL, UNFILTERED)) == set(diagram(NOMINAL, FILTERED))
