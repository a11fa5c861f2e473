"""The lead screw's tutorial from end to end, and its study's optimum against a grid around it (-m full)."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

from test_lead_screw_tutorial import COMMANDS, TOP, run

pytestmark = pytest.mark.full


def test_every_command_of_the_tutorial_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(TOP / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    for command in COMMANDS:
        run(command, tmp_path, capsys)
    assert (tmp_path / "best" / "results.csv").exists()
