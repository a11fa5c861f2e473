"""Quantities at the file's edge: ``"27 mm"`` becomes 0.027, and inside there are only SI floats.

A quantity is a string of one number and one unit of the closed table below. The table is closed on purpose: a sweep
that ran overnight because somebody's ``"0.4"`` was read as metres is worth more than the convenience of guessing.
Pressures say whether they are gauge or absolute and are kept as gauge pressure; temperatures are kept in kelvin.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from decimal import Decimal

from fluxbore.design.errors import SpecError, shown

STANDARD_ATMOSPHERE = 101_325.0
"""Pa, the difference between absolute and gauge pressure (ISO 2533, sea level)."""

ZERO_CELSIUS = 273.15
"""K, the temperature of 0 degC."""


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit as a straight line to SI: ``si = factor * number + offset``."""

    factor: float
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Dimension:
    """A physical dimension with its closed table of units.

    ``preferred`` is the unit of specification files and pictures; ``si`` names the unit of the stored float.
    """

    name: str
    si: str
    preferred: str
    units: dict[str, Unit]


def _scaled(**factors: float) -> dict[str, Unit]:
    return {name: Unit(factor) for name, factor in factors.items()}


def _pressures() -> dict[str, Unit]:
    sizes = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "bar": 1e5, "psi": 6894.757293168}
    gauge = {f"{name} gauge": Unit(factor) for name, factor in sizes.items()}
    absolute = {f"{name} absolute": Unit(factor, -STANDARD_ATMOSPHERE) for name, factor in sizes.items()}
    return gauge | absolute


def _pressure_differences() -> dict[str, Unit]:
    """A step of pressure is the same on both scales."""
    plain = {name.removesuffix(" gauge"): unit for name, unit in _pressures().items() if name.endswith(" gauge")}
    return plain | {name: Unit(unit.factor) for name, unit in _pressures().items()}


DIMENSIONS: dict[str, Dimension] = {
    dimension.name: dimension
    for dimension in (
        Dimension("length", "m", "mm", _scaled(mm=1e-3, um=1e-6, cm=1e-2, m=1.0) | {"in": Unit(0.0254)}),
        Dimension("area density", "1/m^2", "1/mm^2", {"1/mm^2": Unit(1e6), "1/cm^2": Unit(1e4), "1/m^2": Unit(1.0)}),
        Dimension("angle", "rad", "deg", _scaled(deg=math.pi / 180.0, rad=1.0)),
        Dimension("flux density", "T", "T", _scaled(T=1.0, mT=1e-3, uT=1e-6) | {"G": Unit(1e-4)}),
        Dimension("current", "A", "A", _scaled(A=1.0, mA=1e-3)),
        Dimension("pressure", "Pa gauge", "MPa gauge", _pressures()),
        Dimension("pressure difference", "Pa", "MPa", _pressure_differences()),
        Dimension("stress", "Pa", "MPa", _scaled(Pa=1.0, kPa=1e3, MPa=1e6, GPa=1e9)),
        Dimension(
            "temperature",
            "K",
            "degC",
            {
                "degC": Unit(1.0, ZERO_CELSIUS),
                "K": Unit(1.0),
                "degF": Unit(5.0 / 9.0, ZERO_CELSIUS - 32.0 * 5.0 / 9.0),
            },
        ),
        Dimension("temperature difference", "K", "K", {"K": Unit(1.0), "degC": Unit(1.0), "degF": Unit(5.0 / 9.0)}),
        Dimension("force", "N", "N", _scaled(N=1.0, kN=1e3, mN=1e-3)),
        Dimension("force constant", "N/A", "N/A", {"N/A": Unit(1.0)}),
        Dimension("motor constant", "N/sqrt(W)", "N/sqrt(W)", {"N/sqrt(W)": Unit(1.0)}),
        Dimension("mass", "kg", "g", _scaled(kg=1.0, g=1e-3)),
        Dimension("resistance", "ohm", "ohm", _scaled(ohm=1.0, mohm=1e-3)),
        Dimension(
            "current density",
            "A/m^2",
            "A/mm^2",
            {"A/mm^2": Unit(1e6), "A/cm^2": Unit(1e4), "A/m^2": Unit(1.0), "MA/m^2": Unit(1e6)},
        ),
        Dimension("energy", "J", "MJ", _scaled(J=1.0, kJ=1e3, MJ=1e6)),
        Dimension("work", "J", "J", _scaled(J=1.0, mJ=1e-3, kJ=1e3)),
        Dimension("electric loading", "A/m", "A/m", {"A/m": Unit(1.0), "kA/m": Unit(1e3), "A/mm": Unit(1e3)}),
        Dimension("time", "s", "s", _scaled(s=1.0, ms=1e-3, min=60.0, h=3600.0)),
        Dimension("volume", "m^3", "mm^3", {"mm^3": Unit(1e-9), "cm^3": Unit(1e-6), "m^3": Unit(1.0)}),
        Dimension("density", "kg/m^3", "g/cm^3", {"kg/m^3": Unit(1.0), "g/cm^3": Unit(1e3), "kg/dm^3": Unit(1e3)}),
        Dimension(
            "field strength",
            "A/m",
            "kA/m",
            {"A/m": Unit(1.0), "kA/m": Unit(1e3), "Oe": Unit(1e3 / (4 * math.pi)), "kOe": Unit(1e6 / (4 * math.pi))},
        ),
        Dimension(
            "resistivity",
            "ohm m",
            "ohm m",
            {"ohm m": Unit(1.0), "ohm mm^2/m": Unit(1e-6), "uohm cm": Unit(1e-8), "nohm m": Unit(1e-9)},
        ),
        Dimension("temperature coefficient", "1/K", "%/K", {"%/K": Unit(1e-2), "1/K": Unit(1.0)}),
        Dimension("speed", "m/s", "m/s", {"m/s": Unit(1.0), "mm/s": Unit(1e-3)}),
        Dimension("voltage", "V", "V", _scaled(V=1.0, mV=1e-3, kV=1e3)),
        Dimension("inductance", "H", "mH", _scaled(H=1.0, mH=1e-3, uH=1e-6)),
        Dimension("thermal conductivity", "W/(m K)", "W/(m K)", {"W/(m K)": Unit(1.0)}),
        Dimension("viscous friction", "N s/m", "N s/m", {"N s/m": Unit(1.0)}),
        Dimension("energy density", "J/m^3", "J/m^3", {"J/m^3": Unit(1.0), "kJ/m^3": Unit(1e3)}),
        Dimension("frequency", "Hz", "Hz", _scaled(Hz=1.0, kHz=1e3)),
        Dimension("area", "m^2", "mm^2", {"mm^2": Unit(1e-6), "cm^2": Unit(1e-4), "m^2": Unit(1.0)}),
        Dimension("stiffness", "N/m", "N/mm", {"N/mm": Unit(1e3), "N/m": Unit(1.0), "kN/m": Unit(1e3)}),
        Dimension("force density", "N/m^3", "kN/m^3", {"kN/m^3": Unit(1e3), "N/m^3": Unit(1.0)}),
        Dimension(
            "force constant density", "N/(A m^3)", "kN/(A m^3)", {"kN/(A m^3)": Unit(1e3), "N/(A m^3)": Unit(1.0)}
        ),
        Dimension(
            "volume flow",
            "m^3/s",
            "ml/min",
            {"ml/min": Unit(1e-6 / 60.0), "l/min": Unit(1e-3 / 60.0), "m^3/s": Unit(1.0)},
        ),
        Dimension("distance", "m", "km", {"km": Unit(1e3), "m": Unit(1.0)}),
        Dimension("wear rate", "m/m", "um/km", {"um/km": Unit(1e-9), "mm/km": Unit(1e-6), "m/m": Unit(1.0)}),
        Dimension("specific wear", "m^2/N", "mm^3/(N m)", {"mm^3/(N m)": Unit(1e-9), "m^2/N": Unit(1.0)}),
        Dimension("torque", "N m", "N m", {"N m": Unit(1.0), "mN m": Unit(1e-3)}),
        Dimension("torque constant", "N m/A", "N m/A", {"N m/A": Unit(1.0), "mN m/A": Unit(1e-3)}),
        Dimension("acceleration", "m/s^2", "m/s^2", {"m/s^2": Unit(1.0), "mm/s^2": Unit(1e-3)}),
        Dimension("rotational inertia", "kg m^2", "kg m^2", {"kg m^2": Unit(1.0), "g cm^2": Unit(1e-7)}),
        Dimension("angular frequency", "rad/s", "rad/s", {"rad/s": Unit(1.0), "rpm": Unit(math.tau / 60.0)}),
        Dimension("rate", "1/s", "1/s", {"1/s": Unit(1.0)}),
        Dimension("wave number", "1/m", "1/m", {"1/m": Unit(1.0), "1/mm": Unit(1e3)}),
        Dimension("transfer ratio", "rad/m", "rad/mm", {"rad/mm": Unit(1e3), "rad/m": Unit(1.0)}),
        Dimension("inverse speed", "s/m", "s/m", {"s/m": Unit(1.0)}),
        Dimension("speed gain", "A s/rad", "A s/rad", {"A s/rad": Unit(1.0)}),
        Dimension("shaft power", "W", "W", _scaled(W=1.0, mW=1e-3, kW=1e3)),
        Dimension("dynamic viscosity", "Pa s", "mPa s", {"mPa s": Unit(1e-3), "Pa s": Unit(1.0)}),
        Dimension("force per pressure", "N/Pa", "N/MPa", {"N/MPa": Unit(1e-6), "N/bar": Unit(1e-5), "N/Pa": Unit(1.0)}),
        Dimension("force gain", "m/(N s)", "mm/(N s)", {"mm/(N s)": Unit(1e-3), "m/(N s)": Unit(1.0)}),
        Dimension("force rate", "N/s", "N/s", {"N/s": Unit(1.0), "kN/s": Unit(1e3)}),
        Dimension("specific force", "N/kg", "N/kg", {"N/kg": Unit(1.0), "kN/kg": Unit(1e3)}),
        Dimension("linear mass", "kg/m", "g/m", {"g/m": Unit(1e-3), "kg/m": Unit(1.0)}),
        Dimension("heat capacity", "J/(kg K)", "J/(kg K)", {"J/(kg K)": Unit(1.0), "kJ/(kg K)": Unit(1e3)}),
    )
}
"""Every dimension a specification can hold, by name; their unit tables are all the units there are."""

DIFFERENCES = {"temperature": "temperature difference", "pressure": "pressure difference"}
"""The dimensions whose units have an offset, and the dimension of a difference between two such values."""

_SPACE = "[ \t\N{NO-BREAK SPACE}]"
"""What may stand around number and unit. Closed like the table of units, so that the JSON Schema means the same."""

_PLAIN_NUMBER = r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?"
_NUMBER = re.compile(_PLAIN_NUMBER)


def parse_quantity(text: object, dimension: str, key: str) -> float:
    """Read one number and one unit, ``"27 mm"``, and return the value in SI.

    text : what the file holds at ``key``; anything but such a string is an error.
    dimension : a name of `DIMENSIONS`.

    Raises SpecError with the key, the units that would do, and what was found.
    """
    table = DIMENSIONS[dimension]
    wanted = f"{with_article(dimension)}, one number and one unit of {_listing(table)}, such as {example(dimension)}"
    if not isinstance(text, str):
        found = f"the bare number {shown(text)}" if _is_number(text) else shown(text)
        raise SpecError(f"{key} must be {wanted}; got {found}.")
    bare = re.sub(f"{_SPACE}+", " ", text).strip(" ")
    match = _NUMBER.match(bare)
    if match is None:
        raise SpecError(f"{key} must be {wanted}; got {shown(text)}.")
    unit = bare[match.end() :].lstrip(" ")
    if unit not in table.units:
        missing = "without a unit" if not unit else f"with the unit {shown(unit)}"
        hint = ""
        if unit.startswith(","):
            missing, hint = "with a comma", " (the decimal sign is a point)"
        if dimension == "pressure" and f"{unit} gauge" in table.units:
            hint = f' (say "{unit} gauge" or "{unit} absolute")'
        raise SpecError(f"{key} must be {wanted}; got {shown(text)} {missing}{hint}.")
    scale = table.units[unit]
    # Decimal keeps "0.1 mm" at the float nearest to 1e-4: 0.1 * 1e-3 is one rounding away from it.
    try:
        value = float(Decimal(match.group()) * Decimal(repr(scale.factor))) + scale.offset
    except ArithmeticError:  # an exponent beyond what even decimals hold
        value = math.inf
    if not math.isfinite(value):
        raise SpecError(f"{key} must be a finite {dimension}; got {shown(text)}.")
    return value


def format_quantity(value: float, dimension: str, digits: int = 15) -> str:
    """Write an SI value in the dimension's preferred unit, with up to ``digits`` significant digits.

    Fifteen digits keep every decimal input as it was typed, and bring the value back to within one rounding.
    """
    table = DIMENSIONS[dimension]
    unit = table.units[table.preferred]
    return f"{(value - unit.offset) / unit.factor:.{digits}g} {table.preferred}"


def quantity_pattern(dimension: str) -> str:
    """The regular expression (ECMA 262) that a JSON Schema uses for this dimension."""
    units = "|".join(re.escape(unit).replace("\\ ", f"{_SPACE}+") for unit in DIMENSIONS[dimension].units)
    return f"^{_SPACE}*{_PLAIN_NUMBER}{_SPACE}*({units}){_SPACE}*$"


def example(dimension: str) -> str:
    """A quantity of this dimension as one would type it."""
    numbers = {"length": "27", "pressure": "0.6", "temperature": "20", "flux density": "1.4", "angle": "30"}
    return f'"{numbers.get(dimension, "1")} {DIMENSIONS[dimension].preferred}"'


def with_article(dimension: str) -> str:
    """ "a length", "an area density"."""
    return f"{'an' if dimension[0] in 'aeiou' else 'a'} {dimension}"


def _listing(table: Dimension) -> str:
    return ", ".join(table.units)


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
