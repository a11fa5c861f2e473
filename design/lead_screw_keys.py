"""The keys of a magnetic lead screw's specification: the RotLin paper's Tables I and II, and what they leave out."""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.force_benchmark_keys import FORCE_BENCHMARK_KEYS
from fluxbore.design.keys import Alternatives, Key, Values
from fluxbore.design.lead_screw_fittings import FITTING_KEYS, FITTING_MATERIALS, FITTING_NON_MAGNETIC
from fluxbore.design.materials import Material, PermanentMagnet, SoftIron
from fluxbore.design.solver_keys import solver_keys

LARGEST_LENGTH = 10.0
"""m; beyond it a length is a slip of the unit, not an actuator."""

LARGEST_MASS = 1e4
"""kg."""

CONTINUOUS, HELICAL_ARCS, STEPPED_ARCS = MAGNET_FORMS = ("continuous", "helical arcs", "stepped arcs")
"""How a member's magnets are cut: not at all, along the helix, or as sectors of rings that climb in steps."""

MEMBERS = ("translator", "rotor")


@dataclass(frozen=True, slots=True)
class AtMostOne(Alternatives):
    """Alternatives of which none need be given."""

    @property
    def demand(self) -> str:
        return "at most one"

    def check(self, given: Values) -> None:
        """Raise SpecError where more of the keys are given than one."""
        if any(key in given for key in self.keys):
            Alternatives.check(self, given)


def _length(name: str, symbol: str, doc: str, *, optional: bool = False) -> Key:
    return Key(f"actuator.{name}", doc, symbol=symbol, above=0.0, maximum=LARGEST_LENGTH, optional=optional)


def _zero_length(name: str, symbol: str, doc: str, *, given: bool = False) -> Key:
    """From zero; that of alternatives where it must be ``given`` to count."""
    return Key(
        f"actuator.{name}",
        doc,
        symbol=symbol,
        minimum=0.0,
        maximum=LARGEST_LENGTH,
        default=None if given else 0.0,
        optional=given,
    )


def _word(name: str, doc: str, default: str | None = None) -> Key:
    return Key(f"actuator.{name}", doc, kind="word", default=default)


def _magnets(member: str) -> tuple[Key, ...]:
    """What either member's magnets and the iron behind them are described by."""
    return (
        _length(f"{member}.magnet_thickness", "l_m", "radial thickness of the magnets"),
        _length(
            f"{member}.magnet_width",
            "w",
            "axial width of one magnet; without it half the pitch, so that neighbours touch",
            optional=True,
        ),
        Key(
            f"actuator.{member}.magnet_fill",
            "share of half the pitch that a magnet is wide",
            kind="number",
            above=0.0,
            maximum=1.0,
            optional=True,
        ),
        _word(f"{member}.magnet", "magnet grade: temperature coefficients, coercivity, density"),
        Key(
            f"actuator.{member}.remanence",
            "remanence at 20 degC; without it the grade's",
            dimension="flux density",
            symbol="B_rem",
            above=0.0,
            maximum=2.0,
            optional=True,
        ),
        Key(
            f"actuator.{member}.magnet_permeability",
            "relative recoil permeability of the magnets; without it the grade's",
            kind="number",
            symbol="mu_r",
            minimum=1.0,
            maximum=10.0,
            optional=True,
        ),
        Key(
            f"actuator.{member}.magnets",
            "how the magnets are cut: continuous helices, arcs along the helix, or sectors of rings in steps",
            kind="word",
            choices=MAGNET_FORMS,
            default=CONTINUOUS,
        ),
        Key(
            f"actuator.{member}.arc_angle",
            "angle of one arc about the axis, where the magnets are cut",
            dimension="angle",
            above=0.0,
            maximum=6.283185307179587,
            optional=True,
        ),
        Key(
            f"actuator.{member}.arcs_per_turn",
            "arcs in one turn, where the magnets are cut",
            kind="integer",
            minimum=1,
            maximum=1000,
            optional=True,
        ),
        _zero_length(f"{member}.iron_thickness", "", "soft iron behind the magnets, radially; 0 where there is none"),
        _word(f"{member}.iron", "soft iron behind the magnets", "1010"),
    )


LEAD_SCREW_KEYS: tuple[Key, ...] = (
    Key("actuator.name", "name of the design; STEP files and report carry it", kind="word", default="lead screw"),
    Key(
        "actuator.reference_volume",
        "volume on which the stall force density is based; without it that of the rotor's envelope",
        dimension="volume",
        above=0.0,
        maximum=1e3,
        optional=True,
    ),
    _length("pitch", "l_p", "along the axis, from one magnet to the next of the same polarity"),
    Key("actuator.starts", "helices of each polarity", kind="integer", minimum=1, maximum=1000, default=1),
    Key(
        "actuator.poles",
        "poles of the rotor along the axis; two fill a pitch",
        kind="integer",
        symbol="p_a",
        minimum=1,
        maximum=10_000,
    ),
    _length("gap", "l_g", "radial air gap between the members' magnets"),
    _zero_length(
        "gap_tolerance", "", "by how much radii, bearings and a bent translator may close the gap, all together"
    ),
    Key(
        "actuator.carried_mass",
        "whatever moves along the axis with the rotor and does not turn",
        dimension="mass",
        minimum=0.0,
        maximum=LARGEST_MASS,
        default=0.0,
    ),
    _length("translator.outer_radius", "R_t", "outside of the translator's magnets"),
    _length("translator.length", "", "of the translator's magnets along the axis"),
    _length(
        "translator.thickness",
        "l_t",
        "radial: magnets, iron and the carrier within; without it the translator is solid to the axis",
        optional=True,
    ),
    _zero_length(
        "translator.carrier_thickness",
        "",
        "radial, of the carrier within the translator's magnets and iron",
        given=True,
    ),
    _word("translator.carrier", "within the magnets and the iron; must not be magnetic", "aluminium 6061"),
    *_magnets("translator"),
    _length("rotor.outer_radius", "R_r", "outside of the rotor's frame"),
    _zero_length("rotor.frame_thickness", "", "radial, of the frame around the rotor's magnets and iron", given=True),
    _length("rotor.length", "", "of the rotor's frame along the axis"),
    _zero_length("rotor.overhang", "", "by how much the frame is longer than the rotor's poles, in all", given=True),
    *_magnets("rotor"),
    _word("rotor.frame", "around the magnets and the iron; must not be magnetic", "phenolic paper"),
    _length("motor.outer_radius", "R_s", "of the stator that turns the rotor: envelope only", optional=True),
    _length("motor.length", "l_s", "of the stator that turns the rotor: envelope only", optional=True),
    Key(
        "actuator.motor.torque_constant",
        "torque per ampere of the motor that turns the rotor",
        dimension="torque constant",
        symbol="K_tn",
        above=0.0,
        maximum=1e4,
        optional=True,
    ),
    Key(
        "actuator.motor.inertia",
        "of whatever turns with the rotor and is not described here: the motor's magnets, encoder, bearings",
        dimension="rotational inertia",
        minimum=0.0,
        maximum=1e4,
        default=0.0,
    ),
    Key(
        "operating_point.load_force",
        "against which the mover drives",
        dimension="force",
        minimum=0.0,
        maximum=1e7,
        default=0.0,
    ),
    Key(
        "operating_point.acceleration",
        "of the mover with its load, for the motor's peak torque",
        dimension="acceleration",
        minimum=0.0,
        maximum=1e5,
        default=0.0,
    ),
    Key(
        "operating_point.friction_torque",
        "of the rotor's bearings and cogging, against which the load must drive back",
        dimension="torque",
        minimum=0.0,
        maximum=1e5,
        default=0.0,
    ),
    Key(
        "operating_point.stroke",
        "between the mover's ends; without it as far as all the rotor's poles are engaged",
        minimum=0.0,
        maximum=LARGEST_LENGTH,
        optional=True,
    ),
    Key(
        "operating_point.magnet_temperature",
        "temperature of the magnets, for remanence and coercivity",
        dimension="temperature",
        above=0.0,
        maximum=1000.0,
        default=293.15,
    ),
    *FITTING_KEYS,
    *solver_keys("displacement"),
    *FORCE_BENCHMARK_KEYS,
)

LEAD_SCREW_ALTERNATIVES: tuple[Alternatives, ...] = (
    Alternatives(
        ("actuator.translator.outer_radius", "actuator.rotor.outer_radius", "actuator.rotor.frame_thickness"),
        2,
        "R_r = R_t + gap + the rotor's magnets and iron + frame_thickness",
    ),
    Alternatives(("actuator.rotor.length", "actuator.rotor.overhang"), 1, "length = poles x l_p / 2 + overhang"),
    AtMostOne(
        ("actuator.translator.thickness", "actuator.translator.carrier_thickness"),
        1,
        "thickness = the translator's magnets and iron + carrier_thickness",
    ),
    *(
        AtMostOne((f"actuator.{member}.magnet_width", f"actuator.{member}.magnet_fill"), 1, "width = fill x l_p / 2")
        for member in MEMBERS
    ),
)

LEAD_SCREW_MATERIALS: dict[str, type[Material]] = {
    "actuator.translator.magnet": PermanentMagnet,
    "actuator.translator.iron": SoftIron,
    "actuator.translator.carrier": Material,
    "actuator.rotor.magnet": PermanentMagnet,
    "actuator.rotor.iron": SoftIron,
    "actuator.rotor.frame": Material,
    **FITTING_MATERIALS,
}
"""Which keys name materials, and the kind of material that each needs."""

LEAD_SCREW_NON_MAGNETIC = frozenset({"actuator.translator.carrier", "actuator.rotor.frame"}) | FITTING_NON_MAGNETIC
"""Keys that must not name a soft iron."""
