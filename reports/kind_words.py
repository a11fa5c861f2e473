"""What a report calls things, by the kind of actuator: how its figures came about, and what nobody has looked at."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.magnetic_network import UPPER_BOUND

HEADLINES = (
    "force_constant",
    "motor_constant",
    "moving_mass",
    "stray_field",
    "pneumatic_force_advance",
    "outer_diameter",
)
"""Figures of the first screen, after the objective."""


@dataclass(frozen=True, slots=True)
class KindWords:
    """The words of one kind of actuator. What a kind does not have is empty, and its sections are left out.

    route, route_short : what gives its figures: "by finite elements", "FEM" at the head of a column.
    network : the cheap model beside it, as "the magnetic network"; network_note : what is to be known of it;
    network_short : at the head of a column.
    moves : whether there is a mover, and so a window of positions. has_field : whether its field is drawn.
    squeeze : what parts overlap by design.
    headlines : figures of the first screen. main : those whose derivatives stand open. symbols : sign and meaning.
    not_checked : whole sentences.
    """

    route: str = "finite elements"
    route_short: str = "FEM"
    network: str = ""
    network_note: str = ""
    network_short: str = "network"
    moves: bool = True
    has_field: bool = True
    squeeze: str = ""
    headlines: tuple[str, ...] = HEADLINES
    main: tuple[str, ...] = ()
    symbols: tuple[tuple[str, str], ...] = ()
    not_checked: tuple[str, ...] = ()


PLAIN = KindWords()
"""Where no kind is named."""

HYBRID = KindWords(
    network="the magnetic network",
    network_note=f"The network's force constant is equation (2) of Nakata and Noda (2023). {UPPER_BOUND}",
    squeeze="the designed squeeze of the seal fins against the bore",
    main=(
        "force_constant",
        "force_constant_linkage",
        "motor_constant",
        "cogging_force",
        "stray_field",
        "yoke_flux_density",
        "demagnetisation_load",
        "winding_resistance",
        "phase_inductance",
        "winding_temperature",
        "continuous_thrust",
        "moving_mass",
        "total_mass",
    ),
    symbols=(
        (
            "z",
            "position: from the mid-plane of the first U coil at the cap end to the cap-side face of the magnet array",
        ),
        ("|B|", "magnitude of the flux density"),
        ("ψ", "flux function r·A; its level lines are field lines"),
        ("g_ac", "radial gap between magnets and winding"),
    ),
    not_checked=(
        "Heat that a mount takes away or brings, and hot spots: the temperature is the winding's mean in still air.",
        "Strength under changing load: stresses are static; threads, shoulders and fatigue are left out.",
        "The winding's support of the cylinder, and differences of thermal expansion.",
        "Force off the middle of the window at the peak current; positions there are taken at no current.",
        "Wear and air leakage of the seal fins; friction outside the range that was measured (0.6 to 8 mm/s).",
        "How the parts are held together: fastening of magnets, pistons, yoke and caps is not drawn.",
        "Anything that is not rotationally symmetric: lead wires, eccentricity, ports in the field.",
    ),
)

COILS = KindWords(
    route="the exact field in air",
    route_short="exact field",
    moves=False,
    has_field=False,
    headlines=(
        "stored_energy",
        "stray_flux_density",
        "quench_load",
        "central_flux_density",
        "total_mass",
        "joule_loss",
    ),
    symbols=(("z", "along the axis"), ("B", "flux density"), ("J", "current density of a winding")),
    not_checked=(
        "Iron or any other magnetic material near the coils: the field is that of currents in empty space.",
        "Forces between the coils, their supports and the stress in the conductor.",
        "Cooling, cryogenics, quench protection and losses under changing current.",
        "Turns, joints and leads: each winding carries its current density evenly.",
    ),
)

LEAD_SCREW = KindWords(
    network="the analytic field",
    network_note=(
        "The analytic field is that of (7) to (10) of the RotLin paper, by modified Bessel functions: linear magnets, "
        "and iron that is infinitely permeable wherever there is any. Both routes leave out the ends of the members."
    ),
    moves=False,
    has_field=False,
    headlines=(
        "stall_force",
        "spring_constant",
        "stall_force_density",
        "motor_torque",
        "moving_mass",
        "outer_diameter",
    ),
    main=(
        "stall_force",
        "spring_constant",
        "stall_force_density",
        "motor_torque",
        "stall_torque",
        "slip_margin",
        "sudden_load_limit",
        "moving_mass",
        "total_mass",
        "rotor_inertia",
    ),
    symbols=(
        ("x_d", "relative displacement h θ − x: the way of the rotor’s field less that of the mover"),
        ("F", "force of the magnetic spring, which pulls x_d back to rest"),
        ("h", "lead over 2π: the field’s way along the axis by the rotor’s angle θ"),
        ("ζ", "z − h θ: along the axis, counted from where the helix stands at the angle θ"),
        ("|B|", "magnitude of the flux density, of all three components"),
        ("ψ", "helical flux function; its level lines are field lines"),
        ("K_n", "force constants of (7) for the first, third and fifth harmonic of the pitch"),
    ),
    not_checked=(
        "Ends: the last pole of each member has one neighbour only, and the field there is no helix. Its share of the "
        "force is taken as that of a pole within; the pull of an end that leaves the other member is left out.",
        "Eccentricity: a rotor that is not in the middle is pulled further out; bearings and guides must hold that and "
        "the tolerance of the gap.",
        "Faults of magnetisation and of place: magnets of unlike strength, pitch or angle, glue lines, joints of arcs. "
        "They show as a displacement at rest that changes with position and angle, and as ripple.",
        "Eddy currents in magnets, iron and frame while the rotor slips or turns fast, and the losses of the motor.",
        "Hysteresis of the magnetic spring and friction: what a benchmark takes for them is measured, not computed.",
        "Strength of magnets, glue and frame, bearing loads, whirling of a long translator.",
        "The motor that turns the rotor: its torque constant and inertia are the specification’s.",
    ),
)

HYDROSTATIC = KindWords(
    route="simulation in time",
    route_short="simulated",
    network="the closed forms",
    network_note=(
        "The closed forms take the force as made exactly, by a fluid that does not give; tracking errors and the "
        "energy’s balance are the simulation’s alone."
    ),
    network_short="closed forms",
    moves=False,
    has_field=False,
    squeeze="the designed squeeze of the O-ring",
    headlines=(
        "force_frequency_limit",
        "tracking_error",
        "peak_pressure",
        "force_efficiency",
        "distal_mass",
        "specific_force_distal",
    ),
    main=(
        "force_frequency_limit",
        "force_at_rated_pressure",
        "specific_force_distal",
        "tracking_error",
        "peak_pressure",
        "pressure_load",
        "torque_load",
        "burst_factor",
        "buckling_safety",
        "distal_mass",
        "output_cylinder_mass",
    ),
    symbols=(
        ("F_ref", "reference of the output force"),
        ("p", "pressure above the atmosphere’s"),
        ("k", "stiffness of the return element"),
    ),
    not_checked=(
        "Inertia of the fluid and leakage past the seals: both are left out, as in the paper.",
        "End stops: a stroke that is exceeded is refused, not simulated.",
        "The load: it is held while a force is made. A joint that moves adds its own speed to what is asked.",
        "Friction that changes along the stroke, with age or with temperature; hysteresis of springs, cords and hose.",
        "Fatigue and shock: stresses are static. Threads, spigots and how the caps are held in the tube.",
        "Side loads on the rod, its bearing and guide; wear and extrusion of the O-ring, its rules with tolerances.",
        "Air that dissolves or leaves the fluid, and how well the system can be bled.",
        "Heat of motor and drive; the motor’s own time in overload, and its voltage at top speed.",
        "The input cylinder’s strength, and hose, block, connectors, screw and motor as parts: they are bought.",
    ),
)

WORDS: dict[str, KindWords] = {
    "coils": COILS,
    "hybrid": HYBRID,
    "hydrostatic": HYDROSTATIC,
    "lead-screw": LEAD_SCREW,
}
"""By the kind's name in the specification."""
