"""Heat that a surface in still air gives off: natural convection around a horizontal cylinder, and radiation.

    Nu = (0.60 + 0.387 Ra^(1/6) / (1 + (0.559/Pr)^(9/16))^(8/27))^2         Ra <= 1e12

Churchill and Chu (1975), Int. J. Heat Mass Transfer 18, 1049; the measurements behind it scatter by about 15 %.
Properties at the mean of surface and air. Dry air at one atmosphere: viscosity and conductivity by Sutherland's formula
(White, Viscous Fluid Flow, 2nd ed., tables 1-2 and 1-3), good to some per cent from 200 to 1500 K.
"""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.units import STANDARD_ATMOSPHERE

GRAVITY = 9.80665
"""m/s^2."""

GAS_CONSTANT = 287.05
"""J/(kg K) of dry air."""

HEAT_CAPACITY = 1006.0
"""J/(kg K) of air at constant pressure near room temperature; 1 % more at 400 K."""

STEFAN_BOLTZMANN = 5.670374419e-8
"""W/(m^2 K^4), CODATA 2018."""


@dataclass(frozen=True, slots=True)
class Air:
    """Dry air at one atmosphere: W/(m K), m^2/s, and Prandtl's number."""

    conductivity: float
    kinematic_viscosity: float
    prandtl: float


def air(temperature: float) -> Air:
    """Air at a temperature (K)."""
    ratio = temperature / 273.0
    viscosity = 1.716e-5 * ratio**1.5 * (273.0 + 111.0) / (temperature + 111.0)
    conductivity = 0.0241 * ratio**1.5 * (273.0 + 194.0) / (temperature + 194.0)
    density = STANDARD_ATMOSPHERE / (GAS_CONSTANT * temperature)
    return Air(conductivity, viscosity / density, viscosity * HEAT_CAPACITY / conductivity)


def nusselt(rayleigh: float, prandtl: float) -> float:
    """Mean Nusselt number of a horizontal cylinder, by its diameter."""
    return float((0.60 + 0.387 * rayleigh ** (1 / 6) / (1 + (0.559 / prandtl) ** (9 / 16)) ** (8 / 27)) ** 2)


def heat_transfer(diameter: float, surface: float, ambient: float, emissivity: float) -> float:
    """Heat given off by area and difference of temperature (W/(m^2 K)).

    diameter : of the horizontal cylinder (m). surface, ambient : K. emissivity : grey, towards walls at the ambient's
    temperature.
    """
    film = (surface + ambient) / 2
    gas = air(film)
    rayleigh = GRAVITY * abs(surface - ambient) / film * diameter**3 / gas.kinematic_viscosity**2 * gas.prandtl
    radiation = emissivity * STEFAN_BOLTZMANN * (surface**2 + ambient**2) * (surface + ambient)
    return gas.conductivity / diameter * nusselt(rayleigh, gas.prandtl) + radiation
