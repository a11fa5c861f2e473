"""Whole reports of lead screws that lack this or have too much of that (-m full)."""

import re
from pathlib import Path

import pytest

import fluxbore

pytestmark = pytest.mark.full

ROTLIN = Path(__file__).parents[2] / "examples" / "rotlin.toml"

ARCS = {
    "magnets": "stepped arcs",
    "arc_angle": "60 deg",
    "arcs_per_turn": "6",
}

CASES = {
    "no motor, load or iron": (
        {
            "actuator.motor.outer_radius": "",
            "actuator.motor.length": "",
            "actuator.motor.torque_constant": "",
            "operating_point.load_force": "",
            "operating_point.acceleration": "",
            "actuator.translator.iron_thickness": "",
            "actuator.rotor.iron_thickness": "",
        },
        ("The specification names no load.", "Every load drives the rotor back", "None (specified)"),
    ),
    "arcs": (
        {f"actuator.{member}.{name}": text for member in ("translator", "rotor") for name, text in ARCS.items()}
        | {"actuator.rotor.magnet_width": "2.3 mm"},
        ("computed as their mean over the rotor’s angle", "Below 4.6 mm: actuator.pitch must be at least"),
    ),
    "load above the stall force": (
        {
            "operating_point.load_force": "250 N",
            "operating_point.friction_torque": "0.02 N m",
            "operating_point.stroke": "80 mm",
        },
        ("holds it nowhere", "The screw slips:", "turns the rotor back against the friction from", "poles run out"),
    ),
    "thin iron, a long pitch": (
        {
            "actuator.pitch": "30 mm",
            "operating_point.stroke": "20 mm",
            "actuator.rotor.iron_thickness": "0.4 mm",
            "operating_point.friction_torque": "200 N m",
        },
        ("No load turns the rotor back", "trust the circles", "Above 32.5 mm: actuator.translator.length must be"),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_page_reads_right(name: str, tmp_path: Path) -> None:
    overrides, sentences = CASES[name]
    spec = fluxbore.load(ROTLIN, overrides)
    found = fluxbore.report(spec, tmp_path / "report.html", picture=False)
    page = re.sub(r"(?s)<style>.*?</style>", "", found.files[0].read_text(encoding="utf-8"))
    text = re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", page))
    assert [sentence for sentence in sentences if sentence not in text] == []
    assert not re.search(r"\b(nan|inf)\b", text)
    assert page.count("<svg") >= 6
