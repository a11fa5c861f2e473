"""results.csv, results.parquet: exact numbers, nothing for what is not known, whole lines whatever a reason holds."""

import csv
import io
import sys

import pytest
import toy
from pyarrow import parquet

from fluxbore.design.errors import MissingLibraryError
from fluxbore.design.performance import FIGURES
from fluxbore.optimize.executor import SerialExecutor
from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.parquet import results_parquet
from fluxbore.optimize.sweep import run_sweeps
from fluxbore.optimize.table import results_table


def test_the_table_is_exact_and_whole():
    """Catches rounded numbers, "None", line breaks inside a row, and a key's column that is empty or wrong."""
    spec = toy.two_sweeps()
    results = run_sweeps(spec, None, SerialExecutor(), evaluate=toy.plain)
    text = results_table(spec, results)
    rows = list(csv.reader(io.StringIO(text)))
    assert rows[0] == [toy.X, toy.Y, toy.N, *FIGURES, "status", "reason"]
    assert len(rows) == 1 + 25 + 4 == text.count("\n")
    made = [row for result in results for row in result.rows]
    for line, row in zip(rows[1:], made, strict=True):
        cells = dict(zip(rows[0], line, strict=True))
        force = row.evaluation.performance.force_constant
        assert cells["force_constant"] == ("" if force is None else repr(force))
        assert cells["motor_constant"] == ""
        assert cells["status"] == row.evaluation.status
        values = {toy.X: 1.0, toy.Y: 1.0, toy.N: 1, **row.values}
        assert [cells[key] for key in values] == [repr(value) for value in values.values()]
    assert 'No convergence at x = 5.0, "y" = 2.5; the last residual is 0.1.' in [line[-1] for line in rows]


def test_a_searchs_designs_follow_the_sweeps():
    spec = toy.spec()
    evaluation = toy.plain(spec)
    text = results_table(spec, (), [Candidate({toy.X: 0.1}, evaluation, 1.0, ())])
    assert text.startswith(f"{toy.X},force_constant,")
    assert text.splitlines()[1].startswith(f"0.1,{evaluation.performance.force_constant!r},")


def study():
    """The toy's sweeps and one design of a search, whose key no sweep moves."""
    spec = toy.two_sweeps()
    results = run_sweeps(spec, None, SerialExecutor(), evaluate=toy.plain)
    return spec, results, [Candidate({toy.X: 0.1}, toy.plain(toy.spec(x=0.1)), 1.0, ())]


def test_the_parquet_file_holds_the_same_rows():
    """Catches a row, a digit or an order in which the two files differ, and a null that is not an empty cell."""
    content = results_parquet(*study())
    lines = list(csv.reader(io.StringIO(results_table(*study()))))
    table = parquet.read_table(io.BytesIO(content))
    assert table.column_names == lines[0]
    found = list(zip(*(column.to_pylist() for column in table.columns), strict=True))
    assert len(found) == len(lines) - 1 == 25 + 4 + 1
    for row, line in zip(found, lines[1:], strict=True):
        numbers = [None if cell == "" else float(cell) for cell in line[:-2]]
        assert list(row) == [*numbers, *line[-2:]]


def test_the_parquet_file_names_units_and_types():
    """Catches a column that turns to text where it is empty, and numbers whose unit nobody knows."""
    schema = parquet.read_schema(io.BytesIO(results_parquet(*study())))
    for name in (toy.X, *FIGURES):
        assert str(schema.field(name).type) == "double"
    assert [str(schema.field(name).type) for name in ("status", "reason")] == ["string", "string"]
    assert schema.field("force_constant").metadata[b"unit"] == b"N/A"
    assert schema.field(toy.X).metadata[b"unit"] == b"m"
    assert schema.field(toy.N).metadata[b"unit"] == b"1"
    assert b"thrust per ampere" in schema.field("force_constant").metadata[b"description"]
    assert schema.metadata[b"specification"].decode() == toy.two_sweeps().fingerprint()


def test_the_same_rows_are_the_same_bytes():
    """Catches a time, a path or a thread's order in the file, by which no two runs could be compared."""
    assert results_parquet(*study()) == results_parquet(*study())
    assert results_parquet(toy.spec(), ()) == results_parquet(toy.spec(), ())


def test_without_pyarrow_one_sentence_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(MissingLibraryError, match=r"^results\.parquet needs pyarrow .*pip install pyarrow$"):
        results_parquet(toy.spec(), ())
