"""The output folder: ours or refused; a file in it is whole or not there."""

import json
import os
import subprocess
import sys

import pytest
import toy

from fluxbore.design.errors import OutputError
from fluxbore.optimize.folder import MARKER, open_folder, write_atomic

SPEC, OTHER = toy.spec(), toy.spec(sweeps=(toy.square(),))


def test_a_new_folder_is_made_and_resumed(tmp_path):
    path = tmp_path / "a" / "b"
    assert not open_folder(path, SPEC).resumed
    assert json.loads((path / MARKER).read_text())["specification"] == SPEC.fingerprint()
    assert open_folder(path, SPEC).resumed
    assert sorted(file.name for file in path.iterdir()) == [MARKER]


def test_an_empty_folder_is_taken(tmp_path):
    assert not open_folder(tmp_path, SPEC).resumed


def test_another_specifications_results_need_force(tmp_path):
    """Catches results of two specifications in one folder, and a journal lost with them: it is keyed by design."""
    folder = open_folder(tmp_path, SPEC)
    folder.write("results.csv", "old")
    folder.write("cad/yoke.step", "mine")
    (tmp_path / "notes.txt").write_text("mine")
    folder.journal.write_text("")
    with pytest.raises(OutputError, match=r"holds the results of another specification \(see --force\)"):
        open_folder(tmp_path, OTHER)
    assert (tmp_path / "results.csv").read_text() == "old"
    assert not open_folder(tmp_path, OTHER, force=True).resumed
    assert sorted(file.name for file in tmp_path.iterdir()) == [MARKER, "cad", "journal.jsonl", "notes.txt"]
    assert open_folder(tmp_path, OTHER).resumed


def test_somebody_elses_files_need_force_and_survive_it(tmp_path):
    """Catches the loss of a folder full of work that was named by mistake."""
    for name in ("report.html", "notes.txt", ".fluxbore.partial", ".x.12.partial.txt"):
        (tmp_path / name).write_text("mine")
    with pytest.raises(OutputError, match=r"holds other files, such as \.fluxbore\.partial \(see --force\)"):
        open_folder(tmp_path, SPEC)
    assert not (tmp_path / MARKER).exists()
    open_folder(tmp_path, SPEC, force=True)
    for name in ("report.html", "notes.txt", ".fluxbore.partial", ".x.12.partial.txt"):
        assert (tmp_path / name).read_text() == "mine"


def test_a_damaged_marker_needs_force(tmp_path):
    (tmp_path / MARKER).write_text("{")
    with pytest.raises(OutputError, match="another specification"):
        open_folder(tmp_path, SPEC)
    assert not open_folder(tmp_path, SPEC, force=True).resumed


def test_what_a_kill_left_is_cleared_away(tmp_path):
    """Catches a folder that is refused because the kill came between the writing and the renaming."""
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    (tmp_path / f".report.html.{dead.pid}.partial").write_text("half")
    living = tmp_path / f".report.html.{os.getppid()}.partial"
    living.write_text("half")
    open_folder(tmp_path, SPEC)
    assert sorted(file.name for file in tmp_path.iterdir()) == sorted([MARKER, living.name])


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
