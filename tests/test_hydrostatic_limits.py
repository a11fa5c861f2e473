"""Electro-hydrostatic actuators with keys at their limits; `tests/full` tries every key by both routes."""

import random

import pytest
from hydrostatic_limits import cases, outcome

SEED, CLOSED, SIMULATED = 7, 30, 2


def test_the_cases_reach_every_number() -> None:
    """A key that is added later and that no case moves."""
    names = {name for name, _ in cases()}
    assert {"actuator.ball_screw.lead", "actuator.return_spring.cord_first", "operating_point.frequency"} <= names
    assert len(names) > 70


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("actuator.return_spring.rate", 1e12),  # losses too small to warm anything
        ("operating_point.temperature", 1e-6),  # a viscosity beyond any number
        ("actuator.hose.bore", 6.35e-6),  # pressures beyond any number's sense
        ("actuator.return_spring.rate", 1e-300),  # a way beyond any number
        ("actuator.hose.bore", 1e-14),
    ],
)
def test_limits_that_broke_it(name: str, value: float) -> None:
    outcome(name, value, "network")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("actuator.motor.torque_constant", 1e-300),  # a current whose square has no number
        ("actuator.drive.force_period", 1e-14),  # less than a step's rounding
    ],
)
def test_limits_that_broke_the_simulation(name: str, value: float) -> None:
    outcome(name, value, "fem")


def test_random_limits_have_figures_or_a_reason() -> None:
    """A traceback, a warning, or a figure that is no number, where one key stands at its limit."""
    drawn = random.Random(SEED).sample(list(cases()), CLOSED)
    found = [outcome(*case, "network")["network"] for case in drawn]
    assert found.count("ok") > CLOSED / 3
    for case in drawn[:SIMULATED]:
        outcome(*case, "fem")
