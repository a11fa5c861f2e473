"""Electro-hydrostatic actuators at the command line: what cannot be built is one sentence, what fails has a reason."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from fluxbore.cli import main

EXAMPLE = str(Path(__file__).parent.parent / "examples" / "prehydra.toml")

FIGURES = ("evaluate", EXAMPLE, "--json", "--fidelity")
SWEEP = """
[[study.sweeps]]
name = "bore"

[[study.sweeps.axes]]
key = "actuator.output_cylinder.bore"
from = "12 mm"
to = "16 mm"
step = "2 mm"
"""

PRELOAD, LEAST = "actuator.return_spring.preload=5 N", "operating_point.least_force=5 N"


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
        (("actuator.motor.peak_torque=",), "actuator.motor.peak_torque (peak torque) is missing."),
        (("actuator.fluid.viscosity=",), "actuator.fluid.viscosity (at the reference temperature) is missing."),
        (("actuator.output_cylinder.bore=",), "actuator.output_cylinder.bore (bore) is missing."),
        (
            ("actuator.return_spring.element=rubber cord",),
            'actuator.return_spring.cord_length is missing: actuator.return_spring.element is "rubber cord".',
        ),
        (
            ("actuator.return_spring.element=elastic",),
            'actuator.return_spring.element must be one of linear spring, constant force, rubber cord; got "elastic".',
        ),
        (
            ("actuator.output_cylinder.dead_volume=-1 cm^3",),
            "actuator.output_cylinder.dead_volume must be at least 0 mm^3; got -1000 mm^3.",
        ),
        (("actuator.pressure_block.volume=-5 cm^3",), "actuator.pressure_block.volume must be at least 0 mm^3"),
        (
            ("actuator.seal.groove_width=2 mm",),
            "actuator.seal.ring_inner_diameter is missing: the groove must be given whole, or not at all.",
        ),
        (
            (
                "actuator.seal.groove_diameter=15 mm",
                "actuator.seal.groove_width=2 mm",
                "actuator.seal.ring_inner_diameter=11 mm",
            ),
            "actuator.seal.groove_diameter must be below the bore, 14.3 mm; got 15 mm.",
        ),
        (
            ("actuator.seal.ring_section=20 mm",),
            "actuator.seal.ring_section must leave a groove's floor in a bore of 14.3 mm; got 20 mm.",
        ),
        (("actuator.ball_screw.lead=0 mm",), "actuator.ball_screw.lead must exceed 0 mm; got 0 mm."),
        (("actuator.ball_screw.lead=5",), "got the bare number 5."),
        (("actuator.ball_screw.lead=5 N",), 'such as "27 mm"; got "5 N" with the unit "N".'),
        (("actuator.ball_screw.efficiency=1.2",), "actuator.ball_screw.efficiency must be at most 1; got 1.2."),
        (
            ("actuator.output_cylinder.bore=20 mm",),
            "actuator.input_cylinder.stroke must displace what the output cylinder takes over its stroke, 47.88 ml; "
            "got 24.48 ml.",
        ),
        (
            ("actuator.output_cylinder.rod_diameter=15 mm",),
            "actuator.output_cylinder.rod_diameter must not exceed the bore 14.3 mm; got 15 mm.",
        ),
        (
            ("actuator.motor.peak_torque=0.5 N m",),
            "actuator.motor.peak_torque must not be below actuator.motor.continuous_torque 0.84 N m; got 0.5 N m.",
        ),
        (
            ("actuator.fluid.hot_temperature=26.7 degC",),
            "actuator.fluid.hot_temperature must exceed actuator.fluid.reference_temperature 26.7 degC; got 26.7 degC.",
        ),
        (
            ("actuator.output_cylinder.piston_length=1 mm",),
            "actuator.output_cylinder.piston_length must hold the O-ring",
        ),
        (("actuator.output_cylinder.cap_length=1 mm",), "actuator.output_cylinder.cap_length must hold the port"),
        (("actuator.output_cylinder.material=unobtainium",), "actuator.output_cylinder.material must name a material"),
        (("actuator.output_cylinder.rod=N48",), 'got "N48", a permanent magnet.'),
        (("actuator.hose.boer=5 mm",), "did you mean actuator.hose.bore?"),
        (("actuator.fluid.air_fraction=0.9",), "actuator.fluid.air_fraction must be at most 0.5; got 0.9."),
        (("operating_point.frequency=0 Hz",), "operating_point.frequency must exceed 0 Hz; got 0 Hz."),
        (("benchmark.tracking.pairs=none",), "benchmark.tracking.pairs must be one of all, published"),
    ],
)
def test_what_cannot_be_built(capsys: pytest.CaptureFixture[str], changes: tuple[str, ...], sentence: str) -> None:
    """By `check`, and as surely by a command that would write."""
    found = refusal(capsys, "check", EXAMPLE, *settings(*changes))
    assert sentence in found
    assert refusal(capsys, "report", EXAMPLE, "-o", "out", *settings(*changes)) == found


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            ("operating_point.force_amplitude=300 N", "operating_point.frequency=0.5 Hz"),
            "operating_point.least_force and twice operating_point.force_amplitude must not exceed what the return "
            "element pushes back with at the end of actuator.output_cylinder.stroke, 477.8 N; got 645 N.",
        ),
        (
            ("operating_point.least_force=10 N",),
            "operating_point.least_force must not be below the return element's force with the piston retracted, 45 N; "
            "got 10 N.",
        ),
        (
            (PRELOAD, LEAST, "operating_point.force_amplitude=20 N", "operating_point.frequency=10 Hz"),
            "The least pressure at the operating point must not fall below the fluid's vapour pressure, -0.09899 MPa "
            "gauge; got -0.1991 MPa gauge.",
        ),
        (
            (PRELOAD, LEAST, "actuator.fluid.vapour_pressure=0 bar gauge"),
            "must not fall below the fluid's vapour pressure, 0 MPa gauge; got -0.0959 MPa gauge.",
        ),
    ],
)
def test_what_fails_has_one_reason(capsys: pytest.CaptureFixture[str], changes: tuple[str, ...], sentence: str) -> None:
    """The same one by either route; a study goes on with it as a row."""
    for route in ("network", "fem"):
        assert main([*FIGURES, route, *settings(*changes)]) == 3
        found = json.loads(capsys.readouterr().out)
        assert found["status"] == "invalid"
        (reason,) = found["reasons"]
        assert sentence in reason
        assert reason.count(". ") == 0


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            ("operating_point.frequency=1e-4 Hz",),
            "The operating point must be simulated in 100000 steps or fewer; operating_point.frequency 0.0001 Hz and ",
        ),
        (  # not even one period of it, if periods were counted by rounding
            ("operating_point.frequency=1e-10 Hz",),
            "The operating point must be simulated in 100000 steps or fewer; operating_point.frequency 1e-10 Hz and ",
        ),
        (
            ("actuator.drive.force_gain=1 m/(N s)",),
            "The output piston must stay within actuator.output_cylinder.stroke 152.4 mm; got",
        ),
    ],
)
def test_what_fails_in_time_alone(capsys: pytest.CaptureFixture[str], changes: tuple[str, ...], sentence: str) -> None:
    """A loop without stability and a run without end have figures in closed form, and a reason where simulated."""
    assert main([*FIGURES, "network", *settings(*changes)]) == 0
    capsys.readouterr()
    assert main([*FIGURES, "fem", *settings(*changes)]) == 3
    assert sentence in json.loads(capsys.readouterr().out)["reasons"][0]


def test_a_bore_that_cannot_be_is_a_row_with_its_reason(capsys: pytest.CaptureFixture[str]) -> None:
    """The sweep goes on, and a narrower cylinder weighs less."""
    text = Path(EXAMPLE).read_text(encoding="utf-8")
    Path("spec.toml").write_text(text + SWEEP, encoding="utf-8")
    arguments = ["sweep", "spec.toml", "-o", "out", "--fidelity", "network", "--workers", "1", "--quiet"]
    assert main(arguments) == 0
    capsys.readouterr()
    with Path("out/results.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["status"] for row in rows] == ["ok", "ok", "invalid"]
    assert "actuator.input_cylinder.stroke must displace" in rows[-1]["reason"]
    assert float(rows[0]["distal_mass"]) < float(rows[1]["distal_mass"])
    assert rows[-1]["distal_mass"] == ""
