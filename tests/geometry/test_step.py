"""STEP files read back twice: on their own tokens, and by the CAD kernel. Of a small assembly; full/ has the large."""

import dataclasses
import math
import re
from pathlib import Path

import pytest
from cad_files import MM, assert_sound, read_tree, write_step
from step_reader import StepFile, read

from fluxbore.design import graphics
from fluxbore.design.materials import standard
from fluxbore.design.title_block import TitleBlock
from fluxbore.geometry import part as parts_of
from fluxbore.geometry import step, step_text, unrolled
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.helix import arc
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import AxialHole, Colour, Fit, Hole, Part
from fluxbore.geometry.parts_list import Item, parts_list
from fluxbore.geometry.step_products import own_frame

pytestmark = pytest.mark.skipif(not graphics.has_gl(), reason=f"libGL is missing: {graphics.APT_LINE}")

STEEL, RED, BLUE = "stainless steel 304", (0.8, 0.2, 0.1), (0.1, 0.2, 0.8)

TITLE = TitleBlock("small", "SM-1", "DRW-7", "C", "Ada Löw", "O'Neill & Co \\ Söhne", approver="Émile")


def ring(name: str, start: float, colour: Colour = RED, **rest: object) -> Part:
    profile = rectangle(0.004, 0.01, start, start + 0.006)
    return Part(name, "coil", "stator", "copper", colour, profile, fill=0.6, **rest)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def whole() -> Assembly:
    """A cap with drillings, coils of which one is turned end for end, a bought rod, an envelope, and arcs."""
    cap = Part(
        "cap", "cap", "stator", STEEL, (0.2, 0.4, 0.6), rectangle(0.004, 0.012, 0.02, 0.03),
        holes=(Hole(0.025, 0.004, math.pi / 2, 0.0, "M5 x 6"), Hole(0.025, 0.002)),
        axial_holes=tuple(AxialHole(0.0095, 0.002, 0.026, 0.03, i * math.tau / 3, "M2.5 x 4") for i in range(3)),
        fits=(Fit("bore", 0.008, "H8"), Fit("spigot", 0.024, "f7")),
    )  # fmt: skip
    stepped = ((0.004, 0.0), (0.01, 0.0), (0.01, 0.002), (0.008, 0.006), (0.004, 0.006))
    turned = tuple((r, 0.05 - z) for r, z in reversed(stepped))
    plain = Part("cone 1", "cone", "stator", STEEL, RED, tuple((r, z + 0.03) for r, z in stepped))
    rod = Part("rod 'τ' \\ №1", "rod", "mover", STEEL, BLUE, rectangle(0, 0.003, -0.01, 0.05), bought="h6 rod 6 x 60")
    arcs = tuple(
        HelicalPart(
            f"arc {i}", "arc", "mover", "N42 (20 °C)" if "N42 (20 °C)" in standard() else STEEL, BLUE,
            0.02, 0.022, arc(0.01, 0.004, 0.9, math.tau * i / 6, 0.01 * i / 6), 0.01,
            note="bonded",
        )
        for i in range(7)
    )  # fmt: skip
    envelope = Part("motor", "motor", "stator", "", (0.5, 0.5, 0.5), rectangle(0.03, 0.04, 0, 0.02))
    return Assembly(
        "small",
        (
            cap, ring("coil 1", 0.0, note="phase U"), ring("coil 2", 0.008, BLUE, note="phase V"), plain,
            dataclasses.replace(plain, name="cone 2", profile=turned), envelope, rod, *arcs,
        ),
        0.0123,
        carried_mass=0.25,
        title=TITLE,
    )  # fmt: skip


@pytest.fixture(scope="module")
def items(whole: Assembly) -> tuple[Item, ...]:
    return parts_list(whole, standard())


@pytest.fixture(scope="module")
def written(whole: Assembly, tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    return write_step(whole, tmp_path_factory.mktemp("out") / "cad")


@pytest.fixture(scope="module")
def file(written: list[Path]) -> StepFile:
    return read(written[0])


def test_each_item_is_one_product_under_its_number(file: StepFile, items: tuple[Item, ...]) -> None:
    """Catches 24 copies of a coil, names that readers would merge, and numbers that are not the parts list's."""
    found = {item[0]: item[1] for item in file.all("PRODUCT").values()}
    parts = {item.part_number: item.name for item in items}
    assert [item.count for item in items] == [1, 2, 2, 1, 1, 7]
    assert found == {"SM-1": "small", "SM-1-STATOR": "stator", "SM-1-MOVER": "mover", **parts}
    assert len(set(file.names())) == len(file.names())
    assert len(file.all("MANIFOLD_SOLID_BREP")) == len(items)


def test_every_piece_is_used_once_under_its_group(file: StepFile, whole: Assembly, items: tuple[Item, ...]) -> None:
    of = {part.name: item.name for item in items for part in item.parts}
    used = {name: (group, product) for group, product, name in file.usages()}
    assert used == {part.name: (part.group, of[part.name]) for part in whole.parts} | {
        "stator": ("small", "stator"), "mover": ("small", "mover"),
    }  # fmt: skip
    assert file.properties()["coil 2"] == {"note": "phase V"}


def test_products_tell_what_a_workshop_asks(file: StepFile, items: tuple[Item, ...]) -> None:
    told = file.properties()
    for item in items:
        found, part = told[item.name], item.part
        assert found["part number"] == item.part_number
        assert found["drawing number"] == item.drawing_number
        assert found["volume"] == (pytest.approx(item.volume * 1e9, rel=1e-12), "MILLIMETRE^3")
        assert found["centroid"] == pytest.approx(
            [x / MM for x in parts_of.centre_of_mass(own_frame(part)[0])], abs=1e-9
        )
        if part.material:
            assert found["mass"] == (pytest.approx(item.mass, rel=1e-12), "KILOGRAM")
            assert found["material name"] == part.material
            assert found["density"] == (standard()[part.material].density, "KILOGRAM^1 METRE^-3")
    descriptions = {item[1]: item[2] for item in file.all("PRODUCT").values()}
    assert descriptions["arc"] == "bonded"  # of all pieces
    assert descriptions["coil"] == ""  # "phase U" and "phase V" are the pieces' own
    assert told["cap"]["tolerance of bore"] == "8 H8"
    assert told["cap"]["tolerance of spigot"] == "24 f7"
    assert told["cap"]["thread M5 x 6"] == "1 x M5 x 6"
    assert told["cap"]["thread M2.5 x 4"] == "3 x M2.5 x 4"
    assert told["coil"]["share of the volume that is the material"] == 0.6
    assert told["rod 'τ' \\ №1"]["designation"] == "h6 rod 6 x 60"
    assert "mass" not in told["motor"]
    assert "material name" not in told["motor"]


def test_what_is_put_together_weighs_its_parts(file: StepFile, items: tuple[Item, ...]) -> None:
    told = file.properties()
    masses = {group: sum(i.mass * i.count for i in items if i.part.group == group) for group in ("stator", "mover")}
    for group, mass in masses.items():
        assert told[group]["mass"] == (pytest.approx(mass), "KILOGRAM")
    assert told["small"]["mass"] == (pytest.approx(sum(masses.values())), "KILOGRAM")
    assert told["mover"]["mass carried along, not drawn"] == (0.25, "KILOGRAM")
    assert told["small"]["position of the mover"] == (pytest.approx(12.3), "MILLIMETRE")


def test_revision_and_source_stand_where_readers_look_for_them(file: StepFile) -> None:
    sources = {
        file.value(item[2])[1]: (item[0], item[3])
        for item in file.all("PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE").values()
    }
    assert sources["cap"] == ("C", ".MADE.")
    assert sources["rod 'τ' \\ №1"] == ("C", ".BOUGHT.")
    assert {item[0] for item in file.all("PRODUCT_DEFINITION_FORMATION").values()} == {"C"}


def test_the_header_tells_program_people_and_schema_and_no_path(file: StepFile, written: list[Path]) -> None:
    name, time, author, organisation, _, program, approver = file.header["FILE_NAME"]
    assert (name, author, organisation, approver) == ("small.step", [TITLE.author], [TITLE.organisation], "Émile")
    assert re.fullmatch(r"fluxbore( \S+)?", program)
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00", time)
    assert file.header["FILE_DESCRIPTION"][0] == ["small, mover at 12.3 mm"]
    assert file.header["FILE_SCHEMA"][0][0].startswith("AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF")
    head = written[0].read_text(encoding="ascii").partition("DATA;")[0]
    assert str(Path.home()) not in head
    assert str(written[0].parent) not in head


def test_ap214_by_choice(whole: Assembly, tmp_path: Path) -> None:
    few = dataclasses.replace(whole, parts=whole.parts[1:3])
    found = read(write_step(few, tmp_path, "AP214")[0])
    assert found.header["FILE_SCHEMA"][0][0].startswith("AUTOMOTIVE_DESIGN")
    assert found.properties()["coil"]["material name"] == "copper"


def test_the_kernel_reads_it_back_as_it_is_modelled(whole: Assembly, written: list[Path]) -> None:
    """Names, groups, colours of each piece, bodies, volumes, and where they stand."""
    import cadquery

    name, pieces = read_tree(written[0])
    assert name == "small"
    assert [(piece.group, piece.name) for piece in pieces] == [(part.group, part.name) for part in whole.parts]
    for piece, part in zip(pieces, whole.parts, strict=True):
        assert piece.colour == pytest.approx(part.colour, abs=1e-6)
        drilled = isinstance(part, Part) and part.holes
        assert_sound(piece.body, parts_of.volume(part), 1e-4 if drilled else 1e-6)
        centre = cadquery.Shape.centerOfMass(piece.body).toTuple()
        assert [x * MM for x in centre] == pytest.approx(parts_of.centre_of_mass(part), abs=5e-6 if drilled else 1e-6)
        box, (low, high) = piece.body.BoundingBox(), (min(z for _, z in part.profile), max(z for _, z in part.profile))
        assert (box.zmin * MM, box.zmax * MM) == pytest.approx((low, high), abs=2e-6)


def test_every_item_has_a_file_of_its_own_with_its_number(written: list[Path], items: tuple[Item, ...]) -> None:
    import cadquery

    names = ["cap", "coil", "cone", "motor", "rod-τ-1", "arc"]
    assert [path.relative_to(written[0].parent).as_posix() for path in written[1:]] == [
        f"parts/{name}.step" for name in names
    ]
    for path, item in zip(written[1:], items, strict=True):
        alone = read(path)
        assert [found[:2] for found in alone.all("PRODUCT").values()] == [[item.part_number, item.name]]
        assert alone.usages() == []
        (colour,) = alone.colours()
        assert colour == pytest.approx(item.part.colour, abs=1e-6)
        body = cadquery.importers.importStep(str(path)).val()
        assert_sound(body, item.volume, 1e-4)
        assert body.BoundingBox().zmin == pytest.approx(0.0, abs=1e-3)


def test_each_place_of_the_stroke_has_its_file_with_the_same_shapes(whole: Assembly) -> None:
    """The mover is shifted and nothing else; a mover that stands still has one file."""
    moved = tuple(
        dataclasses.replace(part, profile=tuple((r, z + 0.02) for r, z in part.profile))
        if isinstance(part, Part)
        else dataclasses.replace(part, outline=unrolled.moved(part.outline, 0.3, 0.02))
        for part in whole.parts
        if part.group == "mover"
    )
    still = tuple(part for part in whole.parts if part.group == "stator")
    few = dataclasses.replace(whole, parts=(*still[1:2], *whole.parts[6:8]))
    out = dataclasses.replace(few, parts=(still[1], *moved[:2]), position=0.0323)
    items = parts_list(few, standard())
    texts = step.step_texts({"mid-stroke": few, "retracted": few, "extended": out}, items, standard())
    assert [name for name in texts if "/" not in name] == ["small.step", "small-extended.step"]
    first, last = (StepFile(texts[name]) for name in ("small.step", "small-extended.step"))
    assert sorted(first.names()) == sorted(last.names())
    assert len(last.all("MANIFOLD_SOLID_BREP")) == len(items)
    assert last.header["FILE_DESCRIPTION"][0] == ["small, mover at 32.3 mm"]


def test_the_kernels_global_settings_are_put_back(whole: Assembly, tmp_path: Path) -> None:
    """Catches an export that turns the units of a script's own STEP files to something else."""
    from OCP.Interface import Interface_Static
    from OCP.STEPCAFControl import STEPCAFControl_Controller

    STEPCAFControl_Controller.Init_s()
    words = ("write.step.unit", "write.step.schema")
    before = {name: Interface_Static.CVal_s(name) for name in words}
    curves = Interface_Static.IVal_s("write.surfacecurve.mode")
    try:
        Interface_Static.SetCVal_s("write.step.unit", "INCH")
        text = write_step(dataclasses.replace(whole, parts=whole.parts[1:2]), tmp_path)[0].read_text(encoding="ascii")
        assert Interface_Static.CVal_s("write.step.unit") == "INCH"
        assert Interface_Static.CVal_s("write.step.schema") == before["write.step.schema"]
        assert Interface_Static.IVal_s("write.surfacecurve.mode") == curves
        assert ".MILLI." in text
    finally:
        for name, value in before.items():
            Interface_Static.SetCVal_s(name, value)


def test_nothing_is_printed(whole: Assembly, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """The kernel's own chatter would break the JSON of the command line; cadquery, loaded by then, stops it too."""
    from OCP.Message import Message, Message_Gravity

    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Info)
    write_step(dataclasses.replace(whole, parts=whole.parts[1:2]), tmp_path)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("name", ["Prüfling 'τ' \\ №1 𝛑", "stator", "coil", "../up/and away"])
def test_any_name_survives_and_none_escapes_the_folder(whole: Assembly, tmp_path: Path, name: str) -> None:
    """The root's name differs from its children's, else readers merge them; the text is ASCII as the standard wants."""
    few = dataclasses.replace(whole, name=name, parts=whole.parts[1:3])
    paths = write_step(few, tmp_path / "cad")
    assert paths[0].parent == tmp_path / "cad"
    assert paths[0].exists()
    assert f"{name} assembly" if name in ("stator", "coil") else name in read(paths[0]).names()


@pytest.mark.parametrize("text", ["", "it's", "a\\b", "\\X2\\00E4\\X0\\", "äöü 𝛑 №", "'\\'"])
def test_words_come_back_from_their_codes(text: str) -> None:
    (found,) = StepFile(
        f"ISO-10303-21;HEADER;A({step_text.word(text)});ENDSEC;DATA;#1 = B();ENDSEC;END-ISO-10303-21;"
    ).header["A"]
    assert found == text


@pytest.mark.parametrize("value", [0.0, 1.0, -3.5e-12, 1e20, 123456789.125, 1 / 3])
def test_numbers_are_reals_of_the_standard(value: float) -> None:
    assert re.fullmatch(r"-?\d+\.\d*(E[-+]\d+)?", step_text.number(value))
    assert float(step_text.number(value)) == pytest.approx(value, rel=1e-14)
