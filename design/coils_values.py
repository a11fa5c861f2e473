"""From a specification's values to a system of coils.

Plain arithmetic, no conversions: values may be complex, so that a step along the imaginary axis gives exact
derivatives of all that follows (`fluxbore.optimize.coils_figures`).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fluxbore.design.coils import Coil, CoilSystem
from fluxbore.design.coils_keys import COIL_NAMES
from fluxbore.design.errors import SpecError
from fluxbore.design.keys import Value, Values

_TOGETHER = (
    ("operating_point.line_radius", "operating_point.line_height"),
    ("operating_point.critical_current_density", "operating_point.critical_flux_density"),
)
"""Keys that say something only in pairs."""


def resolve(given: Values) -> dict[str, Value]:
    """Complete the given keys: the third of each winding's mean radius, inner radius and thickness, its place.

    Raises nothing; what is missing is `check`'s.
    """
    values: dict[str, Any] = dict(given)
    for name in present(given):
        section = f"actuator.{name}."
        values.setdefault(section + "position", 0.0)
        radius, inner, thickness = (values.get(section + leaf) for leaf in ("radius", "inner_radius", "thickness"))
        if inner is None and radius is not None and thickness is not None:
            values[section + "inner_radius"] = radius - thickness / 2
        elif radius is None and inner is not None and thickness is not None:
            values[section + "radius"] = inner + thickness / 2
        elif thickness is None and inner is not None and radius is not None:
            values[section + "thickness"] = 2 * (radius - inner)
    return values


def present(given: Values) -> tuple[str, ...]:
    """The windings that there are: those of which a key is given."""
    return tuple(name for name in COIL_NAMES if any(key.startswith(f"actuator.{name}.") for key in given))


def check(values: Values) -> None:
    """Raise SpecError where a winding is given in part or one of a pair of keys is missing."""
    for name in present(values):
        for leaf in ("half_height", "current_density"):
            if f"actuator.{name}.{leaf}" not in values:
                raise SpecError(f"actuator.{name}.{leaf} is missing: actuator.{name} must be given whole.")
    for pair in _TOGETHER:
        given = [key for key in pair if key in values]
        if len(given) == 1:
            missing = next(key for key in pair if key not in values)
            raise SpecError(f"{missing} must be given where {given[0]} is; got none.")


def from_values(values: Values) -> CoilSystem:
    """The coils that these resolved values describe, checked.

    Raises SpecError where a key is missing and DesignError where the coils cannot be built.
    """
    check(values)
    system = CoilSystem(
        str(values["actuator.name"]),
        str(values["actuator.conductor"]),
        float(values["actuator.fill"]),
        windings(values),
    )
    system.check()
    return system


def windings(values: Mapping[str, Any]) -> tuple[Coil, ...]:
    """The coils as they follow from resolved values, real or complex, unchecked."""
    return tuple(_winding(values, name) for name in present(values))


def _winding(values: Mapping[str, Any], name: str) -> Coil:
    inner, radius, thickness, half, middle, density = (
        values[f"actuator.{name}.{leaf}"]
        for leaf in ("inner_radius", "radius", "thickness", "half_height", "position", "current_density")
    )
    return Coil(name, inner, radius + thickness / 2, middle - half, middle + half, density)
