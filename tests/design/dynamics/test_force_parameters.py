"""The benchmark's parameters: all from the specification, the screw's from the design where nothing is given."""

import math
from dataclasses import fields

import pytest
from rotlin_stand import EXAMPLE, ROTLIN

from fluxbore.design.dynamics.force_parameters import OF_THE_SCREW, ForceParameters, force_parameters
from fluxbore.design.dynamics.force_stand import controller_of, stand_of
from fluxbore.design.errors import SpecError
from fluxbore.design.force_benchmark_keys import FORCE_BENCHMARK_KEYS, PREFIX
from fluxbore.design.spec import load

OF_THE_DESIGN = {"transfer_ratio", "torque_constant", "travel"}


def test_every_key_is_a_parameter_and_every_parameter_a_key():
    """Catches a key that a specification may give and nothing reads."""
    assert {field.name for field in fields(ForceParameters)} - OF_THE_DESIGN == {
        key.name.removeprefix(PREFIX) for key in FORCE_BENCHMARK_KEYS
    }


def test_what_the_paper_does_not_publish_has_a_reason_in_the_example():
    """Catches a value that slips in as if it had been published, and more than one number that is fitted."""
    spec = load(EXAMPLE)
    notes = {note.key.removeprefix(PREFIX): note for note in spec.notes if note.key.startswith(PREFIX)}
    assert [name for name, note in notes.items() if note.status == "calibrated"] == ["distortion"]
    unpublished = {"friction", "bristle_stiffness", "bristle_damping", "angle_count", "frequency", "duration"}
    waves = {"distortion", "second_order", "sixth_order", "translator_order", "translator_wave"}
    assert set(notes) == unpublished | waves | {"control_period", "lower_peak", "second_loop"}
    given = {key.removeprefix(PREFIX) for key in spec.given if key.startswith(PREFIX)}
    assert given == {key.name.removeprefix(PREFIX) for key in FORCE_BENCHMARK_KEYS}


def test_a_key_left_out_is_the_example_s():
    """Catches a stand without a section of its own that differs from the published and calibrated one."""
    values = load(EXAMPLE).values
    defaults = {key.name: key.default for key in FORCE_BENCHMARK_KEYS if key.default is not None}
    assert len(defaults) == len(FORCE_BENCHMARK_KEYS) - len(OF_THE_SCREW)
    assert {name: values[name] for name in defaults} == pytest.approx(defaults, rel=1e-12)


def test_the_screw_s_own_stand_in_for_what_is_not_given():
    """Catches the paper's stall force in another design's simulation."""
    spec = load(EXAMPLE)
    values = {key: value for key, value in spec.values.items() if key.removeprefix(PREFIX) not in OF_THE_SCREW}
    own = {"stall_force": 300.0, "spring_constant": 3e5, "mass": 3.0, "inertia": 1e-4, "angle_count": 1e-3}
    found = force_parameters(spec.actuator, values, own)
    assert {name: getattr(found, name) for name in OF_THE_SCREW} == own
    assert found.spring.law.stall_force == 300.0
    with pytest.raises(SpecError, match=r"^benchmark\.force\.stall_force is missing: the design itself has no such"):
        force_parameters(spec.actuator, values)


def test_the_published_transfer_ratio_is_the_pitchs():
    """8.19e-4 of Table II is the exact one rounded."""
    assert pytest.approx(8.19e-4, rel=1e-3) == ROTLIN.transfer_ratio
    assert pytest.approx(36e-3 / 7 / math.tau, rel=1e-12) == ROTLIN.transfer_ratio


def test_the_guides_never_gain_work():
    """Bristles are passive up to 4 F_C/sigma_1, which must lie above the speeds of the steps, 45 mm/s at 100 N."""
    guides = stand_of(ROTLIN).guides
    assert 4 * guides.level / guides.damping > 0.1
    friction = controller_of(ROTLIN).friction
    assert friction.level == pytest.approx(guides.level)
    assert guides.damping < 2 * math.sqrt(guides.stiffness * ROTLIN.mass)


@pytest.mark.parametrize("angle, position", [(0.0, 0.0), (1.3, 0.01), (-40.0, 0.07)])
def test_the_plants_of_both_simulations_are_distorted_alike(angle, position):
    """One line, written for records and for one sample at a time."""
    assert stand_of(ROTLIN).distortion(angle, position) == pytest.approx(
        float(ROTLIN.zero_force_line(angle, position)), abs=1e-18
    )
