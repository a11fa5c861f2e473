"""Transfer functions of diagrams whose answers are known, with numbers of several kinds."""

from fractions import Fraction

import numpy as np
import pytest

from fluxbore.design.block_diagram import Signal, characteristic, transfer
from fluxbore.design.polynomial import S, add, multiply, scaled, trimmed


def motor(gain, lag):
    """A lag in an integrating loop: gain/(lag s^2 + s + gain)."""
    return {
        "error": Signal({"wanted": (1,), "angle": (-1,)}),
        "speed": Signal({"error": (gain,)}, (1, lag)),
        "angle": Signal({"speed": (1,)}, S),
    }


def test_a_loop_that_is_closed():
    ratio = transfer(motor(3, 2), "wanted", "angle")
    assert ratio.numerator == (3,)
    assert ratio.denominator == (3, 1, 2)
    assert characteristic(motor(3, 2)) == ratio.denominator


def test_signals_within_the_loop_share_its_denominator():
    """Catches a column replaced in the wrong place, or the sign of a minor."""
    ratio = transfer(motor(3, 2), "wanted", "error")
    assert ratio.numerator == (0, 1, 2)
    assert ratio.denominator == (3, 1, 2)


def test_the_order_of_the_signals_does_not_matter():
    diagram = motor(Fraction(3), Fraction(2))
    turned = {name: diagram[name] for name in ("angle", "error", "speed")}
    assert transfer(turned, "wanted", "angle") == transfer(diagram, "wanted", "angle")


def test_a_filter_that_two_loops_share_is_one_state():
    """Loops closed one after the other would multiply the filter's pole in twice."""
    diagram = {
        "filtered": Signal({"out": (5,)}, (5, 1)),
        "inner": Signal({"wanted": (1,), "filtered": (-2,)}),
        "out": Signal({"inner": (1,), "filtered": (-3,)}, S),
    }
    assert characteristic(diagram) == (25, 5, 1)


def test_coefficients_may_be_arrays_over_a_grid():
    gains = np.array([[1.0], [2.0]])
    lags = np.array([0.5, 0.25, 0.125])
    ratio = transfer(motor(gains, lags), "wanted", "angle")
    for row, gain in enumerate(gains[:, 0]):
        for column, lag in enumerate(lags):
            single = transfer(motor(gain, lag), "wanted", "angle")
            found = [np.broadcast_to(c, (2, 3))[row, column] for c in ratio.denominator]
            assert found == list(single.denominator)


def test_feedback_into_itself_and_two_sources():
    diagram = {"y": Signal({"y": (Fraction(1, 2),), "u": (3,), "v": (0, 1)})}
    assert transfer(diagram, "u", "y").numerator == (3,)
    assert transfer(diagram, "v", "y").numerator == (0, 1)
    assert transfer(diagram, "u", "y").denominator == (Fraction(1, 2),)


def test_a_source_from_elsewhere_does_nothing():
    assert transfer(motor(1, 1), "wind", "angle").numerator == (0,)


def test_names_that_do_not_fit_are_told():
    with pytest.raises(ValueError, match="a signal of the diagram itself"):
        transfer(motor(1, 1), "speed", "angle")
    with pytest.raises(KeyError, match="torque"):
        transfer(motor(1, 1), "wanted", "torque")


def test_polynomials_are_numpys():
    left, right = (1, 0, -2.5, 3), (4, 5)
    reference = np.polynomial.polynomial
    assert multiply(left, right) == pytest.approx(reference.polymul(left, right))
    assert add(left, right) == pytest.approx(reference.polyadd(left, right))
    assert add(right, left) == add(left, right)
    assert scaled(left, 2) == pytest.approx(2 * np.array(left))
    assert trimmed((1, 2, 0, 0)) == (1, 2)
    assert trimmed((0, 0)) == (0,)
