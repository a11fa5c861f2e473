"""The benchmark of the force as a command: its folder, a run again, other designs, sensitivities, a kill (-m full)."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from fluxbore.cli import main

pytestmark = pytest.mark.full

TOP = Path(__file__).parents[2]
EXAMPLE = TOP / "examples" / "rotlin.toml"
SHORT = ("--set", "benchmark.force.duration=2 s", "--set", "benchmark.force.frequency=0.5 Hz")
RUN = ("--fidelity", "network", "--workers", "1", "--quiet", "--no-picture")


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the example, and beside it a screw with weaker magnets and a section that gives nothing of it."""
    text = EXAMPLE.read_text(encoding="utf-8")
    (tmp_path / "own.toml").write_text(text, encoding="utf-8")
    bare = "\n".join(line for line in text.splitlines() if not line.startswith(("stall_force", "mass =", "inertia =")))
    (tmp_path / "bare.toml").write_text(bare.replace('"1.2164 T"', '"1.3 T"').replace("RotLin", "Strong"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def answer(capsys) -> dict:
    return json.loads(capsys.readouterr().out)


def test_a_run_again_takes_what_it_has(place, capsys):
    """Catches traces or figures kept under another key than they are looked for by."""
    command = ["simulate", "own.toml", "-o", "out", *SHORT, *RUN, "--json"]
    assert main(command) == 0
    first, journal, traces = (
        answer(capsys),
        Path("out/journal.jsonl").read_bytes(),
        Path("out/traces.parquet").read_bytes(),
    )
    assert main(command) == 0
    assert answer(capsys) == first
    assert Path("out/journal.jsonl").read_bytes() == journal
    assert Path("out/traces.parquet").read_bytes() == traces
    names = {Path(name).name for name in first["files"]}
    assert names == {"results.csv", "traces.parquet", "figures.json", "report.html"}


def test_a_kill_costs_no_more_than_what_was_in_flight(place, capsys):
    """The same command goes on to what an undisturbed run gives."""
    command = ["simulate", "own.toml", *SHORT, *RUN, "--json"]
    assert main(command) == 0
    whole = answer(capsys)
    process = subprocess.Popen([sys.executable, "-m", "fluxbore", *command, "-o", "out"], stdout=subprocess.PIPE)
    while not Path("out/journal.jsonl").exists() and process.poll() is None:
        time.sleep(0.05)
    time.sleep(0.5)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    assert main([*command, "-o", "out"]) == 0
    assert answer(capsys)["figures"] == whole["figures"]


def test_other_designs_keep_their_own_screw(place, capsys):
    """Catches the first design's stall force, mass and inertia in the second's simulation, and another stand's load."""
    text = Path("bare.toml").read_text().replace('"2250 N/m"', '"3000 N/m"')
    Path("bare.toml").write_text(text)
    assert main(["simulate", "own.toml", "--against", "bare.toml", *SHORT, *RUN, "--json"]) == 0
    found = answer(capsys)
    (other,) = found["against"]
    assert other["status"] == "ok"
    own, theirs = found["figures"], other["figures"]
    assert own["stall_force_taken"] == 192.0
    assert theirs["stall_force_taken"] == theirs["stall_force"] == pytest.approx(192 * (1.3 / 1.2164) ** 2, rel=1e-3)
    assert theirs["mass_taken"] != own["mass_taken"] == 2.55
    assert theirs["dominant_pole"]["0"] / own["dominant_pole"]["0"] == pytest.approx(
        192 / theirs["stall_force"], rel=0.03
    )


def test_sensitivities_are_told(place, capsys):
    assert main(["simulate", "own.toml", "--vary", *SHORT, *RUN, "--json"]) == 0
    found = answer(capsys)
    assert {item["status"] for item in found["variations"]} == {"ok"}
    errors = {item["change"]: item["figures"]["estimation_rmse"]["1"]["polynomial"] for item in found["variations"]}
    ours = found["figures"]["estimation_rmse"]["1"]["polynomial"]
    more, less = (errors[f"amplitude of the zero-force line, {sign}10 %"] for sign in ("+", "−"))
    assert less < 0.95 * ours < ours < 0.95 * more


def test_the_page_s_script_runs(monkeypatch, capsys):
    page = (TOP / "docs" / "force_benchmark.md").read_text(encoding="utf-8")
    (script,) = re.findall(r"^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    monkeypatch.chdir(TOP)
    exec(compile(script, "force_benchmark.md", "exec"), {})
    assert capsys.readouterr().out.startswith("{'run': 'experiment', 'number': '3', 'force': 165.0} 1.5")


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("benchmark.force.third_peak=190 N", "third_peak must be below the largest force of (17)"),
        ("benchmark.force.load_stiffness=1 N/mm", "must press the load no further than the way over which all poles"),
        ("benchmark.force.second_step=1 kN", "second_step must be below what the screw holds"),
        ("benchmark.force.control_period=0.001 ms", "A run must take at most 5000000 steps in time"),
        ("benchmark.force.position_gain=1e6 1/s", "The screw slips"),
        ("benchmark.force.distortion=1 m", "The screw slips"),
        ("benchmark.force.eta=0.5", "eta must be at least 1; got 0.5"),
    ],
)
def test_what_cannot_be_is_one_sentence(place, capsys, setting, words):
    assert main(["simulate", "own.toml", "--set", setting, *RUN, "-o", "out"]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert words in printed.err
    assert printed.err.count("\n") == 1
