"""The benchmark of a lead screw's force on the page: what it says of runs whose figures are known."""

from __future__ import annotations

import dataclasses
import math
import re
from pathlib import Path
from typing import Any

import numpy as np

from fluxbore.actuators import ACTUATORS
from fluxbore.design.dynamics.force_poles import LARGEST_K_E, nominal_loop, pole_set, survey, unstable_by_routh
from fluxbore.design.dynamics.linearised import FILTERED, UNFILTERED
from fluxbore.design.dynamics.simulation import Simulation, Trace, Trial
from fluxbore.design.performance import Performance
from fluxbore.design.spec import load
from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun
from fluxbore.optimize.evaluation import OK, Evaluation
from fluxbore.optimize.lead_screw_benchmark import FORCE, DesignFigures
from fluxbore.reports import benchmark_tables, force_benchmark, force_benchmark_loci, force_benchmark_loops
from fluxbore.reports.benchmark_sections import SECTIONS
from fluxbore.reports.content import ReportContent
from fluxbore.reports.force_benchmark_poles import listed, routh_text, sentences
from fluxbore.reports.page import render
from fluxbore.reports.tables import Table

SPEC = load(Path(__file__).parents[2] / "examples" / "rotlin.toml")

PEAKS = {"1": 45.0, "2": 85.0, "3": 165.0, "3, lower peak": 147.5}

RMSE = {
    "1": {"linear": 4.71, "polynomial": 4.66, "proposed": 0.61},
    "2": {"linear": 4.52, "polynomial": 4.61, "proposed": 0.93},
    "3": {"linear": 15.09, "polynomial": 4.41, "proposed": 1.39},
}
LOWER = {"linear": 7.87, "polynomial": 4.5, "proposed": 1.38}

CASE = {"harmonic_ratio_2": 0.01583, "harmonic_ratio_3": 0.000805, "remanence_for_stall_force": 1.216}

FIGURES: dict[str, Any] = {
    **CASE,
    "iron_cases": {
        "both": CASE,
        "translator": {**CASE, "remanence_for_stall_force": 1.245},
        "none": {**CASE, "harmonic_ratio_2": 0.01739, "remanence_for_stall_force": 1.276},
    },
    "estimation_rmse": RMSE,
    "estimation_rmse_lower_peak": LOWER,
    "proposed_over_polynomial": {name: found["proposed"] / found["polynomial"] for name, found in RMSE.items()},
    "linear_over_polynomial": {name: found["linear"] / found["polynomial"] for name, found in RMSE.items()},
    "zero_force_line_error": 0.35e-6,
    "friction_found": 0.87,
    "step_t63": {"50": 0.971, "100": 0.929},
    "step_t98": {"50": 3.44, "100": 3.2},
    "step_error": {"50": -1.93, "100": -3.72},
    "step_overshoot": {"50": 0.0, "100": 0.002},
    "step_error_without_line": {"50": -4.13, "100": 1.84},
    "dominant_pole": {"0": -0.954, "50": -0.9876, "100": -1.1162},
    "largest_pole_real_part": -0.02975,
    "largest_pole_real_part_filtered": 0.61,
    "grid_points": 18000,
    "grid_points_unstable": 0,
    "grid_points_unstable_filtered": 4242,
    "stiffest_load_pole_real_part": -0.0654,
    "stiffest_load_pole_real_part_filtered": 0.1401,
}


def trials(*, traces: bool) -> tuple[Trial, ...]:
    """One of each run, with waves for signals."""
    time = np.linspace(0.0, 10.0, 40)
    wave = np.sin(time)

    def trial(run: str, number: str, force: float, figures: dict[str, float], *signals: str) -> Trial:
        trace = Trace(time, {name: (1 + i) * wave for i, name in enumerate(signals)}) if traces else None
        return Trial({"run": run, "number": number, "force": force}, figures, trace)

    found = [trial("detection", "", 0.0, FIGURES, "angle", "zero_force_line", "zero_force_line_found")]
    for number, peak in PEAKS.items():
        errors = {f"rmse_{name}": error for name, error in RMSE.get(number, LOWER).items()}
        found.append(trial("experiment", number, peak, errors, "load_force", "linear", "polynomial", "proposed"))
    for force in ("50", "100"):
        figures = {name: FIGURES[f"step_{name}"][force] for name in ("t63", "error")}
        found.append(trial("step", force, float(force), figures, "load_force"))
    for tip, height in ((75.0, 2.119), (165.0, 4.277)):
        figures = {"height": height, "area": 1e-3, "peak": 0.98 * tip}
        found.append(trial("loop", f"{tip:g}", tip, figures, "displacement", "spring_force"))
    return tuple(found)


def run(label: str = "RotLin", *, traces: bool = True, **changes: Any) -> DesignRun:
    field = DesignFigures(stall_force=191.0, spring_constant=236e3, mass=2.4, inertia=7e-5)
    simulation = Simulation("force", 1, trials(traces=traces), FIGURES)
    evaluation = Evaluation("fem", OK, (), Performance(stall_force=191.0))
    return dataclasses.replace(
        DesignRun(label, SPEC, evaluation, field, (simulation,), dict(FIGURES), OK),
        **changes,
    )


ALONE = BenchmarkResult(FORCE, (1,), run())
PARAMETERS = force_benchmark.benchmark_parameters(ALONE.run)


def cells(table: Table, label: str) -> list[str]:
    """The texts of the row under this label, with plain spaces and signs."""
    (row,) = [row for row in table.rows if plain(row[0].text).startswith(label)]
    return [plain(cell.text) for cell in row]


def plain(text: str) -> str:
    return text.replace("\u00a0", " ").replace("\u202f", " ").replace("\u2212", "-")


def test_errors_stand_beside_table_iii():
    """Catches experiments or estimates that are swapped, and a ratio to another estimate than the polynomial."""
    table = force_benchmark.errors_table(ALONE.run, PARAMETERS, FORCE)
    assert cells(table, "1, to 45 N")[1:] == [
        "4.71 (4.77)",
        "4.66 (4.68)",
        "0.61 (0.88)",
        "13 % (19 %)",
        "101 % (102 %)",
    ]
    assert cells(table, "3, to 165 N")[1:] == [
        "15.09 (7.23)",
        "4.41 (4.14)",
        "1.39 (1.62)",
        "32 % (39 %)",
        "342 % (175 %)",
    ]
    assert cells(table, "3, but to 147.5 N")[1:] == ["7.87", "4.50", "1.38", "31 %", "175 %"]


def test_the_contradiction_is_told_from_the_parameters():
    """Catches a gap between line and sine that is quoted and not computed, or taken at another force."""
    text = plain(force_benchmark.contradiction(ALONE.run, PARAMETERS, FORCE))
    h = 36e-3 / 7 / math.tau
    gap = 220e3 * h * math.asin(165 / 192) - 165
    assert f"{gap:.1f} N above the sine" in text
    assert "errs by 15.1 N" in text
    assert "The paper prints 7.23 N, which this K_s, F_stall and peak do not allow together" in text
    assert "a peak of 147.5 N gives 7.9 N" in text
    near = run(figures={**FIGURES, "estimation_rmse": {**RMSE, "3": {**RMSE["3"], "linear": 7.9}}})
    assert "peak allow; a peak" in force_benchmark.contradiction(near, PARAMETERS, FORCE)
    alone = dataclasses.replace(FORCE, published=())
    assert "The paper" not in force_benchmark.contradiction(ALONE.run, PARAMETERS, alone)


def test_steps_are_held_against_the_pole_at_their_reference():
    """Catches the pole of another force, a time constant of the wrong sign, and a share of the other reference."""
    table = force_benchmark.step_table(ALONE.run)
    slow = 1 / 1.1162
    assert cells(table, "100 N") == [
        "100 N",
        "0.929",
        f"{slow:.3f}",
        f"+{100 * (0.929 / slow - 1):.1f} %",
        "3.20",
        "-3.72 (-3.7 %)",
        "0.20 %",
        "1.84",
    ]
    assert cells(table, "50 N")[3] == f"{100 * (0.971 * 0.9876 - 1):.1f} %"


def test_the_peak_of_the_hysteresis_is_told_not_to_be_the_stall_force():
    """Catches the stall force told as the peak of (17); by (17) with x_s at its bound of phi/(psi + xi)."""
    text = plain(force_benchmark_loops.peak_sentence(PARAMETERS))
    h = 36e-3 / 7 / math.tau
    peak = 192 * (0.96 + 0.04 * math.sin(1 / 4000 / h))
    assert f"{peak:.1f} N, not at F_stall = 192.0 N" in text
    assert "within 0.250 mm" in text
    assert f"an F_stall that is {100 * (192 / peak - 1):.1f} % larger" in text


def test_the_onset_of_the_instability_is_a_pole_on_the_imaginary_axis():
    """Catches a stiffness that is read off the wrong observer's locus, or between the wrong points."""
    begin = force_benchmark_loci.onset(PARAMETERS, FILTERED)
    assert begin is not None
    assert begin < LARGEST_K_E
    loop = nominal_loop(PARAMETERS)
    assert abs(pole_set(loop.with_values({"K_e": begin}), FILTERED)[0].real) < 1e-3
    assert pole_set(loop.with_values({"K_e": 1.01 * begin}), FILTERED)[0].real > 1e-3
    assert force_benchmark_loci.onset(PARAMETERS, UNFILTERED) is None


def test_stability_is_told_of_either_loop():
    """Catches an instability that only the grid's figures show, and one that is told where there is none."""
    first, second = map(plain, sentences(FIGURES, PARAMETERS))
    assert "On 18 000 points with K_e up to 5 000 kN/m, K_l* up to 10 000 kN/m and D_e of 0, 0.1, 10 and" in first
    assert "no pole of the published loop lies in the right half plane" in first
    assert "The Routh–Hurwitz criterion holds at each of them" in first
    assert "4 242 of the points are unstable (4 242 by Routh’s table)" in second
    assert "+0.14 1/s" in second
    assert "It begins at K_e = 3 6" in second
    _, calm = sentences({**FIGURES, "grid_points_unstable_filtered": 0}, PARAMETERS)
    assert "unstable" not in calm
    worse, _ = sentences({**FIGURES, "grid_points_unstable": 3}, PARAMETERS)
    assert "3 have a pole of the published loop in the right half plane" in plain(worse)


def test_routh_and_the_poles_count_alike():
    """Catches a table that is taken of another grid or of the other observer."""
    for speed in (UNFILTERED, FILTERED):
        assert unstable_by_routh(PARAMETERS, speed) == survey(PARAMETERS, speed).unstable
    assert unstable_by_routh(PARAMETERS, FILTERED) > 0
    assert "fails at 12 of them" in routh_text(12)


def test_a_pair_of_poles_is_written_once():
    found = np.array([-0.954, -27.3 + 334.6j, -27.3 - 334.6j, -345.3])
    assert plain(listed(found)) == "-0.954, -27.3 ± 334.6j, -345.3"


def test_every_parameter_stands_under_where_it_comes_from():
    """Catches a parameter that is lost between the headings, and a calibrated one told as assumed."""
    flat = benchmark_tables.parameters(SPEC, FORCE.section, force_benchmark.DEFAULT)
    table = force_benchmark.by_status(flat)
    assert sorted(row[0].text for row in table.rows) == sorted(row[0].text for row in flat.rows)
    by_title = {re.sub(r" \(\d+\)$", "", title): rows for title, rows in table.bodies}
    assert [row[0].text for row in by_title["Calibrated"]] == ["Distortion"]
    assert {row[3].text for row in by_title["Assumed"]} == {"assumed"}
    notes = {note.key: note.reason for note in SPEC.notes}
    (friction,) = [row for row in by_title["Assumed"] if row[0].text == "Friction"]
    assert friction[4].text == notes["benchmark.force.friction"].replace("gamma", "γ")


def test_what_the_specification_leaves_out_is_told_as_the_designs_own():
    """Catches a stall force that the benchmark took of the design, and that the page passes over."""
    bare = dataclasses.replace(
        SPEC, given={key: value for key, value in SPEC.given.items() if key != "benchmark.force.stall_force"}
    )
    found = run(spec=bare)
    shown = dataclasses.asdict(force_benchmark.benchmark_parameters(found))
    flat = benchmark_tables.parameters(bare, FORCE.section, force_benchmark.DEFAULT, shown)
    assert cells(flat, "Stall force")[2:] == ["191 N", "–", benchmark_tables.OWN]


def test_iron_cases_have_their_rows():
    table = force_benchmark.iron_table(ALONE.run, PARAMETERS)
    assert cells(table, "Behind neither")[1:] == ["1.739 %", "0.0805 %", "1.276"]
    assert cells(table, "As specified")[3] == "1.216"
    assert table.head[3] == "B_rem for 192 N (T)"


def test_the_section_stands_whole_on_the_page():
    """Catches a picture that is missing, symbols left as they are typed, and a miss that only the table shows."""
    refused = run(
        "other", simulations=(), figures={}, status="refused", reasons=("benchmark.force.third_peak is too large.",)
    )
    changed = {**FIGURES, "step_error_share": {"50": 0.0404, "100": 0.037}}
    whole = dataclasses.replace(ALONE, run=run(figures=changed), against=(refused,))
    page = render(ReportContent(spec=SPEC, simulation=whole))
    assert page.count('id="force-benchmark"') == 1
    assert 'href="#force-benchmark"' in page
    for name in ("loops", "zero-line", "experiments", "steps", "loci-k-e", "loci-k-l"):
        assert f"force-{name}-" in page
    assert "F<sub>stall</sub>" in page
    assert "other: benchmark.force.third_peak is too large." in page
    assert "Step of 50 N, final error: 4.04\u00a0% is simulated; it is not at most 4\u00a0%." in page
    assert "seed" not in re.sub(r"<(style|script|pre)\b.*?</\1>", "", page, flags=re.DOTALL)


def test_without_traces_the_words_and_the_loci_stay():
    """Catches a page that ends in a traceback where a record holds no traces."""
    simulation = run(traces=False).simulations[0]
    assert force_benchmark.runs.experiments(simulation) is None
    assert force_benchmark.runs.zero_force_line(simulation) is None
    assert force_benchmark.runs.steps(simulation, FIGURES["dominant_pole"]) is None
    static = force_benchmark.runs.of_run(simulation, "loop")
    assert force_benchmark_loops.loops(PARAMETERS, static) is None
    assert cells(force_benchmark_loops.loop_table(static), "165 N")[1:] == ["4.28", "1.00", "161.7"]


def test_other_designs_and_conditions_have_their_tables():
    """Catches a change against the wrong run, and a table of every figure that there is."""
    better = {**FIGURES, "estimation_rmse": {**RMSE, "3": {**RMSE["3"], "proposed": 1.19}}}
    other = run("other", figures=better, simulations=(dataclasses.replace(ALONE.run.simulations[0], figures=better),))
    whole = dataclasses.replace(
        ALONE, against=(other,), variations=(dataclasses.replace(other, label="friction, +10 %"),)
    )
    proposed = [item for item in FORCE.published if item.path[-1] == "proposed" and item.path[0] == "estimation_rmse"]
    designs = benchmark_tables.comparison(whole.runs, proposed, ())
    assert cells(designs, "other")[1:] == ["0.6100 (0.0000)", "0.9300 (0.0000)", "1.190 (-0.200)"]
    varied = benchmark_tables.variations(whole, proposed)
    assert varied.head == ("One change at a time", "RMSE 3, proposed (N)")
    assert cells(varied, "As it is")[1:] == ["1.390"]
    assert cells(varied, "Friction, +10 %")[1:] == ["1.190"]
    assert "seed" not in varied.caption


def test_every_benchmark_of_every_kind_has_its_section():
    """Catches a benchmark whose report says nothing of it."""
    names = {name for actuator in ACTUATORS.values() for name in actuator.benchmarks}
    assert names <= set(SECTIONS)
