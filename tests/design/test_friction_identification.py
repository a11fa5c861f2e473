"""The friction law from measurements: parameters found, intervals that cover, and what cannot be told."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from fluxbore.design.errors import FluxboreError, IdentificationError
from fluxbore.design.friction import SealFriction, seal_friction
from fluxbore.design.friction_identification import identify_friction, law
from fluxbore.design.friction_points import COLUMNS, FrictionPoints, friction_points
from fluxbore.design.identification import Identified
from fluxbore.design.measurements import parse_measurements

Floats = NDArray[np.float64]

AREA = 20.6e-6
TABLE_IV = SealFriction(0.182, 0.127, 20.5, 0.00132, 0.0)
FREQUENCIES = (0.3, 0.5, 0.8, 1.0, 1.2, 1.4, 1.9, 2.2, 2.5, 3.0, 3.3, 3.6)
SPEEDS = 2 * 1.05e-3 * np.array(FREQUENCIES)
PRESSURES = np.linspace(0.0, 0.6e6, 8)
TRUTH = {
    "static_coefficient": 0.182,
    "coulomb_coefficient": 0.127,
    "contact_force": 20.5,
    "stribeck_speed": 0.00132,
    "coulomb_force": 0.127 * 20.5,
}


def points(
    speeds: Floats = SPEEDS,
    pressures: Floats = PRESSURES,
    noise: float = 0.1,
    seed: int = 1,
    friction: SealFriction = TABLE_IV,
) -> FrictionPoints:
    """Both directions at each speed and pressure."""
    v, P = (each.ravel() for each in np.meshgrid(np.concatenate((speeds, -speeds)), pressures))
    scatter = np.random.default_rng(seed).normal(0.0, noise, len(v))
    return FrictionPoints(v, P, seal_friction(friction, AREA, P, v) + scatter, "m.csv")


def errors(found: Identified) -> dict[str, float]:
    estimates = {**found.parameters, **found.derived}
    return {name: estimates[name].value / value - 1 for name, value in TRUTH.items()}


def test_without_scatter_the_law_itself_comes_back() -> None:
    found = identify_friction(points(noise=0.0), AREA)
    assert all(abs(error) < 1e-8 for error in errors(found).values()), found.parameters
    assert found.parameters["contact_force"].high == pytest.approx(20.5, rel=1e-6)
    assert law([each.value for each in found.parameters.values()]).stribeck_speed == pytest.approx(0.00132)


@pytest.mark.parametrize("scale", [1e-2, 1.0, 1e2])
def test_seals_of_other_sizes_are_found_too(scale: float) -> None:
    """Nothing in the fit knows the prototype: another force and speed by a factor."""
    other = SealFriction(0.3, 0.05, 8.0 * scale, 4e-3 * scale, 0.0)
    v, P = (each.ravel() for each in np.meshgrid(np.geomspace(1e-3, 2e-2, 9) * scale, PRESSURES * scale))
    found = identify_friction(FrictionPoints(v, P, seal_friction(other, AREA, P, v), "m.csv"), AREA)
    values = [each.value for each in found.parameters.values()]
    assert values == pytest.approx([0.3, 0.05, 8.0 * scale, 4e-3 * scale], rel=1e-6)


def test_at_a_tenth_of_a_newton_parameters_come_within_five_per_cent_and_intervals_cover() -> None:
    """Thirty trials: root mean square errors below 5 % each, 95 % intervals that hold the truth in 24 or more (where
    they would cover 80 % only, this fails in nearly half of all seeds; where 95 %, in one of 2,000)."""
    runs = [identify_friction(points(seed=seed), AREA) for seed in range(30)]
    table = np.array([list(errors(found).values()) for found in runs])
    assert np.all(np.sqrt(np.mean(table**2, axis=0)) < 0.05)
    for name, value in TRUTH.items():
        held = 0
        for found in runs:
            estimate = {**found.parameters, **found.derived}[name]
            held += estimate.low <= value <= estimate.high
        assert held >= 24, (name, held)
    assert np.mean([found.residual_deviation for found in runs]) == pytest.approx(0.1, rel=0.05)


def test_coefficient_and_contact_force_trade_off_and_their_product_does_not() -> None:
    found = identify_friction(points(), AREA)
    assert ("contact_force", "coulomb_coefficient") in [pair[:2] for pair in found.correlated()]
    share = {
        name: estimate.standard_error / estimate.value
        for name, estimate in {**found.parameters, **found.derived}.items()
    }
    assert 2 * share["coulomb_force"] < min(share["coulomb_coefficient"], share["contact_force"])


def test_viscous_friction_is_zero_unless_asked_for() -> None:
    thick = SealFriction(0.182, 0.127, 20.5, 0.00132, 40.0)
    data = points(noise=0.01, friction=thick)
    assert "viscous_coefficient" not in identify_friction(data, AREA).parameters
    found = identify_friction(data, AREA, viscous=True)
    estimate = found.parameters["viscous_coefficient"]
    assert estimate.low < 40.0 < estimate.high
    assert estimate.standard_error < 4.0


def test_viscous_friction_that_is_not_there_ends_at_its_bound() -> None:
    """Some seeds pull it below zero; there it stays at zero, and the interval with it."""
    bounds = set()
    for seed in range(6):
        estimate = identify_friction(points(seed=seed), AREA, viscous=True).parameters["viscous_coefficient"]
        bounds.add(estimate.bound)
        assert estimate.low == 0.0 <= estimate.value <= estimate.high
    assert bounds == {"", "lower"}


@pytest.mark.parametrize(
    ("speeds", "pressures", "sentence"),
    [
        (
            SPEEDS[:2],
            PRESSURES,
            "m.csv does not identify stribeck_speed: it has 2 speeds of the 3 needed; "
            "it takes three or more speeds on both sides of the Stribeck speed.",
        ),
        (
            SPEEDS[3:4],
            PRESSURES,
            "m.csv does not identify stribeck_speed and static_coefficient: it has 1 speed of the 3 needed; it takes "
            "three or more speeds on both sides of the Stribeck speed; slow motion, below the Stribeck speed.",
        ),
        (
            SPEEDS[3] * np.array([1.0, 1.001, 0.999, 1.01]),
            PRESSURES,
            "m.csv does not identify stribeck_speed and static_coefficient: it has 1 speed of the 3 needed",
        ),
        (
            SPEEDS,
            np.array([3e5]),
            "m.csv does not identify contact_force, coulomb_coefficient and static_coefficient: "
            "it has 1 pressure of the 2 needed, and tells their products alone; it takes ",
        ),
        (SPEEDS, np.array([0.0]), "m.csv does not identify contact_force, coulomb_coefficient and static_"),
        # All of them far above the Stribeck speed: what is measured is Coulomb's force alone.
        (
            SPEEDS + 8e-3,
            PRESSURES,
            "m.csv does not identify static_coefficient and stribeck_speed: friction changes with the speed by no more "
            "than its scatter; it takes slow motion, below the Stribeck speed; three or more speeds on both sides",
        ),
    ],
)
def test_what_is_not_identifiable_is_named(speeds: Floats, pressures: Floats, sentence: str) -> None:
    with pytest.raises(IdentificationError) as caught:
        identify_friction(points(speeds, pressures), AREA)
    assert str(caught.value).startswith(sentence)


def test_speeds_that_differ_little_from_one_to_the_next_are_many() -> None:
    """A sweep of speeds, each 1 % above the last: neighbours count as one, the ends do not."""
    found = identify_friction(points(np.geomspace(6e-4, 8e-3, 260), PRESSURES[::3]), AREA)
    assert found.parameters["stribeck_speed"].value == pytest.approx(0.00132, rel=0.05)


def test_too_few_speeds_for_viscous_friction() -> None:
    with pytest.raises(IdentificationError, match=r"identify stribeck_speed: it has 3 speeds of the 4 needed"):
        identify_friction(points(SPEEDS[::5]), AREA, viscous=True)


def test_scatter_that_hides_a_parameter_is_refused() -> None:
    """Pressures so close together that the friction changes by a twentieth of its scatter."""
    with pytest.raises(
        IdentificationError,
        match=r"identify .*contact_force: the 95 % interval .*would be .*; it takes .*pressures far enough apart",
    ):
        identify_friction(points(pressures=np.array([0.0, 2e3])), AREA)


def test_force_of_the_other_sign_is_told() -> None:
    data = points()
    turned = FrictionPoints(data.velocity, data.pressure, -data.friction, "m.csv")
    with pytest.raises(IdentificationError, match=r"^m\.csv: force must be friction, which is positive at positive"):
        identify_friction(turned, AREA)


def test_suction_is_refused() -> None:
    data = points()
    with pytest.raises(IdentificationError, match=r"^m\.csv: pressure must be 0 MPa gauge or above .*got -0\.1 MPa"):
        identify_friction(FrictionPoints(data.velocity, data.pressure - 1e5, data.friction, "m.csv"), AREA)


@settings(deadline=None, max_examples=30)
@given(data=st.data(), count=st.integers(1, 12), viscous=st.booleans())
def test_any_points_are_identified_or_refused_in_one_sentence(data: st.DataObject, count: int, viscous: bool) -> None:
    """Whatever the columns let through."""

    def drawn(column: int, low: float, high: float) -> str:
        values = st.floats(low, high) | st.sampled_from([low, high, 1e-9, 1.0])
        return f"{data.draw(values, label=COLUMNS[column].name)!r}"

    rows = [f"{drawn(0, -100.0, 100.0)},{drawn(1, 0.0, 1e9)},{drawn(2, -1e6, 1e6)}" for _ in range(count)]
    text = "velocity,pressure,force\n" + "\n".join(rows)
    try:
        found = identify_friction(friction_points(parse_measurements(text, "m.csv", COLUMNS)), AREA, viscous=viscous)
    except FluxboreError as error:
        sentence = str(error)
    else:
        assert all(np.isfinite(each.standard_error) for each in found.parameters.values())
        return
    assert sentence.endswith(".")
    assert sentence.isprintable()
