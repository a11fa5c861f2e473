"""The keys of a hybrid actuator's specification (Nakata and Noda 2023, Tables II and III, and what they leave out)."""

from __future__ import annotations

from fluxbore.design.air_ports import AIR_PORTS
from fluxbore.design.contact_force_keys import CONTACT_FORCE_KEYS
from fluxbore.design.hybrid_operating_keys import OPERATING_KEYS
from fluxbore.design.keys import Alternatives, Key
from fluxbore.design.materials import Conductor, Material, PermanentMagnet
from fluxbore.design.seal_keys import FIN_KEYS, SEAL_KEYS
from fluxbore.design.solver_keys import solver_keys
from fluxbore.design.threads import SCREWS

LARGEST_LENGTH = 10.0
"""m; beyond it a length is a slip of the unit, not an actuator."""


def _length(name: str, symbol: str, doc: str, *, default: float | None = None, zero: bool = False) -> Key:
    above, minimum = (None, 0.0) if zero else (0.0, None)
    return Key(
        f"actuator.{name}", doc, symbol=symbol, above=above, minimum=minimum, maximum=LARGEST_LENGTH, default=default
    )


def _optional_length(name: str, doc: str) -> Key:
    return Key(f"actuator.{name}", doc, above=0.0, maximum=LARGEST_LENGTH, optional=True)


def _material(name: str, doc: str) -> Key:
    return Key(f"actuator.{name}", doc, kind="word")


HYBRID_KEYS: tuple[Key, ...] = (
    Key("actuator.name", "name of the design; STEP files and report carry it", kind="word", default="hybrid actuator"),
    Key(
        "actuator.reference_volume",
        "volume on which the thrust densities are based; without it that of the back yoke's envelope",
        dimension="volume",
        above=0.0,
        maximum=1e3,
        optional=True,
    ),
    _length("back_yoke.outer_diameter", "D", "back yoke outer diameter"),
    _length("back_yoke.inner_diameter", "D_i", "back yoke inner diameter"),
    _length("back_yoke.thickness", "(D - D_i)/2", "back yoke thickness"),
    _length("back_yoke.length", "L", "back yoke length"),
    _length("back_yoke.front_overhang", "L_f", "back yoke beyond the winding at the rod end", zero=True),
    _length("back_yoke.back_overhang", "L_b", "back yoke beyond the winding at the cap end", zero=True),
    _material("back_yoke.material", "soft iron of the back yoke"),
    _length(
        "back_yoke.lead_hole",
        "",
        "hole for the winding's leads in the back overhang; at most half of the overhang is drilled",
        default=4e-3,
        zero=True,
    ),
    Key(
        "actuator.back_yoke.emissivity",
        "of the actuator's outside for heat radiation: 0.1 for bright metal and plating, 0.9 for paint",
        kind="number",
        minimum=0.0,
        maximum=1.0,
        default=0.1,
    ),
    _length("winding.outer_diameter", "D_w", "winding outer diameter"),
    _length("winding.yoke_clearance", "(D_i - D_w)/2", "radial room between winding and yoke for the leads", zero=True),
    Key("actuator.winding.sets_per_phase", "coils of each phase", kind="integer", symbol="n_w", minimum=1, maximum=200),
    Key("actuator.winding.turns", "turns of one phase", kind="number", symbol="N", above=0.0, maximum=1e6),
    Key(
        "actuator.winding.turns_density",
        "turns per area of the winding's cross-section",
        dimension="area density",
        above=0.0,
    ),
    _length("winding.wire_diameter", "", "bare diameter of the wire"),
    _optional_length(
        "winding.insulated_diameter", "diameter of the wire with its enamel; without it 1.1 x the bare one"
    ),
    Key(
        "actuator.winding.insulation_conductivity",
        "thermal conductivity of enamel, varnish and whatever else fills the winding",
        dimension="thermal conductivity",
        above=0.0,
        maximum=1e3,
        default=0.2,
    ),
    _material("winding.material", "conductor of the winding"),
    _length("cylinder.outer_diameter", "D_c", "air cylinder outer diameter; the winding sits on it"),
    _length("cylinder.inner_diameter", "D_c'", "air cylinder bore as drawn: for the field and the CAD"),
    Key(
        "actuator.cylinder.bore_tolerance",
        "bore tolerance, the total width of the field in whose middle inner_diameter lies; 0.027 mm is H8",
        minimum=0.0,
        maximum=1e-2,
        default=0.027e-3,
    ),
    _length("cylinder.catalogue_bore", "", "nominal bore of the catalogue cylinder: for the pneumatic forces"),
    _length("cylinder.length", "", "length of the cylinder tube"),
    _material("cylinder.material", "material of the cylinder tube"),
    Key(
        "actuator.cylinder.ends",
        "closed where the tube itself holds the end caps against the pressure, open where tie rods do",
        kind="word",
        choices=("closed", "open"),
        default="closed",
    ),
    _length("mover.pole_pitch", "tau", "pole pitch"),
    _length("mover.ring_width", "tau_f", "axial thickness of the soft-magnetic rings between the magnets", zero=True),
    _length("mover.magnet_thickness", "tau_m", "axial thickness of a magnet"),
    Key(
        "actuator.mover.pole_pairs", "pole pairs of the magnet array", kind="integer", symbol="p", minimum=1, maximum=50
    ),
    _length("mover.outer_diameter", "D_m", "magnet and ring outer diameter"),
    _material("mover.magnet", "magnet grade: temperature coefficients, coercivity, density"),
    Key(
        "actuator.mover.remanence",
        "remanence at 20 degC; without it the grade's",
        dimension="flux density",
        symbol="B_r",
        above=0.0,
        maximum=2.0,
        optional=True,
    ),
    Key(
        "actuator.mover.magnet_permeability",
        "relative recoil permeability of the magnets; without it the grade's",
        kind="number",
        symbol="mu_r",
        minimum=1.0,
        maximum=10.0,
        optional=True,
    ),
    _optional_length(
        "mover.longest_magnet",
        "longest magnet made and magnetised in one piece; longer ones are bonded of equal rings. Without it any length",
    ),
    _material("mover.ring_material", "soft iron of the rings"),
    _length("mover.stroke", "L_mr", "stroke length"),
    _length("shaft.outer_diameter", "D_s", "shaft outer diameter"),
    _length("shaft.length", "L_s", "shaft length"),
    _material("shaft.material", "shaft material; a magnetic one short-circuits the magnets"),
    Key(
        "actuator.shaft.ends",
        "how the rod's free length is held for buckling, the cap's side first",
        kind="word",
        choices=("fixed-free", "pinned-pinned", "fixed-pinned", "fixed-fixed"),
        default="fixed-free",
    ),
    _length("piston.length", "", "axial length of each piston"),
    _length("piston.fin_outer_diameter", "D_f", "seal fin outer diameter, before it is pressed into the bore"),
    _length("piston.fin_inner_diameter", "d", "seal fin inner diameter, at its root"),
    _length("piston.fin_length", "l", "seal fin axial length"),
    _length("piston.fin_thickness", "", "seal fin wall thickness"),
    _material("piston.material", "material of piston and seal fin"),
    *FIN_KEYS,
    *SEAL_KEYS,
    _length("end_caps.flange_diameter", "", "outer diameter of the end caps"),
    _length("end_caps.flange_length", "", "axial length of an end cap outside the tube"),
    _length("end_caps.port_diameter", "", "diameter of the air port in each end cap, drilled plain"),
    Key(
        "actuator.end_caps.port_thread",
        "thread of the air port in each end cap; the flow bore beneath it follows",
        kind="word",
        choices=tuple(AIR_PORTS),
    ),
    _length("end_caps.rod_clearance", "", "radial clearance of the rod-end cap around the shaft", zero=True),
    _length(
        "end_caps.nose_length",
        "",
        "of the rod-end cap beyond its flange: room for the rod's seal and bush",
        default=0.0,
        zero=True,
    ),
    Key(
        "actuator.end_caps.ring_section",
        "section of the O-rings on the spigots and around the rod; thinner ones are taken where room is short",
        above=0.0,
        maximum=7e-3,
        default=1.5e-3,
    ),
    Key(
        "actuator.end_caps.screw_thread",
        "of the set screws through the tube into each spigot",
        kind="word",
        choices=tuple(SCREWS),
        default="M3",
    ),
    Key(
        "actuator.end_caps.screws",
        "set screws in each spigot; 0 where the caps are bonded",
        kind="integer",
        minimum=0,
        maximum=24,
        default=4,
    ),
    Key(
        "actuator.end_caps.mounting_thread",
        "of the mounting holes in the cap end's flange",
        kind="word",
        choices=tuple(SCREWS),
        default="M3",
    ),
    Key(
        "actuator.end_caps.mounting_holes",
        "threaded holes along the axis in the cap end's flange",
        kind="integer",
        minimum=0,
        maximum=24,
        default=4,
    ),
    _material("end_caps.material", "material of the end caps"),
    *OPERATING_KEYS,
    *solver_keys("position"),
    Key(
        "solver.factorisation",
        "sparse factorisation",
        kind="word",
        choices=("banded", "superlu"),
        default="banded",
    ),
    *CONTACT_FORCE_KEYS,
)

HYBRID_ALTERNATIVES: tuple[Alternatives, ...] = (
    Alternatives(
        ("actuator.back_yoke.outer_diameter", "actuator.back_yoke.inner_diameter", "actuator.back_yoke.thickness"),
        2,
        "D = D_i + 2 thickness",
    ),
    Alternatives(
        ("actuator.back_yoke.length", "actuator.back_yoke.front_overhang", "actuator.back_yoke.back_overhang"),
        2,
        "L = L_f + L_b + the winding's length, 3 n_w coils of 2 tau / 3",
    ),
    Alternatives(
        ("actuator.winding.outer_diameter", "actuator.winding.yoke_clearance"), 1, "D_w = D_i - 2 yoke_clearance"
    ),
    Alternatives(
        ("actuator.winding.turns", "actuator.winding.turns_density"), 1, "turns = density x the phase's window area"
    ),
    Alternatives(("actuator.mover.ring_width", "actuator.mover.magnet_thickness"), 1, "tau_m = tau - tau_f"),
    Alternatives(
        ("actuator.end_caps.port_diameter", "actuator.end_caps.port_thread"), 1, "a threaded port has its own flow bore"
    ),
)

HYBRID_MATERIALS: dict[str, type[Material]] = {
    "actuator.back_yoke.material": Material,
    "actuator.winding.material": Conductor,
    "actuator.cylinder.material": Material,
    "actuator.mover.magnet": PermanentMagnet,
    "actuator.mover.ring_material": Material,
    "actuator.shaft.material": Material,
    "actuator.piston.material": Material,
    "actuator.piston.fin_material": Material,
    "actuator.end_caps.material": Material,
}
"""Which keys name materials, and the kind of material that each needs."""

HYBRID_NON_MAGNETIC = frozenset(
    {"actuator.piston.material", "actuator.piston.fin_material", "actuator.end_caps.material"}
)
"""Parts that the field model takes for air."""
