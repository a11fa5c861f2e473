"""Reading a specification: files, overrides, notes, and designs that are the same specification with other values."""

from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest

from fluxbore.design.errors import DesignError, MaterialError, SpecError
from fluxbore.design.hybrid_values import positions
from fluxbore.design.spec import DEEPEST, LARGEST_FILE, Spec, load, loads
from fluxbore.design.spec_file import template

TEXT = template("ipehla")
RING, YOKE = "actuator.mover.ring_width", "actuator.back_yoke.thickness"
TURNS, DENSITY = "actuator.winding.turns", "actuator.winding.turns_density"
D_W, CLEARANCE = "actuator.winding.outer_diameter", "actuator.winding.yoke_clearance"


@pytest.fixture(scope="module")
def spec() -> Spec:
    return loads(TEXT)


def refused(text: str, overrides: dict[str, str] | None = None, kind=SpecError) -> str:
    with pytest.raises(kind) as caught:
        loads(text, overrides)
    return str(caught.value)


def test_values_are_si_and_every_key_has_one(spec):
    assert spec.number("actuator.back_yoke.outer_diameter") == 0.027
    assert spec.number("operating_point.pressure") == 600_000.0
    assert spec.number("operating_point.winding_temperature") == 293.15
    assert spec.word("actuator.name") == "iPEHLA"
    computed = {"benchmark.mcfc.moving_mass", "benchmark.mcfc.force_constant"}  # of the design where not given
    computed.add("actuator.mover.longest_magnet")  # any length where not given
    computed |= {f"drawing.{name}" for name in ("part_number", "number", "author", "approver", "organisation")}
    assert {key.name for key in spec.kind.keys} - computed == set(spec.values)
    with pytest.raises(FrozenInstanceError):
        spec.given = {}


def test_what_is_assumed_is_noted_with_its_reason(spec):
    notes = {note.key: note for note in spec.notes}
    assert notes["actuator.mover.magnet_permeability"].status == "assumed"
    assert "sintered" in notes["actuator.mover.magnet_permeability"].reason
    assert "actuator.mover.remanence" not in notes


def test_positions_of_the_window(spec):
    assert positions(spec.values) == pytest.approx([z * 1e-3 for z in range(24, 32)])
    assert positions(loads(TEXT, {"operating_point.positions": "1"}).values) == pytest.approx((0.0275,))
    assert positions(loads(TEXT, {"operating_point.positions": "2"}).values) == pytest.approx((0.024, 0.031))


@pytest.mark.parametrize("content", [TEXT, "\ufeff" + TEXT, TEXT.replace("\n", "\r\n")], ids=["plain", "BOM", "CRLF"])
def test_what_editors_on_windows_write_is_read(content, tmp_path, spec):
    path = tmp_path / "a spec.toml"
    path.write_bytes(content.encode())
    assert load(path).fingerprint() == spec.fingerprint()


@pytest.mark.parametrize(
    "content, sentence",
    [
        (b"", 'must hold actuator.kind, one of "hybrid", "coils", "lead-screw", "hydrostatic"; got none.'),
        (b"\xff\xfe\x00", "must be a UTF-8 text; byte 0 is not."),
        (b"hello world", "is not valid TOML: Expected '=' after a key"),
        (b"a = " + b"[" * 3000 + b"]" * 3000, f"must be nested at most {DEEPEST} levels deep; it is deeper."),
        (b"a" + b".a" * 3000 + b" = 1", f"must be nested at most {DEEPEST} levels deep; it is deeper."),
        (b"a = " + b"9" * 5000, "a number in it has too many digits."),
        (b"a = " + b"9" * 50, "must hold whole numbers of at most 64 bits; got one of 50 digits."),
        (b'a = "\\u0000"', "must hold text without null characters"),
        (b"#" * (LARGEST_FILE + 1), f"must be a specification of at most {LARGEST_FILE} bytes; it is larger."),
    ],
)  # fmt: skip
def test_a_file_that_is_no_specification(content, sentence, tmp_path):
    path = tmp_path / "x.toml"
    path.write_bytes(content)
    with pytest.raises(SpecError) as caught:
        load(path)
    assert str(caught.value).startswith(str(path))
    assert sentence in str(caught.value)


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(SpecError, match=r"cannot be read: No such file or directory\.$"):
        load(tmp_path / "none.toml")
    with pytest.raises(SpecError, match=r"cannot be read: Is a directory\.$"):
        load(tmp_path)


def test_overrides_take_the_place_of_the_files_values():
    assert loads(TEXT, {RING: "2 mm"}).number(RING) == 0.002
    assert loads(TEXT, {"operating_point.positions": "3"}).number("operating_point.positions") == 3
    assert loads(TEXT, {"actuator.mover.magnet": "N52"}).word("actuator.mover.magnet") == "N52"
    assert loads(TEXT, {"actuator.name": "a = b"}).word("actuator.name") == "a = b"
    assert loads(TEXT, {"study.variables.0.lower": "1 mm"}).study.variables[0].lower == 0.001
    assert len(loads(TEXT, {"study.sweeps.1": ""}).study.sweeps) == 1
    assert loads(TEXT, {"study.sweeps": ""}).study.sweeps == ()
    swapped = loads(TEXT, {D_W: "", CLEARANCE: "0.3 mm"})
    assert swapped.number(D_W) == pytest.approx(0.0244)


@pytest.mark.parametrize(
    "key, text, sentence",
    [
        ("", "1", "--set needs a dotted key"),
        ("actuator..name", "1", "--set needs a dotted key"),
        (
            "actuator.turns",
            "5",
            "actuator.turns is not a key of this specification (did you mean actuator.winding.turns?).",
        ),
        (
            "actuator.winding.turnz",
            '{ value = 5, assumed = "a guess" }',
            "actuator.winding.turnz is not a key of this specification (did you mean actuator.winding.turns?).",
        ),
        ("actuator.kind.x", "1", "kind holds a value, not a section"),
        ("study.variables.9.lower", "1 mm", 'must number an item of a list of 2, counted from 0; got "9".'),
        ("study.variables.-1", "", "must number an item of a list of 2"),
        ("study.variables.\N{SUPERSCRIPT TWO}", "1", "must number an item of a list of 2"),
        ("study.objectve", "", "study.objectve cannot be dropped: the specification does not hold it."),
        (RING, "2\nx = 3", "must be a length"),
        (RING, "9" * 5000, "must be a length"),
        ("actuator.name", "\udcff", "--set must hold text without null characters and broken bytes"),
        ("operating_point.positions", "1e3", "must be a whole number"),
        ("actuator.back_yoke", "3", "actuator.back_yoke must be a section of keys, [actuator.back_yoke]; got 3."),
    ],
)
def test_overrides_that_make_no_sense(key, text, sentence):
    assert sentence in refused(TEXT, {key: text})


def test_one_sentence_has_one_full_stop():
    """Catches "did you mean x?." """
    assert refused(TEXT, {"actuator.back_yoke.thicknes": "1 mm"}).endswith(
        "(did you mean actuator.back_yoke.thickness?)."
    )
    assert "did you mean actuator.back_yoke?" in refused(TEXT + "\n[back_yoke]\nthickness = '1 mm'\n")


def test_required_keys_are_asked_for_with_their_meaning():
    assert refused(TEXT, {"actuator.shaft.length": ""}) == "actuator.shaft.length (shaft length) is missing."


def test_the_window_lies_within_the_stroke():
    """The stroke's ends are z = 0 and z = 88 mm: mid-stroke 44 mm, half of 88 mm to each side."""
    ends = {"operating_point.first_position": "0 mm", "operating_point.last_position": "88 mm"}
    assert positions(loads(TEXT, ends).values)[-1] == 0.088
    assert "must lie within the stroke, 0 mm to 88 mm; got 88.1 mm." in refused(
        TEXT, ends | {"operating_point.last_position": "88.1 mm"}
    )
    assert "got -0.1 mm" in refused(TEXT, ends | {"operating_point.first_position": "-0.1 mm"})
    assert "must not be below operating_point.first_position 24 mm; got 23 mm." in refused(
        TEXT, {"operating_point.last_position": "23 mm"}
    )


def test_a_design_that_cannot_be_built_is_refused_on_reading():
    assert "must exceed" in refused(TEXT, {"actuator.shaft.outer_diameter": "16 mm"}, DesignError)


def test_own_materials_are_read_and_roles_are_held():
    own = '\n[materials.mine]\ntype = "soft iron"\ndensity = "7.8 g/cm^3"\nbh = [[0.5, 100], [1.5, 1000]]\n'
    spec = loads(TEXT + own, {"actuator.back_yoke.material": "mine"})
    assert spec.materials["mine"].density == 7800.0
    assert "must name a conductor" in refused(TEXT, {"actuator.winding.material": "POM"}, MaterialError)
    assert "must name a permanent magnet" in refused(TEXT, {"actuator.mover.magnet": "1010"}, MaterialError)


def test_a_changed_value_keeps_all_others(spec):
    other = spec.with_values({RING: 0.002})
    assert other.number(RING) == 0.002
    assert other.number("actuator.mover.magnet_thickness") == pytest.approx(0.010)
    assert {k for k in spec.values if other.values[k] != spec.values[k]} == {RING, "actuator.mover.magnet_thickness"}
    assert spec.number(RING) == 0.0015


def test_a_key_that_follows_takes_the_place_of_one_that_is_given(spec):
    """D and thickness are given; asked for D_i, the thickness gives way and D stays, or both are named."""
    other = spec.with_values({"actuator.back_yoke.inner_diameter": 0.0256})
    assert other.number("actuator.back_yoke.outer_diameter") == 0.027
    assert other.number(YOKE) == pytest.approx(0.0007)
    both = spec.with_values({"actuator.back_yoke.inner_diameter": 0.0256, YOKE: 0.001})
    assert both.number("actuator.back_yoke.outer_diameter") == pytest.approx(0.0276)
    with pytest.raises(SpecError, match="over-determined: at most 1 of"):
        spec.with_values({TURNS: 1.0, DENSITY: 1e6})


def test_held_keys_stay_while_the_yoke_moves(spec):
    """The rule of Fig. 6(b): D_w = D_i - 0.8 mm with the turns per area of the prototype."""
    study = spec.for_study()
    assert CLEARANCE in study.given
    assert D_W not in study.given
    assert study.number(DENSITY) == pytest.approx(584 / (8 * 16.8e-6))
    thin = study.with_values({YOKE: 0.0004})
    assert thin.number("actuator.back_yoke.inner_diameter") == pytest.approx(0.0262)
    assert thin.number(D_W) == pytest.approx(0.0254)
    assert thin.number(TURNS) == pytest.approx(584 * 5.4 / 4.2)
    assert spec.with_values({YOKE: 0.0004}).number(TURNS) == 584  # without the study nothing is held but what is given


def test_pinning_changes_no_value(spec):
    for key in (CLEARANCE, DENSITY, "actuator.back_yoke.length", "actuator.mover.magnet_thickness"):
        pinned = spec.pinned([key])
        assert key in pinned.given
        for name, value in spec.values.items():
            assert pinned.values[name] == (pytest.approx(value, rel=1e-14) if isinstance(value, float) else value)


def test_changes_are_held_against_the_keys_limits(spec):
    with pytest.raises(SpecError, match="must be at least 0 mm; got -1 mm"):
        spec.with_values({RING: -0.001})
    with pytest.raises(SpecError, match="is not a key of this specification"):
        spec.with_values({"actuator.ring_width": 0.001})


def test_the_fingerprint_knows_what_decides_the_result(spec):
    """Catches a resumed folder that mixes two designs, and one that is refused over a comment."""
    assert loads("# a remark\n" + TEXT).fingerprint() == spec.fingerprint()
    prints = {
        spec.fingerprint(),
        loads(TEXT, {RING: "1.6 mm"}).fingerprint(),
        loads(TEXT, {"study.search.seed": "2"}).fingerprint(),
        loads(TEXT, {"solver.mesh_refinement": "2"}).fingerprint(),
        loads(TEXT, {"study.variables.0.upper": "5 mm"}).fingerprint(),
    }
    assert len(prints) == 5


def test_examples_are_sound():
    for path in sorted((Path(__file__).parents[2] / "examples").glob("*.toml")):
        load(path)


def test_a_runs_folder_leads_to_the_design_in_it(tmp_path):
    (tmp_path / "design.toml").touch()
    with pytest.raises(SpecError, match=r"cannot be read: Is a directory; the design in it is .*design\.toml\.$"):
        load(tmp_path)
