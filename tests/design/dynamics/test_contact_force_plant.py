"""From the specification to the plant, and what it refuses."""

import pytest
from mcfc_cases import EXAMPLE, MASS, example, plant, straight_map

from fluxbore.design.contact_force_keys import CONTACT_FORCE_KEYS
from fluxbore.design.dynamics.contact_force_plant import ContactForcePlant, passed_positions, seal_law
from fluxbore.design.errors import SpecError
from fluxbore.design.spec import load


def refused(values=None, mass=MASS, force=20.5, force_map=None, **changes):
    spec = example(**changes)
    with pytest.raises(SpecError) as caught:
        ContactForcePlant.from_values(
            spec.actuator, {**spec.values, **(values or {})}, force_map or straight_map(), mass, force
        )
    return str(caught.value)


def test_every_unpublished_key_of_the_example_says_why():
    """A value without a note would pass for a published one."""
    spec = load(EXAMPLE)
    noted = {note.key for note in spec.notes}
    own = {"encoder_resolution", "time_step"}  # published; not of the test stand
    left_out = {"moving_mass", "force_constant"}  # computed of the design
    for key in CONTACT_FORCE_KEYS:
        assert key.name in noted or key.leaf in own | left_out, key.name
    assert {note.key for note in spec.notes if note.status == "calibrated"} >= {
        "benchmark.mcfc.valve_lag",
        "benchmark.mcfc.velocity_filter",
    }


def test_the_examples_values_are_the_keys_defaults():
    """A design of another file stands on the same test stand."""
    spec = load(EXAMPLE)
    for key in CONTACT_FORCE_KEYS:
        if not key.optional:
            assert spec.values[key.name] == key.default, key.name


def test_a_control_period_is_a_whole_number_of_steps_at_most_as_long():
    for step, count in ((1e-4, 10), (1e-3, 1), (0.3e-3, 4), (2e-4, 5)):
        made = plant(time_step=step)
        assert made.steps == count
        assert made.step <= step * (1 + 1e-9)


def test_the_controller_divides_by_the_mean_of_what_it_passes():
    """The slope beyond the way does not count; a force constant of its own does."""
    sloped = straight_map(8.0, slope=100.0)
    back, before = passed_positions(example().actuator, example().values)
    assert (back, before) == pytest.approx((26.45e-3, 27.5e-3))
    assert plant(sloped).force_constant == pytest.approx(8.0 + 100.0 * ((back + before) / 2 - 27e-3), abs=1e-3)
    assert plant(sloped, force_constant=7.5).force_constant == 7.5


def test_the_mass_and_the_contact_force_of_the_specification_come_before_the_designs():
    assert plant().moving_mass == MASS
    assert plant(moving_mass=0.3).moving_mass == 0.3
    values = dict(example().values)
    values["actuator.seal.contact_force"] = 25.0
    assert seal_law(values, 20.5).contact_force == 25.0
    del values["actuator.seal.contact_force"]
    assert seal_law(values, 20.5).contact_force == 20.5


def test_friction_that_differs_is_the_seals_alone():
    made = plant(friction_share=1.1)
    assert made.seal.law.coulomb_coefficient == pytest.approx(1.1 * made.law.coulomb_coefficient)
    assert made.seal.law.static_coefficient == pytest.approx(1.1 * made.law.static_coefficient)
    assert made.seal.law.contact_force == made.law.contact_force


def test_without_a_position_the_window_has_it():
    values = dict(example().values)
    del values["benchmark.mcfc.position"]
    assert passed_positions(example().actuator, values)[1] == pytest.approx(27.5e-3)


def test_no_mass_is_refused():
    assert refused(mass=None).startswith("benchmark.mcfc.moving_mass must be given")


def test_no_contact_force_is_refused():
    values = {"actuator.seal.contact_force": None}
    assert refused(values, force=None).startswith("actuator.seal.contact_force must be given")


def test_a_chamber_that_the_piston_would_sweep_is_refused():
    sentence = refused(chamber_volume=0.4e-6)
    assert sentence.startswith("benchmark.mcfc.chamber_volume must be at least")
    assert sentence.endswith("422.2 mm^3; got 400 mm^3.")


@pytest.mark.parametrize("position", [0.0005, 0.0885])
def test_a_way_beyond_the_stroke_is_refused(position):
    """The prototype's stroke is from 0 to 88 mm, and the disturbance takes 1.05 mm of it."""
    assert refused(position=position).startswith("benchmark.mcfc.position, and benchmark.mcfc.stroke behind it, must")


def test_a_motor_without_force_is_refused():
    assert refused(force_map=straight_map(0.0)).startswith("benchmark.mcfc.force_constant must be given")
