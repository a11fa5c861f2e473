"""Dead times and lags against closed forms and against one another."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.dynamics.lag import held, lagged


def test_a_step_decays_as_its_exponential_at_any_step():
    for step in (1e-4, 1e-2, 1.0):
        count = 50
        found = lagged(np.ones(count), 0.1, step, 0.0)
        assert found == pytest.approx(1 - np.exp(-step * np.arange(count + 1) / 0.1), abs=1e-12)


def test_a_lag_begins_where_it_is_told():
    assert lagged(np.zeros(3), 1.0, 1.0, 2.0) == pytest.approx(2.0 * np.exp([0.0, -1.0, -2.0, -3.0]))


def test_no_lag_is_the_command():
    assert lagged(np.array([1.0, 3.0]), 0.0, 0.1, 7.0).tolist() == [7.0, 1.0, 3.0]


def test_whole_delays_shift():
    assert held(np.array([1.0, 2.0, 3.0]), 2, 3.0, 9.0).tolist() == [9.0, 9.0, 9.0, 1.0, 1.0, 2.0]
    assert held(np.array([1.0, 2.0]), 2, 0.0, 9.0).tolist() == [1.0, 1.0, 2.0, 2.0]


@given(
    st.lists(st.floats(-10, 10), min_size=1, max_size=12),
    st.integers(1, 5),
    st.floats(0, 12),
    st.floats(-10, 10),
)
def test_delays_between_steps_are_means_of_the_delayed_command(values, steps, delay, before):
    """Rounding a delay to whole steps would move it with the step."""
    command = np.array(values)
    fine = 400
    found = held(command, steps, delay, before)
    time = (np.arange(len(found) * fine) + 0.5) / fine - delay  # in steps
    index = np.minimum(np.floor(time / steps).astype(int), len(command) - 1)
    late = np.where(time < 0, before, command[np.maximum(index, 0)])
    mean = late.reshape(len(found), fine).mean(axis=1)
    assert found == pytest.approx(mean, abs=20 * 2 / fine)


def test_half_the_step_gives_the_same_lag_of_a_delayed_command():
    command = np.sin(np.arange(40.0))
    coarse, fine = (
        lagged(held(command, steps, 3.3 * steps, 0.0), 2.0, 1.0 / steps, 0.0)[::steps] for steps in (10, 160)
    )
    assert coarse == pytest.approx(fine, abs=2e-4)
