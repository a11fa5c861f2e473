"""Simulations as the journal keeps them, and the key under which one stands there."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from typing import Any

from fluxbore.design.dynamics.simulation import Simulation, Trial
from fluxbore.design.spec import Spec
from fluxbore.optimize.benchmark import Benchmark
from fluxbore.optimize.design_key import canonical, design_key


def simulation_key(benchmark: Benchmark, spec: Spec, fidelity: str, field: Any, seed: int) -> str:
    """SHA-256 of everything that decides a simulation: design, field, benchmark, seed and program."""
    content = [design_key(spec, fidelity, benchmark.simulate), benchmark.name, canonical(field), seed]
    return hashlib.sha256(json.dumps(content).encode()).hexdigest()


def to_plain(simulation: Simulation) -> dict[str, Any]:
    """The simulation without its traces, as JSON has it; None for what is not finite."""
    return {
        "benchmark": simulation.benchmark,
        "seed": simulation.seed,
        "trials": [{"setting": dict(item.setting), "figures": dict(item.figures)} for item in simulation.trials],
        "figures": simulation.figures,
    }


def from_plain(plain: Mapping[str, Any]) -> Simulation:
    """The inverse of `to_plain`."""
    trials = tuple(
        Trial(
            dict(item["setting"]),
            {name: math.nan if value is None else value for name, value in item["figures"].items()},
        )
        for item in plain["trials"]
    )
    return Simulation(plain["benchmark"], plain["seed"], trials, plain["figures"])
