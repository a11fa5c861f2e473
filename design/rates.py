"""Derivatives in the units that people think in: what a millimetre more does, in newtons per ampere."""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.keys import Key
from fluxbore.design.performance import FIGURES, HEAVY, SMALL_FIELD
from fluxbore.design.units import DIFFERENCES, DIMENSIONS


@dataclass(frozen=True, slots=True)
class Measure:
    """A unit for differences of a quantity: ``factor`` of them make one of SI; ``unit`` is empty for plain numbers."""

    factor: float
    unit: str

    def show(self, value: float, digits: int = 4) -> str:
        """A difference given in SI."""
        return f"{value / self.factor:.{digits}g}{' ' if self.unit else ''}{self.unit}"


_PLAIN = {"fraction": Measure(0.01, "%"), "power": Measure(1.0, "W")}


def measure(dimension: str, size: float = 1.0) -> Measure:
    """The preferred unit for differences of this dimension; by ``size`` (SI) mT for weak fields, kg for big masses."""
    name = DIFFERENCES.get(dimension, dimension)
    if name == "flux density" and abs(size) < SMALL_FIELD:
        return Measure(DIMENSIONS[name].units["mT"].factor, "mT")
    if name == "mass" and abs(size) >= HEAVY:
        return Measure(1.0, "kg")
    if name not in DIMENSIONS:
        return _PLAIN.get(name, Measure(1.0, ""))
    table = DIMENSIONS[name]
    return Measure(table.units[table.preferred].factor, table.preferred)


def measure_of_key(key: Key) -> Measure:
    """The preferred unit for steps of a key's value."""
    return measure(key.dimension) if key.kind == "quantity" else Measure(1.0, "")


def measure_of_figure(name: str, size: float = 1.0) -> Measure:
    """The preferred unit for differences of a figure."""
    return measure(FIGURES[name].dimension, size)


def show_rate(figure: str, key: Key, derivative: float, digits: int = 4) -> str:
    """The derivative (SI) of a figure by a key: ``-0.3021 N/A per mm``."""
    step = measure_of_key(key)
    change = derivative * step.factor
    unit = measure_of_figure(figure, change if change else 1.0)
    return f"{change / unit.factor:+.{digits}g} {unit.unit}".rstrip() + f" per {step.unit or 'unit'}"


def handy_step(size: float, unit: Measure) -> float:
    """A power of ten of the unit, in SI, that is a tenth of ``size`` (SI) or a little less; of nothing, the unit."""
    if size == 0 or not math.isfinite(size):
        return unit.factor
    exponent = math.floor(math.log10(abs(size) / unit.factor / 10) + 1e-9)
    return unit.factor * float(f"1e{exponent}")
