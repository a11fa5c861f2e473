"""The progress line: what a person at a long study wants to know."""

import io
import sys

import pytest

from fluxbore.optimize.progress import Progress
from fluxbore.progress_bar import Bar


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


def test_quiet_is_quiet(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    with Bar(quiet=True) as bar:
        bar.show(Progress("sweep", 1, 1, 0, 0, None, None, None, 1.0, 0.0))
    assert stream.getvalue() == ""
