"""The figures of a magnetic lead screw as a spring, a gear and a mass: fields of `Performance`."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.figure_fields import DRIVE, FIELD, FORCE, SIZE, SPRING, figure


@dataclass(frozen=True, kw_only=True)
class LeadScrewFigures:
    """SI units; None where a route or a kind of actuator has no such figure."""

    stall_force: float | None = figure(
        "force", FORCE, "largest force of the magnetic spring over the displacement; beyond it the screw slips"
    )
    stall_force_density: float | None = figure(
        "force density", FORCE, "stall force over the reference volume or, without one, that of the rotor's envelope"
    )
    stall_torque: float | None = figure("torque", FORCE, "that turns the rotor past the stall: h times the stall force")
    slip_margin: float | None = figure(
        "count", FORCE, "stall force over the load with the moving mass accelerated; at one the screw slips"
    )
    sudden_load_limit: float | None = figure(
        "force", FORCE, "load that, put on at once with the rotor held, just does not slip the mover to the next pole"
    )
    stroke_end_force: float | None = figure(
        "force", FORCE, "stall force that is left at the ends of the stroke, where fewer poles may be engaged"
    )
    force_ripple: float | None = figure(
        "fraction",
        FORCE,
        "peak to peak over a turn at the stall, over the stall force; zero unless both members' magnets are cut",
    )
    spring_constant: float | None = figure(
        "stiffness", SPRING, "slope of the force over the relative displacement at rest, with all harmonics"
    )
    load_displacement: float | None = figure(
        "length", SPRING, "relative displacement under the load at rest; none beyond the stall force"
    )
    spring_energy: float | None = figure("work", SPRING, "stored on the way to the next pole, where the screw slips")
    slip_work: float | None = figure("work", SPRING, "that the load does at each slip by one pitch")
    natural_frequency: float | None = figure("frequency", SPRING, "of the mover on the spring, the rotor held")
    transfer_ratio: float | None = figure("transfer ratio", DRIVE, "angle of the rotor over the way of its field: 1/h")
    motor_torque: float | None = figure(
        "torque",
        DRIVE,
        "peak of the motor: h times load and accelerated mass, the rotor's own acceleration, and friction",
    )
    motor_current: float | None = figure("current", DRIVE, "motor torque over the motor's torque constant")
    back_driving_force: float | None = figure(
        "force", DRIVE, "load that turns the rotor back against the friction torque; beyond the stall force it slips"
    )
    largest_acceleration: float | None = figure(
        "acceleration", DRIVE, "that the screw can give the mover under the load before it slips", signed=True
    )
    harmonic_ratio_2: float | None = figure(
        "fraction",
        FIELD,
        "second harmonic of the force over its first, K_2/K_1: that of three periods in a pitch",
        signed=True,
    )
    harmonic_ratio_3: float | None = figure(
        "fraction",
        FIELD,
        "third harmonic of the force over its first, K_3/K_1: that of five periods in a pitch",
        signed=True,
    )
    translator_iron_flux_density: float | None = figure(
        "flux density", FIELD, "mean over the section of the iron behind the translator's magnets, largest along it"
    )
    rotor_iron_flux_density: float | None = figure(
        "flux density", FIELD, "mean over the section of the iron behind the rotor's magnets, largest along it"
    )
    rotor_inertia: float | None = figure("rotational inertia", SIZE, "of all that turns about the axis")
    reflected_mass: float | None = figure("mass", SIZE, "that the rotor's inertia is to the load: J/h^2")
    magnet_mass: float | None = figure("mass", SIZE, "magnets of both members")
