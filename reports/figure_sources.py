"""Where the figures that follow in closed form come from: formula, source, and which given values they rest on.

The ranges of validity stand in the modules of `fluxbore.design` and in docs/constraints.md.
"""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.spec import Spec
from fluxbore.reports.wording import key_scale


@dataclass(frozen=True, slots=True)
class Source:
    """formula : in words or symbols. work : author and year; empty where it is a definition.

    rests_on : dotted keys whose values, where nobody gave them, are assumptions. assumed : what else is one.
    """

    formula: str
    work: str = ""
    rests_on: tuple[str, ...] = ()
    assumed: str = ""


_NETWORK = "Nakata and Noda 2023"
_LAME = "Lamé; Timoshenko and Goodier, Theory of Elasticity § 28"
_SEAL = tuple(f"actuator.seal.{name}" for name in ("static_coefficient", "coulomb_coefficient"))
_LIP = ("actuator.piston.fin_thickness", "actuator.piston.fin_material", "actuator.piston.fin_modulus")
_FIT = (
    "actuator.cylinder.bore_tolerance",
    "actuator.piston.fin_tolerance",
    "operating_point.coldest_temperature",
    "operating_point.hottest_temperature",
)
_ROUGH = ("actuator.seal.roughness", "actuator.seal.roughness_wavelength")
_SHELL = "after Hetényi 1946; Timoshenko and Woinowsky-Krieger 1959, ch. 15"
_HEAT = ("actuator.back_yoke.emissivity", "actuator.winding.insulation_conductivity")
_COOLING = "Mellor et al. 1991; Hashin and Shtrikman 1962; Churchill and Chu 1975"
_IRON = "coefficient of hysteresis, from handbooks"

_ROTLIN = "RotLin paper"
_CARRIED = ("actuator.carried_mass",)
_TURNED = ("actuator.motor.inertia",)

_PREHYDRA = "PREHydrA paper"
_STRIBECK = tuple(f"actuator.friction.{name}" for name in ("preload", "pressure_coefficient", "viscous_coefficient"))
_SPRING = ("actuator.return_spring.rate", "actuator.return_spring.preload")
_STROKE = ("actuator.output_cylinder.stroke",)
_LINE = (
    *(f"actuator.{name}.diameter" for name in ("port", "fitting", "pressure_block")),
    "actuator.hose.bore",
    "actuator.fluid.viscosity",
)
_MOVED = ("actuator.output_cylinder.moving_mass", "actuator.motor.inertia", "actuator.ball_screw.inertia")
_LOOPS = tuple(f"actuator.drive.{name}" for name in ("bandwidth", "integral_time", "force_period", "delay"))
_COLUMN = (
    "actuator.fluid.bulk_modulus",
    "actuator.fluid.air_fraction",
    "actuator.input_cylinder.dead_volume",
    "actuator.output_cylinder.dead_volume",
    "actuator.pressure_block.volume",
    "actuator.hose.bore",
)
_WORN = ("actuator.output_cylinder.mass", "actuator.return_spring.mass", "actuator.other_distal_mass")
_WALL = ("actuator.output_cylinder.wall_thickness",)
_ROD = ("actuator.output_cylinder.rod_diameter",)
_PARKER = "Parker O-Ring Handbook ORD 5700"
_CYCLE = "quasi-static over a period, or simulated in time"

SOURCES: dict[str, Source] = {
    "force_constant": Source("FEM: Maxwell's stress; network: equation (2)", _NETWORK),
    "force_constant_linkage": Source("3/2 (π/τ) λ_1"),
    "motor_constant": Source("K/√(3/2 R)"),
    "pneumatic_force_advance": Source("p π d²/4", "", ("actuator.cylinder.catalogue_bore",)),
    "pneumatic_force_retract": Source("p π (d² − D_s²)/4", "", ("actuator.cylinder.catalogue_bore",)),
    "saturation_ratio": Source("peak force/(K I)"),
    "peak_thrust": Source("pneumatic and electromagnetic force"),
    "electric_loading": Source("K_sp of equation (2)", _NETWORK),
    "back_emf": Source("2/3 K v"),
    "phase_inductance": Source("FEM: dλ/dI; network: current sheet beneath an ideal yoke", "after Bianchi et al. 2003"),
    "voltage_demand": Source("√((R I + E)² + (π v L I/τ)²)", "Hendershot and Miller 2010"),
    "voltage_margin": Source(
        "U_dc/√3 less the demand", "van der Broeck et al. 1988", ("operating_point.supply_voltage",)
    ),
    "no_load_speed": Source("E = U_dc/√3", "van der Broeck et al. 1988", ("operating_point.supply_voltage",)),
    "speed_limit": Source("demand = U_dc/√3", "van der Broeck et al. 1988", ("operating_point.supply_voltage",)),
    "demagnetisation_load": Source("‖H_reverse‖₈/H_cJ over the magnets' volume"),
    "copper_loss": Source("3/2 I² R"),
    "iron_loss": Source("k_h f Bⁿ and eddy currents of the solid yoke", "Steinmetz 1892", (), _IRON),
    "eddy_loss": Source("σ v² ∫B_r² dV over the cylinder's wall", "Saslow 1992"),
    "drag_force": Source("the two losses over v", "Saslow 1992; Steinmetz 1892", (), _IRON),
    "winding_temperature": Source("thermal network: winding, yoke, tube, caps, still air", _COOLING, _HEAT),
    "continuous_current": Source("I at the winding's limit of temperature", _COOLING, _HEAT),
    "continuous_thrust": Source("K times the continuous current", _COOLING, _HEAT),
    "hoop_stress": Source("p (b² + a²)/(b² − a²)", _LAME),
    "cylinder_safety": Source("yield stress over von Mises' stress at the bore", _LAME),
    "cap_safety": Source("weakest of tube, spigot and set screws over p π D²/4", "bearing and shear; ISO 3506-1"),
    "bore_dilation": Source("u(a) of the thick-walled tube", _LAME),
    "bore_clearance": Source("(D_c' − D_m)/2 + u(a)", _LAME),
    "shaft_stress": Source("peak thrust over the section"),
    "shaft_safety": Source("yield stress over shaft stress"),
    "buckling_force": Source(
        "π² E I/(K L)², or Johnson's parabola", "Euler; Johnson; Shigley", ("actuator.shaft.ends",)
    ),
    "buckling_safety": Source("buckling force over peak thrust", "Euler; Johnson; Shigley", ("actuator.shaft.ends",)),
    "seal_friction": Source("equation (6) with (4) and (5)", f"{_NETWORK}, Table IV", _SEAL),
    "seal_friction_variation": Source("equation (6) less itself without pressure", f"{_NETWORK}, Table IV", _SEAL),
    "fin_deformed_length": Source("equation (4)", _NETWORK),
    "fin_contact_area": Source("equation (5)", _NETWORK),
    "fin_interference": Source("(D_f − D_c')/2 at the worst of tolerances and temperatures", "", _FIT),
    "largest_interference": Source("(D_f − D_c')/2 at the other end of both", "", _FIT),
    "lip_contact_force": Source("clamped cone on the elastic foundation of its hoops", _SHELL, _LIP),
    "lip_contact_pressure": Source("lip contact force over equation (5)'s area", _SHELL, _LIP),
    "sealing_margin": Source("contact pressure at the least interference over p", _SHELL, (*_LIP, *_FIT)),
    "lip_stress": Source("von Mises, at the worst of interference and pressure", _SHELL, (*_LIP, *_FIT)),
    "lip_safety": Source("yield stress over lip stress", _SHELL, (*_LIP, *_FIT)),
    "air_leakage": Source(
        "π D_c' u³ (p₁² − p_a²)/(24 μ p_a Δl), u = u₀ ln(1 + β E*/p_c)",
        "after Persson 2007; Akarapu et al. 2011",
        (*_ROUGH, *_LIP, *_FIT),
    ),
    "seal_wear": Source("k p_c", "Archard 1953", ("actuator.seal.specific_wear", *_LIP)),
    "seal_life": Source("least interference over wear", "Archard 1953", ("actuator.seal.specific_wear", *_LIP, *_FIT)),
    "thrust_density": Source("(p A + K I)/V", "", ("actuator.reference_volume",)),
    "force_constant_density": Source("K/V", "", ("actuator.reference_volume",)),
    "fill_factor": Source("copper over the window's section"),
    "winding_layers": Source("turns × wire over the coil's width", "", ("actuator.winding.insulated_diameter",)),
    "winding_room": Source("height less the layers", "", ("actuator.winding.insulated_diameter",)),
    "stored_energy": Source("½ ∫J·A dV of rotationally symmetric coils"),
    "quench_load": Source("|J|/J_c + B/B_c", "Alotto et al. 1996, TEAM problem 22"),
    "merit": Source("(B_stray/B_norm)² + |E − E_ref|/E_ref", "Alotto et al. 1996, TEAM problem 22"),
    "stall_force": Source("FEM: Maxwell's stress; network: largest of Σ F_n sin(m_n x_d)", f"{_ROTLIN}, (7) to (10)"),
    "stall_force_density": Source("stall force over V", "", ("actuator.reference_volume",)),
    "stall_torque": Source("h F_stall", f"{_ROTLIN}, (6)"),
    "slip_margin": Source("F_stall/(F_load + M a)", "", ("operating_point.load_force", *_CARRIED)),
    "sudden_load_limit": Source("F with F x = ∫F_s dx where F = F_s(x) beyond the peak"),
    "stroke_end_force": Source(
        "F_stall times the overlap over p_a l_p/2", "", ("operating_point.stroke", "actuator.translator.length")
    ),
    "force_ripple": Source("helices of other leads that arcs of both members make, by Bessel functions, ideal iron"),
    "spring_constant": Source("dF/dx_d at x_d = 0", f"{_ROTLIN}, (1)"),
    "load_displacement": Source("F_s(x_d) = F_load", "", ("operating_point.load_force",)),
    "spring_energy": Source("∫F_s dx_d from 0 to l_p/2"),
    "slip_work": Source("F_load l_p", "", ("operating_point.load_force",)),
    "natural_frequency": Source("√(K_s/M)/2π", "", _CARRIED),
    "transfer_ratio": Source("1/h, h = lead/2π", f"{_ROTLIN}, (3)"),
    "motor_torque": Source(
        "h (F_load + M a) + J a/h + T_f",
        f"{_ROTLIN}, (4) to (6)",
        (
            *(f"operating_point.{name}" for name in ("load_force", "acceleration", "friction_torque")),
            *_CARRIED,
            *_TURNED,
        ),
    ),
    "motor_current": Source("motor torque over K_tn", "", ("actuator.motor.torque_constant",)),
    "back_driving_force": Source("T_f/h", "", ("operating_point.friction_torque",)),
    "largest_acceleration": Source("(F_stall − F_load)/M", "", ("operating_point.load_force", *_CARRIED)),
    "harmonic_ratio_2": Source("K_2/K_1 = F_3/F_1 of n = 1, 3, 5 …", f"{_ROTLIN}, (9)"),
    "harmonic_ratio_3": Source("K_3/K_1 = F_5/F_1", f"{_ROTLIN}, (9)"),
    "translator_iron_flux_density": Source("flux along the helix' normal over the iron's section, at x_d = 0"),
    "rotor_iron_flux_density": Source("flux along the helix' normal over the iron's section, at x_d = 0"),
    "rotor_inertia": Source("rings of magnets, iron, frame, fittings as drawn, and what the motor adds", "", _TURNED),
    "reflected_mass": Source("J/h²", "", _TURNED),
    "force_frequency_limit": Source("F f = ω_max i k/2π", f"{_PREHYDRA}, (4)", _SPRING[:1]),
    "stroke_force": Source("k x_max", "", (*_SPRING[:1], *_STROKE)),
    "force_at_rated_pressure": Source("A p"),
    "pushing_force": Source("A p − F_f(v_max, p)", f"{_PREHYDRA}, (1) and (2)", _STRIBECK),
    "force_efficiency": Source("F/(F + F_f)", f"{_PREHYDRA}, Sec. V", _STRIBECK),
    "force_efficiency_both": Source("F/(F + F_f + F_f,in A/A_in)", "", _STRIBECK),
    "specific_force_distal": Source("A p over the distal mass", "", _WORN),
    "specific_force_total": Source("A p over the total mass", "", _WORN),
    "maximum_velocity": Source("ω_max i A_in/A"),
    "speed_load": Source("2π f F/k over the largest", f"{_PREHYDRA}, (4)", _SPRING[:1]),
    "torque_load": Source(
        "largest over peak torque, or rms over continuous", "", ("actuator.motor.peak_torque", *_MOVED, *_LINE)
    ),
    "power_load": Source("mean |T ω| over the rated", "", (*_MOVED, *_LINE)),
    "stroke_load": Source("the way to F_0 + 2 F over the stroke", "", (*_STROKE, *_SPRING)),
    "pressure_load": Source(_CYCLE, "", _MOVED[:1]),
    "peak_pressure": Source(_CYCLE, "", _MOVED[:1]),
    "least_pressure": Source(_CYCLE, "", (*_SPRING[1:], *_MOVED[:1], *_LINE)),
    "line_pressure_drop": Source("orifices and hose by regime", "Merritt 1967; Haaland 1983", _LINE),
    "effective_bulk_modulus": Source("1/β = Σ V_i/(V β_i)", "Murnaghan 1944; Merritt 1967", _COLUMN),
    "burst_factor": Source("yield stress over √3 p K²/(K² − 1)", _LAME, _WALL, "the material’s yield stress"),
    "seal_squeeze": Source("1 − depth/W′", _PARKER, ("actuator.seal.ring_section",)),
    "seal_stretch": Source("groove’s floor over d_1, less one", _PARKER, ("actuator.seal.ring_section",)),
    "seal_fill": Source("π W′²/(4 b depth)", _PARKER, ("actuator.seal.ring_section",)),
    "minimum_friction": Source("least of (1) without pressure", f"{_PREHYDRA}, (1), Table I"),
    "friction_at_limit": Source("(1) and (2)", f"{_PREHYDRA}, Table I"),
    "tracking_error": Source("simulated in time", "", (*_LOOPS, *_MOVED, *_COLUMN)),
    "mean_tracking_error": Source("simulated in time", "", (*_LOOPS, *_MOVED, *_COLUMN)),
    "energy_imbalance": Source("what enters every port less what is stored and lost"),
    "fluid_temperature": Source(
        "losses in seals and line to still air",
        "Churchill and Chu 1975",
        ("operating_point.ambient_temperature", *_LINE),
        "emissivity 0.9; nothing into the frame",
    ),
    "distal_mass": Source("cylinder, springs, half of hose and fluid", "", (*_WORN, *_WALL, *_ROD)),
    "output_cylinder_mass": Source(
        "parts as drawn", "", ("actuator.output_cylinder.mass", *_WALL, *_ROD, "actuator.output_cylinder.cap_length")
    ),
    "fluid_volume": Source("stroke, dead volumes, hose and block", "", (*_STROKE, *_COLUMN[2:])),
}
"""By the figure's name; what is not here is a length, a mass or a value read from the field."""


def source_text(name: str) -> str:
    """Formula and work; empty for a figure that is read off."""
    found = SOURCES.get(name)
    return "" if found is None else f"{found.formula} ({found.work})" if found.work else found.formula


def assumptions(spec: Spec, name: str) -> str:
    """What the figure rests on that is assumed: marked so in the specification, taken by default, or in a material."""
    found = SOURCES.get(name)
    if found is None:
        return ""
    marked = {note.key for note in spec.notes if note.status == "assumed"}
    parts = [_value(spec, key, key in marked) for key in found.rests_on if key in spec.values]
    return "; ".join([*(part for part in parts if part), *([found.assumed] if found.assumed else [])])


def _value(spec: Spec, name: str, marked: bool) -> str:
    """``emissivity 0.1 (default)``; empty where the specification gives a value of its own without a doubt."""
    value, key = spec.values[name], spec.kind.known(name)
    taken = name not in spec.given or value == key.default
    if not marked and not taken:
        return ""
    shown = value if isinstance(value, str) else key_scale(spec, name, [float(value)]).quantity(float(value))
    return f"{key.leaf.replace('_', ' ')} {shown}{'' if marked else ' (default)'}"
