"""Rounding's noise is zero, and what is small but real is not."""

import toy

from fluxbore.design.performance import Performance
from fluxbore.design.study import Variable
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.noise import clear_slopes, clear_value

SPEC = toy.spec(x=2.0, y=3.0, variables=(Variable(toy.X, 0.0, 1e-3),))


def test_a_slope_is_noise_by_what_the_whole_range_would_do():
    """Catches a slope judged by its own size: 1e-6 N/A per metre is nothing of 1 N/A over 1 mm, and much of 1e-8."""
    slopes = {"force_constant": {toy.X: -1e-7, toy.Y: 1e-7}, "stray_field": {toy.X: 1e-7}, "turns": {toy.X: 1e-30}}
    made = Performance(force_constant=1.0, stray_field=1e-8)
    assert clear_slopes(SPEC, Evaluation("fem", OK, (), made, gradient=slopes)) == {
        "force_constant": {toy.X: 0.0, toy.Y: 1e-7},
        "stray_field": {toy.X: 1e-7},
        "turns": {toy.X: 1e-30},
    }
    assert clear_slopes(SPEC, Evaluation("fem", OK, (), made)) == {}


def test_a_value_is_noise_by_its_variables_range():
    """Catches -4e-17 mm for a bound of zero, and a key without a range rounded off."""
    assert clear_value(SPEC, toy.X, -4e-20) == 0.0
    assert clear_value(SPEC, toy.X, 4e-12) == 4e-12
    assert clear_value(SPEC, toy.Y, 4e-20) == 4e-20
