"""`fluxbore simulate` on an electro-hydrostatic actuator with short references, and what it refuses in a sentence."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import pytest

from fluxbore.cli import main
from fluxbore.design.spec import load
from fluxbore.optimize.benchmark import BenchmarkResult
from fluxbore.optimize.hydrostatic_benchmark import ALTERNATIVES, TENTHS, TRACKING
from fluxbore.optimize.simulation_table import trials_table
from fluxbore.simulating import simulate
from fluxbore.simulation_messages import simulation_plain, simulation_text

SPEC = str(Path(__file__).parent.parent / "examples" / "prehydra.toml")
SHORT = {"pairs": "published", "ramp": 0.15, "duration": 0.25, "step": 250e-6}


@pytest.fixture(scope="module")
def result() -> BenchmarkResult:
    """Two seeds of one process: the runs of the first serve the second."""
    spec = load(SPEC).with_values({f"benchmark.tracking.{name}": value for name, value in SHORT.items()})
    return simulate(spec, seeds=2, fidelity="network", workers=1)


@pytest.fixture(scope="module")
def figures(result: BenchmarkResult) -> dict[str, Any]:
    plain = simulation_plain(result)
    assert json.loads(json.dumps(plain, allow_nan=False))["status"] == "ok"
    found: dict[str, Any] = plain["figures"]
    return found


def test_json_has_every_figure_that_was_asked_for(figures: dict[str, Any]) -> None:
    assert figures["force_frequency_limit"] == pytest.approx(213.0, abs=0.5)
    assert figures["maximum_velocity"] == pytest.approx(0.47, abs=0.005)
    assert figures["minimum_friction"] == pytest.approx(10.3, abs=0.1)
    assert figures["friction_at_limit"] == pytest.approx(45.8, abs=0.3)
    assert figures["force_at_rated_pressure"] == pytest.approx(1124.0, abs=1.0)
    assert figures["efficiency"] == pytest.approx(0.87, abs=0.005)
    assert figures["peak_pressure"] == max(row["peak_pressure"] for row in figures["tracking"])
    assert figures["energy_imbalance"] < 1e-6
    assert len(figures["tracking"]) == 5
    for row in figures["tracking"]:
        assert {"amplitude", "frequency", "reading", "max_error", "mean_absolute_error"} <= set(row)
        assert 0 < row["mean_absolute_error"] < row["max_error"]
    assert [(row["amplitude"], row["reading"]) for row in figures["refused"]] == [(300.0, "half")]


def test_seeds_share_the_runs_and_differ_in_the_friction(figures: dict[str, Any]) -> None:
    one, two = figures["seeds"]
    assert (one["seed"], two["seed"]) == (1, 2)
    assert one["tracking"] == two["tracking"]
    assert one["identified_friction"] != two["identified_friction"]


def test_tables_for_people_and_programs(result: BenchmarkResult) -> None:
    """A refused pair is a row with its reason and without numbers."""
    text = simulation_text(result)
    assert text.startswith(
        "tracking: tracking sinusoidal forces (PREHydrA paper, Secs. III to V); medians over seeds 1"
    )
    assert "got 645 N (211 mm of travel)" in text
    assert "least friction" in text
    rows = list(csv.DictReader(io.StringIO(trials_table(result.runs))))
    (refused,) = [row for row in rows if row["reason"] and row["seed"] == "1"]
    assert refused["max_error"] == ""
    assert "645 N" in refused["reason"]
    assert [row["run"] for row in rows].count("identification") == 2


def test_every_variation_can_be_specified() -> None:
    """Catches keys that are none, and values beyond their ranges."""
    spec = load(SPEC)
    found = TRACKING.variations(spec, None)
    assert len(found) == 2 * len(TENTHS) + len(ALTERNATIVES)
    for label, values in found:
        changed = spec.with_values(values)
        assert changed.values["benchmark.tracking.pairs"] == "published"
        assert changed.actuator.bare != spec.actuator.bare, label


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ('benchmark.tracking.step="0.3 ms"', "tracking.step must be a whole share of actuator.drive.force_period"),
        ('benchmark.tracking.duration="9000 s"', "duration must be short enough for no more than 2e+06 steps"),
        ('benchmark.tracking.margin="600 N"', "must keep benchmark.tracking.margin 600 N"),
        ('actuator.return_spring.element="constant force"', "must keep benchmark.tracking.margin"),
        ('benchmark.tracking.slowest_speed="0.5 m/s"', "slowest_speed must be below"),
        ("actuator.motor.maximum_speed=", "actuator.motor.maximum_speed"),
        ('actuator.input_cylinder.dead_volume="-5 cm^3"', "actuator.input_cylinder.dead_volume"),
        ('benchmark.tracking.pairs="none"', "benchmark.tracking.pairs must be one of"),
    ],
)
def test_what_cannot_be_simulated_is_one_sentence(capsys: pytest.CaptureFixture[str], change: str, words: str) -> None:
    command = ["simulate", SPEC, "--fidelity", "network", "--workers", "1", "--quiet"]
    assert main([*command, "--set", change]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert words in err
    assert "Traceback" not in err
