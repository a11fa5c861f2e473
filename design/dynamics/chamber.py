"""Pressure in an air chamber with a moving piston, under a pressure control valve.

The energy balance of a chamber without heat through its walls is p' = gamma (R T m' - p V')/V (adiabatic; gamma = 1
for isothermal air: both are in the reference of MathWorks' Simscape, block Pneumatic Piston Chamber, and are the usual
models of chambers by Carneiro and de Almeida 2006, who find them coarse where air is exchanged fast). The valve has a
loop of its own, taken as sending mass so that the absolute pressure p nears the wanted one, p_w, with a time constant:

    p' = (p_w - p)/T - gamma p V'/V

With q = p V^gamma this is the constant-coefficient lag T q' + q = p_w V^gamma, whatever V does. Valid while p stays
above zero and the valve within its flow.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.lag import lagged

Floats = NDArray[np.float64]

ATMOSPHERE = 101325.0
"""Pa, at which gauge pressures are zero."""


@dataclass(frozen=True, slots=True)
class Chamber:
    """volume : at position zero (m^3). area : of the piston (m^2). exponent : gamma. time_constant : T (s)."""

    volume: float
    area: float
    exponent: float
    time_constant: float


def swelling(chamber: Chamber, position: Floats) -> Floats:
    """(V/V_0)^gamma at positions (m), positive where the piston has left the chamber's end further behind."""
    return np.asarray((1 + chamber.area / chamber.volume * position) ** chamber.exponent)


def pressures(chamber: Chamber, wanted: Floats, swell: Floats, step: float, start: float) -> Floats:
    """Gauge pressure (Pa) at the ends of the steps (s).

    wanted : (n,) gauge, mean over each step. swell : (n + 1,) by `swelling` at the steps' ends. start : gauge.
    """
    q = lagged(
        (wanted + ATMOSPHERE) * (swell[1:] + swell[:-1]) / 2,
        chamber.time_constant,
        step,
        (start + ATMOSPHERE) * swell[0],
    )
    return q / swell - ATMOSPHERE
