"""What holds a magnetic lead screw together, as parts: the translator's ends, the rotor's clamp rings and hubs, its
bearings, the motor's end shields; and what these add to the figures.

Bearings are envelopes, as the motor's stator is: their masses are part of what the specification says is carried, and
what turns of them is part of the motor's inertia.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from fluxbore.design.lead_screw_fittings import Fittings
from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.design.materials import Material
from fluxbore.design.units import format_quantity
from fluxbore.geometry.fits import fits, outline_of
from fluxbore.geometry.inertia import inertia
from fluxbore.geometry.lead_screw_layout import (
    CLEARANCE,
    EDGE,
    RotorFittings,
    TranslatorEnd,
    has_ends,
    innermost,
    rotor_fittings,
    translator_end,
)
from fluxbore.geometry.outline import Profile, rectangle, turned
from fluxbore.geometry.part import AxialHole, AxisThread, Colour, Fit, Part, mass

HOLES = 6
"""Screws of an end shield."""

SCREWED = 1.4
"""Least width of its skirt over a screw's hole; in a narrower one there is none."""

WORTH_BORING = 1e-9
"""Of the outside; where a bore is as wide as the spigot to a rounding, it is as wide."""

COLOURS: dict[str, Colour] = {
    "translator end": (0.76, 0.79, 0.83),
    "rotor clamp ring": (0.62, 0.47, 0.29),
    "rotor hub": (0.70, 0.73, 0.77),
    "bearing": (0.52, 0.54, 0.58),
    "end shield": (0.66, 0.69, 0.72),
}


@dataclass(frozen=True, slots=True)
class FittingParts:
    """fixed : on the translator. turning : on the rotor. carried : on the motor's stator, which does not turn."""

    fixed: tuple[Part, ...] = ()
    turning: tuple[Part, ...] = ()
    carried: tuple[Part, ...] = ()


@dataclass(frozen=True, slots=True)
class FittingMasses:
    """What the fittings add. fixed, moving : mass (kg), what is bored out of the translator for its ends taken off.
    inertia : about the axis, of what turns (kg m^2). diameter, length : over all of them, in mid-stroke (m)."""

    fixed: float = 0.0
    moving: float = 0.0
    inertia: float = 0.0
    diameter: float = 0.0
    length: float = 0.0


def fitting_parts(actuator: LeadScrewActuator, position: float = 0.0) -> FittingParts:
    """With the rotor's middle at a position (m); none where the specification wants none drawn.

    Raises DesignError where the bearing that is named does not fit.
    """
    fittings = actuator.fittings
    if fittings is None:
        return FittingParts()
    rotor = rotor_fittings(actuator, fittings)
    fixed: tuple[Part, ...] = ()
    if has_ends(actuator):
        end = translator_end(actuator, fittings, actuator.stroke / 2 + rotor.z_mover + CLEARANCE * rotor.r_frame)
        fixed = _pair(_translator_end(end, fittings, actuator.translator.body), 0.0)
    turning = (
        *_pair(_clamp_ring(rotor, actuator.rotor.body), position),
        *_pair(_hub(rotor, fittings.hub), position),
    )
    carried: tuple[Part, ...] = _pair(_bearing(rotor), position)
    if rotor.z_motor is not None:
        carried = (*carried, *_pair(_shield(rotor, fittings), position))
    return FittingParts(fixed, turning, carried)


def fitting_masses(actuator: LeadScrewActuator, materials: Mapping[str, Material]) -> FittingMasses:
    """Nothing where no fittings are drawn. Raises DesignError as `fitting_parts`."""
    if actuator.fittings is None:
        return FittingMasses()

    def weight(parts: tuple[Part, ...]) -> float:
        return sum(mass(part, materials[part.material].density) for part in parts if part.material)

    parts = fitting_parts(actuator)
    turned_round = sum(float(inertia(part, materials[part.material].density).tensor[2, 2]) for part in parts.turning)
    every = (*parts.fixed, *parts.turning, *parts.carried)
    bodies = {"translator carrier": actuator.translator.body, "translator iron": actuator.translator.iron}
    name, _ = innermost(actuator)
    bored = sum(turned(ring)[0] for ring in _bores(actuator))
    return FittingMasses(
        fixed=weight(parts.fixed) - (bored * materials[bodies[name]].density if name else 0.0),
        moving=weight(parts.turning) + weight(parts.carried),
        inertia=turned_round,
        diameter=2 * max(r for part in every for r, _ in part.profile),
        length=2 * max(z for part in every for _, z in part.profile),
    )


def seated(actuator: LeadScrewActuator, part: Part) -> Part:
    """A ring of the translator, bored out at both ends for the spigots where it is the one that they sit in."""
    if actuator.fittings is None or not has_ends(actuator) or part.name != innermost(actuator)[0]:
        return part
    end = translator_end(actuator, actuator.fittings, 0.0)
    inner, outer = part.profile[0][0], part.profile[1][0]
    low, high = part.profile[0][1], part.profile[2][1]
    profile = part.profile
    if end.r_spigot - inner > WORTH_BORING * outer:
        wide, deep = end.r_spigot, end.spigot
        profile = (
            (wide, low),
            (outer, low),
            (outer, high),
            (wide, high),
            (wide, high - deep),
            (inner, high - deep),
            (inner, low + deep),
            (wide, low + deep),
        )
    return replace(part, profile=profile, fits=(*fits(("bore", 2 * end.r_spigot, "H7")), *part.fits))


def _bores(actuator: LeadScrewActuator) -> tuple[Profile, ...]:
    """Rings that `seated` takes away."""
    fittings = actuator.fittings
    name, outer = innermost(actuator)
    if fittings is None or not has_ends(actuator) or not name:
        return ()
    end = translator_end(actuator, fittings, 0.0)
    inner = max(actuator.carrier_radius, 0.0) if name == "translator carrier" else _iron_bore(actuator)
    if end.r_spigot - inner <= WORTH_BORING * outer:
        return ()
    return (rectangle(inner, end.r_spigot, 0.0, end.spigot),) * 2


def _iron_bore(actuator: LeadScrewActuator) -> float:
    return max(actuator.shape.radii[0] - actuator.shape.translator.iron_thickness, 0.0)


def _pair(part: Part, position: float) -> tuple[Part, Part]:
    """A part for the upper end, and the same turned end for end for the lower one."""
    up = replace(
        part,
        name=f"{part.name}, upper",
        profile=tuple((r, z + position) for r, z in part.profile),
        axial_holes=tuple(
            replace(hole, start=hole.start + position, end=hole.end + position) for hole in part.axial_holes
        ),
    )
    down = replace(
        part,
        name=f"{part.name}, lower",
        profile=tuple((r, position - z) for r, z in reversed(part.profile)),
        axial_holes=tuple(
            replace(hole, start=position - hole.end, end=position - hole.start) for hole in part.axial_holes
        ),
    )
    return down, up


def _translator_end(end: TranslatorEnd, fittings: Fittings, material: str) -> Part:
    edge, thread = EDGE * end.r_stub, fittings.end_thread
    depth = 0.0 if thread is None else 2 * thread.diameter
    tapped = thread is not None and thread.diameter < end.r_stub and 2 * depth < end.z_end - end.z_stub
    middle = (
        ((thread.core / 2, end.z_end), (thread.core / 2, end.z_end - depth), (0.0, end.z_end - depth))
        if tapped and thread is not None
        else ((0.0, end.z_end),)
    )
    shoulder = ((end.r_inner, end.z_face), (end.r_inner, end.z_flange)) if end.z_flange > end.z_face else ()
    profile = outline_of(
        (0.0, end.z_face - end.spigot),
        (end.r_spigot, end.z_face - end.spigot),
        (end.r_spigot, end.z_face),
        *shoulder,
        (end.r_flange, end.z_flange),
        (end.r_flange, end.z_stub),
        (end.r_stub, end.z_stub),
        (end.r_stub, end.z_end - edge),
        (end.r_stub - edge, end.z_end),
        *middle,
    )
    note = "spigot bonded into the translator, flange clamps its magnets; outer end for a shaft holder"
    if tapped and thread is not None:
        note += f"; tapped in the middle {thread.tapped(depth)}"
    sizes = fits(("spigot", 2 * end.r_spigot, "h6"), ("shaft end", 2 * end.r_stub, "h6"))
    cut = (AxisThread(thread.core, thread.tapped(depth)),) if tapped and thread is not None else ()
    return replace(_part("translator end", "stator", material, profile, note, sizes), axis_threads=cut)


def _clamp_ring(rotor: RotorFittings, material: str) -> Part:
    profile = rectangle(rotor.r_clamp, rotor.r_iron, rotor.z_clamp - rotor.clamp, rotor.z_clamp)
    sizes = fits(("outside", 2 * rotor.r_iron, "h6"))
    return _part("rotor clamp ring", "mover", material, profile, "bonded before magnets and iron", sizes)


def _hub(rotor: RotorFittings, material: str) -> Part:
    """Spigot in the frame's bore, flange at its end, journal."""
    journal = rotor.bearing.bore / 2
    edge = min(EDGE * journal, (journal - rotor.r_hub) / 4, rotor.bearing.width / 4)
    start = rotor.z_frame - rotor.spigot
    spigot = ((rotor.r_hub, start), (rotor.r_iron, start), (rotor.r_iron, rotor.z_frame))
    profile = outline_of(
        *(spigot if rotor.spigot > WORTH_BORING * rotor.r_frame else ((rotor.r_hub, rotor.z_frame),)),
        (rotor.r_frame, rotor.z_frame),
        (rotor.r_frame, rotor.z_seat),
        (journal, rotor.z_seat),
        (journal, rotor.z_end - edge),
        (journal - edge, rotor.z_end),
        (rotor.r_hub, rotor.z_end),
    )
    sizes = fits(("spigot", 2 * rotor.r_iron, "h6"), ("journal", 2 * journal, "k6"))
    return _part("rotor hub", "mover", material, profile, "spigot bonded into the frame", sizes)


def _bearing(rotor: RotorFittings) -> Part:
    bearing = rotor.bearing
    profile = rectangle(bearing.bore / 2, bearing.outer_diameter / 2, rotor.z_seat, rotor.z_end)
    size = " x ".join(
        format_quantity(value, "length", 4) for value in (bearing.bore, bearing.outer_diameter, bearing.width)
    )
    name = f"deep groove ball bearing {bearing.designation}".strip()
    note = "envelope; its mass counts in actuator.carried_mass, what turns of it in actuator.motor.inertia"
    return replace(_part("bearing", "mover", "", profile, note), bought=f"{name}, {size}")


def _shield(rotor: RotorFittings, fittings: Fittings) -> Part:
    """A cup: skirt from the stator's end, web, ring around the bearing with a lip before it."""
    assert rotor.z_motor is not None
    end, outer = rotor.z_end + rotor.lip, rotor.r_shield
    edge = min(EDGE * outer, (outer - rotor.r_skirt) / 4, rotor.lip)
    profile = outline_of(
        (rotor.r_skirt, rotor.z_motor),
        (outer, rotor.z_motor),
        (outer, end - edge),
        (outer - edge, end),
        (rotor.r_lip, end),
        (rotor.r_lip, rotor.z_end),
        (rotor.r_seat, rotor.z_end),
        (rotor.r_seat, rotor.z_seat),
        (rotor.r_ring, rotor.z_seat),
        (rotor.r_ring, rotor.z_web),
        (rotor.r_skirt, rotor.z_web),
    )
    sizes = fits(("bearing seat", 2 * rotor.r_seat, "H7"))
    screw, holes = fittings.screw, tuple[AxialHole, ...]()
    if screw is not None and outer - edge - rotor.r_skirt > SCREWED * screw.clearance:
        angles = (math.tau * i / HOLES for i in range(HOLES))
        place = (outer - edge + rotor.r_skirt) / 2
        holes = tuple(AxialHole(place, screw.clearance, rotor.z_motor, end, angle) for angle in angles)
    note = "screwed to the motor's stator; the guides' carriages are fixed to it"
    return replace(_part("end shield", "mover", fittings.shield, profile, note, sizes), axial_holes=holes)


def _part(role: str, group: str, material: str, profile: Profile, note: str, sizes: tuple[Fit, ...] = ()) -> Part:
    return Part(role, role, group, material, COLOURS[role], profile, note=note, fits=sizes)
