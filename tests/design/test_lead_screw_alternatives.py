"""A lead screw's dimensions by whichever of its alternatives: the same screw, and what a study holds."""

from pathlib import Path

import pytest

from fluxbore.design.errors import SpecError
from fluxbore.design.spec import Spec, load, loads
from fluxbore.design.spec_file import to_toml

EXAMPLE = load(Path(__file__).parents[2] / "examples" / "rotlin.toml")
TRANSLATOR, ROTOR = "actuator.translator.", "actuator.rotor."


def described(spec: Spec) -> dict[str, float]:
    return {key: float(value) for key, value in spec.values.items() if not isinstance(value, str)}


@pytest.mark.parametrize(
    "keys",
    [
        (ROTOR + "outer_radius", ROTOR + "frame_thickness"),
        (TRANSLATOR + "outer_radius", ROTOR + "frame_thickness"),
        (ROTOR + "overhang", TRANSLATOR + "carrier_thickness"),
        (ROTOR + "magnet_fill", TRANSLATOR + "magnet_width"),
    ],
)
def test_the_same_screw_by_other_keys(keys: tuple[str, ...]) -> None:
    """A dimension that follows by another formula than the one it is given by, or that its own key would refuse."""
    other = EXAMPLE.pinned(keys)
    assert set(keys) <= set(other.given)
    assert described(other) == pytest.approx(described(EXAMPLE), rel=1e-12, abs=1e-15)
    again = loads(to_toml(other))
    assert dict(again.given) == dict(other.given)


def test_a_rotor_of_one_size_leaves_the_translator_what_the_gap_leaves() -> None:
    other = EXAMPLE.pinned((ROTOR + "outer_radius", ROTOR + "frame_thickness"))
    wide = other.with_values({"actuator.gap": 1.0e-3, ROTOR + "magnet_thickness": 3e-3})
    assert wide.actuator.shape.frame_radius == EXAMPLE.actuator.shape.frame_radius
    assert wide.actuator.shape.translator_radius == pytest.approx(17.45e-3 - 0.7e-3, rel=1e-12)


def test_a_rotor_grows_with_its_iron_and_its_poles() -> None:
    other = EXAMPLE.pinned((ROTOR + "frame_thickness", ROTOR + "overhang", TRANSLATOR + "carrier_thickness"))
    grown = other.with_values(
        {ROTOR + "iron_thickness": 6e-3, TRANSLATOR + "iron_thickness": 4e-3, "actuator.poles": 6}
    )
    shape = grown.actuator.shape
    assert shape.frame_radius == pytest.approx(27.25e-3, rel=1e-12)
    assert shape.frame_length == pytest.approx(65e-3 + shape.pitch, rel=1e-12)
    assert grown.number(TRANSLATOR + "thickness") == pytest.approx(6.5e-3, rel=1e-12)


def test_magnets_keep_their_share_of_the_pitch() -> None:
    other = EXAMPLE.with_values({ROTOR + "magnet_fill": 0.8, "actuator.pitch": 8e-3})
    assert other.number(ROTOR + "magnet_width") == pytest.approx(3.2e-3, rel=1e-12)
    assert other.number(TRANSLATOR + "magnet_width") == pytest.approx(4e-3, rel=1e-12)


def test_a_translator_without_a_thickness_is_solid() -> None:
    given = {key: value for key, value in EXAMPLE.given.items() if key != TRANSLATOR + "thickness"}
    solid = Spec(EXAMPLE.kind, given, EXAMPLE.study, (), EXAMPLE.materials, {})
    assert solid.actuator.carrier_radius == 0.0
    assert solid.with_values({"actuator.gap": 1e-3}).actuator.carrier_radius == 0.0
    assert solid.number(TRANSLATOR + "carrier_thickness") == pytest.approx(17.45e-3 - 7.5e-3, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            {ROTOR + "frame_thickness": "1 mm"},
            "over-determined: give exactly two of actuator.translator.outer_radius, actuator.rotor.outer_radius, "
            "actuator.rotor.frame_thickness",
        ),
        ({ROTOR + "outer_radius": ""}, "under-determined: give exactly two of"),
        ({ROTOR + "overhang": "1 mm"}, "over-determined: give exactly one of actuator.rotor.length"),
        ({TRANSLATOR + "carrier_thickness": "0 mm"}, "give at most one of actuator.translator.thickness"),
        (
            {ROTOR + "magnet_fill": "0.9", ROTOR + "magnet_width": "2 mm"},
            "give at most one of actuator.rotor.magnet_width, actuator.rotor.magnet_fill (width = fill x l_p / 2)",
        ),
    ],
)
def test_too_many_or_too_few(change: dict[str, str], words: str) -> None:
    text = to_toml(EXAMPLE)
    with pytest.raises(SpecError) as error:
        loads(text, change)
    assert words in str(error.value)
