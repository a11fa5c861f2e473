"""B-H curves: the guard lets every physical table through and names the row of any other."""

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design.bh_curve import MU_0, BHCurve, from_points, read_csv
from fluxbore.design.errors import MaterialError


@st.composite
def tables(draw: st.DrawFn) -> tuple[list[float], list[float]]:
    """Tables of 2 to 12 points that rise at least as steeply as the vacuum, without the origin."""
    count = draw(st.integers(2, 12))
    steps = st.tuples(st.floats(1.0, 1e5), st.floats(1.0, 5000.0))
    b, h = [0.0], [0.0]
    for field, permeability in draw(st.lists(steps, min_size=count, max_size=count)):
        h.append(h[-1] + field)
        b.append(b[-1] + MU_0 * permeability * field)
    return b[1:], h[1:]


@given(tables())
def test_every_table_that_rises_like_a_material_is_taken(table: tuple[list[float], list[float]]) -> None:
    """Catches a guard that turns good measurements away, or one that drops or moves a point."""
    b, h = table
    curve = BHCurve("x", tuple(b), tuple(h), "made up")
    assert curve.b == (0.0, *b)
    assert curve.h == (0.0, *h)
    assert BHCurve("x", curve.b, curve.h, "made up") == curve


@given(tables(), st.data(), st.sampled_from(["b", "h"]), st.booleans())
def test_a_point_at_or_below_the_one_before_is_named(
    table: tuple[list[float], list[float]], data: st.DataObject, which: str, from_origin: bool
) -> None:
    """Catches a guard that looks only at one column, at neighbours in one direction, or that miscounts the rows."""
    b, h = ([0.0, *column] if from_origin else column for column in table)
    row = data.draw(st.integers(1, len(b) - 1))
    share = data.draw(st.floats(0.0, 1.0))
    column = b if which == "b" else h
    column[row] = share * column[row - 1]
    with pytest.raises(MaterialError, match=rf'^B-H curve "x" row {row + 1} must exceed both') as caught:
        BHCurve("x", tuple(b), tuple(h), "made up")
    assert str(caught.value).endswith(f"got B = {b[row]:.6g} T, H = {h[row]:.6g} A/m.")


@given(tables(), st.floats(0.01, 0.99), st.booleans())
def test_a_segment_flatter_than_the_vacuum_is_refused(
    table: tuple[list[float], list[float]], permeability: float, from_origin: bool
) -> None:
    """Catches a table in the wrong unit (kA/m or gauss), monotone yet no material's; with and without the origin."""
    b, h = ([0.0, *column] if from_origin else column for column in table)
    b.append(b[-1] + MU_0 * permeability * 1e4)
    h.append(h[-1] + 1e4)
    with pytest.raises(MaterialError, match=rf"row {len(b)} must rise .* as steeply as the vacuum"):
        BHCurve("x", tuple(b), tuple(h), "made up")


def test_rounding_of_the_last_digit_is_forgiven() -> None:
    """Catches a guard so exact that the published table of 1010 steel, 0.99988 mu_0 at its end, is turned away."""
    curve = BHCurve("x", (1.0, 2.3243, 2.4712), (500.0, 199890.0, 316804.0), "1010, last points")
    assert (curve.b[3] - curve.b[2]) / (curve.h[3] - curve.h[2]) < MU_0


@pytest.mark.parametrize(
    ("b", "h", "sentence"),
    [
        ((0.0, 1.0), (0.0, 100.0), "at least three points with the origin; got 2"),
        ((), (), "at least three points"),
        ((1.0, 1.5), (100.0,), "one H to each B; got 2 B and 1 H"),
        ((-0.1, 1.0, 1.5), (10.0, 100.0, 900.0), "row 1 must start at the origin or above"),
        ((0.1, math.nan, 1.5), (10.0, 100.0, 900.0), "row 2 must be finite; got B = nan T, H = 100 A/m"),
        ((0.1, 1.0, 1.5), (10.0, 100.0, math.inf), "row 3 must be finite"),
        ((0.0, 1.0, 1.5), (10.0, 100.0, 900.0), "row 1 must exceed both"),
    ],
)
def test_tables_without_a_meaning_are_refused(b: tuple[float, ...], h: tuple[float, ...], sentence: str) -> None:
    """Catches a NaN, a remanent start or a lone point that would reach the Newton iteration."""
    with pytest.raises(MaterialError, match=sentence):
        BHCurve("x", b, h, "made up")


def test_maximum_permeability_and_saturation_of_a_known_curve() -> None:
    """Catches mu_0 taken twice or not at all: mu_r 1000 to 1 T, then a polarisation of 2 T exactly."""
    curve = BHCurve("x", (1.0, 2.0 + MU_0 * 1e5), (1.0 / (1000 * MU_0), 1e5), "made up")
    assert curve.maximum_permeability == pytest.approx(1000.0, rel=1e-12)
    assert curve.saturation == pytest.approx(2.0, rel=1e-12)


@pytest.mark.parametrize("row", [[1.0], [1.0, 2.0, 3.0], [1.0, "100 A/m"], "1.0, 100", [True, 100.0]])
def test_a_row_that_is_no_pair_of_numbers_is_named_with_its_key(row: object) -> None:
    """Catches a row that would be cut short, or read with a unit nobody parsed."""
    with pytest.raises(MaterialError, match=r"^materials\.my\.bh must hold pairs .* row 2 is "):
        from_points("my", [[0.5, 50.0], row, [1.5, 900.0]], "made up", "materials.my.bh")


def test_a_broken_law_in_a_specification_names_its_key() -> None:
    """Catches a sentence that leaves the user to search which table is meant."""
    with pytest.raises(MaterialError, match=r"^materials\.my\.bh row 2 must exceed both B = 0\.5 T, H = 50 A/m"):
        from_points("my", [[0.5, 50.0], [0.4, 60.0]], "made up", "materials.my.bh")


@pytest.mark.parametrize(
    "text",
    [
        "0.5,50\n1.0,100\n1.5,900\n",
        "B (T), H (A/m)\n0.5, 50\n\n# knee\n1.0, 100\n1.5, 900",
        "\ufeffB;H\r\n0.5;50\r\n1.0;100\r\n1.5;900\r\n",
    ],
)
def test_text_files_as_people_and_spreadsheets_write_them_are_read(tmp_path: Path, text: str) -> None:
    """Catches a reader that stumbles over a heading, a remark, a semicolon or a byte-order mark."""
    path = tmp_path / "iron.csv"
    path.write_text(text, encoding="utf-8", newline="")
    curve = read_csv("my", path, "made up", "materials.my.bh_file")
    assert curve.b == (0.0, 0.5, 1.0, 1.5)
    assert curve.h == (0.0, 50.0, 100.0, 900.0)


def test_files_that_cannot_be_read_are_named(tmp_path: Path) -> None:
    """Catches a traceback for a missing file, a folder, bytes that are no text, or a stray word in the middle."""
    key = "materials.my.bh_file"
    with pytest.raises(MaterialError, match=r"^materials\.my\.bh_file must name a file .*none\.csv"):
        read_csv("my", tmp_path / "none.csv", "", key)
    with pytest.raises(MaterialError, match="must name a file"):
        read_csv("my", tmp_path, "", key)
    (tmp_path / "bytes.csv").write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(MaterialError, match="UTF-8"):
        read_csv("my", tmp_path / "bytes.csv", "", key)
    (tmp_path / "words.csv").write_text("B,H\n0.5,50\nknee\n1.5,900\n", encoding="utf-8")
    with pytest.raises(MaterialError, match=r'line 3 of ".*words\.csv" is "knee"'):
        read_csv("my", tmp_path / "words.csv", "", key)
    (tmp_path / "empty.csv").write_text("", encoding="utf-8")
    with pytest.raises(MaterialError, match=r"materials\.my\.bh_file .*at least three points"):
        read_csv("my", tmp_path / "empty.csv", "", key)
