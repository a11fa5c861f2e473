"""Specifications of coils: what may be given, what follows, and what is refused in a sentence."""

import math
from pathlib import Path

import pytest

from fluxbore.design.coils_values import windings
from fluxbore.design.errors import DesignError, FluxboreError, SpecError
from fluxbore.design.spec import load, loads
from fluxbore.design.spec_file import template, to_toml

EXAMPLES = Path(__file__).parents[2] / "examples"
STORE = EXAMPLES / "team22.toml"

ONE = """
[actuator]
kind = "coils"
[actuator.coil_1]
inner_radius = "25 mm"
thickness = "50 mm"
half_height = "40 mm"
current_density = "10 A/mm^2"
"""


def test_the_published_numbers_become_the_windings():
    """Catches a full height read as half of one, a mean radius as an inner one, a lost sign."""
    inner, outer = load(STORE).actuator.coils
    assert (inner.inner_radius, inner.outer_radius) == (pytest.approx(1.865), pytest.approx(2.135))
    assert (inner.lower, inner.upper, inner.current_density) == (-0.8, 0.8, 22.5e6)
    assert (outer.inner_radius, outer.outer_radius) == (pytest.approx(2.875), pytest.approx(3.125))
    assert outer.current_density == -22.5e6


@pytest.mark.parametrize(
    "given",
    [
        {"inner_radius": "25 mm", "thickness": "50 mm"},
        {"radius": "50 mm", "thickness": "50 mm"},
        {"inner_radius": "25 mm", "radius": "50 mm"},
    ],
)
def test_any_two_radial_measures_give_the_third(given):
    """Catches a rule that halves the thickness on one way only."""
    changes = {"inner_radius": "", "thickness": ""} | given
    spec = loads(ONE, {f"actuator.coil_1.{key}": text for key, text in changes.items()})
    coil = spec.actuator.coils[0]
    assert coil.inner_radius == pytest.approx(0.025, rel=1e-15)
    assert coil.outer_radius == pytest.approx(0.075, rel=1e-15)
    assert spec.number("actuator.coil_1.radius") == pytest.approx(0.05, rel=1e-15)
    assert spec.number("actuator.coil_1.thickness") == pytest.approx(0.05, rel=1e-15)


def test_the_volume_is_that_of_the_ring():
    """Catches a lost pi, which mass and loss would carry on."""
    coil = loads(ONE).actuator.coils[0]
    assert coil.volume == pytest.approx(math.pi * (0.075**2 - 0.025**2) * 0.08, rel=1e-14)


def test_complex_values_pass_through():
    """Catches a float() on the way from values to windings, which would drop every derivative in silence."""
    spec = loads(ONE)
    moved = {**spec.given, "actuator.coil_1.thickness": 0.05 + 1e-30j}
    coil = windings(spec.kind.resolve(moved))[0]
    assert coil.inner_radius == 0.025
    assert coil.outer_radius.imag == pytest.approx(1e-30)


@pytest.mark.parametrize(
    "changes, sentence",
    [
        ({"coil_1.thickness": ""}, "The specification is under-determined: give exactly two of"),
        ({"coil_1.radius": "50 mm"}, "The specification is over-determined: give exactly two of"),
        ({"coil_1.current_density": ""}, "actuator.coil_1.current_density (current density in"),
        ({"coil_2.radius": "1 m"}, "The specification is under-determined: give exactly two of actuator.coil_2"),
        ({"coil_3.position": "1 m"}, "give exactly two of actuator.coil_3.radius"),
        ({"coil_1.half_height": "0 mm"}, "actuator.coil_1.half_height must exceed 0 mm; got 0 mm."),
        ({"coil_1.current_density": "10 A"}, "actuator.coil_1.current_density must be a current density"),
        ({"coil_5.radius": "1 m"}, "is not a key of this specification"),
    ],
)
def test_what_is_given_wrongly_is_named(changes, sentence):
    """Catches a traceback, or a sentence about another key."""
    with pytest.raises(FluxboreError) as caught:
        loads(ONE, {f"actuator.{key}": text for key, text in changes.items()})
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_second_winding_is_given_whole():
    changes = {"coil_2.radius": "1 m", "coil_2.thickness": "0.1 m", "coil_2.half_height": "0.1 m"}
    with pytest.raises(SpecError, match=r"^actuator\.coil_2\.current_density is missing: actuator\.coil_2 must be"):
        loads(ONE, {f"actuator.{key}": text for key, text in changes.items()})


@pytest.mark.parametrize("key", ["line_radius", "line_height", "critical_current_density", "critical_flux_density"])
def test_keys_that_belong_together_are_given_together(key):
    with pytest.raises(SpecError, match=r"must be given where operating_point\..* is; got none\.$"):
        load(STORE, {f"operating_point.{key}": ""})


@pytest.mark.parametrize(
    "changes, sentence",
    [
        ({"coil_2.radius": "2 m"}, "actuator.coil_2 must not overlap actuator.coil_1"),
        ({"coil_2.thickness": "7 m"}, "actuator.coil_2.thickness must leave a bore around the axis, at most 6000 mm"),
        ({"coil_2.half_height": "0.5 um"}, "actuator.coil_2.half_height must be at least 0.001 mm"),
        ({"coil_2.thickness": "", "coil_2.inner_radius": "3.1 m"}, "actuator.coil_2.radius must exceed"),
    ],
)
def test_coils_that_cannot_be_wound_are_refused(changes, sentence):
    """Catches an impossible design that a search would take for a very good one."""
    with pytest.raises(DesignError) as caught:
        _ = load(STORE, {f"actuator.{key}": text for key, text in changes.items()}).actuator
    assert sentence in str(caught.value)


def test_windings_above_one_another_may_share_their_radii():
    """Catches an overlap seen along one direction only."""
    changes = {"coil_2.radius": "2 m", "coil_2.position": "2 m"}
    assert len(load(STORE, {f"actuator.{key}": text for key, text in changes.items()}).actuator.coils) == 2


@pytest.mark.parametrize("part", ['hold = ["actuator.coil_3.radius"]', "sweep"])
def test_a_study_of_an_absent_winding_is_refused(part):
    """Catches a KeyError where a study names a winding that is not there."""
    study = part if part != "sweep" else 'sweeps = [{ axes = [{ key = "actuator.coil_3.radius", values = ["1 m"] }] }]'
    with pytest.raises(SpecError, match=r"actuator\.coil_3\.radius must have a value in the specification"):
        loads(f"{ONE}[study]\n{study}\n")


def test_the_template_is_the_example_and_survives_writing():
    """Catches a template that went stale, and a written design that reads back as another."""
    assert template("team22") == STORE.read_text(encoding="utf-8")
    spec = load(STORE)
    again = loads(to_toml(spec))
    assert again.values == spec.values
    assert again.study == spec.study
