"""Sweeps of FEMM files: a row for every combination whatever becomes of it, and after any kill the same table."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

import femm_models
import pytest

from fluxbore import model_sweep
from fluxbore.cli import main
from fluxbore.design.errors import FluxboreError, OutputError
from fluxbore.fem.magnetostatics import Settings
from fluxbore.model_sweep import ModelSweep, run_sweep
from fluxbore.optimize.executor import Outcome, SerialExecutor
from fluxbore.optimize.journal import Journal
from fluxbore.optimize.progress import Progress

CURRENT = f"circuit.{femm_models.SPULE}.current"
LIFT = "group.1.displacement.z"
ROUGH = ("--accuracy", "20")

computed: list[tuple[str, ...]] = []
"""What `quick` was asked for."""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    femm_models.write(tmp_path)
    monkeypatch.chdir(tmp_path)
    computed.clear()
    return tmp_path


@pytest.fixture
def here(monkeypatch):
    """Rows in this process: a second less of start for each test."""
    monkeypatch.setattr(model_sweep, "local_executor", lambda _: SerialExecutor())


@pytest.fixture
def quick(here, monkeypatch):
    """Rows without a solution behind them."""

    def row(task: tuple[ModelSweep, tuple[str, ...]]) -> model_sweep.Row:
        computed.append(task[1])
        return {"energy": float(task[1][0]) / 3, "status": "ok", "reason": ""}

    monkeypatch.setattr(model_sweep, "_row", row)


def sweep_of(*axes: str, **question: object) -> ModelSweep:
    return ModelSweep.of(femm_models.axisymmetric(), axes, **question)


THREE = f"{CURRENT}=1:3:1"


def table_of(path: str | Path) -> list[dict[str, str]]:
    with Path(path).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def answer(capsys: pytest.CaptureFixture[str], *arguments: str, status: int = 0) -> dict:
    assert main(["solve", *arguments, "--json"]) == status
    return json.loads(capsys.readouterr().out, parse_constant=lambda word: pytest.fail(f"{word} in the JSON"))


def test_rows_of_two_axes_are_single_solutions(here, capsys):
    """Catches rows in another order, and a sweep that means something else by its keys than --set does."""
    question = ("--group", "1", "--point", "1,12", *ROUGH)
    found = answer(
        capsys, "axi.fem", "--sweep", f"{CURRENT}=1,4000 mA", "--sweep", f"{LIFT}=0:10:10", "-o", "out", *question
    )
    assert found["status"] == "ok"
    assert found["file"] == "out/results.csv"
    rows = found["rows"]
    assert [(row[CURRENT], row[LIFT]) for row in rows] == [(1.0, "0"), (1.0, "10"), (4.0, "0"), (4.0, "10")]
    alone = answer(capsys, "axi.fem", "--set", f"{CURRENT}=4", "--set", f"{LIFT}=10", *question)
    last = rows[-1]
    assert last["energy"] == alone["energy"]
    assert last["coenergy"] == alone["coenergy"]
    assert last[f"circuit.{femm_models.SPULE}.flux_linkage"] == alone["circuits"][femm_models.SPULE]["flux_linkage"]
    assert last["group.1.force.z"] == alone["groups"]["1"]["force"][1]
    assert last["group.1.force_error"] == alone["groups"]["1"]["force_error"]
    assert [last["point.1.B.r"], last["point.1.B.z"]] == alone["points"][0]["B"]
    assert last["point.1.A"] == alone["points"][0]["A"]
    assert last["unknowns"] == alone["mesh"]["unknowns"]
    assert [{key: str(value) for key, value in row.items()} for row in rows] == table_of("out/results.csv")


def test_set_holds_in_every_row_and_before_the_sweep(here, capsys):
    """Catches a sweep whose groups are told from the drawing as --set left it, not from the file."""
    sweep = ("--sweep", f"{LIFT}=2:2:1", "--set", f"{CURRENT}=4", "-o", "out", *ROUGH)
    (row,) = answer(capsys, "axi.fem", *sweep)["rows"]
    alone = answer(capsys, "axi.fem", "--set", f"{CURRENT}=4", "--set", f"{LIFT}=2", *ROUGH)
    assert row["energy"] == alone["energy"]


def test_rows_that_did_not_converge_have_empty_cells(here, capsys, monkeypatch):
    """Catches zeros in a table, which a plot takes for the field of no current."""
    monkeypatch.setattr("fluxbore.fem.femm_solution.Settings", partial(Settings, max_iterations=0))
    for file, key in (("iron.fem", CURRENT), ("planar.fem", "circuit.coil.current")):
        arguments = (file, "--sweep", f"{key}=20:40:20", "--group", "1", "--point", "1,12", "-o", file[:-4], *ROUGH)
        found = answer(capsys, *arguments, status=3)
        assert found["status"] == "failed"
        for row, told in zip(table_of(found["file"]), found["rows"], strict=True):
            assert row["status"] == "failed"
            assert row["reason"].startswith("Newton's iteration ended")
            filled = {name for name, cell in row.items() if cell}
            assert filled == {key, "unknowns", "status", "reason"}
            assert {name for name, value in told.items() if value is not None} == filled


def test_planar_rows_have_both_components_and_the_torque(here, capsys):
    found = answer(
        capsys,
        "planar.fem",
        "--sweep",
        "group.1.rotation=0:90:90",
        "--group",
        "1",
        "--point",
        "7,0",
        "-o",
        "out",
        *ROUGH,
    )
    names = {
        "group.1.force.x",
        "group.1.force.y",
        "group.1.torque",
        "group.1.force_error",
        "point.1.B.x",
        "point.1.B.y",
    }
    assert names <= set(found["rows"][0])
    upright, lying = (abs(row["group.1.torque"]) for row in found["rows"])
    assert lying > 10 * upright, "the coil's field is upright: it turns a magnet that lies"


def test_a_row_that_cannot_be_meshed_is_a_row(here, capsys):
    """Catches a sweep that ends at the first position in which parts overlap, and a row without a reason."""
    arguments = ("planar.fem", "--sweep", "group.1.displacement.x=0:8:4", "-o", "out", *ROUGH)
    found = answer(capsys, *arguments)
    assert found["status"] == "some failed"
    assert [row["status"] for row in found["rows"]] == ["ok", "failed", "failed"]
    assert found["rows"][1]["reason"].startswith("planar.fem: ")
    assert "energy" not in found["rows"][1]
    rows = table_of("out/results.csv")
    assert [row["status"] for row in rows] == ["ok", "failed", "failed"]
    assert rows[1]["energy"] == ""
    assert rows[1]["reason"] == found["rows"][1]["reason"]
    assert main(["solve", *arguments]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("1 of 3 rows solved: out/results.csv\n2 failed, such as: planar.fem: ")
    assert "3 from the journal, 2 failed" in err


def test_a_sweep_without_one_solved_row(here, capsys):
    question = ("--sweep", f"{CURRENT}=1:2:1", "--point", "900,0", "-o", "out", *ROUGH)
    found = answer(capsys, "axi.fem", *question, status=3)
    assert found["status"] == "failed"
    assert all("--point must lie inside the model" in row["reason"] for row in found["rows"])


def test_processes_give_what_this_process_gives(capsys, monkeypatch, folder):
    """Catches a question that is lost on its way to a worker. Progress goes to stderr, unless --quiet."""
    arguments = ("axi.fem", "--sweep", f"{CURRENT}=0,1,x", "--group", "1", *ROUGH)
    assert main(["solve", *arguments, "-o", "many", "--workers", "2", "--quiet"]) == 0
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(model_sweep, "local_executor", lambda _: SerialExecutor())
    assert main(["solve", *arguments, "-o", "one"]) == 0
    assert "sweep 3/3, 1 failed" in capsys.readouterr().err
    assert (folder / "many/results.csv").read_text() == (folder / "one/results.csv").read_text()


def test_nothing_is_computed_twice(quick):
    seen: list[Progress] = []
    _, first = run_sweep(sweep_of(THREE), "out", progress=seen.append)
    assert computed == [("1",), ("2",), ("3",)]
    assert [(each.done, each.reused) for each in seen] == [(0, 0), (1, 0), (2, 0), (3, 0)]
    _, second = run_sweep(sweep_of(THREE), "out", progress=seen.append)
    assert len(computed) == 3
    assert (seen[-1].done, seen[-1].total, seen[-1].reused) == (3, 3, 3)
    assert first == second


def test_torn_at_every_byte_it_loses_the_torn_row_only(quick, folder):
    """Catches half a line that is read as a row, joined to the next one, or that costs a whole one beside it."""
    path, _ = run_sweep(sweep_of(THREE), "whole")
    content, expected = (folder / "whole/sweep.jsonl").read_bytes(), path.read_text()
    ends = [place + 1 for place, byte in enumerate(content) if byte == ord("\n")]
    (folder / "torn").mkdir()
    for length in [*range(0, len(content), 3), *(end + shift for end in ends for shift in (-1, 0, 1))]:
        (folder / "torn/sweep.jsonl").write_bytes(content[:length])
        (folder / "torn/results.csv").unlink(missing_ok=True)
        computed.clear()
        path, _ = run_sweep(sweep_of(THREE), "torn")
        kept = sum(end <= length for end in ends[1:])
        assert len(computed) == 3 - kept, length
        assert path.read_text() == expected
        computed.clear()
        run_sweep(sweep_of(THREE), "torn")
        assert computed == [], "what came after the torn row was joined to it"


@pytest.mark.parametrize(
    "damage", [b"\0" * 30, b"{}", b"[1]", b'[["1"], 3]', b'[["1"], {}]', b'[["9"], {"status": "ok"}]', b"\xff\xfe"]
)
def test_a_damaged_line_costs_nothing_else(quick, folder, damage):
    """Catches a folder that a power cut made useless, and rows that no value of the sweep asked for."""
    path, expected = run_sweep(sweep_of(THREE), "out")
    lines = (folder / "out/sweep.jsonl").read_bytes().splitlines(keepends=True)
    (folder / "out/sweep.jsonl").write_bytes(b"".join([*lines[:2], damage + b"\n", *lines[3:]]))
    computed.clear()
    seen: list[Progress] = []
    assert run_sweep(sweep_of(THREE), "out", progress=seen.append) == (path, expected)
    assert computed == [("2",)]
    assert [each.done for each in seen] == [2, 3]


class Interrupted(SerialExecutor):
    """Somebody presses Ctrl-C before the first row is done."""

    def run(self, function: object, tasks: Sequence[object]) -> Iterator[Outcome[object]]:  # type: ignore[override]
        raise KeyboardInterrupt


QUESTIONS = {
    "values": ((f"{CURRENT}=1:4:1",), {}),
    "key": ((f"{LIFT}=1:3:1",), {}),
    "changes": ((THREE,), {"changes": ((LIFT, "1"),)}),
    "groups": ((THREE,), {"groups": (1,)}),
    "points": ((THREE,), {"points": ((1.0, 2.0),)}),
    "accuracy": ((THREE,), {"accuracy": 0.01}),
    "open boundary": ((THREE,), {"open_boundary": True}),
}


@pytest.mark.parametrize("case", QUESTIONS)
def test_another_question_does_not_take_these_rows(case, quick, folder, monkeypatch):
    """Catches figures of one question that are given as the answer to another, and rows that are lost by mistake."""
    run_sweep(sweep_of(THREE), "out")
    before = {path.name: path.read_bytes() for path in (folder / "out").iterdir()}
    axes, question = QUESTIONS[case]
    other = sweep_of(*axes, **question)
    with pytest.raises(OutputError, match=r"^out must be empty or hold rows of this very sweep; .* \(see --force\)\.$"):
        run_sweep(other, "out")
    assert {path.name: path.read_bytes() for path in (folder / "out").iterdir()} == before
    monkeypatch.setattr(model_sweep, "local_executor", lambda _: Interrupted())
    with pytest.raises(KeyboardInterrupt):
        run_sweep(other, "out", force=True)
    monkeypatch.setattr(model_sweep, "local_executor", lambda _: SerialExecutor())
    assert [path.name for path in (folder / "out").iterdir()] == ["sweep.jsonl"], "a table of another sweep stays"
    computed.clear()
    _, rows = run_sweep(other, "out")
    assert len(computed) == len(rows) == len(table_of("out/results.csv"))


def test_force_replaces_rows_and_nothing_else(quick, folder):
    (folder / "out").mkdir()
    (folder / "out/notes.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"it holds other files, such as notes\.txt"):
        run_sweep(sweep_of(THREE), "out")
    assert [path.name for path in (folder / "out").iterdir()] == ["notes.txt"]
    run_sweep(sweep_of(THREE), "out", force=True)
    assert (folder / "out/notes.txt").read_text() == "mine"
    assert len(table_of("out/results.csv")) == 3


def test_one_run_at_a_time(quick, folder):
    """Catches two writers in one journal."""
    run_sweep(sweep_of(THREE), "out")
    before = (folder / "out/sweep.jsonl").read_bytes()
    with (
        Journal("out/sweep.jsonl", read=False),
        pytest.raises(FluxboreError, match="must be written by one run at a time; another run is at work"),
    ):
        run_sweep(sweep_of(f"{CURRENT}=7:9:1"), "out", force=True)
    assert (folder / "out/sweep.jsonl").read_bytes() == before
    run_sweep(sweep_of(THREE), "out")


class Crashing(SerialExecutor):
    """Its second task takes the process with it."""

    def run(self, function: object, tasks: Sequence[object]) -> Iterator[Outcome[object]]:  # type: ignore[override]
        for index, task in enumerate(tasks):
            yield Outcome(index, None, "The process died.") if index == 1 else Outcome(index, function(task))


def test_what_crashed_is_tried_again(quick, monkeypatch):
    """Catches a lack of memory that stays in the table for ever."""
    monkeypatch.setattr(model_sweep, "local_executor", lambda _: Crashing())
    _, rows = run_sweep(sweep_of(THREE), "out")
    assert [row["status"] for row in rows] == ["ok", "failed", "ok"]
    assert rows[1]["reason"] == "The process died."
    monkeypatch.setattr(model_sweep, "local_executor", lambda _: SerialExecutor())
    _, rows = run_sweep(sweep_of(THREE), "out")
    assert [row["status"] for row in rows] == ["ok"] * 3


def test_figures_that_are_no_numbers_are_empty(here, monkeypatch):
    """Catches a NaN that ends a night's sweep, since JSON has none."""
    from fluxbore.fem.femm_solution import FemmSolution

    monkeypatch.setattr(FemmSolution, "energies", (float("nan"), 1.0))
    _, (row,) = run_sweep(sweep_of(f"{CURRENT}=1", accuracy=0.2), "out")
    assert (row["energy"], row["coenergy"]) == (None, 1.0)
    assert table_of("out/results.csv")[0]["energy"] == ""


COMMAND = [
    sys.executable,
    "-m",
    "fluxbore",
    "solve",
    "axi.fem",
    "--sweep",
    f"{CURRENT}=1:8:1",
    *ROUGH,
    "--workers",
    "1",
]
posix = pytest.mark.skipif(os.name != "posix", reason="needs signals")


def begun(rows: int) -> subprocess.Popen[str]:
    """A sweep that has written so many rows."""
    process = subprocess.Popen([*COMMAND, "-o", "out"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    journal = Path("out/sweep.jsonl")
    while process.poll() is None and (not journal.exists() or journal.read_bytes().count(b"\n") <= rows):
        time.sleep(0.01)
    assert process.poll() is None, "the sweep was done before it could be stopped"
    return process


@posix
def test_stopped_and_killed_it_goes_on(here, capsys, folder):
    """Catches rows lost by an interrupt or a kill, rows computed again, and another table than without them."""
    process = begun(1)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate()
    assert (process.returncode, out) == (130, "")
    assert "interrupted; the same command goes on where it was" in err
    assert "Traceback" not in err
    assert not (folder / "out/results.csv").exists()
    first = (folder / "out/sweep.jsonl").read_bytes().splitlines()[1:]
    process = begun(len(first) + 1)
    process.kill()
    process.communicate()
    second = (folder / "out/sweep.jsonl").read_bytes().splitlines()[1:]
    assert second[: len(first)] == first
    assert main([*COMMAND[3:], "-o", "out"]) == 0
    reused = int(capsys.readouterr().err.splitlines()[-1].split(", ")[1].split()[0])
    assert len(first) < reused <= len(second) < 8
    rows = table_of("out/results.csv")
    assert [float(row[CURRENT]) for row in rows] == list(range(1, 9))
    energies = [float(row["energy"]) for row in rows]
    assert energies == pytest.approx([energies[0] * k**2 for k in range(1, 9)], rel=1e-6)
