"""Lead screws at the command line: what cannot be built or studied is one sentence, and a failed design is a row."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

import fluxbore
from fluxbore.cli import main

EXAMPLES = Path(__file__).parent.parent / "examples"
ROTLIN, STUDY = str(EXAMPLES / "rotlin.toml"), str(EXAMPLES / "rotlin-pitch.toml")
ARCS = ("actuator.rotor.magnets=stepped arcs", "actuator.rotor.arcs_per_turn=6")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to stand in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def settings(*changes: str) -> list[str]:
    return [word for change in changes for word in ("--set", change)]


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """The one sentence of a command that must be refused, and must leave nothing behind."""
    assert main(list(arguments)) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("fluxbore: ")
    assert err.endswith(".\n")
    assert err.count("\n") == 1
    assert not list(Path().iterdir())
    return err.removeprefix("fluxbore: ").rstrip("\n")


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            ("actuator.translator.magnet_width=2.6 mm",),
            "actuator.pitch must be at least two magnet widths, 5.2 mm by actuator.translator.magnet_width; "
            "got 5.14285714285714 mm.",
        ),
        (
            (*ARCS, "actuator.rotor.arc_angle=61 deg"),
            "actuator.rotor.arc_angle must be at most 60 deg, or the 6 arcs of a turn overlap; got 61 deg.",
        ),
        (ARCS, 'actuator.rotor.arc_angle is missing: actuator.rotor.magnets is "stepped arcs".'),
        (
            ("actuator.rotor.arc_angle=60 deg",),
            'actuator.rotor.arc_angle must not be given where actuator.rotor.magnets is "continuous".',
        ),
        (
            ("actuator.gap_tolerance=0.8 mm",),
            "actuator.gap must exceed actuator.gap_tolerance 0.8 mm, or the members touch; got 0.8 mm.",
        ),
        (
            ("actuator.gap_tolerance=0 mm", "actuator.gap=1e-9 mm"),
            "actuator.gap must be at least 1.745e-08 mm, 1e-09 of actuator.translator.outer_radius; got 1e-09 mm.",
        ),
        (
            ("actuator.translator.length=10 mm",),
            "actuator.translator.length must be at least the length of the rotor's poles, 10.2857142857143 mm; "
            "got 10 mm.",
        ),
        (
            ("actuator.rotor.length=10 mm",),
            "actuator.rotor.length must be at least the length of its poles, 10.2857142857143 mm; got 10 mm.",
        ),
        (("actuator.rotor.magnets=spiral",), "actuator.rotor.magnets must be one of continuous, helical arcs,"),
        (("actuator.rotor.magnet=N99",), "actuator.rotor.magnet must name a permanent magnet, one of N42,"),
        (("actuator.rotor.magnet=1010",), "actuator.rotor.magnet must name a permanent magnet"),
        (("actuator.rotor.iron=copper",), "actuator.rotor.iron must name a soft iron"),
        (("actuator.rotor.frame=1010",), "actuator.rotor.frame must name a non-magnetic material"),
        (("actuator.rotor.remanence=0 T",), "actuator.rotor.remanence must exceed 0 T; got 0 T."),
        (("actuator.pitch=-1 mm",), "actuator.pitch must exceed 0 mm; got -1 mm."),
        (("actuator.pitch=5 N",), "actuator.pitch must be a length, one number and one unit of"),
        (("actuator.pitch=5.14",), "got the bare number 5.14."),
        (("actuator.starts=0",), "actuator.starts must be at least 1; got 0."),
        (("actuator.poles=2.5",), "actuator.poles must be a whole number, such as 4; got 2.5."),
        (("actuator.rotor.iron_thickness=-1 mm",), "actuator.rotor.iron_thickness must be at least 0 mm; got -1 mm."),
        (
            ("actuator.motor.length=",),
            "actuator.motor.length is missing: it is needed with actuator.motor",
        ),
        (
            ("actuator.motor.outer_radius=20 mm",),
            "actuator.motor.outer_radius must not be below actuator.rotor.outer_radius 26.25 mm; got 20 mm.",
        ),
        (
            ("actuator.rotor.frame_thickness=1 mm",),
            "The specification is over-determined: give exactly two of actuator.translator.outer_radius,",
        ),
        (("operating_point.load_force=-5 N",), "operating_point.load_force must be at least 0 N; got -5 N."),
        (("actuator.winding.turns=5",), "actuator.winding is not a key of this specification."),
    ],
)
def test_what_cannot_be_built(capsys: pytest.CaptureFixture[str], changes: tuple[str, ...], sentence: str) -> None:
    """By `check`, and as surely by a command that would write."""
    found = refusal(capsys, "check", ROTLIN, *settings(*changes))
    assert sentence in found
    assert refusal(capsys, "sweep", ROTLIN, "-o", "out", *settings(*changes)) == found


@pytest.mark.parametrize(
    ("command", "changes", "words"),
    [
        ("optimize", ("study.objective=maximise stall_power",), "study.objective must name a figure"),
        ("optimize", ("study.hold.0=actuator.poles",), "study.hold.0 must be a key that has alternatives, one of"),
        ("optimize", ("study.hold.0=actuator.gap",), "study.hold.0 must be a key that has alternatives, one of"),
        ("optimize", ("study.variables.0.key=benchmark.force.psi",), "study.variables.0.key"),
        ("optimize", ("study.variables.0.key=solver.mesh_refinement",), "study.variables.0.key"),
        ("optimize", ("study.variables.6.lower=1.5",), "study.variables.6.lower must be a whole number"),
        ("optimize", ("study.variables.6.lower=0",), "actuator.poles must be at least 1; got 0"),
        ("optimize", ("study.variables.6.resolution=1",), "study.variables.6"),
        ("optimize", ("study.variables.1.lower=2 mm",), "study.variables.1"),
        ("optimize", ("study.constraints.0.upper=start s",), "study.constraints.0.upper"),
        ("optimize", ("study.constraints.4.upper=1.6 N",), "must be a flux density"),
        (
            "optimize",
            ("study.hold.3=actuator.translator.outer_radius",),
            "at most 2 of actuator.translator.outer_radius, actuator.rotor.outer_radius, actuator.rotor.frame",
        ),
        ("pareto", ("study.pareto.against=maximise spring_constant",), "study.variables must be continuous"),
        ("sweep", ("study.sweeps.0.axes.0.key=actuator.rotor.magnets",), "study.sweeps.0.axes.0.key"),
        ("sweep", ("study.sweeps.0.axes.0.step=0 mm",), "study.sweeps.0.axes.0.step"),
    ],
)
def test_what_cannot_be_studied(
    capsys: pytest.CaptureFixture[str], command: str, changes: tuple[str, ...], words: str
) -> None:
    assert words in refusal(capsys, command, STUDY, "-o", "out", *settings(*changes))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("study.production.tolerances.0.key=actuator.poles", "study.production.tolerances.0.key"),
        ("study.production.tolerances.0.tolerance=-1 mm", "study.production.tolerances.0"),
        ("study.production.tolerances.1.tolerance=0.1 mm", "study.production.tolerances.1.tolerance must be a flux"),
    ],
)
def test_what_cannot_scatter(capsys: pytest.CaptureFixture[str], change: str, words: str) -> None:
    spec = str(EXAMPLES / "rotlin-tolerance.toml")
    assert words in refusal(capsys, "tolerance", spec, "-o", "out", "--set", change)


def test_a_pitch_that_cannot_be_built_is_a_row_with_its_reason(capsys: pytest.CaptureFixture[str]) -> None:
    """A sweep beyond what the translator's length holds goes on, and its figures are there where there are any."""
    axis = "study.sweeps.0.axes.0"
    short = settings(f"{axis}.from=5 mm", f"{axis}.to=65 mm", f"{axis}.step=20 mm")
    arguments = ["sweep", STUDY, "-o", "out", "--fidelity", "network", "--workers", "1", "--quiet", *short]
    assert main(arguments) == 0
    capsys.readouterr()
    with Path("out/results.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["status"] for row in rows] == ["ok", "ok", "invalid", "invalid"]
    assert "actuator.translator.length must be at least the length of the rotor's poles" in rows[-1]["reason"]
    alone = fluxbore.evaluate(fluxbore.load(STUDY, {"actuator.pitch": "5 mm"}), "network").performance
    assert float(rows[0]["stall_force"]) == pytest.approx(alone.stall_force, rel=1e-9)
    assert rows[-1]["stall_force"] == ""


def test_a_field_that_does_not_converge_is_a_reason(capsys: pytest.CaptureFixture[str]) -> None:
    saturated = settings("solver.max_iterations=1", "actuator.rotor.iron_thickness=0.1 mm")
    assert main(["evaluate", ROTLIN, "--json", *saturated]) == 3
    found = json.loads(capsys.readouterr().out)
    assert found["status"] == "not converged"
    assert len(found["reasons"]) == 1
    assert found["reasons"][0].endswith(".")
