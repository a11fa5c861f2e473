"""The parts of the pneumatic-electromagnetic hybrid actuator, as turned profiles (Nakata and Noda 2023, Figs. 5 and 9).

What the paper does not dimension is drawn as a workshop would, from the actuator's own parameters:

- each end cap is a spigot in the tube, as far as the chamber, and a flange outside; its port is drilled radially in the
  middle of the flange, and a bore along the axis leads from there to the chamber. At the rod end that bore is wider
  than the rod's by the port's area; the cap end has the same bore, blind;
- the shaft ends flush with the cap-side piston and leaves through the rod-end cap;
- each piston has one lip towards its chamber with a groove behind it, so that the pressure spreads the lip. It is drawn
  unloaded: where it is wider than the tube's bore the two overlap on purpose.
"""

from __future__ import annotations

import math

from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid import PHASES, HybridActuator
from fluxbore.design.units import format_quantity
from fluxbore.design.winding import copper_fill
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.outline import Profile, rectangle
from fluxbore.geometry.part import Colour, Hole, Part

THINNEST = 1e-5
"""m. Nobody turns a thinner wall, and CAD kernels, which call points 1e-7 mm apart the same, are far from trouble."""

SLACK = 1e-9
"""m. Rounding allowed where a position is compared with the ends of the stroke."""

COLOURS: dict[str, Colour] = {
    "back yoke": (0.36, 0.40, 0.45),
    "coil U": (0.80, 0.36, 0.20),
    "coil V": (0.87, 0.55, 0.22),
    "coil W": (0.66, 0.42, 0.30),
    "cylinder tube": (0.76, 0.79, 0.83),
    "end cap": (0.60, 0.65, 0.71),
    "shaft": (0.84, 0.84, 0.82),
    "magnet +z": (0.15, 0.35, 0.62),
    "magnet -z": (0.30, 0.56, 0.76),
    "ring": (0.42, 0.43, 0.45),
    "piston": (0.93, 0.92, 0.86),
}


def assembly(actuator: HybridActuator, position: float) -> Assembly:
    """All parts with the mover at this position (m), as `fluxbore.design.hybrid` defines it.

    The stator comes first: yoke, coils, tube, caps; then shaft, magnets and rings from the cap end, and pistons.
    Raises DesignError where the parts do not fit one another or the position is beyond the stroke.
    """
    actuator.check()
    _check_mover(actuator)
    _check_caps(actuator)
    low = actuator.mid_stroke - actuator.mover.stroke / 2
    high = actuator.mid_stroke + actuator.mover.stroke / 2
    if not low - SLACK <= position <= high + SLACK:
        raise DesignError(f"The position must lie within the stroke, {_mm(low)} to {_mm(high)}; got {_mm(position)}.")
    pistons = _pistons(actuator, position)
    return Assembly(
        name=actuator.name,
        parts=(
            _back_yoke(actuator),
            *_coils(actuator),
            _tube(actuator),
            *_end_caps(actuator),
            _shaft(actuator, position),
            *_magnet_array(actuator, position),
            *pistons,
        ),
        position=position,
        squeezes=tuple((piston.name, "cylinder tube") for piston in pistons),
    )


def passage_diameter(actuator: HybridActuator) -> float:
    """Of the bore between port and chamber (m): around the rod it leaves an annulus of the port's own area."""
    caps = actuator.end_caps
    return math.hypot(_rod_bore(actuator), caps.port_diameter)


def _rod_bore(actuator: HybridActuator) -> float:
    return actuator.shaft.outer_diameter + 2 * actuator.end_caps.rod_clearance


def _tube_span(actuator: HybridActuator) -> tuple[float, float]:
    half = actuator.cylinder.length / 2
    return actuator.middle - half, actuator.middle + half


def _back_yoke(actuator: HybridActuator) -> Part:
    yoke = actuator.back_yoke
    profile = rectangle(yoke.inner_diameter / 2, yoke.outer_diameter / 2, actuator.yoke_start, actuator.yoke_end)
    return Part("back yoke", "back yoke", "stator", yoke.material, COLOURS["back yoke"], profile)


def _coils(actuator: HybridActuator) -> list[Part]:
    inner, outer = actuator.cylinder.outer_diameter / 2, actuator.winding.outer_diameter / 2
    digits = len(str(actuator.coils))
    faces = [actuator.winding_start + i * actuator.coil_width for i in range(actuator.coils + 1)]
    fill = copper_fill(actuator)  # enamel and resin have no mass here
    parts = []
    for i in range(actuator.coils):
        phase = PHASES[i % len(PHASES)]
        name, note = f"coil {i + 1:0{digits}d} {phase}", f"phase {phase}, {actuator.turns_per_coil:g} turns"
        profile = rectangle(inner, outer, faces[i], faces[i + 1])
        material, colour = actuator.winding.material, COLOURS[f"coil {phase}"]
        parts.append(Part(name, "coil", "stator", material, colour, profile, note=note, fill=fill))
    return parts


def _tube(actuator: HybridActuator) -> Part:
    cylinder = actuator.cylinder
    profile = rectangle(cylinder.inner_diameter / 2, cylinder.outer_diameter / 2, *_tube_span(actuator))
    return Part("cylinder tube", "cylinder", "stator", cylinder.material, COLOURS["cylinder tube"], profile)


def _end_caps(actuator: HybridActuator) -> tuple[Part, Part]:
    """The caps at the cap end and at the rod end, mirror images but for the rod's bore."""
    caps, spigot, flange = (
        actuator.end_caps,
        actuator.cylinder.inner_diameter / 2,
        actuator.end_caps.flange_diameter / 2,
    )
    passage = passage_diameter(actuator) / 2

    def cap(end: int, bore: float) -> Part:
        outwards = 1 if end else -1
        face, shoulder = actuator.chamber[end], _tube_span(actuator)[end]
        port, outside = shoulder + outwards * caps.flange_length / 2, shoulder + outwards * caps.flange_length
        # A tenth of the port's diameter beyond its rim, so that the drilling does not graze the passage's bottom.
        bottom = port + outwards * 0.6 * caps.port_diameter
        outline = (
            (passage, face),
            (spigot, face),
            (spigot, shoulder),
            (flange, shoulder),
            (flange, outside),
            (bore, outside),
            (bore, bottom),
            (passage, bottom),
        )
        profile = outline if end else outline[::-1]  # mirrored, the polygon runs the other way
        name = "end cap, rod end" if end else "end cap, cap end"
        holes = (Hole(port, caps.port_diameter),)
        return Part(name, "end cap", "stator", caps.material, COLOURS["end cap"], profile, holes)

    return cap(0, 0.0), cap(1, _rod_bore(actuator) / 2)


def _shaft(actuator: HybridActuator, position: float) -> Part:
    shaft, start = actuator.shaft, position - actuator.piston.length
    profile = rectangle(0.0, shaft.outer_diameter / 2, start, start + shaft.length)
    return Part("shaft", "shaft", "mover", shaft.material, COLOURS["shaft"], profile)


def _magnet_array(actuator: HybridActuator, position: float) -> list[Part]:
    """Half ring, magnet, ring, magnet, ..., half ring; the magnets' directions alternate, the first along +z."""
    mover, inner, outer = actuator.mover, actuator.shaft.outer_diameter / 2, actuator.mover.outer_diameter / 2
    digits, half = len(str(actuator.magnets)), mover.ring_width / 2
    end = position + actuator.array_length
    borders = [position + i * mover.pole_pitch for i in range(actuator.magnets)] + [end]

    def ring(name: str, role: str, low: float, high: float) -> Part:
        profile = rectangle(inner, outer, low, high)
        return Part(name, role, "mover", mover.ring_material, COLOURS["ring"], profile)

    parts = [ring("half ring, cap side", "half ring", position, position + half)] if half else []
    for i in range(actuator.magnets):
        way, name = "-z" if i % 2 else "+z", f"magnet {i + 1:0{digits}d}"
        low, high = borders[i] + half, borders[i + 1] - half
        profile, note = rectangle(inner, outer, low, high), f"magnetised along {way}"
        parts.append(Part(name, "magnet", "mover", mover.magnet, COLOURS[f"magnet {way}"], profile, note=note))
        if half and i + 1 < actuator.magnets:
            parts.append(ring(f"ring {i + 1:0{digits}d}", "ring", high, borders[i + 1] + half))
    if half:
        parts.append(ring("half ring, rod side", "half ring", end - half, end))
    return parts


def _pistons(actuator: HybridActuator, position: float) -> list[Part]:
    """Two alike, mirrored, their lips away from the magnets; from the lip inwards along s, from the axis along r."""
    piston, shaft = actuator.piston, actuator.shaft.outer_diameter / 2
    tip, root, wall = piston.fin_outer_diameter / 2, piston.fin_inner_diameter / 2, _radial_thickness(actuator)
    hub = _hub_radius(actuator)
    outline = (
        (shaft, 0.0),
        (hub, 0.0),
        (hub, piston.fin_length),
        (root - wall, piston.fin_length),
        (tip - wall, 0.0),
        (tip, 0.0),
        (root, piston.fin_length),
        (root, piston.length),
        (shaft, piston.length),
    )
    cap_side, rod_side = position - piston.length, position + actuator.array_length + piston.length
    profiles: dict[str, Profile] = {
        "piston, cap side": tuple((r, cap_side + s) for r, s in outline),
        # Mirrored, the polygon would run clockwise.
        "piston, rod side": tuple((r, rod_side - s) for r, s in reversed(outline)),
    }
    return [
        Part(name, "piston", "mover", piston.material, COLOURS["piston"], profile) for name, profile in profiles.items()
    ]


def _radial_thickness(actuator: HybridActuator) -> float:
    """The lip's wall measured along r (m); its thickness is measured across the cone."""
    piston = actuator.piston
    slope = (piston.fin_outer_diameter - piston.fin_inner_diameter) / 2 / piston.fin_length
    return piston.fin_thickness * math.hypot(1.0, slope)


def _hub_radius(actuator: HybridActuator) -> float:
    """Of the piston's face, which meets the end cap (m); the groove between it and the lip's root is two lips wide, or
    half of what there is above the shaft."""
    shaft, lip = actuator.shaft.outer_diameter / 2, actuator.piston.fin_inner_diameter / 2 - _radial_thickness(actuator)
    return lip - min(2 * actuator.piston.fin_thickness, (lip - shaft) / 2)


def _check_caps(actuator: HybridActuator) -> None:
    caps, cylinder = actuator.end_caps, actuator.cylinder
    low, high = _tube_span(actuator)
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
    seat = 2 * _hub_radius(actuator) - 2 * THINNEST
    if seat <= _rod_bore(actuator):
        raise DesignError(
            "actuator.end_caps.rod_clearance must leave the piston a seat on the end cap, below "
            f"{_mm((seat - actuator.shaft.outer_diameter) / 2)}; got {_mm(caps.rod_clearance)}."
        )
    widest = math.sqrt(seat**2 - _rod_bore(actuator) ** 2)
    if caps.port_diameter > widest:
        raise DesignError(
            "actuator.end_caps.port_diameter must leave the piston a seat around the passage to the chamber, at most "
            f"{_mm(widest)}; got {_mm(caps.port_diameter)}."
        )
    shortest = 1.2 * caps.port_diameter + 2 * THINNEST
    if caps.flange_length < shortest:
        raise DesignError(
            "actuator.end_caps.flange_length must hold the port and a wall on both sides of it, at least "
            f"{_mm(shortest)}; got {_mm(caps.flange_length)}."
        )


def _check_mover(actuator: HybridActuator) -> None:
    mover, piston, shaft = actuator.mover, actuator.piston, actuator.shaft
    if 0 < mover.ring_width < 2 * THINNEST:
        raise DesignError(
            f"actuator.mover.ring_width must be 0 mm (no rings) or at least {_mm(2 * THINNEST)}; "
            f"got {_mm(mover.ring_width)}."
        )
    retracted = actuator.chamber[0] + shaft.length
    front = _tube_span(actuator)[1] + actuator.end_caps.flange_length
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
    if _radial_thickness(actuator) > room:
        thickest = room * piston.fin_thickness / _radial_thickness(actuator)
        raise DesignError(
            "actuator.piston.fin_thickness must leave a groove between fin and shaft, at most "
            f"{_mm(thickest)}; got {_mm(piston.fin_thickness)}."
        )


def _mm(length: float) -> str:
    return format_quantity(length, "length", 6)
