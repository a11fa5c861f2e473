"""Ripple of arcs: against patterns sampled around the axis and finite elements along the radius."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from lead_screws import ARCS, PITCH, table_i
from numpy.typing import NDArray
from radial_elements import RadialElements

from fluxbore.design.helical_field import ROTOR, TRANSLATOR, force_series, stack
from fluxbore.design.lead_screw import Arcs, LeadScrew
from fluxbore.design.step_ripple import force_ripple, stepped_series

PLAIN = table_i()
SAMPLES = 3600  # around the axis


def with_arcs(translator: Arcs | None, rotor: Arcs | None) -> LeadScrew:
    return replace(PLAIN, translator=replace(PLAIN.translator, arcs=translator), rotor=replace(PLAIN.rotor, arcs=rotor))


STEPPED = with_arcs(ARCS, ARCS)


def sampled(arcs: Arcs | None, n: int) -> NDArray[np.complex128]:
    """exp(-i n theta_s) around the axis, theta_s the middle of the arc that covers theta; zero between arcs."""
    theta = (np.arange(SAMPLES) + 0.5) / SAMPLES * 2 * np.pi
    if arcs is None:
        return np.asarray(np.exp(-1j * n * theta))
    middle = np.round(theta * arcs.per_turn / (2 * np.pi)) * 2 * np.pi / arcs.per_turn
    covered = np.abs(theta - middle) <= arcs.angle / 2
    return np.asarray(np.exp(-1j * n * (middle if arcs.stepped else theta)) * covered)


@cache
def passed_on(n: int, order: int) -> float:
    return RadialElements(stack(PLAIN), 2 * np.pi * n / PITCH, order, 40).interaction(TRANSLATOR, ROTOR)


def coenergy(screw: LeadScrew, x: float, turned: int) -> float:
    """W' of the first two harmonics and of orders up to 150: the rotor moved by x (m) and turned by so many samples."""
    found = 0.0
    for n in (1, 3):
        b = 4 / (np.pi * n)
        fixed = np.fft.fft(sampled(screw.translator.arcs, n)) / SAMPLES
        moving = np.fft.fft(np.roll(sampled(screw.rotor.arcs, n), turned)) / SAMPLES
        for m in range(-150, 151):
            if abs(fixed[m] * moving[m]) < 1e-9:
                continue
            both = fixed[m] * np.conj(moving[m]) * np.exp(2j * np.pi * n / PITCH * x)
            found += np.pi * screw.active_length * b**2 * both.real * passed_on(n, abs(m))
    return found


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (ARCS, ARCS),
        (ARCS, Arcs(np.radians(100), 3, stepped=True)),
        (Arcs(np.radians(50), 6, stepped=False), ARCS),
        (None, ARCS),
    ],
)
def test_force_and_torque_are_slopes_of_the_sampled_coenergy(first: Arcs | None, second: Arcs | None) -> None:
    """Steps and spaces as they are, without any Fourier coefficient in closed form."""
    screw = with_arcs(first, second)
    series = stepped_series(screw)
    scale = float(np.sum(np.abs(series.coenergy * series.wave)))
    for x, turned in ((0.4e-3, 0), (0.4e-3, 97), (-1.1e-3, 350)):
        theta = turned * 2 * np.pi / SAMPLES
        displacement = screw.h * theta - x
        step, angle = 1e-7, 2 * np.pi / SAMPLES
        # F_s pulls the mover along +x, and T_s the rotor back.
        force = (coenergy(screw, x + step, turned) - coenergy(screw, x - step, turned)) / (2 * step)
        torque = -(coenergy(screw, x, turned + 1) - coenergy(screw, x, turned - 1)) / (2 * angle)
        assert float(series.force(displacement, theta)) == pytest.approx(force, abs=4e-3 * scale)
        assert float(series.torque(displacement, theta)) == pytest.approx(torque, abs=4e-3 * scale * screw.h)


def test_mean_over_a_turn_is_the_plain_series() -> None:
    angles = np.linspace(0, 2 * np.pi, 1000, endpoint=False)
    x = np.array([0.2e-3, 1.0e-3, PITCH / 4])
    series = stepped_series(STEPPED)
    force = np.mean(series.force(x[:, None], angles), axis=1)
    assert force == pytest.approx(force_series(STEPPED).force(x), rel=1e-9)
    assert np.mean(series.torque(x[:, None], angles), axis=1) == pytest.approx(STEPPED.h * force, rel=1e-9)


def test_one_member_of_whole_helices_takes_the_ripple_away() -> None:
    """And so do arcs that follow the helix without spaces."""
    assert force_ripple(with_arcs(ARCS, None), 1e-3) == 0.0
    assert force_ripple(with_arcs(None, ARCS), 1e-3) == 0.0
    closed = replace(ARCS, stepped=False)
    assert force_ripple(with_arcs(closed, ARCS), 1e-3) == pytest.approx(0.0, abs=1e-9)


def test_ripple_of_sixty_degrees() -> None:
    """Six periods a turn, both members alike; with coprime numbers of arcs much less is left."""
    at_stall = force_ripple(STEPPED, PITCH / 4)
    stall = force_series(STEPPED).peak[1]
    assert 0.02 < at_stall / stall < 0.2
    fifth = replace(ARCS, angle=2 * np.pi / 5, per_turn=5)
    assert force_ripple(with_arcs(ARCS, fifth), PITCH / 4) < 0.1 * at_stall
    series = stepped_series(STEPPED)
    angles = np.linspace(0, 2 * np.pi, 50)
    assert series.force(1e-3, angles + np.pi / 3) == pytest.approx(series.force(1e-3, angles), abs=1e-9)


def test_work_of_a_turn_is_nought() -> None:
    """Ripple stores and gives back: over a turn at a fixed mover, the rotor passing one pitch, no work is left."""
    theta = np.linspace(0, 2 * np.pi, 4000, endpoint=False)
    series = stepped_series(STEPPED)
    torque = series.torque(STEPPED.h * theta - 0.3e-3, theta)
    assert abs(float(np.mean(torque))) < 1e-9 * float(np.max(np.abs(torque)))
