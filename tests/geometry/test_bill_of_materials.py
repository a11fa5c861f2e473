"""The bill of materials, read back by another reader of CSV; its sums are the masses that the figures use."""

import csv
import dataclasses
import io
from pathlib import Path

import pytest

from fluxbore.actuators import assembly_of
from fluxbore.cli import main
from fluxbore.design.materials import standard
from fluxbore.design.spec import load
from fluxbore.design.title_block import TitleBlock, title_block
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.bill_of_materials import HEAD, bill_of_materials
from fluxbore.geometry.file_names import file_name
from fluxbore.geometry.mass import part_masses, total
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Fit, Part
from fluxbore.geometry.parts_list import parts_list

MM = 1e-3
EXAMPLES = Path(__file__).parents[2] / "examples"


def rows_of(text: str) -> list[dict[str, str]]:
    assert text.count("\r\n") == text.count("\n")  # RFC 4180, 2.1
    return list(csv.DictReader(io.StringIO(text, newline="")))


@pytest.mark.parametrize("name", ["ipehla", "prehydra", "rotlin", "team22"])
def test_sums_are_the_masses_of_all_parts(name: str) -> None:
    spec = load(EXAMPLES / f"{name}.toml")
    whole = assembly_of(spec)
    rows = rows_of(bill_of_materials(whole, parts_list(whole, spec.materials)))
    masses = part_masses(whole, spec.materials)
    for group in ("mover", "stator"):
        found = sum(float(row["mass total (kg)"]) for row in rows if row["group"] == group)
        expected = total(masses, group) + (whole.carried_mass if group == "mover" else 0.0)
        assert found == pytest.approx(expected, rel=1e-9)
    assert sum(int(row["pieces"]) for row in rows if row["item"]) == len(whole.parts)
    numbers = [row["part number"] for row in rows if row["item"]]
    assert len(set(numbers)) == len(numbers)
    assert all(row["make or buy"] == ("buy" if row["designation"] else "make") for row in rows if row["item"])


def test_words_with_commas_quotes_and_breaks_stay_in_their_cells() -> None:
    block = rectangle(2 * MM, 5 * MM, 0.0, 30 * MM)
    parts = (
        Part('tube, "long"\nof two', "tube", "stator", "brass", (0.5, 0.5, 0.5), block, note="a, b",
             fits=(Fit("bore", 4 * MM, "H7"),)),
        Part("ring 1", "ring", "mover", "brass", (0.5, 0.5, 0.5), block, bought="DIN 471 - 8 x 0.8"),
    )  # fmt: skip
    whole = Assembly("a", parts, 0.0, carried_mass=0.25)
    first, second, carried = rows_of(bill_of_materials(whole, parts_list(whole, standard())))
    assert list(first) == list(HEAD)
    assert first["name"] == 'tube, "long"\\nof two'
    assert first["size"] == "Ø10 / Ø4 × 30 mm"
    assert first["note"] == "a, b; bore 4 H7"
    assert (first["make or buy"], first["drawing number"], first["revision"]) == ("make", "DESIGN-001", "A")
    assert (second["make or buy"], second["designation"], second["drawing number"]) == ("buy", "DIN 471 - 8 x 0.8", "")
    assert carried["name"] == "carried along, not drawn"
    assert float(carried["mass total (kg)"]) == 0.25


@pytest.mark.parametrize(
    ("name", "number"),
    [("Kühler 2", "KUEHLER-2"), ("Straße é", "STRASSE-E"), ("張三", "DESIGN"), ("a" * 30, "A" * 24)],
)
def test_a_number_made_from_the_name_keeps_its_letters(name: str, number: str) -> None:
    assert title_block({"actuator.name": name}).part_number == number


def test_what_only_some_pieces_are_is_told_with_their_number() -> None:
    block = rectangle(2 * MM, 5 * MM, 0.0, 3 * MM)
    one = Part("magnet 1", "magnet", "mover", "N48", (0.5, 0.5, 0.5), block, note="along +z")
    parts = [dataclasses.replace(one, name=f"magnet {i}", note=way) for i, way in enumerate(("+z", "-z", "+z"))]
    whole = Assembly("a", tuple(parts), 0.0)
    (row,) = rows_of(bill_of_materials(whole, parts_list(whole, standard())))
    assert row["note"] == "2 of 3: +z; 1 of 3: -z"


def test_no_file_is_a_device_to_windows() -> None:
    names = ("CON", "nul.x", "Com1", "console", "end cap, rod end")
    assert [file_name(name) for name in names] == ["_CON", "_nul.x", "_Com1", "console", "end-cap-rod-end"]


def test_no_word_is_a_formula_to_a_spreadsheet() -> None:
    block = rectangle(2 * MM, 5 * MM, 0.0, 30 * MM)
    parts = (Part("@SUM(A1)", "tube", "stator", "brass", (0.5, 0.5, 0.5), block, note="+1"),)
    whole = Assembly("a", parts, 0.0, title=TitleBlock(part_number='=HYPERLINK("x")', revision="-"))
    (row,) = rows_of(bill_of_materials(whole, parts_list(whole, standard())))
    assert row["part number"] == '\'=HYPERLINK("x")-001'
    assert (row["name"], row["revision"], row["note"]) == ("'@SUM(A1)", "'-", "'+1")


def test_the_command_writes_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(EXAMPLES / "team22.toml"), "-o", str(tmp_path / "x"), "--format", "bom"]) == 0
    file = Path(capsys.readouterr().out.strip())
    assert file.name == "TEAM-22-parts.csv"
    assert len(rows_of(file.read_bytes().decode())) == 2
