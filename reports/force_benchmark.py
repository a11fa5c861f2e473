"""The benchmark of a lead screw's force on the page: what was simulated, beside what was measured."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from fluxbore.design.dynamics.force_parameters import ForceParameters, force_parameters
from fluxbore.optimize.benchmark import Benchmark, BenchmarkResult, DesignRun
from fluxbore.reports import benchmark_tables as shared
from fluxbore.reports import force_benchmark_loci as loci
from fluxbore.reports import force_benchmark_loops as loops
from fluxbore.reports import force_benchmark_poles as stability
from fluxbore.reports import force_benchmark_runs as runs
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import capital, greek, key_label, listing, plain

DEFAULT = "the default: the paper's, where it has one"

HOW = (
    "fluxbore simulate SPEC -o DIR --against DESIGN.toml puts other designs through the same, and --vary tells what a "
    "tenth more or less of some parameters does: both tables then stand here."
)

ALLOWED = 0.2
"""Of the published error, within which the linear estimate of experiment 3 agrees with it."""

LINEAR, POLYNOMIAL, PROPOSED = runs.ESTIMATES


def section(result: BenchmarkResult) -> dict[str, Any]:
    """Everything that the template shows."""
    run, benchmark = result.run, result.benchmark
    first, parameters = run.simulations[0], benchmark_parameters(run)
    sound = [item for item in result.runs if item.ok]
    errors = [item for item in benchmark.published if item.path[0] == "estimation_rmse" and item.path[-1] == PROPOSED]
    third = [item for item in benchmark.published if item.path[:2] == ("estimation_rmse", "3") and item not in errors]
    ends = [item for item in benchmark.published if item.path[0] == "step_error_share"]
    static = runs.of_run(first, "loop")
    return {
        "sentences": sentences(run, parameters),
        "statistics": shared.statistics(result),
        "calibrated": calibrated(run, benchmark),
        "parameters": by_status(shared.parameters(run.spec, benchmark.section, DEFAULT, asdict(parameters))),
        "loops": loops.loops(parameters, static),
        "loop_table": loops.loop_table(static),
        "peak": loops.peak_sentence(parameters),
        "zero_line": runs.zero_force_line(first),
        "zero_line_text": zero_line_text(run, parameters),
        "experiments": runs.experiments(first),
        "errors": errors_table(run, parameters, benchmark),
        "contradiction": contradiction(run, parameters, benchmark),
        "steps": runs.steps(first, run.figures["dominant_pole"]),
        "step_table": step_table(run),
        "step_text": step_text(),
        "poles": stability.pole_table(parameters),
        "stability": stability.sentences(run.figures, parameters),
        "loci": (loci.over_load(parameters), loci.over_spring(parameters)),
        "iron": iron_table(run, parameters),
        "missed": shared.missed(result),
        "limits": tuple(greek(text) for text in benchmark.limits),
        "comparison": shared.comparison(sound, errors, benchmark.causes) if len(sound) > 1 else None,
        "variations": shared.variations(result, [*errors, *third, *ends]) if result.variations else None,
        "failed": tuple(f"{item.label}: {' '.join(item.reasons)}" for item in result.runs if not item.ok),
        "how": "" if result.against or result.variations else HOW,
    }


def benchmark_parameters(run: DesignRun) -> ForceParameters:
    """Those that the run was simulated with: the section's keys, and where it has none the design's own figures."""
    return force_parameters(run.spec.actuator, run.spec.values, asdict(run.field))


def sentences(run: DesignRun, parameters: ForceParameters) -> tuple[str, ...]:
    """What was done, and what came of it."""
    p, figures = parameters, run.figures
    ratios = listing(f"{plain(100 * value, 0)}\u00a0%" for value in figures["proposed_over_polynomial"].values())
    steps = listing(f"{float(force):g}" for force in figures["step_t63"])
    peaks = listing(f"{peak:g}" for peak in p.peaks.values())
    return (
        "The rotor turns under position control, the magnetic spring drives the mover, and the mover presses on a load "
        f"of {plain(p.load_stiffness / 1e3, 2)}\u00a0kN/m, all in simulated time. The estimates know no more than the "
        "two encoders do: the rotor’s angle and the mover’s position.",
        f"Two unloaded runs find the zero-force line; experiments 1 to 3 press up to {peaks}\u00a0N under three "
        f"estimates of the load’s force; the force control steps to {steps}\u00a0N. The proposed estimate errs by "
        f"{ratios} of what the polynomial one does, root mean square.",
    )


def calibrated(run: DesignRun, benchmark: Benchmark) -> tuple[str, ...]:
    """What was fitted to a measurement, and what therefore is predicted."""
    fitted = [note for note in run.spec.notes if note.status == "calibrated" and note.key.startswith(benchmark.section)]
    if not fitted:
        return ("Nothing of the benchmark is calibrated: every figure is a prediction from its parameters.",)
    return (
        *(f"Calibrated: {key_label(run.spec, note.key)} ({note.reason})." for note in fitted),
        "Predicted, then: everything else, which is the other errors of all three estimates, the zero-force line that "
        "the unloaded runs find, the loops, the steps of the force and the poles.",
    )


def by_status(table: Table) -> Table:
    """The parameters under headings, by where their values come from."""
    status, reason = 3, 4
    groups = {
        "Published, or given without a mark": [row for row in table.rows if row[reason].text == shared.GIVEN],
        "Of the design itself": [row for row in table.rows if row[reason].text == shared.OWN],
        "Calibrated": [row for row in table.rows if row[status].text == "calibrated"],
        "Assumed": [row for row in table.rows if row[status].text == "assumed"],
        "As the default has it": [row for row in table.rows if row[reason].text == DEFAULT],
    }
    rows: list[tuple[Cell, ...]] = []
    headings = []
    for title, members in groups.items():
        if members:
            headings.append((len(rows), f"{title} ({len(members)})"))
            rows += members
    return Table(table.caption, table.head, tuple(rows), words=table.words, sections=tuple(headings))


def zero_line_text(run: DesignRun, parameters: ForceParameters) -> str:
    """How well the unloaded runs tell the zero-force line, and the friction."""
    figures = run.figures
    return (
        f"The line that the runs find is {plain(figures['zero_force_line_error'] * 1e6, 2)}\u00a0µm (rms) off the "
        f"plant’s own, of a wave of {plain(parameters.distortion * 1e6, 1)}\u00a0µm. Half of the gap between the runs "
        f"tells the mover’s friction: {plain(figures['friction_found'], 2)}\u00a0N, where the plant has "
        f"{plain(parameters.friction, 2)}\u00a0N."
    )


def errors_table(run: DesignRun, parameters: ForceParameters, benchmark: Benchmark) -> Table:
    """Root mean square errors beside Table III, and their ratios."""
    given: Mapping[tuple[str, str], float] = {
        (item.path[1], item.path[2]): item.value
        for item in benchmark.published
        if item.path[0] == "estimation_rmse" and item.value is not None
    }
    found: Mapping[str, Mapping[str, float]] = run.figures["estimation_rmse"]
    rows = [
        _errors(f"{number}, to {parameters.peaks[number]:g}\u00a0N", found[number], number, given) for number in found
    ]
    lower = f"3, but to {parameters.lower_peak:g}\u00a0N"
    rows.append(_errors(lower, run.figures["estimation_rmse_lower_peak"], "", given))
    ratios = ("Proposed / polynomial", "Linear / polynomial")
    head = ("Experiment", *(f"{capital(name)} (N)" for name in runs.ESTIMATES), *ratios)
    return Table("Root mean square errors of the estimates; in brackets the paper’s Table III", head, tuple(rows))


def _errors(
    label: str, found: Mapping[str, float], number: str, given: Mapping[tuple[str, str], float]
) -> tuple[Cell, ...]:
    paper = {name: given[number, name] for name in runs.ESTIMATES if (number, name) in given}

    def ratio(above: str) -> Cell:
        text = f"{plain(100 * found[above] / found[POLYNOMIAL], 0)}\u00a0%"
        known = above in paper and POLYNOMIAL in paper
        return Cell(text + (f" ({plain(100 * paper[above] / paper[POLYNOMIAL], 0)}\u00a0%)" if known else ""))

    def error(name: str) -> Cell:
        text = plain(found[name], 2) + (f" ({plain(paper[name], 2)})" if name in paper else "")
        return Cell(text, "strong" if name == PROPOSED else "")

    return (Cell(label), *(error(name) for name in runs.ESTIMATES), ratio(PROPOSED), ratio(LINEAR))


def contradiction(run: DesignRun, parameters: ForceParameters, benchmark: Benchmark) -> str:
    """Why the linear estimate of experiment 3 is what it is, whatever the plant."""
    p = parameters
    peak = p.third_peak
    over = p.spring_constant * p.transfer_ratio * math.asin(peak / p.stall_force) - peak
    found = run.figures["estimation_rmse"]["3"][LINEAR]
    lower = run.figures["estimation_rmse_lower_peak"][LINEAR]
    paper = next((item.value for item in benchmark.published if item.path == ("estimation_rmse", "3", LINEAR)), None)
    text = (
        f"At {peak:g}\u00a0N the line K_s x_d with K_s = {plain(p.spring_constant / 1e3, 0)}\u00a0kN/m lies "
        f"{plain(over, 1)}\u00a0N above the sine with F_stall = {plain(p.stall_force, 0)}\u00a0N, whatever the rest of "
        f"the plant: the linear estimate of experiment 3 errs by {plain(found, 1)}\u00a0N."
    )
    if paper is None:
        return text
    apart = abs(found - paper) > ALLOWED * paper
    word = "do not allow together" if apart else "allow"
    return (
        f"{text} The paper prints {plain(paper, 2)}\u00a0N, which this K_s, F_stall and peak {word}; a peak of "
        f"{p.lower_peak:g}\u00a0N gives {plain(lower, 1)}\u00a0N."
    )


IRON = {
    "both": "behind both members",
    "translator": "behind the translator’s magnets alone",
    "none": "behind neither",
}


def iron_table(run: DesignRun, parameters: ForceParameters) -> Table:
    """What the analytic field (7) to (10) makes of the screw, by where there is iron behind the magnets."""
    figures = run.figures
    shown = {"as specified": figures, **{text: figures["iron_cases"][name] for name, text in IRON.items()}}
    rows = tuple(
        (
            Cell(capital(name)),
            Cell(f"{plain(100 * found['harmonic_ratio_2'], 3)}\u00a0%"),
            Cell(f"{plain(100 * found['harmonic_ratio_3'], 4)}\u00a0%"),
            Cell(plain(found["remanence_for_stall_force"], 3), "strong"),
        )
        for name, found in shown.items()
    )
    head = ("Iron", "K_2/K_1", "K_3/K_1", f"B_rem for {plain(parameters.stall_force, 0)} N (T)")
    return Table("Harmonics of the force, and the remanence that gives the stall force", head, rows)


def step_table(run: DesignRun) -> Table:
    """Times and errors of the steps, beside the dominant pole."""
    figures = run.figures
    rows = []
    for force, t63 in figures["step_t63"].items():
        pole, error = figures["dominant_pole"][force], figures["step_error"][force]
        slow = -1 / pole
        blind = figures["step_error_without_line"][force]
        rows.append(
            (
                Cell(f"{float(force):g}\u00a0N"),
                Cell(plain(t63, 3), "strong"),
                Cell(plain(slow, 3)),
                Cell(f"{'+' if t63 > slow else ''}{plain(100 * (t63 / slow - 1), 1)}\u00a0%"),
                Cell(plain(figures["step_t98"][force], 2)),
                Cell(f"{plain(error, 2)} ({plain(100 * error / float(force), 1)}\u00a0%)", "strong"),
                Cell(f"{plain(100 * figures['step_overshoot'][force], 2)}\u00a0%"),
                Cell(plain(blind, 2)),
            )
        )
    head = (
        "Step to",
        "To 63 % (s)",
        "1/|dominant pole| (s)",
        "Apart",
        "To 98 % (s)",
        "Error at the end (N)",
        "Overshoot",
        "Error without x_d0 (N)",
    )
    return Table("Steps of the force; the pole is linearised at the reference", head, tuple(rows))


def step_text() -> str:
    """Where the error at the end comes from."""
    return (
        "(31) inverts the plain sine. What the spring holds back by its hysteresis, and what the guides hold by "
        "friction once the mover creeps up to its place, stays as the error at the end."
    )
