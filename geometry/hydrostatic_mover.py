"""What moves in a hydraulic cylinder: piston, its O-ring, rod."""

from __future__ import annotations

from fluxbore.design.o_rings import designation
from fluxbore.design.threads import SCREWS, Thread
from fluxbore.design.units import format_quantity
from fluxbore.geometry.fits import fits
from fluxbore.geometry.gland_profile import ring_profile
from fluxbore.geometry.hydrostatic_layout import LAND_EDGE, ROD_EDGE, ROD_OUTSIDE, CylinderLayout
from fluxbore.geometry.part import AxisThread, Colour, Part

RING_MATERIAL = "NBR 70"
"""Of the O-ring, as it is bought."""

HELD = "rod bonded into the piston; pressure goes through the shoulder, which seats before the end meets its floor"

COLOURS: dict[str, Colour] = {
    "piston": (0.62, 0.64, 0.67),
    "O-ring": (0.13, 0.13, 0.14),
    "rod": (0.84, 0.84, 0.82),
}


def piston(place: CylinderLayout, material: str, position: float) -> Part:
    """From its pressure face backwards: crown, land, groove, land; behind, the hole for the rod's end."""
    outer, floor, inner = place.r_piston, place.gland.groove_diameter / 2, place.r_rod_spigot
    seat, back = position + place.piston_length - place.rod_seat, position + place.piston_length
    low, high = (position + (place.piston_length + side * place.gland.groove_width) / 2 for side in (-1, 1))
    land = LAND_EDGE
    profile = (
        (0.0, position),
        (outer - land, position),
        (outer, position + land),
        (outer, low),
        (floor, low),
        (floor, high),
        (outer, high),
        (outer, back - land),
        (outer - land, back),
        (inner, back),
        (inner, seat),
        (0.0, seat),
    )
    sizes = fits(("outside", 2 * outer, "h8"), ("groove floor", 2 * floor, "h9"), ("rod's seat", 2 * inner, "H7"))
    return Part("piston", "piston", "mover", material, COLOURS["piston"], profile, note=HELD, fits=sizes)


def ring(place: CylinderLayout, position: float) -> Part:
    gland = place.gland
    size = [format_quantity(value, "length", 4) for value in (gland.ring_inner_diameter, gland.ring_section)]
    profile = ring_profile(gland, position + place.piston_length / 2)
    note = f"free ring {size[0]} x {size[1]}, drawn as squeezed"
    return Part(
        "O-ring",
        "O-ring",
        "mover",
        RING_MATERIAL,
        COLOURS["O-ring"],
        profile,
        note=note,
        bought=f"{designation(gland)}, {RING_MATERIAL}",
    )


def rod(place: CylinderLayout, material: str, position: float) -> Part:
    back = position + place.piston_length
    start = back - place.rod_seat
    end, edge = start + place.rod_length, ROD_EDGE * place.r_rod
    profile = (
        (0.0, start),
        (place.r_rod_spigot, start),
        (place.r_rod_spigot, back),
        (place.r_rod, back),
        (place.r_rod, end - edge),
        (place.r_rod - edge, end),
        (0.0, end),
    )
    sizes = fits(("rod", 2 * place.r_rod, "h8"), ("end in the piston", 2 * place.r_rod_spigot, "h6"))
    threaded = 2 * ROD_OUTSIDE * place.r_rod
    thread = eye_thread(2 * place.r_rod)
    note = f"{HELD}; outer end threaded {thread.name if thread else ''} for the eye".replace("  ", " ")
    note += f" over {format_quantity(threaded, 'length', 4)}"
    cut = () if thread is None else (AxisThread(2 * place.r_rod, thread.tapped(threaded)),)
    return Part("rod", "rod", "mover", material, COLOURS["rod"], profile, note=note, fits=sizes, axis_threads=cut)


def eye_thread(diameter: float) -> Thread | None:
    """The largest coarse thread that a rod of this diameter (m) holds; None where the table has none of its size."""
    held = [screw for screw in SCREWS.values() if 0.8 * diameter < screw.diameter < diameter * (1 + 1e-9)]
    return max(held, key=lambda screw: screw.diameter, default=None)
