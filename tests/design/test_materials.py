"""Materials: the library's data and sources, temperature, looking up, and a specification's own tables."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import fluxbore.design
from fluxbore.design.errors import FluxboreError, MaterialError, SpecError
from fluxbore.design.materials import (
    Conductor,
    Library,
    Material,
    PermanentMagnet,
    SoftIron,
    Structural,
    from_table,
    lookup,
    schema,
    standard,
)
from fluxbore.design.units import ZERO_CELSIUS

IRON = {"type": "soft iron", "density": "7.8 g/cm^3", "bh": [[0.5, 50.0], [1.0, 100.0], [1.5, 900.0]]}
MAGNET = {"type": "magnet", "density": "7.5 g/cm^3", "remanence": "1.4 T", "intrinsic_coercivity": "12 kOe"}
COPPER = {"type": "conductor", "density": "8960 kg/m^3", "resistivity": "1.72 uohm cm"}


def data_tables() -> Iterator[tuple[str, dict[str, Any]]]:
    folder = Path(fluxbore.design.__file__).parent / "data"
    for path in sorted(folder.glob("*.toml")):
        yield from tomllib.loads(path.read_text(encoding="utf-8")).items()


def test_the_library_holds_what_the_actuators_are_made_of(library: Library) -> None:
    """Catches a data file that is not found, or a renamed material that specifications in use refer to."""
    kinds = {
        SoftIron: {"1010", "1018", "pure iron", "TEAM 13 steel"},
        PermanentMagnet: {"N42", "N48", "N50", "N52", "N48M"},
        Conductor: {"copper", "aluminium"},
        Structural: {"aluminium 6061", "stainless steel 304", "POM", "PTFE", "air"},
    }
    for kind, names in kinds.items():
        assert names <= {name for name, material in library.items() if type(material) is kind}
    assert all(material.name == name for name, material in library.items())


def test_no_name_stands_in_two_data_files(library: Library) -> None:
    """Catches a material that one file gives and another silently replaces."""
    assert len(list(data_tables())) == len(library)


def test_every_material_names_its_source() -> None:
    """Catches a datum without provenance, which nobody could check."""
    for name, table in data_tables():
        assert len(table.get("source", "")) > 20, name


def test_the_library_is_read_once_and_cannot_be_changed(library: Library) -> None:
    """Catches one specification's own material leaking into the next one's library."""
    assert standard() is library
    with pytest.raises(TypeError):
        library["1010"] = library["1018"]  # type: ignore[index]


@pytest.mark.parametrize(
    ("name", "field", "lowest", "highest"),
    [("1010", 1999.0, 1.50, 1.60), ("1018", 7957.8, 1.70, 1.72), ("pure iron", 897.8, 1.58, 1.60),
     ("TEAM 13 steel", 247.0, 0.49, 0.51)],
)  # fmt: skip
def test_soft_irons_pass_through_their_published_points(
    library: Library, name: str, field: float, lowest: float, highest: float
) -> None:
    """Catches columns that were swapped, or one material's table under another's name."""
    curve = library[name].curve
    assert curve is not None
    assert lowest < curve.b[curve.h.index(field)] < highest


def test_soft_irons_saturate_where_iron_does(library: Library) -> None:
    """Catches a table cut off below the knee or with a digit too many: iron's polarisation is 2.16 T at most."""
    for material in library.values():
        if material.curve is not None:
            assert 2.0 < material.curve.saturation <= 2.165, material.name
            assert material.curve.b[-1] > 2.2, material.name


def test_the_end_of_the_team_13_curve_follows_its_published_formula(library: Library) -> None:
    """Catches a slip in the points that were computed: B = mu_0 H + 2.16 T above 2.22 T."""
    curve = library["TEAM 13 steel"].curve
    assert curve is not None
    for b, h in zip(curve.b, curve.h, strict=True):
        if b > 2.22:
            assert b == pytest.approx(4e-7 * 3.141592653589793 * h + 2.16, abs=5e-5)


def test_magnet_grades_keep_the_order_of_their_names(library: Library) -> None:
    """Catches a remanence under the wrong grade, and a grade above the 1.6 T that Nd2Fe14B can give."""
    grades = [library[name] for name in ("N42", "N45", "N48", "N50", "N52")]
    remanences = [grade.remanence for grade in grades if isinstance(grade, PermanentMagnet)]
    assert remanences == sorted(remanences)
    assert len(remanences) == 5
    assert remanences[0] == pytest.approx(1.30, abs=0.02)
    assert remanences[-1] == pytest.approx(1.44, abs=0.02)
    plain, heat_proof = library["N48"], library["N48M"]
    assert isinstance(plain, PermanentMagnet)
    assert isinstance(heat_proof, PermanentMagnet)
    assert heat_proof.intrinsic_coercivity > plain.intrinsic_coercivity


def test_a_magnet_loses_remanence_and_coercivity_with_temperature(library: Library) -> None:
    """Catches a coefficient in percent taken as a plain number, degC taken as K, or the two coefficients swapped."""
    magnet = library["N48"]
    assert isinstance(magnet, PermanentMagnet)
    hot = 80.0 + ZERO_CELSIUS
    assert magnet.remanence_at(20.0 + ZERO_CELSIUS) == pytest.approx(magnet.remanence)
    assert magnet.remanence_at(hot) == pytest.approx(magnet.remanence * (1 - 0.0012 * 60))
    assert magnet.remanence_at(hot, 1.4) == pytest.approx(1.4 * (1 - 0.0012 * 60))
    assert magnet.coercivity_at(hot) == pytest.approx(955e3 * (1 - 0.0076 * 60))


def test_a_magnet_heated_beyond_its_straight_line_is_an_error(library: Library) -> None:
    """Catches a negative coercivity, which would pass for a magnet that withstands any field."""
    magnet = library["N48"]
    assert isinstance(magnet, PermanentMagnet)
    with pytest.raises(MaterialError, match=r'coercivity of "N48" .* up to 152 degC; got 200 degC'):
        magnet.coercivity_at(200.0 + ZERO_CELSIUS)


@given(st.floats(200.0, 500.0))
def test_conductors_warm_up_along_a_straight_line(temperature: float) -> None:
    """Catches a coefficient that refers to another temperature than 20 degC."""
    copper = standard()["copper"]
    assert isinstance(copper, Conductor)
    assert copper.resistivity_at(20.0 + ZERO_CELSIUS) == pytest.approx(1.72e-8)
    expected = 1.72e-8 * (1 + 3.93e-3 * (temperature - 293.15))
    assert copper.resistivity_at(temperature) == pytest.approx(expected, rel=1e-12)


def test_only_soft_iron_and_magnets_are_magnetic(library: Library) -> None:
    """Catches a structural material that shunts flux, or a soft iron taken for air."""
    for material in library.values():
        expected = {SoftIron: material.relative_permeability > 500, PermanentMagnet: True}
        assert expected.get(type(material), material.relative_permeability == 1.0), material.name
        assert (material.curve is not None) == isinstance(material, SoftIron)


def test_looking_up_gives_the_material_or_a_sentence_with_the_key_and_the_names(library: Library) -> None:
    """Catches a KeyError at the user, and a magnet made of copper."""
    assert lookup("N48", "actuator.mover.magnet", library, PermanentMagnet) is library["N48"]
    assert lookup("copper", "actuator.back_yoke.material", library, Material) is library["copper"]
    with pytest.raises(MaterialError, match=r'^actuator\.mover\.magnet must name a permanent magnet, .*N48.*"N99"\.$'):
        lookup("N99", "actuator.mover.magnet", library, PermanentMagnet)
    with pytest.raises(MaterialError, match=r'must name a permanent magnet, .*; got "copper", a conductor\.$'):
        lookup("copper", "actuator.mover.magnet", library, PermanentMagnet)
    with pytest.raises(
        MaterialError, match=r'must name a conductor, one of aluminium, copper; got "1010", a soft iron'
    ):
        lookup("1010", "actuator.winding.material", library, Conductor)


def test_a_table_of_ones_own_becomes_a_material() -> None:
    """Catches a unit that is dropped on the way, or a default that is lost."""
    magnet = from_table("mine", MAGNET | {"remanence_coefficient": "-0.11 %/K", "working_temperature": "150 degC"})
    assert isinstance(magnet, PermanentMagnet)
    assert magnet.density == pytest.approx(7500.0)
    assert magnet.intrinsic_coercivity == pytest.approx(954.93e3, rel=1e-5)
    assert magnet.remanence_coefficient == pytest.approx(-0.0011)
    assert magnet.working_temperature == pytest.approx(423.15)
    assert magnet.recoil_permeability == 1.05
    iron = from_table("mine", IRON | {"source": "own ring test"})
    assert iron.curve is not None
    assert iron.curve.b == (0.0, 0.5, 1.0, 1.5)
    assert iron.curve.source == iron.source == "own ring test"
    copper = from_table("mine", COPPER)
    assert isinstance(copper, Conductor)
    assert copper.resistivity == pytest.approx(1.72e-8)


def test_a_curve_file_is_found_beside_the_specification(tmp_path: Path) -> None:
    """Catches a path taken relative to the working folder, which works only for its author."""
    (tmp_path / "iron.csv").write_text("0.5,50\n1.0,100\n1.5,900\n", encoding="utf-8")
    table = {"type": "soft iron", "density": "7.8 g/cm^3", "bh_file": "iron.csv"}
    assert from_table("mine", table, "materials.mine", tmp_path).curve is not None
    with pytest.raises(MaterialError, match=r"^materials\.mine\.bh_file must name a file"):
        from_table("mine", table, "materials.mine", tmp_path / "elsewhere")


@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        ({}, r"materials\.mine\.type must be one of soft iron, magnet, conductor, structural; got none"),
        ({"type": "iron"}, r'materials\.mine\.type must be one of .*; got "iron"'),
        (COPPER | {"remanence": "1 T"}, r'materials\.mine\.remanence is no key of a material of type "conductor"'),
        (COPPER | {"density": 8960}, r"materials\.mine\.density must be a density.*bare number 8960"),
        (COPPER | {"density": "8960 kg"}, r'materials\.mine\.density must be .*got "8960 kg" with the unit "kg"'),
        (COPPER | {"density": "0 kg/m^3"}, r"materials\.mine\.density must exceed 0"),
        (COPPER | {"bh": IRON["bh"]}, r"materials\.mine\.bh is no key"),
        ({"type": "magnet", "density": "7.5 g/cm^3"}, r"materials\.mine\.remanence must be given"),
        (MAGNET | {"recoil_permeability": 0.9}, r"materials\.mine\.recoil_permeability must be at least 1; got 0\.9"),
        (IRON | {"poisson_ratio": 0.6}, r"materials\.mine\.poisson_ratio must be at most 0\.5; got 0\.6"),
        (IRON | {"bh_file": "iron.csv"}, r"exactly one of .*bh and .*bh_file; got bh and bh_file"),
        ({"type": "soft iron", "density": "7.8 g/cm^3"}, r"exactly one of .*; got none"),
        (IRON | {"bh": 3}, r"materials\.mine\.bh must be a list of pairs"),
        (IRON | {"bh": [[0.5, 50.0], [0.4, 60.0]]}, r"materials\.mine\.bh row 2 must exceed both"),
    ],
)
def test_a_wrong_table_is_one_sentence_that_names_the_key(table: dict[str, object], sentence: str) -> None:
    """Catches a traceback, a silently ignored key and a missing unit in a user's material."""
    with pytest.raises(FluxboreError, match=sentence):
        from_table("mine", table)


def test_the_section_must_be_a_table() -> None:
    """Catches an AttributeError for ``materials.mine = "1010"``."""
    with pytest.raises(SpecError, match=r"materials\.mine must be a section"):
        from_table("mine", "1010")  # type: ignore[arg-type]


def test_the_schema_takes_every_table_of_the_library_and_no_key_that_the_reader_refuses() -> None:
    """Catches a schema that drifts away from the reader: an editor would mark good files and miss bad ones."""
    variants: dict[str, Any] = {variant["title"]: variant for variant in schema()["oneOf"]}  # type: ignore[attr-defined]
    for name, table in data_tables():
        variant = variants[table["type"]]
        assert set(table) <= set(variant["properties"]), name
        assert set(variant["required"]) <= set(table), name
        for key, value in table.items():
            pattern = variant["properties"][key].get("pattern")
            assert pattern is None or re.search(pattern, value), (name, key)
    for kind, sample in (("soft iron", IRON), ("magnet", MAGNET), ("conductor", COPPER)):
        for key in variants[kind]["required"]:
            with pytest.raises(FluxboreError, match=rf"materials\.mine\.{key} must be"):
                from_table("mine", {word: value for word, value in sample.items() if word != key})
