"""The hybrid actuator's moving parts: shaft, magnets and rings, pistons, and the snap rings that hold them.

The shaft ends flush with the cap-side piston and leaves through the rod-end cap. Each piston has one lip towards its
chamber with a groove behind it, so that the pressure spreads the lip. It is drawn unloaded: where it is wider than the
tube's bore the two overlap on purpose. A snap ring of round wire lies half in the shaft and half in a recess of the
piston, which keeps it from leaving its groove; the rest of the piston's face meets the end cap.
"""

from __future__ import annotations

import math

from fluxbore.design.hybrid import HybridActuator
from fluxbore.geometry import hybrid_layout as layout
from fluxbore.geometry.outline import Point, Profile, rectangle
from fluxbore.geometry.part import Colour, Fit, Part

SNAP_MATERIAL = "stainless steel 304"
"""Of the snap rings: beside the array a magnetic one would carry flux, though not much of it."""

SNAP_CHORDS = 12
"""Of the wire's circle."""

RECESS = 0.6
"""Wires that the recess is wider than the shaft, at the radius: half a wire sticks out."""

CHAMFER = 0.5e-3
"""Of the shaft's ends, at most; see `_chamfer`."""

COLOURS: dict[str, Colour] = {
    "shaft": (0.84, 0.84, 0.82),
    "magnet +z": (0.15, 0.35, 0.62),
    "magnet -z": (0.30, 0.56, 0.76),
    "ring": (0.42, 0.43, 0.45),
    "piston": (0.93, 0.92, 0.86),
    "snap ring": (0.50, 0.52, 0.55),
}

SIDES = ("cap side", "rod side")


def mover(actuator: HybridActuator, position: float) -> tuple[Part, ...]:
    """Shaft, magnets and rings from the cap end, pistons, snap rings."""
    return (
        _shaft(actuator, position),
        *_magnet_array(actuator, position),
        *_pistons(actuator, position),
        *_snap_rings(actuator, position),
    )


def _faces(actuator: HybridActuator, position: float) -> tuple[float, float]:
    """z of the pistons' outer faces."""
    length = actuator.piston.length
    return position - length, position + actuator.array_length + length


def _shaft(actuator: HybridActuator, position: float) -> Part:
    shaft, wire, chamfer = actuator.shaft, layout.snap_wire(actuator), _chamfer(actuator)
    radius, (start, face) = shaft.outer_diameter / 2, _faces(actuator, position)
    end = start + shaft.length
    points: list[Point] = [(0.0, start), (radius - chamfer, start), (radius, start + chamfer)]
    if wire:
        floor = radius - wire / 2
        for low in (start + wire, face - 2 * wire):
            points += [(radius, low), (floor, low), (floor, low + wire), (radius, low + wire)]
    points += [(radius, end - chamfer), (radius - chamfer, end), (0.0, end)]
    held = "held by snap rings" if wire else "no room for snap rings: held by the compound alone"
    return Part(
        "shaft",
        "shaft",
        "mover",
        shaft.material,
        COLOURS["shaft"],
        tuple(points),
        note=f"magnets, rings and pistons bonded on with retaining compound, {held}",
        # What bushes of POM run on; ground shafts as they are sold (h6) keep it.
        fits=(Fit("diameter", shaft.outer_diameter, "h8"),),
    )


STACKED = "h9"
"""Of the lengths of magnets and rings: a stack of them that is too long would not go between the snap rings."""


def _chamfer(actuator: HybridActuator) -> float:
    """Of the shaft's ends (m), at 45°: no more than half of what is left beyond a groove."""
    wire = layout.snap_wire(actuator)
    beside = wire / 2 if wire else min(actuator.shaft.outer_diameter / 20, actuator.piston.length / 10)
    return min(CHAMFER, beside)


def _magnet_array(actuator: HybridActuator, position: float) -> list[Part]:
    """Half ring, magnet, ring, magnet, ..., half ring; the magnets' directions alternate, the first along +z."""
    mover, inner, outer = actuator.mover, actuator.shaft.outer_diameter / 2, actuator.mover.outer_diameter / 2
    digits, half = len(str(actuator.magnets)), mover.ring_width / 2
    end = position + actuator.array_length
    borders = [position + i * mover.pole_pitch for i in range(actuator.magnets)] + [end]
    bore = (Fit("bore", 2 * inner, "H8"), Fit("diameter", 2 * outer, "h8"))

    def ring(name: str, role: str, low: float, high: float) -> Part:
        profile, length = rectangle(inner, outer, low, high), half if role == "half ring" else mover.ring_width
        fits = (*bore, Fit("length", length, STACKED))
        return Part(name, role, "mover", mover.ring_material, COLOURS["ring"], profile, fits=fits)

    parts = [ring("half ring, cap side", "half ring", position, position + half)] if half else []
    for i in range(actuator.magnets):
        parts += _magnet(actuator, f"magnet {i + 1:0{digits}d}", "-z" if i % 2 else "+z", borders[i], borders[i + 1])
        if half and i + 1 < actuator.magnets:
            parts.append(ring(f"ring {i + 1:0{digits}d}", "ring", borders[i + 1] - half, borders[i + 1] + half))
    if half:
        parts.append(ring("half ring, rod side", "half ring", end - half, end))
    return parts


def _magnet(actuator: HybridActuator, name: str, way: str, before: float, behind: float) -> list[Part]:
    """One magnet between the middles of its rings (m), of as many equal pieces as its length takes."""
    mover, count, half = actuator.mover, layout.segments(actuator), actuator.mover.ring_width / 2
    inner, outer = actuator.shaft.outer_diameter / 2, mover.outer_diameter / 2
    low, high = before + half, behind - half
    length = (mover.pole_pitch - mover.ring_width) / count
    cuts = [low + i * (high - low) / count for i in range(count)] + [high]
    pieces = []
    for i in range(count):
        own, note = name, f"magnetised along {way}"
        if count > 1:
            own, note = f"{name}.{i + 1}", f"{note}; piece {i + 1} of {count}, bonded to one another"
        pieces.append(
            Part(
                own,
                "magnet",
                "mover",
                mover.magnet,
                COLOURS[f"magnet {way}"],
                rectangle(inner, outer, cuts[i], cuts[i + 1]),
                note=note,
                fits=(Fit("bore", 2 * inner, "H9"), Fit("diameter", 2 * outer, "h9"), Fit("length", length, STACKED)),
            )
        )
    return pieces


def _pistons(actuator: HybridActuator, position: float) -> list[Part]:
    """Two alike, mirrored, their lips away from the magnets; from the lip inwards along s, from the axis along r."""
    piston, shaft, wire = actuator.piston, actuator.shaft.outer_diameter / 2, layout.snap_wire(actuator)
    tip, root, wall = piston.fin_outer_diameter / 2, piston.fin_inner_diameter / 2, layout.lip_wall(actuator)
    hub, recess = layout.hub_radius(actuator), shaft + RECESS * wire
    face: tuple[Point, ...] = ((shaft, 2 * wire), (recess, 2 * wire), (recess, 0.0)) if wire else ((shaft, 0.0),)
    outline = (
        *face,
        (hub, 0.0),
        (hub, piston.fin_length),
        (root - wall, piston.fin_length),
        (tip - wall, 0.0),
        (tip, 0.0),
        (root, piston.fin_length),
        (root, piston.length),
        (shaft, piston.length),
    )
    fits = (Fit("bore", 2 * shaft, "H8"), Fit("lip", 2 * tip, "js9"))
    return [
        Part(
            f"piston, {side}", "piston", "mover", piston.material, COLOURS["piston"],
            _outwards(actuator, position, end, outline), fits=fits,
        )
        for end, side in enumerate(SIDES)
    ]  # fmt: skip


def _snap_rings(actuator: HybridActuator, position: float) -> list[Part]:
    wire, shaft = layout.snap_wire(actuator), actuator.shaft.outer_diameter
    if not wire:
        return []
    steps = [2 * math.pi * step / SNAP_CHORDS for step in range(SNAP_CHORDS)]
    circle = tuple((shaft / 2 + wire / 2 * math.cos(step), 1.5 * wire + wire / 2 * math.sin(step)) for step in steps)
    bought = f"snap ring of round wire {wire * 1e3:.4g}, for shafts of {shaft * 1e3:.4g} (DIN 9925, formerly DIN 7993)"
    return [
        Part(
            f"snap ring, {side}", "snap ring", "mover", SNAP_MATERIAL, COLOURS["snap ring"],
            _outwards(actuator, position, end, circle), note="drawn closed", bought=bought,
        )
        for end, side in enumerate(SIDES)
    ]  # fmt: skip


def _outwards(actuator: HybridActuator, position: float, end: int, outline: tuple[Point, ...]) -> Profile:
    """What is drawn in (r, s), s from a piston's outer face inwards."""
    face = _faces(actuator, position)[end]
    if end == 0:
        return tuple((r, face + s) for r, s in outline)
    return tuple((r, face - s) for r, s in reversed(outline))  # mirrored, the polygon would run clockwise
