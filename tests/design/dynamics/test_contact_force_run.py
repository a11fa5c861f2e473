"""One run of the benchmark against the same test stand stepped in small steps, and at limits that are known."""

import math

import numpy as np
import pytest
from mcfc_cases import plant, straight_map

from fluxbore.design.contact_force_keys import CONTACT_FORCE_KEYS
from fluxbore.design.dynamics.chamber import ATMOSPHERE
from fluxbore.design.dynamics.contact_force_run import CONDITIONS, air, drive, run
from fluxbore.design.dynamics.disturbance import followed
from fluxbore.design.errors import SpecError
from fluxbore.design.friction import seal_friction, sliding_level
from fluxbore.design.statistics import root_mean_square

FREQUENCY = 3.6
PERIODS = 600
"""Two round trips and a bit."""


def one(made, condition, target=40.0, frequency=FREQUENCY, seed=1):
    return run(made, drive(made, frequency), condition, target, np.random.default_rng(seed))


def stepped(made, condition, target, seed, fine=40):
    """The force (N) at each control period's end by explicit steps of 25 us: scalars, dead times as queues, counts and
    filter as a controller has them. The equations alone are shared."""
    period, area = made.estimate.period, made.chamber.area
    step, base = period / fine, target / area
    time = step * np.arange(PERIODS * fine + 1)
    motion = followed(made.load, time, made.stroke, FREQUENCY)
    random = np.random.default_rng(seed)
    phase = random.random()
    noise = made.noise * random.standard_normal(len(drive(made, FREQUENCY).read.time))
    wanted = [base] * round(made.valve_delay / step)
    asked = [0.0] * round(made.driver_delay / step)
    pressure, current, deflection, estimate, count = base, 0.0, 0.0, 0.0, math.floor(phase)
    forces = []
    for k in range(PERIODS * fine + 1):
        x, v = float(motion.position[k]), float(motion.velocity[k])
        if k % fine == 0:
            now = math.floor(x / made.estimate.resolution + phase)
            speed, count = (now - count) * made.estimate.resolution / period, now
            estimate += (speed - estimate) * (1 - math.exp(-period / made.estimate.time_constant))
            friction = float(seal_friction(made.law, made.seal.area, base, estimate))
            slip = made.seal.stiffness * deflection
            field = float(made.force_map.force(np.array(made.position + x), np.array(current)))
            mass = made.moving_mass * float(motion.acceleration[k])
            forces.append(area * pressure + field - slip - mass + noise[k // fine])
            valve = max(0.0, base + friction / area) if condition == "P-P" else base
            volts = friction / made.force_constant if condition == "P-E" else 0.0
        wanted.append(valve)
        asked.append(volts)
        level = float(sliding_level(made.seal.law, made.seal.area, pressure, v))
        deflection += step * (v - made.seal.stiffness * abs(v) / level * deflection)
        swept = area * v / (made.chamber.volume + area * x)
        pressure += step * (
            (wanted[k] - pressure) / made.chamber.time_constant
            - made.chamber.exponent * (pressure + ATMOSPHERE) * swept
        )
        current += step * (asked[k] - current) / made.driver_lag
    return np.array(forces)


@pytest.mark.parametrize("condition", CONDITIONS)
def test_a_run_is_what_small_steps_make_of_the_same_stand(condition):
    """Any sign, order or dead time that the cascade has otherwise would show in newtons."""
    made = plant(straight_map(8.0, slope=200.0, cogging=0.3), noise=0.1)
    found = one(made, condition).force[: PERIODS + 1]
    assert np.sqrt(np.mean((found - 40.0) ** 2)) > 1.0
    assert found == pytest.approx(stepped(made, condition, 40.0, 1), abs=0.15)
    assert np.sqrt(np.mean((found - stepped(made, condition, 40.0, 1)) ** 2)) < 0.02


@pytest.mark.parametrize("condition", CONDITIONS)
def test_errors_do_not_depend_on_the_step(condition):
    """To 0.01 N between 0.05 and 0.2 ms, and at the control period itself; all 144 are in tests/full."""

    def error(step):
        made = plant(time_step=step)
        return root_mean_square(one(made, condition, target=60.0).force[1:] - 60.0)

    found = [error(step) for step in (5e-5, 1e-4, 2e-4, 1e-3)]
    assert np.ptp(found) < 0.01


def test_stiff_bristles_leave_the_law():
    """P-N on a stand without lags: equation (6) with the sign of the way, at either end but for the corners."""
    made = plant(
        noise=0.0, bristle_stiffness=1e9, chamber_volume=1.0, load_frequency=1e4, moving_mass=0.0, time_step=1e-3
    )
    record = one(made, "P-N")
    speed = 2 * FREQUENCY * made.stroke
    level = float(sliding_level(made.law, made.seal.area, 40.0 / made.chamber.area, speed))
    sliding = np.abs(np.abs(record.velocity) - speed) < 1e-6
    assert sliding.mean() > 0.95
    error = record.force[sliding] - 40.0
    assert np.mean(np.abs(error + np.sign(record.velocity[sliding]) * level) < 0.01) > 0.95


def test_a_perfect_controller_leaves_nothing():
    """P-E without lags, counts or noise: the friction is made up for but at the corners."""
    made = plant(
        noise=0.0,
        bristle_stiffness=1e9,
        chamber_volume=1.0,
        load_frequency=1e4,
        moving_mass=0.0,
        velocity_filter=0.0,
        encoder_resolution=1e-12,
        driver_delay=0.0,
        driver_lag=0.0,
        control_period=1e-4,
    )
    error = one(made, "P-E").force - 40.0
    assert np.mean(np.abs(error) < 0.02) > 0.99


def test_the_valve_stops_at_the_atmosphere():
    """At no target the air could only pull."""
    record = one(plant(), "P-P", target=0.0)
    swept = air(plant(), drive(plant(), FREQUENCY), np.zeros(len(record.time) - 1), 0.0).pressure
    assert np.min(record.pressure - swept) > -1.0
    assert np.max(record.pressure - swept) > 1e3


def test_records_start_at_rest_and_last_ten_round_trips():
    record = one(plant(noise=0.0), "P-E", target=20.0)
    assert record.time[-1] == pytest.approx(10 / FREQUENCY, abs=1e-3)
    assert (record.position[0], record.velocity[0], record.current[0]) == (0.0, 0.0, 0.0)
    assert record.force[0] == pytest.approx(20.0, abs=1e-9)
    assert len({len(getattr(record, name)) for name in record.__slots__}) == 1


def test_a_still_chamber_may_be_handed_in():
    made = plant()
    driven = drive(made, FREQUENCY)
    base = made.target_pressure(40.0)
    still = air(made, driven, np.full(len(driven.read.time) - 1, base), base)
    for condition in CONDITIONS:
        first = run(made, driven, condition, 40.0, np.random.default_rng(5))
        again = run(made, driven, condition, 40.0, np.random.default_rng(5), still)
        assert np.array_equal(first.force, again.force)


def test_friction_scatters_from_run_to_run():
    """With its standard deviation, and by a draw behind the others, so that the noise stays as it was."""
    made = plant(friction_scatter=0.05, time_step=1e-3)
    driven = drive(made, FREQUENCY)
    sure = plant(time_step=1e-3)
    found = []
    for seed in range(60):
        record = run(made, driven, "P-N", 40.0, np.random.default_rng(seed))
        found.append(root_mean_square(record.friction))
    mean = root_mean_square(one(sure, "P-N").friction)
    assert np.mean(found) / mean == pytest.approx(1.0, abs=3 * 0.05 / 60**0.5)
    assert np.std(found) / mean == pytest.approx(0.05, rel=0.3)
    noise = [one(made, "P-N").force + one(made, "P-N").friction, one(sure, "P-N").force + one(sure, "P-N").friction]
    assert noise[0] == pytest.approx(noise[1], abs=1e-9)


NUMBERS = [key for key in CONTACT_FORCE_KEYS if key.kind != "word"]


@pytest.mark.parametrize("limit", ["least", "most"])
@pytest.mark.parametrize("key", NUMBERS, ids=lambda key: key.leaf)
def test_every_key_at_its_limits_gives_numbers_or_a_sentence(key, limit):
    """No overflow, no division by nothing."""
    least = key.minimum if key.minimum is not None else 1e-300 if key.above is not None else -1.0
    value = least if limit == "least" else key.maximum if key.maximum is not None else 1.0
    changes = {"time_step": 1e-3, "control_period": 1e-3, key.leaf: value}
    if key.leaf == "control_period" and limit == "least":
        changes["time_step"] = 1e-5
    try:
        made = plant(**changes)
    except SpecError as error:
        if key.name in str(error):
            return
        raise
    for condition in CONDITIONS:
        record = one(made, condition)
        for name in record.__slots__:
            assert np.all(np.isfinite(getattr(record, name))), name
