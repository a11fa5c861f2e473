"""The cylinder's friction law from data: exact without scatter, its errors as published, outliers, what is not told."""

from collections.abc import Sequence

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from fluxbore.design.cylinder_friction import PUBLISHED, cylinder_friction
from fluxbore.design.errors import DesignError, IdentificationError
from fluxbore.design.friction_points import COLUMNS, FrictionPoints, friction_points
from fluxbore.design.hydrostatic_friction_identification import (
    NAMES,
    cylinder_law,
    expected_errors,
    identify_cylinder_friction,
    plan,
)
from fluxbore.design.measurements import parse_measurements

Floats = NDArray[np.float64]
GEOMETRIC = np.geomspace(1e-3, 0.45, 30)
EVEN = np.linspace(3e-3, 0.45, 30)
TRUTH = {name: getattr(PUBLISHED, name) for name in NAMES}
TABLE_I = {"preload": 0.91, "stribeck_force": 5.96, "stribeck_decay": 61.1, "viscous_coefficient": 3.56}
"""Standard errors; the paper prints N/Pa at the second, which must be N."""

f_C = PUBLISHED.pressure_coefficient


def points(velocity: ArrayLike, pressure: ArrayLike = 0.0, scatter: float = 0.0, seed: int = 1) -> FrictionPoints:
    v = np.asarray(velocity, dtype=np.float64)
    p = np.broadcast_to(np.asarray(pressure, dtype=np.float64), v.shape).copy()
    noise = scatter * np.random.default_rng(seed).standard_normal(len(v))
    return FrictionPoints(v, p, cylinder_friction(PUBLISHED, v, p) + noise, "m.csv")


def test_without_scatter_the_law_itself_comes_back() -> None:
    """To 1e-6, f_C known or found from two pressures, in one direction or both, evenly spaced too."""
    found = identify_cylinder_friction(points(EVEN), known_pressure_coefficient=f_C)
    for name, each in found.parameters.items():
        assert each.value == pytest.approx(TRUTH[name], rel=1e-6), name
    both = np.concatenate((GEOMETRIC, -GEOMETRIC))
    found = identify_cylinder_friction(points(both, np.where(both > 0, 26e5, 2e5)))
    assert set(found.parameters) == set(NAMES)
    for name, each in found.parameters.items():
        assert each.value == pytest.approx(TRUTH[name], rel=1e-6), name
    law = cylinder_law(found)
    assert law.stribeck_decay == pytest.approx(118.5)
    assert law.pressure_coefficient == pytest.approx(4.2e-6)


def test_errors_are_as_published() -> None:
    """Thirty speeds evenly from 3 mm/s to 0.45 m/s and 2 N of scatter, which the paper does not tell, give all four
    standard errors of Table I within a factor of 1.5; geometric spacing halves that of c."""
    even = expected_errors(PUBLISHED, EVEN, 2.0)
    for name, published in TABLE_I.items():
        assert 1 / 1.5 < even[name] / published < 1.5, name
    assert expected_errors(PUBLISHED, GEOMETRIC, 2.0)["stribeck_decay"] < even["stribeck_decay"] / 2


def test_expected_errors_are_those_of_a_fit() -> None:
    """The fit's standard errors scatter about them; by the median of few seeds within a fifth."""
    found = [
        identify_cylinder_friction(points(GEOMETRIC, 0.0, 2.0, seed), known_pressure_coefficient=f_C).parameters
        for seed in range(9)
    ]
    for name, expected in expected_errors(PUBLISHED, GEOMETRIC, 2.0).items():
        assert np.median([each[name].standard_error for each in found]) == pytest.approx(expected, rel=0.2), name


def test_outliers_count_little() -> None:
    """Three of sixty points 60 N off: least squares runs away with them, the robust fit does not."""
    clean = points(np.concatenate((GEOMETRIC, -GEOMETRIC)), 0.0, 1.0)
    force = clean.friction.copy()
    force[[5, 20, 47]] += (60.0, 60.0, -60.0)
    spoiled = FrictionPoints(clean.velocity, clean.pressure, force, clean.source)
    good = identify_cylinder_friction(clean, known_pressure_coefficient=f_C).parameters
    robust = identify_cylinder_friction(spoiled, known_pressure_coefficient=f_C).parameters
    plain = identify_cylinder_friction(spoiled, known_pressure_coefficient=f_C, robust=False).parameters
    for name in ("preload", "viscous_coefficient", "stribeck_force"):
        off = abs(robust[name].value - good[name].value)
        assert off < abs(plain[name].value - good[name].value) / 3, name
        assert off < 2 * good[name].standard_error, name


def test_a_file_is_read() -> None:
    rows = "".join(f"{1e3 * v:.9g}, {0.2 if k % 2 else 2.6}, {_force(v, k):.12g}\n" for k, v in enumerate(GEOMETRIC))
    data = parse_measurements("velocity [mm/s], pressure [MPa gauge], force [N]\n" + rows, "run.csv", COLUMNS)
    found = identify_cylinder_friction(friction_points(data))
    assert found.parameters["pressure_coefficient"].value == pytest.approx(4.2e-6, rel=1e-4)


def _force(v: float, k: int) -> float:
    return float(cylinder_friction(PUBLISHED, v, 0.2e6 if k % 2 else 2.6e6))


def test_plan_is_geometric_and_tells_c() -> None:
    found = plan(PUBLISHED, 1e-3, 0.45, 30, 2.0)
    np.testing.assert_allclose(np.diff(np.log(found.speeds)), np.log(450) / 29)
    assert found.decay_share == pytest.approx(found.errors["stribeck_decay"] / 118.5)
    assert found.decay_share < 0.2
    assert plan(PUBLISHED, 1e-3, 0.45, 120, 2.0).decay_share == pytest.approx(found.decay_share / 2, rel=0.05)
    with pytest.raises(DesignError, match=r"must be above 0 m/s and below the fastest, 0.45 m/s; got 1 m/s\."):
        plan(PUBLISHED, 1.0, 0.45, 30, 2.0)
    with pytest.raises(DesignError, match=r"must have 3 speeds or more, in both directions each; got 2\."):
        plan(PUBLISHED, 1e-3, 0.45, 2, 2.0)


@pytest.mark.parametrize(
    "velocity, pressure, words",
    [
        ([0.1, 0.2, 0.3, 0.1, 0.2, 0.3], 0.0, "has 3 speeds of the 4 needed"),
        (GEOMETRIC.tolist(), 5e5, "does not identify pressure_coefficient and preload: it has 1 pressure"),
        ((-GEOMETRIC).tolist(), -1e5, "pressure must be 0 MPa gauge or above"),
    ],
)
def test_what_the_data_do_not_tell(velocity: Sequence[float], pressure: float, words: str) -> None:
    known = f_C if pressure == 0.0 else None
    with pytest.raises(IdentificationError, match=words):
        identify_cylinder_friction(points(velocity, pressure), known_pressure_coefficient=known)


def test_a_force_with_the_motion_is_no_friction() -> None:
    good = points(GEOMETRIC)
    with pytest.raises(IdentificationError, match="must be friction, which is positive at positive velocities"):
        identify_cylinder_friction(FrictionPoints(good.velocity, good.pressure, -good.friction, "m.csv"))


def test_speeds_beyond_the_stribeck_effect_do_not_tell_it() -> None:
    """From 0.1 m/s on e^(-c v) is nothing: refused by name, not made up."""
    fast = points(np.linspace(0.1, 0.45, 40), 0.0, 2.0)
    with pytest.raises(IdentificationError, match=r"does not identify .*stribeck_"):
        identify_cylinder_friction(fast, known_pressure_coefficient=f_C)


@pytest.mark.full
@pytest.mark.parametrize("both", [True, False], ids=["both directions", "one"])
def test_intervals_cover_in_200_trials(both: bool) -> None:
    """Catches standard errors that are too small or too large: 95 % intervals cover in 90 to 98 % of seeded trials."""
    speeds = np.concatenate((GEOMETRIC, -GEOMETRIC)) if both else GEOMETRIC
    covered = dict.fromkeys(NAMES[:-1], 0)
    for seed in range(200):
        found = identify_cylinder_friction(points(speeds, 0.0, 2.0, seed), known_pressure_coefficient=f_C)
        for name, each in found.parameters.items():
            covered[name] += each.low <= TRUTH[name] <= each.high
    assert all(180 <= count <= 196 for count in covered.values()), covered
