"""The figures of an electro-hydrostatic actuator's benchmark, JSON-ready and in SI units: those of its data alone, the
tracking of the paper's pairs, and the friction that a simulated identification finds.

The efficiency is the paper's reading, 300 N over 300 N and one cylinder's friction at the largest speed and pressure,
`efficiency_both_cylinders` that of the whole column. `peak_pressure` is that of the 300 N runs. The identification
measures the output cylinder at `SPEEDS` speeds spaced geometrically, both ways, with `SCATTER` of noise by the seed:
at the paper's own spacing, which is not published, its standard errors come of 2 N.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fluxbore.design.cylinder_friction import cylinder_friction
from fluxbore.design.dynamics.force_tracking import Tracking
from fluxbore.design.friction_points import FrictionPoints
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.hydrostatic_figures import (
    force_efficiency,
    force_frequency_limit,
    friction_at,
    ideal_force,
    maximum_velocity,
    pushing_force,
    smallest_friction,
    stroke_force,
)
from fluxbore.design.hydrostatic_friction_identification import identify_cylinder_friction, plan
from fluxbore.design.identification import Identified

LIMIT_SPEED, LIMIT_PRESSURE, FORCE = 0.45, 26e5, 300.0
"""m/s, Pa gauge and N, at which the paper tells friction and efficiency."""

SPEEDS, SLOWEST, SCATTER = 30, 1e-3, 2.0
"""Number of speeds, the slowest (m/s), and the noise (N) of the simulated identification."""


def benchmark_figures(actuator: HydrostaticActuator, tracking: Sequence[Tracking], seed: int) -> dict[str, Any]:
    """By name; `tracking` is a list of rows, a row that could not be run with its `failure`."""
    shares = force_efficiency(actuator, FORCE, LIMIT_SPEED, LIMIT_PRESSURE)
    rows = [each for each in tracking if each.failure == ""]
    peaks = [each.peak_pressure for each in rows if each.pair.amplitude == FORCE and each.peak_pressure is not None]
    balances = [each.energy_imbalance for each in rows if each.energy_imbalance is not None]
    found = simulated_identification(actuator, seed)
    return {
        "force_frequency_limit": force_frequency_limit(actuator),
        "maximum_velocity": maximum_velocity(actuator),
        "minimum_friction": smallest_friction(actuator),
        "friction_at_limit": friction_at(actuator, LIMIT_SPEED, LIMIT_PRESSURE),
        "stroke_force": stroke_force(actuator),
        "force_at_rated_pressure": ideal_force(actuator),
        "pushing_force_at_rated_pressure": pushing_force(actuator, LIMIT_SPEED),
        "efficiency": shares.one_cylinder,
        "efficiency_both_cylinders": shares.both_cylinders,
        "peak_pressure": max(peaks) if peaks else None,
        "tracking": [tracking_row(each) for each in tracking],
        "identified_friction": {
            name: {"value": each.value, "standard_error": each.standard_error}
            for name, each in found.parameters.items()
        },
        "energy_imbalance": max(balances) if balances else None,
    }


def tracking_row(found: Tracking) -> Mapping[str, Any]:
    """One run by the names of the figures."""
    row: dict[str, Any] = {
        "amplitude": found.pair.amplitude,
        "frequency": found.pair.frequency,
        "assumed": found.pair.assumed,
        "reading": found.reading,
    }
    if found.failure:
        return row | {"failure": found.failure}
    names = ("max_error", "mean_absolute_error", "phase", "peak_pressure", "least_pressure", "peak_torque")
    return row | {name: getattr(found, name) for name in (*names, "fluid_loss", "energy_imbalance")}


def simulated_identification(actuator: HydrostaticActuator, seed: int) -> Identified:
    """The output cylinder's friction from simulated points at a plan's speeds, f_C known, as the paper has it."""
    law = actuator.output_cylinder.friction
    speeds = plan(law, SLOWEST, maximum_velocity(actuator), SPEEDS, SCATTER).speeds
    v = np.concatenate((speeds, -speeds))
    noise = SCATTER * np.random.default_rng(seed).standard_normal(len(v))
    points = FrictionPoints(v, np.zeros_like(v), cylinder_friction(law, v, 0.0) + noise, "the simulated experiment")
    return identify_cylinder_friction(points, known_pressure_coefficient=law.pressure_coefficient)
