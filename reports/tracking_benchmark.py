"""The tracking benchmark of an electro-hydrostatic actuator on the page: what was simulated, beside what is published.

Of the paper on the PREHydrA: Figs. 3, 6 and 7, Table I, and the figures of its Secs. III to V.
"""

from __future__ import annotations

import math
from typing import Any

from fluxbore.design.dynamics.force_reference import READINGS
from fluxbore.design.dynamics.tracking_stand import TrackingStand, tracking_stand
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.optimize.benchmark import BenchmarkResult, DesignRun, Published
from fluxbore.optimize.hydrostatic_benchmark import (
    FIG_7,
    MEASURED_ERROR,
    MEASURED_MEAN,
    MODEL_ERROR,
)
from fluxbore.optimize.hydrostatic_common import weighed
from fluxbore.reports import benchmark_tables as shared
from fluxbore.reports import tracking_benchmark_friction as friction
from fluxbore.reports import tracking_benchmark_range as pictures
from fluxbore.reports.tables import Cell, Table
from fluxbore.reports.wording import DASH, capital, greek, plain, significant

DEFAULT = "the default: the paper's, where it has one"

HOW = (
    "fluxbore simulate SPEC -o DIR --vary tells what a tenth more or less of some parameters does, and other "
    "assumptions; --against DESIGN.toml puts other designs through the same: both tables then stand here."
)


def section(result: BenchmarkResult) -> dict[str, Any]:
    """Everything that the template shows."""
    run, benchmark = result.run, result.benchmark
    first, actuator, stand = run.simulations[0], weighed(run.spec), tracking_stand(run.spec.values)
    law = actuator.output_cylinder.friction
    sound = [item for item in result.runs if item.ok]
    every = ("max_error", "mean_absolute_error")
    errors = [item for item in benchmark.published if item.path[0] in every and item.path != _LEFT_OUT]
    return {
        "sentences": sentences(run),
        "statistics": shared.statistics(result),
        "range": pictures.operating_range(first, actuator, stand),
        "errors": pictures.error_map(first),
        "error_table": error_table(run),
        "refused": tuple(f"{row['amplitude']:g} N at {row['frequency']:g} Hz, {row['reading']}: {row['reason']}"
                         for row in run.figures["refused"] or ()),
        "traces": pictures.traces(first, run.figures["energy_of"]),
        "phase": phase_sentence(run),
        "friction": friction.curve(law, stand, first.seed, first.figures),
        "friction_table": friction.table(law, stand, first.figures),
        "friction_text": friction_text(run, stand),
        "energy": energy_table(run),
        "energy_text": energy_text(run),
        "disagreements": disagreements(run, actuator, stand),
        "assumed": assumed(run),
        "parameters": shared.parameters(run.spec, benchmark.section, DEFAULT),
        "seeds": shared.seeds(result) if len(result.seeds) > 1 else None,
        "missed": shared.missed(result),
        "limits": tuple(greek(text) for text in benchmark.limits),
        "comparison": shared.comparison(sound, errors, benchmark.causes) if len(sound) > 1 else None,
        "variations": shared.variations(result, wanted(errors, benchmark.published)) if result.variations else None,
        "failed": tuple(f"{item.label}: {' '.join(item.reasons)}" for item in result.runs if not item.ok),
        "how": "" if result.against or result.variations else HOW,
    }  # fmt: skip


def wanted(errors: list[Published], published: tuple[Published, ...]) -> list[Published]:
    """The figures of the table of sensitivities."""
    others = ("peak_pressure", "phase_of_largest_error")
    return [*errors, *(item for item in published if item.path[0] in others)]


def sentences(run: DesignRun) -> tuple[str, ...]:
    """What was done, and what came of it."""
    figures = run.figures
    count, missing = len(figures["tracking"]), len(figures["refused"] or ())
    worst = figures.get("largest_mean_absolute_error")
    rest = f"; {missing} cannot be made, for the reasons below" if missing else ""
    bound = "" if worst is None else f" No mean absolute error exceeds {plain(worst, 2)}\u00a0N."
    return (
        "The output force follows a sinusoidal reference against the return element, the load held, in simulated time: "
        "velocity feed-forward (3) and proportional force feedback, sampled; the drive’s velocity loop, the inertias, "
        "both seals’ friction (1) and (2), and a column of fluid that gives and flows through hose and orifices.",
        f"Each pair of amplitude and frequency is run twice, since the paper’s amplitudes can be read in two ways: "
        f"{count} runs are made{rest}.{bound}",
    )


def error_table(run: DesignRun) -> Table:
    """Errors of every pair by both readings, where the paper tells them beside its own."""
    figures = run.figures
    rows: dict[tuple[float, float], dict[str, Any]] = {}
    for row in (*figures["tracking"], *(figures["refused"] or ())):
        rows.setdefault((row["amplitude"], row["frequency"]), {})[row["reading"]] = row
    cells = []
    for (amplitude, frequency), found in sorted(rows.items(), key=lambda item: item[0][1]):
        paper = f"{amplitude:g} N at {frequency:g} Hz" == FIG_7
        texts = [Cell(f"{amplitude:g}\u00a0N at {frequency:g}\u00a0Hz")]
        for reading in READINGS:
            each = found.get(reading, {})
            refused = "max_error" not in each
            texts += [
                Cell("cannot be made" if refused else plain(each["max_error"], 2), "muted" if refused else "strong"),
                Cell(DASH if refused else plain(each["mean_absolute_error"], 2), "" if refused else "strong"),
                Cell(DASH if refused else f"{math.degrees(each['phase']):.0f}"),
            ]
        texts.append(
            Cell(f"model {MODEL_ERROR:g}; measured {MEASURED_ERROR:g}, mean {MEASURED_MEAN:g}" if paper else DASH)
        )
        cells.append(tuple(texts))
    head = (
        "Amplitude and frequency",
        *(f"{title} ({unit}), {word}" for word in ("half", "whole") for title, unit in _COLUMNS),
        "Paper (N)",
    )
    return Table(
        "Errors, the amplitude read as half the distance between the peaks and as the whole of it; the paper’s mean "
        "absolute errors lie between 0.44 and 3.61 N",
        head,
        tuple(cells),
        words=frozenset({7}),
    )


_LEFT_OUT = ("mean_absolute_error", FIG_7, "peak-to-peak")
"""Of the tables of designs and sensitivities, which are wide: it goes with the others."""

_COLUMNS = (("Largest", "N"), ("Mean", "N"), ("Largest after extremum", "deg"))


def phase_sentence(run: DesignRun) -> str:
    """Where in the period the largest error comes, beside what the paper says of it."""
    figures = run.figures
    pair = str(figures["energy_of"]).partition(",")[0]
    phase = math.degrees(figures["phase_of_largest_error"])
    away = min(phase, 180 - phase)
    at_extrema = figures["error_at_extrema"]
    largest = figures["max_error"][pair][str(figures["energy_of"]).partition(", ")[2]]
    slow = [
        row for row in figures["tracking"] if min(math.degrees(row["phase"]), 180 - math.degrees(row["phase"])) < 20
    ]
    text = (
        f"At {pair} the error is largest {phase:.0f}° after an extremum of the reference, {plain(largest, 2)}\u00a0N; "
        f"within 5° of an extremum it is {plain(at_extrema, 2)}\u00a0N at most. "
    )
    if away > 20:
        text += (
            "The paper’s Fig. 7 has it at the extrema, where the motion turns and static friction acts. This model "
            "does not: at the middle of the way the viscous friction of both seals exceeds their static friction, and "
            "the sampled feed-forward lags there most. "
        )
    if slow:
        names = ", ".join(f"{row['amplitude']:g}\u00a0N at {row['frequency']:g}\u00a0Hz" for row in slow)
        text += f"Nearly at the extrema it is for {names}."
    return text.strip()


def friction_text(run: DesignRun, stand: TrackingStand) -> str:
    """How the data were drawn and what they tell."""
    refused = run.simulations[0].figures["identification_refused"]
    told = (
        f"This seed’s data do not tell the parameters: {refused} "
        if refused
        else "The pressure’s share is taken off and f_C is taken as known, as in the paper. "
    )
    return (
        f"Friction is measured at {stand.speeds} constant speeds from {stand.slowest_speed * 1e3:g} to "
        f"{stand.fastest_speed * 1e3:g}\u00a0mm/s with a scatter of {stand.noise:g}\u00a0N, drawn by the seed. {told}"
        "Speeds and scatter are assumed so that the errors to expect are such as Table I has; geometric speeds would "
        "tell F_S0 and c better from as many runs, which is the plan to follow."
    )


def energy_table(run: DesignRun) -> Table:
    """What entered, left, was stored and was lost in each component over the run of the main pair."""
    energy = run.figures["energy"]
    rows = tuple(
        (
            Cell(capital(name)),
            *(Cell(plain(part[column], 3)) for column in ("entered", "left", "stored")),
            Cell(plain(part["lost"], 3), "strong"),
            Cell(significant(part["entered"] - part["left"] - part["stored"] - part["lost"], 2)),
        )
        for name, part in energy.items()
    )
    lost = sum(part["lost"] for part in energy.values())
    foot = ((Cell("All"), Cell(""), Cell(""), Cell(""), Cell(plain(lost, 3), "strong"), Cell("")),)
    head = ("Component", "Entered (J)", "Left (J)", "Stored (J)", "Lost (J)", "Not accounted for (J)")
    return Table(f"Energy over the run of {run.figures['energy_of']}", head, rows, foot)


def energy_text(run: DesignRun) -> str:
    """How well energy balances, and what it is lost in."""
    energy = run.figures["energy"]
    first, second = sorted(energy, key=lambda name: -energy[name]["lost"])[:2]
    return (
        "What enters at each port less what leaves at the next is stored or lost, each by its own formula. The "
        f"largest difference in any component of any run is {significant(run.figures['energy_imbalance'], 2)} of the "
        f"energy that enters. Most is lost in the {first} and the {second}. The winding loses "
        f"{plain(run.figures['copper_loss'], 2)}\u00a0W besides, on average."
    )


def disagreements(run: DesignRun, actuator: HydrostaticActuator, stand: TrackingStand) -> Table:
    """Where the paper's own figures do not agree with each other, with what this specification gives."""
    figures, stroke = run.figures, actuator.output_cylinder.stroke
    amplitude = max(pair.amplitude for pair in stand.pairs)
    way = 2 * amplitude / max(actuator.return_element.stiffness(stroke / 2), 1e-9)
    share = [f"{plain(100 * figures[name], 1)}\u00a0%" for name in _SHARES]
    rows = (
        (
            Cell("Least friction"),
            Cell("7 N (text) and Table I"),
            Cell(f"{plain(figures['minimum_friction'], 1)} N by Table I’s law: no speed gives 7 N"),
        ),
        (
            Cell("Amplitude"),
            Cell("(4) and 0.47 m/s count half the distance between peaks; 300 N is “amplitude” too"),
            Cell(
                f"{amplitude:g} N read so takes {way * 1e3:.0f} mm of {stroke * 1e3:.1f} mm of stroke: it must be the "
                "whole distance. Both readings are simulated"
            ),
        ),
        (
            Cell("Efficiency"),
            Cell("87 %"),
            Cell(f"F/(F + F_f) is {share[0]}, 1 − F_f/F {share[2]}; with both cylinders’ friction {share[1]}"),
        ),
        (
            Cell("Largest pressure"),
            Cell("26 bar at 300 N"),
            Cell(
                f"{plain(figures['peak_pressure'] / 1e5, 1)} bar simulated for a peak of offset and whole amplitude; "
                "26 bar fit a peak of 383 N, the stroke’s 433 N less the margin"
            ),
        ),
        (
            Cell("Standard error of F_S0"),
            Cell("5.96 N/Pa"),
            Cell("a force has the unit N; so it is read here"),
        ),
    )
    return Table(
        "Where the paper’s own figures disagree",
        ("Figure", "The paper", "Here"),
        rows,
        words=frozenset({1, 2}),
        signs=True,
    )


_SHARES = ("efficiency", "efficiency_both_cylinders", "efficiency_by_difference")


def assumed(run: DesignRun) -> Table:
    """Every value of the specification that is marked as assumed or calibrated, with its reason."""
    spec, rows = run.spec, []
    for note in spec.notes:
        value = spec.values.get(note.key)
        if value is None:
            continue
        key = spec.kind.key(note.key)
        assert key is not None
        place = note.key.removeprefix("actuator.").rpartition(".")[0].replace("_", " ").replace(".", ", ")
        rows.append(
            (
                Cell(capital(place or "actuator")),
                Cell(note.key.rpartition(".")[2].replace("_", " ")),
                Cell(key.show(value)),
                Cell(note.status),
                Cell(greek(note.reason)),
            )
        )
    head = ("Component", "What", "Value", "Status", "Reason")
    return Table("What the paper does not publish", head, tuple(rows), words=frozenset({1, 3, 4}))
