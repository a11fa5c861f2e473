"""The tutorial on lead screws: its quick commands and its table; `tests/full` runs all of it."""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import pytest

import fluxbore
from fluxbore.cli import main

TOP = Path(__file__).parent.parent
PAGE = (TOP / "docs" / "lead_screw_tutorial.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
COMMANDS = [line for language, block in BLOCKS if not language for line in block.splitlines()]
SLOW = ("optimize", "pareto", "tolerance")


@pytest.fixture
def newcomer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the examples, which is where a reader of the page stands."""
    (tmp_path / "examples").mkdir()
    for path in (TOP / "examples").glob("rotlin*.toml"):
        shutil.copy(path, tmp_path / "examples" / path.name)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(command: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One line of the page; what it quotes of an error must be what is printed."""
    line, _, target = command.partition(" > ")
    words = shlex.split(line)[1:]
    # In this process: others would take longer to start than they save.
    studied = words[0] in (*SLOW, "sweep")
    status = main([*words, *(("--workers", "1", "--quiet") if studied else ())])
    output = capsys.readouterr()
    if target:
        (folder / target).write_text(output.out, encoding="utf-8")
    if "gap_tolerance" in command:
        assert status == 2
        assert output.err.strip() in " ".join(PAGE.replace("\n> ", " ").split())
    else:
        assert status in (0, 3) if "max_evaluations" in command else status == 0, (command, output.err)


def test_the_quick_commands_run(newcomer: Path, capsys: pytest.CaptureFixture[str]) -> None:
    quick = [command for command in COMMANDS if command.split()[1] not in SLOW]
    assert len(quick) >= 6
    assert all(command.startswith("fluxbore ") for command in COMMANDS)
    for command in quick:
        run(command, newcomer, capsys)
    assert (newcomer / "pitch" / "results.csv").read_text(encoding="utf-8").count("\n") == 22


def test_the_table_over_the_pitch() -> None:
    """A row of it that the closed form no longer gives."""
    rows = re.findall(r"^\| (\d+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", PAGE, re.MULTILINE)
    assert len(rows) == 5
    spec = fluxbore.load(TOP / "examples" / "rotlin-pitch.toml").for_study()
    for pitch, force, stiffness, torque in rows:
        found = fluxbore.evaluate(spec.with_values({"actuator.pitch": float(pitch) * 1e-3}), "network").performance
        assert f"{found.stall_force:.1f}" == force
        assert f"{found.spring_constant / 1e3:.1f}" == stiffness
        assert f"{found.motor_torque:.4f}" == torque


def test_its_script_runs(newcomer: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (script,) = (block for language, block in BLOCKS if language == "python")
    exec(compile(script, "lead_screw_tutorial.md", "exec"), {})
    first, second = capsys.readouterr().out.splitlines()
    assert [float(number) for number in first.split()] == pytest.approx([192.0, 250.54e3, 1221.7], rel=1e-4)
    assert float(second) == pytest.approx(328.3, abs=0.5)


@pytest.mark.parametrize("name", ["pitch", "pareto", "tolerance"])
def test_the_studies_design_is_the_example_s(name: str) -> None:
    """A dimension that changed in one of the two files.

    Where radii move the bearing is in proportion, and what is left for others to weigh differs by what its seats weigh.
    """
    spec, study = (fluxbore.load(TOP / "examples" / f"{each}.toml") for each in ("rotlin", f"rotlin-{name}"))
    design = {key.name for key in spec.kind.keys if key.of_design}
    if name != "tolerance":
        design -= {"actuator.rotor.bearing", "actuator.carried_mass", "actuator.motor.inertia"}
        ours, theirs = (fluxbore.evaluate(each, "network").performance for each in (spec, study))
        assert theirs.moving_mass == pytest.approx(ours.moving_mass, rel=1e-3)
        assert theirs.rotor_inertia == pytest.approx(ours.rotor_inertia, rel=1e-3)
    assert {key: spec.given[key] for key in spec.given if key in design} == {
        key: study.given[key] for key in study.given if key in design
    }
    assert [note for note in spec.notes if note.key in design] == [note for note in study.notes if note.key in design]
