"""Least squares with intervals: against exact theory on straight models, and what it refuses."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.stats import linregress, t

from fluxbore.design.errors import IdentificationError, SpecError
from fluxbore.design.identification import Identified, Parameter, identify

Floats = NDArray[np.float64]

LINE = (Parameter("offset", 0.0), Parameter("slope", 1.0, dimension="force"))


def line(x: Floats, y: Floats, parameters: tuple[Parameter, ...] = LINE, level: float = 0.95) -> Identified:
    return identify(lambda p: p[0] + p[1] * x - y, parameters, source="line.csv", level=level)


@pytest.fixture
def scattered() -> tuple[Floats, Floats]:
    x = np.linspace(1.0, 4.0, 12)
    return x, 2.0 + 3.0 * x + np.random.default_rng(2).normal(0.0, 0.3, len(x))


def test_a_straight_line_as_the_textbook_has_it(scattered: tuple[Floats, Floats]) -> None:
    """Values, standard errors and Student intervals against scipy's regression."""
    x, y = scattered
    found = line(x, y, level=0.9)
    known = linregress(x, y)
    half = t.ppf(0.95, 10)
    for name, value, error in (
        ("slope", known.slope, known.stderr),
        ("offset", known.intercept, known.intercept_stderr),
    ):
        estimate = found.parameters[name]
        assert estimate.value == pytest.approx(value, rel=1e-7)
        assert estimate.standard_error == pytest.approx(error, rel=1e-6)
        assert estimate.high - estimate.low == pytest.approx(2 * half * error, rel=1e-6)
        assert estimate.bound == ""
    assert found.degrees_of_freedom == 10
    assert found.residual_deviation == pytest.approx(np.std(y - known.intercept - known.slope * x) * np.sqrt(1.2))
    x_mean, x_square = np.mean(x), np.mean(x**2)
    assert found.correlation[0, 1] == pytest.approx(-x_mean / np.sqrt(x_square), rel=1e-6)
    assert found.correlated() == []


def test_an_analytic_jacobian_gives_the_same(scattered: tuple[Floats, Floats]) -> None:
    x, y = scattered
    other = identify(
        lambda p: p[0] + p[1] * x - y,
        LINE,
        source="line.csv",
        jacobian=lambda p: np.stack([np.ones_like(x), x], axis=1),
    )
    assert other.covariance == pytest.approx(line(x, y).covariance, rel=1e-6)


def test_what_follows_from_the_parameters_has_its_interval(scattered: tuple[Floats, Floats]) -> None:
    """The line's value at the mean of x, which is the mean of y with the error s/sqrt(n); and a product."""
    x, y = scattered
    found = identify(
        lambda p: p[0] + p[1] * x - y,
        LINE,
        source="line.csv",
        derived={
            "middle": (lambda p: float(p[0] + p[1] * np.mean(x)), None),
            "product": (lambda p: float(p[0] * p[1]), "force"),
        },
    )
    assert found.derived["middle"].value == pytest.approx(np.mean(y))
    assert found.derived["middle"].standard_error == pytest.approx(found.residual_deviation / np.sqrt(12), rel=1e-6)
    gradient = np.array([found.parameters["slope"].value, found.parameters["offset"].value])
    assert found.derived["product"].standard_error == pytest.approx(
        np.sqrt(gradient @ found.covariance @ gradient), rel=1e-6
    )


def test_data_without_scatter_give_the_parameters_themselves() -> None:
    x = np.array([1.0, 2.0, 3.0])
    found = line(x, 2.0 + 3.0 * x)
    assert found.parameters["slope"].value == pytest.approx(3.0, rel=1e-12)
    assert found.parameters["slope"].high == pytest.approx(3.0, rel=1e-9)


def test_a_parameter_at_its_bound_is_said_to_be(scattered: tuple[Floats, Floats]) -> None:
    x, y = scattered
    for side, bounds in (("upper", (0.0, 1.5)), ("lower", (2.5, 9.0))):
        parameters = (Parameter("offset", 2.0, *bounds), Parameter("slope", 1.0))
        estimate = line(x, y, parameters).parameters["offset"]
        assert estimate.bound == side
        assert estimate.value == bounds[side == "upper"]
        assert bounds[0] <= estimate.low <= estimate.high <= bounds[1]


def test_the_best_of_several_starts_is_taken() -> None:
    """sin(p x) has a minimum for nearly every start."""
    x = np.linspace(0.0, 10.0, 60)
    y = np.sin(2.0 * x)

    def residual(p: Floats) -> Floats:
        return np.asarray(np.sin(p[0] * x) - y)

    rate = (Parameter("rate", 6.0),)
    found = identify(residual, rate, source="s", starts=[[0.5], [2.1], [4.0]])
    assert found.parameters["rate"].value == pytest.approx(2.0)


def test_what_can_only_change_together_is_named() -> None:
    x = np.array([2.0, 2.0, 2.0, 2.0])
    with pytest.raises(IdentificationError) as caught:
        line(x, np.array([1.0, 1.1, 0.9, 1.0]))
    assert str(caught.value) == (
        "line.csv does not identify offset and slope: they can change together without a change of the measured "
        "values; it takes more data of less scatter."
    )


def test_what_changes_nothing_is_named() -> None:
    parameters = (Parameter("offset", 1.0), Parameter("slope", 1.0, told_by="x other than 0"))
    with pytest.raises(IdentificationError) as caught:
        line(np.zeros(4), np.array([1.0, 1.1, 0.9, 1.0]), parameters)
    assert str(caught.value) == (
        "line.csv does not identify slope: the measured values would be the same for any value of it; "
        "it takes x other than 0."
    )


def test_an_interval_wider_than_the_value_is_no_result() -> None:
    """And the sentence tells which parameter, with its interval in its unit."""
    x = np.linspace(1.0, 1.1, 6)
    y = 2.0 + 0.1 * x + np.random.default_rng(1).normal(0, 0.1, 6)
    with pytest.raises(
        IdentificationError,
        match=r"^line\.csv does not identify (offset and )?slope: the 95 % interval( of slope)? would be "
        r"-?[\d.]+ N \N{PLUS-MINUS SIGN} [\d.]+ N; it takes more data of less scatter\.$",
    ):
        line(x, y, (Parameter("offset", 1.0, scale=1e3), Parameter("slope", 1.0, dimension="force")))


def test_as_many_rows_as_parameters_leave_no_scatter() -> None:
    with pytest.raises(
        IdentificationError, match=r"^line\.csv must have more rows than the 2 parameters of the model; got 2\.$"
    ):
        line(np.array([1.0, 2.0]), np.array([1.0, 2.0]))


@pytest.mark.parametrize("level", [0.0, 0.4, 1.0, 95.0, float("nan")])
def test_levels_that_are_none(level: float) -> None:
    with pytest.raises(SpecError, match=r"^level must be from 0\.5 to 0\.9999; got "):
        line(np.arange(5.0), np.arange(5.0), level=level)


def test_intervals_cover_as_often_as_they_say() -> None:
    """An interval of 80 % of a curved model over 300 trials: 0.8 \N{PLUS-MINUS SIGN} 3 sqrt(0.8 0.2/300)."""
    x, random, held = np.linspace(0.0, 2.0, 25), np.random.default_rng(11), np.zeros(2)
    truth = np.array([3.0, 1.2])

    def model(p: Floats) -> Floats:
        return np.asarray(p[0] * np.exp(-p[1] * x))

    for _ in range(300):
        y = model(truth) + random.normal(0, 0.05, len(x))
        found = identify(
            lambda p, y=y: model(p) - y,  # type: ignore[misc]
            (Parameter("size", 1.0), Parameter("rate", 1.0)),
            source="s",
            level=0.8,
        )
        estimates = found.parameters.values()
        held += [estimate.low <= value <= estimate.high for value, estimate in zip(truth, estimates, strict=True)]
    assert np.all(np.abs(held / 300 - 0.8) < 0.07), held
