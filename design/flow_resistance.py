"""Pressure drops of ports, fittings and hoses over the flow through them, laminar and turbulent.

    orifice   Q = C_d A sqrt(2/rho) dp/(dp^2 + p_cr^2)^(1/4),   p_cr = rho/2 (Re_cr nu/(C_d d))^2
    hose      dp = f L/d rho/2 (Q/A)^2,   f = 64/Re below Re = 2000,
              1/sqrt(f) = -1.8 lg(6.9/Re + (k/3.7 d)^1.11) above 4000, and between them on the straight line of f

The orifice's root is made linear below p_cr as the block Fixed Orifice of MathWorks' Simscape Fluids has it, with
Re_cr = 12 (Merritt 1967, sec. 3-4: C_d = 0.61 for a sharp edge, 0.8 and more where it is rounded); here it is solved
for the pressure, in closed form. The hose is Darcy's law with Haaland's friction factor (1983, J. Fluids Eng. 105(1),
89), within 2 % of Colebrook's for 4e3 < Re < 1e8; inlet lengths and bends are left out.

Both give R = dp/Q (Pa s/m^3), which never falls below that of laminar flow: flow times drop is a loss at any flow.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.errors import DesignError

LAMINAR, TURBULENT = 2000.0, 4000.0
"""Reynolds numbers between which a hose's friction factor is interpolated."""


@dataclass(frozen=True, slots=True)
class Orifice:
    """diameter (m), discharge coefficient, Reynolds number below which it is laminar; `count` of them in a row."""

    diameter: float
    discharge_coefficient: float = 0.7
    critical_reynolds: float = 12.0
    count: int = 1

    def __post_init__(self) -> None:
        if not (math.isfinite(self.diameter) and self.diameter > 0):
            raise DesignError(f"The diameter of an orifice must be finite and above 0 m; got {self.diameter:g} m.")
        if not 0 < self.discharge_coefficient <= 1:
            raise DesignError(
                f"The discharge coefficient of an orifice must be above 0 and at most 1; "
                f"got {self.discharge_coefficient:g}."
            )


def orifice_resistance(orifice: Orifice, flow: float, density: float, viscosity: float) -> float:
    """R (Pa s/m^3) at a flow (m^3/s) of either sign; density in kg/m^3, viscosity in Pa s."""
    C_d, area = orifice.discharge_coefficient, math.pi / 4 * orifice.diameter**2
    k = density / (2 * (C_d * area) ** 2)
    critical = density / 2 * (orifice.critical_reynolds * viscosity / density / (C_d * orifice.diameter)) ** 2
    turbulent = (k * flow) ** 2
    return orifice.count * math.sqrt((turbulent + math.sqrt(turbulent**2 + (2 * k * critical) ** 2)) / 2)


def friction_factor(reynolds: float, roughness: float) -> float:
    """Darcy's f of a round hose at a Reynolds number above zero; roughness over its bore."""
    if reynolds <= LAMINAR:
        return 64 / reynolds
    turbulent = _haaland(max(reynolds, TURBULENT), roughness)
    share = min((reynolds - LAMINAR) / (TURBULENT - LAMINAR), 1.0)
    return 64 / LAMINAR + share * (turbulent - 64 / LAMINAR)


def hose_resistance(
    bore: float, length: float, roughness: float, flow: float, density: float, viscosity: float
) -> float:
    """R (Pa s/m^3) of a hose of bore, length and roughness (m) at a flow (m^3/s) of either sign."""
    reynolds = 4 * density * abs(flow) / (math.pi * bore * viscosity)
    if reynolds <= LAMINAR:
        return 128 * viscosity * length / (math.pi * bore**4)
    area = math.pi / 4 * bore**2
    return friction_factor(reynolds, roughness / bore) * length / bore * density / 2 * abs(flow) / area**2


def _haaland(reynolds: float, roughness: float) -> float:
    return (1.8 * math.log10(6.9 / reynolds + (roughness / 3.7) ** 1.11)) ** -2
