"""Logs of a lead screw's encoders from CSV: even time, or one sentence."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.dynamics.motion_log import read_motion_log
from fluxbore.design.errors import FluxboreError

HEAD = "time [ms], angle [deg], position [mm]"


def test_a_log_in_its_units(tmp_path: Path) -> None:
    """And a load cell where there is one; other columns are left alone."""
    file = tmp_path / "log.csv"
    file.write_text("position [mm], note, time [ms], angle [deg], force [N]\n0,1,5,0,1\n1,1,5.1,180,2\n2,1,5.2,720,3\n")
    log = read_motion_log(file)
    assert log.period == pytest.approx(1e-4)
    assert log.angle == pytest.approx([0.0, np.pi, 4 * np.pi])
    assert log.position == pytest.approx([0.0, 1e-3, 2e-3])
    assert log.force is not None
    assert log.force == pytest.approx([1.0, 2.0, 3.0])
    assert log.source == "log.csv"


def test_without_a_load_cell(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    file.write_text(f"{HEAD}\n0,0,0\n0.1,1,0\n0.2,2,0\n")
    assert read_motion_log(file).force is None


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ("0,0,0\n0.1,1,0\n0.2,2,0\n0.4,3,0\n0.5,4,0\n", "line 5: time must rise by 0.0001 s as elsewhere, within 10 %"),
        ("0,0,0\n0.2,1,0\n0.1,2,0\n", "line 4: time must rise from row to row; got 0.0001 s after 0.0002 s"),
        ("0,0,0\n0.1,1,0\n0.1,2,0\n", "line 4: time must rise from row to row"),
        ("0,0,0\n0.1,nan,0\n0.2,2,0\n", 'line 3: angle must hold finite numbers; got "nan"'),
        ("0,0,0\n0.1,,0\n0.2,2,0\n", "line 3: angle must hold finite numbers; got an empty cell"),
        ("0,0,0\n0.1,1\n0.2,2,0\n", "line 3: a row must have the header's 3 columns; got 2"),
        ("0,0,0\n0.1,1,0\n", "must have 3 rows or more below its header; got 2"),
    ],
)
def test_gaps_nan_and_unsorted_time(tmp_path: Path, rows: str, words: str) -> None:
    """One sentence with file, line, limit and value."""
    file = tmp_path / "log.csv"
    file.write_text(f"{HEAD}\n{rows}")
    with pytest.raises(FluxboreError) as raised:
        read_motion_log(file)
    text = str(raised.value)
    assert words in text
    assert text.startswith("log.csv")
    assert text.endswith(".")
    assert "\n" not in text
