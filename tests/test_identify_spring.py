"""`fluxbore identify magnetic-spring`: its page, its example, and one sentence for a file it cannot use."""

from __future__ import annotations

import json
import math
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
SPEC = "examples/rotlin.toml"
TABLE_II = {"stall_force": 192.0, "transfer_ratio": 8.1851e-4, "weight": 0.96}


@pytest.fixture(autouse=True)
def newcomer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the example."""
    (tmp_path / "examples").mkdir()
    for name in ("rotlin-spring.csv", "ipehla.toml", "rotlin.toml"):
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
    assert [language for language, _ in found] == ["python", "text", "", "text", "", "text"]
    exec(compile(found[0][1], "magnetic_spring.md", "exec"), {})
    assert capsys.readouterr().out == found[1][1]
    for command, answer in (found[2:4], found[4:6]):
        assert main(shlex.split(command[1])[1:]) == 0
        assert capsys.readouterr().out == answer[1]


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


def test_beside_a_specification(capsys: pytest.CaptureFixture[str]) -> None:
    """Its own values with their units, and lines that can take the place of those that it has."""
    assert main(["identify", "magnetic-spring", DATA, "--spec", SPEC, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    known = {**found["parameters"], **found["derived"]}
    own = {**TABLE_II, "psi": 3000.0, "xi": 1000.0, "rising_rate": 4000.0, "pitch": 36e-3 / 7}
    assert {name: known[name]["given"] for name in own} == pytest.approx(own, rel=1e-4)
    section, text = "", []
    names = [line.partition(" = ")[0] for line in found["toml"].splitlines()[1:]]
    assert names == ["stall_force", "elastic_share", "psi", "xi"]
    for line in Path(SPEC).read_text(encoding="utf-8").splitlines():
        section = line if line.startswith("[") else section
        if not (section.startswith("[benchmark.force]") and line.partition(" = ")[0] in names):
            text.append(found["toml"] if line.startswith("[benchmark.force]") else line)
    Path("mine.toml").write_text("\n".join(text), encoding="utf-8")
    spec = fluxbore.load("mine.toml")
    for name in ("stall_force", "psi", "xi"):
        assert spec.number(f"benchmark.force.{name}") == pytest.approx(known[name]["value"], rel=1e-3)
    assert {note.key for note in spec.notes} >= {f"benchmark.force.{name}" for name in names}


@pytest.mark.parametrize(
    ("law", "name", "stall_force", "expected"),
    [
        ("linear", "spring_constant", "192 N", 220e3),
        ("sine", "spring_constant", "192 N", 192.0 * 2 * math.pi / (36e-3 / 7)),
        ("sine", "stall_force", "", None),
    ],
)
def test_what_a_specification_has(
    capsys: pytest.CaptureFixture[str], law: str, name: str, stall_force: str, expected: float | None
) -> None:
    """The stand's own, else the design's: by the analytic field where the section leaves it out."""
    change = f"benchmark.force.stall_force={stall_force}"
    arguments = [f"magnetic-spring-{law}", DATA, "--spec", SPEC, "--set", change, "--json"]
    assert main(["identify", *arguments]) == 0
    found = json.loads(capsys.readouterr().out)
    known = {**found["parameters"], **found["derived"]}
    if expected is None:
        expected = fluxbore.evaluate(fluxbore.load(SPEC), "network").performance.stall_force
        assert expected == pytest.approx(192.0, rel=1e-3)
    assert known[name]["given"] == pytest.approx(expected, rel=1e-12)


def test_what_cannot_be_asked(capsys: pytest.CaptureFixture[str]) -> None:
    words = refusal(capsys, "magnetic-spring", DATA, "--spec", "examples/ipehla.toml")
    assert 'actuator.kind must be "lead-screw" to identify magnetic-spring; got "hybrid"' in words
    words = refusal(capsys, "magnetic-spring-polynomial", DATA, "--spec", SPEC)
    assert "--spec must be left out: magnetic-spring-polynomial is identified from its data alone" in words
    words = refusal(capsys, "magnetic-spring", DATA, "--spec", SPEC, "--set", "benchmark.force.eta=2")
    assert "benchmark.force.eta must be 1, as the memory is identified with it; got 2" in words
    assert 'free must be one of zero_displacement for magnetic-spring-sine; got "start_state"' in refusal(
        capsys, "magnetic-spring-sine", DATA, "--free", "start_state"
    )
