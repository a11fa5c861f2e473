"""The main job as the README has it, with every figure that the README quotes."""

from __future__ import annotations

import contextlib
import io
import json
import re
from pathlib import Path

import pytest

from fluxbore.cli import main

TOP = Path(__file__).parents[2]

pytestmark = pytest.mark.full


def test_readme_quotes_what_the_main_job_finds(tmp_path: Path) -> None:
    """Figures in the README that the program no longer computes."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        arguments = ["design", str(TOP / "examples" / "ipehla.toml"), "-o", str(tmp_path / "out"), "--json", "--quiet"]
        assert main(arguments) == 0
    found = json.loads(printed.getvalue())
    start, chosen = (found["search"][name] for name in ("start", "chosen"))
    best = found["search"]["best"]
    readme = (TOP / "README.md").read_text(encoding="utf-8")

    def row(label: str) -> list[float]:
        line = next(line for line in readme.splitlines() if line.startswith(f"| {label}"))
        return [float(re.findall(r"[\d.]+", cell)[0]) for cell in line.split("|")[2:4]]

    ring, yoke = "actuator.mover.ring_width", "actuator.back_yoke.thickness"
    assert row("soft-magnetic ring width") == pytest.approx([start["values"][ring] * 1e3, chosen["values"][ring] * 1e3])
    assert row("back-yoke thickness") == pytest.approx([start["values"][yoke] * 1e3, chosen["values"][yoke] * 1e3])
    for label, figure, scale, half in (
        ("force constant by finite elements", "force_constant", 1.0, 5e-4),
        ("stray field", "stray_field", 1e3, 5e-4),
        ("resistance of a phase", "winding_resistance", 1.0, 5e-3),
    ):
        for quoted, design in zip(row(label), (start, chosen), strict=True):
            assert quoted == pytest.approx(design["performance"][figure] * scale, abs=half)
    gains = [float(text) for text in re.findall(r"they gain ([\d.]+) % \(([\d.]+) %", readme)[0]]
    for quoted, design in zip(gains, (best, chosen), strict=True):
        assert quoted == pytest.approx((design["objective"] / start["objective"] - 1) * 100, abs=5e-3)
