"""`fluxbore export`: its words, what it says of parts that overlap, and whose files it touches."""

import json
from pathlib import Path

import pytest

from fluxbore import export_command, exporting
from fluxbore.actuators import STROKE_PLACES
from fluxbore.cli import main
from fluxbore.design.spec import Spec, load
from fluxbore.exit_status import DONE, INPUT_WRONG, NOT_VALID
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.own_files import LIST
from fluxbore.geometry.part import Part
from fluxbore.geometry.standing import narrowest, standings

EXAMPLES = Path(__file__).parents[1] / "examples"
TEAM_22, ROTLIN = str(EXAMPLES / "team22.toml"), str(EXAMPLES / "rotlin.toml")


def block(name: str, group: str, inner: float, outer: float, start: float = 0.0) -> Part:
    return Part(name, name, group, "brass", (0.5, 0.5, 0.5), rectangle(inner, outer, start, start + 0.01))


def moving(spec: Spec, place: float = 0.5) -> Assembly:
    """A ring that is squeezed, and a rod that runs into a stop when it is out."""
    parts = (
        block("stop", "stator", 0.0, 0.01, 0.03),
        block("tube", "stator", 0.006, 0.01),
        Part("rod", "rod", "mover", "brass", (0.5, 0.5, 0.5), rectangle(0.0, 0.0055, 0.0, 0.01 + 0.021 * place)),
        block("seal", "mover", 0.0055, 0.0061),
    )
    return Assembly("stopped", parts, place, squeezes=(("seal", "tube"),))


def test_the_commands_words_are_the_tables() -> None:
    assert sorted(export_command.FORMATS) == sorted(exporting.WORDS)
    assert set(exporting.OF_A_RUN) - set(exporting.FORMATS) <= {"winding"}
    assert all(form.summary for form in exporting.FORMATS.values())


def test_overlaps_and_gaps_are_told_place_by_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Catches a file that goes to a workshop with parts that cannot be put together, and nobody is told."""
    monkeypatch.setattr(exporting, "assembly_of", moving)
    assert main(["export", TEAM_22, "-o", str(tmp_path / "a"), "--format", "glb"]) == NOT_VALID
    file, *lines = capsys.readouterr().out.splitlines()
    assert Path(file).exists()
    squeezed = "squeezed by design: tube in seal 38 mm³; narrowest gap 0.5 mm, rod to tube"
    assert lines[0] == f"mid-stroke, 500 mm: {squeezed}"
    assert lines[-1] == "stop and rod must not overlap, extended; they share 95 mm³."
    assert main(["export", TEAM_22, "-o", str(tmp_path / "b"), "--format", "glb", "--json"]) == NOT_VALID
    told = json.loads(capsys.readouterr().out)
    assert told["status"] == "parts overlap"
    assert told["reasons"] == lines[-1:]
    assert [place["place"] for place in told["places"]] == list(STROKE_PLACES)
    extended = told["places"][2]["interferences"]
    assert [(item["first"], item["second"], item["designed"]) for item in extended] == [
        ("stop", "rod", False),
        ("tube", "seal", True),
    ]
    assert extended[0]["volume"] == pytest.approx(3.14159 * 0.0055**2 * 1e-3, rel=1e-5)


def test_what_fits_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of a kind that does not move there is one place, without a gap that moves."""
    assert main(["export", TEAM_22, "-o", str(tmp_path / "a"), "--format", "glb", "--json"]) == DONE
    told = json.loads(capsys.readouterr().out)
    assert (told["status"], told["reasons"]) == ("ok", [])
    assert [(place["interferences"], place["gap"]) for place in told["places"]] == [([], None)]


def test_the_narrowest_gap_is_found_behind_wider_ones(tmp_path: Path) -> None:
    spec = load(TEAM_22)
    found = standings({"here": moving(spec, 0.2), "there": moving(spec, 0.9)})
    assert [standing.place for standing in found] == ["here", "there"]
    gap = narrowest(moving(spec, 0.9))
    assert gap is not None
    assert (gap.first, gap.second, gap.distance) == ("rod", "tube", pytest.approx(0.0005))


def test_the_field_of_a_kind_that_has_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", TEAM_22, "-o", str(tmp_path / "a"), "--format", "vtu"]) == DONE
    (file,) = capsys.readouterr().out.split()
    assert Path(file).name == "TEAM-22.vtu"
    assert Path(file).read_bytes().startswith(b'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid"')
    assert main(["export", ROTLIN, "-o", str(tmp_path / "b"), "--format", "vtu"]) == INPUT_WRONG
    assert 'actuator.kind must be "coils" or "hybrid"' in capsys.readouterr().err
    assert not (tmp_path / "b").exists()


def test_a_schema_that_is_none_is_refused(tmp_path: Path) -> None:
    import fluxbore

    with pytest.raises(fluxbore.FluxboreError, match='must be AP242 or AP214; got "AP203"'):
        fluxbore.export(TEAM_22, tmp_path / "a", form="bom", schema="AP203")
    assert not (tmp_path / "a").exists()


def test_another_design_takes_the_folder_by_force_and_nobodys_file(tmp_path: Path) -> None:
    import fluxbore

    folder = tmp_path / "a"
    fluxbore.export(TEAM_22, folder, form=["bom", "glb"])
    fluxbore.export(TEAM_22, folder, form="fem")
    (folder / "TEAM-22.glb").write_bytes(b"mended")
    (folder / "notes.txt").write_text("mine")
    fluxbore.export(str(EXAMPLES / "fabry.toml"), folder, form="bom", force=True)
    left = {path.name for path in folder.iterdir() if not path.name.startswith(".")}
    assert left - {"journal.jsonl"} == {"TEAM-22.glb", "notes.txt", "Fabry-solenoid-parts.csv"}
    assert (folder / LIST).exists()
