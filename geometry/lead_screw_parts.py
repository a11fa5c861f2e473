"""The parts of a magnetic lead screw (the RotLin paper's Figs. 1 to 3 and 5): members with helical magnets on iron.

What is drawn, and what is not:

- the translator lies still with its middle at z = 0: magnets outside, iron and a carrier within, all of one length;
- the rotor stands at the position, turned by position/h, so that magnets of one polarity face one another (x_d = 0: no
  force, and stable). Its magnets are as long as its poles, as is the iron; the frame around them has its own length;
- continuous magnets are cut flat at both ends of that length: a line along the axis crosses as many poles as the
  specification says, and the mass is that of the model's rings;
- arcs are whole and alike. They stand wherever a middle lies within the length, so that those at the ends overhang it
  by up to half of their own; a length of whole pitches has as many as the helix in it. Both members' helices then are
  half an arc's rise off the middle, so that the rotor overhangs as far at either end;
- the motor's stator is an envelope. What holds all that together is drawn where the specification says so
  (`fluxbore.geometry.lead_screw_fittings`); the guides, which are not on the axis, and the motor's magnets are not.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from fluxbore.design.errors import DesignError
from fluxbore.design.lead_screw import Arcs, HelicalMagnets, LeadScrew
from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.design.units import format_quantity
from fluxbore.geometry import helix, unrolled
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.fits import fits
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.lead_screw_fittings import fitting_parts, seated
from fluxbore.geometry.outline import RESOLUTION, rectangle
from fluxbore.geometry.part import Body, Colour, Part

COLOURS: dict[str, Colour] = {
    "N": (0.72, 0.18, 0.16),
    "S": (0.16, 0.36, 0.66),
    "iron": (0.45, 0.47, 0.50),
    "carrier": (0.76, 0.79, 0.83),
    "frame": (0.70, 0.55, 0.35),
    "motor stator": (0.60, 0.65, 0.71),
}

OUTWARDS = {"N": "outwards", "S": "inwards"}

WHOLE_HELIX = "to be made of bonded arcs: no helix is pressed or magnetised as a whole"

NOTES = {"motor stator": "envelope", "rotor iron": "bonded into the frame", "translator iron": "carries the magnets"}

MOST_TURNS = 2000
"""Of one helix around its member; each is some twenty faces of a STEP file."""

MOST_MAGNETS = 4000
"""Pieces of one member."""

SLACK = 1e-9
"""m. Rounding allowed where a position is compared with the ends of the stroke."""


@dataclass(frozen=True, slots=True)
class _Member:
    """What its magnets need: radii, length along the axis and where its middle is (m), turned by an angle (rad)."""

    name: str
    group: str
    magnet: str
    shape: HelicalMagnets
    inner_radius: float
    outer_radius: float
    length: float
    position: float = 0.0
    angle: float = 0.0


def assembly(actuator: LeadScrewActuator, position: float = 0.0) -> Assembly:
    """All parts with the rotor's middle at this position (m) from the translator's, the spring at rest.

    The translator, which lies still, comes first. Raises DesignError where the magnets are too many to draw and where
    the position is beyond the stroke.
    """
    shape, held = actuator.shape, fitting_parts(actuator, position)
    reach = actuator.stroke / 2
    if not abs(position) <= reach + SLACK:
        raise DesignError(
            f"The position must lie within the stroke, {_mm(-reach)} to {_mm(reach)}; got {_mm(position)}."
        )
    inner, outer, bore, rim = shape.radii
    iron, turned = inner - shape.translator.iron_thickness, position / shape.h
    translator = _Member(
        "translator", "stator", actuator.translator.magnet, shape.translator, inner, outer, shape.translator_length
    )
    rotor = _Member(
        "rotor", "mover", actuator.rotor.magnet, shape.rotor, bore, rim, shape.active_length, position, turned
    )
    parts = [
        *_ring(actuator, "translator carrier", actuator.carrier_radius, iron, 0.0, shape.translator_length),
        *_ring(actuator, "translator iron", iron, inner, 0.0, shape.translator_length),
        *_magnets(actuator, translator),
        *held.fixed,
        *_magnets(actuator, rotor),
        *_ring(actuator, "rotor iron", rim, shape.rotor_iron_radius, position, shape.active_length),
        *_ring(actuator, "rotor frame", shape.rotor_iron_radius, shape.frame_radius, position, shape.frame_length),
        *held.turning,
    ]
    if actuator.motor_radius is not None and actuator.motor_length is not None:
        parts += _ring(
            actuator, "motor stator", shape.frame_radius, actuator.motor_radius, position, actuator.motor_length
        )
    parts += held.carried
    return Assembly(actuator.name, tuple(parts), position, outside="mover", carried_mass=actuator.shape.carried_mass)


def _ring(
    actuator: LeadScrewActuator, name: str, inner: float, outer: float, middle: float, length: float
) -> list[Body]:
    """A turned part; none where there is no thickness."""
    if outer - inner < RESOLUTION:
        return []
    materials = {
        "translator carrier": actuator.translator.body,
        "translator iron": actuator.translator.iron,
        "rotor iron": actuator.rotor.iron,
        "rotor frame": actuator.rotor.body,
    }
    group = "stator" if name.startswith("translator") else "mover"
    colour = COLOURS[name if name in COLOURS else name.split()[-1]]
    profile = rectangle(max(inner, 0.0), outer, middle - length / 2, middle + length / 2)
    part = Part(name, name, group, materials.get(name, ""), colour, profile, note=NOTES.get(name, ""))
    return [seated(actuator, replace(part, fits=fits(*_sizes(name, max(inner, 0.0), outer))))]


def _sizes(name: str, inner: float, outer: float) -> tuple[tuple[str, float, str], ...]:
    """Feature, diameter (m) and tolerance class of what slides into one another when the screw is put together."""
    if name == "rotor iron":
        return (("outside", 2 * outer, "h6"),)
    if name == "rotor frame":
        return (("bore", 2 * inner, "H7"),)
    return (("outside", 2 * outer, "h9"),) if name.startswith("translator") else ()


def _magnets(actuator: LeadScrewActuator, member: _Member) -> list[Body]:
    """North and south of every start, continuous or in arcs. North is magnetised outwards."""
    shape, arcs = actuator.shape, member.shape.arcs
    lead, offset = shape.starts * shape.pitch, _offset(shape)
    _check_number(member, shape.pitch, shape.starts)
    found: list[Body] = []
    for polarity, shift in (("N", 0.0), ("S", shape.pitch / 2)):
        middles = [start * shape.pitch + shift + offset for start in range(shape.starts)]
        if arcs is None:
            role, pieces = (
                f"{member.name} magnet {polarity}",
                [helix.band(lead, member.shape.magnet_width, middle, member.length) for middle in middles],
            )
        else:
            role, pieces = f"{member.name} arc {polarity}", _pieces(member, arcs, lead, middles)
        digits = len(str(len(pieces)))
        for i, outline in enumerate(pieces):
            name = role if len(pieces) == 1 else f"{role} {i + 1:0{digits}d}"
            found.append(_piece(member, name, role, polarity, lead, outline))
    return found


def _offset(shape: LeadScrew) -> float:
    """Along the axis (m), of the north helices' middles from the members': the same for both, so that x_d stays 0."""
    arcs = shape.rotor.arcs or shape.translator.arcs
    return 0.0 if arcs is None else shape.starts * shape.pitch / (2 * arcs.per_turn)


def _pieces(member: _Member, arcs: Arcs, lead: float, middles: list[float]) -> list[unrolled.Outline]:
    """Arcs of all helices of one polarity, from the lower end of the member on."""
    places = [place for middle in middles for place in helix.places(lead, middle, arcs.per_turn, member.length)]
    slope, width = 0.0 if arcs.stepped else lead, member.shape.magnet_width
    return [helix.arc(slope, width, arcs.angle, *place) for place in sorted(places, key=lambda place: place[1])]


def _piece(member: _Member, name: str, role: str, polarity: str, lead: float, outline: unrolled.Outline) -> Body:
    arcs = member.shape.arcs
    note = f"magnetised {OUTWARDS[polarity]}; {WHOLE_HELIX if arcs is None else 'bonded'}"
    if arcs is not None and arcs.stepped:
        if arcs.angle >= unrolled.TURN - unrolled.FLAT:
            low, high = unrolled.heights(unrolled.moved(outline, 0.0, member.position))
            profile = rectangle(member.inner_radius, member.outer_radius, low, high)
            return Part(name, role, member.group, member.magnet, COLOURS[polarity], profile, note=note)
        lead = 0.0
    return HelicalPart(
        name,
        role,
        member.group,
        member.magnet,
        COLOURS[polarity],
        member.inner_radius,
        member.outer_radius,
        unrolled.moved(outline, member.angle, member.position),
        lead=lead,
        note=note,
    )


def _check_number(member: _Member, pitch: float, starts: int) -> None:
    """Raise DesignError where nobody would wait for the drawing."""
    turns, arcs = member.length / (pitch * starts), member.shape.arcs
    if turns > MOST_TURNS:
        raise DesignError(
            f"actuator.pitch must be at least {_mm(member.length / (MOST_TURNS * starts))}, or a helix winds more than "
            f"{MOST_TURNS} times around the {member.name}; got {_mm(pitch)}."
        )
    pieces = 2 * starts * (1 if arcs is None else max(1, math.ceil(turns * arcs.per_turn)))
    if pieces > MOST_MAGNETS:
        key, value = ("starts", starts) if arcs is None else (f"{member.name}.arcs_per_turn", arcs.per_turn)
        raise DesignError(
            f"actuator.{key} must not cut the {member.name}'s magnets into more than {MOST_MAGNETS} pieces, and "
            f"{value} make {pieces}."
        )


def _mm(length: float) -> str:
    return format_quantity(length, "length", 6)
