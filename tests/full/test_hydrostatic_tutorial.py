"""Every command of the tutorial on electro-hydrostatic actuators, and what it says of the sized one (-m full)."""

import re
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

from test_hydrostatic_tutorial import COMMANDS, PAGE, run

import fluxbore

pytestmark = pytest.mark.full


def test_every_command_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for command in COMMANDS:
        run(command, tmp_path, capsys)
    made = fluxbore.evaluate(fluxbore.load("out/design.toml"), "network").performance
    rows = {row[0]: row[1] for row in re.findall(r"^\| ([^|]+) \| [^|]+ \| ([^|]+) \|$", PAGE, re.MULTILINE)}
    assert made.output_cylinder_mass is not None
    assert made.distal_mass is not None
    assert rows["output cylinder"] == f"{made.output_cylinder_mass * 1e3:.1f} g"
    assert float(rows["mass at the joint"].split()[0]) == pytest.approx(made.distal_mass * 1e3, abs=0.2)
    for name in (
        "out/report.html",
        "out/cad/PREHydrA.step",
        "out/cad/PREHydrA.dxf",
        "first.html",
        "tracking/report.html",
    ):
        assert Path(name).is_file(), name
