"""The drawing of an assembly: what the plane cuts, what is seen behind it, and the DXF file read back."""

import io
import math
from pathlib import Path
from typing import Any

import ezdxf
import pytest
import shapely

from fluxbore.actuators import assembly_of
from fluxbore.cli import main
from fluxbore.design.materials import standard
from fluxbore.design.spec import Spec, load
from fluxbore.geometry import own_files, section
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.drawing import dxf_text
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.mass import part_masses, total
from fluxbore.geometry.measure import overall
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Hole, Part
from fluxbore.geometry.sheet_dxf import APPLICATION

MM = 1e-3
EXAMPLES = Path(__file__).parents[2] / "examples"


def turned(profile: Any, *holes: Hole, name: str = "block") -> Part:
    return Part(name, name, "stator", "brass", (0.5, 0.5, 0.5), profile, holes)


def read(text: str) -> Any:
    """The drawing as another reader has it, free of errors."""
    document = ezdxf.read(io.StringIO(text))
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    return document


def dimensions(document: Any) -> dict[str, float]:
    """Name -> what the DIMENSION entity says (mm): the distance of its points times the scale of its style."""
    return {
        entity.get_xdata(APPLICATION)[0].value: entity.get_measurement() * entity.override().get("dimlfac", 1.0)
        for entity in document.modelspace().query("DIMENSION")
    }


@pytest.fixture(scope="module")
def spec() -> Spec:
    return load(EXAMPLES / "prehydra.toml")


@pytest.fixture(scope="module")
def whole(spec: Spec) -> Assembly:
    return assembly_of(spec)


@pytest.fixture(scope="module")
def drawn(spec: Spec, whole: Assembly) -> Any:
    return read(dxf_text(whole, spec.materials))


def test_the_plane_cuts_both_halves_and_leaves_drillings_open() -> None:
    """Areas by hand: a ring of 10 by 20 mm on both sides, less a drilling in one of them."""
    ring = rectangle(5 * MM, 15 * MM, 0.0, 20 * MM)
    assert section.face(turned(ring)).area == pytest.approx(2 * 200e-6)
    through, blind = Hole(10 * MM, 4 * MM), Hole(10 * MM, 4 * MM, math.pi, 9 * MM)
    assert section.face(turned(ring, through)).area == pytest.approx(2 * 200e-6 - 40e-6)
    assert section.face(turned(ring, through, blind)).area == pytest.approx(2 * 200e-6 - 40e-6 - 24e-6)
    beside = Hole(10 * MM, 4 * MM, math.pi / 2)
    assert section.face(turned(ring, beside)).area == pytest.approx(2 * 200e-6)


def test_a_rod_is_one_face_without_a_line_along_its_axis() -> None:
    face = section.face(turned(rectangle(0.0, 5 * MM, 0.0, 30 * MM)))
    assert face.geom_type == "Polygon"
    assert face.equals(shapely.box(0.0, -5 * MM, 30 * MM, 5 * MM))


def test_a_step_in_a_bore_is_seen_behind_the_plane_and_one_outside_is_not() -> None:
    """A bore of 10 mm that opens to 16 mm in the middle; the outside has a step of its own."""
    outline = ((5, 0), (12, 0), (12, 10), (15, 10), (15, 40), (8, 40), (8, 20), (5, 20))
    sleeve = turned(tuple((r * MM, z * MM) for r, z in outline), name="sleeve")
    alone = section.seen_behind(Assembly("sleeve", (sleeve,), 0.0))
    assert alone == [((20 * MM, -5 * MM), (20 * MM, 5 * MM))]
    rod = turned(rectangle(0.0, 3 * MM, -10 * MM, 50 * MM), name="rod")
    behind = section.seen_behind(Assembly("with a rod", (sleeve, rod), 0.0))
    assert sorted(behind) == [((20 * MM, -3 * MM), (20 * MM, -5 * MM)), ((20 * MM, 3 * MM), (20 * MM, 5 * MM))]


def test_the_rim_of_a_drilling_lies_on_drilling_and_bore() -> None:
    """Each point of it is on both cylinders: y'^2 + x^2 = r^2 and x^2 + (z - z_0)^2 = R^2."""
    hole = Hole(10 * MM, 6 * MM)
    part = turned(rectangle(5 * MM, 15 * MM, 0.0, 20 * MM), hole)
    lines = [line for line in section.seen_behind(Assembly("bush", (part,), 0.0)) if len(line) > 2]
    assert len(lines) == 2
    for line, radius in zip(lines, (5 * MM, 15 * MM), strict=True):
        for z, y in line:
            depth = radius**2 - y**2
            assert depth + (z - hole.z) ** 2 == pytest.approx((hole.diameter / 2) ** 2, abs=1e-12)


def test_dimensions_are_the_specification_s(spec: Spec, drawn: Any) -> None:
    found = dimensions(drawn)
    cylinder = "actuator.output_cylinder."
    given = {
        "bore": cylinder + "bore",
        "stroke": cylinder + "stroke",
        "wall": cylinder + "wall_thickness",
        "rod diameter": cylinder + "rod_diameter",
        "piston length": cylinder + "piston_length",
        "cap length, cap end": cylinder + "cap_length",
        "cap length, rod end": cylinder + "cap_length",
        "bleed screw's thread": cylinder + "bleed_thread",
        "groove diameter": "actuator.seal.groove_diameter",
        "groove width": "actuator.seal.groove_width",
    }
    assert {name: found[name] for name in given} == pytest.approx(
        {name: spec.number(key) / MM for name, key in given.items()}, rel=1e-9
    )
    depth = (spec.number(cylinder + "bore") - spec.number("actuator.seal.groove_diameter")) / 2
    assert found["groove depth to the bore"] == pytest.approx(depth / MM)


def test_every_measure_is_drawn_once_and_ends_on_an_outline(whole: Assembly, drawn: Any) -> None:
    """A dimension whose points float beside the parts would mislead."""
    measures = [*whole.measures, *(measure for detail in whole.details for measure in detail.measures)]
    assert len(dimensions(drawn)) == len(measures)
    lines = shapely.union_all([section.face(part).boundary for part in whole.parts])
    for measure in measures:
        if measure.name == "stroke":  # to where the piston's face comes
            continue
        for point in (measure.start, measure.end):
            assert lines.distance(shapely.Point(point)) < 1e-9, measure.name


def test_what_is_shown_is_what_the_number_means(drawn: Any) -> None:
    """The text of the DIMENSION's own block, so that a reader which does not compute it shows the same."""
    texts = {
        entity.get_xdata(APPLICATION)[0].value: [
            part.dxf.text for part in entity.virtual_entities() if part.dxftype() == "TEXT"
        ] or [part.text for part in entity.virtual_entities() if part.dxftype() == "MTEXT"]
        for entity in drawn.modelspace().query("DIMENSION")
    }  # fmt: skip
    assert all(len(text) == 1 for text in texts.values())
    assert texts["stroke"] == ["stroke 152.4"]
    assert "14.3" in texts["bore"][0]
    assert texts["piston clearance"] == ["0.05"]  # of a detail, 10:1


def test_outlines_are_the_faces_that_the_model_has(whole: Assembly, drawn: Any) -> None:
    """Area of the closed outlines in the file against that of the parts' faces; millimetres, 1:1."""
    assert drawn.dxfversion == "AC1024"
    assert drawn.header["$INSUNITS"] == 4
    closed = [entity for entity in drawn.modelspace().query('LWPOLYLINE[layer=="OUTLINE"]') if entity.closed]
    areas = sum(shapely.Polygon([point[:2] for point in entity.get_points()]).area for entity in closed)
    assert areas == pytest.approx(sum(section.face(part).area for part in whole.parts) / MM**2, rel=1e-9)


def test_the_sheet_names_parts_materials_masses_and_program(spec: Spec, whole: Assembly, drawn: Any) -> None:
    texts = [entity.dxf.text for entity in drawn.modelspace().query("TEXT")]
    for word in ("PREHydrA", "O-ring", "NBR 70", "bleed screw", "A (10:1)"):
        assert word in texts
    assert any(text.startswith("fluxbore ") for text in texts)
    mass = f"{total(part_masses(whole, spec.materials)) * 1e3:.4g} g"
    assert {mass, "1:1", "A3", "PREHYDRA", "ISO 2768-mK", "1 of 1"} <= set(texts)
    layers = {entity.dxf.layer for entity in drawn.modelspace()}
    assert layers == {"OUTLINE", "EDGES", "HIDDEN", "CENTRE", "HATCH", "DIMENSIONS", "TEXT", "SHEET", "FRAME"}


def test_solid_bars_are_not_hatched(spec: Spec, whole: Assembly) -> None:
    """The rod is the only one; with it gone there are as many hatches as before."""
    assert whole.part("rod") in whole.parts
    others = tuple(part for part in whole.parts if part.name != "rod")
    texts = [dxf_text(Assembly("a", parts, 0.0), spec.materials) for parts in (whole.parts, others)]
    hatches = [len(read(text).modelspace().query("HATCH")) for text in texts]
    assert hatches[0] == hatches[1] > 0


@pytest.mark.parametrize("name", ["ipehla", "team22", "rotlin"])
def test_other_kinds_are_drawn_with_the_sizes_of_their_parts(name: str) -> None:
    other = load(EXAMPLES / f"{name}.toml")
    found = assembly_of(other)
    measures = overall(found.parts, 1.0)
    spans = {round(measure.length, 9) for measure in measures}
    points = [point for part in found.parts for point in part.profile]
    heights = [z for _, z in points]
    longest, widest = max(heights) - min(heights), 2 * max(points)[0]
    assert {round(longest, 9), round(widest, 9)} <= spans
    for measure in measures:
        assert all((abs(y), z) in points for z, y in (measure.start, measure.end)), measure.name
    document = read(dxf_text(found, other.materials))
    assert sorted(entity.get_measurement() for entity in document.modelspace().query("DIMENSION")) == pytest.approx(
        sorted(measure.length / MM for measure in measures)
    )


def test_arcs_that_the_plane_passes_by_are_in_the_list_alone() -> None:
    """An arc beside the plane has no face to bear a number; drawn alone it has its length and diameter."""
    arc = HelicalPart(
        "arc 1", "arc", "mover", "brass", (0.5, 0.5, 0.5), 10 * MM, 12 * MM,
        ((1.0, 0.0), (2.0, 0.0), (2.0, 5 * MM), (1.0, 5 * MM)),
    )  # fmt: skip
    assert section.face(arc).is_empty
    document = read(dxf_text(Assembly("arcs", (arc,), 0.0), standard()))
    assert "arc 1" in [entity.dxf.text for entity in document.modelspace().query("TEXT")]
    assert dimensions(document) == pytest.approx({"length, arc 1": 5.0, "diameter": 24.0})


def test_names_from_the_specification_stay_on_one_line() -> None:
    block = turned(rectangle(0.0, 5 * MM, 0.0, 30 * MM), name="tube\nwith a break Ø")
    texts = [entity.dxf.text for entity in read(dxf_text(Assembly("a\nb", (block,), 0.0), standard())).query("TEXT")]
    assert not any("\n" in text for text in texts)
    assert any("break Ø" in text for text in texts)


def test_the_command_writes_one_file_of_our_own(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "drawing"
    assert main(["export", str(EXAMPLES / "prehydra.toml"), "-o", str(folder), "--format", "dxf"]) == 0
    file = folder / "PREHydrA.dxf"
    assert capsys.readouterr().out.splitlines()[0] == str(file)
    assert read(file.read_text(encoding="utf-8")).modelspace()
    other = folder / "theirs.dxf"
    other.write_text("0\nSECTION\n", encoding="ascii")
    own_files.remove(folder)
    assert not file.exists()
    assert other.exists()


def test_the_page_tells_what_the_program_draws(spec: Spec, whole: Assembly, capsys: pytest.CaptureFixture[str]) -> None:
    """The parts list of docs/hydrostatic_cad.md, and the sentence that it quotes."""
    page = (EXAMPLES.parent / "docs" / "hydrostatic_cad.md").read_text(encoding="utf-8")
    for row in part_masses(whole, spec.materials):
        line = f"| {row.part.name} | {row.part.material} | {row.volume / MM**3:.1f} | {row.mass * 1e3:.2f} |"
        assert line in page
    assert f"In all {total(part_masses(whole, spec.materials)) * 1e3:.0f} g." in page
    short = ["--set", "actuator.output_cylinder.cap_length=10 mm"]
    assert main(["export", str(EXAMPLES / "prehydra.toml"), "-o", "x", "--format", "dxf", *short]) == 2
    assert capsys.readouterr().err.strip() in " ".join(page.replace("\n> ", " ").split())
