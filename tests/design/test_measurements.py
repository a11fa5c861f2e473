"""Reading measured data: what is accepted, and one sentence for whatever is not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluxbore.design import measurements
from fluxbore.design.errors import MeasurementError
from fluxbore.design.measurements import Column, parse_measurements, read_measurements
from fluxbore.design.units import STANDARD_ATMOSPHERE

COLUMNS = (Column("velocity", "speed"), Column("pressure", "pressure", 0.0), Column("force", "force", -1e6, 1e6))
GOOD = "velocity [mm/s],pressure [MPa gauge],force [N]\n1,0.1,2\n-2,0.2,-3\n"


def parse(text: str, **options: int) -> measurements.Measurements:
    return parse_measurements(text, "m.csv", COLUMNS, optional=(Column("run", None),), **options)


def test_units_are_taken_to_si() -> None:
    found = parse(GOOD)
    assert found["velocity"] == pytest.approx([1e-3, -2e-3])
    assert found["pressure"] == pytest.approx([1e5, 2e5])
    assert found["force"].tolist() == [2.0, -3.0]
    assert found.lines.tolist() == [2, 3]
    assert len(found) == 2
    assert "run" not in found


@pytest.mark.parametrize(
    "text",
    [
        "force,velocity,pressure\n2,1e-3,1e5\n-3,-2e-3,2e5\n",  # another order, SI
        "velocity [mm/s];pressure [MPa gauge];force [N]\n1;0.1;2\n-2;0.2;-3\n",
        "\ufeff" + GOOD,
        GOOD.replace("\n", "\r\n"),
        GOOD.replace("\n", "\r"),
        "# from the bench\n\n" + GOOD.replace("\n-2", "\n  # and back\n\n-2"),
        'Velocity [mm/s] , "pressure [MPa gauge]", FORCE [N], note\n 1 ,"0.1",2,slow\n-2.0,.2,-3e0,fast\n',
        "velocity [mm/s],pressure [kPa  gauge],force [mN]\n1,100,2000\n-2,200,-3000\n",
    ],
)
def test_ways_to_write_the_same_table(text: str, tmp_path: Path) -> None:
    """Separators, line ends, the byte-order mark, comments, quotes, and columns that nobody asked for."""
    path = tmp_path / "m.csv"
    path.write_bytes(text.encode())
    found = read_measurements(path, COLUMNS)
    assert found.source == "m.csv"
    for name, values in (("velocity", [1e-3, -2e-3]), ("pressure", [1e5, 2e5]), ("force", [2.0, -3.0])):
        assert found[name] == pytest.approx(values, rel=1e-12)


def test_absolute_pressure_becomes_gauge() -> None:
    found = parse("velocity,pressure [bar absolute],force\n1,2,3\n")
    assert found["pressure"] == pytest.approx([2e5 - STANDARD_ATMOSPHERE])


def test_an_optional_column_is_read_where_it_stands() -> None:
    found = parse("velocity,pressure,force,run\n1,2,3,7\n")
    assert found["run"].tolist() == [7.0]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "m.csv must begin with a header of its columns, velocity, pressure, force; got an empty table."),
        ("# nothing\n\n", "m.csv must begin with a header of its columns, velocity, pressure, force; got an empty"),
        (GOOD + "nan,0.1,2\n", 'm.csv, line 4: velocity must hold finite numbers; got "nan".'),
        (GOOD + "1,0.1,NaN\n", 'm.csv, line 4: force must hold finite numbers; got "NaN".'),
        (GOOD + "1,0.1,inf\n", 'm.csv, line 4: force must hold finite numbers; got "inf".'),
        (GOOD + "1,0.1,1e999\n", 'm.csv, line 4: force must hold finite numbers; got "1e999".'),
        (GOOD + "1,0.1,\n", "m.csv, line 4: force must hold finite numbers; got an empty cell."),
        (GOOD + "1,0.1,1_0\n", 'm.csv, line 4: force must hold finite numbers; got "1_0".'),
        (GOOD + "1,0.1,٣\n", 'm.csv, line 4: force must hold finite numbers; got "٣".'),
        (GOOD + "1,0.1,slow\n", 'm.csv, line 4: force must hold finite numbers; got "slow".'),
        (
            "velocity;pressure;force\n0,5;1;2\n",
            'm.csv, line 2: velocity must hold finite numbers; got "0,5" (the decimal sign is a point).',
        ),
        (GOOD + "1,0.1\n", "m.csv, line 4: a row must have the header's 3 columns; got 2."),
        (GOOD + "1,0.1,2,3\n", "m.csv, line 4: a row must have the header's 3 columns; got 4."),
        (GOOD + "1,-0.1,2\n", "m.csv, line 4: pressure must be 0 MPa gauge or above; got -0.1 MPa gauge."),
        (GOOD + "1,0.1,1000001\n", "m.csv, line 4: force must be 1e+06 N or below; got 1e+06 N."),
        (GOOD + "1,0.1,-2e6\n", "m.csv, line 4: force must be -1e+06 N or above; got -2e+06 N."),
        (GOOD + '1,"0.1,2\n', "m.csv, line 4: a row must be cells as CSV writes them; got unexpected end of data."),
        (
            "velocity,pressure\n1,2\n",
            'm.csv, line 1: the column force must be there; got "velocity", "pressure".',
        ),
        (
            "velocity (mm/s),pressure,force\n1,2,3\n",
            'must be there; got "velocity (mm/s)", "pressure", "force" (units stand in square brackets).',
        ),
        ("1,2,3\n4,5,6\n", 'm.csv, line 1: the column velocity must be there; got "1", "2", "3".'),
        (
            "velocity,pressure [MPa],force\n1,2,3\n",
            'got "MPa" (say "MPa gauge" or "MPa absolute").',
        ),
        (
            "velocity [knots],pressure,force\n1,2,3\n",
            'm.csv, line 1: velocity must be in a unit of m/s, mm/s; got "knots".',
        ),
        ("velocity,pressure,force,run [N]\n1,2,3,4\n", 'm.csv, line 1: run must be without a unit; got "N".'),
        ("velocity,pressure,force,Force\n1,2,3,4\n", "m.csv, line 1: force must be one column; got two."),
        (
            "velocity [mm/s] x,pressure,force\n1,2,3\n",
            'm.csv, line 1: a column must be named like "force [N]"; got "velocity [mm/s] x".',
        ),
        (GOOD + "1," + "0" * 100_001 + ",2\n", "m.csv, line 4: a line must have at most 100000 characters"),
    ],
)
def test_what_is_refused(text: str, sentence: str) -> None:
    with pytest.raises(MeasurementError) as caught:
        parse(text)
    assert sentence in str(caught.value)
    assert str(caught.value).endswith(".")


def test_too_few_rows() -> None:
    with pytest.raises(MeasurementError, match=r"^m\.csv must have 3 rows or more below its header; got 2\.$"):
        parse(GOOD, least_rows=3)


def test_files_that_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for path in (tmp_path / "none.csv", tmp_path, Path("with\0nul.csv")):
        with pytest.raises(MeasurementError, match=r" cannot be read: .+\.$"):
            read_measurements(path, COLUMNS)
    wrong = tmp_path / "m.csv"
    wrong.write_bytes(GOOD.encode() + b"1,0.1,\xff\n")
    with pytest.raises(MeasurementError, match=r"^m\.csv, line 4: a table must be UTF-8 text"):
        read_measurements(wrong, COLUMNS)
    monkeypatch.setattr(measurements, "LARGEST_FILE", 10)
    with pytest.raises(MeasurementError, match=r"^m\.csv must be at most 0 MB; it is larger\.$"):
        read_measurements(wrong, COLUMNS)


@given(rows=st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 3), min_size=1, max_size=10))
def test_what_was_written_is_read(rows: list[tuple[float, float, float]]) -> None:
    columns = [Column(name, "force") for name in "abc"]
    text = "a,b,c\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows)
    found = parse_measurements(text, "m.csv", columns)
    assert np.stack([found[name] for name in "abc"], axis=1).tolist() == [list(row) for row in rows]


@given(raw=st.binary(max_size=200), header=st.booleans())
def test_any_bytes_are_a_table_or_one_sentence(
    raw: bytes, header: bool, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.getbasetemp() / "fuzz.csv"
    path.write_bytes((GOOD.encode() if header else b"") + raw)
    _table_or_sentence(path)


@given(raw=st.text(alphabet="0123456789.,;-+eE#\"'[]\n\r \t\x00\x0b\u2028naN/velocitypressureforce", max_size=200))
def test_anything_like_a_table_is_one_or_one_sentence(raw: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.getbasetemp() / "fuzz.csv"
    path.write_text("velocity,pressure,force\n" + raw, encoding="utf-8", newline="")
    _table_or_sentence(path)


def _table_or_sentence(path: Path) -> None:
    try:
        found = read_measurements(path, COLUMNS)
    except MeasurementError as error:
        sentence = str(error)
    else:
        assert len(found) >= 1
        assert all(np.all(np.isfinite(found[column.name])) for column in COLUMNS)
        return
    assert sentence.endswith(".")
    assert sentence.isprintable()
    assert len(sentence) < 600
