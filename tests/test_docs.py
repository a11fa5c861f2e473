"""The documentation's commands and scripts, run as they stand."""

from __future__ import annotations

import re
import runpy
import shlex
import shutil
from pathlib import Path

import pytest

from fluxbore.cli import main
from fluxbore.design.graphics import has_gl
from fluxbore.design.spec import loads

TOP = Path(__file__).parent.parent


def blocks(page: Path, language: str) -> list[str]:
    """The fenced code blocks of a page that are in this language ("" for commands)."""
    found = re.findall(r"^```(\w*)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    return [block for name, block in found if name == language]


def commands(page: Path) -> list[str]:
    return [line for block in blocks(page, "") for line in block.splitlines() if line.startswith("fluxbore ")]


@pytest.fixture
def newcomer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the examples, which is where a reader of the tutorial stands."""
    shutil.copytree(TOP / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_every_command_of_the_tutorial_runs(newcomer: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A command of the tutorial that no longer works, or an error that it quotes and that reads otherwise now."""
    page = TOP / "docs" / "tutorial.md"
    text = " ".join(page.read_text(encoding="utf-8").replace("\n> ", " ").split())
    found = commands(page)
    assert len(found) >= 8
    for command in found:
        if command.startswith("fluxbore design"):
            continue  # the whole job has a test of its own
        line, _, target = command.partition(" > ")
        status = main(shlex.split(line)[1:])
        output = capsys.readouterr()
        if target:
            (newcomer / target).write_text(output.out, encoding="utf-8")
        if "ring_width=1.5" in command:
            assert status == 2
            assert output.err.strip() in text
        else:
            assert status == 0, (command, output.err)
    assert (newcomer / "fig6a" / "results.csv").read_text(encoding="utf-8").count("\n") == 25
    assert (newcomer / "optimum" / "design.toml").exists()


def test_the_tutorials_python_runs(newcomer: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The Python interface as the tutorial and the README show it."""
    main(["new", "ipehla"])
    (newcomer / "my.toml").write_text(capsys.readouterr().out, encoding="utf-8")
    for page in (TOP / "docs" / "tutorial.md", TOP / "README.md"):
        for block in blocks(page, "python"):
            exec(compile(block, str(page), "exec"), {})
    assert "8.6" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["solve.md", "femm.md"])
def test_every_command_on_femm_files_runs(newcomer: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    """A command of the pages on `fluxbore solve` that no longer works, or an error that reads otherwise now."""
    page = TOP / "docs" / name
    text = " ".join(page.read_text(encoding="utf-8").replace("\n> ", " ").split())
    found = commands(page)
    assert found
    for command in found:
        status = main(shlex.split(command)[1:])
        output = capsys.readouterr()
        if "circuit.coils" in command:
            assert status == 2
            assert output.err.strip() in text
        else:
            assert status == 0, (command, output.err)
            missing = [file for file in re.findall(r"--(?:png|vtu|ans|csv) (\S+)", command) if not Path(file).exists()]
            assert not missing, command


@pytest.mark.parametrize("name", ["solve.md", "femm.md"])
def test_the_python_on_femm_files_runs(newcomer: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    """The Python interface as the pages on FEMM files show it, and a slope of the coenergy that is no force."""
    for block in blocks(TOP / "docs" / name, "python"):
        exec(compile(block, name, "exec"), {})
    last = capsys.readouterr().out.splitlines()[-1]
    if name == "solve.md":
        assert float(last) == pytest.approx(-7.714, rel=5e-3)


@pytest.mark.parametrize("page", ["README.md", "docs/solve.md"])
def test_the_output_that_pages_quote_is_the_programs(
    newcomer: Path, capsys: pytest.CaptureFixture[str], page: str
) -> None:
    """Words that the program no longer prints, or figures that have moved; meshes differ a little between netgens."""
    command = next(command for command in commands(TOP / page) if command.startswith("fluxbore solve"))
    assert main(shlex.split(command)[1:]) == 0
    printed = capsys.readouterr().out.splitlines()
    quoted = next(
        block for block in blocks(TOP / page, "text") if block.startswith("examples/solenoid.fem:")
    ).splitlines()
    number = r"-?[0-9]+(?:\.[0-9]+)?"
    assert [re.sub(number, "#", line) for line in quoted] == [re.sub(number, "#", line) for line in printed]
    for ours, theirs in zip(quoted[2:], printed[2:], strict=True):
        measured, told = ([float(found) for found in re.findall(number, line)] for line in (ours, theirs))
        told_routes = "routes" in ours
        assert measured[: -1 if told_routes else None] == pytest.approx(told[: -1 if told_routes else None], rel=2e-3)


def test_the_tables_of_integrals_are_the_programs() -> None:
    """A block or line integral of another name or number than docs/femm.md has."""
    from dataclasses import fields

    from fluxbore.fem.integrals import INTEGRALS
    from fluxbore.fem.line_values import LineIntegrals

    text = (TOP / "docs" / "femm.md").read_text(encoding="utf-8")
    told = {
        tuple(map(int, numbers.split(", "))): (name, unit)
        for numbers, name, unit in re.findall(
            r"^\| ([0-9, ]+) \| `([\w.]+)` \| ([^|]+) \|", text.split("### Line integrals")[0], re.MULTILINE
        )
    }
    assert told == {
        item.numbers: (item.name, item.unit) for item in INTEGRALS if item.numbers and item.name != "centroid"
    }
    section = text.split("### Line integrals")[1].split("##")[0]
    names = {
        name
        for row in re.findall(r"^\| [0-5] \| ([^|]+)\|", section, re.MULTILINE)
        for name in re.findall(r"`(\w+)`", row)
    }
    assert names == {field.name for field in fields(LineIntegrals)} - {"errors"}


def test_the_keys_of_femm_files_are_accepted() -> None:
    """A key of the reference that `--set` refuses; boundaries and points of the examples are too few to try them."""
    from fluxbore.fem.femm_edit import edit
    from fluxbore.fem.femm_reader import read_model

    text = (TOP / "docs" / "reference.md").read_text(encoding="utf-8").split("## Keys of FEMM files")[1].split("## ")[0]
    keys = [
        key for key in re.findall(r"^\| `([^`]+)`", text, re.MULTILINE) if not key.startswith(("boundary", "point"))
    ]
    names = {"circuit": "winding", "material": "NdFeB", "group": "2"}
    tried = 0
    for key in keys:
        model = read_model(TOP / "examples" / ("solenoid.fem" if key.endswith(".z") else "rotor.fem"))
        kind = key.partition(".")[0]
        changed = edit(model, {re.sub(r"\b(NAME|N)\b", names.get(kind, ""), key): "0.5"})
        assert changed != model, key
        tried += 1
    assert tried >= 12


def test_the_position_figure_is_the_one_in_the_docs(tmp_path: Path) -> None:
    """A figure of the convention that no longer belongs to the model, for instance after a change of the parts."""
    draw = runpy.run_path(str(TOP / "docs" / "position_figure.py"))["draw"]
    made = tmp_path / "position.svg"
    draw().savefig(made, metadata={"Date": None})
    outlines = re.compile(r'<g id="patch_\d+">')
    kept = (TOP / "docs" / "position.svg").read_text(encoding="utf-8")
    assert len(outlines.findall(made.read_text(encoding="utf-8"))) == len(outlines.findall(kept))


def test_the_reference_is_the_programs_own() -> None:
    """A key, figure, unit or material that changed while the reference page did not."""
    page = runpy.run_path(str(TOP / "docs" / "reference.py"))["page"]
    assert page() == (TOP / "docs" / "reference.md").read_text(encoding="utf-8")


def test_the_tutorials_tables_can_be_read() -> None:
    """A section that the tutorial shows and that the reader refuses."""
    text = (TOP / "examples" / "ipehla.toml").read_text(encoding="utf-8")
    spec = loads(text + "\n" + "\n".join(blocks(TOP / "docs" / "tutorial.md", "toml")))
    assert spec.materials["our iron"].curve is not None
    assert spec.study.sweeps[-1].size == 9


def test_links_between_pages_lead_somewhere() -> None:
    """A page or picture that was renamed while others still point to it."""
    for page in [TOP / "README.md", TOP / "CONTRIBUTING.md", *(TOP / "docs").rglob("*.md")]:
        for target in re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8")):
            assert (page.parent / target).exists(), f"{page.name} points to {target}"


@pytest.mark.skipif(not has_gl(), reason="libGL does not load here")
def test_readme_names_the_files_that_the_job_leaves() -> None:
    """A result file that the README does not explain."""
    from fluxbore import api
    from fluxbore.optimize.folder import JOURNAL
    from fluxbore.optimize.table import FILE_NAME

    text = (TOP / "README.md").read_text(encoding="utf-8")
    for name in (api.REPORT_FILE, api.DESIGN_FILE, FILE_NAME, JOURNAL, f"{api.CAD_FOLDER}/iPEHLA.step"):
        assert f"out/{name}" in text
