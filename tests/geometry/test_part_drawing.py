"""Drawings of single parts: all sizes told once, legible, and the same in DXF, SVG and PDF."""

import dataclasses
import io
import itertools
import math
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import ezdxf
import pypdf
import pytest
from drawing_checks import check_texts, check_told, read_back, told

from fluxbore.actuators import assembly_of
from fluxbore.cli import main
from fluxbore.design.errors import DesignError
from fluxbore.design.iso286 import limits
from fluxbore.design.materials import standard
from fluxbore.design.spec import load
from fluxbore.design.title_block import TitleBlock
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.drawing_set import drawing_set, made
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import AxialHole, AxisThread, Fit, Hole, Part
from fluxbore.geometry.part_dimensions import chamfers, diameters, hole_groups, levels
from fluxbore.geometry.part_drawing import part_sheet
from fluxbore.geometry.parts_list import Item, parts_list
from fluxbore.geometry.sheet import Dimension, Sheet, Stroke, texts_of
from fluxbore.geometry.sheet_dimension import spread
from fluxbore.geometry.sheet_dxf import dxf_text
from fluxbore.geometry.sheet_frame import SIZES
from fluxbore.geometry.sheet_pdf import pdf_bytes
from fluxbore.geometry.sheet_svg import svg_text
from fluxbore.geometry.sheet_text import fitted, text_width, wrapped

MM = 1e-3
EXAMPLES = Path(__file__).parents[2] / "examples"

BUSH = tuple(
    (r * MM, z * MM)
    for r, z in ((5, 10), (12, 10), (12, 21.5), (11.5, 22), (10, 22), (10, 24), (15, 24), (15, 40), (5, 40))
)
"""From z = 10 mm: a cylinder with a chamfer of 0.5 mm, a groove, a flange."""


def a_part(**changes: Any) -> Part:
    part = Part("bush", "bush", "stator", "brass", (0.5, 0.5, 0.5), BUSH)
    return dataclasses.replace(part, **changes)


def item_of(*parts: Any) -> Item:
    return parts_list(Assembly("a", parts, 0.0), standard())[0]


def sheet_of(*parts: Any) -> Sheet:
    return part_sheet(item_of(*parts), TitleBlock(), "bush")


def words(sheet: Sheet) -> list[str]:
    return [text.text for text in texts_of(sheet.items)]


def test_each_diameter_and_length_is_told_once_from_the_left_face() -> None:
    part = a_part()
    assert [2 * item.r / MM for item in diameters(part)] == pytest.approx([10, 20, 24, 30])
    assert [level.z / MM for level in levels(part)] == pytest.approx([22, 24, 40])
    (chamfer,) = chamfers(part)
    assert (chamfer.size, chamfer.count) == (pytest.approx(0.5 * MM), 1)
    sheet = sheet_of(part)
    sizes = told(sheet)
    assert sorted(size / MM for _, size in sizes.values()) == pytest.approx([0.5, 10, 12, 14, 20, 24, 30, 30])
    check_told(part, sizes)
    check_texts(sheet)
    assert {"Ø10", "Ø20", "Ø24", "Ø30", "12", "14", "30", "0.5×45°"} <= set(words(sheet))


def test_a_size_that_is_left_out_is_missed() -> None:
    """The check itself: without any one of the dimensions it complains."""
    part = a_part(holes=(Hole(30 * MM, 3 * MM, bottom=4 * MM),))
    sizes = told(sheet_of(part))
    for name in sizes:
        with pytest.raises(AssertionError):
            check_told(part, {other: size for other, size in sizes.items() if other != name})


def test_fits_are_shown_as_class_and_limits_where_their_size_is() -> None:
    fits = (Fit("bore", 10 * MM, "H8"), Fit("seat", 24 * MM, "f7"), Fit("pin", 4 * MM, "m6"))
    shown = words(sheet_of(a_part(fits=fits)))
    assert "Ø10 H8 (+0.022/0)" in shown
    assert "Ø24 f7 (-0.02/-0.041)" in shown
    assert "24" not in shown  # of no length
    assert "Pin: 4 m6 (+0.012/+0.004)." in shown  # no dimension has this size
    with pytest.raises(DesignError, match='got "Q8"'):
        sheet_of(a_part(fits=(Fit("bore", 10 * MM, "Q8"),)))


def test_a_thread_about_the_axis_is_told_where_its_diameter_is() -> None:
    """A bore of 6 mm with M6 in a note alone would be drilled to 6 mm, and no M6 could be cut."""
    assert "Ø10 thread M10" in words(sheet_of(a_part(axis_threads=(AxisThread(10 * MM, "M10"),))))


def test_every_thread_about_an_axis_has_a_diameter_of_its_part() -> None:
    found = {}
    for name in ("prehydra", "rotlin"):
        spec = load(f"examples/{name}.toml")
        whole = assembly_of(spec)
        for part in whole.parts:
            for cut in part.axis_threads if isinstance(part, Part) else ():
                found[part.role] = cut.thread
                assert any(abs(2 * item.r - cut.diameter) < 1e-9 for item in diameters(part)), part.name
    assert found == {"end cap": "M6", "rod": "M6 x 9.52", "translator end": "M8 x 16"}


def test_a_stack_of_magnets_and_rings_is_never_too_long() -> None:
    """Eight magnets with general tolerances would be up to 2 mm too long for the grooves of their snap rings."""
    spec = load("examples/ipehla.toml")
    whole = assembly_of(spec)
    stacked = [part for part in whole.parts if part.role in ("magnet", "ring", "half ring")]
    lengths = [fit for part in stacked if isinstance(part, Part) for fit in part.fits if fit.feature == "length"]
    assert sum(fit.nominal for fit in lengths) == pytest.approx(96 * MM)
    assert max(limits(fit.nominal, fit.tolerance)[1] for fit in lengths) == 0.0
    (magnet,) = [item for item in parts_list(whole, spec.materials) if item.name == "magnet"]
    assert "10.5 h9 (0/-0.043)" in words(part_sheet(magnet, whole.title, "magnet"))


def test_no_line_runs_through_the_text_of_a_narrow_fit() -> None:
    sheet = sheet_of(a_part(fits=(Fit("bore", 10 * MM, "H8"), Fit("seat", 24 * MM, "f7"))))
    dimensions = [item for item in sheet.items if isinstance(item, Dimension) and item.kind == "across"]
    assert any("H8" in item.shown.text for item in dimensions)
    for item in dimensions:
        left, low, right, high = item.shown.box
        for stroke in item.strokes:
            if isinstance(stroke, Stroke):
                (x0, y0), (x1, y1) = stroke.points[0], stroke.points[-1]
                across = min(x0, x1) < right - 1e-6 and max(x0, x1) > left + 1e-6
                assert not (across and low + 1e-6 < y0 < high - 1e-6 and low + 1e-6 < y1 < high - 1e-6), item.name


def test_drillings_stand_in_a_table_with_count_thread_and_pitch_circle() -> None:
    ports = tuple(Hole(32 * MM, 4.2 * MM, math.radians(angle), 9 * MM, "M5 x 6") for angle in (0, 120, 240))
    flange = tuple(AxialHole(13 * MM, 3.4 * MM, 24 * MM, 40 * MM, math.radians(angle)) for angle in (60, 180))
    blind = (AxialHole(8 * MM, 2.5 * MM, 30 * MM, 40 * MM, 0.0, "M3 x 8"),)
    part = a_part(holes=ports, axial_holes=(*flange, *blind))
    groups = hole_groups(part)
    assert [(group.letter, len(group.holes)) for group in groups] == [("A", 3), ("B", 2), ("C", 1)]
    assert groups[0].angles == "every 120° from 0°"
    assert [group.through for group in groups] == [False, True, False]
    sheet = sheet_of(part)
    check_told(part, told(sheet))
    check_texts(sheet)
    shown = words(sheet)
    table = {
        "M5 x 6",
        "M3 x 8",
        "Ø4.2",
        "Ø3.4",
        "Ø26",
        "Ø16",
        "all through",
        "10 deep, from the right",
        "60°, 180°, clockwise",
    }
    assert table <= set(shown)
    assert "9 from the axis, flat" in shown
    assert any(text.endswith(" A") for text in shown)  # its place among the lengths
    assert "Blind threads reach the floor: bottoming tap." in shown
    assert "Blind threads reach the floor: bottoming tap." not in words(sheet_of(a_part(axial_holes=flange)))


def test_pieces_that_are_bought_or_only_an_envelope_have_no_sheet() -> None:
    ring = rectangle(5 * MM, 8 * MM, 0.0, 3 * MM)
    parts = (
        a_part(name="bush 1"),
        a_part(name="bush 2"),
        a_part(name="ring", role="ring", profile=ring, bought="ring 10 x 16 x 3"),
        a_part(name="space", role="space", profile=ring, material=""),
    )
    whole = Assembly("a", parts, 0.0)
    items = parts_list(whole, standard())
    assert [made(item) for item in items] == [True, False, False]
    first, single = drawing_set(whole, items)
    assert [len(first), len(single)] == [1, 1]
    assert "2 pieces. Dimensions in mm. Lengths from the left face." in " ".join(words(single[0]))
    assert {"2 of 2", "DESIGN-001", "brass", "A"} <= set(words(single[0]))


def test_the_dxf_measures_what_the_model_has() -> None:
    """Sizes read back from the file by another reader, at a scale that is not 1."""
    part = a_part(holes=(Hole(30 * MM, 3 * MM, bottom=7 * MM), Hole(30 * MM, 3 * MM, 2.0, bottom=7 * MM)))
    sheet = sheet_of(part)
    assert sheet.scale != 1
    document = ezdxf.read(io.StringIO(dxf_text(sheet)))
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    sizes = read_back(document)
    assert len(sizes) == sum(isinstance(item, Dimension) for item in sheet.items)
    check_told(part, sizes)
    outline = next(iter(document.modelspace().query('LWPOLYLINE[layer=="OUTLINE"]')))
    corners = {(round(abs(y), 6), round(x, 6)) for x, y, *_ in outline.get_points()}
    assert {(12.0, 0.0), (15.0, 30.0)} <= corners  # 1:1 about the datum
    layout = document.layout("Sheet")
    assert (layout.dxf.paper_width, layout.dxf.paper_height) == SIZES[sheet.size]
    (window,) = [view for view in layout.query("VIEWPORT") if view.dxf.id != 1]
    assert window.dxf.height / window.dxf.view_height == pytest.approx(sheet.scale)


def test_svg_and_pdf_show_the_same_words_in_true_size() -> None:
    sheet = sheet_of(a_part(fits=(Fit("bore", 10 * MM, "H8"),), holes=(Hole(30 * MM, 3 * MM, bottom=7 * MM),)))
    root = ET.fromstring(svg_text(sheet))
    width, height = SIZES[sheet.size]
    assert (root.get("width"), root.get("height")) == (f"{width:g}mm", f"{height:g}mm")
    shown = [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")]
    assert sorted(text for text in shown if text) == sorted(words(sheet))
    reader = pypdf.PdfReader(io.BytesIO(pdf_bytes([sheet, sheet])))
    assert reader.metadata is not None
    assert "/CreationDate" not in reader.metadata  # nothing in it depends on the day
    pages = reader.pages
    assert len(pages) == 2
    box = pages[0].mediabox
    assert (float(box.width), float(box.height)) == pytest.approx((width / 25.4 * 72, height / 25.4 * 72), abs=0.1)
    text = "".join(pages[0].extract_text().split())
    for word in words(sheet):
        assert "".join(word.split()) in text
    assert not pages[0].images


def test_a_helical_magnet_has_its_envelope_width_lead_and_angle() -> None:
    arc = HelicalPart(
        "arc", "arc", "mover", "N42", (0.5, 0.5, 0.5), 10 * MM, 12 * MM,
        ((1.0, 0.0), (2.0, 1 * MM), (2.0, 5 * MM), (1.0, 4 * MM)), lead=2 * math.pi * MM,
    )  # fmt: skip
    sheet = sheet_of(arc)
    check_texts(sheet)
    sizes = {name: size / MM for name, (_, size) in told(sheet).items()}
    assert sizes == pytest.approx({"length": 5, "width": 4, "inner diameter": 20, "outer diameter": 24})
    assert "57.3°" in words(sheet)
    assert "lead 6.2832 mm" in " ".join(words(sheet))


@pytest.mark.parametrize("name", ["ipehla", "prehydra", "rotlin", "team22"])
def test_sheets_of_the_examples_are_legible_and_complete(name: str) -> None:
    spec = load(EXAMPLES / f"{name}.toml")
    whole = assembly_of(spec)
    items = parts_list(whole, spec.materials)
    first, parts = drawing_set(whole, items)
    for sheet in (*first, *parts):
        check_texts(sheet)
    for item, sheet in zip([item for item in items if made(item)], parts, strict=True):
        if isinstance(item.part, Part):
            check_told(item.part, told(sheet))


def test_places_are_spread_in_order_and_no_farther_than_need_be() -> None:
    assert spread([0.0, 10.0, 20.0], 4.0) == [0.0, 10.0, 20.0]
    assert spread([5.0, 5.0], 4.0) == pytest.approx([3.0, 7.0])
    found = spread([0.0, 1.0, 1.5, 30.0, 31.0], 4.0)
    assert all(b - a >= 4.0 - 1e-9 for a, b in itertools.pairwise(found))
    assert sum(found[:3]) == pytest.approx(2.5)  # a block stands about the mean of its wishes


def test_words_shrink_before_they_are_cut_and_break_at_spaces() -> None:
    assert fitted("short", 50.0, 2.5) == ("short", 2.5)
    text, size = fitted("a rather long word", 40.0, 3.5)
    assert text == "a rather long word"
    assert text_width(text, size) <= 40.0 + 1e-9
    text, size = fitted("a" * 200, 20.0, 2.5)
    assert text.endswith("...")
    assert text_width(text, size) <= 20.0
    for item in ("-001", "-002"):  # else all parts of a long number would be alike
        text, size = fitted("ACME-PNEUMATICS-2026-000417-B" + item, 20.0, 2.5)
        assert text.startswith("ACME")
        assert text.endswith("..." + item)
        assert text_width(text, size) <= 20.0
    assert wrapped("one two three", text_width("one two", 2.5), 2.5) == ["one two", "three"]


def test_the_command_writes_a_drawing_of_every_part(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--format", "dxf", "--format", "svg", "--format", "pdf"]
    assert main(["export", str(EXAMPLES / "team22.toml"), "-o", str(tmp_path / "x"), *words]) == 0
    capsys.readouterr()
    found = {str(path.relative_to(tmp_path / "x")) for path in (tmp_path / "x").rglob("*.*") if path.name[0] != "."}
    names = ("TEAM-22", "parts/coil-1", "parts/coil-2")
    assert found == {f"{name}.{ending}" for name in names for ending in ("dxf", "svg")} | {
        "TEAM-22.pdf",
        "journal.jsonl",
    }
