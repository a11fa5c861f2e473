"""The tracking benchmark on a short stand: pairs in both readings, reasons, energies, and the friction identified."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from fluxbore.design.cylinder_friction import PUBLISHED
from fluxbore.design.dynamics.simulation import Simulation
from fluxbore.design.dynamics.tracking_benchmark import abilities, simulate
from fluxbore.design.dynamics.tracking_identification import friction_measurements, identification_speeds, identified
from fluxbore.design.dynamics.tracking_pair import run_pair
from fluxbore.design.dynamics.tracking_stand import Pair, TrackingStand, check_stand, reference_of
from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.prehydra_parameters import prehydra
from fluxbore.design.return_element import ConstantReturn

STAND = TrackingStand(
    pairs=tuple(
        Pair(amplitude, frequency, reading)
        for amplitude, frequency in ((300.0, 8.0), (40.0, 8.0))
        for reading in ("half", "peak-to-peak")
    ),
    main=(40.0, 8.0),
    offset=45.0,
    margin=50.0,
    ramp=0.15,
    duration=0.1,
    step=250e-6,
    highest_pressure=26e5,
    speeds=30,
    spacing="even",
    noise=2.0,
    slowest_speed=3e-3,
    fastest_speed=0.45,
)


@pytest.fixture(scope="module")
def actuator() -> HydrostaticActuator:
    return prehydra()


@pytest.fixture(scope="module")
def simulation(actuator: HydrostaticActuator) -> Simulation:
    return simulate(actuator, STAND, 1, traces=True)


def test_pairs_that_cannot_be_made_are_rows_with_their_reason(simulation: Simulation) -> None:
    """300 N needs 211 mm read as half the distance; the other reading's peak leaves the stroke, or not, by itself."""
    refused = {(row["amplitude"], row["reading"]): row["reason"] for row in simulation.figures["refused"]}
    assert "got 645 N (211 mm of travel)" in refused[300.0, "half"]
    assert all((row["amplitude"], row["reading"]) not in refused for row in simulation.figures["tracking"])
    pairs = [trial for trial in simulation.trials if trial.setting["run"] == "tracking"]
    assert len(pairs) == len(STAND.pairs)
    for trial in pairs:
        assert bool(trial.setting["reason"]) == math.isnan(trial.figures["max_error"])


def test_figures_are_those_of_the_trace(simulation: Simulation, actuator: HydrostaticActuator) -> None:
    """Catches errors of the ramp among those of the sinusoid, and a phase of another error than the largest."""
    trial = next(t for t in simulation.trials if t.setting.get("amplitude") == 40.0 and t.setting["reading"] == "half")
    assert trial.trace is not None
    time, error = trial.trace.time, trial.trace.signals["error"]
    np.testing.assert_allclose(error, trial.trace.signals["reference"] - trial.trace.signals["force"], atol=1e-9)
    sine = time >= STAND.ramp - 1e-9
    largest = np.argmax(np.abs(error[sine]))
    assert trial.figures["max_error"] == pytest.approx(abs(error[sine][largest]), rel=0.02)
    assert trial.figures["mean_absolute_error"] == pytest.approx(np.mean(np.abs(error[sine])), rel=0.05)
    turn = math.tau * 8.0 * (time[sine][largest] - STAND.ramp)
    assert trial.figures["phase"] == pytest.approx(turn % math.pi, abs=math.tau * 8 * 1.5e-3)
    assert trial.figures["extremum_error"] <= trial.figures["max_error"]
    position = actuator.return_element.force(0.0) + 2840.0 * trial.trace.signals["position"]
    np.testing.assert_allclose(position, trial.trace.signals["force"], rtol=1e-9)


def test_the_reading_that_counts_half_errs_more(simulation: Simulation) -> None:
    errors = simulation.figures["mean_absolute_error"]["40 N at 8 Hz"]
    assert errors["half"] > errors["peak-to-peak"] > 0


def test_energy_is_accounted_for(simulation: Simulation) -> None:
    assert 0 < simulation.figures["energy_imbalance"] < 1e-6
    energy = simulation.figures["energy"]
    for part in energy.values():
        assert part["entered"] == pytest.approx(part["left"] + part["stored"] + part["lost"], abs=1e-5)
    assert simulation.figures["energy_of"] == "40 N at 8 Hz, half"


def test_abilities_are_the_papers(actuator: HydrostaticActuator) -> None:
    """Equation (4), Table I at 0.45 m/s and 26 bar, and the shares of the force by all three readings."""
    found = abilities(actuator, STAND)
    assert found["force_frequency_limit"] == pytest.approx(213.0, abs=0.5)
    assert found["maximum_velocity"] == pytest.approx(0.47, abs=0.005)
    assert found["minimum_friction"] == pytest.approx(10.3, abs=0.1)
    assert found["friction_at_limit"] == pytest.approx(45.8, abs=0.3)
    assert found["force_at_rated_pressure"] == pytest.approx(1124.0, abs=1.0)
    assert found["stroke_force"] == pytest.approx(433.0, abs=0.5)
    assert found["efficiency"] == pytest.approx(0.87, abs=0.005)
    assert found["efficiency_both_cylinders"] == pytest.approx(0.77, abs=0.005)
    assert found["efficiency_by_difference"] == pytest.approx(0.85, abs=0.005)


def test_seeds_differ_in_the_friction_alone(actuator: HydrostaticActuator, simulation: Simulation) -> None:
    one, two = simulation, simulate(actuator, STAND, 2, traces=True)
    assert one.figures["tracking"] == two.figures["tracking"]
    assert one.figures["identified_friction"] != two.figures["identified_friction"]


def test_friction_is_found_exactly_without_noise() -> None:
    """To 1e-6 of each value, by either spacing."""
    for spacing in ("even", "geometric"):
        found = identified(PUBLISHED, replace(STAND, noise=1e-9, spacing=spacing), 1)["identified_friction"]
        for name, each in found.items():
            assert each["value"] == pytest.approx(getattr(PUBLISHED, name), rel=1e-6)


def test_expected_errors_are_such_as_table_i_has() -> None:
    """Within a factor of 1.5 at the plan that is assumed; geometric spacing tells c and F_S0 better."""
    found = identified(PUBLISHED, STAND, 1)
    table = {"preload": 0.91, "stribeck_force": 5.96, "stribeck_decay": 61.1, "viscous_coefficient": 3.56}
    even, geometric = found["expected_standard_error"], found["expected_standard_error_geometric"]
    for name, error in table.items():
        assert error / 1.5 <= even[name] <= error * 1.5
    assert geometric["stribeck_decay"] < 0.5 * even["stribeck_decay"]
    assert geometric["stribeck_force"] < 0.6 * even["stribeck_force"]


def test_data_that_tell_nothing_are_a_reason() -> None:
    """Five speeds with scatter: no figures of friction, and a sentence in their place."""
    stand = replace(STAND, speeds=5, noise=30.0, slowest_speed=0.2)
    found = identified(PUBLISHED, stand, 1)
    assert found["identified_friction"] == {}
    assert "does not identify" in found["identification_refused"] or "must" in found["identification_refused"]


def test_measurements_follow_the_seed() -> None:
    one, again, other = (friction_measurements(PUBLISHED, STAND, seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one.friction, again.friction)
    assert np.std(one.friction - other.friction) == pytest.approx(2.0 * math.sqrt(2), rel=0.5)
    assert identification_speeds(STAND, "geometric")[[0, -1]] == pytest.approx([3e-3, 0.45])


def test_stands_that_cannot_be_are_told(actuator: HydrostaticActuator) -> None:
    with pytest.raises(
        DesignError, match=r"tracking.step must be a whole share of .*force_period 0.001 s; got 0.0003 s"
    ):
        check_stand(actuator, replace(STAND, step=3e-4))
    with pytest.raises(DesignError, match=r"slowest_speed must be below .*fastest_speed 0.45 m/s; got 0.5 m/s"):
        check_stand(actuator, replace(STAND, slowest_speed=0.5))
    with pytest.raises(DesignError, match=r"no more than 2e\+06 steps of a run; got 8e\+06"):
        check_stand(actuator, replace(STAND, duration=2000.0))
    still = replace(actuator, return_element=ConstantReturn(100.0))
    with pytest.raises(DesignError, match=r"must keep benchmark.tracking.margin 50 N .* 100 N; got 645 N\.$"):
        reference_of(still, STAND, STAND.pairs[0])
    with pytest.raises(DesignError, match="margin"):
        simulate(still, STAND, 1)


def test_cavitation_is_a_reason(actuator: HydrostaticActuator) -> None:
    """A weak return element and a tight seal: the input piston pulls the column apart."""
    tight = replace(actuator.output_cylinder.friction, preload=80.0)
    dry = replace(actuator, output_cylinder=replace(actuator.output_cylinder, friction=tight))
    soft = replace(dry, return_element=replace(actuator.return_element, preload=0.0))
    stand = replace(STAND, offset=0.0, ramp=0.15, duration=0.2)
    run = run_pair(soft, stand, Pair(60.0, 3.0, "half"), traces=False)
    assert run.figures is None
    assert "vapour pressure" in run.reason
