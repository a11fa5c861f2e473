"""Studies of the hybrid actuator by exact gradients: killed and resumed, and by each algorithm from outside a limit.

Two positions of the mover in place of eight, the usual mesh.
"""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import fluxbore
from fluxbore.design.spec import loads

pytestmark = pytest.mark.full

EXAMPLES = Path(__file__).parents[2] / "examples"
STUDY = """\
[study]
objective = "maximise force_constant"
hold = ["actuator.winding.yoke_clearance", "actuator.winding.turns_density"]

[[study.variables]]
key = "actuator.mover.ring_width"
lower = "0.5 mm"
upper = "6 mm"
resolution = "0.05 mm"

[[study.variables]]
key = "actuator.back_yoke.thickness"
lower = "0.5 mm"
upper = "2 mm"

[[study.constraints]]
figure = "stray_field"
upper = "1.1 x start"

[study.pareto]
against = "minimise total_mass"
points = 3

[study.search]
max_evaluations = 6
network = "off"

[study.production]
samples = 500
checks = 2
yield = 0.9
tolerances = [
  { key = "actuator.back_yoke.thickness", tolerance = "0.03 mm" },
  { key = "actuator.mover.ring_width", tolerance = "0.05 mm" },
]
"""


def text() -> str:
    example = (EXAMPLES / "ipehla.toml").read_text()
    return example[: example.index("[study]")].replace("positions = 8", "positions = 2") + STUDY


def begin(command: str, folder: Path, spec: Path) -> subprocess.Popen[bytes]:
    arguments = [command, str(spec), "-o", str(folder), "--workers", "1", "--quiet"]
    return subprocess.Popen(
        [sys.executable, "-m", "fluxbore", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
    )


def keys(folder: Path) -> list[str]:
    """Of the designs that are recorded, in order; a last line that is torn does not count."""
    journal = folder / "journal.jsonl"
    lines = journal.read_bytes().split(b"\n")[:-1] if journal.exists() else []
    return [json.loads(line)["key"] for line in lines]


def results(folder: Path) -> dict[str, bytes]:
    """All tables and the design."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix in (".csv", ".parquet", ".toml")}


@pytest.mark.parametrize("command", ["optimize", "pareto", "tolerance", "robust"])
def test_a_study_killed_halfway_ends_with_the_same_tables(command, tmp_path):
    """Catches gradients that do not survive the journal to the last bit, and designs asked for in another order."""
    spec = tmp_path / "spec.toml"
    spec.write_text(text())
    whole, killed = tmp_path / "whole", tmp_path / "killed"
    process = begin(command, whole, spec)
    _, errors = process.communicate()
    assert process.returncode in (0, 3), errors.decode()
    expected = keys(whole)

    process = begin(command, killed, spec)
    while process.poll() is None and len(keys(killed)) < len(expected) / 2:
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    assert process.returncode == -signal.SIGKILL, "it was done before it could be killed"
    known = keys(killed)

    process = begin(command, killed, spec)
    _, errors = process.communicate()
    assert process.returncode in (0, 3), errors.decode()
    assert keys(killed)[: len(known)] == known
    assert sorted(keys(killed)) == sorted(expected), "the same designs, and none of them twice"
    assert results(killed) == results(whole)


def test_every_gradient_algorithm_comes_from_outside_a_limit_to_the_same_optimum():
    """A fifth less stray field than the prototype has: MMA and CCSAQ can stall out there, and then SLSQP goes on."""
    found = {}
    for algorithm in ("SLSQP", "MMA", "CCSAQ"):
        study = STUDY.replace("1.1 x start", "0.8 x start").replace("= 6\n", f'= 40\nalgorithm = "{algorithm}"\n')
        spec = loads(text().replace(STUDY, study))
        result = fluxbore.optimize(spec, workers=1)
        assert result.algorithm.startswith(algorithm)
        assert not result.start.feasible
        assert result.optimality.residual < 1e-3
        found[algorithm] = result.best.objective
    assert found["MMA"] == pytest.approx(found["SLSQP"], rel=1e-4)
    assert found["CCSAQ"] == pytest.approx(found["SLSQP"], rel=1e-4)
