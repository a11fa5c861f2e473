"""The hybrid actuator's end caps with what is bought for them: O-rings, the rod's seal and its bush.

Each cap is a spigot in the tube, as far as the chamber, and a flange outside; the rod end's has a nose beyond it. The
port is drilled radially in the middle of the flange, a thread above a narrower bore, and a passage along the axis leads
from there to the chamber. At the rod end it is wider than the rod's bore by the flow bore's area; the cap end has the
same passage, blind. Beyond it the rod meets its O-ring and then its bush, which is pressed in from outside.
"""

from __future__ import annotations

import math

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.seal_gland import SealGland
from fluxbore.geometry import hybrid_layout as layout
from fluxbore.geometry.gland_profile import ring_profile
from fluxbore.geometry.hybrid_layout import RodGuide, Spigot
from fluxbore.geometry.outline import Point, Profile, rectangle
from fluxbore.geometry.part import AxialHole, Colour, Fit, Hole, Part

RING_MATERIAL, BUSH_MATERIAL = "NBR 70", "POM"
"""Of O-rings and bush, as they are bought; the field takes the caps and what is in them for air."""

COLOURS: dict[str, Colour] = {
    "end cap": (0.60, 0.65, 0.71),
    "O-ring": (0.13, 0.13, 0.14),
    "bush": (0.55, 0.47, 0.20),
}

ENDS = ("cap end", "rod end")


def end_caps(actuator: HybridActuator, spigot: Spigot) -> tuple[Part, ...]:
    """Both caps, then what is bought for them."""
    guide = layout.rod_guide(actuator)
    parts = [_cap_end(actuator, spigot), _rod_end(actuator, spigot, guide)]
    if spigot.ring is not None:
        parts += [
            _ring(f"O-ring, {name}", "O-ring", spigot.ring.gland, _height(actuator, end, spigot.ring.middle))
            for end, name in enumerate(ENDS)
        ]
    if guide is not None:
        seal, middle = guide.ring.gland, _height(actuator, 1, guide.ring.middle)
        parts += [_ring("rod seal", "rod seal", seal, middle), _bush(actuator, guide)]
    return tuple(parts)


def _cap_end(actuator: HybridActuator, spigot: Spigot) -> Part:
    """Its passage is blind; threaded holes in its outer face mount the actuator."""
    bottom, outside = layout.passage_end(actuator), spigot.length + actuator.end_caps.flange_length
    passage = layout.passage_diameter(actuator) / 2
    outline = (*_outside(actuator, spigot, outside), (0.0, outside), (0.0, bottom), (passage, bottom))
    places: tuple[AxialHole, ...] = ()
    if (mounting := layout.mounting(actuator)) is not None:
        start, end = sorted(_height(actuator, 0, s) for s in (outside, outside - mounting.depth))
        text = f"{mounting.thread.name} x {_mm(mounting.depth)}"
        places = tuple(
            AxialHole(mounting.radius, mounting.thread.core, start, end, angle, text) for angle in mounting.angles
        )
    return _cap(actuator, spigot, 0, outline, places)


def _rod_end(actuator: HybridActuator, spigot: Spigot, guide: RodGuide | None) -> Part:
    caps, bore, passage = actuator.end_caps, layout.rod_bore(actuator) / 2, layout.passage_diameter(actuator) / 2
    flange, bottom = spigot.length + caps.flange_length, layout.passage_end(actuator)
    outside, nose = flange + caps.nose_length, actuator.cylinder.inner_diameter / 2
    seat = bore if guide is None else actuator.shaft.outer_diameter / 2 + guide.wall
    outline = _outside(actuator, spigot, flange)
    if caps.nose_length:
        edge = min(layout.flange_edge(actuator), caps.nose_length / 4, (nose - seat) / 4)
        outline += ((nose, flange), (nose, outside - edge), (nose - edge, outside))
    if guide is None:
        outline += ((bore, outside),)
    else:
        gland, half = guide.ring.gland, guide.ring.gland.groove_width / 2
        low, high, floor = guide.ring.middle - half, guide.ring.middle + half, gland.bore / 2
        outline += ((seat, outside), (seat, guide.start), (bore, guide.start))
        outline += ((bore, high), (floor, high), (floor, low), (bore, low))
    outline += ((bore, bottom), (passage, bottom))
    note = "no room for a seal and a bush: bored for the rod" if guide is None else "bush pressed in from outside"
    if caps.nose_length:  # a drawing tells a diameter once, where its fit is
        note += f"; nose {_mm(2 * nose)} in diameter, without the spigot's fit"
    fits: tuple[Fit, ...] = (Fit("clearance of the rod", 2 * bore, "H9"),)
    if guide is not None:
        fits += (Fit("bush seat", 2 * seat, "H7"), Fit("floor of the rod seal", guide.ring.gland.bore, "H9"))
    return _cap(actuator, spigot, 1, outline, (), fits, note)


def _outside(actuator: HybridActuator, spigot: Spigot, flange: float) -> tuple[Point, ...]:
    """From the passage's mouth over spigot and flange to the outer edge of the flange, at s = `flange`."""
    inner, outer = actuator.cylinder.inner_diameter / 2, actuator.end_caps.flange_diameter / 2
    edge = layout.flange_edge(actuator)
    points: tuple[Point, ...] = (
        (layout.passage_diameter(actuator) / 2, 0.0),
        (inner - spigot.chamfer, 0.0),
        (inner, spigot.chamfer),
    )
    if spigot.ring is not None:
        half, floor = spigot.ring.gland.groove_width / 2, spigot.ring.gland.groove_diameter / 2
        low, high = spigot.ring.middle - half, spigot.ring.middle + half
        points += ((inner, low), (floor, low), (floor, high), (inner, high))
    shoulder = ((inner, spigot.length), (outer, spigot.length))
    return (*points, *shoulder, (outer, flange - edge), (outer - edge, flange))


def _cap(
    actuator: HybridActuator,
    spigot: Spigot,
    end: int,
    outline: tuple[Point, ...],
    beside: tuple[AxialHole, ...],
    fits: tuple[Fit, ...] = (),
    note: str = "",
) -> Part:
    """A cap of this outline (r, s) with its port and tapped holes."""
    caps, inner = actuator.end_caps, actuator.cylinder.inner_diameter / 2
    screws, sealed = spigot.screws, spigot.ring is not None
    held = "bonded into the tube" if screws is None else f"held by {screws.count} set screws {screws.thread.name}"
    if spigot.ring is not None:
        fits += (Fit("floor of the O-ring", spigot.ring.gland.groove_diameter, "h9"),)
    notes = [
        note,
        held + ("" if sealed else ", sealed by the compound" if screws is None else ", sealed by a compound"),
    ]
    holes = _ports(actuator, end)
    if screws is not None:
        z, text = _height(actuator, end, screws.s), f"{screws.thread.name} x {_mm(inner - screws.bottom)}"
        angles = [2 * math.pi * i / screws.count for i in range(screws.count)]
        holes += tuple(Hole(z, screws.thread.core, angle, screws.bottom, text) for angle in angles)
    return Part(
        f"end cap, {ENDS[end]}",
        "end cap",
        "stator",
        caps.material,
        COLOURS["end cap"],
        _placed(actuator, end, outline),
        holes,
        "; ".join(part for part in notes if part),
        axial_holes=beside,
        fits=(Fit("spigot", 2 * inner, "f7"), *fits),
    )


def _ports(actuator: HybridActuator, end: int) -> tuple[Hole, ...]:
    port = layout.port(actuator)
    z = _height(actuator, end, port.s)
    if port.thread is None:
        return (Hole(z, port.flow),)
    text, bottom = f"{port.thread.name} x {_mm(port.depth)}", actuator.end_caps.flange_diameter / 2 - port.depth
    return Hole(z, port.thread.core, bottom=bottom, thread=text), Hole(z, port.flow)


def _ring(name: str, role: str, gland: SealGland, middle: float) -> Part:
    """Drawn as squeezed, so that it shares no volume with what squeezes it."""
    size = f"{_mm(gland.ring_inner_diameter)} x {_mm(gland.ring_section)}"
    return Part(
        name,
        role,
        "stator",
        RING_MATERIAL,
        COLOURS["O-ring"],
        ring_profile(gland, middle),
        note="drawn as squeezed",
        bought=f"O-ring {size}",
    )


def _bush(actuator: HybridActuator, guide: RodGuide) -> Part:
    """Dry sliding, of a size of ISO 3547 where the rod's diameter is one."""
    inner, outer = actuator.shaft.outer_diameter / 2, actuator.shaft.outer_diameter / 2 + guide.wall
    start, end = _height(actuator, 1, guide.start), actuator.rod_face
    size = " x ".join(_mm(length) for length in (2 * inner, 2 * outer, end - start))
    return Part(
        "bush",
        "bush",
        "stator",
        BUSH_MATERIAL,
        COLOURS["bush"],
        rectangle(inner, outer, start, end),
        note="dry sliding, of polymer",
        bought=f"plain bush {size} (ISO 3547)",
    )


def _height(actuator: HybridActuator, end: int, s: float) -> float:
    """z of what is s from the chamber face of a cap."""
    return actuator.chamber[end] + (s if end else -s)


def _placed(actuator: HybridActuator, end: int, outline: tuple[Point, ...]) -> Profile:
    face, way = actuator.chamber[end], 1 if end else -1
    # Mirrored, the polygon runs the other way.
    return tuple((r, face + way * s) for r, s in (outline if end else outline[::-1]))


def _mm(length: float) -> str:
    return f"{length * 1e3:.3g}" if length < 1e-2 else f"{length * 1e3:.4g}"
