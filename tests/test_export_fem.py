"""`fluxbore export --format fem`: the design as a file that this program, too, reads and solves."""

import json
from pathlib import Path

import pytest

from fluxbore.cli import main
from fluxbore.design.spec_file import template
from fluxbore.fem.femm_reader import read_model


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "spec.toml").write_text(template("ipehla"))
    return tmp_path


def export(*arguments: str) -> int:
    return main(["export", "spec.toml", "--format", "fem", *arguments])


def test_the_file_is_a_model(capsys):
    """Catches a file that is named and not there, or that our own reader refuses."""
    assert export("-o", "out", "--json") == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert json.loads(out) == {"status": "ok", "reasons": [], "files": ["out/iPEHLA.fem"]}
    model = read_model("out/iPEHLA.fem")
    assert model.axisymmetric
    assert model.unit == "millimeters"
    assert [circuit.name for circuit in model.circuits] == ["U", "V", "W"]
    assert {label.group for label in model.labels} == {0, 1, 2, 3}


def test_its_mover_is_pulled_as_the_specification_s(capsys):
    """Catches groups and turns that are not the design's.

    The published motor has 8.67 N/A, by all three phases with the current at the best angle: one and a half times what
    one phase alone does where it does most, which is phase V with the mover in the middle.
    """
    assert export("-o", "out") == 0
    capsys.readouterr()
    question = ("--group", "1", "--accuracy", "50", "--set", "circuit.V.current=1", "--json")
    assert main(["solve", "out/iPEHLA.fem", *question]) == 0
    force = json.loads(capsys.readouterr().out)["groups"]["1"]["force"][1]
    assert 1.5 * abs(force) == pytest.approx(8.67, rel=0.03)


def test_again_and_over_other_files(capsys, folder):
    """Catches somebody's folder that is taken without a question, and an own one that is refused."""
    assert export("-o", "out") == 0
    first = (folder / "out/iPEHLA.fem").read_bytes()
    assert export("-o", "out") == 0
    assert (folder / "out/iPEHLA.fem").read_bytes() == first
    capsys.readouterr()
    Path("mine").mkdir()
    Path("mine/notes.txt").write_text("mine")
    assert export("-o", "mine") == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert "mine must be empty" in err
    assert [path.name for path in Path("mine").iterdir()] == ["notes.txt"]
    assert export("-o", "mine", "--force") == 0
    assert {"notes.txt", "iPEHLA.fem"} <= {path.name for path in Path("mine").iterdir()}


def test_another_design_is_another_file(capsys):
    """Catches --set that does not reach the file."""
    thickness = "actuator.back_yoke.thickness"
    assert export("-o", "thin") == 0
    assert export("-o", "thick", "--set", f"{thickness}=1.3 mm") == 0
    radii = [
        {round(node.x, 6) for node in read_model(f"{name}/iPEHLA.fem").nodes if node.group == 2}
        for name in ("thin", "thick")
    ]
    assert radii[0] - radii[1] == {12.5}, "mm; the yoke's outer radius is given, so that the inner one moves"
    assert 12.2 in radii[1]


@pytest.mark.parametrize(
    "arguments", [("-o", ""), ("-o", "spec.toml"), ("-o", "out", "--set", "actuator.back_yoke.thickness=-1 mm"), ()]
)
def test_refusals_leave_nothing(arguments, capsys, folder):
    assert export(*arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert [path.name for path in folder.iterdir()] == ["spec.toml"]
