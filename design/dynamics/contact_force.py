"""The benchmark that maintains a contact force constant (MCFC; Nakata and Noda 2023, Sec. IV) in simulated time.

A load actuator pushes the mover to and fro; the actuator should press with its target force all the while. Three
conditions, four target forces and twelve frequencies of ten round trips each make 144 runs. Each has its root mean
square error; medians, cell counts and tests follow the paper over the target forces of 20, 40 and 60 N. Under P-P at
0 N the paper has no data, for its air could not pull; here the valve stops at the atmosphere, and the run is not
counted.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.contact_force_plant import ContactForcePlant, seal_law
from fluxbore.design.dynamics.contact_force_run import (
    BY_CURRENT,
    BY_PRESSURE,
    CONDITIONS,
    NO_COMPENSATION,
    Record,
    air,
    drive,
    run,
)
from fluxbore.design.dynamics.force_map import ForceMap
from fluxbore.design.dynamics.simulation import Simulation, Trace, Trial
from fluxbore.design.friction import kinetic_friction
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.keys import Values
from fluxbore.design.pneumatics import piston_area
from fluxbore.design.seal import contact_area, deformed_length
from fluxbore.design.statistics import compare, friedman, root_mean_square, trend

Floats = NDArray[np.float64]

BENCHMARK = "mcfc"

FREQUENCIES = (0.3, 0.5, 0.8, 1.0, 1.2, 1.4, 1.9, 2.2, 2.5, 3.0, 3.3, 3.6)
"""Hz, of the disturbance (Nakata and Noda 2023, Sec. IV-A)."""

TARGETS = (0.0, 20.0, 40.0, 60.0)
"""N, of the contact force (Sec. IV-D)."""

COUNTED = TARGETS[1:]
"""N, the targets of the paper's statistics (Sec. IV-E)."""

TRACE_POINTS = 2000
"""At most, of a kept trace: two hundred a round trip."""


def simulate(
    actuator: HybridActuator,
    values: Values,
    force_map: ForceMap,
    seed: int,
    *,
    moving_mass: float | None = None,
    contact_force: float | None = None,
    traces: bool = False,
) -> Simulation:
    """All 144 runs.

    values : resolved, of the specification. force_map : over the positions the benchmark passes. seed : of the
    encoder's phases and the load cell's noise, drawn for every run by itself. moving_mass, contact_force : of the mover
    (kg), and F_0 of its fins (N), where `benchmark.mcfc.moving_mass` and `actuator.seal.contact_force` are not given.
    traces : whether trials keep theirs.

    Trials come by frequency, target and condition; their figures are mean_speed (m/s) and rmse (N), which includes
    the load cell's noise. Raises SpecError.
    """
    plant = ContactForcePlant.from_values(actuator, values, force_map, moving_mass, contact_force)
    trials = []
    for i, frequency in enumerate(FREQUENCIES):
        driven = drive(plant, frequency)
        speed = float(np.mean(np.abs(driven.read.velocity[1:])))
        for j, target in enumerate(TARGETS):
            base = plant.target_pressure(target)
            # Without compensation by air the chamber is the same whatever the motor does.
            still = air(plant, driven, np.full(len(driven.read.time) - 1, base), base)
            for k, condition in enumerate(CONDITIONS):
                record = run(plant, driven, condition, target, np.random.default_rng([seed, i, j, k]), still)
                trials.append(
                    Trial(
                        {"condition": condition, "target": target, "frequency": frequency},
                        {"mean_speed": speed, "rmse": root_mean_square(record.force[1:] - target)},
                        _trace(record) if traces else None,
                    )
                )
    found = {"fin_deformed_length": deformed_length(actuator), "fin_contact_area": contact_area(actuator)}
    return Simulation(BENCHMARK, seed, tuple(trials), {**found, **statistics(tuple(trials))})


def statistics(trials: tuple[Trial, ...]) -> dict[str, Any]:
    """The paper's statistics over the targets that count, JSON-ready.

    median_rmse (N), cell counts of the 36, Friedman's and Wilcoxon's tests; trend : condition -> target (N, as a
    text) -> Spearman's correlation of error and mean speed, for every target.
    """
    cells = {
        condition: np.array(
            [trial.figures["rmse"] for trial in _of(trials, condition) if trial.setting["target"] in COUNTED]
        )
        for condition in CONDITIONS
    }
    test = friedman(cells)
    electric, pneumatic, none = cells[BY_CURRENT], cells[BY_PRESSURE], cells[NO_COMPENSATION]
    return {
        "median_rmse": {condition: float(np.median(errors)) for condition, errors in cells.items()},
        "friedman_chi2": test.chi2,
        "friedman_p": test.p,
        "rank_sums": dict(test.rank_sums),
        "cells": len(none),
        "cells_lowest_P-E": int(np.sum((electric < pneumatic) & (electric < none))),
        "cells_P-P_below_P-N": int(np.sum(pneumatic < none)),
        "post_hoc": [
            {
                "pair": [pair.first, pair.second],
                "statistic": pair.statistic,
                "p": pair.p,
                "p_corrected": pair.corrected,
                "medians": list(pair.medians),
            }
            for pair in compare(cells)
        ],
        "trend": {condition: _trends(trials, condition) for condition in CONDITIONS},
    }


def untuned_rmse(
    actuator: HybridActuator, values: Values, contact_force: float | None = None
) -> Mapping[tuple[float, float], float]:
    """(target (N), frequency (Hz)) -> error without compensation (N), by (6) alone: |f_k| at the speed 2 f stroke.

    No plant and no choice but the disturbance's stroke: the mover slides at one speed, and the friction is all that
    the contact force misses. For the targets that count; contact_force as in `simulate`.
    """
    law, area, stroke = seal_law(values, contact_force), contact_area(actuator), float(values["benchmark.mcfc.stroke"])
    return {
        (target, frequency): kinetic_friction(law, area, target / piston_area(actuator), 2 * frequency * stroke)
        for target in COUNTED
        for frequency in FREQUENCIES
    }


def _of(trials: tuple[Trial, ...], condition: str) -> list[Trial]:
    return [trial for trial in trials if trial.setting["condition"] == condition]


def _trends(trials: tuple[Trial, ...], condition: str) -> dict[str, float]:
    found = {}
    for target in TARGETS:
        chosen = [trial.figures for trial in _of(trials, condition) if trial.setting["target"] == target]
        found[f"{target:g}"] = trend([run["mean_speed"] for run in chosen], [run["rmse"] for run in chosen])
    return found


def _trace(record: Record) -> Trace:
    """Every n-th reading, so that a report can draw it."""
    stride = -(-len(record.time) // TRACE_POINTS)
    names = ("position", "velocity", "force", "friction", "pressure", "current", "velocity_estimate")
    signals = {name: np.ascontiguousarray(getattr(record, name)[::stride]) for name in names}
    return Trace(np.ascontiguousarray(record.time[::stride]), signals)
