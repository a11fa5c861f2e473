"""What must fit within a hydraulic cylinder: walls, lands and threads, each limit one sentence that names its key."""

from __future__ import annotations

from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity
from fluxbore.geometry.gland_profile import ring_size
from fluxbore.geometry.hydrostatic_layout import (
    LEAST_THREAD,
    LEAST_WALL,
    PORT_SLACK,
    RELIEF,
    ROD_CLEARANCE,
    ROD_SPIGOT,
    SHANK,
    CylinderLayout,
)


def checked(place: CylinderLayout) -> CylinderLayout:
    """The same layout; raises DesignError for the first limit that is broken."""
    _check_piston(place)
    _check_caps(place)
    _check_bush(place)
    _check_mounting(place)
    return place


def _check_piston(place: CylinderLayout) -> None:
    floor = place.gland.groove_diameter
    if not floor < 2 * place.r_piston:
        raise DesignError(
            "actuator.seal.groove_diameter must be below the piston's diameter, the bore less its clearance, "
            f"{_mm(2 * place.r_piston)}; got {_mm(floor)}."
        )
    width = ring_size(place.gland)[1]
    if place.gland.groove_width < width:
        raise DesignError(
            f"actuator.seal.groove_width must hold the squeezed O-ring, at least {_mm(width)}; "
            f"got {_mm(place.gland.groove_width)}."
        )
    shortest = place.gland.groove_width + 2 * LEAST_WALL
    if place.piston_length < shortest:
        raise DesignError(
            f"{place.key}.piston_length must hold the O-ring's groove and a land on both sides of it, at least "
            f"{_mm(shortest)}; got {_mm(place.piston_length)}."
        )
    if not floor > 2 * LEAST_WALL:
        raise DesignError(
            f"actuator.seal.groove_diameter must leave a wall of the piston around the rod's end, above "
            f"{_mm(2 * LEAST_WALL)}; got {_mm(floor)}."
        )
    thickest = (floor - 2 * LEAST_WALL) / ROD_SPIGOT
    if 2 * place.r_rod > thickest:
        raise DesignError(
            f"{place.key}.rod_diameter must leave a wall of the piston between its groove and the rod's end in it, at "
            f"most {_mm(thickest)}; got {_mm(2 * place.r_rod)}."
        )


def _check_caps(place: CylinderLayout) -> None:
    key, most = place.key, place.r_bore - LEAST_WALL
    widest = 2 * most / PORT_SLACK
    if 2 * place.r_port > widest:
        raise DesignError(
            f"actuator.port.diameter must leave a wall in the spigot of {key}'s cap, at most "
            f"{_mm(widest)}; got {_mm(2 * place.r_port)}."
        )
    thread = 2 * (place.r_cap - LEAST_WALL)
    if 2 * place.r_thread > thread:
        raise DesignError(
            f"{key}.bleed_thread must leave a wall in the cap, at most {_mm(thread)}; got {_mm(2 * place.r_thread)}."
        )
    if place.port_thread is not None and not place.r_port < place.port_thread.core / 2:
        raise DesignError(
            f"actuator.port.diameter must be below the core of actuator.port.thread {place.port_thread.name}, "
            f"{_mm(place.port_thread.core)}; got {_mm(2 * place.r_port)}."
        )
    if place.r_relief > most:
        rod = 2 * max(max(most**2 - place.r_vent**2, 0.0) ** 0.5 - ROD_CLEARANCE, 0.0)
        raise DesignError(
            f"{key}.rod_diameter must leave a wall in the spigot of the rod-end cap, at most {_mm(rod)}; "
            f"got {_mm(2 * place.r_rod)}."
        )
    hold = 2 * place.r_thread * (RELIEF + LEAST_THREAD)
    cap_end = place.tube[0] - place.z_seat + (SHANK * 2 * place.r_thread - place.r_neck) + hold
    rod_end = place.z_relief - place.tube[1] + place.r_rod + place.wiper_width
    for what, shortest in (
        ("the port, the bleed screw's seat and its thread", cap_end),
        (f"the vent{', the wiper' if place.wiper_width else ''} and a bearing of half the rod's diameter", rod_end),
    ):
        if place.flange < shortest:
            raise DesignError(f"{key}.cap_length must hold {what}, at least {_mm(shortest)}; got {_mm(place.flange)}.")


def _check_bush(place: CylinderLayout) -> None:
    thickest = max(place.r_outside - LEAST_WALL - place.r_bearing, 0.0)
    if place.bush_wall > thickest:
        raise DesignError(
            f"{place.key}.bush_wall must leave a wall in the rod-end cap, at most {_mm(thickest)}; "
            f"got {_mm(place.bush_wall)}."
        )
    if place.wiper_width > 0 and not place.bush_wall > 0:
        raise DesignError(
            f"{place.key}.wiper_width must be 0 mm where there is no bush, since the wiper sits in the bush's bore; "
            f"got {_mm(place.wiper_width)}."
        )


def _check_mounting(place: CylinderLayout) -> None:
    screw = place.mounting
    if screw is None:
        return
    room, needed = place.r_cap - place.r_thread, screw.diameter + 2 * LEAST_WALL
    if room < needed:
        raise DesignError(
            f"{place.key}.mounting_thread must leave walls between bleed screw and the cap's outside, {_mm(room)} "
            f"apart; {screw.name} needs {_mm(needed)}."
        )
    if place.mounting_depth < screw.diameter:
        raise DesignError(
            f"{place.key}.cap_length must hold the mounting holes before the port, {_mm(screw.diameter)} deep at "
            f"least; got {_mm(place.flange)}, which leaves {_mm(place.mounting_depth)}."
        )


def _mm(length: float) -> str:
    return format_quantity(length, "length", 6)
