"""The hybrid actuator's figures that need no field of their own, and what its reader must be warned of.

`common_figures` needs nothing but the specification. `derived` takes what a route's field gave and adds what follows
from it in closed form; both routes call it last.
"""

from __future__ import annotations

from dataclasses import replace

from fluxbore.design import (
    column,
    drive,
    inductance,
    losses,
    manufacture,
    pneumatics,
    pressure_vessel,
    thermal,
    thrust_density,
    winding,
)
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Conductor, Material, PermanentMagnet, lookup
from fluxbore.design.performance import Performance
from fluxbore.design.pressure_vessel import UNLOADED
from fluxbore.design.spec import Spec
from fluxbore.design.units import format_quantity
from fluxbore.geometry.hybrid_parts import assembly
from fluxbore.geometry.mass import envelope, part_masses, total
from fluxbore.optimize import hybrid_caps, hybrid_seal
from fluxbore.optimize.hybrid_gaps import gaps

NOTABLE_FRACTION = 0.01
"""Of the magnets' volume; the field at their sharp edges against the rings always takes a little less than that."""

THIN = 3.0
"""Skin depths must exceed a wall by this factor for its eddy currents to leave the field nearly as it is."""


def common_figures(spec: Spec, actuator: HybridActuator) -> Performance:
    """The figures that need no field; the inductance is that of a sheet beneath an ideal yoke, until a field replaces
    it."""
    resistance = winding.resistance(
        actuator, _conductor(spec, actuator), spec.number("operating_point.winding_temperature")
    )
    pressure = spec.number("operating_point.pressure")
    current = spec.number("operating_point.current")
    parts = assembly(actuator, actuator.mid_stroke)
    masses = part_masses(parts, spec.materials)
    outer_diameter, length = envelope(parts)
    clearance = (actuator.cylinder.inner_diameter - actuator.mover.outer_diameter) / 2
    vessel = pressure_vessel.vessel(
        actuator.cylinder,
        _material(spec, "actuator.cylinder.material"),
        pressure,
        closed=spec.word("actuator.cylinder.ends") == "closed",
    )
    wire = spec.number("actuator.winding.insulated_diameter")
    return Performance(
        winding_resistance=resistance,
        turns=actuator.winding.turns,
        phase_inductance=inductance.phase_inductance(actuator),
        pneumatic_force_advance=pneumatics.advance_force(actuator, pressure),
        pneumatic_force_retract=pneumatics.retract_force(actuator, pressure),
        moving_mass=total(masses, "mover"),
        total_mass=total(masses),
        electric_loading=winding.electric_loading(actuator, current),
        copper_loss=winding.copper_loss(resistance, current),
        hoop_stress=vessel.hoop_stress,
        cylinder_safety=vessel.safety,
        cap_safety=hybrid_caps.safety(spec, actuator),
        bore_dilation=vessel.dilation,
        bore_clearance=None if vessel.dilation is None else clearance + vessel.dilation,
        buckling_force=column.critical_force(
            actuator, _material(spec, "actuator.shaft.material"), spec.word("actuator.shaft.ends")
        ),
        fill_factor=winding.copper_fill(actuator),
        winding_layers=manufacture.winding_layers(actuator, wire),
        winding_room=manufacture.winding_room(actuator, wire),
        yoke_wall=actuator.back_yoke.thickness,
        cylinder_wall=(actuator.cylinder.outer_diameter - actuator.cylinder.inner_diameter) / 2,
        magnet_wall=(actuator.mover.outer_diameter - actuator.shaft.outer_diameter) / 2,
        outer_diameter=outer_diameter,
        length=length,
        **hybrid_seal.figures(spec, actuator),
    )


def derived(spec: Spec, performance: Performance) -> Performance:
    """The figures with those that follow from the field's: drive, thrust, losses, heat and the rod's load.

    performance : `common_figures` and what the route's field gave, of which force_constant, gap_flux_density,
    yoke_flux_density, phase_inductance and peak_force are read. Without a peak force the force constant stands for it;
    without a force constant nothing follows.

    Closed forms, smooth in the specification's values and in the figures read, to rounding; about a millisecond.
    """
    if performance.force_constant is None:
        return performance
    return _dense(spec, _loaded(spec, _heated(spec, _driven(spec, performance))))


def _driven(spec: Spec, performance: Performance) -> Performance:
    """With what the drive sees."""
    constant, resistance = performance.force_constant, performance.winding_resistance
    assert constant is not None
    assert resistance is not None
    pitch = spec.number("actuator.mover.pole_pitch")
    inductance = performance.phase_inductance or 0.0
    current, speed, peak = (spec.number(f"operating_point.{name}") for name in ("current", "speed", "peak_current"))
    demand = drive.voltage_demand(constant, resistance, inductance, pitch, current, speed)
    straight = constant * peak
    performance = replace(
        performance,
        back_emf=drive.back_emf(constant, speed),
        voltage_demand=demand,
        saturation_ratio=performance.peak_force / straight if performance.peak_force is not None and straight else None,
        motor_constant=winding.motor_constant(constant, resistance),
    )
    if "operating_point.supply_voltage" not in spec.values:
        return performance
    voltage = drive.phase_voltage(spec.number("operating_point.supply_voltage"))
    return replace(
        performance,
        voltage_margin=voltage - demand,
        no_load_speed=drive.speed_limit(constant, resistance, 0.0, pitch, 0.0, voltage),
        speed_limit=drive.speed_limit(constant, resistance, inductance, pitch, current, voltage),
    )


def _heated(spec: Spec, performance: Performance) -> Performance:
    """With losses and temperatures. A loss whose material data are missing is not given, and heats nothing."""
    actuator: HybridActuator = spec.actuator
    conductor, tube = _conductor(spec, actuator), _material(spec, "actuator.cylinder.material")
    speed = spec.number("operating_point.speed")
    wall = yoke = None
    if performance.gap_flux_density is not None and tube.resistivity is not None:
        wall = losses.wall_drag(actuator, tube.resistivity, performance.gap_flux_density) * speed
    if performance.yoke_flux_density is not None:
        iron = losses.yoke_drag(actuator, _material(spec, "actuator.back_yoke.material"), performance.yoke_flux_density)
        yoke = None if iron is None else iron[0] + iron[1] * speed
    drags = [drag for drag in (wall, yoke) if drag is not None]
    net = thermal.network(
        actuator,
        conductor,
        tube,
        insulation_conductivity=spec.number("actuator.winding.insulation_conductivity"),
        emissivity=spec.number("actuator.back_yoke.emissivity"),
        ambient=spec.number("operating_point.ambient_temperature"),
    )
    current, duty, limit = (
        spec.number(f"operating_point.{name}") for name in ("current", "duty", "winding_temperature_limit")
    )
    yoke_loss, tube_loss = (yoke or 0.0) * speed, (wall or 0.0) * speed

    def copper_loss(temperature: float) -> float:
        return duty * winding.copper_loss(winding.resistance(actuator, conductor, temperature), current)

    continuous = thermal.continuous_current(
        net, winding.resistance(actuator, conductor, limit), limit, duty, yoke_loss, tube_loss
    )
    assert performance.force_constant is not None
    return replace(
        performance,
        iron_loss=None if yoke is None else yoke_loss,
        eddy_loss=None if wall is None else tube_loss,
        drag_force=sum(drags) if drags else None,
        winding_temperature=thermal.winding_temperature(net, copper_loss, yoke_loss, tube_loss),
        continuous_current=continuous,
        continuous_thrust=performance.force_constant * continuous,
    )


def _loaded(spec: Spec, performance: Performance) -> Performance:
    """With the rod under the largest thrust, advancing."""
    actuator: HybridActuator = spec.actuator
    constant, pneumatic = performance.force_constant, performance.pneumatic_force_advance
    assert constant is not None
    assert pneumatic is not None
    peak = performance.peak_force
    thrust = pneumatic + (constant * spec.number("operating_point.peak_current") if peak is None else peak)
    stress = column.axial_stress(actuator, thrust)
    strength = _material(spec, "actuator.shaft.material").yield_stress
    critical = performance.buckling_force
    return replace(
        performance,
        peak_thrust=thrust,
        shaft_stress=stress,
        shaft_safety=strength / abs(stress) if strength is not None and abs(stress) > UNLOADED else None,
        buckling_safety=critical / thrust if critical is not None and stress > UNLOADED else None,
    )


def _dense(spec: Spec, performance: Performance) -> Performance:
    """With the forces over the actuator's volume."""
    constant, pneumatic = performance.force_constant, performance.pneumatic_force_advance
    assert constant is not None
    assert pneumatic is not None
    key = "actuator.reference_volume"
    volume = spec.number(key) if key in spec.values else thrust_density.envelope(spec.actuator)
    current = spec.number("operating_point.current")
    return replace(
        performance,
        thrust_density=thrust_density.thrust_density(pneumatic, constant, current, volume),
        force_constant_density=thrust_density.force_constant_density(constant, volume),
    )


def warnings(spec: Spec, performance: Performance) -> tuple[str, ...]:
    """What sound figures do not say by themselves: magnets beyond their temperature or their coercivity, eddy currents
    beyond their formula, figures that the study asks for and the data do not allow."""
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
    return (
        *found,
        *_runaway(performance),
        *_thick_walls(spec, actuator),
        *hybrid_seal.warnings(spec),
        *gaps(spec, performance),
    )


def _runaway(performance: Performance) -> list[str]:
    if performance.winding_temperature is None or performance.winding_temperature <= thermal.HOTTEST:
        return []
    return [
        f"winding_temperature is beyond {thermal.HOTTEST:g} K: at operating_point.current and operating_point.speed "
        "the copper runs away, and the number only measures how far."
    ]


def _thick_walls(spec: Spec, actuator: HybridActuator) -> list[str]:
    tube, speed = _material(spec, "actuator.cylinder.material"), spec.number("operating_point.speed")
    if tube.resistivity is None or speed == 0:
        return []
    wall = (actuator.cylinder.outer_diameter - actuator.cylinder.inner_diameter) / 2
    depth = losses.skin_depth(tube.resistivity, actuator.mover.pole_pitch, speed)
    if depth >= THIN * wall:
        return []
    return [
        f"At this speed the skin depth in the cylinder, {format_quantity(depth, 'length', 3)}, is below {THIN:g} times "
        f"its wall, {format_quantity(wall, 'length', 3)}; eddy_loss and drag_force are too high."
    ]


def _material(spec: Spec, key: str) -> Material:
    return lookup(spec.word(key), key, spec.materials, Material)


def _conductor(spec: Spec, actuator: HybridActuator) -> Conductor:
    return lookup(actuator.winding.material, "actuator.winding.material", spec.materials, Conductor)
