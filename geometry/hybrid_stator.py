"""The hybrid actuator's yoke, coils and tube as turned parts; its end caps are `fluxbore.geometry.hybrid_caps`."""

from __future__ import annotations

import math

from fluxbore.design.hybrid import PHASES, HybridActuator
from fluxbore.design.winding import copper_fill
from fluxbore.geometry import hybrid_layout as layout
from fluxbore.geometry.hybrid_layout import Spigot
from fluxbore.geometry.outline import rectangle
from fluxbore.geometry.part import Colour, Fit, Hole, Part

COLOURS: dict[str, Colour] = {
    "back yoke": (0.36, 0.40, 0.45),
    "coil U": (0.80, 0.36, 0.20),
    "coil V": (0.87, 0.55, 0.22),
    "coil W": (0.66, 0.42, 0.30),
    "cylinder tube": (0.76, 0.79, 0.83),
}


def back_yoke(actuator: HybridActuator) -> Part:
    """With the hole for the leads in the middle of its back overhang, where there is one."""
    yoke, hole = actuator.back_yoke, layout.lead_hole(actuator)
    profile = rectangle(yoke.inner_diameter / 2, yoke.outer_diameter / 2, actuator.yoke_start, actuator.yoke_end)
    holes = (Hole(actuator.yoke_start + yoke.back_overhang / 2, hole),) if hole > 0 else ()
    note = "pushed over the winding and bonded" + ("; the hole leads the phases out" if holes else "")
    return Part("back yoke", "back yoke", "stator", yoke.material, COLOURS["back yoke"], profile, holes, note)


def coils(actuator: HybridActuator) -> list[Part]:
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


def tube(actuator: HybridActuator, spigot: Spigot) -> Part:
    """With a lead-in for lips and O-rings at both ends, and holes for the set screws of the caps."""
    cylinder, (low, high) = actuator.cylinder, layout.tube_span(actuator)
    inner, outer, depth = cylinder.inner_diameter / 2, cylinder.outer_diameter / 2, spigot.lead_in
    length = depth / layout.LEAD_IN
    profile = (
        (inner + depth, low),
        (outer, low),
        (outer, high),
        (inner + depth, high),
        (inner, high - length),
        (inner, low + length),
    )
    holes: tuple[Hole, ...] = ()
    if screws := spigot.screws:
        places = (actuator.chamber[0] - screws.s, actuator.chamber[1] + screws.s)
        angles = [2 * math.pi * i / screws.count for i in range(screws.count)]
        holes = tuple(Hole(z, screws.thread.clearance, angle) for z in places for angle in angles)
    return Part(
        "cylinder tube",
        "cylinder",
        "stator",
        cylinder.material,
        COLOURS["cylinder tube"],
        profile,
        holes,
        note="both ends with a lead-in of 15° for lips and O-rings",
        # The drawn diameter is in the middle of the bore's tolerance, as with the lip's.
        fits=(Fit("bore", cylinder.inner_diameter, "JS8"),),
    )
