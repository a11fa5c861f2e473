"""How sections, places, currents and positions follow from keys: each state's own derivatives against differences."""

import numpy as np
import pytest
from short_motor import short_spec

from fluxbore.design.hybrid_values import positions
from fluxbore.design.spec import Spec
from fluxbore.geometry.cross_section import numbers
from fluxbore.geometry.hybrid import cross_section
from fluxbore.optimize.hybrid_field import Field, intrinsic_coercivity, peak_currents, ranges, solve_field, thrust_sign
from fluxbore.optimize.hybrid_jacobian import LIMITS, Jacobians
from fluxbore.optimize.partials import moved

Array = np.ndarray
KEYS = [
    "actuator.mover.pole_pitch",
    "actuator.mover.ring_width",
    "actuator.back_yoke.outer_diameter",
    "actuator.back_yoke.front_overhang",
    "actuator.cylinder.inner_diameter",
    "actuator.shaft.outer_diameter",
    "actuator.winding.turns",
    "actuator.mover.remanence",
    "actuator.mover.magnet_permeability",
    "operating_point.magnet_temperature",
    "operating_point.first_position",
    "operating_point.last_position",
    "operating_point.peak_current",
    "operating_point.speed",
]


@pytest.fixture(scope="module")
def spec() -> Spec:
    return short_spec()


@pytest.fixture(scope="module")
def field(spec: Spec) -> Field:
    return solve_field(spec)


@pytest.fixture(scope="module")
def jacobians(spec: Spec, field: Field) -> Jacobians:
    return Jacobians(spec, field, KEYS)


def state_at(spec: Spec, state: int) -> dict[str, Array]:
    """All of a state's continuous numbers for a specification; two positions, then the peak states at the second."""
    window = positions(spec.values)
    position = window[min(state, 1)]
    section = cross_section(spec.actuator, position, spec.materials, spec.number("operating_point.magnet_temperature"))
    places = ranges(spec.actuator, position)
    return {"numbers": numbers(section), **{name: np.array(getattr(places, name)[1]) for name in LIMITS}}


@pytest.mark.parametrize("state", [0, 1, 2, 3])
def test_each_states_sections(spec: Spec, jacobians: Jacobians, state: int) -> None:
    """Catches one section's derivatives taken for another's, and positions that do not move with the keys' window."""
    assert jacobians.keys == KEYS
    for place, key in enumerate(KEYS):
        step = 1e-4 * spec.number(key)
        after, before = (state_at(moved(spec, key, spec.number(key) + sign * step), state) for sign in (1, -1))
        for name, high in after.items():
            expected = (high - before[name]) / (2 * step)
            found = jacobians.numbers(state) if name == "numbers" else jacobians.limits(state, name)
            assert found[:, place] == pytest.approx(expected, rel=1e-6, abs=1e-7), (key, name)


def test_what_is_no_section(spec: Spec, field: Field, jacobians: Jacobians) -> None:
    """Catches currents of the wrong sign or angle; positions, pitch and coercivity by every key."""
    sign = thrust_sign(spec, field.middle)

    def rest(there: Spec) -> Array:
        window = positions(there.values)
        currents = [*peak_currents(there, window[1], sign), *peak_currents(there, window[1], -sign)]
        pitch = there.number("actuator.mover.pole_pitch")
        return np.array([*window, pitch, intrinsic_coercivity(there), *currents])

    found = np.vstack((jacobians.positions, jacobians.pitch, jacobians.coercivity, *jacobians.currents))
    for place, key in enumerate(KEYS):
        value = spec.number(key)
        expected = (rest(moved(spec, key, value * (1 + 1e-5))) - rest(moved(spec, key, value * (1 - 1e-5)))) / (
            2e-5 * value
        )
        assert found[:, place] == pytest.approx(expected, rel=1e-6, abs=1e-6), key


def test_the_middles_current_turns_with_its_position(jacobians: Jacobians) -> None:
    """Catches phases that stay while the window's last position, which is the middle one of two, moves."""
    last = jacobians.keys.index("operating_point.last_position")
    assert np.abs(jacobians.currents[0][:, last]).max() > 100  # A/m
    assert jacobians.currents[0] == pytest.approx(-jacobians.currents[1])


def test_a_key_without_a_neighbour_of_its_topology(field: Field) -> None:
    """Catches columns of a design that has no such derivative: a ring of nothing is no ring."""
    none = short_spec(mover__ring_width=0.0)
    found = Jacobians(none, solve_field(none), ["actuator.mover.ring_width", "actuator.mover.pole_pitch"])
    assert found.keys == ["actuator.mover.pole_pitch"]
    assert found.numbers(0).shape[1] == 1
    assert found.positions.shape == (len(field.window), 1)
