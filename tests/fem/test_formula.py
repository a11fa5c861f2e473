"""Formulas of magnetisation: Lua 4's arithmetic, and nothing else."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.errors import FluxboreError, SpecError
from fluxbore.fem.formula import DEEPEST, FUNCTIONS, LONGEST, VARIABLES, parse_formula

X, Y = np.array([3.0, -1.0, 0.5]), np.array([4.0, 2.0, -0.5])


def value(text: str, x: float = 3.0, y: float = 4.0) -> float:
    return float(parse_formula(text).evaluate(np.array(x), np.array(y)))


def test_a_radial_magnet_points_along_the_polar_angle() -> None:
    """Catches theta in radians, and a pole turned by the wrong half circle."""
    theta = np.degrees(np.arctan2(Y, X))
    assert parse_formula("theta").evaluate(X, Y) == pytest.approx(theta)
    assert parse_formula("theta+180").evaluate(X, Y) == pytest.approx(theta + 180)


def test_trigonometry_is_in_radians_as_in_femm() -> None:
    """Catches plain Lua 4, whose functions take degrees: FEMM builds it with radians."""
    assert parse_formula("atan2(y,x)*180/PI").evaluate(X, Y) == pytest.approx(np.degrees(np.arctan2(Y, X)))
    assert value("sin(pi/2)") == pytest.approx(1.0)
    assert value("deg(rad(30))") == pytest.approx(30.0)


@pytest.mark.parametrize(
    "text, expected",
    [
        ("x", 3), ("y", 4), ("r", 3), ("z", 4), ("R", 5), ("theta", math.degrees(math.atan2(4, 3))),
        ("2^3^2", 512), ("-2^2", -4), ("2^-1", 0.5), ("2-3-4", -5), ("12/3/2", 2), ("1+2*3", 7), ("(1+2)*3", 9),
        ("- -5", 5), ("1e2+.5", 100.5), ("3.", 3), ("mod(-7,3)", -1), ("floor(-1.5)", -2), ("ceil(1.2)", 2),
        ("min(3,1,2)", 1), ("max(x)", 3), ("max(1,y)", 4), ("sqrt(x^2+y^2)", 5), ("abs(-x)", 3), ("log(exp(2))", 2),
        ("log10(1000)", 3), ("asin(1)*2", math.pi), ("acos(0)*2", math.pi), ("atan(1)*4", math.pi),
        ("x>0 and 90 or -90", 90), ("x<0 and 90 or -90", -90), ("not (x<0) and 1", 1), ("x==3 and 7", 7),
        ("x~=3 and 7 or 8", 8), ("x>=3 and y<=4", 1), ("0 and 5", 5), ("90*(x>0)", 90), ("theta*0 --90", 0),
        (" theta * 0\t+ 1 ", 1), ("cosh(0)+sinh(0)+tanh(0)+cos(0)+tan(0)", 2),
    ],
)  # fmt: skip
def test_arithmetic_follows_lua(text: str, expected: float) -> None:
    """Catches wrong precedence, Python's modulus in place of C's, and 0 taken for false."""
    assert value(text) == pytest.approx(expected)


def test_a_choice_is_made_point_by_point() -> None:
    """Catches a comparison of a whole array at once."""
    assert parse_formula("x>0 and 90 or -90").evaluate(X, Y).tolist() == [90, -90, 90]


def test_a_constant_fills_the_shape() -> None:
    """Catches a scalar where the elements' quadrature points are expected."""
    assert parse_formula("45").evaluate(np.zeros((2, 3)), np.zeros((2, 3))).tolist() == [[45] * 3] * 2


@pytest.mark.parametrize(
    "text, words",
    [
        ("", "empty"), ("--theta", "empty"), ("theta+", "ends too early"), ("(theta", '"\\)" is missing'),
        ("theta)", "should end"), ("theta theta", "should end"), ("foo", '"foo" is not known'),
        ("x.y", "cannot be read"), ("__import__('os')", "cannot be read"), ("x; y", "cannot be read"),
        ("sin", '"\\(" is missing'), ("sin()", "out of place"), ("sin(1,2)", "sin takes 1 value, not 2"),
        ("atan2(1)", "atan2 takes 2 values, not 1"), ("*3", '"\\*" is out of place'), ("I*x", '"I" is not known'),
        ("x % 2", "cannot be read"), ("1 .. 2", "cannot be read"), ("dofile(1)", "not known"), ("ⅷ", "cannot be read"),
        ("theta\n; x", "cannot be read"),
    ],
)  # fmt: skip
def test_what_is_no_formula_is_refused_in_one_sentence(text: str, words: str) -> None:
    """Catches a traceback, an answer to nonsense, and a way to anything but arithmetic."""
    with pytest.raises(SpecError, match=words) as caught:
        parse_formula(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text", ["1/(x-3)", "sqrt(-1)", "log(0)", "90*(x<0)", "9^9^9^9", "exp(1000)", "1e999"])
def test_a_formula_without_a_value_is_refused_with_the_place(text: str) -> None:
    """Catches NaN directions that would fail far away in the solver, and exponents that never end."""
    with pytest.raises(SpecError, match=r"none at \(3, 4\)"):
        value(text)


def test_long_and_deep_formulas_are_refused() -> None:
    """Catches a crash of the recursion."""
    with pytest.raises(SpecError, match=f"at most {LONGEST}"):
        parse_formula("1+" * LONGEST + "1")
    for text in ["(" * 200 + "1" + ")" * 200, "- " * 200 + "1", "not " * 100 + "1", "2" + "^2" * 200, "sin(" * 100]:
        with pytest.raises(SpecError, match=f"more than {DEEPEST}"):
            parse_formula(text)
    assert value("1" + "+1" * 200) == 201


words = st.sampled_from([*VARIABLES, *FUNCTIONS, *"+-*/^(),<>", "==", "~=", "and", "or", "not", "1", "2.5", "PI", "$"])


@given(st.lists(words, max_size=25).map(" ".join) | st.text(max_size=30))
def test_any_text_gives_finite_degrees_or_one_sentence(text: str) -> None:
    """Catches every other exception."""
    try:
        degrees = parse_formula(text).evaluate(X, Y)
    except FluxboreError as error:
        sentence = str(error)
    else:
        sentence = ""
        assert degrees.shape == X.shape
        assert np.isfinite(degrees).all()
    assert "\n" not in sentence
