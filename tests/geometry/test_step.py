"""STEP files read back: names, hierarchy, colours and solids, and that a failure leaves nothing half-written."""

import dataclasses
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from actuators import table_ii

from fluxbore.design import graphics
from fluxbore.design.errors import OutputError
from fluxbore.geometry import hybrid_parts, step, step_files
from fluxbore.geometry import part as parts_of
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Part
from fluxbore.geometry.solid import is_closed, kernel_volume

MM = 1e-3

pytestmark = pytest.mark.skipif(not graphics.has_gl(), reason=f"libGL is missing: {graphics.APT_LINE}")


def block(name: str, group: str = "stator", colour: parts_of.Colour = (0.2, 0.4, 0.6)) -> Part:
    return Part(name, "block", group, "steel", colour, rectangle(0, 0.01, 0, 0.02))


@pytest.fixture(scope="module")
def whole() -> Assembly:
    return hybrid_parts.assembly(table_ii(), 27.5 * MM)


@pytest.fixture(scope="module")
def written(whole: Assembly, tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    return step.write_step(whole, tmp_path_factory.mktemp("out") / "cad")


def check(body: Any, part: Part) -> None:
    """One valid closed solid of the right volume, standing at its place along z."""
    assert len(body.Solids()) == 1
    assert body.isValid()
    assert is_closed(body)
    assert kernel_volume(body) == pytest.approx(parts_of.volume(part), rel=1e-4 if part.holes else 1e-6)
    assert body.BoundingBox().zmin * MM == pytest.approx(min(z for _, z in part.profile), abs=1e-6)


def test_the_assembly_comes_back_with_names_groups_colours_and_solids(whole: Assembly, written: list[Path]) -> None:
    import cadquery

    assert written[0].name == "iPEHLA.step"
    root = cadquery.Assembly.importStep(str(written[0]))
    assert root.name == "iPEHLA"
    assert [group.name for group in root.children] == ["stator", "mover"]
    for group in root.children:
        expected = [part for part in whole.parts if part.group == group.name]
        assert [child.name for child in group.children] == [part.name for part in expected]
        for child, part in zip(group.children, expected, strict=True):
            assert child.color.toTuple()[:3] == pytest.approx(part.colour, abs=2e-3)
            check(child.obj, part)


def test_the_file_itself_names_each_product_once(whole: Assembly, written: list[Path]) -> None:
    """On the file's own tokens, without the library that wrote it."""
    text = written[0].read_text(encoding="ascii")
    names = re.findall(r"=\s*PRODUCT\(\s*'([^']*)'", text)
    assert sorted(names) == sorted(["iPEHLA", "stator", "mover", *(part.name for part in whole.parts)])
    assert len(re.findall(r"=\s*MANIFOLD_SOLID_BREP\(", text)) == len(whole.parts)


def test_every_part_has_its_file_with_its_name_and_colour(whole: Assembly, written: list[Path]) -> None:
    import cadquery

    files = written[1:]
    assert len(files) == len(set(files)) == len(whole.parts)
    assert sorted(files) == sorted((written[0].parent / "parts").iterdir())
    assert all(re.fullmatch(r"[a-z0-9-]+\.step", file.name) for file in files)
    for file, part in zip(files, whole.parts, strict=True):
        check(cadquery.importers.importStep(str(file)).val(), part)
        text = file.read_text(encoding="ascii")
        assert re.findall(r"=\s*PRODUCT\(\s*'([^']*)'", text) == [part.name]
        colours = re.findall(r"COLOUR_RGB\(\s*'',\s*([^)]*)\)", text)
        assert len(set(colours)) == 1


def test_the_header_names_the_program_and_nobody(written: list[Path]) -> None:
    header = written[0].read_text(encoding="ascii").partition("ENDSEC;")[0].replace("\n", "")
    assert "'iPEHLA, mover at 27.5 mm'" in header
    assert re.search(r"FILE_NAME\('iPEHLA\.step','[-:T0-9]+',\('fluxbore [^']+'\),\s*\(''\),", header)
    assert "AUTOMOTIVE_DESIGN" in header
    assert str(Path.home()) not in header
    assert str(written[0].parent) not in header


def test_the_kernels_global_settings_are_put_back(whole: Assembly, tmp_path: Path) -> None:
    """Catches an export that turns the units of a script's own STEP files to something else."""
    from OCP.Interface import Interface_Static
    from OCP.STEPCAFControl import STEPCAFControl_Controller

    STEPCAFControl_Controller.Init_s()
    before = {name: Interface_Static.CVal_s(name) for name in ("write.step.unit", "write.step.schema")}
    try:
        Interface_Static.SetCVal_s("write.step.unit", "INCH")
        step.write_step(Assembly("a", (block("b"),), 0.0), tmp_path / "cad")
        assert Interface_Static.CVal_s("write.step.unit") == "INCH"
        assert ".MILLI." in (tmp_path / "cad" / "a.step").read_text(encoding="ascii")
    finally:
        for name, value in before.items():
            Interface_Static.SetCVal_s(name, value)


def test_nothing_is_printed(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """The kernel's own chatter would break the JSON of the command line."""
    step.write_step(Assembly("a", (block("b"),), 0.0), tmp_path / "cad")
    assert capfd.readouterr() == ("", "")


def test_a_second_export_replaces_the_parts_and_leaves_other_files(tmp_path: Path) -> None:
    """Catches parts of an earlier design that stay beside those of the new one."""
    folder = tmp_path / "cad"
    folder.mkdir()
    (folder / "notes.txt").write_text("mine")
    step.write_step(Assembly("a", (block("old one"), block("both", "mover")), 0.0), folder)
    step.write_step(Assembly("a", (block("new one"), block("both", "mover")), 0.0), folder)
    assert sorted(path.name for path in folder.iterdir()) == ["a.step", "notes.txt", "parts"]
    assert sorted(path.name for path in (folder / "parts").iterdir()) == ["both.step", "new-one.step"]
    assert "new one" in (folder / "a.step").read_text(encoding="ascii")


def test_an_assembly_of_another_name_goes_and_files_of_others_stay(tmp_path: Path) -> None:
    """Catches an assembly of an earlier name beside the new one, and the loss of what somebody saved beside ours."""
    folder = tmp_path / "cad"
    step.write_step(Assembly("old", (block("b"),), 0.0), folder)
    edited = (folder / "old.step").read_text(encoding="ascii").replace("'fluxbore", "'FreeCAD")
    for name in ("edited.step", "parts/edited.step"):
        (folder / name).write_text(edited, encoding="ascii")
    (folder / "parts" / "own").mkdir()
    (folder / "parts" / "own" / "notes.txt").write_text("mine")
    step.write_step(Assembly("nëw " * 30, (block("c"),), 0.0), folder)
    step.write_step(Assembly("new", (block("c"),), 0.0), folder)
    left = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    assert left == ["edited.step", "new.step", "parts/c.step", "parts/edited.step", "parts/own/notes.txt"]
    step_files.remove_own(folder)
    left = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    assert left == ["edited.step", "parts/edited.step", "parts/own/notes.txt"]


def test_what_was_written_is_removed_as_a_whole(tmp_path: Path) -> None:
    step.write_step(Assembly("a", (block("b"),), 0.0), tmp_path / "cad")
    step_files.remove_own(tmp_path / "cad")
    step_files.remove_own(tmp_path / "cad")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("there", [pytest.param(False, marks=pytest.mark.full), True])
def test_what_a_killed_export_left_goes_at_the_next(tmp_path: Path, there: bool) -> None:
    """Catches scratch folders that pile up; the one of a process that lives and folders of others are not touched."""
    folder = tmp_path / "cad"
    if there:
        step.write_step(Assembly("a", (block("b"),), 0.0), folder)
    killed = subprocess.Popen(
        [sys.executable, "-c", KILLED, str(folder)], env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    )
    assert killed.wait() == -signal.SIGKILL
    beside = folder if there else tmp_path
    (left,) = beside.glob(".step-*")
    assert (left / "new" / "a.step").exists()
    (left / "old").mkdir(exist_ok=True)
    (left / "old" / "notes.txt").write_text("mine")
    others = [beside / f".step-{os.getppid()}-abcdefgh", beside / ".step-by-step"]
    for other in others:
        other.mkdir()
    step.write_step(Assembly("a", (block("c"),), 0.0), folder)
    assert sorted(beside.glob(".step-*")) == sorted([*others, left])
    assert [path.name for path in left.rglob("*")] == ["old", "notes.txt"]
    (left / "old" / "notes.txt").unlink()
    step.write_step(Assembly("a", (block("c"),), 0.0), folder)
    assert sorted(beside.glob(".step-*")) == sorted(others)


KILLED = """
import os, signal, sys
from pathlib import Path
from fluxbore.geometry import step
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Part
step._move = lambda *_: os.kill(os.getpid(), signal.SIGKILL)
part = Part("b", "block", "stator", "steel", (0.2, 0.4, 0.6), rectangle(0, 0.01, 0, 0.02))
step.write_step(Assembly("a", (part,), 0.0), Path(sys.argv[1]))
"""


@pytest.mark.parametrize("failing", ["a.step", "c.step"])
def test_a_failure_leaves_what_was_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing: str) -> None:
    folder = tmp_path / "cad"
    step.write_step(Assembly("a", (block("b"),), 0.0), folder)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*.step")}
    real = step._write

    def write(path: Path, *rest: Any) -> None:
        if path.name == failing:
            raise OSError(28, "No space left on device")
        real(path, *rest)

    monkeypatch.setattr(step, "_write", write)
    with pytest.raises(OutputError, match=r"cad\" must be a folder .*No space left on device\.$"):
        step.write_step(Assembly("a", (block("c"),), 0.0), folder)
    with pytest.raises(OutputError):
        step.write_step(Assembly("a", (block("c"),), 0.0), tmp_path / "new")
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cad"]


@pytest.mark.parametrize("failing", ["parts", "a.step"])
def test_a_failure_while_renaming_puts_the_old_parts_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing: str
) -> None:
    folder = tmp_path / "cad"
    step.write_step(Assembly("a", (block("b"),), 0.0), folder)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*.step")}
    real = Path.replace

    def replace(self: Path, target: Path) -> Path:
        if self.parent.name == "new" and self.name == failing:
            raise OSError(13, "Permission denied")
        return real(self, target)

    monkeypatch.setattr(Path, "replace", replace)
    with pytest.raises(OutputError, match="Permission denied"):
        step.write_step(Assembly("a", (block("c"),), 0.0), folder)
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_a_folder_that_is_a_file_is_refused_in_one_sentence(tmp_path: Path) -> None:
    (tmp_path / "cad").write_text("a file")
    with pytest.raises(OutputError, match=r'cad" must be a folder that can be written; got: .*\.$'):
        step.write_step(Assembly("a", (block("b"),), 0.0), tmp_path / "cad")
    assert (tmp_path / "cad").read_text() == "a file"
    assert [path.name for path in tmp_path.iterdir()] == ["cad"]


@pytest.mark.parametrize("name", ["Prüfling 'τ' \\ №1", "stator", "b", "../up/and away"])
def test_any_name_survives_and_none_escapes_the_folder(tmp_path: Path, name: str) -> None:
    """The root's name differs from its children's, else readers merge them; the text is ASCII as AP214 wants it."""
    import cadquery

    paths = step.write_step(Assembly(name, (block("b"), block("c", "mover")), 0.0), tmp_path / "cad")
    assert paths[0].parent == tmp_path / "cad"
    assert paths[0].exists()
    paths[0].read_text(encoding="ascii")
    root = cadquery.Assembly.importStep(str(paths[0]))
    assert root.name == (f"{name} assembly" if name in ("stator", "b") else name)


def test_parts_whose_names_differ_only_for_people_get_files_of_their_own(tmp_path: Path) -> None:
    parts = (block("coil A"), block("coil a"), block("coil/a", "mover"))
    paths = step.write_step(Assembly("a", parts, 0.0), tmp_path / "cad")
    assert [path.name for path in paths[1:]] == ["coil-a.step", "coil-a-2.step", "coil-a-3.step"]


def test_every_position_can_be_exported(tmp_path: Path) -> None:
    """The mover stands where the position says, in the file as in the model."""
    import cadquery

    for position in (0.0, 88 * MM):
        whole = hybrid_parts.assembly(table_ii(), position)
        few = tuple(part for part in whole.parts if part.name in ("half ring, cap side", "cylinder tube"))
        path = step.write_step(dataclasses.replace(whole, parts=few), tmp_path / f"{position}")[0]
        mover = cadquery.Assembly.importStep(str(path)).children[1].children[0]
        assert mover.obj.BoundingBox().zmin * MM == pytest.approx(position, abs=1e-6)
