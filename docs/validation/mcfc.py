"""Writes docs/validation/mcfc.md: the contact-force benchmark beside the paper. Run from the repository's top.

Takes some five minutes on one core, most of it the calibration; `--check` compares with the file instead of writing
it, from the tables on.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

import fluxbore
from fluxbore.design.dynamics.contact_force import COUNTED, simulate, untuned_rmse
from fluxbore.design.dynamics.contact_force_run import BY_CURRENT, BY_PRESSURE, CONDITIONS, NO_COMPENSATION
from fluxbore.design.dynamics.force_map import ForceMap
from fluxbore.design.dynamics.simulation import Simulation
from fluxbore.optimize.hybrid_force_map import force_map_of, map_values

TOP = Path(__file__).parent.parent.parent
TARGET = Path(__file__).with_suffix(".md")
SPEC = fluxbore.load(TOP / "examples" / "ipehla.toml")
SECTION = "benchmark.mcfc."

Floats = NDArray[np.float64]
Run = Callable[[int, Mapping[str, float]], Simulation]

SEEDS = (1, 2, 3, 4, 5)
CALIBRATION_SEEDS = (101, 102, 103)
"""Not those of the tables, so that no seed is fitted to what it shows."""

START = {"velocity_filter": 0.025, "valve_lag": 0.12}
"""s, of the search; a third of the paper's shortest period and less."""

PUBLISHED = {BY_PRESSURE: 2.94, BY_CURRENT: 1.26}
"""N, the medians that the calibration is held to; P-N is not among them."""

MEDIAN_SCALE, CELL_SCALE, BLUR = 0.05, 0.5, 0.05
"""N, cells and N: what counts as one unit of disagreement, and the width over which a cell changes hands."""

CHANGES: tuple[tuple[str, dict[str, float]], ...] = (
    ("as calibrated", {}),
    ("friction 10 % higher than the controller's", {"friction_share": 1.1}),
    ("friction 10 % lower than the controller's", {"friction_share": 0.9}),
    ("friction scatters by 3 % from run to run", {"friction_scatter": 0.03}),
    ("valve lag 0.10 s", {"valve_lag": 0.10}),
    ("valve lag 0.20 s", {"valve_lag": 0.20}),
    ("valve delay 10 ms", {"valve_delay": 0.010}),
    ("valve delay 40 ms", {"valve_delay": 0.040}),
    ("velocity filter 15 ms", {"velocity_filter": 0.015}),
    ("velocity filter 45 ms", {"velocity_filter": 0.045}),
    ("chamber and hose 15 cm³", {"chamber_volume": 15e-6}),
    ("chamber and hose 60 cm³", {"chamber_volume": 60e-6}),
    ("isothermal air", {"gas_exponent": 1.0}),
    ("controller's force constant too high, as 8.67 for 8.02 N/A", {"force_constant": 8.67 / 8.02}),
    ("controller's force constant too low, as 8.02 for 8.67 N/A", {"force_constant": 8.02 / 8.67}),
    ("bristles of 50 N/mm", {"bristle_stiffness": 5e4}),
    ("bristles of 200 N/mm", {"bristle_stiffness": 2e5}),
    ("load actuator of 20 Hz", {"load_frequency": 20.0}),
    ("load actuator of 80 Hz", {"load_frequency": 80.0}),
    ("driver's delay 6 ms", {"driver_delay": 0.006}),
    ("no noise", {"noise": 0.0}),
    ("noise of 0.42 N", {"noise": 0.42}),
    ("control period 2 ms", {"control_period": 2e-3}),
    ("moving mass doubled", {"moving_mass": 2.0}),
    ("stroke 0.9 mm", {"stroke": 0.9e-3}),
    ("stroke 1.2 mm", {"stroke": 1.2e-3}),
)
"""Sensitivities; force constant and mass as multiples of their own values."""

STROKES = (0.9e-3, 1.05e-3, 1.2e-3)
"""m: what the paper's window and speeds leave open."""

RECALIBRATED: tuple[tuple[str, dict[str, float]], ...] = (
    ("bristles of 50 N/mm", {"bristle_stiffness": 5e4}),
    ("bristles of 200 N/mm", {"bristle_stiffness": 2e5}),
)
"""Other assumptions, for which the two times are sought once more."""


def runner() -> tuple[Run, ForceMap]:
    """Simulations of the prototype over the finite elements' force map, and that map."""
    evaluation = fluxbore.evaluate(SPEC.with_values(map_values(SPEC)))
    force_map, mass = force_map_of(evaluation), evaluation.performance.moving_mass
    assert mass is not None

    def run(seed: int, changes: Mapping[str, float]) -> Simulation:
        scales = {"force_constant": force_map.mean_force_constant, "moving_mass": mass}
        values = {SECTION + name: value * scales.get(name, 1.0) for name, value in changes.items()}
        return simulate(SPEC.actuator, {**SPEC.values, **values}, force_map, seed, moving_mass=mass)

    return run, force_map


def errors(simulation: Simulation) -> dict[str, Floats]:
    """(36,) of each condition at the targets that count (N)."""
    return {
        condition: np.array(
            [
                trial.figures["rmse"]
                for trial in simulation.trials
                if trial.setting["condition"] == condition and trial.setting["target"] in COUNTED
            ]
        )
        for condition in CONDITIONS
    }


def disagreement(simulation: Simulation) -> float:
    """Sum of squares over two medians and two counts of cells, 18 and 36, each by its scale."""
    found = errors(simulation)
    none, pneumatic, electric = (found[name] for name in (NO_COMPENSATION, BY_PRESSURE, BY_CURRENT))

    def below(a: Floats, b: Floats) -> Floats:
        return np.asarray(1 / (1 + np.exp(np.clip((a - b) / BLUR, -50, 50))))

    medians = sum(((float(np.median(found[name])) - value) / MEDIAN_SCALE) ** 2 for name, value in PUBLISHED.items())
    wins = float(np.sum(below(pneumatic, none)))
    lowest = float(np.sum(below(electric, none) * below(electric, pneumatic)))
    return medians + ((wins - 18) / CELL_SCALE) ** 2 + ((lowest - 36) / CELL_SCALE) ** 2


def calibrate(run: Run) -> tuple[dict[str, float], float, int]:
    """The two calibrated times (s), the disagreement left, and the simulations it took."""
    names = list(START)

    def cost(logarithms: Floats) -> float:
        changes = {**dict(zip(names, np.exp(logarithms).tolist(), strict=True)), "time_step": 1e-3}
        return float(np.mean([disagreement(run(seed, changes)) for seed in CALIBRATION_SEEDS]))

    start = np.log(list(START.values()))
    simplex = np.vstack([start, start + [0.2, 0.0], start + [0.0, 0.2]])
    found = minimize(
        cost, start, method="Nelder-Mead", options={"initial_simplex": simplex, "xatol": 5e-3, "fatol": 1e-2}
    )
    fitted = dict(zip(names, np.exp(found.x).tolist(), strict=True))
    return fitted, float(found.fun), int(found.nfev) * len(CALIBRATION_SEEDS)


def calibration(run: Run) -> str:
    """What was calibrated, how, and to what end."""
    fitted, left, simulations = calibrate(run)
    shown = ", ".join(map(str, CALIBRATION_SEEDS))
    start, ends, held = (
        " and ".join(f"{values[name] * 1e3:.4g} ms" for name in START)
        for values in (START, fitted, {name: SPEC.number(SECTION + name) for name in START})
    )
    return f"""Two times are calibrated, `velocity_filter` and `valve_lag`, to four published numbers: the medians of
P-P and P-E, and the 18 and 36 cells of 36 that chi2 = 54.0 stands for. P-N is not among them. Least squares with
{MEDIAN_SCALE} N and {CELL_SCALE} cells as units, cells blurred over {BLUR} N, seeds {shown}, steps of 1 ms;
Nelder and Mead's search in the logarithms from {start}. After {simulations} simulations it ends at
**{ends}**, with a disagreement of {left:.2f}. The example holds {held}. All other unpublished
values are assumed, with the reason beside each in the example."""


def recalibration(run: Run) -> str:
    """The two times under other assumptions, what is left, and the statistics that they give."""
    rows = []
    for label, changes in RECALIBRATED:

        def changed(seed: int, more: Mapping[str, float], changes: Mapping[str, float] = changes) -> Simulation:
            return run(seed, {**changes, **more})

        fitted, left, _ = calibrate(changed)
        times = " | ".join(f"{fitted[name] * 1e3:.3g}" for name in START)
        rows.append(row(f"{label} | {times} | {left:.2f}", changed(1, fitted)))
    return "\n".join(rows)


def untuned() -> str:
    """The median of (6) alone at each of the strokes."""
    medians = [
        float(np.median(list(untuned_rmse(SPEC.actuator, {**SPEC.values, SECTION + "stroke": stroke}).values())))
        for stroke in STROKES
    ]
    return ", ".join(f"{median:.3f} N at {stroke * 1e3:g} mm" for stroke, median in zip(STROKES, medians, strict=True))


def row(label: str, simulation: Simulation) -> str:
    """Medians, counts and tests of one simulation as a row."""
    figures = simulation.figures
    medians = " | ".join(f"{figures['median_rmse'][condition]:.3f}" for condition in CONDITIONS)
    corrected = {tuple(item["pair"]): item["p_corrected"] for item in figures["post_hoc"]}
    tests = " | ".join(f"{p:.2g}" for p in corrected.values())
    return (
        f"| {label} | {medians} | {figures['friedman_chi2']:.2f} | {figures['cells_lowest_P-E']} | "
        f"{figures['cells_P-P_below_P-N']} | {tests} |"
    )


def trends(simulations: list[Simulation]) -> str:
    """Spearman's correlation of error and speed, the weakest of the seeds."""
    rows = []
    for condition in CONDITIONS:
        found = [
            min((simulation.figures["trend"][condition][f"{target:g}"] for simulation in simulations), key=abs)
            for target in COUNTED
        ]
        rows.append(f"| {condition} | {' | '.join(f'{value:+.2f}' for value in found)} |")
    return "\n".join(rows)


def steps(run: Run) -> str:
    """The largest change of any of the 144 errors between steps (N)."""
    found = {}
    for step in (5e-5, 1e-4, 2e-4, 5e-4, 1e-3):
        trials = run(1, {"time_step": step}).trials
        found[step] = np.array([trial.figures["rmse"] for trial in trials])
    return "\n".join(f"| {step * 1e3:g} | {np.max(np.abs(value - found[5e-5])):.1e} |" for step, value in found.items())


def page() -> str:
    """The whole file."""
    commit = subprocess.run(
        ["git", "-C", TOP, "log", "-1", "--format=%h"], capture_output=True, text=True
    ).stdout.strip()
    run, force_map = runner()
    seeds = [run(seed, {}) for seed in SEEDS]
    five = "\n".join(row(str(seed), found) for seed, found in zip(SEEDS, seeds, strict=True))
    changed = "\n".join(row(label, run(1, changes)) for label, changes in CHANGES)
    cells = "\n".join(
        f"| {target:g} | {trial:g} | " + " | ".join(f"{value:.2f}" for value in values) + " |"
        for target, trial, values in by_cell(seeds[0])
    )
    header = "| median P-N | P-P | P-E | chi2 | P-E lowest | P-P below P-N | p P-N/P-P | p P-N/P-E | p P-P/P-E |"
    rule = "|---|---|---|---|---|---|---|---|---|---|"
    again = "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    return f"""# The contact-force benchmark: published statistics and ours

Nakata and Noda, "Fusion Hybrid Linear Actuator", IEEE/ASME Trans. Mechatronics 28 (2023), Sec. IV. Written by
`python docs/validation/mcfc.py` at commit {commit}, from `examples/ipehla.toml`; every number below is computed.
Medians in N over 36 cells (20, 40 and 60 N at twelve frequencies); p after Wilcoxon, times three after Bonferroni.

## Without a plant

The median over the 36 cells of |f_k| of equation (6) with Table IV at the speed 2 f stroke, for P-N, where the paper
has 3.13 N: {untuned()}.
The example's stroke of {SPEC.number(SECTION + "stroke") * 1e3:g} mm is inferred. Nothing in it is fitted to the error;
but the authors identified Table IV with this disturbance on this stand, so it checks that (6) is read as they meant it,
and predicts nothing of another stand.

## Five seeds

| seed {header}
{rule}
| paper | 3.13 | 2.94 | 1.26 | 54.0 | all | 18, by chi2 | not reported | < .001 | < .001 |
{five}

Spearman's correlation of error with mean speed, the weakest of the five seeds, by target force:

| | 20 N | 40 N | 60 N |
|---|---|---|---|
{trends(seeds)}

## The calibration

{calibration(run)}

## The same calibration under other assumptions

One assumption changed, the two times sought again in the same way. Times in ms; left is the disagreement, to be held
against that above.

| change | filter | valve lag | left {header}
{again}
{recalibration(run)}

Where as little is left as above or less, the published numbers do not tell these stands apart: the two times belong to
the assumptions that they were found under, and are no measurement of the authors' valve and filter.

## Sensitivity

One change at a time, seed 1.

| change {header}
{rule}
{changed}

## Step of the simulation

The largest change of any of the 144 errors against a step of 0.05 ms (N), seed 1:

| step (ms) | change |
|---|---|
{steps(run)}

## Every cell

Seed 1, root mean square error (N). The force constant over the way is {force_map.force_constant.min():.3f} to
{force_map.force_constant.max():.3f} N/A, the cogging {force_map.cogging.min():.3f} to {force_map.cogging.max():.3f} N.

| target (N) | frequency (Hz) | P-N | P-P | P-E |
|---|---|---|---|---|
{cells}

## What this does not show

- With two times fitted to four numbers it shows that one plant can reproduce P-P, P-E and the tests; not that it is the
  authors' plant. Chamber, bristles and load actuator could trade against the two times, as the table of sensitivities
  tells.
- The prototype's force constant was 8.02 N/A where the field gives 8.67. The controller here divides by the mean of
  the field it drives, as the authors' divided by what they had measured; two rows above tell what a wrong one does.
- Fig. 16 and Fig. 17 were not at hand as pictures; no curve is compared.
- Seeds draw the encoder's phase and the load cell's noise, which move little. Friction that differs from run to run is
  left out but for the row above.
"""


def by_cell(simulation: Simulation) -> list[tuple[float, float, list[float]]]:
    """Target, frequency and the three conditions' errors."""
    found: dict[tuple[float, float], list[float]] = {}
    for trial in simulation.trials:
        key = float(trial.setting["target"]), float(trial.setting["frequency"])
        found.setdefault(key, []).append(trial.figures["rmse"])
    return [(*key, found[key]) for key in sorted(found)]


if __name__ == "__main__":
    text = page()
    if "--check" in sys.argv[1:]:
        raise SystemExit(0 if text.splitlines()[5:] == TARGET.read_text(encoding="utf-8").splitlines()[5:] else 3)
    TARGET.write_text(text, encoding="utf-8")
