"""The page on benchmarks in simulated time: its commands, script and table run as they stand."""

import re
import shlex
import shutil
from pathlib import Path

import pytest

from fluxbore.cli import main

TOP = Path(__file__).parent.parent
PAGE = (TOP / "docs" / "simulate.md").read_text(encoding="utf-8")
NUMBER = r"-?[0-9]+(?:\.[0-9]+)?"


def blocks(language: str) -> list[str]:
    found = re.findall(r"^```(\w*)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    return [block for name, block in found if name == language]


COMMANDS = [line for block in blocks("") for line in block.splitlines() if line.startswith("fluxbore ")]


@pytest.fixture
def newcomer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(TOP / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_first_command_prints_what_the_page_quotes(newcomer, capsys):
    """Catches words that the program no longer prints, and figures that have moved since the page was written."""
    assert main(shlex.split(COMMANDS[0])[1:]) == 0
    printed = capsys.readouterr().out.splitlines()
    (quoted,) = (block.splitlines() for block in blocks("text"))
    assert [re.sub(NUMBER, "#", line).split() for line in quoted] == [
        re.sub(NUMBER, "#", line).split() for line in printed[: len(quoted)]
    ]
    for ours, theirs in zip(quoted[3:], printed[3:], strict=False):
        measured, told = ([float(found) for found in re.findall(NUMBER, line)] for line in (theirs, ours))
        assert told == pytest.approx(measured, rel=1e-3, abs=1.5e-3), ours


@pytest.mark.full
def test_every_command_runs_and_the_table_of_designs_holds(newcomer, capsys):
    """Catches a comparison of designs whose numbers are no longer the program's."""
    for command in COMMANDS[1:]:
        assert main(shlex.split(command)[1:]) == 0, command
    printed = capsys.readouterr().out
    for label in ("P-N", "P-P", "P-E"):
        (row,) = re.findall(rf"^\| (?:median error, )?{label} \|(.*)\|$", PAGE, re.MULTILINE)
        told = [float(value) for value in re.findall(NUMBER, row)]
        (line,) = re.findall(
            rf"^median RMSE, {label} +({NUMBER}) N +({NUMBER}) N +({NUMBER}) N$", printed, re.MULTILINE
        )
        assert told == pytest.approx([float(value) for value in line], abs=0.003), label
    assert all(Path("mcfc", name).exists() for name in re.findall(r"^\| `mcfc/([\w.]+)`", PAGE, re.MULTILINE))


@pytest.mark.full
def test_the_script_runs(newcomer, capsys):
    for block in blocks("python"):
        exec(compile(block, "simulate.md", "exec"), {})
    assert "'P-E': 1.2" in capsys.readouterr().out
