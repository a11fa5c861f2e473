"""What a benchmark in simulated time gives, the same for every actuator: trials with their traces, and figures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Trace:
    """One trial over time: (n,) seconds, and signals of the same length by name, in SI units."""

    time: Floats
    signals: Mapping[str, Floats]


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """One run of a benchmark.

    setting : what was set, by name: words, or numbers in SI units. figures : what came out, SI units.
    trace : None where traces were not kept.
    """

    setting: Mapping[str, str | float]
    figures: Mapping[str, float]
    trace: Trace | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Simulation:
    """A benchmark's trials for one seed, and the figures that follow from all of them, JSON-ready."""

    benchmark: str
    seed: int
    trials: tuple[Trial, ...]
    figures: Mapping[str, Any] = field(default_factory=dict)
