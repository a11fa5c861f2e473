"""Tracking of the PREHydrA's pairs: what the paper's model gives, what cannot be run, what each assumption moves."""

import math

import pytest

from fluxbore.design.dynamics.force_reference import HALF, READINGS, WHOLE
from fluxbore.design.dynamics.force_tracking import (
    PAIRS,
    Pair,
    Tracking,
    prehydra_variations,
    sensitivities,
    track,
    track_all,
    varied,
)
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.prehydra_parameters import prehydra


@pytest.fixture(scope="module")
def actuator() -> HydrostaticActuator:
    return prehydra()


@pytest.fixture(scope="module")
def found(actuator: HydrostaticActuator) -> Tracking:
    """50 N at 4 Hz, at twice the step and half a second of cosine: 0.5 % of the figures of the whole."""
    return track(actuator, PAIRS[3], HALF, time=0.5, step=250e-6)


def test_fifty_newtons_at_four_hertz(found: Tracking) -> None:
    """The paper's model: 6.44 N less about 4 N at most, Fig. 7; no number was tuned to it."""
    assert found.failure == ""
    assert found.max_error == pytest.approx(2.4, abs=1.0)
    assert found.mean_absolute_error is not None
    assert found.mean_absolute_error <= 2.0
    assert found.energy_imbalance is not None
    assert found.energy_imbalance < 1e-6


def test_the_largest_error_is_not_where_the_pistons_turn(found: Tracking) -> None:
    """Unlike the paper's: viscous friction at 0.45 m/s is more than the seal's at rest."""
    assert found.phase is not None
    assert 60 < found.phase < 150


def test_more_than_the_stroke_is_a_row_with_its_reason(actuator: HydrostaticActuator) -> None:
    row = track(actuator, Pair(300.0, 0.5), HALF)
    assert "must not exceed the return element's force" in row.failure
    assert row.max_error is None


def test_every_variation_changes_its_own_number(actuator: HydrostaticActuator) -> None:
    """And nothing else: undone, it is the actuator again."""
    for each in prehydra_variations(actuator):
        assert varied(actuator, each.path, each.low) != varied(actuator, each.path, each.high) != actuator
    stiff = varied(actuator, "hose.wall_modulus", 1e9)
    assert stiff.hose.wall_modulus == 1e9
    assert varied(stiff, "hose.wall_modulus", math.inf) == actuator
    assert varied(actuator, "orifices", 4.5e-3) == actuator
    rough = varied(actuator, "friction", 1.1)
    assert rough.input_cylinder.friction.preload == pytest.approx(1.1 * 8.1)
    assert rough.output_cylinder.friction.stribeck_decay == 118.5


@pytest.mark.full
def test_all_pairs_by_both_readings(actuator: HydrostaticActuator) -> None:
    """Mean errors below 3.7 N from 0.1 to 10 Hz, the least at the lowest frequency, 23.5 to 26 bar at 300 N; 300 N as
    half an amplitude is beyond the stroke."""
    rows = {(row.pair.amplitude, row.pair.frequency, row.reading): row for row in track_all(actuator)}
    assert len(rows) == len(PAIRS) * len(READINGS)
    refused = [key for key, row in rows.items() if row.failure]
    assert refused == [(300.0, 0.1, HALF), (300.0, 0.5, HALF)]
    errors = {key: row.mean_absolute_error for key, row in rows.items() if row.mean_absolute_error is not None}
    assert all(error < 3.7 for error in errors.values()), errors
    assert min(errors, key=lambda key: errors[key]) == (300.0, 0.1, WHOLE)
    for frequency in (0.1, 0.5):
        peak = rows[300.0, frequency, WHOLE].peak_pressure
        assert peak is not None
        assert 23.5e5 <= peak <= 26e5
    assert all(row.energy_imbalance < 1e-6 for row in rows.values() if row.energy_imbalance is not None)


@pytest.mark.full
def test_halving_the_step_changes_figures_by_less_than_a_hundredth(actuator: HydrostaticActuator) -> None:
    coarse, fine = (track(actuator, PAIRS[3], HALF, step=step) for step in (125e-6, 62.5e-6))
    assert coarse.max_error == pytest.approx(fine.max_error, rel=0.01)
    assert coarse.mean_absolute_error == pytest.approx(fine.mean_absolute_error, rel=0.01)
    assert coarse.peak_pressure == pytest.approx(fine.peak_pressure, rel=0.01)


@pytest.mark.full
def test_delay_and_air_drive_the_error(actuator: HydrostaticActuator) -> None:
    """More of either, more error; the width of the linear piece of friction moves it by less than 0.01 N."""
    by_path = {each.path: each for each in prehydra_variations(actuator)}
    picked = [by_path[path] for path in ("drive.delay", "fluid.air_fraction", "linear_speed")]
    delay, air, linear = sensitivities(actuator, picked)
    for each in (delay, air):
        assert each.low.max_error is not None
        assert each.high.max_error is not None
        assert each.low.max_error < each.high.max_error
    assert linear.low.max_error == pytest.approx(linear.high.max_error, abs=0.05)
