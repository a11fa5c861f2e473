"""The electro-hydrostatic actuator's figures that no simulation decides, and what both routes check.

`weighed` gives the actuator with the masses that the specification leaves to its parts as drawn. `common_figures` needs
that and the quasi-static cycle of the operating point.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic import HydrostaticActuator
from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.materials import Material, lookup
from fluxbore.design.performance import Performance
from fluxbore.design.spec import Spec
from fluxbore.design.units import format_quantity
from fluxbore.optimize.hydrostatic_cycle import Cycle, cycle

ROD_ENDS = "fixed-free"
"""How the rod is held when extended: by its cap alone, as the worst."""


def weighed(spec: Spec) -> HydrostaticActuator:
    """Raises DesignError where a cylinder that is to be weighed cannot be drawn, MaterialError for its materials."""
    from fluxbore.geometry.hydrostatic_parts import masses

    design: HydrostaticDesign = spec.actuator
    return design.weighed(masses(design, spec.materials))


def operating_point(spec: Spec) -> tuple[float, float, float]:
    """Amplitude (N, half the distance between peaks), frequency (Hz) and least force (N)."""
    return (
        spec.number("operating_point.force_amplitude"),
        spec.number("operating_point.frequency"),
        spec.number("operating_point.least_force"),
    )


def operating_cycle(spec: Spec, actuator: HydrostaticActuator) -> Cycle:
    """Of the operating point. Raises DesignError for a stroke that it exceeds, and for cavitation."""
    from fluxbore.design.fluid import check_cavitation

    amplitude, frequency, least = operating_point(spec)
    found = cycle(actuator, amplitude, frequency, least)
    rest, stroke = actuator.return_element.force(0.0), actuator.output_cylinder.stroke
    top = actuator.return_element.force(stroke) + (actuator.series_stiffness or 0.0) * stroke
    if found.way > 0 and not least + 2 * amplitude <= top * (1 + 1e-9):
        raise DesignError(
            "operating_point.least_force and twice operating_point.force_amplitude must not exceed what the return "
            "element pushes back with at the end of actuator.output_cylinder.stroke, "
            f"{format_quantity(top, 'force', 4)}; got {format_quantity(least + 2 * amplitude, 'force', 4)}."
        )
    if found.way > 0 and not least >= rest * (1 - 1e-9):
        raise DesignError(
            "operating_point.least_force must not be below the return element's force with the piston retracted, "
            f"{format_quantity(rest, 'force', 4)}; got {format_quantity(least, 'force', 4)}."
        )
    check_cavitation(actuator.fluid, found.least, "The least pressure at the operating point")
    return found


def common_figures(spec: Spec, actuator: HydrostaticActuator, found: Cycle) -> Performance:
    """All figures in closed form. Raises DesignError where the cylinder cannot be drawn, or loses more than air takes.

    actuator : as weighed. found : its cycle at the operating point.
    """
    from fluxbore.design import hydrostatic_figures as figures
    from fluxbore.design.column import section
    from fluxbore.design.hydrostatic_range import demand, extension_at
    from fluxbore.design.pressure_vessel import wall_stress

    amplitude, frequency, least = operating_point(spec)
    asked = demand(actuator, amplitude, frequency, least)
    cylinder = actuator.output_cylinder
    top, fastest = least + 2 * amplitude, figures.maximum_velocity(actuator)
    rated = figures.ideal_force(actuator)
    distal, total = figures.distal_mass(actuator), figures.total_mass(actuator)
    rod = _material(spec, "output_cylinder.rod")
    limit = figures.force_frequency_limit(actuator, extension_at(actuator, least + amplitude))
    shaft = None if cylinder.rod_diameter is None else rated / section(cylinder.rod_diameter)[0]
    buckling = (
        None
        if cylinder.rod_diameter is None or rod.young_modulus is None
        else figures.rod_buckling_force(cylinder, rod, ends=ROD_ENDS)
    )
    inner = cylinder.bore / 2
    return replace(
        _drawn(spec),
        force_frequency_limit=limit or None,
        stroke_force=figures.stroke_force(actuator),
        force_at_rated_pressure=rated,
        pushing_force=figures.pushing_force(actuator, fastest),
        specific_force_distal=rated / distal if distal > 0 else None,
        specific_force_total=rated / total,
        maximum_velocity=fastest,
        speed_load=asked.speed,
        torque_load=asked.torque,
        power_load=asked.power if actuator.motor.rated_power is not None else None,
        stroke_load=asked.stroke,
        line_pressure_drop=found.drop,
        effective_bulk_modulus=effective_bulk_modulus(actuator, found.middle),
        hoop_stress=None
        if cylinder.wall_thickness is None
        else wall_stress(inner, inner, inner + cylinder.wall_thickness, cylinder.rated_pressure).hoop,
        burst_factor=_burst_factor(spec, actuator),
        minimum_friction=figures.smallest_friction(actuator),
        shaft_stress=shaft,
        shaft_safety=None if shaft is None or rod.yield_stress is None else rod.yield_stress / shaft,
        buckling_force=buckling,
        buckling_safety=None if buckling is None else buckling / rated,
        distal_mass=distal,
        total_mass=total,
        moving_mass=cylinder.moving_mass,
        output_cylinder_mass=cylinder.mass,
        fluid_volume=actuator.fluid_volume,
        **_pressed(actuator, found.peak_output, top, fastest),
        **_gland(spec),
    )


def pressure_figures(
    spec: Spec, actuator: HydrostaticActuator, output: float, into: float, hose: float, least: float, loss: float
) -> dict[str, float | None]:
    """What follows from the largest pressures in both cylinders and the hose, the least in either cylinder (Pa) and the
    losses in the fluid (W). Raises DesignError for losses that the air around cannot take."""
    from fluxbore.design import hydrostatic_figures as figures

    amplitude, _, least_force = operating_point(spec)
    loads = [output / actuator.output_cylinder.rated_pressure, into / actuator.input_cylinder.rated_pressure]
    if actuator.hose.rated_pressure is not None:
        loads.append(hose / actuator.hose.rated_pressure)
    return {
        "pressure_load": max(loads),
        "peak_pressure": output,
        "least_pressure": least,
        "fluid_temperature": figures.fluid_temperature(
            actuator, loss, spec.number("operating_point.ambient_temperature")
        ),
        **_pressed(actuator, output, least_force + 2 * amplitude, figures.maximum_velocity(actuator)),
    }


def effective_bulk_modulus(actuator: HydrostaticActuator, pressure: float) -> float:
    """Of fluid, air and the hose's wall together (Pa) at a gauge pressure (Pa): V/beta of them add up."""
    from fluxbore.design.fluid import bulk_modulus

    volume = actuator.fluid_volume
    fluid = float(bulk_modulus(actuator.fluid, pressure))
    return volume / (volume / fluid + actuator.hose.volume / actuator.hose.wall_modulus)


def _pressed(actuator: HydrostaticActuator, pressure: float, force: float, speed: float) -> dict[str, float | None]:
    """Friction and efficiency at a pressure (Pa), a force (N) and the largest speed (m/s)."""
    from fluxbore.design import hydrostatic_figures as figures

    share = figures.force_efficiency(actuator, force, speed, pressure)
    return {
        "friction_at_limit": figures.friction_at(actuator, speed, pressure),
        "force_efficiency": share.one_cylinder,
        "force_efficiency_both": share.both_cylinders,
    }


def _burst_factor(spec: Spec, actuator: HydrostaticActuator) -> float | None:
    from fluxbore.design import hydrostatic_figures as figures

    tube = _material(spec, "output_cylinder.material")
    if tube.yield_stress is None or actuator.output_cylinder.wall_thickness is None:
        return None
    return figures.burst_factor(actuator.output_cylinder, tube)


def _gland(spec: Spec) -> Mapping[str, float]:
    from fluxbore.design.seal_gland import gland_figures

    design: HydrostaticDesign = spec.actuator
    found = gland_figures(design.gland)
    return {"seal_squeeze": found.squeeze, "seal_stretch": found.stretch, "seal_fill": found.fill}


def _drawn(spec: Spec) -> Performance:
    """Size of the output cylinder over its caps. Raises DesignError where its parts do not fit one another."""
    from fluxbore.geometry.hydrostatic_parts import assembly
    from fluxbore.geometry.mass import envelope

    diameter, length = envelope(assembly(spec.actuator, 0.0))
    return Performance(outer_diameter=diameter, length=length)


def _material(spec: Spec, leaf: str) -> Material:
    key = f"actuator.{leaf}"
    return lookup(str(spec.values[key]), key, spec.materials, Material)
