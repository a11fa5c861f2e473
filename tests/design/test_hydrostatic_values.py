"""From a specification to an electro-hydrostatic actuator: what is missing, what follows, what is weighed as drawn."""

from dataclasses import replace
from pathlib import Path

import pytest

from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.hydrostatic_values import UNWEIGHED, HydrostaticDesign, from_values
from fluxbore.design.prehydra_parameters import prehydra
from fluxbore.design.return_element import ConstantReturn, CordReturn, LinearReturn
from fluxbore.design.seal_gland import check_gland
from fluxbore.design.spec import Spec, load, loads
from fluxbore.design.spec_file import template
from fluxbore.design.units import STANDARD_ATMOSPHERE

PREHYDRA = load(Path(__file__).parents[2] / "examples" / "prehydra.toml")
CORD = {
    "actuator.return_spring.element": "rubber cord",
    "actuator.return_spring.cord_length": 0.2,
    "actuator.return_spring.cord_area": 1e-4,
    "actuator.return_spring.cord_stretch": 1.2,
    "actuator.return_spring.cord_first": 2e5,
}


def without(*keys: str) -> Spec:
    return replace(PREHYDRA, given={key: value for key, value in PREHYDRA.given.items() if key not in keys})


def design(spec: Spec) -> HydrostaticDesign:
    found: HydrostaticDesign = spec.actuator
    return found


def test_the_example_is_the_papers_actuator() -> None:
    """Catches a slip of the example against the parameters in the program: all but names and masses as weighed."""
    one, other = design(PREHYDRA).bare, prehydra()
    assert one.motor.maximum_speed == other.motor.maximum_speed
    assert one.ball_screw == other.ball_screw
    assert one.hose == other.hose
    assert one.input_cylinder.friction == other.input_cylinder.friction
    for name in ("bore", "stroke", "dead_volume", "moving_mass", "rated_pressure"):
        assert getattr(one.output_cylinder, name) == pytest.approx(getattr(other.output_cylinder, name), rel=1e-3), name
        assert getattr(one.input_cylinder, name) == pytest.approx(getattr(other.input_cylinder, name), rel=1e-3), name
    assert one.return_element.force(0.1) == pytest.approx(other.return_element.force(0.1), rel=1e-12)
    assert one.fluid_volume == pytest.approx(56e-6, rel=0.02)  # "about 56 mL"


def test_a_gauge_pressure_is_above_the_atmosphere() -> None:
    """The fluid's vapour pressure is absolute inside: catches the atmosphere added twice or not at all."""
    assert design(PREHYDRA).bare.fluid.vapour_pressure == pytest.approx(-98_987 + STANDARD_ATMOSPHERE, rel=1e-12)


def test_masses_that_are_not_given_are_weighed() -> None:
    """Only those; catches a drawn mass that replaces a catalogue's."""
    found = design(PREHYDRA)
    assert found.unweighed == ("input_cylinder.mass", "output_cylinder.mass", "return_spring.mass")
    assert found.bare.output_cylinder.mass == UNWEIGHED
    weighed = found.weighed({"input_cylinder.mass": 0.1, "output_cylinder.mass": 0.2, "return_spring.mass": 0.3})
    assert weighed.input_cylinder.mass == 0.1
    assert weighed.output_cylinder.mass == 0.2
    assert isinstance(weighed.return_element, LinearReturn)
    assert weighed.return_element.mass == 0.3
    assert weighed.output_cylinder.moving_mass == 0.45


def test_given_masses_leave_nothing_to_weigh() -> None:
    given = dict.fromkeys(
        ("actuator.input_cylinder.mass", "actuator.output_cylinder.mass", "actuator.return_spring.mass"), 0.35
    )
    found = design(PREHYDRA.with_values(given))
    assert found.unweighed == ()
    assert found.weighed({}) == found.bare


def test_a_moving_mass_that_is_not_given_is_weighed() -> None:
    found = design(without("actuator.output_cylinder.moving_mass"))
    assert "output_cylinder.moving_mass" in found.unweighed
    masses = dict.fromkeys(found.unweighed, 0.2)
    assert found.weighed(masses).output_cylinder.moving_mass == 0.2


@pytest.mark.parametrize("bore", [8e-3, 10e-3, 14.3e-3])
def test_a_groove_that_is_not_given_follows_the_bore(bore: float) -> None:
    """By the handbook's rules at any bore of the study; catches a groove that stays while the bore moves."""
    gland = design(PREHYDRA.with_values({"actuator.output_cylinder.bore": bore})).gland
    assert gland.bore == bore
    check_gland(gland)


def test_a_groove_that_is_given_stays() -> None:
    groove = {
        "actuator.seal.ring_inner_diameter": 10.8e-3,
        "actuator.seal.groove_diameter": 11.2e-3,
        "actuator.seal.groove_width": 2.4e-3,
    }
    gland = design(PREHYDRA.with_values(groove)).gland
    assert (gland.ring_inner_diameter, gland.groove_diameter, gland.groove_width) == (10.8e-3, 11.2e-3, 2.4e-3)


def test_other_return_elements() -> None:
    """Each by its own data; the spring's rate does not count for them."""
    constant = design(PREHYDRA.with_values({"actuator.return_spring.element": "constant force"})).bare.return_element
    assert constant == ConstantReturn(45.0, UNWEIGHED)
    cord = design(PREHYDRA.with_values(CORD)).bare.return_element
    assert isinstance(cord, CordReturn)
    assert cord.force(0.1) == pytest.approx(2e-4 * (1.7 - 1.7**-2) * 2e5, rel=1e-12)


@pytest.mark.parametrize(
    ("spec", "key"),
    [
        (without("actuator.return_spring.rate"), "actuator.return_spring.rate"),
        (
            without("actuator.return_spring.rate").with_values({"actuator.return_spring.element": "rubber cord"}),
            "actuator.return_spring.cord_length",
        ),
        (PREHYDRA.with_values({"actuator.seal.groove_width": 2.4e-3}), "actuator.seal.ring_inner_diameter"),
    ],
)
def test_what_is_described_in_part_is_told(spec: Spec, key: str) -> None:
    with pytest.raises(SpecError, match=rf"^{key} is missing: .*\.$"):
        from_values(spec.values)


@pytest.mark.parametrize("key", ["actuator.hose.length", "actuator.motor.inertia", "actuator.fluid.viscosity"])
def test_a_component_without_its_datum_is_told(key: str) -> None:
    """Catches a datum that is silently taken by default."""
    section, leaf = key.rsplit(".", 1)
    text, part = template("prehydra").split(f"[{section}]", 1)
    lines = part.splitlines(keepends=True)
    at = next(i for i, line in enumerate(lines) if line.startswith(f"{leaf} ="))
    with pytest.raises(SpecError, match=rf"^{key} \([a-z ]+\) is missing"):
        loads(f"{text}[{section}]{''.join(lines[:at] + lines[at + 1 :])}")


def test_an_input_cylinder_that_is_too_small_is_told() -> None:
    with pytest.raises(DesignError, match=r"^actuator\.input_cylinder\.stroke must displace .*\.$"):
        design(PREHYDRA.with_values({"actuator.input_cylinder.bore": 10e-3}))


def test_a_rod_wider_than_its_bore_is_told() -> None:
    with pytest.raises(DesignError, match=r"^actuator\.output_cylinder\.rod_diameter must not exceed the bore"):
        design(PREHYDRA.with_values({"actuator.output_cylinder.rod_diameter": 15e-3}))
