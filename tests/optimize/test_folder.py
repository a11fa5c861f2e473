"""The output folder: ours or refused; a file in it is whole or not there."""

import json
import os
import subprocess
import sys

import pytest
import toy

from fluxbore.design.errors import OutputError
from fluxbore.optimize import journal as journal_module
from fluxbore.optimize.evaluation import INVALID, failure
from fluxbore.optimize.folder import JOURNAL, MARKER, OUTPUTS, open_folder, write_atomic

SPEC, OTHER = toy.spec(), toy.spec(sweeps=(toy.square(),))

STEP = "ISO-10303-21;\nHEADER;\nFILE_NAME('{}','',('fluxbore 1.0'),(''),\n 'a processor','{}','');\nENDSEC;\n"
"""Name and originating system of a STEP file."""


def resumed(*arguments, **options):
    """Whether the folder is taken as one to go on in; it is closed again."""
    with open_folder(*arguments, **options) as folder:
        return folder.resumed


def content(path):
    """Every file below the folder with its bytes, and every folder."""
    return {file: file.read_bytes() if file.is_file() else None for file in path.rglob("*")}


def test_a_new_folder_is_made_and_resumed(tmp_path):
    path = tmp_path / "a" / "b"
    assert not resumed(path, SPEC)
    assert json.loads((path / MARKER).read_text())["specification"] == SPEC.fingerprint()
    assert resumed(path, SPEC)
    assert sorted(file.name for file in path.iterdir()) == [MARKER, JOURNAL]


def test_an_empty_folder_is_taken(tmp_path):
    assert not resumed(tmp_path, SPEC)


def test_another_specifications_results_need_force(tmp_path):
    """Catches results of two specifications in one folder, and a journal lost with them: it is keyed by design."""
    with open_folder(tmp_path, SPEC) as folder:
        folder.journal.put("a", "sweep", {}, failure("fem", INVALID, "Why."))
        for name in OUTPUTS:
            folder.write(name, "old")
        folder.write("cad/old.step", STEP.format("old.step", "fluxbore 1.0"))
        folder.write("cad/parts/yoke.step", STEP.format("yoke.step", "fluxbore 1.0"))
    (tmp_path / "notes.txt").write_text("mine")
    before = content(tmp_path)
    with pytest.raises(OutputError, match=r"holds the results of another specification \(see --force\)"):
        open_folder(tmp_path, OTHER)
    assert content(tmp_path) == before
    with open_folder(tmp_path, OTHER, force=True) as folder:
        assert not folder.resumed
        assert "a" in folder.journal
    assert sorted(file.name for file in tmp_path.iterdir()) == [MARKER, JOURNAL, "notes.txt"]
    assert resumed(tmp_path, OTHER)


def test_a_folder_that_is_taken_over_keeps_cad_files_that_are_not_ours(tmp_path):
    """Catches the loss of a drawing that somebody saved beside ours, or of ours that was edited elsewhere."""
    with open_folder(tmp_path, SPEC) as folder:
        folder.write("cad/parts/ours.step", STEP.format("ours.step", "fluxbore 1.0"))
        folder.write("cad/parts/edited.step", STEP.format("edited.step", "FreeCAD"))
        folder.write("cad/mine.step", "mine")
        folder.write("cad/ours.txt", STEP.format("ours.step", "fluxbore 1.0"))
    assert resumed(tmp_path, SPEC)
    assert (tmp_path / "cad" / "parts" / "ours.step").exists()
    assert not resumed(tmp_path, OTHER, force=True)
    left = [file.relative_to(tmp_path / "cad").as_posix() for file in (tmp_path / "cad").rglob("*")]
    assert sorted(left) == ["mine.step", "ours.txt", "parts", "parts/edited.step"]


def test_a_second_run_is_refused_before_it_touches_anything(tmp_path):
    """Catches a second run that cleans away the results of the first before it finds the journal locked."""
    with open_folder(tmp_path / "out", SPEC) as folder:
        folder.write("results.csv", "old")
        (tmp_path / "out" / "cad").mkdir()
        before = content(tmp_path)
        for spec, force in ((SPEC, False), (OTHER, False), (OTHER, True)):
            with pytest.raises(OutputError, match="another run is at work in this folder"):
                open_folder(tmp_path / "out", spec, force)
            assert content(tmp_path) == before
    assert resumed(tmp_path / "out", SPEC)


def test_a_run_that_starts_as_another_is_refused_does_not_write_into_a_removed_journal(tmp_path, monkeypatch):
    """Catches a lock on a file that the refused run has just taken away: its records would go nowhere."""
    real = journal_module._lock
    calls = []

    def lock(file, path):
        calls.append(file)
        if len(calls) == 1:
            path.unlink()
        real(file, path)

    monkeypatch.setattr(journal_module, "_lock", lock)
    with open_folder(tmp_path, SPEC) as folder:
        folder.journal.put("a", "sweep", {}, failure("fem", INVALID, "Why."))
    assert len(calls) == 2
    with open_folder(tmp_path, SPEC) as folder:
        assert "a" in folder.journal


def test_a_kill_between_lock_and_marker_leaves_a_free_folder(tmp_path):
    (tmp_path / JOURNAL).touch()
    assert not resumed(tmp_path, SPEC)


def test_a_folder_that_was_made_and_cannot_be_marked_goes_again(tmp_path, monkeypatch):
    """Catches an empty folder left by a run that was refused."""

    def full(*_):
        raise OutputError("x cannot be written: No space left on device.")

    monkeypatch.setattr("fluxbore.optimize.folder.write_atomic", full)
    with pytest.raises(OutputError, match="No space"):
        open_folder(tmp_path / "a" / "b", SPEC)
    assert list(tmp_path.iterdir()) == []


def test_somebody_elses_files_need_force_and_survive_it(tmp_path):
    """Catches the loss of a folder full of work that was named by mistake."""
    for name in ("report.html", "notes.txt", ".fluxbore.partial", ".x.12.partial.txt"):
        (tmp_path / name).write_text("mine")
    before = content(tmp_path)
    with pytest.raises(OutputError, match=r"holds other files, such as \.fluxbore\.partial \(see --force\)"):
        open_folder(tmp_path, SPEC)
    assert content(tmp_path) == before
    assert not resumed(tmp_path, SPEC, force=True)
    for name in ("report.html", "notes.txt", ".fluxbore.partial", ".x.12.partial.txt"):
        assert (tmp_path / name).read_text() == "mine"


def test_somebody_elses_journal_is_not_mended_before_it_is_refused(tmp_path):
    """Catches the loss of a last line that is no record of ours."""
    (tmp_path / JOURNAL).write_bytes(b'{"day": 1}\nhalf a line')
    with pytest.raises(OutputError, match=r"such as journal\.jsonl"):
        open_folder(tmp_path, SPEC)
    assert content(tmp_path) == {tmp_path / JOURNAL: b'{"day": 1}\nhalf a line'}


def test_a_damaged_marker_needs_force(tmp_path):
    (tmp_path / MARKER).write_text("{")
    with pytest.raises(OutputError, match="another specification"):
        open_folder(tmp_path, SPEC)
    assert not resumed(tmp_path, SPEC, force=True)


def test_what_a_kill_left_is_cleared_away(tmp_path):
    """Catches a folder that is refused because the kill came between the writing and the renaming."""
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    (tmp_path / f".report.html.{dead.pid}.partial").write_text("half")
    living = tmp_path / f".report.html.{os.getppid()}.partial"
    living.write_text("half")
    assert not resumed(tmp_path, SPEC)
    assert sorted(file.name for file in tmp_path.iterdir()) == sorted([MARKER, JOURNAL, living.name])


@pytest.mark.parametrize("place", ["/dev/null", "/dev/null/out", "/proc/out"])
def test_what_cannot_be_a_folder_is_one_sentence(place):
    """Catches a traceback, and a run that finds out after an hour."""
    with pytest.raises(OutputError, match=r"^/(dev/null|proc)[^\n]*\.$"):
        open_folder(place, SPEC)


def test_a_file_is_replaced_whole_or_not_at_all(tmp_path):
    """Catches a half-written report after a full disk or an error, and litter beside it."""
    target = tmp_path / "report.html"
    write_atomic(target, "old")
    with pytest.raises(UnicodeEncodeError):
        write_atomic(target, "\ud800")
    with pytest.raises(OutputError, match="cannot be written"):
        write_atomic(tmp_path / "nowhere" / "x", b"new")
    (tmp_path / "taken").mkdir()
    with pytest.raises(OutputError, match="taken cannot be written"):
        write_atomic(tmp_path / "taken", b"new")
    assert target.read_text() == "old"
    assert sorted(file.name for file in tmp_path.iterdir()) == ["report.html", "taken"]
    assert write_atomic(target, b"new").read_bytes() == b"new"


def test_a_folder_made_for_what_cannot_begin_goes_again(tmp_path):
    """But not with a record in it, not one that was there before, and not where the run was merely interrupted."""

    def fail(error, *, record=False):
        folder = open_folder(tmp_path / "a" / "b", SPEC)
        if record:
            folder.journal.put("a", "sweep", {}, failure("fem", INVALID, "Why."))
        folder.__exit__(type(error), error, None)

    fail(OutputError("No."))
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "a").mkdir()
    fail(OutputError("No."))
    assert content(tmp_path) == {tmp_path / "a": None}
    fail(KeyboardInterrupt())
    assert (tmp_path / "a" / "b" / MARKER).exists()
    fail(OutputError("No."))
    assert (tmp_path / "a" / "b" / MARKER).exists(), "it was there before"
    (tmp_path / "a" / "b" / MARKER).unlink()
    (tmp_path / "a" / "b" / JOURNAL).unlink()
    (tmp_path / "a" / "b").rmdir()
    fail(OutputError("No."), record=True)
    assert (tmp_path / "a" / "b" / JOURNAL).stat().st_size > 0
