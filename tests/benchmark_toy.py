"""A benchmark of coils that costs nothing: its figures are the seed's own."""

from __future__ import annotations

import numpy as np

from fluxbore.design.dynamics.simulation import Simulation, Trace, Trial
from fluxbore.design.errors import DesignError
from fluxbore.design.spec import Spec
from fluxbore.optimize.benchmark import Benchmark, Published

RADIUS = "actuator.coil_1.radius"

calls: list[tuple[int, bool]] = []
"""Seed and traces of every simulation in this process."""


def simulate(spec: Spec, field: float, seed: int, traces: bool) -> Simulation:
    calls.append((seed, traces))
    if spec.number("actuator.coil_1.current_density") < 0:
        raise DesignError("A current against the field cannot be simulated.")
    time = np.linspace(0.0, 1.0, 5)
    error = seed * field * abs(spec.number(DENSITY)) / 22.5e6
    trials = tuple(
        Trial(
            {"way": way, "load": load},
            {"error": seed * field * load, "none": float("nan")},
            Trace(time, {"force": load * time}) if traces else None,
        )
        for way in ("A", "B")
        for load in (0.1, 0.2)
    )
    return Simulation("toy", seed, trials, {"error": {"A": error}, "cells": seed, "pairs": [[seed, "x"]]})


def designs(spec: Spec) -> list[dict[str, float]]:
    return [{}]


def field(spec: Spec, evaluations: list) -> float:
    return float(evaluations[0].performance.central_flux_density)


DENSITY = "actuator.coil_1.current_density"


def variations(spec: Spec, field: float) -> list[tuple[str, dict[str, float]]]:
    """The second the benchmark refuses, the third the key."""
    return [(f"{factor:g}", {DENSITY: factor * spec.number(DENSITY)}) for factor in (0.5, -1.0, 1e12)]


TOY = Benchmark(
    "toy",
    "toy",
    "nobody",
    designs,
    field,
    simulate,
    (Published(("error", "A"), "error", "count", 1.0, 0.5), Published(("cells",), "cells", "count")),
    variations=variations,
)
