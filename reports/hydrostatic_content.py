"""What the report shows of an electro-hydrostatic actuator alone: its range, the power along its chain, its margins."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.hydrostatic_range import Demand
from fluxbore.design.performance import Performance
from fluxbore.design.seal_gland import SealGland

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class OperatingPoint:
    """A sinusoidal force: amplitude (N, half the distance between its peaks), frequency (Hz), least force (N)."""

    amplitude: float
    frequency: float
    least: float

    @property
    def top(self) -> float:
        """Largest force (N)."""
        return self.least + 2 * self.amplitude


@dataclass(frozen=True, slots=True, eq=False)
class RangeMap:
    """frequencies : (n,) Hz. limits : limit -> (n,) amplitude (N) that it allows; one far beyond `amplitudes`, the
    least and the largest amplitude (N) that are of interest, is as far beyond them as was looked."""

    frequencies: Array
    limits: Mapping[str, Array]
    amplitudes: tuple[float, float]


@dataclass(frozen=True, slots=True)
class PortRow:
    """A port over whole periods: largest sizes of effort and flow in their units, mean power sent to the load and
    returned from it (W); their difference is lost behind the port."""

    name: str
    effort: float
    flow: float
    units: tuple[str, str]
    sent: float
    returned: float


@dataclass(frozen=True, slots=True, eq=False)
class Tracked:
    """The operating point in simulated time, its last whole periods.

    time : (k,) s from their start. reference, force : (k,) N. pressures : (k, 3) Pa gauge, of input cylinder, block and
    output cylinder. period : s. ports : in the order of the chain. losses : component and mean loss (W), the winding's
    first. stored : mean power (W) that components kept. imbalance : of energy, over what entered.
    """

    time: Array
    reference: Array
    force: Array
    pressures: Array
    period: float
    ports: tuple[PortRow, ...]
    losses: tuple[tuple[str, float], ...]
    stored: float
    imbalance: float


@dataclass(frozen=True, slots=True)
class Material:
    """Of the sized parts: name and yield stress (Pa)."""

    name: str
    yield_stress: float | None


@dataclass(frozen=True, slots=True, eq=False)
class HydraulicsContent:
    """SI units.

    actuator : as weighed. figures : the design's; those in closed form where it was not simulated. demand : of the
    operating point. range : None where the force does not change with the stroke. tracked : None where the operating
    point was not simulated, `untracked` being the reason. tube, rod : materials of the output cylinder. buckling :
    critical load (N) of the rod over the stroke by the way it is held (`column.END_CONDITIONS`). drawn : masses (kg) of
    the output cylinder and of its moving parts as drawn. unweighed : masses that the specification leaves to the
    drawing.
    """

    actuator: HydrostaticActuator
    figures: Performance
    point: OperatingPoint
    demand: Demand
    range: RangeMap | None
    tracked: Tracked | None
    untracked: str
    gland: SealGland
    tube: Material
    rod: Material
    buckling: Mapping[str, float]
    drawn: tuple[float, float]
    unweighed: tuple[str, ...]
