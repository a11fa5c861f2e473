"""`fluxbore identify magnetic-spring`: its page, its example, and one sentence for a file it cannot use."""

from __future__ import annotations

import json
import re
import runpy
import shlex
import shutil
from pathlib import Path

import pytest

import fluxbore
from fluxbore.cli import main

TOP = Path(__file__).parent.parent
DATA = "examples/rotlin-spring.csv"
TABLE_II = {"stall_force": 192.0, "transfer_ratio": 8.1851e-4, "weight": 0.96}


@pytest.fixture(autouse=True)
def newcomer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the example."""
    (tmp_path / "examples").mkdir()
    for name in ("rotlin-spring.csv", "ipehla.toml"):
        shutil.copy(TOP / "examples" / name, tmp_path / "examples" / name)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(["identify", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("fluxbore: ")
    assert err.endswith(".\n")
    assert err.count("\n") == 1
    return err


def test_the_page_s_command_and_script_give_what_it_quotes(capsys: pytest.CaptureFixture[str]) -> None:
    page = (TOP / "docs" / "magnetic_spring.md").read_text(encoding="utf-8")
    found = re.findall(r"^```(\w*)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    assert [language for language, _ in found] == ["python", "text", "", "text"]
    exec(compile(found[0][1], "magnetic_spring.md", "exec"), {})
    assert capsys.readouterr().out == found[1][1]
    assert main(shlex.split(found[2][1])[1:]) == 0
    assert capsys.readouterr().out == found[3][1]


def test_the_example_is_what_its_script_writes() -> None:
    script = runpy.run_path(str(TOP / "docs" / "validation" / "magnetic_spring.py"))
    assert script["rows"]() == Path(DATA).read_text(encoding="utf-8")


def test_the_answer_in_json(capsys: pytest.CaptureFixture[str]) -> None:
    """Table II within intervals, in SI units; a model without a specification has nothing for one."""
    assert main(["identify", "magnetic-spring", DATA, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    for name, value in TABLE_II.items():
        estimate = found["parameters"][name]
        assert estimate["low"] < value < estimate["high"]
        assert estimate["given"] is None
    assert found["derived"]["psi"]["low"] < 3000.0 < found["derived"]["psi"]["high"]
    assert found["parameters"]["transfer_ratio"]["unit"] == "m"
    assert found["toml"] == ""
    assert found["specification"] is False


@pytest.mark.parametrize("law", ["sine", "linear", "polynomial"])
def test_the_other_laws(capsys: pytest.CaptureFixture[str], law: str) -> None:
    assert main(["identify", f"magnetic-spring-{law}", DATA]) == 0
    out = capsys.readouterr().out
    assert out.startswith(f"magnetic-spring-{law} from rotlin-spring.csv: 241 rows\n")
    assert "specification" not in out
    found = fluxbore.identify(f"magnetic-spring-{law}", DATA, free=["zero_displacement"])
    assert found.spec is None
    assert abs(found.found.parameters["zero_displacement"].value) < 5e-6


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time,displacement [mm],force\n0,0,0\n1,0.1,20\n3,0.2,41\n4,0.1,22\n", "line 4: time must rise by 1 s as"),
        ("time,displacement [mm],force\n0,0,0\n2,0.1,20\n1,0.2,41\n", "line 4: time must rise from row to row"),
        ("displacement [mm],force\n0,0\n0.1,nan\n", 'line 3: force must hold finite numbers; got "nan"'),
        ("displacement [mm]\n0\n", "the column force must be there"),
        ("displacement [N],force\n0,0\n", "displacement must be in a unit of mm"),
        ("", "must begin with a header"),
    ],
)
def test_files_that_are_none(capsys: pytest.CaptureFixture[str], text: str, words: str) -> None:
    Path("loops.csv").write_text(text, encoding="utf-8")
    assert words in refusal(capsys, "magnetic-spring", "loops.csv")


def test_what_cannot_be_asked(capsys: pytest.CaptureFixture[str]) -> None:
    words = refusal(capsys, "magnetic-spring", DATA, "--spec", "examples/ipehla.toml")
    assert "--spec must be left out: magnetic-spring is identified from its data alone" in words
    assert 'free must be one of zero_displacement for magnetic-spring-sine; got "start_state"' in refusal(
        capsys, "magnetic-spring-sine", DATA, "--free", "start_state"
    )
