"""The state of Bouc-Wen hysteresis: bounded, blind to time and to steps, and the differential equation's solution."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from fluxbore.design.dynamics.bouc_wen import BoucWen, advance, states
from fluxbore.design.errors import DesignError

Floats = NDArray[np.float64]

TABLE_II = BoucWen(1.0, 3000.0, 1000.0, 1.0)
MODELS = (
    TABLE_II,
    BoucWen(1.0, 3000.0, 3000.0),  # comes back on the straight line
    BoucWen(1.0, 3000.0, -1000.0),
    BoucWen(0.7, 9e6, 1e6, 2.0),
    BoucWen(1.0, 60e3, -10e3, 1.4),
)


def rate(model: BoucWen, sense: float, state: float) -> float:
    """(18), by the travel |x|, as it stands in the paper."""
    size = abs(state)
    return model.phi * sense - model.psi * size ** (model.eta - 1) * state - model.xi * sense * size**model.eta


@pytest.mark.parametrize("model", MODELS)
def test_a_stretch_is_what_the_differential_equation_gives(model: BoucWen) -> None:
    """From either side of zero, through it and on: (18) integrated at 1e-12 by another route."""
    for start in (-0.9 * model.bound, -0.2 * model.bound, 0.0, 0.5 * model.bound):
        for moved in (3e-4, -3e-4, 2e-5):
            sense = math.copysign(1.0, moved)
            solved = solve_ivp(
                lambda _, y, sense=sense: [rate(model, sense, float(y[0]))],
                (0.0, abs(moved)),
                [start],
                rtol=1e-10,
                atol=1e-16,
                method="DOP853",
                max_step=2e-5,
            )
            assert advance(model, start, moved) == pytest.approx(float(solved.y[0, -1]), abs=1e-9 * model.bound)


@pytest.mark.parametrize("model", MODELS)
def test_a_stretch_is_the_same_in_many_short_ones(model: BoucWen) -> None:
    """Short ones of other exponents take another rule than long ones: to and fro through zero and near the bound."""
    for start, moved in ((-0.9 * model.bound, 4e-4), (0.8 * model.bound, -4e-4), (0.0, 1e-4)):
        whole = advance(model, start, moved)
        record = np.linspace(0.0, moved, 2001)
        assert states(model, record, start)[-1] == pytest.approx(whole, abs=1e-8 * model.bound)


def test_the_state_comes_to_its_bound_and_no_further() -> None:
    """A quarter of a millimetre for Table II; a rule that overshoots, or a bound of psi alone, would show."""
    assert TABLE_II.bound == pytest.approx(0.25e-3, rel=1e-12)
    assert advance(TABLE_II, 0.0, 1.0) == pytest.approx(0.25e-3, rel=1e-12)
    walk = np.cumsum(np.random.default_rng(3).normal(0.0, 3e-4, 20_000))
    for start in (-0.25e-3, 0.0, 0.25e-3):
        largest = float(np.max(np.abs(states(TABLE_II, walk, start))))
        assert 0.99 * 0.25e-3 < largest <= 0.25e-3 * (1 + 1e-6)


@pytest.mark.parametrize("moved", [0.4e-3, 0.6e-3, 5e-3, 1.0])
def test_steps_that_throw_eulers_rule_off_are_stable(moved: float) -> None:
    """To and fro in steps of up to a metre: Euler's rule leaves the bound beyond 0.5 mm."""
    record = np.tile([0.0, moved], 200)
    assert float(np.max(np.abs(states(TABLE_II, record)))) <= TABLE_II.bound * (1 + 1e-12)
    euler = 0.0
    for sense in [1.0, -1.0] * 200:
        euler += moved * rate(TABLE_II, sense, euler)
        if abs(euler) > 2 * TABLE_II.bound:
            break
    assert (abs(euler) > 2 * TABLE_II.bound) == (moved > 0.5e-3)


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.floats(-1e-3, 1e-3), min_size=2, max_size=12),
    st.integers(2, 9),
    st.sampled_from(MODELS[:3]),
)
def test_only_the_way_counts(turns: list[float], parts: int, model: BoucWen) -> None:
    """Rate independence: the same way in other steps, and with rests, ends in the same state."""
    coarse = np.array(turns)
    shares = np.linspace(0.0, 1.0, parts) ** 1.7
    fine = np.concatenate([a + (b - a) * shares for a, b in pairwise(turns)])
    ends = states(model, fine)[parts - 1 :: parts]
    assert ends == pytest.approx(states(model, coarse)[1:], abs=1e-12 * model.bound)


@pytest.mark.parametrize("model", MODELS)
def test_the_record_is_the_steps(model: BoucWen) -> None:
    """A record at once and sample by sample, through many turning points and rests."""
    generator = np.random.default_rng(5)
    walk = np.cumsum(np.round(generator.normal(0.0, 1.5, 120)) * 4e-5)
    start = 0.3 * model.bound
    stepped = [start]
    for moved in np.diff(walk).tolist():
        stepped.append(advance(model, stepped[-1], moved))
    assert states(model, walk, start) == pytest.approx(np.array(stepped), abs=1e-12 * model.bound)


def test_records_too_short_to_move() -> None:
    assert states(TABLE_II, [], 1e-4).tolist() == []
    assert states(TABLE_II, [0.7], 1e-4).tolist() == [1e-4]
    assert states(TABLE_II, [0.7, 0.7, 0.7], 1e-4).tolist() == [1e-4] * 3


def test_the_law_is_odd() -> None:
    walk = np.cumsum(np.random.default_rng(8).normal(0.0, 1e-4, 500))
    assert states(TABLE_II, -walk, -1e-4) == pytest.approx(-states(TABLE_II, walk, 1e-4), abs=1e-18)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"phi": 0.0}, "phi of the hysteresis must be finite and above 0; got 0"),
        ({"psi": -1.0}, "psi of the hysteresis must be finite and above 0; got -1"),
        ({"xi": 3001.0}, "xi of the hysteresis must be finite and above -3000 and at most psi, 3000; got 3001"),
        ({"xi": -3000.0}, "xi of the hysteresis must be"),
        ({"xi": math.nan}, "got nan"),
        ({"eta": 0.9}, "eta of the hysteresis must be finite and 1 or above; got 0.9"),
    ],
)
def test_parameters_without_a_bounded_state_are_refused(change: dict[str, float], words: str) -> None:
    """xi at psi is the last that is valid."""
    BoucWen(1.0, 3000.0, 3000.0, 1.0)
    with pytest.raises(DesignError) as raised:
        BoucWen(**{"phi": 1.0, "psi": 3000.0, "xi": 1000.0, "eta": 1.0, **change})
    assert words in str(raised.value)
    assert str(raised.value).endswith(".")


def test_a_state_beyond_the_bound_is_refused_where_it_has_no_travel() -> None:
    model = MODELS[3]
    with pytest.raises(DesignError, match="the hysteresis state must be at most"):
        advance(model, 1.01 * model.bound, 1e-4)
