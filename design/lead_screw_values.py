"""From a specification's values to a lead screw's parameters."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.keys import Value, Values
from fluxbore.design.lead_screw import Arcs, HelicalMagnets, LeadScrew
from fluxbore.design.lead_screw_fittings import Fittings, fittings_of
from fluxbore.design.lead_screw_keys import CONTINUOUS, MEMBERS, STEPPED_ARCS
from fluxbore.design.materials import Library, Material, PermanentMagnet, SoftIron, lookup
from fluxbore.design.units import format_quantity

ROUNDING = 1e-9
"""Relative; a thickness that falls short by no more is as thick as it must be."""


@dataclass(frozen=True, slots=True)
class Member:
    """What one member is made of: names of materials, and what was measured in place of the grade's (None: its own)."""

    magnet: str
    iron: str
    body: str
    remanence: float | None
    permeability: float | None


@dataclass(frozen=True, slots=True)
class LeadScrewActuator:
    """A magnetic lead screw with what carries and turns it, SI units.

    shape : its dimensions, with magnets of 1 T; `magnetised` gives it those of its grades. carrier_radius : inside of
    the translator, 0 where it is solid. motor_radius, motor_length : the stator's, None where it is not described.
    fittings : what holds it together; None where that is not drawn.
    """

    name: str
    shape: LeadScrew
    translator: Member
    rotor: Member
    carrier_radius: float
    motor_radius: float | None
    motor_length: float | None
    motor_inertia: float
    torque_constant: float | None
    reference_volume: float | None
    stroke: float
    fittings: Fittings | None = None

    def magnetised(self, library: Library, temperature: float) -> LeadScrew:
        """The screw with the remanences at a temperature (K) and the densities of its materials.

        Raises MaterialError for a name that no material has, and where the heat leaves nothing of a remanence.
        """
        shape, frame = self.shape, lookup(self.rotor.body, "actuator.rotor.frame", library, Material)
        return replace(
            shape,
            translator=_filled(shape.translator, "translator", self.translator, library, temperature),
            rotor=_filled(shape.rotor, "rotor", self.rotor, library, temperature),
            frame_density=frame.density,
        )


def resolve(given: Values) -> dict[str, Value]:
    """Complete the given keys by those that follow from them.

    The third of the radii R_t, R_r and the frame's thickness, the rotor's length or what it exceeds its poles by, the
    translator's thickness or its carrier's (both down to the axis where neither is given), the magnets' width or their
    share of half a pitch (all of it where neither is given), and a stroke over which all poles are engaged.

    Plain arithmetic, no conversions: values may be complex, so that a step along the imaginary axis gives exact
    derivatives of all that follows. Raises nothing; what cannot be built is `from_values`'s.
    """
    values: dict[str, Any] = dict(given)
    _resolve_radii(values)
    half_pitch = values["actuator.pitch"] / 2
    engaged = values["actuator.poles"] * half_pitch
    if "actuator.rotor.length" not in values:
        values["actuator.rotor.length"] = engaged + values["actuator.rotor.overhang"]
    else:
        values["actuator.rotor.overhang"] = _rest(values["actuator.rotor.length"], engaged)
    for member in MEMBERS:
        width, fill = f"actuator.{member}.magnet_width", f"actuator.{member}.magnet_fill"
        if width in values:
            values[fill] = 1.0 - _rest(half_pitch, values[width]) / half_pitch
        else:
            values.setdefault(fill, 1.0)
            values[width] = values[fill] * half_pitch
    values.setdefault("operating_point.stroke", values["actuator.translator.length"] - engaged)
    if "benchmark.force.position_count" in values:
        lead = values["actuator.starts"] * values["actuator.pitch"]
        values.setdefault("benchmark.force.angle_count", values["benchmark.force.position_count"] * math.tau / lead)
    return values


def _resolve_radii(values: dict[str, Any]) -> None:
    """Radially, from the axis outwards."""

    def depth(member: str) -> Any:
        return values[f"actuator.{member}.magnet_thickness"] + values[f"actuator.{member}.iron_thickness"]

    inside, outside, frame = (
        "actuator.translator.outer_radius",
        "actuator.rotor.outer_radius",
        "actuator.rotor.frame_thickness",
    )
    between = values["actuator.gap"] + depth("rotor")
    if outside not in values:
        values[outside] = values[inside] + between + values[frame]
    elif inside not in values:
        values[inside] = values[outside] - between - values[frame]
    else:
        values[frame] = _rest(values[outside], between + values[inside])
    thickness, carrier = "actuator.translator.thickness", "actuator.translator.carrier_thickness"
    if thickness in values:
        values[carrier] = _rest(values[thickness], depth("translator"))
    elif carrier in values:
        values[thickness] = values[carrier] + depth("translator")
    else:
        values[thickness] = values[inside]
        values[carrier] = _rest(values[inside], depth("translator"))


def _rest(whole: Any, part: Any) -> Any:
    """The difference, exactly zero where it is one of rounding: a thickness of -1e-19 m is none that can be given."""
    rest = whole - part
    return rest - rest.real if abs(rest.real) <= ROUNDING * abs(whole.real) else rest


def check(values: Values) -> None:
    """Raise SpecError where the arcs or the motor are described in part, DesignError where nothing can be built."""
    for member in MEMBERS:
        form = values[f"actuator.{member}.magnets"]
        for leaf in ("arc_angle", "arcs_per_turn"):
            key = f"actuator.{member}.{leaf}"
            if form != CONTINUOUS and key not in values:
                raise SpecError(f'{key} is missing: actuator.{member}.magnets is "{form}".')
            if form == CONTINUOUS and key in values:
                raise SpecError(f'{key} must not be given where actuator.{member}.magnets is "{CONTINUOUS}".')
    pair = ("actuator.motor.outer_radius", "actuator.motor.length")
    given = [key for key in pair if key in values]
    if len(given) == 1:
        missing = next(key for key in pair if key not in values)
        raise SpecError(f"{missing} is missing: it is needed with {given[0]}.")
    from_values(values)


def from_values(values: Values) -> LeadScrewActuator:
    """The parameters of the resolved values. Raises DesignError, one sentence, where they cannot be built."""
    number = _Reader(values)
    shape = LeadScrew(
        pitch=number("pitch"),
        poles=int(number("poles")),
        translator_radius=number("translator.outer_radius"),
        gap=number("gap"),
        translator=_shape(values, number, "translator"),
        rotor=_shape(values, number, "rotor"),
        translator_length=number("translator.length"),
        frame_radius=number("rotor.outer_radius"),
        frame_length=number("rotor.length"),
        starts=int(number("starts")),
        gap_tolerance=number("gap_tolerance"),
        carried_mass=number("carried_mass"),
    )
    motor_radius = number.optional("motor.outer_radius")
    if motor_radius is not None and motor_radius < shape.frame_radius:
        raise DesignError(
            "actuator.motor.outer_radius must not be below actuator.rotor.outer_radius "
            f"{_mm(shape.frame_radius)}; got {_mm(motor_radius)}."
        )
    return LeadScrewActuator(
        name=str(values["actuator.name"]),
        shape=shape,
        translator=_member(values, number, "translator", "carrier"),
        rotor=_member(values, number, "rotor", "frame"),
        carrier_radius=_carrier_radius(shape, number.optional("translator.thickness")),
        motor_radius=motor_radius,
        motor_length=number.optional("motor.length"),
        motor_inertia=number("motor.inertia"),
        torque_constant=number.optional("motor.torque_constant"),
        reference_volume=number.optional("reference_volume"),
        stroke=float(values["operating_point.stroke"]),
        fittings=fittings_of(values),
    )


@dataclass(frozen=True, slots=True)
class _Reader:
    """Numbers of the section `actuator` by the rest of their keys."""

    values: Values

    def __call__(self, name: str) -> float:
        return float(self.values[f"actuator.{name}"])

    def optional(self, name: str) -> float | None:
        value = self.values.get(f"actuator.{name}")
        return None if value is None else float(value)


def _shape(values: Values, number: _Reader, member: str) -> HelicalMagnets:
    """A member's magnets by their dimensions, 1 T until their grade is known."""
    form, arcs = values[f"actuator.{member}.magnets"], None
    if form != CONTINUOUS:
        arcs = Arcs(number(f"{member}.arc_angle"), int(number(f"{member}.arcs_per_turn")), form == STEPPED_ARCS)
    return HelicalMagnets(
        magnet_thickness=number(f"{member}.magnet_thickness"),
        magnet_width=number(f"{member}.magnet_width"),
        remanence=1.0,
        arcs=arcs,
        iron_thickness=number(f"{member}.iron_thickness"),
    )


def _member(values: Values, number: _Reader, member: str, body: str) -> Member:
    def word(leaf: str) -> str:
        return str(values[f"actuator.{member}.{leaf}"])

    return Member(
        word("magnet"),
        word("iron"),
        word(body),
        number.optional(f"{member}.remanence"),
        number.optional(f"{member}.magnet_permeability"),
    )


def _carrier_radius(shape: LeadScrew, thickness: float | None) -> float:
    """Inside of the translator (m)."""
    if thickness is None:
        return 0.0
    least = shape.translator.magnet_thickness + shape.translator.iron_thickness
    if thickness < least * (1 - ROUNDING):
        raise DesignError(
            f"actuator.translator.thickness must hold its magnets and iron, {_mm(least)}; got {_mm(thickness)}."
        )
    if thickness > shape.translator_radius * (1 + ROUNDING):
        raise DesignError(
            f"actuator.translator.thickness must not exceed actuator.translator.outer_radius "
            f"{_mm(shape.translator_radius)}; got {_mm(thickness)}."
        )
    return max(0.0, shape.translator_radius - thickness)


def _filled(magnets: HelicalMagnets, name: str, member: Member, library: Library, temperature: float) -> HelicalMagnets:
    grade = lookup(member.magnet, f"actuator.{name}.magnet", library, PermanentMagnet)
    iron = lookup(member.iron, f"actuator.{name}.iron", library, SoftIron)
    return replace(
        magnets,
        remanence=grade.remanence_at(temperature, member.remanence),
        magnet_permeability=grade.recoil(member.permeability),
        magnet_density=grade.density,
        iron_density=iron.density,
    )


def _mm(length: float) -> str:
    return format_quantity(length, "length")
