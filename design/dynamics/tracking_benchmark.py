"""The tracking benchmark of an electro-hydrostatic actuator: sinusoidal forces, read in both ways, and its friction.

After the paper on the PREHydrA, Secs. III-A and IV: references of a force and a frequency behind a ramp (Figs. 6 and
7), friction identified at constant speeds (Fig. 3, Table I), and the figures of its Sec. V. A pair that the actuator
cannot make is a trial with its reason; the others go on.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict
from functools import lru_cache
from typing import Any

from fluxbore.design import hydrostatic_figures as closed
from fluxbore.design.dynamics.force_reference import READINGS
from fluxbore.design.dynamics.simulation import Simulation, Trial
from fluxbore.design.dynamics.tracking_identification import identified
from fluxbore.design.dynamics.tracking_pair import PairRun, run_pair
from fluxbore.design.dynamics.tracking_stand import TrackingStand, check_stand
from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic import HydrostaticActuator

NAME = "tracking"
TRACKING, IDENTIFICATION = ("tracking", "identification")
"""What a trial is: `setting["run"]`."""

ROW = ("max_error", "mean_absolute_error", "phase", "extremum_error", "peak_pressure", "energy_imbalance")
"""Of a pair's figures, those that the list `tracking` holds."""


def simulate(
    actuator: HydrostaticActuator, stand: TrackingStand, seed: int, *, whole: bool = True, traces: bool = False
) -> Simulation:
    """Every pair in both readings, and the friction identified from data that the seed draws.

    whole : whether all pairs are run, which figures over all of them need. Raises DesignError for a stand that cannot
    be, and where none of the pairs can be made.
    """
    check_stand(actuator, stand)
    runs = _tracked(actuator, stand, traces)
    if not any(run.figures is not None for run in runs):
        raise DesignError(runs[0].reason)
    found = identified(actuator.output_cylinder.friction, stand, seed)
    figures = {
        **abilities(actuator, stand),
        **tracking_figures(runs, stand, whole=whole),
        **found,
    }
    parameters = {
        f"{name}_{leaf}": value
        for name, each in found["identified_friction"].items()
        for leaf, value in each.items()
        if leaf in ("value", "standard_error")
    }
    trials = [*(_trial(run, stand.ramp) for run in runs), Trial({"run": IDENTIFICATION}, parameters)]
    return Simulation(NAME, seed, tuple(trials), figures)


def abilities(actuator: HydrostaticActuator, stand: TrackingStand) -> dict[str, float]:
    """What needs no simulated time, SI units.

    Friction at the limit and the efficiencies are at the fastest speed and the highest pressure of the stand, the
    latter at the largest amplitude: F/(F + F_f) as the paper reads it, the same with both cylinders' friction, and
    1 - F_f/F, which the paper's words could mean too.
    """
    amplitude = max(pair.amplitude for pair in stand.pairs)
    speed, pressure = stand.fastest_speed, stand.highest_pressure
    friction = closed.friction_at(actuator, speed, pressure)
    shares = closed.force_efficiency(actuator, amplitude, speed, pressure)
    return {
        "force_frequency_limit": closed.force_frequency_limit(actuator),
        "maximum_velocity": closed.maximum_velocity(actuator),
        "stroke_force": closed.stroke_force(actuator),
        "force_at_rated_pressure": closed.ideal_force(actuator),
        "pushing_force": closed.pushing_force(actuator, closed.maximum_velocity(actuator)),
        "minimum_friction": closed.smallest_friction(actuator),
        "friction_at_limit": friction,
        "efficiency": shares.one_cylinder,
        "efficiency_both_cylinders": shares.both_cylinders,
        "efficiency_by_difference": 1 - friction / amplitude,
    }


def tracking_figures(runs: tuple[PairRun, ...], stand: TrackingStand, *, whole: bool) -> dict[str, Any]:
    """Of all pairs: rows, those refused, errors by pair and reading, pressure at the largest force, energies."""
    made = [(run.pair, run.figures) for run in runs if run.figures is not None]
    largest = max(pair.amplitude for pair, _ in made)
    top = [figures for pair, figures in made if pair.amplitude == largest]
    main = main_run(runs, stand)
    assert main.figures is not None
    found: dict[str, Any] = {
        "tracking": [
            {**_named(run), **{name: getattr(run.figures, name) for name in ROW}}
            for run in runs
            if run.figures is not None
        ],
        "refused": [{**_named(run), "reason": run.reason} for run in runs if run.figures is None],
        "largest_force": largest,
        "peak_pressure": max(figures.peak_pressure for figures in top),
        "least_pressure": min(figures.least_pressure for _, figures in made),
        "energy_imbalance": max(figures.energy_imbalance for _, figures in made),
        "energy_of": f"{main.pair.name}, {main.pair.reading}",
        "energy": main.energy,
        "copper_loss": main.figures.copper_loss,
        "phase_of_largest_error": main.figures.phase,
        "error_at_extrema": main.figures.extremum_error,
    }
    for name in ("max_error", "mean_absolute_error"):
        table: dict[str, dict[str, float]] = {}
        for pair, figures in made:
            table.setdefault(pair.name, {})[pair.reading] = getattr(figures, name)
        found[name] = table
    if whole:
        least = min(made, key=lambda item: item[1].mean_absolute_error)
        found["largest_mean_absolute_error"] = max(figures.mean_absolute_error for _, figures in made)
        found["frequency_of_least_error"] = least[0].frequency
    return found


def main_run(runs: tuple[PairRun, ...], stand: TrackingStand) -> PairRun:
    """That of the operating point's pair by the reading that (4) counts, or else the first that can be made."""
    made = [run for run in runs if run.figures is not None]
    wanted = [run for run in made if (run.pair.amplitude, run.pair.frequency) == stand.main]
    return min(wanted or made, key=lambda run: READINGS.index(run.pair.reading) if wanted else 0)


@lru_cache(maxsize=2)
def _tracked(actuator: HydrostaticActuator, stand: TrackingStand, traces: bool) -> tuple[PairRun, ...]:
    """Nothing of it is drawn by chance: the seeds that one process simulates share it."""
    return tuple(run_pair(actuator, stand, pair, traces=traces) for pair in stand.pairs)


def _named(run: PairRun) -> dict[str, float | str]:
    return {"amplitude": run.pair.amplitude, "frequency": run.pair.frequency, "reading": run.pair.reading}


def _trial(run: PairRun, ramp: float) -> Trial:
    setting: Mapping[str, str | float] = {"run": TRACKING, **_named(run), "ramp": ramp, "reason": run.reason}
    figures = dict.fromkeys(ROW, math.nan) if run.figures is None else asdict(run.figures)
    return Trial(setting, figures, run.trace)
