"""The tracking benchmark's section of a report: what it says of short runs, beside the paper's figures."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fluxbore.design.hydrostatic_range import demand
from fluxbore.design.performance import Performance
from fluxbore.design.spec import load
from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.hydrostatic_benchmark import TRACKING, simulate_tracking
from fluxbore.optimize.hydrostatic_common import weighed
from fluxbore.reports import tracking_benchmark
from fluxbore.reports.benchmark_sections import SECTIONS, benchmark_section
from fluxbore.reports.tables import Table
from fluxbore.reports.tracking_benchmark_range import load_limits

STAND = {
    "benchmark.tracking.pairs": "published",
    "benchmark.tracking.ramp": 0.15,
    "benchmark.tracking.duration": 0.25,
    "benchmark.tracking.step": 250e-6,
    "benchmark.tracking.amplitude_6": 60.0,
    "benchmark.tracking.frequency_6": 4.0,
}
SPEC = load(Path(__file__).parents[2] / "examples" / "prehydra.toml").with_values(STAND)

ACTUATOR = weighed(SPEC)


@pytest.fixture(scope="module")
def result() -> BenchmarkResult:
    simulation = simulate_tracking(SPEC, None, 1, True)
    evaluation = Evaluation("network", OK, (), Performance())
    run = DesignRun("PREHydrA", SPEC, evaluation, None, (simulation,), simulation.figures, OK)
    changed = DesignRun("delay of 1 ms", SPEC, evaluation, None, (simulation,), _worse(simulation.figures), OK)
    return BenchmarkResult(TRACKING, (1,), run, (), (changed,))


@pytest.fixture(scope="module")
def shown(result: BenchmarkResult) -> dict[str, Any]:
    section = benchmark_section(result)
    assert section is not None
    assert section["template"] == SECTIONS["tracking"].template
    found: dict[str, Any] = section["shown"]
    return found


def _worse(figures: Any) -> dict[str, Any]:
    errors = {pair: {reading: 1.5 * x for reading, x in each.items()} for pair, each in figures["max_error"].items()}
    return {**figures, "max_error": errors}


def cells(table: Table, label: str) -> list[str]:
    (row,) = [row for row in table.rows if row[0].text.replace("\u00a0", " ").startswith(label)]
    return [cell.text.replace("\u00a0", " ") for cell in row]


def test_errors_stand_by_pair_and_reading(shown: dict[str, Any], result: BenchmarkResult) -> None:
    """Catches readings that are swapped, a refused pair with numbers, and the paper's figures at another pair."""
    table, figures = shown["error_table"], result.run.figures
    own = cells(table, "50 N at 4 Hz")
    assert float(own[1]) == pytest.approx(figures["max_error"]["50 N at 4 Hz"]["half"], abs=0.005)
    assert float(own[4]) == pytest.approx(figures["max_error"]["50 N at 4 Hz"]["peak-to-peak"], abs=0.005)
    assert own[7] == "model 2.44; measured 6.44, mean 3.03"
    large = cells(table, "300 N at 0.5 Hz")
    assert large[1:4] == ["cannot be made", "–", "–"]
    assert cells(table, "60 N at 4 Hz")[7] == "–"
    assert any("211 mm of travel" in text for text in shown["refused"])


def test_disagreements_of_the_paper_are_told(shown: dict[str, Any]) -> None:
    table = shown["disagreements"]
    assert cells(table, "Least friction")[2].startswith("10.3 N by Table I")
    assert "300 N read so takes 211 mm of 152.4 mm" in cells(table, "Amplitude")[2]
    assert cells(table, "Efficiency")[2] == (
        "F/(F + F_f) is 86.8 %, 1 − F_f/F 84.7 %; with both cylinders’ friction 76.6 %"
    )
    assert any(text.startswith("Least friction: 10.3") for text in shown["missed"])


def test_phase_is_told_against_the_papers(shown: dict[str, Any], result: BenchmarkResult) -> None:
    phase = math.degrees(result.run.figures["phase_of_largest_error"])
    assert f"the error is largest {phase:.0f}° after an extremum" in shown["phase"]
    assert ("The paper’s Fig. 7 has it at the extrema" in shown["phase"]) == (20 < phase < 160)


def test_friction_stands_beside_table_i(shown: dict[str, Any], result: BenchmarkResult) -> None:
    table = shown["friction_table"]
    found = result.run.figures["identified_friction"]["viscous_coefficient"]
    row = cells(table, "f_v (N s/m)")
    assert row[1:3] == ["59.5", "59.5 ± 3.56"]
    assert row[3].startswith(f"{found['value']:.4g} ± ")
    assert 1 / 1.5 < float(cells(table, "c (s/m)")[5]) < 1.5


def test_energy_adds_up(shown: dict[str, Any]) -> None:
    """Of every row what entered is what left, was stored and lost; the sum is that of the rows."""
    rows = [[float(cell.text.replace("−", "-")) for cell in row[1:5]] for row in shown["energy"].rows]
    for entered, left, stored, lost in rows:
        assert entered == pytest.approx(left + stored + lost, abs=2.1e-3)
    assert float(shown["energy"].foot[0][4].text) == pytest.approx(sum(row[3] for row in rows), abs=6e-3)


def test_assumptions_are_listed_with_their_reasons(shown: dict[str, Any]) -> None:
    table = shown["assumed"]
    assert len(table.rows) == len([note for note in SPEC.notes if note.key in SPEC.values])
    assert {row[3].text for row in table.rows} == {"assumed"}
    assert [row[2].text for row in table.rows if row[1].text == "roughness"] == ["0.0015 mm"]
    assert all(row[4].text for row in table.rows)


def test_sensitivities_show_what_changes(shown: dict[str, Any]) -> None:
    """Other figures than the largest errors did not change, and have no column."""
    table = shown["variations"]
    assert [title.partition(" (")[0] for title in table.head[1:]] == [
        "50 N at 4 Hz, largest error",
        "50 N at 4 Hz peak to peak, largest error",
    ]
    assert len(table.rows) == 2
    assert shown["how"] == ""


def test_the_range_counts_the_seals_friction() -> None:
    """On each line the demand is all there is; without friction the pressure's would be level, at 540 N."""
    frequencies = np.array([0.1, 0.4, 2.0, 10.0])
    found = load_limits(ACTUATOR, 45.0, frequencies, 1500.0)
    for row, name in zip(found, ("pressure", "torque", "power"), strict=True):
        for amplitude, frequency in zip(row, frequencies, strict=True):
            if not math.isnan(amplitude):
                asked = demand(ACTUATOR, float(amplitude), float(frequency), 45.0)
                assert getattr(asked, name) == pytest.approx(1.0, rel=0.015)
    assert np.all(found[0] < 523)
    assert np.all(np.diff(found[0]) < 0)


def test_pictures_say_what_they_show(shown: dict[str, Any]) -> None:
    assert "300 N at 0.5 Hz: cannot be made" in shown["range"].alt
    assert "150 N at 0.5 Hz" in shown["range"].alt
    assert "50 N at 4 Hz" in shown["traces"].alt
    assert "least 10.3 N" in shown["friction"].alt
    for name in ("range", "errors", "traces", "friction"):
        assert shown[name].markup.startswith("<svg")


def test_data_that_tell_no_friction_are_told(result: BenchmarkResult) -> None:
    """A seed whose fit is refused still has its section."""
    figures = {
        **result.run.figures,
        "identified_friction": {},
        "identification_refused": "the simulated runs at constant speed does not identify stribeck_decay: why.",
    }
    stand = tracking_benchmark.tracking_stand(SPEC.values)
    simulation = result.run.simulations[0]
    run = DesignRun("PREHydrA", SPEC, result.run.evaluation, None, (_with(simulation, figures),), figures, OK)
    assert "do not tell the parameters: the simulated runs" in tracking_benchmark.friction_text(run, stand)
    law = ACTUATOR.output_cylinder.friction
    assert cells(tracking_benchmark.friction.table(law, stand, figures), "c (s/m)")[3] == "–"


def _with(simulation: Any, figures: dict[str, Any]) -> Any:
    from dataclasses import replace

    return replace(simulation, figures=figures)
