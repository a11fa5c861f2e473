"""Values typed for a FEMM model: a bare number in the file's unit, or a number with a unit."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from fluxbore.design.errors import SpecError, one_line, shown
from fluxbore.design.units import parse_quantity

LARGEST = 1e30
"""Of a value; what is beyond cannot be meant."""


@dataclass(frozen=True, slots=True)
class Value:
    """The quantity of a key. units : its own, which a value may carry, to SI; bare : of a number without one.

    dimension : of `design.units`, in place of units. least, most : SI.
    """

    dimension: str | None = None
    units: tuple[tuple[str, float], ...] = ()
    bare: float = 1.0
    least: float = -LARGEST
    most: float = LARGEST

    def read(self, key: str, text: str) -> float:
        """SI. Raises SpecError."""
        number = bare_number(text)
        if number is not None:
            value = number * self.bare
        elif self.dimension is not None:
            value = parse_quantity(text, self.dimension, key)
        else:
            value = self._with_unit(key, text.strip())
        if not self.least <= value <= self.most:
            limits = [f"at least {self.least:g}"] if self.least > -LARGEST else []
            limits += [f"at most {self.most:g}"] if self.most < LARGEST or not limits else []
            raise SpecError(f"{key} must be {' and '.join(limits)}; got {shown(text)}.")
        return value

    def _with_unit(self, key: str, text: str) -> float:
        for unit, factor in self.units:
            number = bare_number(text.removesuffix(unit)) if text.endswith(unit) else None
            if number is not None:
                return number * factor
        units = f", bare or in {' or '.join(unit for unit, _ in self.units)}" if self.units else ""
        raise SpecError(f"{key} must be a number{units}; got {shown(text)}.")


CURRENT = Value("current")
DEGREES = Value("angle")
FIELD = Value("field strength")
PLAIN = Value()
PERMEABILITY = Value(least=1e-6)
DENSITY = Value(units=(("MA/m^2", 1e6), ("A/mm^2", 1e6), ("A/m^2", 1.0)), bare=1e6)
CONDUCTIVITY = Value(units=(("MS/m", 1e6), ("S/m", 1.0)), bare=1e6, least=0.0)
FILL = Value(least=1e-6, most=1.0)


def bare_number(text: str) -> float | None:
    """A bare, finite number; None for anything else."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if isfinite(value) and "_" not in text else None


def spelt(key: str) -> str:
    """A key as a sentence can quote it."""
    return one_line(key if len(key) <= 80 else key[:77] + "...")
