"""Files put into a folder together: all or none, stale ones gone, others never touched."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from fluxbore.design.errors import OutputError
from fluxbore.geometry import own_files
from fluxbore.geometry.own_files import LIST, put, remove

STEP = "ISO-10303-21;\nHEADER;\nFILE_NAME('{}','',(''),(''),'','{}','');\nENDSEC;\n"


def files(folder: Path) -> dict[str, bytes]:
    """All that a user sees, and the list."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()
    }


def names(folder: Path) -> list[str]:
    return [name for name in files(folder) if name != LIST]


def test_files_of_several_formats_come_together(tmp_path: Path) -> None:
    made = {"step": {"a.step": "A", "parts/b.step": "B"}, "glb": {"a.glb": b"\0glb"}}
    paths = put(tmp_path / "new" / "cad", made, "one")
    assert [path.relative_to(tmp_path).as_posix() for path in paths] == [
        "new/cad/a.step", "new/cad/parts/b.step", "new/cad/a.glb",
    ]  # fmt: skip
    assert files(tmp_path / "new" / "cad")["a.glb"] == b"\0glb"
    assert sorted(path.name for path in (tmp_path / "new" / "cad").iterdir()) == [LIST, "a.glb", "a.step", "parts"]


def test_of_the_same_design_other_formats_stay(tmp_path: Path) -> None:
    """Catches a GLB that removes the STEP files, and a STEP part that the design no longer has."""
    put(tmp_path, {"step": {"a.step": "A", "parts/b.step": "B"}}, "one")
    put(tmp_path, {"glb": {"a.glb": "G"}}, "one")
    put(tmp_path, {"step": {"a.step": "A2", "parts/c.step": "C"}}, "one")
    assert names(tmp_path) == ["a.glb", "a.step", "parts/c.step"]


def test_of_another_design_nothing_stays(tmp_path: Path) -> None:
    put(tmp_path, {"step": {"a.step": "A", "parts/b.step": "B"}, "glb": {"a.glb": "G"}}, "one")
    put(tmp_path, {"step": {"z.step": "Z"}}, "two")
    assert names(tmp_path) == ["z.step"]
    assert not (tmp_path / "parts").exists()


def test_what_somebody_made_or_changed_is_never_removed(tmp_path: Path) -> None:
    put(tmp_path, {"step": {"a.step": "A", "b.step": "B"}, "glb": {"parts/c.glb": "C"}}, "one")
    (tmp_path / "b.step").write_text("B, mended")
    (tmp_path / "copy.step").write_text("A")
    (tmp_path / "parts" / "notes.txt").write_text("mine")
    put(tmp_path, {"step": {"z.step": "Z"}}, "two")
    assert names(tmp_path) == ["b.step", "copy.step", "parts/notes.txt", "z.step"]
    remove(tmp_path)
    assert names(tmp_path) == ["b.step", "copy.step", "parts/notes.txt"]


def test_what_somebody_made_or_changed_is_not_replaced_but_by_force(tmp_path: Path) -> None:
    put(tmp_path, {"step": {"a.step": "A", "b.step": "B"}}, "one")
    (tmp_path / "b.step").write_text("mended")
    (tmp_path / "c.step").write_text("mine")
    before = files(tmp_path)
    for name in ("b.step", "c.step"):
        with pytest.raises(
            OutputError, match=rf'{name}" must be as fluxbore wrote it to be replaced; .* \(see --force\)'
        ):
            put(tmp_path, {"step": {"a.step": "new", name: "new"}}, "one")
        assert files(tmp_path) == before
    put(tmp_path, {"step": {"b.step": "new", "c.step": "new"}}, "one", force=True)
    assert names(tmp_path) == ["b.step", "c.step"]


def test_a_folder_of_an_earlier_version_is_told_by_headers(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "old.step").write_text(STEP.format("old.step", "fluxbore 0.1"))
    (tmp_path / "old.dxf").write_text("999\nfluxbore 0.1\n0\nSECTION\n")
    (tmp_path / "parts" / "p.step").write_text(STEP.format("p.step", "fluxbore"))
    (tmp_path / "edited.step").write_text(STEP.format("edited.step", "FreeCAD"))
    (tmp_path / "mine.step").write_text("fluxbore")
    put(tmp_path, {"step": {"new.step": "N"}}, "one")
    assert names(tmp_path) == ["edited.step", "mine.step", "new.step"]


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '{"design": 1}', '{"design": "", "files": {"../x": ["a", "b"]}, "coming": {}}']
)
def test_a_damaged_list_costs_nobody_a_file(tmp_path: Path, text: str) -> None:
    folder = tmp_path / "cad"
    put(folder, {"step": {"a.step": "A"}}, "one")
    (tmp_path / "x").write_text("mine")
    (folder / LIST).write_text(text)
    remove(folder)
    assert (folder / "a.step").exists()
    put(folder, {"step": {"b.step": "B"}}, "two")
    assert names(tmp_path)[-1] == "x"
    assert (folder / "a.step").exists()


@pytest.mark.parametrize("failing", [0, 1, 2])
def test_a_failure_leaves_what_was_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing: int) -> None:
    """Catches half of a new design among the old one, whichever file cannot be put in place."""
    put(tmp_path, {"step": {"a.step": "A", "parts/b.step": "B"}}, "one")
    before = {name: text for name, text in files(tmp_path).items() if name != LIST}
    real, placed = Path.replace, []

    def replace(self: Path, target: Path) -> Path:
        if self.parent.name in ("new", "parts") and "/new/" in str(self):
            placed.append(self)
            if len(placed) == failing + 1:
                raise OSError(28, "No space left on device")
        return real(self, target)

    monkeypatch.setattr(Path, "replace", replace)
    with pytest.raises(OutputError, match=r"must be a folder that can be written; got: No space left on device\.$"):
        put(tmp_path, {"step": {"a.step": "A2", "parts/b.step": "B2", "c.step": "C2"}}, "two")
    assert {name: text for name, text in files(tmp_path).items() if name != LIST} == before
    monkeypatch.undo()
    put(tmp_path, {"step": {"c.step": "C2"}}, "two")
    assert names(tmp_path) == ["c.step"]


def test_a_folder_that_is_a_file_is_refused_in_one_sentence(tmp_path: Path) -> None:
    (tmp_path / "cad").write_text("a file")
    with pytest.raises(OutputError, match=r'cad" must be a folder that can be written; got: .*\.$'):
        put(tmp_path / "cad", {"step": {"a.step": "A"}}, "one")
    assert (tmp_path / "cad").read_text() == "a file"


KILLED = """
import os, signal, sys
from pathlib import Path
from fluxbore.geometry import own_files
real, count = Path.replace, []
def replace(self, target):
    if "/new/" in str(self):
        count.append(self)
        if len(count) == 2:
            os.kill(os.getpid(), signal.SIGKILL)
    return real(self, target)
Path.replace = replace
own_files.put(Path(sys.argv[1]), {"step": {"a.step": "A2", "b.step": "B2"}}, "two")
"""


def test_what_a_killed_run_left_is_known_and_goes_at_the_next(tmp_path: Path) -> None:
    """Catches files that count as somebody's for ever since their list was never finished; scratch folders pile up."""
    put(tmp_path, {"step": {"a.step": "A", "b.step": "B"}}, "one")
    killed = subprocess.Popen(
        [sys.executable, "-c", KILLED, str(tmp_path)], env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    )
    assert killed.wait() == -signal.SIGKILL
    assert (tmp_path / "a.step").read_text() == "A2"
    assert len(list(tmp_path.glob(".fluxbore-*-*"))) == 1
    other = tmp_path / f".fluxbore-{os.getppid()}-abcdefgh"
    other.mkdir()
    put(tmp_path, {"step": {"c.step": "C"}}, "three")
    assert names(tmp_path) == ["c.step"]
    assert [path.name for path in tmp_path.glob(".fluxbore-*-*")] == [other.name]
    assert json.loads((tmp_path / LIST).read_text())["coming"] == {}


def test_what_was_written_is_removed_as_a_whole(tmp_path: Path) -> None:
    put(tmp_path / "cad", {"step": {"a.step": "A", "parts/b.step": "B"}}, "one")
    remove(tmp_path / "cad")
    remove(tmp_path / "cad")
    assert list(tmp_path.iterdir()) == []
    assert own_files._listed(tmp_path).files == {}
