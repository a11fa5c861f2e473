"""What an electro-hydrostatic actuator can do at most, from its data alone: force over frequency, friction, efficiency,
force density, burst, and how warm its fluid gets.

    F f      = w_max i k / 2 pi                                                                        (4)
    F_rated  = A p_rated,    less the seal's friction while it pushes
    share    = F/(F + F_f), the paper's: one cylinder's friction; with both cylinders F/(F + 2 F_f)
    burst    = the equivalent stress at the bore at rated pressure, against the yield stress (Lame)

(4) counts the amplitude F of F sin(2 pi f t), half the distance between its peaks. The share of force that arrives is
an efficiency where no speed is lost on the way, as in a column of fluid that neither leaks nor gives.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.column import END_CONDITIONS, buckling_force
from fluxbore.design.convection import heat_transfer
from fluxbore.design.cylinder_friction import cylinder_friction, least_friction
from fluxbore.design.errors import DesignError
from fluxbore.design.flow_resistance import hose_resistance, orifice_resistance
from fluxbore.design.fluid import density, viscosity
from fluxbore.design.hydrostatic import HydraulicCylinder, HydrostaticActuator
from fluxbore.design.materials import Material
from fluxbore.design.pressure_vessel import wall_stress
from fluxbore.design.units import format_quantity

EMISSIVITY = 0.9
"""Of a hose and of painted or oxidised parts."""

LEAST_RISE = 1e-9
"""K, below which a rise is none."""

HOTTEST = 400.0
"""K above the ambient; beyond it there is no fluid left to speak of."""


@dataclass(frozen=True, slots=True)
class ForceEfficiency:
    """Shares of the force that arrive at the load, with the friction of one cylinder, and of both."""

    one_cylinder: float
    both_cylinders: float


def stiffness(actuator: HydrostaticActuator, extension: float = 0.0) -> float:
    """Of what the output piston works against with the load held (N/m): return element and series spring together."""
    return actuator.return_element.stiffness(extension) + (actuator.series_stiffness or 0.0)


def force_frequency_limit(actuator: HydrostaticActuator, extension: float = 0.0) -> float:
    """F f (N/s) of equation (4), at the stiffness of an extension (m), with the cylinders' ratio of areas."""
    return actuator.maximum_velocity * actuator.hydraulic_ratio * stiffness(actuator, extension) / math.tau


def maximum_velocity(actuator: HydrostaticActuator) -> float:
    """Of the output piston (m/s)."""
    return actuator.maximum_velocity * actuator.hydraulic_ratio


def stroke_force(actuator: HydrostaticActuator) -> float:
    """What the return element's force rises by over the output's stroke (N); the paper's 433 N."""
    element, stroke = actuator.return_element, actuator.output_cylinder.stroke
    return element.force(stroke) - element.force(0.0) + (actuator.series_stiffness or 0.0) * stroke


def ideal_force(actuator: HydrostaticActuator) -> float:
    """A p (N) at the output cylinder's rated pressure."""
    return actuator.output_cylinder.area * actuator.output_cylinder.rated_pressure


def pushing_force(actuator: HydrostaticActuator, speed: float) -> float:
    """`ideal_force` less the seal's friction at a speed (m/s) and that pressure (N)."""
    cylinder = actuator.output_cylinder
    return ideal_force(actuator) - float(cylinder_friction(cylinder.friction, speed, cylinder.rated_pressure))


def smallest_friction(actuator: HydrostaticActuator) -> float:
    """Of the output cylinder without pressure (N)."""
    return least_friction(actuator.output_cylinder.friction)[1]


def friction_at(actuator: HydrostaticActuator, speed: float, pressure: float) -> float:
    """Of the output cylinder (N) at a speed (m/s) and a gauge pressure (Pa)."""
    return float(cylinder_friction(actuator.output_cylinder.friction, speed, pressure))


def force_efficiency(actuator: HydrostaticActuator, force: float, speed: float, pressure: float) -> ForceEfficiency:
    """At a force (N) of the load, a speed (m/s) of the pistons, and a gauge pressure (Pa)."""
    lost = friction_at(actuator, speed, pressure)
    ratio = actuator.hydraulic_ratio
    first = float(cylinder_friction(actuator.input_cylinder.friction, speed / ratio, pressure)) / ratio
    return ForceEfficiency(force / (force + lost), force / (force + lost + first))


def distal_mass(actuator: HydrostaticActuator) -> float:
    """kg at the joint: output cylinder, return element, half of the hose with its fluid, and what else is told."""
    hose = (actuator.hose.linear_mass * actuator.hose.length + actuator.hose.volume * actuator.fluid.density) / 2
    springs = float(getattr(actuator.return_element, "mass", 0.0))
    return actuator.output_cylinder.mass + springs + hose + actuator.other_distal_mass


def total_mass(actuator: HydrostaticActuator) -> float:
    """kg of all components whose mass is told, with the fluid."""
    hose = actuator.hose
    parts = (actuator.motor, actuator.drive, actuator.coupling, actuator.ball_screw, actuator.input_cylinder)
    springs = float(getattr(actuator.return_element, "mass", 0.0))
    others = actuator.block.mass + actuator.output_cylinder.mass + springs + actuator.other_distal_mass
    filled = actuator.fluid_volume * actuator.fluid.density
    return sum(part.mass for part in parts) + others + hose.linear_mass * hose.length + filled


@dataclass(frozen=True, slots=True)
class ForceDensity:
    """Force at rated pressure, without friction, over the mass at the joint and over all of it (N/kg)."""

    distal: float
    total: float


def force_density(actuator: HydrostaticActuator) -> ForceDensity:
    """Of components whose mass is told; one that is left out makes the actuator look better than it is."""
    return ForceDensity(ideal_force(actuator) / distal_mass(actuator), ideal_force(actuator) / total_mass(actuator))


def burst_factor(cylinder: HydraulicCylinder, material: Material) -> float:
    """Yield stress over the equivalent stress at the bore, at the rated pressure, with closed ends (Lame).

    Raises DesignError where the cylinder has no wall or the material no yield stress.
    """
    if cylinder.wall_thickness is None:
        raise DesignError(f"actuator.{cylinder.name}.wall_thickness is missing: the burst factor needs it.")
    if material.yield_stress is None:
        raise DesignError(f"actuator.{cylinder.name}.material must have a yield stress; {material.name} has none.")
    inner = cylinder.bore / 2
    return (
        material.yield_stress
        / wall_stress(inner, inner, inner + cylinder.wall_thickness, cylinder.rated_pressure).equivalent
    )


def least_wall(bore: float, pressure: float, stress: float) -> float:
    """The wall (m) of a closed tube of a bore (m) whose equivalent stress at the bore is `stress` (Pa) at a gauge
    pressure (Pa): sqrt(3) p K^2/(K^2 - 1) = sigma, K the ratio of the radii (Lame with von Mises).

    Raises DesignError where no wall is thick enough.
    """
    share = math.sqrt(3) * pressure / stress
    if not share < 1:
        limit = format_quantity(stress / math.sqrt(3), "pressure", 4)
        raise DesignError(
            f"actuator.output_cylinder.rated_pressure must be below {limit} for a wall of that stress; "
            f"got {format_quantity(pressure, 'pressure', 4)}."
        )
    return bore / 2 * (1 / math.sqrt(1 - share) - 1)


def rod_buckling_force(
    cylinder: HydraulicCylinder, material: Material, *, ends: str = "fixed-free", length: float | None = None
) -> float:
    """Critical load (N) of the rod over its stroke, or a length (m); `ends` is one of `column.END_CONDITIONS`."""
    if cylinder.rod_diameter is None:
        raise DesignError(f"actuator.{cylinder.name}.rod_diameter is missing: buckling needs it.")
    if material.young_modulus is None:
        raise DesignError(f"actuator.{cylinder.name}.rod must have a Young's modulus; {material.name} has none.")
    reach = END_CONDITIONS[ends] * (cylinder.stroke if length is None else length)
    force = buckling_force(cylinder.rod_diameter, reach, material.young_modulus, material.yield_stress)
    return math.inf if force is None else force


def line_pressure_drop(actuator: HydrostaticActuator, speed: float) -> float:
    """From chamber to chamber (Pa) at a speed of the output piston (m/s): ports, fittings, hose and block."""
    flow = actuator.output_cylinder.area * speed
    rho, mu = density(actuator.fluid, actuator.temperature), float(viscosity(actuator.fluid, actuator.temperature))
    hose = actuator.hose
    resistance = (
        2 * orifice_resistance(actuator.port, flow, rho, mu)
        + 2 * orifice_resistance(actuator.fitting, flow, rho, mu)
        + 2 * orifice_resistance(actuator.block.orifice, flow, rho, mu)
        + hose_resistance(hose.bore, hose.length, hose.roughness, flow, rho, mu)
    )
    return resistance * flow


def fluid_temperature(actuator: HydrostaticActuator, loss: float, ambient: float | None = None) -> float:
    """Of the fluid (K) where `loss` (W) goes on in cylinders and line until nothing changes any more.

    The heat leaves by natural convection and radiation of both cylinders' tubes and the hose (`convection`), as
    horizontal cylinders in still air; what flows into the frame is left out, and walls are taken as warm as the fluid:
    high by what the frame takes, low by what the hose's wall holds back, some kelvin at a watt for each 0.1 m.
    """
    from scipy.optimize import brentq

    surroundings = actuator.temperature if ambient is None else ambient
    if loss <= 0:
        return surroundings
    surfaces = [(actuator.hose.bore * 2, actuator.hose.length)]
    for cylinder in (actuator.input_cylinder, actuator.output_cylinder):
        surfaces.append((cylinder.bore + 2 * (cylinder.wall_thickness or 0.0), cylinder.stroke))

    def surplus(rise: float) -> float:
        given = sum(
            heat_transfer(outer, surroundings + rise, surroundings, EMISSIVITY) * math.pi * outer * length
            for outer, length in surfaces
        )
        return given * rise - loss

    if surplus(LEAST_RISE) >= 0:
        return surroundings
    if surplus(HOTTEST) < 0:
        raise DesignError(
            f"The losses in the fluid must be what cylinders and hose give off at {HOTTEST:g} K above the ambient; "
            f"got {loss:.4g} W."
        )
    return surroundings + float(brentq(surplus, LEAST_RISE, HOTTEST, xtol=1e-6))
