"""PREHydrA's tracking benchmark as its specification has it: half a minute to minutes, so only with -m full."""

import json
import re
from pathlib import Path

import pytest

from fluxbore.cli import main
from fluxbore.design.dynamics.tracking_pair import run_pair
from fluxbore.design.dynamics.tracking_stand import Pair, tracking_stand
from fluxbore.design.spec import load
from fluxbore.optimize.hydrostatic_benchmark import ALTERNATIVES
from fluxbore.optimize.hydrostatic_common import weighed

pytestmark = pytest.mark.full

TOP = Path(__file__).parents[2]
SPEC = TOP / "examples" / "prehydra.toml"
PAGE = (TOP / "docs" / "hydrostatic_tracking.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def figures(tmp_path_factory):
    """As the command prints them, with the folder that it writes."""
    folder = tmp_path_factory.mktemp("tracking") / "out"
    assert main(["simulate", str(SPEC), "-o", str(folder), "--no-picture", "--quiet"]) == 0
    names = {"report.html", "results.csv", "traces.parquet", "figures.json", "journal.jsonl"}
    assert names <= {path.name for path in folder.iterdir()}
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "Tracking sinusoidal forces" in page
    return json.loads((folder / "figures.json").read_text(encoding="utf-8"))["figures"]


def test_fifty_newtons_at_four_hertz(figures):
    """2.4 N within 1 N at most, 2 N on average at most: the paper's model, 4 N below the 6.44 N measured."""
    assert figures["max_error"]["50 N at 4 Hz"]["half"] == pytest.approx(2.4, abs=1.0)
    assert figures["mean_absolute_error"]["50 N at 4 Hz"]["half"] <= 2.0


def test_every_pair_errs_by_less_than_the_papers_bound_and_the_slowest_least(figures):
    rows = figures["tracking"]
    assert {row["frequency"] for row in rows} == {0.1, 0.5, 2.0, 4.0, 6.0, 10.0}
    assert all(row["mean_absolute_error"] < 3.7 for row in rows)
    assert min(rows, key=lambda row: row["mean_absolute_error"])["frequency"] == 0.1


def test_pressure_at_300_newtons(figures):
    assert 23.5e5 <= figures["peak_pressure"] <= 26e5


def test_largest_error_comes_where_the_paper_does_not_have_it(figures):
    """Near the largest speed at 2 Hz and above, near the extrema below: catches a phase that is hidden or folded."""
    for row in figures["tracking"]:
        degrees = row["phase"] * 57.29577951308232
        away = min(degrees, 180 - degrees)
        assert away < 20 if row["frequency"] <= 0.5 else away > 45


def test_energy_balances_in_every_run(figures):
    assert all(row["energy_imbalance"] < 1e-6 for row in figures["tracking"])
    assert figures["energy_imbalance"] == max(row["energy_imbalance"] for row in figures["tracking"])


@pytest.mark.parametrize("pair", [Pair(50.0, 4.0, "half"), Pair(20.0, 10.0, "half"), Pair(300.0, 0.5, "peak-to-peak")])
def test_half_the_step_changes_the_figures_by_less_than_one_per_cent(pair):
    """At 0.1 Hz the largest error is one of many slips and does not converge so; its mean does."""
    spec = load(SPEC)
    actuator, stand = weighed(spec), tracking_stand(spec.values)
    fine = tracking_stand({**spec.values, "benchmark.tracking.step": 62.5e-6})
    one, two = (run_pair(actuator, each, pair, traces=False).figures for each in (stand, fine))
    for name in ("max_error", "mean_absolute_error", "peak_pressure"):
        assert getattr(two, name) == pytest.approx(getattr(one, name), rel=0.01)


def numbers(row):
    """The numbers of the page's row of this name, a cell each; None for a cell that begins with none."""
    line = next(line for line in PAGE.splitlines() if line.startswith(f"| {row} |"))
    found = [re.match(r"[\d.]+", cell.strip()) for cell in line.strip("|").split("|")[1:]]
    return [None if each is None else float(each.group()) for each in found]


def test_the_page_has_the_simulated_figures(figures):
    """To a hundredth: stick and slip of the ramp leave the third digit uncertain."""
    pair = "50 N at 4 Hz"
    told = {
        "largest pressure at 300 N": figures["peak_pressure"] / 1e5,
        "50 N at 4 Hz, largest error": figures["max_error"][pair]["half"],
        "50 N at 4 Hz, mean absolute error": figures["mean_absolute_error"][pair]["half"],
        "largest mean absolute error of all": figures["largest_mean_absolute_error"],
        "frequency of the least error": figures["frequency_of_least_error"],
    }
    for name, value in told.items():
        assert numbers(name)[0] == pytest.approx(value, rel=0.01), name


@pytest.mark.parametrize("label", ["delay of 1 ms", "velocity loop of 40 Hz", "no air", "2.5 % air"])
def test_the_page_has_the_sensitivities(label):
    """The rows that say which assumption drives the errors."""
    spec = load(SPEC).with_values(dict(ALTERNATIVES)[label])
    found = run_pair(weighed(spec), tracking_stand(spec.values), Pair(50.0, 4.0, "half"), traces=False).figures
    largest, mean, *_, phase = numbers(label)
    assert found.max_error == pytest.approx(largest, rel=0.02)
    assert found.mean_absolute_error == pytest.approx(mean, rel=0.02)
    assert found.phase * 57.29577951308232 == pytest.approx(phase, abs=5.0)
