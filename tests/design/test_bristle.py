"""The bristle model: exact steps, its limits, and its energy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from fluxbore.design.bristle import Bristle, advance, bristle_force, bristle_record
from fluxbore.design.errors import DesignError
from fluxbore.design.friction import SealFriction, seal_friction, sliding_level

TABLE_IV = SealFriction(0.182, 0.127, 20.5, 0.00132, 0.0)
AREA = 20.6e-6
BRISTLE = Bristle(TABLE_IV, AREA, 9.6e4)

steps = st.floats(1e-7, 10.0)
velocities = st.lists(st.floats(-0.02, 0.02), min_size=1, max_size=30)
pressures = st.floats(0.0, 0.6e6)


@given(velocity=st.floats(1e-5, 0.05), pressure=pressures, viscous=st.floats(0, 50), step=steps)
def test_steady_sliding_is_equation_6(velocity: float, pressure: float, viscous: float, step: float) -> None:
    """At any length of step, and to both sides."""
    law = SealFriction(0.182, 0.127, 20.5, 0.00132, viscous)
    bristle = Bristle(law, AREA, 9.6e4, 30.0)
    far = float(sliding_level(law, AREA, pressure, velocity)) / bristle.stiffness
    count = 2 + min(int(60 * far / (velocity * step)), 100_000)
    if count * step * velocity < 40 * far:
        return  # a step so short that the record would not reach it
    for signed in (velocity, -velocity):
        record = bristle_record(bristle, np.full(count, signed), np.full(count, pressure), step)
        expected = float(seal_friction(law, AREA, pressure, signed))
        assert record.force[-1] == pytest.approx(expected, rel=1e-9)
        assert bristle_force(bristle, record.deflection[-1], signed, pressure) == pytest.approx(expected, rel=1e-9)


@given(velocity=velocities, pressure=pressures, step=steps, start=st.floats(-1e-5, 1e-5))
def test_deflection_is_bounded_at_any_step(velocity: list[float], pressure: float, step: float, start: float) -> None:
    """What an explicit step would break as soon as a h exceeds two."""
    record = bristle_record(BRISTLE, np.array(velocity), np.full(len(velocity), pressure), step, start)
    bound = max(abs(start), float(sliding_level(TABLE_IV, AREA, pressure, 0.0)) / BRISTLE.stiffness)
    assert np.max(np.abs(record.deflection)) <= bound * (1 + 1e-12)
    assert np.max(np.abs(record.force)) <= BRISTLE.stiffness * bound * (1 + 1e-12)


@given(velocity=velocities, step=st.floats(1e-6, 0.1), data=st.data())
def test_work_is_stored_or_lost_and_never_made(velocity: list[float], step: float, data: st.DataObject) -> None:
    """Over every stretch of a record of changing pressure: work done on the contact >= gain of sigma_0 z^2/2."""
    pressure = data.draw(st.lists(pressures, min_size=len(velocity), max_size=len(velocity)))
    damped = Bristle(TABLE_IV, AREA, 9.6e4, 4 * 0.127 * 20.5 / 0.02)
    for bristle in (BRISTLE, damped):
        v = np.array(velocity)
        record = bristle_record(bristle, v, np.array(pressure), step)
        work = record.force * v * step
        stored = np.diff(bristle.stiffness * record.deflection**2 / 2)
        assert np.all(work - stored >= -1e-12 * (np.abs(work) + np.abs(stored)) - 1e-18)


def _lugre(t: float, z: NDArray[np.float64], v: float, pressure: float) -> NDArray[np.float64]:
    level = (0.127 + (0.182 - 0.127) * np.exp(-((v / 0.00132) ** 2))) * (AREA * pressure + 20.5)
    return np.asarray(v - 9.6e4 * abs(v) / level * z)


@pytest.mark.parametrize("velocity", [3e-3, -3e-3, 1e-4, 0.0])
def test_one_long_step_is_the_differential_equation_s(velocity: float) -> None:
    """An independent solver over the same step: deflection at its end, and the mean force."""
    step, start, pressure = 0.01, 1.5e-5, 0.3e6
    bristle = Bristle(TABLE_IV, AREA, 9.6e4, 12.0)
    found = solve_ivp(
        lambda t, y: [_lugre(t, y[0], velocity, pressure), y[0]],
        (0.0, step),
        [start, 0.0],
        rtol=1e-11,
        atol=1e-18,
        method="DOP853",
    )
    after, force = advance(bristle, start, velocity, pressure, step)
    end, integral = found.y[:, -1]
    assert float(after) == pytest.approx(end, rel=1e-8)
    assert float(force) == pytest.approx(9.6e4 * integral / step + 12.0 * (end - start) / step, rel=1e-8)


def test_before_it_slides_it_is_a_spring() -> None:
    """Stiffness sigma_0 about rest, and no creep while at rest."""
    way = 1e-9
    record = bristle_record(BRISTLE, np.array([way / 1e-3, 0.0, 0.0]), np.zeros(3), 1e-3)
    assert 9.6e4 * record.deflection[1] / way == pytest.approx(9.6e4, rel=1e-3)
    assert record.deflection[1:].tolist() == [record.deflection[1]] * 3
    assert record.force[1:] == pytest.approx(9.6e4 * record.deflection[1])


def test_the_record_is_its_steps_one_by_one() -> None:
    """For several runs at once, whose pressures differ and whose velocity is one."""
    random = np.random.default_rng(5)
    v = random.normal(scale=4e-3, size=(40, 1))
    v[7] = 0.0
    pressure = random.uniform(0, 0.6e6, (40, 3))
    bristle = Bristle(TABLE_IV, AREA, 9.6e4, 20.0)
    record = bristle_record(bristle, v, pressure, 1e-3)
    z = np.zeros(3)
    for k in range(40):
        z, force = advance(bristle, z, v[k], pressure[k], 1e-3)
        assert record.deflection[k + 1] == pytest.approx(z, rel=1e-12, abs=1e-18)
        assert record.force[k] == pytest.approx(force, rel=1e-9, abs=1e-12)


def test_halving_the_step_quarters_the_error() -> None:
    """Of a smooth motion that each step holds at its mid value: second order, at a step where a h is near one."""

    def force(count: int) -> float:
        step = 0.2 / count
        middle = (np.arange(count) + 0.5) * step
        velocity = 8e-3 * np.sin(2 * np.pi * 2 * middle)
        pressure = 0.3e6 * (1 + np.cos(2 * np.pi * 2 * middle)) / 2
        return float(bristle_record(BRISTLE, velocity, pressure, step).deflection[-1]) * BRISTLE.stiffness

    best = force(409_600)
    errors = [abs(force(count) - best) for count in (800, 1600, 3200, 6400)]
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(slopes > 1.8), (errors, slopes)


def test_contact_that_nothing_presses_has_no_friction() -> None:
    loose = Bristle(SealFriction(0.182, 0.127, 0.0, 0.00132, 2.0), AREA, 9.6e4)
    record = bristle_record(loose, np.array([0.01, -0.01, 0.0]), np.array([0.0, -1e5, 0.0]), 1e-4)
    assert record.force == pytest.approx([0.02, -0.02, 0.0], abs=1e-9)


@pytest.mark.parametrize(("stiffness", "damping"), [(0.0, 0.0), (-1.0, 0.0), (float("nan"), 0.0), (1e5, -1.0)])
def test_bristles_that_cannot_be(stiffness: float, damping: float) -> None:
    with pytest.raises(DesignError, match=r"^The (stiffness|damping) of bristles must be finite and .*; got .*\.$"):
        Bristle(TABLE_IV, AREA, stiffness, damping)
