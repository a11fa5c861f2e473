"""What the drawing of a hydraulic cylinder's section is dimensioned by."""

from __future__ import annotations

import math

from fluxbore.geometry.hydrostatic_caps import NIPPLE_END
from fluxbore.geometry.hydrostatic_layout import LAND_EDGE, ROD_EDGE, CylinderLayout
from fluxbore.geometry.measure import Detail, Measure, along, diameter


def measures(place: CylinderLayout, position: float) -> tuple[Measure, ...]:
    """What the cylinder is made by; those across stand in the empty chamber and at both ends."""
    back, (left, right), (cap, front) = position + place.piston_length, place.ends, place.tube
    middle, half = position + place.piston_length / 2, place.gland.groove_width / 2
    end = back - place.rod_seat + place.rod_length
    out, floor, step = place.r_outside, place.gland.groove_diameter / 2, position / 4
    screw, room = left - NIPPLE_END * 2 * place.r_thread, 0.025 * (right - left)  # room : between lines across
    face, land = out - place.edge, place.r_piston - LAND_EDGE
    rod_edge = ROD_EDGE * place.r_rod
    drill = place.r_port if place.port_thread is None else place.port_thread.core / 2
    wide = (diameter("cap diameter", place.r_cap, left + place.edge, screw - 3 * room),) if place.r_cap > out else ()
    return (
        along("cap length, cap end", left, cap, face, 1),
        along("cap length, rod end", front, right, face, 1),
        along("spigot, cap end", cap, 0.0, place.r_bore, 2),
        along("spigot, rod end", place.z_front, front, place.r_bore, 2),
        along("piston length", position, back, land, 2),
        # To where the piston's pressure face comes; there is nothing to see at that place.
        Measure("stroke", (0.0, -place.r_bore), (place.stroke, -place.r_bore), place=3, sign="stroke "),
        along("tube length", cap, front, out, 4),
        along("length over the caps", left, right, face, 5),
        Measure("rod length", (end - place.rod_length, -place.r_rod_spigot), (end, rod_edge - place.r_rod), place=6),
        diameter("bore", place.r_bore, 2 * step, 2 * step),
        diameter("groove diameter", floor, middle - half, 3 * step),
        Measure("wall", (step, place.r_bore), (step, out), across=True, place=step),
        diameter("outside diameter", out, cap, screw - 2 * room),
        *wide,
        diameter("bleed screw's thread", place.r_thread, left, screw - room),
        diameter("rod diameter", place.r_rod, end - rod_edge, end + room),
        Measure("port", (place.z_port - drill, place.r_cap), (place.z_port + drill, place.r_cap), place=-1),
    )


def gland_detail(place: CylinderLayout, position: float) -> Detail:
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
