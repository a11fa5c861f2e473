"""Where the fittings of a magnetic lead screw stand: what is given, and what is in proportion to the screw.

z runs along the axis from the middle of the member, of which both halves are alike. From there outwards:

    translator   magnets on iron and carrier | flange that clamps them | stub, to beyond the mover's reach | grip
    rotor        magnets and iron | clamp ring in the frame's bore | ... | hub: spigot in the frame, flange, journal
    motor        stator | end shield with the bearing's seat, a lip before it

What has no key is a share of a length of the screw's, so that anything that can be built has fittings and no figure
jumps. Lengths in m.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.errors import DesignError
from fluxbore.design.lead_screw import HelicalMagnets, LeadScrew
from fluxbore.design.lead_screw_fittings import Fittings
from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.design.rolling_bearings import Bearing, in_proportion
from fluxbore.design.units import format_quantity

CLAMP, SPIGOT, CLEARANCE, LIP, ROUNDED = 0.08, 0.15, 0.03, 0.06, 0.04
"""Of R_r: clamp rings and the hub's spigot, axially; between what turns and what does not; the shield's lip; the width
over which the larger of two lengths takes over from the other."""

FLANGE, GRIP = 0.08, 1.5
"""Of R_t, axially: the flange at the translator's ends, and what its holders take."""

STUB = 0.65
"""Radius of the stubs over the inside of the translator's magnets: thinner, so that the rotor's parts pass freely."""

BORED = 0.5
"""Radius of the ends' spigots over the outside of what they sit in, where that has no bore or a narrower one."""

OVER_MAGNETS = 0.75
"""Share of the magnets' thickness that is clamped; the rest keeps rings and flange off the gap."""

SEATED = 1.1
"""Least outside of a shield over its bearing's seat."""

RING, SKIRT = 0.3, 0.45
"""Radial, of the shield's ring around the bearing and of its skirt, over what there is between bearing and outside."""

EDGE = 0.05
"""Chamfers, of the radius."""

LEAST_INSIDE = 1e-3
"""Of R_t: magnets that reach closer to the axis are a bar without ends."""

THINNEST = 1e-10
"""m; a ring of less is not drawn."""


def overhang(shape: LeadScrew, member: HelicalMagnets) -> float:
    """By how much whole arcs may stick out of their member's length at either end; none of what is cut flat."""
    if member.arcs is None:
        return 0.0
    rise = 0.0 if member.arcs.stepped else shape.starts * shape.pitch * member.arcs.angle / math.tau
    return (member.magnet_width + rise) / 2


def larger(first: float, second: float, width: float) -> float:
    """Smooth in both, and more than either by some of `width` where they are alike."""
    return (first + second + math.hypot(first - second, width)) / 2


@dataclass(frozen=True, slots=True)
class RotorFittings:
    """Of one end of rotor and motor: radii r_... and heights z_... . clamp : of the ring; spigot : length of the hub's.

    z_clamp : outer face of the clamp ring, z_frame : the hub's shoulder, z_seat : where the bearing begins, z_motor :
    the stator's end, None where no motor is described.
    """

    r_clamp: float
    r_iron: float
    r_frame: float
    r_hub: float
    clamp: float
    spigot: float
    z_clamp: float
    z_frame: float
    z_seat: float
    bearing: Bearing
    z_motor: float | None
    r_motor: float

    @property
    def z_end(self) -> float:
        """End of hub and bearing."""
        return self.z_seat + self.bearing.width

    @property
    def lip(self) -> float:
        return LIP * self.r_frame

    @property
    def z_mover(self) -> float:
        """End of all that moves."""
        return self.z_end + (0.0 if self.z_motor is None else self.lip)

    @property
    def r_seat(self) -> float:
        """Of the bearing in its shield."""
        return self.bearing.outer_diameter / 2

    @property
    def r_lip(self) -> float:
        """Bore of the lip that holds the bearing's outer ring."""
        journal = self.bearing.bore / 2
        return journal + 0.7 * (self.r_seat - journal)

    @property
    def r_free(self) -> float:
        """Where the shield may begin beside what turns."""
        return max(self.r_seat, (1 + CLEARANCE) * self.r_frame)

    @property
    def r_shield(self) -> float:
        return max(self.r_motor, SEATED * self.r_free)

    @property
    def r_ring(self) -> float:
        """Outside of the shield's ring around the bearing."""
        return self.r_seat + RING * (self.r_shield - self.r_free)

    @property
    def r_skirt(self) -> float:
        """Inside of the shield's skirt."""
        return self.r_shield - SKIRT * (self.r_shield - self.r_free)

    @property
    def z_web(self) -> float:
        """Inner face of the shield's web."""
        whole = self.bearing.width + self.lip
        return self.z_end + self.lip - min(2 * self.lip, whole / 2)


def rotor_fittings(actuator: LeadScrewActuator, fittings: Fittings) -> RotorFittings:
    """Raises DesignError where the bearing that is named does not fit between gap and frame."""
    shape = actuator.shape
    gap, outside = shape.bore_radius, shape.frame_radius
    clamp = CLAMP * outside if fittings.clamp_length is None else fittings.clamp_length
    z_clamp = shape.active_length / 2 + overhang(shape, shape.rotor) + clamp
    z_frame = max(shape.frame_length / 2, z_clamp)
    room, longest = z_frame - z_clamp, SPIGOT * outside
    bearing = in_proportion(gap + outside) if fittings.bearing is None else fittings.bearing
    r_hub = gap + (shape.rotor_iron_radius - gap) / 4
    if not 2 * r_hub < bearing.bore < 2 * outside:
        raise DesignError(
            f"actuator.rotor.bearing must have a bore between {_mm(2 * r_hub)}, of the rotor's hubs, and "
            f"actuator.rotor.outer_radius {_mm(2 * outside)} across; got {bearing.designation} with "
            f"{_mm(bearing.bore)}."
        )
    z_motor = None if actuator.motor_length is None else actuator.motor_length / 2
    return RotorFittings(
        r_clamp=gap + (1 - OVER_MAGNETS) * (shape.rotor_magnet_radius - gap),
        r_iron=shape.rotor_iron_radius,
        r_frame=outside,
        r_hub=r_hub,
        clamp=clamp,
        # As long as there is room for, and no longer than is worth it.
        spigot=room * longest / (room + longest),
        z_clamp=z_clamp,
        z_frame=z_frame,
        z_seat=larger(z_frame, z_motor or 0.0, ROUNDED * outside) + CLEARANCE * outside,
        bearing=bearing,
        z_motor=z_motor,
        r_motor=0.0 if actuator.motor_radius is None else actuator.motor_radius,
    )


@dataclass(frozen=True, slots=True)
class TranslatorEnd:
    """Of one end: radii and heights. spigot : length of what sits in the bore of radius r_spigot."""

    r_spigot: float
    r_inner: float
    r_flange: float
    r_stub: float
    spigot: float
    z_face: float
    z_flange: float
    z_stub: float
    z_end: float


def translator_end(actuator: LeadScrewActuator, fittings: Fittings, reach: float) -> TranslatorEnd:
    """reach : how far the mover's end comes from the translator's middle (m)."""
    shape = actuator.shape
    inner, outside = shape.radii[:2]
    face = shape.translator_length / 2
    flange = face + overhang(shape, shape.translator)
    stub = flange + FLANGE * outside
    grip = GRIP * outside if fittings.end_grip is None else fittings.end_grip
    carrier = max(actuator.carrier_radius, BORED * innermost(actuator)[1])
    room = shape.translator_length / 3
    return TranslatorEnd(
        r_spigot=carrier,
        r_inner=inner,
        r_flange=inner + OVER_MAGNETS * (outside - inner),
        r_stub=STUB * inner,
        spigot=room * carrier / (room + carrier),
        z_face=face,
        z_flange=flange,
        z_stub=stub,
        z_end=larger(stub, reach, ROUNDED * outside) + grip,
    )


def has_ends(actuator: LeadScrewActuator) -> bool:
    """Whether there is anything within the translator's magnets that an end could sit in."""
    inner, outside = actuator.shape.radii[:2]
    return inner > LEAST_INSIDE * outside


def innermost(actuator: LeadScrewActuator) -> tuple[str, float]:
    """What the ends' spigots sit in, and its outside (m): carrier, iron, or the magnets themselves ("")."""
    inner = actuator.shape.radii[0]
    iron = inner - actuator.shape.translator.iron_thickness
    if iron - actuator.carrier_radius > THINNEST:
        return "translator carrier", iron
    return ("translator iron", inner) if inner - iron > THINNEST else ("", actuator.carrier_radius)


def _mm(length: float) -> str:
    return format_quantity(length, "length", 6)
