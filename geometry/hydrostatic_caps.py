"""What closes a hydraulic cylinder: cap end with port and bleed screw, rod-end cap with the rod's bush and wiper.

Both caps are bonded into the tube, which seals them too. Threads are plain cylinders of their cores, the bleed screw's
of its nominal diameter; its hexagon is round.
"""

from __future__ import annotations

import math

from fluxbore.design.threads import SCREWS
from fluxbore.design.units import format_quantity
from fluxbore.geometry.fits import fits, outline_of
from fluxbore.geometry.hydrostatic_layout import RELIEF, SHANK, CylinderLayout
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import AxialHole, AxisThread, Colour, Fit, Hole, Part

SCREW_MATERIAL, BUSH_MATERIAL, WIPER_MATERIAL = "stainless steel 304", "POM", "NBR 70"
"""Of what is bought."""

NIPPLE_END = 1.9
"""Thread diameters that the bleed screw sticks out by."""

HOLES = 4
"""Tapped holes by which the cylinder is fixed, between the port's direction and square to it."""

BONDED = "spigot bonded into the tube with anaerobic retaining compound, which seals it"

COLOURS: dict[str, Colour] = {
    "end cap": (0.70, 0.55, 0.26),
    "bleed screw": (0.45, 0.47, 0.50),
    "rod bush": (0.91, 0.90, 0.84),
    "rod wiper": (0.20, 0.22, 0.26),
}


def cap_end(place: CylinderLayout, material: str) -> Part:
    """Outwards, towards -z: spigot, flange; inside it passage, neck, seat and thread."""
    shoulder, outside, edge = place.tube[0], place.ends[0], place.edge
    profile = outline_of(
        (place.r_passage, place.z_passage),
        (place.r_neck, place.z_passage),
        (place.r_neck, place.z_seat),
        (place.r_thread, place.z_seat - (place.r_thread - place.r_neck)),
        (place.r_thread, outside),
        (place.r_cap - edge, outside),
        (place.r_cap, outside + edge),
        (place.r_cap, shoulder),
        (place.r_bore, shoulder),
        (place.r_bore, 0.0),
        (place.r_passage, 0.0),
    )
    thread, port = place.port_thread, Hole(place.z_port, 2 * place.r_port)
    wider: tuple[Hole, ...] = ()
    if thread is not None:
        tapped = thread.tapped(place.r_cap - place.port_floor)
        wider = (Hole(place.z_port, thread.core, bottom=place.port_floor, thread=tapped),)
    return Part(
        "end cap, cap end",
        "end cap",
        "stator",
        material,
        COLOURS["end cap"],
        profile,
        (port, *wider),
        note=f"{BONDED}; bleed screw's thread {_thread_name(2 * place.r_thread)}, 90 deg seat"
        + (", spot face around the port for the connector's seal" if thread is not None else ""),
        axial_holes=_mounting_holes(place),
        fits=fits(("spigot", 2 * place.r_bore, "f7")),
        axis_threads=(AxisThread(2 * place.r_thread, _thread_name(2 * place.r_thread)),),
    )


def _mounting_holes(place: CylinderLayout) -> tuple[AxialHole, ...]:
    screw, outside = place.mounting, place.ends[0]
    if screw is None:
        return ()
    end, tapped = outside + place.mounting_depth, screw.tapped(place.mounting_depth)
    angles = (math.tau * (i + 0.5) / HOLES for i in range(HOLES))
    return tuple(AxialHole(place.r_mounting, screw.core, outside, end, angle, tapped) for angle in angles)


def bleed_screw(place: CylinderLayout) -> Part:
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
    name, size = "bleed screw", _thread_name(wide)
    note, bought = f"thread {size}", f"bleed screw {size}, 90 deg seat"
    return Part(name, name, "stator", SCREW_MATERIAL, COLOURS[name], profile, hole, note, bought=bought)


def rod_end(place: CylinderLayout, material: str) -> tuple[Part, ...]:
    """The cap; in its bore, from the chamber outwards, the rod's bush and the wiper, where there are any."""
    shoulder, outside, edge = place.tube[1], place.ends[1], place.edge
    profile = outline_of(
        (place.r_relief, place.z_front),
        (place.r_bore, place.z_front),
        (place.r_bore, shoulder),
        (place.r_outside, shoulder),
        (place.r_outside, outside - edge),
        (place.r_outside - edge, outside),
        (place.r_bush, outside),
        (place.r_bush, place.z_relief),
        (place.r_relief, place.z_relief),
    )
    bearing = ("bush seat", 2 * place.r_bush, "H7") if place.bush_wall else ("bearing", 2 * place.r_bearing, "H8")
    cap = Part(
        "end cap, rod end",
        "end cap",
        "stator",
        material,
        COLOURS["end cap"],
        profile,
        (Hole(place.z_vent, 2 * place.r_vent),),
        note=BONDED,
        fits=fits(("spigot", 2 * place.r_bore, "f7"), bearing),
    )
    return (cap, *_in_bore(place))


def _in_bore(place: CylinderLayout) -> tuple[Part, ...]:
    if not place.bush_wall:
        return ()
    low, middle, high = place.z_relief, place.z_wiper, place.ends[1]
    bush = rectangle(place.r_bearing, place.r_bush, low, middle)
    size = " x ".join(_mm(value) for value in (2 * place.r_rod, 2 * place.r_bush, middle - low))
    running = fits(("bore, pressed in", 2 * place.r_bearing, "H8"))
    parts = (_ring("rod bush", BUSH_MATERIAL, bush, f"plain bush {size}, {BUSH_MATERIAL}", "pressed in", running),)
    if not place.wiper_width:
        return parts
    wiper = rectangle(place.r_rod, place.r_bush, middle, high)
    size = " x ".join(_mm(value) for value in (2 * place.r_rod, 2 * place.r_bush, place.wiper_width))
    note = "pressed in; its lip, which the rod widens, is drawn as it lies"
    return (*parts, _ring("rod wiper", WIPER_MATERIAL, wiper, f"rod wiper {size}, {WIPER_MATERIAL}", note))


def _ring(
    name: str,
    material: str,
    profile: tuple[tuple[float, float], ...],
    bought: str,
    note: str,
    sizes: tuple[Fit, ...] = (),
) -> Part:
    return Part(name, name, "stator", material, COLOURS[name], profile, note=note, fits=sizes, bought=bought)


def _thread_name(diameter: float) -> str:
    """ "M6", or its diameter where no screw has that."""
    found = (screw.name for screw in SCREWS.values() if abs(screw.diameter - diameter) < 1e-9)
    return next(found, format_quantity(diameter, "length", 4))


def _mm(length: float) -> str:
    return format_quantity(length, "length", 4)
