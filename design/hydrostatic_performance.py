"""The figures of an electro-hydrostatic actuator: fields of `Performance`."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.figure_fields import DRIVE, FORCE, HEAT, HYDRAULIC, SIZE, TRACKING, figure


@dataclass(frozen=True, kw_only=True)
class HydrostaticFigures:
    """SI units; None where a route or a kind of actuator has no such figure."""

    force_frequency_limit: float | None = figure(
        "force rate", FORCE, "amplitude times frequency of the fastest sinusoidal force, by equation (4)"
    )
    stroke_force: float | None = figure(
        "force", FORCE, "by which the return element's force rises over the output's stroke"
    )
    force_at_rated_pressure: float | None = figure(
        "force", FORCE, "of the output piston at the rated pressure, without friction"
    )
    pushing_force: float | None = figure(
        "force", FORCE, "the same less the seal's friction at the largest speed", signed=True
    )
    force_efficiency: float | None = figure(
        "fraction", FORCE, "force over force and friction of the output cylinder, at top force and top speed"
    )
    force_efficiency_both: float | None = figure("fraction", FORCE, "the same with the friction of both cylinders")
    specific_force_distal: float | None = figure(
        "specific force", FORCE, "force at the rated pressure over the distal mass"
    )
    specific_force_total: float | None = figure(
        "specific force", FORCE, "force at the rated pressure over the total mass"
    )
    maximum_velocity: float | None = figure("speed", DRIVE, "of the output piston, by the motor's speed")
    speed_load: float | None = figure("fraction", DRIVE, "speed that the operating point asks for over the motor's")
    torque_load: float | None = figure(
        "fraction", DRIVE, "torque that the operating point asks for over the motor's, peak or root mean square"
    )
    power_load: float | None = figure("fraction", DRIVE, "mean power that the operating point asks for over the rated")
    stroke_load: float | None = figure(
        "fraction", DRIVE, "stroke that the operating point asks for over the cylinder's"
    )
    pressure_load: float | None = figure(
        "fraction", HYDRAULIC, "pressure that the operating point asks for over the rated"
    )
    peak_pressure: float | None = figure("pressure", HYDRAULIC, "largest in the output cylinder at the operating point")
    least_pressure: float | None = figure(
        "pressure",
        HYDRAULIC,
        "least in either cylinder at the operating point; below the vapour's it cavitates",
        signed=True,
    )
    line_pressure_drop: float | None = figure(
        "pressure difference", HYDRAULIC, "from chamber to chamber at the operating point's largest speed"
    )
    effective_bulk_modulus: float | None = figure(
        "stress", HYDRAULIC, "of fluid, air and hose together at the middle pressure of the operating point"
    )
    burst_factor: float | None = figure(
        "count", HYDRAULIC, "yield stress of the output cylinder's tube over its equivalent stress at rated pressure"
    )
    seal_squeeze: float | None = figure("fraction", HYDRAULIC, "of the piston's O-ring in its groove", signed=True)
    seal_stretch: float | None = figure("fraction", HYDRAULIC, "of the piston's O-ring in its groove", signed=True)
    seal_fill: float | None = figure("fraction", HYDRAULIC, "share of the groove that the O-ring fills")
    minimum_friction: float | None = figure("force", HYDRAULIC, "least of the output's seal sliding without pressure")
    friction_at_limit: float | None = figure(
        "force", HYDRAULIC, "of the output's seal at the largest speed and the operating point's peak pressure"
    )
    tracking_error: float | None = figure(
        "force", TRACKING, "largest difference of reference and output force at the operating point, simulated"
    )
    mean_tracking_error: float | None = figure("force", TRACKING, "mean of its absolute value")
    energy_imbalance: float | None = figure(
        "fraction", TRACKING, "of the simulation: energy that is neither stored nor lost, over that put in"
    )
    fluid_temperature: float | None = figure(
        "temperature", HEAT, "of the fluid in steady state at the operating point, in still air"
    )
    distal_mass: float | None = figure(
        "mass", SIZE, "worn at the joint: output cylinder, return element, half of the hose with its fluid"
    )
    output_cylinder_mass: float | None = figure("mass", SIZE, "of the output cylinder")
    fluid_volume: float | None = figure("volume", SIZE, "of the filled system")
