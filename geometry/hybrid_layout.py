"""Where the details of the hybrid actuator stand that the paper leaves out: seals, bush, threads, chamfers, snap rings.

All sizes follow from the actuator's parameters, most of them linearly. A detail that does not fit is made smaller, and
left out where it would be too small to make: then the joint is bonded, or the bore plain, and the part's note says so.
Heights s are measured from an end cap's chamber face outwards, or from a piston's outer face inwards. Lengths in m.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.air_ports import AIR_PORTS, AirPort
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.seal_gland import SealGland, designed_gland, designed_rod_gland
from fluxbore.design.threads import SCREWS, Thread

LEAST_WALL = 1e-3
"""Beside a thread: what a lathe leaves without care."""

LEAST_SECTION = 0.5e-3
"""Of an O-ring; thinner ones are not sold."""

LEAST_WIRE = 0.3e-3
"""Of a snap ring."""

STATIC_SQUEEZE = 0.2
"""Of a ring that does not slide, in the middle of what its standards allow."""

BUSH_LENGTH = 0.75
"""Of the rod's diameter: 6 mm of 8 mm, as catalogues of ISO 3547 bushes have it."""

BUSH_WALL, BUSH_ROD = 1e-3, 8e-3
"""A bush for a rod of 8 mm has a wall of 1 mm; the wall goes with the root of the rod, which gives ISO 3547's 1.5 mm
at 18 mm and 2 mm at 32 mm."""

LEAST_HOLD = 0.8
"""Screw diameters that a set screw must hold in the spigot."""

EDGE = 0.5e-3
"""Chamfer of a flange's outer edge."""

LEAD_IN = math.tan(math.radians(15))
"""Radial over axial length of the chamfer that guides an O-ring or a lip into the tube; makers ask for 15° to 20°."""

SNAP_WIRE = 0.1
"""Of the shaft's diameter: the wire of a snap ring."""


@dataclass(frozen=True, slots=True)
class Ring:
    """An O-ring with its gland; middle : s of its middle."""

    gland: SealGland
    middle: float


@dataclass(frozen=True, slots=True)
class Screws:
    """Radial set screws. s : of their axes. bottom : of the tapped holes, from the axis."""

    thread: Thread
    count: int
    s: float
    bottom: float


@dataclass(frozen=True, slots=True)
class Spigot:
    """What both caps have in the tube. chamfer : of the spigot's edge, at 45°. lead_in : depth of the tube's chamfer,
    radial. ring, screws : None where there is no room for them."""

    length: float
    chamfer: float
    lead_in: float
    ring: Ring | None
    screws: Screws | None


@dataclass(frozen=True, slots=True)
class RodGuide:
    """Seal and bush of the rod. wall, start : of the bush, which ends at the cap's outer face."""

    ring: Ring
    wall: float
    start: float


@dataclass(frozen=True, slots=True)
class Port:
    """s : of its axis, in the middle of the flange. flow : bore. thread : None where it is plain; else `depth` long."""

    s: float
    flow: float
    thread: AirPort | None
    depth: float


@dataclass(frozen=True, slots=True)
class Mounting:
    """Threaded holes along the axis in the cap end's outer face. radius : of their circle."""

    thread: Thread
    radius: float
    depth: float
    angles: tuple[float, ...]


def rod_bore(actuator: HybridActuator) -> float:
    """Diameter of the rod-end cap's bore around the rod (m)."""
    return actuator.shaft.outer_diameter + 2 * actuator.end_caps.rod_clearance


def passage_diameter(actuator: HybridActuator) -> float:
    """Of the bore between port and chamber (m): around the rod it leaves an annulus of the port's own area."""
    return math.hypot(rod_bore(actuator), actuator.end_caps.port_diameter)


def tube_span(actuator: HybridActuator) -> tuple[float, float]:
    """z of the tube's two ends (m)."""
    half = actuator.cylinder.length / 2
    return actuator.middle - half, actuator.middle + half


def lip_wall(actuator: HybridActuator) -> float:
    """The lip's wall measured along r (m); its thickness is measured across the cone."""
    piston = actuator.piston
    slope = (piston.fin_outer_diameter - piston.fin_inner_diameter) / 2 / piston.fin_length
    return piston.fin_thickness * math.hypot(1.0, slope)


def hub_radius(actuator: HybridActuator) -> float:
    """Of the piston's face, which meets the end cap (m); the groove between it and the lip's root is two lips wide, or
    half of what there is above the shaft."""
    shaft, lip = actuator.shaft.outer_diameter / 2, actuator.piston.fin_inner_diameter / 2 - lip_wall(actuator)
    return lip - min(2 * actuator.piston.fin_thickness, (lip - shaft) / 2)


def snap_wire(actuator: HybridActuator) -> float:
    """Diameter of the wire of the snap rings that hold the pistons on the shaft (m); 0 where they are bonded.

    A ring lies half in the shaft, in a recess of the piston's outer face: it must leave the piston its face.
    """
    room = hub_radius(actuator) - actuator.shaft.outer_diameter / 2
    wire = min(SNAP_WIRE * actuator.shaft.outer_diameter, 0.4 * room, 0.15 * actuator.piston.length)
    return wire if wire >= LEAST_WIRE else 0.0


def spigot(actuator: HybridActuator) -> Spigot:
    """From the chamber face: chamfer, land, O-ring, land, set screws, and the tube's lead-in at the shoulder."""
    caps, cylinder = actuator.end_caps, actuator.cylinder
    length = tube_span(actuator)[1] - actuator.chamber[1]
    wall = (cylinder.inner_diameter - passage_diameter(actuator)) / 2
    tube_wall = (cylinder.outer_diameter - cylinder.inner_diameter) / 2
    section = min(caps.ring_section, length / 4.5, wall / 1.8)
    chamfer, lead_in = 0.2 * section, 0.3 * min(section, tube_wall)
    ring, inner = None, chamfer
    if section >= LEAST_SECTION:
        gland = designed_gland(cylinder.inner_diameter, section, squeeze=STATIC_SQUEEZE)
        ring = Ring(gland, chamfer + section / 2 + gland.groove_width / 2)
        inner = ring.middle + gland.groove_width / 2
    low, high = inner + 0.4 * section, length - lead_in / LEAD_IN
    return Spigot(length, chamfer, lead_in, ring, _screws(actuator, low, high))


def _screws(actuator: HybridActuator, low: float, high: float) -> Screws | None:
    """In the middle of the free stretch of the spigot; None where they do not fit or the winding covers them."""
    caps, passage = actuator.end_caps, passage_diameter(actuator) / 2
    thread, s, bottom = SCREWS[caps.screw_thread], (low + high) / 2, passage + LEAST_WALL
    wound = (actuator.winding_end - actuator.winding_start) / 2
    free = (actuator.chamber[1] - actuator.chamber[0]) / 2 + s - thread.clearance / 2 >= wound
    held = actuator.cylinder.inner_diameter / 2 - bottom >= LEAST_HOLD * thread.diameter
    apart = 2 * math.pi * bottom >= 1.3 * thread.diameter * caps.screws
    if caps.screws and high - low >= thread.clearance and free and held and apart:
        return Screws(thread, caps.screws, s, bottom)
    return None


def port(actuator: HybridActuator) -> Port:
    """Radial, in the middle of the flange."""
    caps = actuator.end_caps
    s = spigot_length(actuator) + caps.flange_length / 2
    if caps.port_thread is None:
        return Port(s, caps.port_diameter, None, 0.0)
    thread = AIR_PORTS[caps.port_thread]
    room = (caps.flange_diameter - passage_diameter(actuator)) / 2 - LEAST_WALL
    return Port(s, caps.port_diameter, thread, min(thread.depth, room))


def spigot_length(actuator: HybridActuator) -> float:
    return tube_span(actuator)[1] - actuator.chamber[1]


def passage_end(actuator: HybridActuator) -> float:
    """s of the passage's bottom (m): a tenth of the flow bore beyond its rim, which must not graze the bottom."""
    return port(actuator).s + 0.6 * actuator.end_caps.port_diameter


def rod_guide(actuator: HybridActuator) -> RodGuide | None:
    """From the passage outwards: land, O-ring, land, bush; all shorter where the cap is, None below half."""
    caps, shaft = actuator.end_caps, actuator.shaft.outer_diameter
    room = spigot_length(actuator) + caps.flange_length + caps.nose_length - passage_end(actuator)
    around = (actuator.cylinder.inner_diameter - shaft) / 2  # the nose is as wide as the spigot
    length, full_wall = BUSH_LENGTH * shaft, BUSH_WALL * math.sqrt(shaft / BUSH_ROD)
    share = min(1.0, room / (2.25 * caps.ring_section + length))
    section, wall = min(share * caps.ring_section, around / 1.4), min(full_wall, around / 1.6)
    least_wall = max(0.3 * full_wall, 2 * caps.rod_clearance)
    if share < 0.5 or section < LEAST_SECTION or wall < least_wall or caps.rod_clearance > 0.2 * section:
        return None
    gland = designed_rod_gland(shaft, section)
    end = passage_end(actuator) + room
    return RodGuide(Ring(gland, passage_end(actuator) + (section + gland.groove_width) / 2), wall, end - share * length)


def mounting(actuator: HybridActuator) -> Mounting | None:
    """On a circle in the middle of the cap end's flange, clear of the port; None where they do not fit."""
    caps, passage = actuator.end_caps, passage_diameter(actuator) / 2
    thread, count, outer = SCREWS[caps.mounting_thread], caps.mounting_holes, caps.flange_diameter / 2
    circle, half = (passage + outer) / 2, SCREWS[caps.mounting_thread].diameter / 2
    angles = tuple((2 * i + 1) * math.pi / count for i in range(count))
    tapped = AIR_PORTS[caps.port_thread].diameter if caps.port_thread else caps.port_diameter
    beside = min((circle * abs(math.sin(angle)) for angle in angles if math.cos(angle) > 0), default=math.inf)
    clear = beside - half >= tapped / 2 + LEAST_WALL
    walled = (outer - passage) / 2 - half >= LEAST_WALL
    apart = 2 * math.pi * circle >= 2 * thread.diameter * count
    depth = min(2 * thread.diameter, 0.75 * caps.flange_length)
    if not (count and clear and walled and apart and depth >= thread.diameter):
        return None
    return Mounting(thread, circle, depth, angles)


def flange_edge(actuator: HybridActuator) -> float:
    """Chamfer of a flange's outer edge (m), at 45°."""
    caps = actuator.end_caps
    return min(EDGE, caps.flange_length / 10, (caps.flange_diameter - actuator.cylinder.outer_diameter) / 10)


def lead_hole(actuator: HybridActuator) -> float:
    """Diameter of the hole for the leads in the back yoke (m), in the middle of its back overhang."""
    yoke = actuator.back_yoke
    return min(yoke.lead_hole, yoke.back_overhang / 2, yoke.inner_diameter / 4)


def segments(actuator: HybridActuator) -> int:
    """Equal rings of which a magnet is bonded."""
    longest = actuator.mover.longest_magnet
    return 1 if longest is None else max(1, math.ceil(actuator.magnet_thickness / longest * (1 - 1e-9)))
