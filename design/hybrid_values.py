"""From a specification's values to the hybrid actuator's parameters."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any, TypeVar

from fluxbore.design.air_ports import AIR_PORTS
from fluxbore.design.errors import SpecError
from fluxbore.design.hybrid import (
    PHASES,
    BackYoke,
    Cylinder,
    EndCaps,
    HybridActuator,
    Mover,
    Piston,
    Shaft,
    Winding,
)
from fluxbore.design.keys import Value, Values
from fluxbore.design.units import format_quantity

_Part = TypeVar("_Part", BackYoke, Winding, Cylinder, Mover, Shaft, Piston, EndCaps)

ENAMELLED = 1.1
"""Diameter of an enamelled wire over the bare one: 0.439 mm of 0.4 mm, grade 1 of IEC 60317-0-1; thicker wires less."""

ROUNDING = 1e-9
"""m; a position this far beyond the stroke's end is the end."""


def resolve(given: Values) -> dict[str, Value]:
    """Complete the given keys by those that follow from them, so that every key of the table has a value.

    The degrees of freedom of the table's `Alternatives`: two of the yoke's three radial dimensions, two of its three
    axial ones, one of each other pair; a port's thread sets its bore. Raises nothing: what cannot be built
    is refused by `HybridActuator.check`.
    """
    values = dict(given)

    def number(key: str) -> float:
        return float(values[key])

    yoke, winding, mover = "actuator.back_yoke.", "actuator.winding.", "actuator.mover."
    if yoke + "outer_diameter" not in values:
        values[yoke + "outer_diameter"] = number(yoke + "inner_diameter") + 2 * number(yoke + "thickness")
    elif yoke + "inner_diameter" not in values:
        values[yoke + "inner_diameter"] = number(yoke + "outer_diameter") - 2 * number(yoke + "thickness")
    else:
        values[yoke + "thickness"] = (number(yoke + "outer_diameter") - number(yoke + "inner_diameter")) / 2

    if mover + "ring_width" not in values:
        values[mover + "ring_width"] = number(mover + "pole_pitch") - number(mover + "magnet_thickness")
    else:
        values[mover + "magnet_thickness"] = number(mover + "pole_pitch") - number(mover + "ring_width")

    coil_width = 2 * number(mover + "pole_pitch") / 3
    wound = len(PHASES) * number(winding + "sets_per_phase") * coil_width
    if yoke + "length" not in values:
        values[yoke + "length"] = wound + number(yoke + "front_overhang") + number(yoke + "back_overhang")
    elif yoke + "front_overhang" not in values:
        values[yoke + "front_overhang"] = number(yoke + "length") - wound - number(yoke + "back_overhang")
    else:
        values[yoke + "back_overhang"] = number(yoke + "length") - wound - number(yoke + "front_overhang")

    if winding + "outer_diameter" not in values:
        values[winding + "outer_diameter"] = number(yoke + "inner_diameter") - 2 * number(winding + "yoke_clearance")
    else:
        values[winding + "yoke_clearance"] = (number(yoke + "inner_diameter") - number(winding + "outer_diameter")) / 2

    window = coil_width * (number(winding + "outer_diameter") - number("actuator.cylinder.outer_diameter")) / 2
    room = number(winding + "sets_per_phase") * window
    if winding + "turns" not in values:
        values[winding + "turns"] = number(winding + "turns_density") * room
    else:
        values[winding + "turns_density"] = number(winding + "turns") / room if room > 0 else math.inf
    values.setdefault(winding + "insulated_diameter", ENAMELLED * number(winding + "wire_diameter"))
    caps = "actuator.end_caps."
    if caps + "port_thread" in values:
        values[caps + "port_diameter"] = AIR_PORTS[str(values[caps + "port_thread"])].flow
    if "actuator.piston.material" in values:
        values.setdefault("actuator.piston.fin_material", values["actuator.piston.material"])
    values.setdefault("operating_point.peak_current", number("operating_point.current"))
    return values


def from_values(values: Values) -> HybridActuator:
    """The actuator that these resolved values describe, checked.

    Raises DesignError where it cannot be built.
    """

    def part(kind: type[_Part], section: str) -> _Part:
        """A dataclass from the keys of its fields' names; one that is absent is an optional one."""
        given: dict[str, Any] = {field.name: values.get(f"actuator.{section}.{field.name}") for field in fields(kind)}
        return kind(**given)

    actuator = HybridActuator(
        name=str(values["actuator.name"]),
        back_yoke=part(BackYoke, "back_yoke"),
        winding=part(Winding, "winding"),
        cylinder=part(Cylinder, "cylinder"),
        mover=part(Mover, "mover"),
        shaft=part(Shaft, "shaft"),
        piston=part(Piston, "piston"),
        end_caps=part(EndCaps, "end_caps"),
    )
    actuator.check()
    return actuator


def check_window(values: Values) -> None:
    """Raise SpecError where the window of positions leaves the stroke or runs backwards, or the operating point
    contradicts itself."""
    actuator = from_values(values)
    _check_operating_point(values)
    low = actuator.mid_stroke - actuator.mover.stroke / 2
    high = actuator.mid_stroke + actuator.mover.stroke / 2

    def shown(length: float) -> str:
        return format_quantity(length, "length", 6)

    first, last = (float(values[f"operating_point.{name}_position"]) for name in ("first", "last"))
    for name, value in (("first", first), ("last", last)):
        if not low - ROUNDING <= value <= high + ROUNDING:
            raise SpecError(
                f"operating_point.{name}_position must lie within the stroke, {shown(low)} to {shown(high)}; "
                f"got {shown(value)}."
            )
    if last < first:
        raise SpecError(
            f"operating_point.last_position must not be below operating_point.first_position {shown(first)}; "
            f"got {shown(last)}."
        )


def positions(values: Values) -> tuple[float, ...]:
    """The window of positions (m) over which figures are averaged, both ends included."""
    first, last = (float(values[f"operating_point.{name}_position"]) for name in ("first", "last"))
    count = int(values["operating_point.positions"])
    if count == 1:
        return ((first + last) / 2,)
    return tuple(first + (last - first) * i / (count - 1) for i in range(count))


def _check_operating_point(values: Values) -> None:
    """Raise SpecError where a smaller value must not exceed a larger one and does."""
    for small, large, dimension in (
        ("operating_point.current", "operating_point.peak_current", "current"),
        ("operating_point.ambient_temperature", "operating_point.winding_temperature_limit", "temperature"),
        ("operating_point.coldest_temperature", "operating_point.hottest_temperature", "temperature"),
        ("actuator.winding.wire_diameter", "actuator.winding.insulated_diameter", "length"),
    ):
        least, value = float(values[small]), float(values[large])
        if value < least:
            raise SpecError(
                f"{large} must not be below {small} {format_quantity(least, dimension, 6)}; "
                f"got {format_quantity(value, dimension, 6)}."
            )
