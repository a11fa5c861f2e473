"""The identification run in simulated time: the plant's own friction comes back."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.dynamics.contact_force_plant import ContactForcePlant
from fluxbore.design.dynamics.force_map import ForceMap
from fluxbore.design.dynamics.friction_run import friction_runs
from fluxbore.design.friction import seal_friction
from fluxbore.design.friction_identification import identify_friction
from fluxbore.design.friction_points import window_friction
from fluxbore.design.spec import load

TOP = Path(__file__).parents[3]
PRESSURES = (0.0, 0.3e6, 0.6e6)
FREQUENCIES = (0.5, 0.8, 1.4, 3.6)


@pytest.fixture(scope="module")
def plant() -> ContactForcePlant:
    spec = load(TOP / "examples" / "ipehla.toml")
    smooth = ForceMap(np.array([0.02, 0.04]), np.full(2, 8.0), np.zeros(2))
    return ContactForcePlant.from_values(spec.actuator, spec.values, smooth, 0.2, 20.5)


def test_the_window_gives_the_plants_friction(plant: ContactForcePlant) -> None:
    """At the runs' mean speeds and pressures, to 1 % of equation (6); and the fit to it, the plant's parameters."""
    runs = friction_runs(plant, 1, pressures=PRESSURES, frequencies=FREQUENCIES)
    points = window_friction(runs, "run", piston_area=plant.chamber.area)
    law, area = plant.seal.law, plant.seal.area
    assert points.friction == pytest.approx(seal_friction(law, area, points.pressure, points.velocity), rel=1e-2)
    ideal = np.repeat(2 * np.array(FREQUENCIES) * plant.stroke, len(PRESSURES))
    assert points.velocity == pytest.approx(ideal, rel=1e-2)
    assert points.pressure == pytest.approx(np.tile(PRESSURES, len(FREQUENCIES)), abs=1e3)
    found = identify_friction(points, area).parameters
    values = [found[name].value for name in ("static_coefficient", "coulomb_coefficient", "stribeck_speed")]
    assert values == pytest.approx([law.static_coefficient, law.coulomb_coefficient, law.stribeck_speed], rel=0.02)


def test_thrust_left_in_passes_for_friction_that_pressure_raises(plant: ContactForcePlant) -> None:
    """Without the piston's area a breathing chamber is taken for a seal that is pressed harder."""
    runs = friction_runs(replace(plant, noise=0.0), 1, pressures=PRESSURES, frequencies=(0.8,))
    left = window_friction(runs, "run").friction - window_friction(runs, "run", piston_area=plant.chamber.area).friction
    assert left[0] < left[1] < left[2]
    assert left[2] > 0.05


def test_positions_come_in_the_encoders_steps(plant: ContactForcePlant) -> None:
    run = friction_runs(plant, 1, pressures=(0.0,), frequencies=(3.6,))[0]
    counts = run.position / plant.estimate.resolution - 0.5
    assert counts == pytest.approx(np.round(counts), abs=1e-6)
    assert np.min(run.position) < -0.9 * plant.stroke


def test_a_seed_is_a_run_of_its_own(plant: ContactForcePlant) -> None:
    first, again, other = (
        friction_runs(plant, seed, pressures=(0.0,), frequencies=(3.6,))[0].force for seed in (1, 1, 2)
    )
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)
