"""The tutorial on electro-hydrostatic actuators: quick commands, script and numbers; `tests/full` runs all of it."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

import fluxbore
from fluxbore.cli import main

TOP = Path(__file__).parent.parent
PAGE = (TOP / "docs" / "hydrostatic_tutorial.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
COMMANDS = [line for language, block in BLOCKS if not language for line in block.splitlines()]
SLOW = ("report", "design", "simulate")


@pytest.fixture
def newcomer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Path:
    """A folder with the specification that the page's first line writes."""
    monkeypatch.chdir(tmp_path)
    run(COMMANDS[0], tmp_path, capsys)
    return tmp_path


def run(command: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One line of the page; what it quotes of a failed design must be what is printed."""
    line, _, target = command.partition(" > ")
    words = shlex.split(line)[1:]
    studied = ("--workers", "1", "--quiet") if words[0] in ("design", "simulate") else ()
    status = main([*words, *studied])
    output = capsys.readouterr()
    if target:
        (folder / target).write_text(output.out, encoding="utf-8")
    if "300 N" in command:
        assert status == 3
        assert " ".join(output.out.split()) in " ".join(PAGE.replace("\n> ", " ").split())
    elif words[0] == "report":  # the prototype's rod breaks the study's limit
        assert status == 3
        assert "buckling_safety >= 3 is not met." in output.out
    else:
        assert status == 0, (command, output.err)


def test_the_quick_commands_run(newcomer: Path, capsys: pytest.CaptureFixture[str]) -> None:
    quick = [command for command in COMMANDS if command.split()[1] not in SLOW]
    assert len(quick) >= 8
    assert all(command.startswith("fluxbore ") for command in COMMANDS)
    for command in quick:
        run(command, newcomer, capsys)


def test_what_the_page_says_of_the_prototype() -> None:
    """A number of the text or of the table that the closed forms no longer give."""
    spec = fluxbore.load(TOP / "examples" / "prehydra.toml")
    figures = fluxbore.evaluate(spec, "network").performance
    rows = {row[0]: row[1] for row in re.findall(r"^\| ([^|]+) \| ([^|]+) \| [^|]+ \|$", PAGE, re.MULTILINE)}
    assert rows["output cylinder"] == f"{figures.output_cylinder_mass * 1e3:.1f} g"
    assert rows["mass at the joint"] == f"{figures.distal_mass * 1e3:.1f} g"
    assert rows["rod as a column, factor"] == f"{figures.buckling_safety:.2f}"
    assert f"gives {figures.force_at_rated_pressure:.0f} N at its rated pressure" in PAGE
    fast = fluxbore.evaluate(spec.with_values({"operating_point.frequency": 5.0}), "network").performance
    assert f"at 5 Hz 50 N ask for {100 * fast.speed_load:.0f} % of the speed" in PAGE


def test_its_script_runs(newcomer: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A narrower cylinder is lighter, and its pressure higher."""
    (script,) = (block for language, block in BLOCKS if language == "python")
    exec(compile(script, "hydrostatic_tutorial.md", "exec"), {})
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert [row[0] for row in rows] == ["10", "12", "14"]
    masses, pressures = ([float(row[column]) for row in rows] for column in (2, 3))
    assert masses == sorted(masses)
    assert pressures == sorted(pressures, reverse=True)
