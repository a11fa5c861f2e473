"""The page of a lead screw's force benchmark beside a simulation: shorter experiments than the example's (-m full)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fluxbore.design.spec import load
from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun
from fluxbore.optimize.evaluate import evaluate
from fluxbore.optimize.evaluation import OK
from fluxbore.optimize.lead_screw_benchmark import FORCE
from fluxbore.optimize.simulation_median import median_figures
from fluxbore.reports import force_benchmark
from fluxbore.reports.content import ReportContent
from fluxbore.reports.force_benchmark_runs import ESTIMATES, of_run
from fluxbore.reports.page import render

pytestmark = pytest.mark.full

SHORT = {"duration": "1 s", "frequency": "1 Hz", "load_stiffness": "30 kN/m"}


@pytest.fixture(scope="module")
def result() -> BenchmarkResult:
    keys = {f"benchmark.force.{name}": value for name, value in SHORT.items()}
    spec = load(Path(__file__).parents[2] / "examples" / "rotlin.toml", keys)
    own = evaluate(spec, "network")
    field = FORCE.field(spec, [own])
    found = FORCE.simulate(spec, field, 1, True)
    return BenchmarkResult(
        FORCE, (1,), DesignRun("RotLin", spec, own, field, (found,), median_figures([found.figures]), OK)
    )


def number(text: str) -> float:
    """What a cell begins with."""
    return float(text.split("\u00a0")[0].split(" ")[0].replace("\N{MINUS SIGN}", "-"))


def test_the_tables_are_the_simulation(result):
    """Catches a row or a column under another's name."""
    shown, figures = force_benchmark.section(result), result.run.figures
    for row, number_of in zip(shown["errors"].rows, ("1", "2", "3"), strict=False):
        found = figures["estimation_rmse"][number_of]
        assert [number(cell.text) for cell in row[1:4]] == pytest.approx([found[name] for name in ESTIMATES], abs=5e-3)
    for row, force in zip(shown["step_table"].rows, ("50", "100"), strict=True):
        assert number(row[1].text) == pytest.approx(figures["step_t63"][force], abs=5e-4)
        assert number(row[5].text) == pytest.approx(figures["step_error"][force], abs=5e-3)
    for row, tip in zip(shown["loop_table"].rows, ("75", "165"), strict=True):
        assert number(row[1].text) == pytest.approx(figures["loop_height"][tip], abs=5e-3)
    assert f"= {figures['peak_hysteresis_force']:.1f}\u00a0N" in shown["peak"]
    assert shown["poles"].rows[0][1].text.startswith(f"\N{MINUS SIGN}{-figures['poles'][0][0]:.1f}, ")


def test_the_pictures_are_of_the_traces_that_the_figures_come_from(result):
    """Catches a trace of another estimate: its error over the trace is the figure's, but for the samples left out."""
    for trial in of_run(result.run.simulations[0], "experiment"):
        signals = trial.trace.signals
        for name in ESTIMATES:
            error = np.sqrt(np.mean((signals[name] - signals["load_force"]) ** 2))
            assert error == pytest.approx(trial.figures[f"rmse_{name}"], rel=0.02)


def test_the_page_stays_small(result):
    """Catches pictures of every sample."""
    page = render(ReportContent(spec=result.run.spec, simulation=result))
    assert page.count("force-experiments-") > 0
    assert len(page) < 1_000_000
