"""A lead screw's keys and values: what follows from what, what is refused, and what the materials make of it."""

import math
from dataclasses import fields
from pathlib import Path

import pytest

from fluxbore.design.errors import FluxboreError
from fluxbore.design.lead_screw_keys import LEAD_SCREW_KEYS, LEAD_SCREW_MATERIALS, LEAD_SCREW_NON_MAGNETIC
from fluxbore.design.lead_screw_performance import LeadScrewFigures
from fluxbore.design.performance import FIGURES
from fluxbore.design.spec import Spec, load

ROTLIN = Path(__file__).parents[2] / "examples" / "rotlin.toml"
CELSIUS = 273.15


def rotlin(changes: dict[str, str] | None = None) -> Spec:
    """The example with keys as typed; an empty text takes one away."""
    return load(ROTLIN, changes)


def checked(changes: dict[str, str]) -> None:
    spec = rotlin(changes)
    assert spec.kind.check is not None
    spec.kind.check(spec.values)


def test_table_i() -> None:
    """The radii that the paper's table gives or implies."""
    shape = rotlin().actuator.shape
    assert shape.radii == pytest.approx((14.95e-3, 17.45e-3, 18.25e-3, 20.75e-3), rel=1e-12)
    assert shape.h == pytest.approx(8.19e-4, rel=1e-3)
    assert shape.active_length == pytest.approx(2 * 36e-3 / 7, rel=1e-12)
    assert rotlin().actuator.carrier_radius == pytest.approx(9.95e-3, rel=1e-12)


def test_what_is_left_out_follows() -> None:
    """Magnets that touch, a solid translator, a stroke of full engagement."""
    spec = rotlin({"actuator.translator.thickness": "", "operating_point.stroke": ""})
    assert spec.actuator.shape.rotor.magnet_width == pytest.approx(18e-3 / 7, rel=1e-12)
    assert spec.actuator.carrier_radius == 0.0
    assert spec.actuator.stroke == pytest.approx(85e-3 - 72e-3 / 7, rel=1e-12)


def test_materials_fill_the_screw() -> None:
    """A measured remanence with the grade's coefficient, the grade's own without one, densities of their own."""
    spec = rotlin({"actuator.rotor.remanence": "", "actuator.rotor.magnet_permeability": ""})
    grade = spec.materials["N42"]
    cold, hot = (spec.actuator.magnetised(spec.materials, CELSIUS + celsius) for celsius in (20.0, 70.0))
    assert cold.translator.remanence == pytest.approx(1.2164)
    assert cold.rotor.remanence == pytest.approx(grade.remanence)  # type: ignore[attr-defined]
    assert cold.rotor.magnet_permeability == grade.relative_permeability
    share = 1 + 50 * grade.remanence_coefficient  # type: ignore[attr-defined]
    assert hot.translator.remanence == pytest.approx(1.2164 * share)
    assert cold.frame_density == spec.materials["phenolic paper"].density
    assert cold.rotor.iron_density == spec.materials["1010"].density
    assert cold.translator.magnet_density == grade.density


def test_arcs_are_read() -> None:
    arcs = {"magnets": "stepped arcs", "arc_angle": "50 deg", "arcs_per_turn": "6"}
    found = rotlin({f"actuator.rotor.{leaf}": text for leaf, text in arcs.items()}).actuator.shape.rotor.arcs
    assert found.stepped
    assert found.fill == pytest.approx(300 / 360)
    assert found.angle == pytest.approx(math.radians(50))


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"actuator.rotor.magnets": "stepped arcs"}, "actuator.rotor.arc_angle is missing"),
        (
            {"actuator.rotor.magnets": "helical arcs", "actuator.rotor.arc_angle": "60 deg"},
            "actuator.rotor.arcs_per_turn is missing",
        ),
        ({"actuator.rotor.arcs_per_turn": "6"}, "actuator.rotor.arcs_per_turn must not be given"),
        ({"actuator.motor.length": ""}, "actuator.motor.length is missing: it is needed with"),
        ({"actuator.motor.outer_radius": "20 mm"}, "actuator.motor.outer_radius must not be below"),
        ({"actuator.translator.thickness": "7 mm"}, "actuator.translator.thickness must hold its magnets and iron"),
        ({"actuator.translator.thickness": "18 mm"}, "actuator.translator.thickness must not exceed"),
        ({"actuator.pitch": "0 mm"}, "actuator.pitch"),
        ({"actuator.rotor.magnet_width": "2.6 mm"}, "actuator.pitch must be at least two magnet widths"),
        ({"actuator.gap_tolerance": "0.8 mm"}, "actuator.gap must exceed actuator.gap_tolerance"),
        ({"actuator.rotor.magnet": "1010"}, "actuator.rotor.magnet must name a permanent magnet"),
        ({"actuator.translator.iron": "N42"}, "actuator.translator.iron must name a soft iron"),
        ({"actuator.translator.carrier": "1010"}, "actuator.translator.carrier"),
        ({"actuator.rotor.magnets": "rings"}, "actuator.rotor.magnets must be one of"),
        ({"actuator.poles": "0"}, "actuator.poles"),
    ],
)
def test_what_cannot_be_built_is_one_sentence(changes: dict[str, str], sentence: str) -> None:
    """Catches a slip that passes, or one that is told without its key."""
    with pytest.raises(FluxboreError) as refused:
        checked(changes)
    text = str(refused.value)
    assert sentence in text
    assert "\n" not in text


def test_arcs_that_overlap_are_refused() -> None:
    arcs = {"magnets": "helical arcs", "arc_angle": "61 deg", "arcs_per_turn": "6"}
    with pytest.raises(FluxboreError, match="the 6 arcs of a turn overlap; got 61 deg"):
        _ = rotlin({f"actuator.translator.{leaf}": text for leaf, text in arcs.items()}).actuator


def test_keys_and_materials_name_one_another() -> None:
    """Catches a material that is never looked up, and a doc or a unit that is missing."""
    keys = {key.name: key for key in LEAD_SCREW_KEYS}
    assert len(keys) == len(LEAD_SCREW_KEYS)
    words = {name for name, key in keys.items() if key.kind == "word" and not key.choices}
    assert set(LEAD_SCREW_MATERIALS) == words - {"actuator.name"}
    assert set(LEAD_SCREW_MATERIALS) >= LEAD_SCREW_NON_MAGNETIC
    assert all(key.doc for key in keys.values())


def test_figures_are_inherited_once() -> None:
    """Catches a figure of the screw that the results' table leaves out."""
    names = [item.name for item in fields(LeadScrewFigures)]
    assert set(names) <= set(FIGURES)
    assert all(FIGURES[name].si for name in names)
