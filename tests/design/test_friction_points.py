"""Points of friction from tables, and from a load cell's samples over the paper's window."""

from __future__ import annotations

import numpy as np
import pytest

from fluxbore.design.errors import IdentificationError
from fluxbore.design.friction_points import COLUMNS, RECORD_COLUMNS, Run, friction_points, window_friction
from fluxbore.design.measurements import parse_measurements


def test_standstill_is_no_sliding_friction() -> None:
    text = "velocity [mm/s],pressure,force\n1,0,2\n0,0,3\n"
    with pytest.raises(
        IdentificationError, match=r"^m\.csv, line 3: velocity must be 1e-09 m/s or more in size, .*; got 0 m/s\.$"
    ):
        friction_points(parse_measurements(text, "m.csv", COLUMNS))


def _round_trip(speed: float, pressure: float, friction: float, noise: float = 0.0, sign: float = 1.0) -> Run:
    """Out and back over 1 mm, with thrust, a zero error of the load cell, and what the turns do to it."""
    z = np.concatenate((np.linspace(0.0, -1e-3, 101), np.linspace(-1e-3, 0.0, 101)))
    v = np.concatenate((np.full(101, -speed), np.full(101, speed)))
    turn = 50.0 * ((z > -0.1e-3) | (z < -0.9e-3))
    force = sign * (2e-4 * pressure + 0.7 + turn - np.sign(v) * friction)
    scatter = np.random.default_rng(1).normal(0, noise, len(z)) if noise else 0.0
    return Run(z, v, force + scatter, np.full(len(z), pressure))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_window_takes_half_the_difference_of_both_directions(sign: float) -> None:
    """Thrust and zero drop out, the turns stay outside; a load cell counts push or pull as positive."""
    found = window_friction([_round_trip(2e-3, 1e5, 3.0, sign=sign), _round_trip(4e-3, 2e5, 2.5, sign=sign)], "m.csv")
    assert found.velocity == pytest.approx([2e-3, 4e-3])
    assert found.pressure == pytest.approx([1e5, 2e5])
    assert found.friction == pytest.approx([3.0, 2.5])


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_thrust_of_a_breathing_chamber_is_no_friction(sign: float) -> None:
    """A pressure that is lower on the way out adds to the difference of the forces; its thrust is taken off."""
    run = _round_trip(2e-3, 1e5, 3.0)
    pressure = run.pressure - 4e3 * np.sign(run.velocity)
    breathing = Run(run.position, run.velocity, sign * (run.force - 0.8 * np.sign(run.velocity)), pressure)
    assert window_friction([breathing], "m.csv").friction == pytest.approx([3.8])
    assert window_friction([breathing], "m.csv", piston_area=2e-4).friction == pytest.approx([3.0])
    assert window_friction([breathing], "m.csv", piston_area=2e-4).pressure == pytest.approx([1e5])


def test_runs_below_the_atmosphere_are_refused_and_a_sensors_zero_is_not() -> None:
    assert window_friction([_round_trip(2e-3, -900.0, 3.0)], "m.csv").pressure.tolist() == [0.0]
    with pytest.raises(IdentificationError, match=r"^m\.csv, run 1: the mean pressure must be 0 .*; got -0\.02 MPa"):
        window_friction([_round_trip(2e-3, -2e4, 3.0)], "m.csv")


def test_suction_in_a_table_is_refused_with_its_line() -> None:
    text = "velocity,pressure [MPa gauge],force\n1,0,2\n1,-0.1,2\n"
    with pytest.raises(IdentificationError) as caught:
        friction_points(parse_measurements(text, "m.csv", COLUMNS))
    assert str(caught.value) == (
        "m.csv, line 3: pressure must be 0 MPa gauge or above for the friction of a seal that pressure presses; "
        "got -0.1 MPa gauge."
    )


def test_runs_of_a_table_are_told_by_their_column() -> None:
    runs = [_round_trip(2e-3, 1e5, 3.0), _round_trip(4e-3, 2e5, 2.5)]
    text = "run,position,velocity,pressure,force\n" + "".join(
        f"{number},{z!r},{v!r},{P!r},{F!r}\n"
        for number, run in enumerate(runs, start=3)
        for z, v, P, F in zip(*(x.tolist() for x in (run.position, run.velocity, run.pressure, run.force)), strict=True)
    )
    found = friction_points(parse_measurements(text, "m.csv", COLUMNS, optional=RECORD_COLUMNS))
    assert found.friction == pytest.approx([3.0, 2.5])
    assert found.velocity == pytest.approx([2e-3, 4e-3])


def test_a_run_that_misses_the_window_is_named() -> None:
    with pytest.raises(IdentificationError) as caught:
        window_friction([_round_trip(2e-3, 1e5, 3.0)], "m.csv", window=(0.1e-3, 0.2e-3))
    assert str(caught.value) == (
        "m.csv, run 1: between 0.1 mm and 0.2 mm there must be 5 samples or more in each direction; got 0."
    )
