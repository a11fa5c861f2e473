"""Play: deaf within its width, and never further behind than it."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.design.dynamics.play import follow, follow_record


def test_it_follows_only_where_it_is_pushed() -> None:
    assert follow_record([0.0, 0.5, 1.0, 3.0, 2.0, 1.5, 0.0], 1.0).tolist() == [0.0, 0.0, 0.0, 2.0, 2.0, 2.0, 1.0]
    assert [follow(2.0, value, 1.0) for value in (0.0, 1.5, 2.5, 4.0)] == [1.0, 2.0, 2.0, 3.0]


def test_it_stays_within_its_width_and_moves_no_more_than_it_must() -> None:
    """Its way is at most that of what it follows."""
    walk = np.cumsum(np.random.default_rng(1).normal(0.0, 1.0, 2000))
    followed = follow_record(walk, 2.5)
    assert float(np.max(np.abs(followed - walk))) == pytest.approx(2.5)
    assert float(np.sum(np.abs(np.diff(followed)))) < 0.5 * float(np.sum(np.abs(np.diff(walk))))


def test_without_width_it_is_what_it_follows() -> None:
    walk = np.random.default_rng(1).normal(0.0, 1.0, 50)
    assert follow_record(walk, 0.0).tolist() == walk.tolist()
    assert follow_record([], 1.0).tolist() == []
