"""The hybrid actuator's figures that need no field, and what its reader must be warned of."""

from __future__ import annotations

from fluxbore.design import pneumatics, winding
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Conductor, PermanentMagnet, lookup
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.design.units import format_quantity
from fluxbore.geometry.hybrid_parts import assembly
from fluxbore.geometry.mass import envelope, part_masses, total

NOTABLE_FRACTION = 0.01
"""Of the magnets' volume; the field at their sharp edges against the rings always takes a little less than that."""


def common_figures(spec: Spec, actuator: HybridActuator) -> Performance:
    """The figures that need no field."""
    conductor = lookup(actuator.winding.material, "actuator.winding.material", spec.materials, Conductor)
    resistance = winding.resistance(actuator, conductor, spec.number("operating_point.winding_temperature"))
    pressure = spec.number("operating_point.pressure")
    current = spec.number("operating_point.current")
    parts = assembly(actuator, actuator.mid_stroke)
    masses = part_masses(parts, spec.materials)
    outer_diameter, length = envelope(parts)
    return Performance(
        winding_resistance=resistance,
        turns=actuator.winding.turns,
        pneumatic_force_advance=pneumatics.advance_force(actuator, pressure),
        pneumatic_force_retract=pneumatics.retract_force(actuator, pressure),
        moving_mass=total(masses, "mover"),
        total_mass=total(masses),
        electric_loading=winding.electric_loading(actuator, current),
        copper_loss=winding.copper_loss(resistance, current),
        outer_diameter=outer_diameter,
        length=length,
    )


def warnings(spec: Spec, performance: Performance) -> tuple[str, ...]:
    """What a sound field does not say by itself: magnets beyond their temperature or their coercivity."""
    actuator: HybridActuator = spec.actuator
    grade = lookup(actuator.mover.magnet, "actuator.mover.magnet", spec.materials, PermanentMagnet)
    temperature = spec.number("operating_point.magnet_temperature")
    found = []
    if grade.working_temperature is not None and temperature > grade.working_temperature:
        found.append(
            f"operating_point.magnet_temperature should not exceed the working temperature of {grade.name}, "
            f"{format_quantity(grade.working_temperature, 'temperature', 4)}; it is "
            f"{format_quantity(temperature, 'temperature', 4)}."
        )
    fraction = performance.demagnetised_fraction
    if fraction is not None and fraction > NOTABLE_FRACTION:
        found.append(
            f"At this temperature {fraction:.1%} of the magnets' volume is beyond its intrinsic coercivity at no "
            "current; the figures take it as still magnetised."
        )
    return tuple(found)
