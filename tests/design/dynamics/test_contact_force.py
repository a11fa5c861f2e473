"""The whole benchmark on a field of a few numbers; on that of the finite elements it is in tests/full."""

import json

import numpy as np
import pytest
from mcfc_cases import MASS, example, straight_map

from fluxbore.design.dynamics.contact_force import COUNTED, FREQUENCIES, TARGETS, simulate, untuned_rmse
from fluxbore.design.dynamics.contact_force_run import CONDITIONS


def simulated(seed=1, traces=False, **changes):
    spec = example(**{"time_step": 1e-3, **changes})
    return simulate(spec.actuator, spec.values, straight_map(), seed, moving_mass=MASS, traces=traces)


@pytest.fixture(scope="module")
def found():
    return simulated(traces=True)


def errors(simulation):
    return np.array([trial.figures["rmse"] for trial in simulation.trials])


def test_without_a_plant_the_law_gives_the_papers_error():
    """3.13 N, from (6), Table IV and the inferred stroke."""
    spec = example()
    errors = untuned_rmse(spec.actuator, spec.values)
    assert len(errors) == 36
    assert np.median(list(errors.values())) == pytest.approx(3.13, abs=0.15)


def test_there_is_a_trial_for_every_condition_target_and_frequency(found):
    settings = [tuple(trial.setting[name] for name in ("condition", "target", "frequency")) for trial in found.trials]
    assert len(settings) == 144
    assert set(settings) == {(c, t, f) for c in CONDITIONS for t in TARGETS for f in FREQUENCIES}


def test_mean_speeds_are_the_papers(found):
    """0.6 to 8 mm/s; rounded corners take some of 2 f stroke."""
    speeds = [trial.figures["mean_speed"] for trial in found.trials]
    assert min(speeds) == pytest.approx(0.63e-3, rel=0.02)
    assert 6.8e-3 < max(speeds) < 2 * 3.6 * 1.05e-3


def test_medians_and_counts_are_those_of_the_counted_trials(found):
    cells = {
        (trial.setting["condition"], trial.setting["target"], trial.setting["frequency"]): trial.figures["rmse"]
        for trial in found.trials
    }
    for condition in CONDITIONS:
        counted = [cells[condition, target, frequency] for target in COUNTED for frequency in FREQUENCIES]
        assert found.figures["median_rmse"][condition] == pytest.approx(np.median(counted), abs=1e-15)
    places = [(target, frequency) for target in COUNTED for frequency in FREQUENCIES]
    assert found.figures["cells_P-P_below_P-N"] == sum(cells["P-P", *at] < cells["P-N", *at] for at in places)
    assert found.figures["cells_lowest_P-E"] == sum(
        cells["P-E", *at] < min(cells["P-N", *at], cells["P-P", *at]) for at in places
    )
    assert sum(found.figures["rank_sums"].values()) == 36 * 6


def test_figures_are_plain(found):
    assert json.loads(json.dumps(found.figures)) == found.figures
    assert found.figures["fin_deformed_length"] == pytest.approx(0.412e-3, abs=1e-6)


def test_traces_hold_the_runs_signals(found):
    for trial in found.trials:
        trace = trial.trace
        assert 1000 < len(trace.time) <= 2000
        assert {len(signal) for signal in trace.signals.values()} == {len(trace.time)}
        assert np.min(trace.signals["position"]) == pytest.approx(-1.05e-3, rel=0.05)
        if trial.setting["condition"] != "P-E":
            assert not np.any(trace.signals["current"])
    assert all(trial.trace is None for trial in simulated().trials)


def test_seeds_draw_for_themselves(found):
    again, other = errors(simulated()), errors(simulated(seed=2))
    assert np.array_equal(again, errors(found))
    assert not np.any(other == errors(found))
    assert np.max(np.abs(other - errors(found))) < 0.1


def test_noise_adds_in_quadrature():
    silent, noisy = errors(simulated(noise=0.0)), errors(simulated(noise=0.5))
    assert noisy == pytest.approx(np.sqrt(silent**2 + 0.25), abs=0.03)
