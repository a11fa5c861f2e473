"""The zero-force line from two unloaded runs: what comes back, and runs that do not tell it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from fluxbore.design.dynamics.magnetic_spring import LinearSpring
from fluxbore.design.dynamics.motion_log import MotionLog
from fluxbore.design.dynamics.pole_distortion import NODES_PER_TURN, PoleDistortion, detect_distortion
from fluxbore.design.errors import IdentificationError

Floats = NDArray[np.float64]

H = 36e-3 / 7 / math.tau
GAP = 0.85 / 220e3
"""m: half of what lies between the runs, by friction."""


def line(angle: Floats) -> Floats:
    return np.asarray(25e-6 * (np.sin(angle + 0.3) + 0.2 * np.sin(6 * angle)) + 5e-6)


def runs(turns: float = 4.0, forward: float = 12.0, backward: float = 12.0, count: float = 0.0) -> MotionLog:
    """Out and home at rotor speeds (rad/s), with a rest before, between and after, at 1 kHz."""
    period = 1e-3
    parts = [
        np.zeros(200),
        np.arange(0.0, math.tau * turns, forward * period),
        np.full(200, math.tau * turns),
        np.arange(math.tau * turns, 0.0, -backward * period),
        np.zeros(200),
    ]
    angle = np.concatenate(parts)
    sense = np.repeat([0.0, 1.0, 0.0, -1.0, 0.0], [len(part) for part in parts])
    position = H * angle - line(angle) - GAP * sense
    if count > 0:
        angle, position = np.round(angle / (count / H)) * (count / H), np.round(position / count) * count
    return MotionLog(period, angle, position, source="runs.csv")


def test_the_line_comes_back_and_the_friction_from_half_of_the_gap() -> None:
    """(24), to what averaging over a 128th of a turn takes off the sixth order; 0.4 % of 5 um."""
    found = detect_distortion(runs(), H)
    angle = np.linspace(found.distortion.first, found.distortion.last, 3000)
    assert found.distortion(angle) == pytest.approx(line(angle), abs=0.15e-6)
    # Four samples a node do not lie quite alike about it on the way out and on the way home.
    assert found.half_gap == pytest.approx(np.full(len(found.half_gap), GAP), abs=0.25e-6)
    assert found.friction(LinearSpring(220e3)) == pytest.approx(0.85, rel=5e-3)
    assert found.speed == pytest.approx(12.0, rel=1e-3)
    assert found.distortion.last - found.distortion.first > math.tau * 3.5


def test_counts_are_averaged_out() -> None:
    """Encoders of 1 um leave less than half a count."""
    found = detect_distortion(runs(forward=3.0, backward=3.0, count=1e-6), H).distortion
    angle = np.linspace(found.first, found.last, 3000)
    assert float(np.sqrt(np.mean((found(angle) - line(angle)) ** 2))) < 0.4e-6


def test_a_wrong_pitch_comes_out_as_distortion() -> None:
    """h rounded to 8.19e-4 drifts in proportion to the angle."""
    exact, rounded = (detect_distortion(runs(), h).distortion for h in (H, 8.19e-4))
    angle = np.linspace(exact.first, exact.last, 200)
    assert rounded(angle) - exact(angle) == pytest.approx((8.19e-4 - H) * angle, abs=0.05e-6)


def test_between_nodes_it_is_straight_and_beyond_them_level() -> None:
    known = PoleDistortion(1.0, 0.5, np.array([0.0, 2e-6, -1e-6]))
    assert known.last == 2.0
    asked = np.array([[-5.0, 1.0, 1.25], [1.5, 1.75, 9.0]])
    assert known(asked) == pytest.approx(np.array([[0.0, 0.0, 1e-6], [2e-6, 0.5e-6, -1e-6]]), abs=1e-18)
    assert known.covers(asked).tolist() == [[False, True, True], [True, True, False]]


@pytest.mark.parametrize(
    ("log", "words"),
    [
        (runs(backward=11.0), "the runs forward and backward must be at speeds within 5 % of one another"),
        (
            runs(turns=0.003),
            "the runs forward and backward must share two 128ths of a turn or more; they go",
        ),
        (replace(runs(), angle=np.zeros(len(runs().angle))), "must hold a run forward and one backward; it has none"),
        (
            replace(runs(), angle=np.cumsum(np.full(len(runs().angle), 0.012))),
            "must hold a run forward and one backward; it has none backward",
        ),
    ],
)
def test_runs_that_do_not_tell_it(log: MotionLog, words: str) -> None:
    with pytest.raises(IdentificationError) as raised:
        detect_distortion(log, H)
    assert words in str(raised.value)
    assert str(raised.value).startswith("runs.csv")


def test_angles_that_a_run_has_jumped_over() -> None:
    """A sample for every third node; a jump on the way out alone, about which the speed is not steady either."""
    fast = math.tau / NODES_PER_TURN * 3e3
    with pytest.raises(
        IdentificationError, match=r"must have a sample within each 0\.0491 rad of their way; one has \d+ for"
    ):
        detect_distortion(runs(forward=fast, backward=fast, turns=60), H)
    log = runs()
    out = np.arange(len(log.angle)) < len(log.angle) / 2
    kept = ~(out & (log.angle > 6.0) & (log.angle < 6.15))
    with pytest.raises(IdentificationError, match=r"must have a sample within each .*; one has none about 5\.7"):
        detect_distortion(replace(log, angle=log.angle[kept], position=log.position[kept]), H)
