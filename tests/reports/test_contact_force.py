"""The contact-force benchmark on the page: what it says of trials whose figures are known."""

from __future__ import annotations

import dataclasses
import re
from typing import Any

import numpy as np
import pytest

from fluxbore.design.dynamics.contact_force import CONDITIONS, FREQUENCIES, TARGETS, statistics
from fluxbore.design.dynamics.simulation import Simulation, Trace, Trial
from fluxbore.design.performance import Performance
from fluxbore.design.spec import loads
from fluxbore.design.spec_file import template
from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.hybrid_contact_force import MCFC
from fluxbore.optimize.simulation_median import median_figures
from fluxbore.reports import benchmark_tables, contact_force
from fluxbore.reports.contact_force_curves import significance
from fluxbore.reports.content import ReportContent
from fluxbore.reports.page import render
from fluxbore.reports.tables import Table
from fluxbore.reports.wording import DASH

ERRORS = [item for item in MCFC.published if item.path[0] == "median_rmse"]
SPEC = loads(template("ipehla"), {"benchmark.mcfc.valve_lag": "0.2 s"})


def simulation(seed: int, scale: float = 1.0, *, traces: bool = False) -> Simulation:
    """Errors in closed form: P-N falls with the frequency, P-P crosses it half-way, P-E is far below both."""
    trials = []
    for i, frequency in enumerate(FREQUENCIES):
        for target in TARGETS:
            small = 1e-3 * seed + 1e-4 * i + 1e-5 * target
            for condition in CONDITIONS:
                error = {"P-N": 3.3 - 0.02 * i, "P-P": 2.1 + 0.2 * i, "P-E": 1.0 + 0.04 * i}[condition] + small
                trials.append(
                    Trial(
                        {"condition": condition, "target": target, "frequency": frequency},
                        {"mean_speed": 2.1e-3 * frequency, "rmse": scale * error},
                        trace(frequency, target) if traces else None,
                    )
                )
    causes = {
        "fin_deformed_length": 0.4123e-3,
        "fin_contact_area": 20.85e-6,
        "force_constant": 8.68,
        "cogging_force": 0.029,
        "contact_force": 20.5 * scale,
        "moving_mass": 0.205,
    }
    return Simulation("mcfc", seed, tuple(trials), {**statistics(tuple(trials)), **causes})


def trace(frequency: float, target: float) -> Trace:
    time = np.linspace(0.0, 10 / frequency, 400)
    wave = np.sin(2 * np.pi * frequency * time)
    names = ("position", "velocity", "force", "friction", "pressure", "current", "velocity_estimate")
    signals = {name: wave.copy() for name in names}
    return Trace(time, {**signals, "position": 5e-4 * (wave - 1), "force": target + 3 * wave})


def run(label: str, scale: float = 1.0, seeds: tuple[int, ...] = (1, 2, 3), **changes: Any) -> DesignRun:
    found = tuple(simulation(seed, scale, traces=seed == seeds[0]) for seed in seeds)
    evaluation = Evaluation("fem", OK, (), Performance(force_constant=8.68))
    whole = DesignRun(label, SPEC, evaluation, None, found, median_figures([item.figures for item in found]), OK)
    return dataclasses.replace(whole, **changes)


@pytest.fixture(scope="module")
def alone() -> BenchmarkResult:
    return BenchmarkResult(MCFC, (1, 2, 3), run("iPEHLA"))


@pytest.fixture(scope="module")
def compared() -> BenchmarkResult:
    bad = run("bad", simulations=(), figures={}, status="refused", reasons=("benchmark.mcfc.stroke is too long.",))
    return BenchmarkResult(MCFC, (1, 2, 3), run("iPEHLA"), (run("fin", 0.9), run("same"), bad))


def cells(table: Table, label: str) -> list[str]:
    """The texts of the row under this label, with plain spaces and hyphens."""
    (row,) = [row for row in table.rows if plain(row[0].text).startswith(label)]
    return [plain(cell.text) for cell in row]


def plain(text: str) -> str:
    return text.replace("\u00a0", " ").replace("\u2011", "-").replace("\u2212", "-")


def test_figures_stand_beside_the_published_ones(alone):
    """Catches a difference of the wrong sign, a tick where the figure is too far off, and a range of one seed."""
    table = benchmark_tables.statistics(alone)
    row = cells(table, "Median RMSE, P-N")
    median = alone.run.figures["median_rmse"]["P-N"]
    assert row[1] == f"{median:.3f} N"
    assert row[3] == "3.130 N"
    assert row[4] == f"+{median - 3.13:.3f} N"
    low, high = (pick(sim.figures["median_rmse"]["P-N"] for sim in alone.run.simulations) for pick in (min, max))
    assert row[2] == f"{low:.3f} to {high:.3f}"
    assert row[5] == "✓ within 0.15 N"
    assert cells(table, "Median RMSE, P-P")[5] == "✗ not within 0.2 N"
    assert cells(table, "Cells of 36 with P-E lowest")[1:4] == ["36", "–", "36"]
    assert cells(table, "Contact area of the fin, s")[1] == "20.85 mm²"


def test_what_is_not_reproduced_is_said(alone):
    """Catches a miss that only the table's small print shows."""
    missed = benchmark_tables.missed(alone)
    assert any(plain(text).startswith("Median RMSE, P-P: 3.2") for text in missed)
    assert not any("P-N:" in plain(text) for text in missed)


def test_trends_and_pairs_have_their_signs(alone):
    """Catches conditions that are swapped between rows, and a rise that is called a fall."""
    trends = contact_force.trends(alone.run)
    assert cells(trends, "P-N")[2:] == ["-1.00 falls"] * 3
    assert cells(trends, "P-P")[1:] == ["–"] + ["1.00 rises"] * 3
    pairs = contact_force.post_hoc(alone.run)
    assert cells(pairs, "P-N and P-E")[4] == "p < .001"
    assert significance(0.2) == "not significant (p = 0.2)"
    assert significance(0.04) == "p < .05"
    assert significance(None) == "not tested"


def test_every_parameter_is_listed_with_its_reason(alone):
    """Catches a parameter that the page passes over, a value in another unit, and a given one told as usual."""
    table = benchmark_tables.parameters(SPEC, MCFC.section, contact_force.DEFAULT)
    names = {key.name for key in SPEC.kind.keys if key.name.startswith(MCFC.section) and key.name in SPEC.values}
    assert len(table.rows) == len(names)
    reasons = {note.key: note.reason for note in SPEC.notes}
    stroke = cells(table, "Stroke")
    assert stroke[2:] == ["1.05 mm", "assumed", plain(reasons["benchmark.mcfc.stroke"])]
    assert cells(table, "Time step")[2] == "0.0001 s"
    assert cells(table, "Valve lag")[2:] == ["0.2 s", DASH, benchmark_tables.GIVEN]
    assert cells(table, "Encoder resolution")[2:] == ["0.0054 mm", DASH, contact_force.DEFAULT]


def test_designs_are_set_against_the_first(compared):
    """Catches a gain against the wrong design, one without its sign, and noise of the seeds told as a gain."""
    sound = [item for item in compared.runs if item.ok]
    better, same = map(plain, contact_force.gains(sound))
    start = sound[0].figures["median_rmse"]["P-E"]
    assert f"-{0.1 * start:.3f} N (-10.0 %) under P-E" in better
    assert same == "same: the median error does not change under any condition."
    table = benchmark_tables.comparison(sound, ERRORS, MCFC.causes)
    row = cells(table, "fin")
    assert row[3] == f"{0.9 * start:.3f} (-{0.1 * start:.3f})"
    assert row[6] == "18.45"
    slight = run("slight", 1.0002)
    (text,) = map(plain, contact_force.gains([sound[0], slight]))
    assert "no more than the seeds differ" in text


def test_variations_stand_beside_the_same_seed(alone):
    """Catches a comparison with the median of the seeds, and a refused variation that ends the page."""
    more = run("friction, +10 %", 1.1, (1,))
    bad = run("valve lag, +10 %", simulations=(), figures={}, status="refused", reasons=("It is too long.",))
    varied = dataclasses.replace(alone, variations=(more, bad))
    table = benchmark_tables.variations(varied)
    first = alone.run.simulations[0].figures["median_rmse"]["P-E"]
    assert cells(table, "As it is")[3] == f"{first:.3f}"
    assert cells(table, "Friction, +10 %")[3] == f"{1.1 * first:.3f}"
    assert cells(table, "Valve lag, +10 %: It is too long.")[1:] == ["–"] * (len(table.head) - 1)
    assert "Contact area of the fin" not in " ".join(table.head)
    assert contact_force.section(varied)["variations"] == table


def test_the_section_stands_whole_on_the_page(alone, compared):
    """Catches a picture that is missing, a failed design that is passed over, and advice where nothing is missing."""
    page = render(ReportContent(spec=SPEC, simulation=compared))
    assert page.count('id="contact-force"') == 1
    assert 'href="#contact-force"' in page
    for name in ("loops", "speed", "boxes", "trace", "designs"):
        assert f"contact-force-{name}-" in page
    assert "bad: benchmark.mcfc.stroke is too long." in page
    assert "--against DESIGN.toml" not in page
    lone = render(ReportContent(spec=SPEC, simulation=alone))
    assert "contact-force-designs-" not in lone
    assert "--against DESIGN.toml" in lone
    assert len(lone) < len(page)
    labels = re.findall(r'aria-label="(Root mean square[^"]+)"', lone)
    assert len(labels) == 1
    assert 'id="contact-force"' not in render(ReportContent(spec=SPEC))


def test_a_simulation_without_traces_leaves_out_what_needs_them():
    """Catches a page that ends in a traceback where a record holds no traces."""
    bare = run("iPEHLA", simulations=(simulation(1), simulation(2), simulation(3)))
    found = contact_force.section(BenchmarkResult(MCFC, (1, 2, 3), bare))
    assert found["loops"] is None
    assert found["trace"] is None
    assert "contact-force-speed" in found["speed"].markup


def test_one_seed_has_no_range_and_no_table_of_seeds():
    """Catches "medians of the seeds" where there is one."""
    found = contact_force.section(BenchmarkResult(MCFC, (4,), run("iPEHLA", seeds=(4,))))
    assert found["seeds"] is None
    assert "seed 4" in found["sentences"][1]
    assert "median of the seeds" not in found["sentences"][1]
    assert "Over the seeds" not in found["statistics"].head
    assert cells(found["statistics"], "Median RMSE, P-N")[2] == "3.130 N"
