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
    network : the cheap model beside it, as "the magnetic network"; network_note : what is to be known of it.
    moves : whether there is a mover, and so a window of positions. has_field : whether its field is drawn.
    squeeze : what parts overlap by design.
    headlines : figures of the first screen. main : those whose derivatives stand open. symbols : sign and meaning.
    not_checked : whole sentences.
    """

    route: str = "finite elements"
    route_short: str = "FEM"
    network: str = ""
    network_note: str = ""
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
    network_note="The analytic field is that of (7) to (10) of the RotLin paper: infinitely permeable iron.",
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
    symbols=(
        ("x_d", "relative displacement: the way of the rotor's field less that of the mover"),
        ("h", "lead over 2π: way of the field by the rotor's angle"),
        ("l_p", "pitch, from one magnet to the next of the same polarity"),
    ),
)
