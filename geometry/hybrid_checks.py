"""What of a hybrid actuator's caps and mover cannot be made: one sentence for each, with key, limit and value."""

from __future__ import annotations

import math

from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.units import format_quantity
from fluxbore.geometry import hybrid_layout as layout
from fluxbore.geometry.hybrid_layout import LEAST_WALL, hub_radius, lip_wall, port, rod_bore, tube_span

THINNEST = 1e-5
"""m. Nobody turns a thinner wall, and CAD kernels, which call points 1e-7 mm apart the same, are far from trouble."""

SLACK = 1e-9
"""m. Rounding allowed where a position is compared with the ends of the stroke."""

SHALLOWEST = 0.6
"""Of a port's usual depth: fittings still hold."""

MOST_SEGMENTS = 50
"""Of a magnet; more is a slip of the unit."""


def check_caps(actuator: HybridActuator) -> None:
    """Raise DesignError where spigots, flanges, ports or the pistons' seats do not fit."""
    caps, cylinder = actuator.end_caps, actuator.cylinder
    low, high = tube_span(actuator)
    # A flange no wider than the yoke's bore goes inside the yoke.
    wide = caps.flange_diameter > actuator.back_yoke.inner_diameter
    covered = (min(actuator.winding_start, actuator.yoke_start), max(actuator.winding_end, actuator.yoke_end))
    start, end = covered if wide else (actuator.winding_start, actuator.winding_end)
    needed = 2 * max(actuator.middle - start, end - actuator.middle)
    if cylinder.length < needed - SLACK:
        what = "back yoke" if needed > actuator.winding_end - actuator.winding_start + SLACK else "winding"
        raise DesignError(
            f"actuator.cylinder.length must keep the end caps' flanges clear of the {what}, at least {_mm(needed)}; "
            f"got {_mm(cylinder.length)}."
        )
    spigots = actuator.chamber[1] - actuator.chamber[0] + 2 * THINNEST
    if high - low < spigots:
        raise DesignError(
            f"actuator.cylinder.length must leave room for the end caps' spigots, at least {_mm(spigots)}; "
            f"got {_mm(cylinder.length)}."
        )
    seat = 2 * hub_radius(actuator) - 2 * THINNEST
    if seat <= rod_bore(actuator):
        raise DesignError(
            "actuator.end_caps.rod_clearance must leave the piston a seat on the end cap, below "
            f"{_mm((seat - actuator.shaft.outer_diameter) / 2)}; got {_mm(caps.rod_clearance)}."
        )
    widest = math.sqrt(seat**2 - rod_bore(actuator) ** 2)
    if caps.port_diameter > widest:
        name, got = "port_diameter", _mm(caps.port_diameter)
        if caps.port_thread is not None:
            name, got = "port_thread", f"{caps.port_thread} with a flow bore of {got}"
        raise DesignError(
            f"actuator.end_caps.{name} must leave the piston a seat around the passage to the chamber, a bore of at "
            f"most {_mm(widest)}; got {got}."
        )
    _check_port(actuator)
    if 0 < caps.nose_length < 2 * THINNEST:
        raise DesignError(
            f"actuator.end_caps.nose_length must be 0 mm (no nose) or at least {_mm(2 * THINNEST)}; "
            f"got {_mm(caps.nose_length)}."
        )


def _check_port(actuator: HybridActuator) -> None:
    caps, thread = actuator.end_caps, port(actuator).thread
    shortest = 1.2 * caps.port_diameter + 2 * THINNEST
    if thread is not None:
        shortest = max(shortest, thread.diameter + LEAST_WALL)
    if caps.flange_length < shortest:
        raise DesignError(
            "actuator.end_caps.flange_length must hold the port and a wall on both sides of it, at least "
            f"{_mm(shortest)}; got {_mm(caps.flange_length)}."
        )
    if thread is None:
        return
    least = SHALLOWEST * thread.depth
    if port(actuator).depth < least:
        narrowest = layout.passage_diameter(actuator) + 2 * (least + LEAST_WALL)
        raise DesignError(
            f"actuator.end_caps.flange_diameter must hold the port's thread {thread.name}, at least {_mm(narrowest)}; "
            f"got {_mm(caps.flange_diameter)}."
        )


def check_mover(actuator: HybridActuator) -> None:
    """Raise DesignError where rings, magnets, shaft or lips cannot be made."""
    mover, piston, shaft = actuator.mover, actuator.piston, actuator.shaft
    if 0 < mover.ring_width < 2 * THINNEST:
        raise DesignError(
            f"actuator.mover.ring_width must be 0 mm (no rings) or at least {_mm(2 * THINNEST)}; "
            f"got {_mm(mover.ring_width)}."
        )
    _check_segments(actuator)
    retracted = actuator.chamber[0] + shaft.length
    front = actuator.rod_face
    if retracted < front:
        raise DesignError(
            "actuator.shaft.length must reach through the rod-end cap when retracted, at least "
            f"{_mm(front - actuator.chamber[0])}; got {_mm(shaft.length)}."
        )
    if piston.fin_outer_diameter >= actuator.cylinder.outer_diameter:
        raise DesignError(
            "actuator.piston.fin_outer_diameter must be below actuator.cylinder.outer_diameter "
            f"{_mm(actuator.cylinder.outer_diameter)}; got {_mm(piston.fin_outer_diameter)}."
        )
    if piston.fin_length > piston.length - THINNEST:
        raise DesignError(
            f"actuator.piston.fin_length must leave a body behind the fin, at most {_mm(piston.length - THINNEST)}; "
            f"got {_mm(piston.fin_length)}."
        )
    room = (piston.fin_inner_diameter - shaft.outer_diameter) / 2 - 4 * THINNEST
    if room <= 0:
        raise DesignError(
            "actuator.piston.fin_inner_diameter must leave a body above actuator.shaft.outer_diameter "
            f"{_mm(shaft.outer_diameter)}; got {_mm(piston.fin_inner_diameter)}."
        )
    if lip_wall(actuator) > room:
        thickest = room * piston.fin_thickness / lip_wall(actuator)
        raise DesignError(
            "actuator.piston.fin_thickness must leave a groove between fin and shaft, at most "
            f"{_mm(thickest)}; got {_mm(piston.fin_thickness)}."
        )


def _check_segments(actuator: HybridActuator) -> None:
    longest = actuator.mover.longest_magnet
    if longest is not None and layout.segments(actuator) > MOST_SEGMENTS:
        raise DesignError(
            f"actuator.mover.longest_magnet must leave at most {MOST_SEGMENTS} pieces of a magnet, at least "
            f"{_mm(actuator.magnet_thickness / MOST_SEGMENTS)}; got {_mm(longest)}."
        )


def _mm(length: float) -> str:
    return format_quantity(length, "length", 6)
