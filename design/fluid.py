"""A hydraulic fluid with air entrained in it: density, compressibility and energy over pressure, viscosity over heat.

Per volume at the atmosphere's pressure P_0 the mixture takes up, at the absolute pressure P,

    s(P)  = (1 - a) (1 + m (P - P_0)/B_0)^(-1/m) + a (P_0/P)^(1/n),     beta = -s/s'

a : volume share of free air at P_0. B_0, m : the liquid's bulk modulus at P_0 and its rise with pressure (Murnaghan
1944, Proc. Natl. Acad. Sci. 30, 244). n : the polytropic exponent of the air, 1 isothermal to 1.4 adiabatic. The sum
of a liquid and a gas at one pressure is the usual lumped model (Merritt 1967, Hydraulic Control Systems, sec. 2-3, for
a constant B; compression without dissolution in Gholizadeh, Burton and Schoenau 2011, Int. J. Fluid Power 12(3)): air
that goes into solution as pressure rises is left out, which errs to the soft side above some 10 bar.

The flow of energy with a fluid that gives is not pressure times volume flow. Counted in volume q at P_0 it is e q, with

    e(p) = int_0^p s dp',     u(p) = e - p s                                            (p = P - P_0, gauge)

the enthalpy and the stored energy per volume at P_0, both without the work on the atmosphere; e = p (1 - p/2 beta) to
first order. With these, what enters a chamber less what its piston takes is what it stores, without error.

Viscosity falls as Andrade's law, mu = mu_r exp(B (1/T - 1/T_r)), through two given points; within a tenth between them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from fluxbore.design.errors import DesignError
from fluxbore.design.units import STANDARD_ATMOSPHERE, format_quantity

LARGEST_EXPONENT = 500.0
"""Of Andrade's law; far beyond any fluid, and below what a number holds."""


@dataclass(frozen=True, slots=True)
class Fluid:
    """SI units; temperatures in K. Raises DesignError for a datum out of its range.

    density : of the liquid at the atmosphere's pressure and `reference_temperature` (kg/m^3). expansion : its cubic
    expansion (1/K). bulk_modulus, modulus_rise : B_0 (Pa) and m. air_fraction, air_exponent : a and n. viscosity,
    hot_viscosity : Pa s at `reference_temperature` and `hot_temperature`. vapour_pressure : absolute (Pa).
    heat_capacity : J/(kg K).
    """

    density: float
    bulk_modulus: float
    viscosity: float
    hot_viscosity: float
    reference_temperature: float = 293.15
    hot_temperature: float = 333.15
    modulus_rise: float = 6.0
    air_fraction: float = 0.0
    air_exponent: float = 1.4
    expansion: float = 0.0
    vapour_pressure: float = 2.3e3
    heat_capacity: float = 3.4e3

    def __post_init__(self) -> None:
        for name in ("density", "bulk_modulus", "viscosity", "hot_viscosity", "heat_capacity"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise DesignError(f"actuator.fluid.{name} must be finite and above 0; got {value:g}.")
        for name, low, high in (
            ("air_fraction", 0.0, 0.5),
            ("air_exponent", 1.0, 1.67),
            ("modulus_rise", 1.5, 30.0),
            ("vapour_pressure", 0.0, STANDARD_ATMOSPHERE),
            ("expansion", 0.0, 0.01),
        ):
            value = getattr(self, name)
            if not low <= value <= high:
                raise DesignError(f"actuator.fluid.{name} must be from {low:g} to {high:g}; got {value:g}.")
        if not self.hot_temperature > self.reference_temperature > 0:
            raise DesignError(
                "actuator.fluid.hot_temperature must exceed actuator.fluid.reference_temperature "
                f"{format_quantity(self.reference_temperature, 'temperature')}; "
                f"got {format_quantity(self.hot_temperature, 'temperature')}."
            )


def volume_ratio(fluid: Fluid, pressure: Any) -> Any:
    """s, at a gauge pressure (Pa), number or array."""
    return _liquid(fluid, pressure) + _gas(fluid, pressure)


def bulk_modulus(fluid: Fluid, pressure: Any) -> Any:
    """beta (Pa) of the mixture at a gauge pressure (Pa): the tangent, not the secant."""
    liquid, gas = _liquid(fluid, pressure), _gas(fluid, pressure)
    stiff = fluid.bulk_modulus + fluid.modulus_rise * pressure
    return (liquid + gas) / (liquid / stiff + gas / (fluid.air_exponent * (pressure + STANDARD_ATMOSPHERE)))


def specific_enthalpy(fluid: Fluid, pressure: Any) -> Any:
    """e (J per m^3 at the atmosphere's pressure) at a gauge pressure (Pa)."""
    m, modulus, n = fluid.modulus_rise, fluid.bulk_modulus, fluid.air_exponent
    base = 1 + m * pressure / modulus
    liquid = (1 - fluid.air_fraction) * modulus / (m - 1) * (base ** ((m - 1) / m) - 1)
    absolute = pressure / STANDARD_ATMOSPHERE + 1
    gas = _log(absolute) if n == 1 else n / (n - 1) * (absolute ** ((n - 1) / n) - 1)
    return liquid + fluid.air_fraction * STANDARD_ATMOSPHERE * gas


def _log(ratio: Any) -> Any:
    """Of a number or an array; specifications are read with this module, and must not wait for numpy."""
    import numpy as np

    return np.log(ratio)


def stored_energy(fluid: Fluid, pressure: Any) -> Any:
    """u (J per m^3 at the atmosphere's pressure) at a gauge pressure (Pa), zero at the atmosphere's."""
    return specific_enthalpy(fluid, pressure) - pressure * volume_ratio(fluid, pressure)


@dataclass(frozen=True, slots=True, eq=False)
class FluidState:
    """At gauge pressures: s, e (J/m^3 at the atmosphere's pressure) and beta (Pa)."""

    ratio: Any
    enthalpy: Any
    modulus: Any


def state_of(fluid: Fluid, pressure: Any) -> FluidState:
    """`volume_ratio`, `specific_enthalpy` and `bulk_modulus` at once, for a loop that asks for all of them."""
    m, modulus, n, share = fluid.modulus_rise, fluid.bulk_modulus, fluid.air_exponent, fluid.air_fraction
    base, absolute = 1 + m / modulus * pressure, pressure / STANDARD_ATMOSPHERE + 1
    liquid, gas = (1 - share) * base ** (-1 / m), share * absolute ** (-1 / n)
    ratio = liquid + gas
    enthalpy = modulus / (m - 1) * (base * liquid - (1 - share))
    if n == 1:
        enthalpy = enthalpy + share * STANDARD_ATMOSPHERE * _log(absolute)
    else:
        enthalpy = enthalpy + STANDARD_ATMOSPHERE * n / (n - 1) * (absolute * gas - share)
    give = liquid / (modulus * base) + gas / (n * STANDARD_ATMOSPHERE * absolute)
    return FluidState(ratio, enthalpy, ratio / give)


def viscosity(fluid: Fluid, temperature: Any) -> Any:
    """mu (Pa s) at a temperature (K). Raises DesignError where the law has no number for it."""
    import numpy as np

    cold, hot = fluid.reference_temperature, fluid.hot_temperature
    slope = math.log(fluid.viscosity / fluid.hot_viscosity) / (1 / cold - 1 / hot)
    rise = slope * (1 / np.asarray(temperature) - 1 / cold)
    if not np.all(rise < LARGEST_EXPONENT):
        raise DesignError(
            "operating_point.temperature must leave the fluid a viscosity in numbers; "
            f"got {format_quantity(float(np.min(temperature)), 'temperature', 4)}."
        )
    return fluid.viscosity * np.exp(rise)


def density(fluid: Fluid, temperature: float, pressure: Any = 0.0) -> Any:
    """Of the mixture (kg/m^3), the air's own mass left out, at a temperature (K) and a gauge pressure (Pa)."""
    liquid = fluid.density / (1 + fluid.expansion * (temperature - fluid.reference_temperature))
    return liquid * (1 - fluid.air_fraction) / volume_ratio(fluid, pressure)


def check_cavitation(fluid: Fluid, pressure: float, where: str) -> None:
    """Raise DesignError where a gauge pressure (Pa) of this name is below that of the vapour."""
    limit = fluid.vapour_pressure - STANDARD_ATMOSPHERE
    if not pressure >= limit:
        raise DesignError(
            f"{where} must not fall below the fluid's vapour pressure, {format_quantity(limit, 'pressure', 4)}; "
            f"got {format_quantity(pressure, 'pressure', 4)}."
        )


def _liquid(fluid: Fluid, pressure: Any) -> Any:
    m = fluid.modulus_rise
    return (1 - fluid.air_fraction) * (1 + m * pressure / fluid.bulk_modulus) ** (-1 / m)


def _gas(fluid: Fluid, pressure: Any) -> Any:
    return fluid.air_fraction * (pressure / STANDARD_ATMOSPHERE + 1) ** (-1 / fluid.air_exponent)
