"""Recurrences over whole records against the plain loop that defines them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from fluxbore.design.recurrence import recurrence


def _loop(a: NDArray[np.float64], b: NDArray[np.float64], start: NDArray[np.float64] | float) -> NDArray[np.float64]:
    values = [np.broadcast_to(np.asarray(start, dtype=np.float64), b.shape[1:])]
    for factor, added in zip(a, b, strict=True):
        values.append(factor * values[-1] + added)
    return np.array(values)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 8, 9, 10, 99, 100, 101, 1000])
@pytest.mark.parametrize("runs", [(), (1,), (5,)])
def test_as_the_loop(count: int, runs: tuple[int, ...]) -> None:
    random = np.random.default_rng(count)
    a, b = random.uniform(-1.0, 1.0, (count, *runs)), random.normal(size=(count, *runs))
    start = random.normal(size=runs)
    assert recurrence(a, b, start) == pytest.approx(_loop(a, b, start), rel=1e-12, abs=1e-12)


def test_factors_of_a_step_at_rest_and_of_one_that_forgets() -> None:
    a = np.array([1.0, 1.0, 0.0, 1.0, 0.5, 0.0])
    b = np.array([0.0, 2.0, 7.0, 0.0, 1.0, 3.0])
    assert recurrence(a, b, 4.0).tolist() == [4.0, 4.0, 6.0, 7.0, 7.0, 4.5, 3.0]


def test_one_record_for_every_run() -> None:
    random = np.random.default_rng(3)
    a, b = random.uniform(0.0, 1.0, 50), random.normal(size=(50, 4))
    each = np.stack([_loop(a, b[:, run], 1.5) for run in range(4)], axis=1)
    assert recurrence(a, b, 1.5) == pytest.approx(each, rel=1e-12, abs=1e-12)
    assert recurrence(b / 4, a, 1.5) == pytest.approx(
        np.stack([_loop(b[:, run] / 4, a, 1.5) for run in range(4)], axis=1), rel=1e-12, abs=1e-12
    )


def test_one_record_from_several_starts() -> None:
    a, b, starts = np.full(20, 0.5), np.ones(20), np.array([0.0, 2.0, 5.0])
    assert recurrence(a, b, starts)[-1] == pytest.approx(2 + (starts - 2) * 0.5**20, rel=1e-12)


def test_nothing_to_step_through() -> None:
    assert recurrence(np.empty(0), np.empty(0), 2.0).tolist() == [2.0]
    assert recurrence(np.empty((0, 2)), np.empty((0, 2)), 2.0).tolist() == [[2.0, 2.0]]


def test_fast_decay_leaves_no_nan() -> None:
    values = recurrence(np.full(10_000, 1e-200), np.ones(10_000))
    assert values[1:] == pytest.approx(1.0)


def test_unequal_records_are_refused() -> None:
    with pytest.raises(ValueError, match="3 factors has 2 terms"):
        recurrence(np.ones(3), np.ones(2))
