"""The keys of an electro-hydrostatic actuator's specification: the PREHydrA's Tables I and II, and what they leave out.

Components stand in the order in which power flows; each holds what its data sheet gives.
"""

from __future__ import annotations

from collections.abc import Mapping

from fluxbore.design.keys import Alternatives, Key
from fluxbore.design.materials import Material
from fluxbore.design.threads import PORTS, SCREWS, Thread
from fluxbore.design.tracking_benchmark_keys import TRACKING_BENCHMARK_KEYS

LARGEST_LENGTH = 10.0
"""m; beyond it a length is a slip of the unit, not an actuator."""

LEAST_SHARE = 1e-15
"""Of a key's largest value, the least of those that must exceed zero: below it squares and quotients have no number."""

LINEAR, CONSTANT, CORD = RETURN_ELEMENTS = ("linear spring", "constant force", "rubber cord")

CYLINDERS = ("input_cylinder", "output_cylinder")


def _quantity(
    name: str,
    doc: str,
    dimension: str,
    largest: float,
    *,
    symbol: str = "",
    zero: bool = False,
    default: float | None = None,
    optional: bool = False,
) -> Key:
    """From zero, or from next to it, to a largest value; required where it has no default and is not optional."""
    return Key(
        f"actuator.{name}",
        doc,
        dimension=dimension,
        symbol=symbol,
        minimum=0.0 if zero else LEAST_SHARE * largest,
        above=None if zero else 0.0,
        maximum=largest,
        default=default,
        optional=optional,
    )


def _length(
    name: str, doc: str, *, symbol: str = "", zero: bool = False, default: float | None = None, optional: bool = False
) -> Key:
    return _quantity(name, doc, "length", LARGEST_LENGTH, symbol=symbol, zero=zero, default=default, optional=optional)


def _mass(name: str, doc: str = "mass", *, optional: bool = False) -> Key:
    return _quantity(name, doc, "mass", 1e4, zero=True, default=None if optional else 0.0, optional=optional)


def _inertia(name: str, doc: str) -> Key:
    return _quantity(name, doc, "rotational inertia", 1e4, zero=True, default=0.0)


def _number(name: str, doc: str, least: float, largest: float, default: float, *, symbol: str = "") -> Key:
    return Key(f"actuator.{name}", doc, kind="number", symbol=symbol, minimum=least, maximum=largest, default=default)


def _word(name: str, doc: str, default: str | None = None, choices: tuple[str, ...] = ()) -> Key:
    return Key(f"actuator.{name}", doc, kind="word", default=default, choices=choices)


def _thread(name: str, doc: str, table: Mapping[str, Thread]) -> Key:
    return Key(f"actuator.{name}", doc, kind="word", choices=tuple(table), optional=True)


def _orifice(name: str, doc: str) -> tuple[Key, ...]:
    return (
        _length(f"{name}.diameter", f"clear bore of {doc}"),
        _number(f"{name}.discharge_coefficient", f"of {doc}", 0.05, 1.0, 0.7, symbol="C_d"),
    )


def _cylinder(name: str) -> tuple[Key, ...]:
    return (
        _length(f"{name}.bore", "bore"),
        _length(f"{name}.stroke", "stroke"),
        _length(f"{name}.wall_thickness", "wall of the tube"),
        _length(f"{name}.rod_diameter", "rod diameter"),
        _length(f"{name}.piston_length", "axial length of the piston", default=12e-3),
        _length(f"{name}.cap_length", "axial length of each end cap beyond the tube", default=15e-3),
        _length(f"{name}.bleed_thread", "thread of the bleed screw in the cap end", default=6e-3),
        _thread(f"{name}.mounting_thread", "tapped holes in the cap end's face to fix it by; without it none", SCREWS),
        _length(
            f"{name}.bush_wall", "wall of the rod's sliding bush; 0 where the cap bears the rod", zero=True, default=0.0
        ),
        _length(f"{name}.wiper_width", "axial, of the rod's wiper before the bush; 0 for none", zero=True, default=0.0),
        _quantity(f"{name}.dead_volume", "behind the piston at its end", "volume", 1.0, zero=True, default=0.0),
        _quantity(f"{name}.rated_pressure", "rated pressure", "pressure", 1e9),
        _mass(
            f"{name}.moving_mass",
            "piston, rod and what is fixed to them; without it that of piston and rod as drawn",
            optional=True,
        ),
        _mass(f"{name}.mass", "of the whole as catalogued; without it that of its parts as drawn", optional=True),
        _word(f"{name}.material", "of the tube and the caps", "brass"),
        _word(f"{name}.rod", "material of rod and piston", "stainless steel 304"),
    )


HYDROSTATIC_KEYS: tuple[Key, ...] = (
    Key(
        "actuator.name",
        "name of the design; STEP files and report carry it",
        kind="word",
        default="hydrostatic actuator",
    ),
    _quantity("motor.maximum_speed", "maximum mechanical speed", "angular frequency", 1e6, symbol="w_max"),
    _quantity("motor.continuous_torque", "continuous torque", "torque", 1e5),
    _quantity("motor.peak_torque", "peak torque", "torque", 1e5),
    _quantity("motor.rated_power", "rated mechanical power; without it no limit", "shaft power", 1e7, optional=True),
    _quantity("motor.torque_constant", "torque per ampere rms", "torque constant", 1e4, symbol="K_t"),
    _quantity("motor.resistance", "line to line", "resistance", 1e4, zero=True),
    _quantity("motor.inertia", "of the rotor", "rotational inertia", 1e4),
    _mass("motor.mass"),
    _quantity("drive.bandwidth", "of the velocity loop in the drive", "frequency", 1e5),
    _quantity("drive.integral_time", "of the velocity loop's PI controller", "time", 1e3),
    _quantity("drive.force_gain", "proportional gain of the force loop", "force gain", 1e3, symbol="k_p", zero=True),
    _quantity("drive.force_period", "between two samples of the force loop", "time", 1.0),
    _quantity("drive.delay", "from a sample to the drive's velocity command", "time", 1.0, zero=True, default=0.0),
    _mass("drive.mass"),
    _inertia("coupling.inertia", "of the coupling"),
    _mass("coupling.mass"),
    _length("ball_screw.lead", "lead: 2 pi i"),
    _number("ball_screw.efficiency", "driving", 0.51, 1.0, 0.9),
    _inertia("ball_screw.inertia", "of the screw"),
    _mass("ball_screw.mass"),
    # Equations (1) and (2), of either cylinder's seal.
    _quantity("friction.preload", "Coulomb friction without pressure", "force", 1e6, symbol="F_preload", zero=True),
    _quantity(
        "friction.pressure_coefficient", "Coulomb friction per pressure", "force per pressure", 1.0, symbol="f_C",
        zero=True,
    ),
    _quantity("friction.stribeck_force", "largest Stribeck force", "force", 1e6, symbol="F_S0", zero=True),
    _quantity("friction.stribeck_decay", "decay of the Stribeck force", "inverse speed", 1e9, symbol="c", zero=True),
    _quantity("friction.viscous_coefficient", "viscous friction", "viscous friction", 1e9, symbol="f_v", zero=True),
    _quantity("friction.linear_speed", "below which friction is linear in the speed", "speed", 1.0, default=1e-4),
    *_cylinder("input_cylinder"),
    *_orifice("port", "a cylinder's port"),
    _thread("port.thread", "of the cylinders' ports, for a connector; without it they are plain drillings", PORTS),
    *_orifice("fitting", "a hose's fitting"),
    _length("hose.bore", "bore"),
    _length("hose.length", "length"),
    _length("hose.roughness", "of the inside", zero=True, default=0.0),
    _quantity(
        "hose.wall_modulus",
        "pressure over the share by which the wall gives the hose more volume; without it the wall is stiff",
        "stress",
        1e15,
        optional=True,
    ),
    _quantity("hose.linear_mass", "mass per length", "linear mass", 1e4, zero=True, default=0.0),
    _quantity("hose.rated_pressure", "rated pressure; without it no limit", "pressure", 1e9, optional=True),
    _quantity("hose.burst_pressure", "burst pressure", "pressure", 1e9, optional=True),
    *_orifice("pressure_block", "the block's passage"),
    _quantity("pressure_block.volume", "of the block's passages", "volume", 1.0, zero=True, default=0.0),
    _mass("pressure_block.mass"),
    *_cylinder("output_cylinder"),
    _word("return_spring.element", "what pushes the output piston back", LINEAR, RETURN_ELEMENTS),
    _quantity("return_spring.rate", "of a linear spring", "stiffness", 1e12, symbol="k", optional=True),
    _quantity("return_spring.preload", "force with the piston retracted", "force", 1e7, zero=True, default=0.0),
    _mass("return_spring.mass", "of all springs or cords; without it that of the least steel spring", optional=True),
    _length("return_spring.cord_length", "unstrained length of a cord", optional=True),
    _quantity("return_spring.cord_area", "unstrained section of all cords together", "area", 1.0, optional=True),
    Key("actuator.return_spring.cord_stretch", "of a cord with the piston retracted", kind="number", minimum=1.0,
        maximum=3.0, optional=True),
    _quantity("return_spring.cord_first", "Mooney's first constant of the rubber", "stress", 1e9, symbol="C_1",
              optional=True),
    _quantity("return_spring.cord_second", "Mooney's second constant of the rubber", "stress", 1e9, symbol="C_2",
              zero=True, default=0.0),
    _quantity("series_spring.stiffness", "between piston and load; without it they are one", "stiffness", 1e12,
              optional=True),
    _quantity("fluid.density", "at the reference temperature", "density", 1e5),
    _quantity("fluid.bulk_modulus", "of the liquid without air", "stress", 1e12, symbol="B_0"),
    _number("fluid.modulus_rise", "of the bulk modulus with pressure", 1.5, 30.0, 6.0, symbol="m"),
    _number("fluid.air_fraction", "free air entrained, share of the volume without pressure", 0.0, 0.5, 0.0,
            symbol="a"),
    _number("fluid.air_exponent", "polytropic exponent of the air", 1.0, 1.67, 1.4, symbol="n"),
    _quantity("fluid.viscosity", "at the reference temperature", "dynamic viscosity", 1e3),
    _quantity("fluid.hot_viscosity", "at the hot temperature", "dynamic viscosity", 1e3),
    _quantity("fluid.reference_temperature", "of density and viscosity", "temperature", 1e3, default=293.15),
    _quantity("fluid.hot_temperature", "of the hot viscosity", "temperature", 1e3, default=333.15),
    _quantity("fluid.expansion", "cubic expansion", "temperature coefficient", 0.01, zero=True, default=0.0),
    Key(
        "actuator.fluid.vapour_pressure",
        "below which the fluid cavitates",
        dimension="pressure",
        minimum=-101_325.0,
        maximum=0.0,
        default=-98_987.0,
    ),
    _quantity("fluid.heat_capacity", "per mass", "heat capacity", 1e6, default=3400.0),
    # The piston's O-ring; without its groove one is drawn by the standard's rules.
    _length("seal.ring_section", "section of the piston's O-ring", symbol="W", default=1.78e-3),
    _length("seal.ring_inner_diameter", "of the free O-ring", symbol="d_1", optional=True),
    _length("seal.groove_diameter", "floor of its groove", optional=True),
    _length("seal.groove_width", "axial width of its groove", symbol="b", optional=True),
    _mass("other_distal_mass", "worn at the joint besides cylinder, springs and half of the hose"),
    Key("operating_point.force_amplitude", "of the sinusoidal force that is asked for, half its peak to peak",
        dimension="force", above=0.0, maximum=1e7, default=50.0),
    Key("operating_point.frequency", "of that force", dimension="frequency", above=0.0, maximum=1e3, default=4.0),
    Key("operating_point.least_force", "of that force", dimension="force", minimum=0.0, maximum=1e7, default=45.0),
    Key("operating_point.temperature", "of the fluid", dimension="temperature", above=0.0, maximum=1e3,
        default=293.15),
    Key("operating_point.ambient_temperature", "of the air", dimension="temperature", above=0.0, maximum=1e3,
        default=293.15),
    *TRACKING_BENCHMARK_KEYS,
)  # fmt: skip

HYDROSTATIC_ALTERNATIVES: tuple[Alternatives, ...] = ()

HYDROSTATIC_MATERIALS: dict[str, type[Material]] = {
    f"actuator.{name}.{leaf}": Material for name in CYLINDERS for leaf in ("material", "rod")
}
"""Which keys name materials, and the kind of material that each needs."""
