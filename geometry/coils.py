"""A system of coaxial coils as parts: each winding a solid ring."""

from __future__ import annotations

from fluxbore.design.coils import CoilSystem
from fluxbore.design.spec import Spec
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Colour, Part

COLOURS: tuple[Colour, Colour] = ((0.80, 0.36, 0.20), (0.30, 0.56, 0.76))
"""Of windings with current along +phi, and against it."""


def assembly(spec: Spec, place: float = 0.5) -> Assembly:
    """The windings where they stand, each a solid ring; nothing moves, whatever the place in the stroke.

    Raises DesignError where they do not fit one another.
    """
    system: CoilSystem = spec.actuator
    return Assembly(
        system.name,
        tuple(
            Part(
                coil.name.replace("_", " "),
                "coil",
                "stator",
                system.conductor,
                COLOURS[coil.current_density < 0],
                rectangle(coil.inner_radius, coil.outer_radius, coil.lower, coil.upper),
                note=f"{coil.current_density / 1e6:.6g} A/mm² along +φ",
                fill=system.fill,
            )
            for coil in system.coils
        ),
        0.0,
    )
