"""The progress line: what a person at a long study wants to know."""

import io
import sys

import pytest

from fluxbore.design.performance import Performance
from fluxbore.optimize import progress
from fluxbore.optimize.evaluation import INVALID, OK, Evaluation
from fluxbore.optimize.progress import Progress
from fluxbore.progress_bar import Bar
from fluxbore.value_text import short_names


def line(monkeypatch: pytest.MonkeyPatch, **changes: object) -> str:
    state = {
        "label": "sweep", "done": 30, "total": 4000, "reused": 0, "failed": 0, "figure": None, "best": None,
        "best_values": None, "rate": None, "seconds_left": None,
    }  # fmt: skip
    stream = io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    with Bar(quiet=False) as bar:
        bar.show(Progress(**(state | changes)))  # type: ignore[arg-type]
    return stream.getvalue().strip()


def test_rate_time_left_and_the_best_so_far(monkeypatch):
    best = {"figure": "force_constant", "best": 8.5, "best_values": {"actuator.mover.ring_width": 0.0015}}
    assert line(monkeypatch, rate=0.33, seconds_left=12000.0, reused=3, failed=2, **best) == (
        "sweep 30/4000, 3 from the journal, 2 failed, 3.03 s each, 3 h 20 min left, best 8.5 N/A at ring_width 1.5 mm"
    )


def test_fast_designs_are_counted_by_the_second(monkeypatch):
    assert line(monkeypatch, rate=12.345, seconds_left=321.0) == "sweep 30/4000, 12.3 a second, 5 min left"
    assert line(monkeypatch, rate=50.0, seconds_left=79.4) == "sweep 30/4000, 50 a second, 79 s left"


def test_nothing_is_left_at_the_end_and_nothing_is_guessed_at_the_beginning(monkeypatch):
    assert line(monkeypatch) == "sweep 30/4000"
    assert line(monkeypatch, done=4000, rate=2.0, seconds_left=0.0) == "sweep 4000/4000, 2 a second"


def test_what_a_budget_leaves_is_the_most_it_can_take(monkeypatch):
    assert line(monkeypatch, label="search", rate=2.0, seconds_left=20.0, at_most=True) == (
        "search 30/4000, 2 a second, at most 20 s left"
    )


def test_variables_with_the_same_last_word_are_told_apart(monkeypatch):
    """Catches two outer diameters of which nobody knows whose they are."""
    yoke, shaft, ring = (
        "actuator.back_yoke.outer_diameter", "actuator.shaft.outer_diameter", "actuator.mover.ring_width",
    )  # fmt: skip
    assert short_names([yoke, shaft, ring]) == {
        yoke: "back_yoke.outer_diameter", shaft: "shaft.outer_diameter", ring: "ring_width",
    }  # fmt: skip
    assert short_names(["length", "actuator.length"]) == {"length": "length", "actuator.length": "actuator.length"}
    best = {"figure": "force_constant", "best": 8.5, "best_values": {yoke: 0.03, shaft: 0.006}}
    assert line(monkeypatch, **best).endswith("at back_yoke.outer_diameter 30 mm, shaft.outer_diameter 6 mm")


def states(monkeypatch: pytest.MonkeyPatch, label: str, added: list[tuple[float, str, bool]]) -> list[Progress]:
    """What a tracker says of designs that are told of at these times, with a status, reused or not."""
    now, seen = [0.0], []
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])
    tracker = progress.Tracker(label, 20, seen.append, None)
    for now[0], status, reused in added:
        tracker.add({}, Evaluation("fem", status, (), Performance()), reused=reused)
    return seen


def test_only_computed_designs_have_a_rate(monkeypatch):
    """Catches a promise after one design, and a rate that the journal or what cannot be built makes look fast."""
    seen = states(monkeypatch, "sweep", [(0, OK, True), (0, INVALID, False), (10, OK, False), (20, OK, False)])
    assert [state.rate for state in seen] == [None, None, None, 0.1]
    assert seen[-1].seconds_left == pytest.approx(160)
    assert not seen[-1].at_most


def test_the_network_s_time_is_no_design_s(monkeypatch):
    """100 s of the network, two designs side by side, then one every 10 s."""
    seen = states(monkeypatch, "search", [(100, OK, False), (100.01, OK, False), (110.01, OK, False)])
    assert [state.rate for state in seen[:2]] == [None, None]
    assert seen[-1].rate == pytest.approx(0.1)
    assert seen[-1].at_most


def test_quiet_is_quiet(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    with Bar(quiet=True) as bar:
        bar.show(Progress("sweep", 1, 1, 0, 0, None, None, None, 1.0, 0.0))
    assert stream.getvalue() == ""
