"""The key of a simulation in the journal: whatever decides on its result changes it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.contact_force_keys import CONTACT_FORCE_KEYS
from fluxbore.design.dynamics.force_map import ForceMap
from fluxbore.design.spec import load
from fluxbore.optimize.hybrid_contact_force import MCFC, Surroundings
from fluxbore.optimize.partials import moved
from fluxbore.optimize.simulation_record import simulation_key

SPEC = load(Path(__file__).parents[2] / "examples" / "ipehla.toml")

POSITIONS = np.linspace(26.45e-3, 27.5e-3, 2000)
"""m; more than an array's repr shows."""

AROUND = Surroundings(ForceMap(POSITIONS, np.full(2000, 8.68), np.zeros(2000)), 0.2, 20.5)

KEY = simulation_key(MCFC, SPEC, "fem", AROUND, 1)


@pytest.mark.parametrize("name", [key.name for key in CONTACT_FORCE_KEYS])
def test_a_changed_test_stand_is_simulated_anew(name: str) -> None:
    """Catches a journal that answers for another valve or filter."""
    value = SPEC.values.get(name, 1.0)
    assert isinstance(value, float)
    assert simulation_key(MCFC, moved(SPEC, name, value * 1.0001 + 1e-9), "fem", AROUND, 1) != KEY


def test_another_design_field_seed_or_route_is_simulated_anew() -> None:
    inside = AROUND.force_map.force_constant.copy()
    inside[1000] += 1e-9
    for key in (
        simulation_key(MCFC, SPEC.with_values({"actuator.mover.ring_width": 1.4e-3}), "fem", AROUND, 1),
        simulation_key(MCFC, SPEC.with_values({"actuator.piston.fin_length": 1.9e-3}), "fem", AROUND, 1),
        simulation_key(MCFC, SPEC, "network", AROUND, 1),
        simulation_key(MCFC, SPEC, "fem", AROUND, 2),
        simulation_key(MCFC, SPEC, "fem", replace(AROUND, moving_mass=0.21), 1),
        simulation_key(MCFC, SPEC, "fem", replace(AROUND, contact_force=17.3), 1),
        simulation_key(
            MCFC, SPEC, "fem", replace(AROUND, force_map=replace(AROUND.force_map, force_constant=inside)), 1
        ),
    ):
        assert key != KEY
    assert simulation_key(MCFC, SPEC.with_values({}), "fem", AROUND, 1) == KEY
