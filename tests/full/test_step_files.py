"""Each actuator's STEP files at three places of its stroke, on their tokens and through the CAD kernel: the same parts,
names, colours, numbers, masses and places as modelled, all of them sound, none overlapping but as designed."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import pytest
from cad_files import MM, assert_sound, read_tree
from step_reader import StepFile, read

from fluxbore.actuators import STROKE_PLACES, assembly_of
from fluxbore.design import graphics
from fluxbore.design.spec import Spec, load
from fluxbore.exporting import Export, Job, export_checked
from fluxbore.geometry import part as parts_of
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.parts_list import Item

pytestmark = [
    pytest.mark.full,
    pytest.mark.skipif(not graphics.has_gl(), reason=f"libGL is missing: {graphics.APT_LINE}"),
]

EXAMPLES = Path(__file__).parents[2] / "examples"

ARCS = {
    f"actuator.{member}.{leaf}": value
    for member, form in (("translator", "stepped arcs"), ("rotor", "helical arcs"))
    for leaf, value in (("magnets", form), ("arc_angle", "59 deg"), ("arcs_per_turn", "6"))
}

CASES = {"ipehla": {}, "rotlin": {}, "rotlin of arcs": ARCS, "prehydra": {}}


@dataclass(frozen=True)
class Written:
    """One design, and what was exported of it."""

    spec: Spec
    items: tuple[Item, ...]
    places: dict[str, Assembly]
    export: Export

    def whole(self, place: str) -> Path:
        stem = self.export.files[0].stem
        return self.export.files[0].with_stem(stem if place == "mid-stroke" else f"{stem}-{place}")


@pytest.fixture(scope="module", params=CASES)
def written(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Written:
    title = {"drawing.part_number": "T-100", "drawing.number": "D-200", "drawing.revision": "B"}
    spec = load(EXAMPLES / f"{request.param.split()[0]}.toml", {**CASES[request.param], **title})
    made = export_checked(spec, tmp_path_factory.mktemp("out") / "cad", ["step"])
    places = {name: assembly_of(spec, share) for name, share in STROKE_PLACES.items()}
    return Written(spec, Job(spec).items, places, made)


@pytest.fixture(scope="module")
def file(written: Written) -> StepFile:
    return read(written.whole("mid-stroke"))


def test_nothing_overlaps_but_what_is_designed(written: Written) -> None:
    assert written.export.sound
    assert [standing.place for standing in written.export.standings] == list(STROKE_PLACES)
    assert all(standing.gap is not None and standing.gap.distance > 0 for standing in written.export.standings)


def test_tokens_count_what_the_parts_list_counts(written: Written, file: StepFile) -> None:
    pieces = {part.name for item in written.items for part in item.parts}
    assert {use[2] for use in file.usages()} == pieces | {"stator", "mover"}
    numbers = Counter(item[0] for item in file.all("PRODUCT").values())
    assert max(numbers.values()) == 1
    assert {f"T-100-{item.number:03d}" for item in written.items} <= set(numbers)
    assert len(set(file.names())) == len(file.names())
    assert len(file.all("MANIFOLD_SOLID_BREP")) == len(file.names()) - 3
    # Alike pieces are one shape: an item has more only where its pieces differ by the angle between drillings.
    assert len(file.names()) - 3 == len(written.items)
    assert {item[0] for item in file.all("PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE").values()} == {"B"}


def test_tokens_tell_masses_materials_and_sources(written: Written, file: StepFile) -> None:
    told = file.properties()
    names = {item[0]: item[1] for item in file.all("PRODUCT").values()}
    for item in written.items:
        found = told[names[item.part_number]]
        assert found["drawing number"] == item.drawing_number
        assert found["source"] == ("buy" if item.part.bought else "make")
        assert found.get("designation", "") == item.part.bought
        if item.mass:
            assert found["mass"] == (pytest.approx(item.mass, rel=1e-12), "KILOGRAM")
            assert found["material name"] == item.part.material
    for group in ("stator", "mover"):
        mass = sum(item.mass * item.count for item in written.items if item.part.group == group)
        assert told[group]["mass"] == (pytest.approx(mass, rel=1e-12), "KILOGRAM")


@pytest.mark.parametrize("place", STROKE_PLACES)
def test_the_kernel_reads_every_piece_back_at_every_place(written: Written, place: str) -> None:
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    whole = written.places[place]
    name, pieces = read_tree(written.whole(place))
    assert name == whole.name
    by_name = {piece.name: piece for piece in pieces}
    assert len(by_name) == len(pieces) == len(whole.parts)
    shapes = set()
    for part in whole.parts:
        piece = by_name[part.name]
        assert piece.group == part.group
        assert piece.colour == pytest.approx(part.colour, abs=1e-6)
        drilled = getattr(part, "holes", ()) or getattr(part, "axial_holes", ())
        if (kind := (part.role, parts_of.volume(part))) not in shapes:
            shapes.add(kind)
            assert_sound(piece.body, parts_of.volume(part), 1e-4 if drilled else 1e-6)
        found = GProp_GProps()
        BRepGProp.VolumeProperties_s(piece.body.wrapped, found, 1e-6)
        centre = [found.CentreOfMass().Coord(i) * MM for i in (1, 2, 3)]
        assert centre == pytest.approx(parts_of.centre_of_mass(part), abs=1e-6 if drilled else 1e-7)


def test_every_item_has_its_file(written: Written) -> None:
    import cadquery

    files = [path for path in written.export.files if path.parent.name == "parts"]
    assert len(files) == len(set(files)) == len(written.items)
    for path, item in zip(files, written.items, strict=True):
        assert [found[0] for found in read(path).all("PRODUCT").values()] == [item.part_number]
        body = cadquery.importers.importStep(str(path)).val()
        assert_sound(body, item.volume, 1e-4)
        assert body.BoundingBox().zmin * MM == pytest.approx(0.0, abs=2e-6)
