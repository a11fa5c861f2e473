"""The hydraulic cylinders of an electro-hydrostatic actuator as turned parts, and what they weigh.

Tube, cap end with port and bleed screw, rod-end cap with the rod's bearing and a vent, piston with its O-ring, rod;
`fluxbore.geometry.hydrostatic_layout` says where they stand. Both cylinders are drawn alike; the export shows the
output's, which is the one that is sized. Threads are plain cylinders of their nominal diameter and the hexagon of the
bleed screw is round; connector, hose and return element are not drawn.
"""

from __future__ import annotations

import math

from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic_keys import CYLINDERS
from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.materials import Library
from fluxbore.design.return_spring_mass import least_mass
from fluxbore.design.units import format_quantity
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.gland_profile import ring_profile
from fluxbore.geometry.hydrostatic_layout import RELIEF, SHANK, CylinderLayout, layout
from fluxbore.geometry.mass import part_masses, total
from fluxbore.geometry.measure import Detail, Measure, along, diameter
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Colour, Hole, Part

OUTPUT = "output_cylinder"

RING_MATERIAL, SCREW_MATERIAL = "NBR 70", "stainless steel 304"
"""Of the O-ring and the bleed screw, as they are bought."""

NIPPLE_END = 1.9
"""Thread diameters that the bleed screw sticks out by."""

SLACK = 1e-9
"""m; rounding allowed where a position is compared with the ends of the stroke."""

COLOURS: dict[str, Colour] = {
    "cylinder tube": (0.80, 0.66, 0.34),
    "end cap": (0.70, 0.55, 0.26),
    "bleed screw": (0.45, 0.47, 0.50),
    "piston": (0.62, 0.64, 0.67),
    "O-ring": (0.13, 0.13, 0.14),
    "rod": (0.84, 0.84, 0.82),
}


def assembly(design: HydrostaticDesign, position: float, cylinder: str = OUTPUT) -> Assembly:
    """One cylinder with its piston at a position (m) from the cap end.

    Raises DesignError where the parts do not fit one another or the position is beyond the stroke.
    """
    place, shape = layout(design, cylinder), design.shapes[cylinder]
    if not -SLACK <= position <= place.stroke + SLACK:
        raise DesignError(
            f"The position must lie within the stroke, 0 mm to {format_quantity(place.stroke, 'length', 6)}; "
            f"got {format_quantity(position, 'length', 6)}."
        )
    tube = rectangle(place.r_bore, place.r_outside, *place.tube)
    return Assembly(
        design.name,
        (
            Part("cylinder tube", "cylinder", "stator", shape.material, COLOURS["cylinder tube"], tube),
            _cap_end(place, shape.material),
            _bleed_screw(place),
            _rod_end(place, shape.material),
            _piston(place, shape.rod, position),
            _ring(place, position),
            _rod(place, shape.rod, position),
        ),
        position,
        measures=_measures(place, position),
        details=(_gland_detail(place, position),),
    )


def masses(design: HydrostaticDesign, library: Library) -> dict[str, float]:
    """Every mass (kg) that `design` leaves to its parts as drawn, by its name: what `design.weighed` takes.

    moving_mass : piston, O-ring and rod. mass : of the whole cylinder, these with it. return_spring.mass : of the
    lightest spring or cord that does it. Raises DesignError where a cylinder that is to be weighed does not fit.
    """
    found: dict[str, float] = {}
    for name in CYLINDERS:
        wanted = [leaf for leaf in ("moving_mass", "mass") if f"{name}.{leaf}" in design.unweighed]
        if wanted:
            rows = part_masses(assembly(design, 0.0, name), library)
            drawn = {"moving_mass": total(rows, "mover"), "mass": total(rows)}
            found.update({f"{name}.{leaf}": drawn[leaf] for leaf in wanted})
    if "return_spring.mass" in design.unweighed:
        found["return_spring.mass"] = least_mass(design.bare.return_element, design.bare.output_cylinder.stroke)
    return found


def _cap_end(place: CylinderLayout, material: str) -> Part:
    """Outwards, towards -z: spigot, flange; inside it passage, neck, seat and thread."""
    shoulder, outside = place.tube[0], place.ends[0]
    profile = (
        (place.r_passage, place.z_passage),
        (place.r_neck, place.z_passage),
        (place.r_neck, place.z_seat),
        (place.r_thread, place.z_seat - (place.r_thread - place.r_neck)),
        (place.r_thread, outside),
        (place.r_outside, outside),
        (place.r_outside, shoulder),
        (place.r_bore, shoulder),
        (place.r_bore, 0.0),
        (place.r_passage, 0.0),
    )
    port = (Hole(place.z_port, 2 * place.r_port),)
    return Part("end cap, cap end", "end cap", "stator", material, COLOURS["end cap"], profile, port)


def _bleed_screw(place: CylinderLayout) -> Part:
    """Closed. Its slim part begins at the seat's cone; a cross-hole leads from there to the bore of the nipple."""
    outside, wide = place.ends[0], 2 * place.r_thread
    slim, bore = SHANK * wide, 0.15 * wide
    cone = place.z_seat - (slim - place.r_neck)
    thread, cross = cone - RELIEF * wide, cone - RELIEF * wide / 2
    hexagon, nipple, end = (outside - share * wide for share in (0.3, 0.9, NIPPLE_END))
    profile = (
        (0.0, cross),
        (bore, cross),
        (bore, end),
        (0.35 * wide, end),
        (0.35 * wide, nipple),
        (0.65 * wide, nipple),
        (0.65 * wide, hexagon),
        (place.r_thread, hexagon),
        (place.r_thread, thread),
        (slim, thread),
        (slim, cone),
        (place.r_neck, place.z_seat),
        (0.0, place.z_seat),
    )
    hole = (Hole(cross, 0.2 * wide, math.pi / 2),)
    name = "bleed screw"
    return Part(name, name, "stator", SCREW_MATERIAL, COLOURS[name], profile, hole, _thread(wide))


def _rod_end(place: CylinderLayout, material: str) -> Part:
    shoulder, outside = place.tube[1], place.ends[1]
    profile = (
        (place.r_relief, place.z_front),
        (place.r_bore, place.z_front),
        (place.r_bore, shoulder),
        (place.r_outside, shoulder),
        (place.r_outside, outside),
        (place.r_bearing, outside),
        (place.r_bearing, place.z_relief),
        (place.r_relief, place.z_relief),
    )
    vent = (Hole(place.z_vent, 2 * place.r_vent),)
    return Part("end cap, rod end", "end cap", "stator", material, COLOURS["end cap"], profile, vent)


def _piston(place: CylinderLayout, material: str, position: float) -> Part:
    """From its pressure face backwards: crown, land, groove, land; behind, the hole for the rod's end."""
    outer, floor, inner = place.r_piston, place.gland.groove_diameter / 2, place.r_rod_spigot
    seat, back = position + place.piston_length - place.rod_seat, position + place.piston_length
    low, high = (position + (place.piston_length + side * place.gland.groove_width) / 2 for side in (-1, 1))
    profile = (
        (0.0, position),
        (outer, position),
        (outer, low),
        (floor, low),
        (floor, high),
        (outer, high),
        (outer, back),
        (inner, back),
        (inner, seat),
        (0.0, seat),
    )
    return Part("piston", "piston", "mover", material, COLOURS["piston"], profile)


def _ring(place: CylinderLayout, position: float) -> Part:
    gland = place.gland
    size = [format_quantity(value, "length", 4) for value in (gland.ring_inner_diameter, gland.ring_section)]
    profile = ring_profile(gland, position + place.piston_length / 2)
    note = f"free ring {size[0]} x {size[1]}, drawn as squeezed"
    return Part("O-ring", "O-ring", "mover", RING_MATERIAL, COLOURS["O-ring"], profile, note=note)


def _rod(place: CylinderLayout, material: str, position: float) -> Part:
    back = position + place.piston_length
    start = back - place.rod_seat
    profile = (
        (0.0, start),
        (place.r_rod_spigot, start),
        (place.r_rod_spigot, back),
        (place.r_rod, back),
        (place.r_rod, start + place.rod_length),
        (0.0, start + place.rod_length),
    )
    return Part("rod", "rod", "mover", material, COLOURS["rod"], profile)


def _measures(place: CylinderLayout, position: float) -> tuple[Measure, ...]:
    """What the cylinder is made by; those across stand in the empty chamber and at both ends."""
    back, (left, right), (cap, front) = position + place.piston_length, place.ends, place.tube
    middle, half = position + place.piston_length / 2, place.gland.groove_width / 2
    end = back - place.rod_seat + place.rod_length
    out, floor, step = place.r_outside, place.gland.groove_diameter / 2, position / 4
    screw, room = left - NIPPLE_END * 2 * place.r_thread, 0.025 * (right - left)  # room : between lines across
    return (
        along("cap length, cap end", left, cap, out, 1),
        along("cap length, rod end", front, right, out, 1),
        along("spigot, cap end", cap, 0.0, place.r_bore, 2),
        along("spigot, rod end", place.z_front, front, place.r_bore, 2),
        along("piston length", position, back, place.r_piston, 2),
        # To where the piston's pressure face comes; there is nothing to see at that place.
        Measure("stroke", (0.0, -place.r_bore), (place.stroke, -place.r_bore), place=3, sign="stroke "),
        along("tube length", cap, front, out, 4),
        along("length over the caps", left, right, out, 5),
        Measure("rod length", (end - place.rod_length, -place.r_rod_spigot), (end, -place.r_rod), place=6),
        diameter("bore", place.r_bore, 2 * step, 2 * step),
        diameter("groove diameter", floor, middle - half, 3 * step),
        Measure("wall", (step, place.r_bore), (step, out), across=True, place=step),
        diameter("outside diameter", out, left, screw - 2 * room),
        diameter("bleed screw's thread", place.r_thread, left, screw - room),
        diameter("rod diameter", place.r_rod, end, end + room),
        Measure("port", (place.z_port - place.r_port, out), (place.z_port + place.r_port, out), place=-1),
    )


def _gland_detail(place: CylinderLayout, position: float) -> Detail:
    """The O-ring in its groove: width, depth to the bore, and the gap that it must bridge."""
    middle, half = position + place.piston_length / 2, place.gland.groove_width / 2
    floor, bore = place.gland.groove_diameter / 2, place.r_bore
    height = bore - floor
    reach = 1.3 * math.hypot(half, height)
    gap = middle + half + 0.3 * half
    measures = (
        Measure("groove width", (middle - half, floor), (middle + half, floor), place=floor - 0.3 * height),
        Measure("groove depth to the bore", (middle - half, floor), (middle - half, bore), True, middle - 1.4 * half),
        Measure("piston clearance", (gap, place.r_piston), (gap, bore), across=True, place=middle + 1.4 * half),
    )
    return Detail("A", (middle, (floor + bore) / 2), reach, measures)


def _thread(diameter: float) -> str:
    return f"thread of {format_quantity(diameter, 'length', 4)}"
