"""The figures that describe a design, the same for every route that computes them.

Network and finite elements fill the same type, so that they differ by one subtraction; a figure that a route cannot
give is ``None``, never a guess.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields

from fluxbore.design.figure_fields import DRIVE, FIELD, FORCE, GROUPS, HEAT, PRESSURE, SEAL, SIZE, WINDING, figure
from fluxbore.design.hydrostatic_performance import HydrostaticFigures
from fluxbore.design.lead_screw_performance import LeadScrewFigures
from fluxbore.design.units import DIMENSIONS, format_quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class Performance(LeadScrewFigures, HydrostaticFigures):
    """Figures of one design, SI units; the unit and meaning of each stand in `FIGURES`."""

    force_constant: float | None = figure(
        "force constant",
        FORCE,
        "thrust per ampere of balanced three-phase current amplitude on the q axis, incremental at no current, "
        "mean over the window of positions; by the stress tensor in the FEM, by equation (2) in the network",
    )
    force_constant_linkage: float | None = figure(
        "force constant", FORCE, "the same from the fundamental of the phases' flux linkages: 3/2 (pi/tau) lambda_1"
    )
    motor_constant: float | None = figure(
        "motor constant", FORCE, "force constant over the root of 3/2 the phase resistance"
    )
    winding_resistance: float | None = figure("resistance", WINDING, "of one phase, at the winding's temperature")
    turns: float | None = figure("count", WINDING, "turns of one phase; fractional where a density of turns is held")
    pneumatic_force_advance: float | None = figure(
        "force", FORCE, "gauge pressure times the catalogue bore's area", signed=True
    )
    pneumatic_force_retract: float | None = figure("force", FORCE, "the same less the shaft's area", signed=True)
    thrust_density: float | None = figure(
        "force density",
        FORCE,
        "pneumatic force, advancing, and force constant times the current, over the reference volume or, without one, "
        "that of the back yoke's envelope",
        signed=True,
    )
    force_constant_density: float | None = figure(
        "force constant density", FORCE, "force constant over the same volume"
    )
    moving_mass: float | None = figure(
        "mass", SIZE, "of the mover: shaft, magnets, rings and pistons, or a rotor and what it carries"
    )
    total_mass: float | None = figure("mass", SIZE, "all parts")
    stray_field: float | None = figure(
        "flux density",
        FIELD,
        "largest flux density at no current on a cylinder 5 mm outside the yoke, from 20 mm before to 20 mm beyond it, "
        "over the window",
    )
    yoke_flux_density: float | None = figure(
        "flux density",
        FIELD,
        "axial flux density averaged over the yoke's cross-section, largest along it and over the window",
    )
    ring_flux_density: float | None = figure(
        "flux density", FIELD, "radial flux density at the outside of an inner soft-magnetic ring, mean over its width"
    )
    gap_flux_density: float | None = figure(
        "flux density", FIELD, "mean radial flux density at the cylinder's outside over tau_f + 2 g_ac around a pole"
    )
    cogging_force: float | None = figure("force", FORCE, "largest axial force at no current over the window")
    demagnetised_fraction: float | None = figure(
        "fraction",
        FIELD,
        "share of the magnets' volume whose reverse field exceeds the intrinsic coercivity at temperature; of a lead "
        "screw half a pitch from rest, where it slips",
    )
    electric_loading: float | None = figure(
        "electric loading", WINDING, "peak K_sp of the sinusoidal current sheet at the spec's current"
    )
    # The drive: what the field and the supply allow.
    phase_inductance: float | None = figure(
        "inductance",
        DRIVE,
        "flux linkage of a phase per ampere of balanced three-phase current (self less mutual), incremental at no "
        "current",
    )
    peak_force: float | None = figure(
        "force",
        FORCE,
        "thrust at the peak current on the q axis in the middle of the window, less the cogging there",
        signed=True,
    )
    saturation_ratio: float | None = figure(
        "fraction", FORCE, "peak force over force constant times peak current: 100 % without saturation"
    )
    peak_thrust: float | None = figure(
        "force",
        FORCE,
        "pneumatic force, advancing, and the electromagnetic force at the peak current",
        signed=True,
    )
    back_emf: float | None = figure(
        "voltage", DRIVE, "amplitude of a phase at the speed: 2/3 of force constant times speed"
    )
    voltage_demand: float | None = figure(
        "voltage",
        DRIVE,
        "amplitude of a phase that the current needs at the speed, over resistance, inductance and back-EMF",
    )
    voltage_margin: float | None = figure(
        "voltage",
        DRIVE,
        "supply voltage over the root of 3 less the voltage demand; below zero the supply is too low",
        signed=True,
    )
    no_load_speed: float | None = figure("speed", DRIVE, "at which the back-EMF alone takes the whole supply voltage")
    speed_limit: float | None = figure(
        "speed",
        DRIVE,
        "to which the supply voltage can push the spec's current; below zero not even at rest, and how far from it",
        signed=True,
    )
    # The magnets under the worst of no current and peak current.
    demagnetisation_load: float | None = figure(
        "fraction",
        FIELD,
        "reverse field in the magnets over their intrinsic coercivity at temperature, by its 8-norm over their volume; "
        "the worst of no current over the window and the peak current of either sign; of a lead screw half a pitch "
        "from rest, where it slips",
    )
    peak_demagnetised_fraction: float | None = figure(
        "fraction", FIELD, "the demagnetised fraction at the peak current, on the q axis of either sign"
    )
    # Losses and temperature.
    copper_loss: float | None = figure("power", HEAT, "3/2 I^2 R at the spec's current amplitude")
    iron_loss: float | None = figure(
        "power", HEAT, "hysteresis and eddy currents of the solid yoke at the speed, over the magnet array's length"
    )
    eddy_loss: float | None = figure(
        "power", HEAT, "eddy currents in the cylinder's wall at the speed, over the magnet array's length"
    )
    drag_force: float | None = figure("force", HEAT, "braking force of the eddy currents and of the yoke's hysteresis")
    winding_temperature: float | None = figure(
        "temperature",
        HEAT,
        "mean of the winding, in steady state in still air, at the spec's current, duty and speed; beyond 2000 K only "
        "a measure of how far the copper has run away",
    )
    continuous_current: float | None = figure(
        "current",
        HEAT,
        "amplitude that heats the winding to its limit at the spec's duty and speed; below zero where the other losses "
        "alone exceed it",
        signed=True,
    )
    continuous_thrust: float | None = figure("force", HEAT, "force constant times continuous current", signed=True)
    # The air cylinder and the rod.
    hoop_stress: float | None = figure(
        "stress",
        PRESSURE,
        "circumferential, at the bore of the cylinder under the pressure; of a hydraulic one the rated pressure",
        signed=True,
    )
    cylinder_safety: float | None = figure(
        "count", PRESSURE, "yield stress of the cylinder over its equivalent (von Mises) stress at the bore"
    )
    cap_safety: float | None = figure(
        "count",
        PRESSURE,
        "force at which the set screws of an end cap, or what holds them, yield over the pressure's push",
    )
    bore_dilation: float | None = figure(
        "length",
        PRESSURE,
        "radial displacement of the bore under the pressure, outwards",
        signed=True,
    )
    bore_clearance: float | None = figure(
        "length",
        PRESSURE,
        "radial, between mover and bore: (D_c' - D_m)/2 and the bore dilation, which opens it under pressure",
        signed=True,
    )
    shaft_stress: float | None = figure(
        "stress",
        PRESSURE,
        "axial, under the peak thrust; of a hydraulic cylinder's rod under the force at rated pressure",
        signed=True,
    )
    shaft_safety: float | None = figure("count", PRESSURE, "yield stress of the shaft over the shaft stress")
    buckling_force: float | None = figure(
        "force",
        PRESSURE,
        "critical axial load of the rod's free length when extended, by Euler and, where stocky, by Johnson",
    )
    buckling_safety: float | None = figure(
        "count", PRESSURE, "buckling force over peak thrust; of a hydraulic cylinder over the force at rated pressure"
    )
    # The piston's seal: two fins with their lips on the bore.
    seal_friction: float | None = figure(
        "force", SEAL, "kinetic friction of the piston's seals at pressure and speed; at rest that of breaking away"
    )
    seal_friction_variation: float | None = figure(
        "force", SEAL, "seal friction at the pressure less that without pressure, at the speed"
    )
    fin_deformed_length: float | None = figure(
        "length", SEAL, "axial length of the fin that the bore bends, by equation (4)"
    )
    fin_contact_area: float | None = figure(
        "area", SEAL, "of the fin on the pressurised side with the bore, by equation (5)"
    )
    fin_interference: float | None = figure(
        "length",
        SEAL,
        "radial, of fin and bore: the least that tolerances and temperatures leave; below zero the fin does not touch",
        signed=True,
    )
    largest_interference: float | None = figure(
        "length", SEAL, "radial, of fin and bore: the most that tolerances and temperatures make of it", signed=True
    )
    fin_angle: float | None = figure("angle", SEAL, "of the fin's cone to its axis")
    fin_wall: float | None = figure("length", SEAL, "wall of the fin")
    lip_contact_force: float | None = figure(
        "force", SEAL, "radial force of one lip on the bore at the pressure, as drawn", signed=True
    )
    lip_contact_pressure: float | None = figure(
        "stress", SEAL, "lip contact force over the fin's contact area", signed=True
    )
    sealing_margin: float | None = figure(
        "count",
        SEAL,
        "mean contact pressure at the least interference over the chamber's pressure; the lip seals above one",
        signed=True,
    )
    lip_stress: float | None = figure(
        "stress",
        SEAL,
        "largest equivalent (von Mises) stress in the lip between the least and the largest interference, without and "
        "under pressure",
    )
    lip_safety: float | None = figure("count", SEAL, "yield stress of the lip over lip stress")
    air_leakage: float | None = figure(
        "volume flow",
        SEAL,
        "of one dry lip at the pressure and the least interference, as air of the atmosphere; grease holds it back",
    )
    seal_wear: float | None = figure(
        "wear rate", SEAL, "depth that the lip loses per distance at the lip contact pressure"
    )
    seal_life: float | None = figure("distance", SEAL, "slid until the least interference is worn off", signed=True)
    # What a workshop makes.
    fill_factor: float | None = figure("fraction", WINDING, "share of the winding's window that is copper")
    winding_layers: float | None = figure(
        "count",
        WINDING,
        "layers of insulated wire in a coil, as a continuous number: turns times wire over the coil's width",
    )
    winding_room: float | None = figure(
        "length",
        WINDING,
        "radial room that the layers leave in the window, wires stacked in squares; below zero they do not fit",
        signed=True,
    )
    yoke_wall: float | None = figure("length", SIZE, "wall of the back yoke")
    cylinder_wall: float | None = figure("length", SIZE, "wall of the air cylinder")
    magnet_wall: float | None = figure("length", SIZE, "radial wall of the magnets: (D_m - D_s)/2")
    outer_diameter: float | None = figure("length", SIZE, "of the whole actuator")
    length: float | None = figure(
        "length", SIZE, "of the stator over its end caps; of a lead screw in the middle of the stroke"
    )
    # Coils in free space.
    stored_energy: float | None = figure("energy", FIELD, "of the magnetic field of all coils")
    central_flux_density: float | None = figure("flux density", FIELD, "on the axis at z = 0")
    stray_flux_density: float | None = figure(
        "flux density",
        FIELD,
        "root of the mean square over the points of the two lines on which the stray field is read",
    )
    winding_flux_density: float | None = figure("flux density", FIELD, "largest on the skin of any winding")
    quench_load: float | None = figure(
        "count",
        FIELD,
        "largest |J|/J_c + B/B_c of any winding, J_c and B_c being the superconductor's limits without field and "
        "without current; above one it quenches",
    )
    joule_loss: float | None = figure("power", HEAT, "of the current densities in the windings' conductor")
    merit: float | None = figure(
        "count",
        FIELD,
        "(stray flux density / its norm)^2 + |stored energy - its reference| / its reference, the objective of the "
        "TEAM workshop's problem 22",
    )


@dataclass(frozen=True, slots=True)
class Figure:
    """What a figure is: its dimension's name, SI unit, meaning, whether it can fall below zero, one of `GROUPS`."""

    name: str
    dimension: str
    si: str
    doc: str
    signed: bool
    group: str


SMALL_FIELD = 0.01
"""T, below which a flux density is shown in millitesla."""

HEAVY = 10.0
"""kg, from which a mass is shown in kilograms."""

_PLAIN = {"count": "1", "fraction": "1", "power": "W"}

_OF_KINDS = (*fields(LeadScrewFigures), *fields(HydrostaticFigures))

FIGURES: dict[str, Figure] = {
    item.name: Figure(
        item.name,
        item.metadata["dimension"],
        _PLAIN.get(item.metadata["dimension"]) or DIMENSIONS[item.metadata["dimension"]].si,
        item.metadata["doc"],
        item.metadata["signed"],
        item.metadata["group"],
    )
    for item in (*fields(Performance)[len(_OF_KINDS) :], *_OF_KINDS)
}
"""Every figure by name, in the order of the results table."""


def grouped(names: Iterable[str]) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """The figures under their headings, each in the order of `FIGURES`; headings without a figure are left out."""
    wanted = set(names)
    found = ((group, tuple(n for n, f in FIGURES.items() if f.group == group and n in wanted)) for group in GROUPS)
    return tuple((group, members) for group, members in found if members)


def to_mapping(performance: Performance) -> dict[str, float | None]:
    """Figure name -> value, in the order of `FIGURES`."""
    return {name: getattr(performance, name) for name in FIGURES}


def from_mapping(values: Mapping[str, float | None]) -> Performance:
    """The inverse of `to_mapping`; names that no longer exist are a TypeError, which a journal's hash rules out."""
    return Performance(**values)


def show_figure(name: str, value: float | None, digits: int = 5) -> str:
    """A figure in its preferred unit."""
    if value is None:
        return "-"
    figure = FIGURES[name]
    if figure.dimension == "fraction":
        return f"{100 * value:.{digits}g} %"
    if figure.dimension == "flux density" and 0 < abs(value) < SMALL_FIELD:
        return f"{1e3 * value:.{digits}g} mT"
    if figure.dimension == "mass" and abs(value) >= HEAVY:
        return f"{value:.0f} kg" if abs(value) >= 10**digits else f"{value:.{digits}g} kg"
    if figure.dimension in DIMENSIONS:
        return format_quantity(value, figure.dimension, digits)
    return f"{value:.{digits}g}" + ("" if figure.si == "1" else f" {figure.si}")
