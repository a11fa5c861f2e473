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
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


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
