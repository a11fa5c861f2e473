"""The page on force estimation: its script runs, its numbers are the validation's, its files are there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

TOP = Path(__file__).parent.parent
PAGE = (TOP / "docs" / "force_estimation.md").read_text(encoding="utf-8")
TABLES = (TOP / "docs" / "validation" / "force_estimation.md").read_text(encoding="utf-8")


def cells(start: str) -> list[str]:
    """Of the row of the validation's tables that begins with these words."""
    row = next(line for line in TABLES.splitlines() if line.startswith(f"| {start} |"))
    return [cell.strip() for cell in row.strip("|").split("|")][1:]


def test_the_script_runs(capsys: pytest.CaptureFixture[str]) -> None:
    """Sample by sample as over the log: it prints so."""
    script = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    assert len(script) == 1
    exec(compile(script[0], "force_estimation.md", "exec"), {})
    assert capsys.readouterr().out == "True\n"


def test_the_numbers_are_those_of_the_tables() -> None:
    """Words on the page that the tables have left behind."""
    text = " ".join(PAGE.split())
    ratios = [cells(f"{number}, {force} N")[3].split(" (")[0] for number, force in ((1, 45), (2, 85), (3, 165))]
    assert f"{ratios[0].removesuffix(' %')}, {ratios[1].removesuffix(' %')} and {ratios[2]}" in text
    second, third = (cells(name)[1].split(" ")[0] for name in ("2, 85 N", "3, 165 N"))
    assert f"Polynomial in experiments 2 and 3: {second} and {third} N" in text
    assert f"{float(cells('3, 165 N')[0].split(' ')[0]):.1f} N, where Table III says 7.23 N" in text
    assert f"at a peak of 147.5 N it gives {float(cells('147.5 N')[0]):.1f} N" in text
    play = cells("with a play of 1 um before the memory")[2]
    assert f"from {cells('as above')[2]} to {play} N" in text
    bare = [float(value) for value in cells("encoders without counts")]
    assert 0.2 <= min(bare) <= max(bare) <= 0.35


def test_the_files_it_names_are_there() -> None:
    names = re.findall(r"`(design/\S+?\.py)`", PAGE)
    assert len(names) >= 5
    assert [name for name in names if not (TOP / name).exists()] == []
