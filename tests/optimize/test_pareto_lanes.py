"""Searches side by side: one order of designs whatever the threads do, and no thread that outlives them."""

import threading
import time

import pytest

from fluxbore.optimize.pareto_lanes import side_by_side


@pytest.fixture(autouse=True)
def _no_thread_left():
    before = threading.active_count()
    yield
    assert threading.active_count() == before


def walk(values, seen, pause=0.0):
    """A lane that asks for these values one after the other."""

    def job(ask):
        for value in values:
            time.sleep(pause)
            seen.append(ask((value,)))

    return job


@pytest.mark.parametrize("pauses", [(0.0, 0.003), (0.003, 0.0)])
def test_batches_are_the_same_whoever_is_the_quicker(pauses):
    """Catches an order that depends on threads: a replay would then ask for other designs."""
    batches, one, other = [], [], []

    def serve(points):
        batches.append([point[0] for point in points])
        return [-point[0] for point in points]

    side_by_side([walk([1, 2, 3, 4], one, pauses[0]), walk([10, 20], other, pauses[1])], serve)
    assert batches == [[1, 10], [2, 20], [3], [4]]
    assert (one, other) == ([-1, -2, -3, -4], [-10, -20])


def test_no_jobs_and_jobs_that_ask_nothing_end_at_once():
    side_by_side([], list)
    side_by_side([walk([], []), walk([], [])], list)


@pytest.mark.parametrize("error", [KeyboardInterrupt, OSError])
def test_what_serving_raises_ends_all_lanes(error):
    """Catches a lane that swallows its stop and asks on for ever."""
    ends = []

    def stubborn(ask):
        try:
            while True:
                ask((0.0,))
        finally:
            ends.append(1)

    def serve(points):
        if len(points) == 2:
            raise error
        return points

    with pytest.raises(error):
        side_by_side([stubborn, stubborn], serve)
    assert ends == [1, 1]


def test_what_a_lane_raises_ends_the_others_and_comes_out():
    def broken(ask):
        ask((1.0,))
        raise ZeroDivisionError("in the lane")

    seen = []
    with pytest.raises(ZeroDivisionError, match="in the lane"):
        side_by_side([walk(range(100), seen), broken], lambda points: [point[0] for point in points])
    assert len(seen) < 100
