"""Where everything of a single-acting hydraulic cylinder stands: what the specification gives, what a workshop adds.

z runs along the axis from 0, where the piston rests on the cap end, to the rod's end. From there outwards:

    cap end   spigot in the tube | flange: port, radial | passage to the chamber, seat, thread of the bleed screw
    rod end   spigot in the tube | flange: vent, radial | relief around the rod to the chamber, bearing of the rod

What has no key follows from one that has, or is a constant with its reason. Lengths in m.
"""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.seal_gland import SealGland, designed_gland
from fluxbore.design.units import format_quantity
from fluxbore.geometry.gland_profile import ring_size

LEAST_WALL = 1e-3
"""Beside drillings, under the groove and beside it: what a lathe leaves without care."""

LEAST_SPIGOT = 3e-3
"""Axial length; a shorter one tilts in the tube."""

JOINT_STRESS = 5e6
"""Pa, shear in the bonded joint of spigot and tube at the rated pressure: a quarter of the 20 MPa and more that makers
give for anaerobic retaining compounds on steel and brass (tested by ISO 10123)."""

PISTON_CLEARANCE = 50e-6
"""Radial, between piston and bore: half of the extrusion gap that 70 IRHD rubber bridges at 100 bar."""

ROD_CLEARANCE = 25e-6
"""Radial, of the rod in its bearing; no seal sits there."""

PORT_SLACK = 1.1
"""Passage over port: drillings of equal width would graze each other."""

VENT = 0.16
"""Vent over bore, diameters: air leaves some 40 times faster than the piston moves, below 20 m/s at 0.5 m/s, for which
0.3 kPa are enough."""

ROD_SPIGOT = 0.6
"""Of the rod's diameter: its end in the piston, so that a shoulder takes the force."""

CROWN = 0.25
"""Of the piston's length: what is left before the rod's end."""

ROD_OUTSIDE = 1.5
"""Rod diameters that the rod reaches beyond its cap when retracted, for its thread."""

NECK, SHANK, RELIEF = 0.25, 0.40, 0.3
"""Of the bleed screw's thread diameter: radius of the passage that it closes, radius and length of its slim part."""

LEAST_THREAD = 0.5
"""Thread diameters that the bleed screw holds on; the pressure behind it is on its tip alone."""


@dataclass(frozen=True, slots=True)
class CylinderLayout:
    """Radii r_..., heights z_... and lengths of one cylinder (m); the piston's own are from its pressure face.

    gland : of its O-ring. z_groove : middle of the groove, r_groove its floor.
    """

    key: str
    r_bore: float
    r_outside: float
    stroke: float
    spigot: float
    flange: float
    r_port: float
    r_passage: float
    r_thread: float
    r_rod: float
    r_bearing: float
    r_vent: float
    r_relief: float
    r_piston: float
    piston_length: float
    gland: SealGland

    @property
    def z_front(self) -> float:
        """Chamber face of the rod-end cap."""
        return self.stroke + self.piston_length

    @property
    def tube(self) -> tuple[float, float]:
        return -self.spigot, self.z_front + self.spigot

    @property
    def ends(self) -> tuple[float, float]:
        """Outer faces of both caps."""
        return self.tube[0] - self.flange, self.tube[1] + self.flange

    @property
    def z_port(self) -> float:
        return self.tube[0] - LEAST_WALL - self.r_port

    @property
    def z_passage(self) -> float:
        """Its blind end, a tenth of the port beyond the port's rim."""
        return self.z_port - 1.2 * self.r_port

    @property
    def r_neck(self) -> float:
        return min(2 * NECK * self.r_thread, 0.8 * self.r_passage)

    @property
    def z_seat(self) -> float:
        """Where the neck opens into the 90-degree seat of the bleed screw."""
        return self.z_passage - LEAST_WALL

    @property
    def z_vent(self) -> float:
        return self.tube[1] + LEAST_WALL + self.r_vent

    @property
    def z_relief(self) -> float:
        return self.z_vent + 1.2 * self.r_vent

    @property
    def r_rod_spigot(self) -> float:
        return ROD_SPIGOT * self.r_rod

    @property
    def rod_seat(self) -> float:
        """Depth of the rod's end in the piston."""
        return (1 - CROWN) * self.piston_length

    @property
    def rod_length(self) -> float:
        return self.rod_seat + self.ends[1] - self.piston_length + 2 * ROD_OUTSIDE * self.r_rod


def layout(design: HydrostaticDesign, name: str) -> CylinderLayout:
    """Of the "output_cylinder" or the "input_cylinder". Raises DesignError, one sentence, where parts do not fit."""
    cylinder, shape = getattr(design.bare, name), design.shapes[name]
    key = f"actuator.{name}"
    if cylinder.wall_thickness is None or cylinder.rod_diameter is None:
        missing = "wall_thickness" if cylinder.wall_thickness is None else "rod_diameter"
        raise DesignError(f"{key}.{missing} is missing: the drawing needs it.")
    port, vent, rod = design.bare.port.diameter, VENT * cylinder.bore, cylinder.rod_diameter
    bearing = rod / 2 + ROD_CLEARANCE
    # The other cylinder's ring is of the same section, in a groove by the same rules.
    gland = design.gland
    if gland.bore != cylinder.bore:
        gland = designed_gland(cylinder.bore, gland.ring_section)
    found = CylinderLayout(
        key=key,
        r_bore=cylinder.bore / 2,
        r_outside=cylinder.bore / 2 + cylinder.wall_thickness,
        stroke=cylinder.stroke,
        # Pressure on the cap's area, borne by the spigot's surface.
        spigot=max(LEAST_SPIGOT, cylinder.rated_pressure * cylinder.bore / (4 * JOINT_STRESS)),
        flange=shape.cap_length,
        r_port=port / 2,
        r_passage=PORT_SLACK * port / 2,
        r_thread=shape.bleed_thread / 2,
        r_rod=rod / 2,
        r_bearing=bearing,
        r_vent=vent / 2,
        # The annulus around the rod has the vent's area.
        r_relief=(bearing**2 + (vent / 2) ** 2) ** 0.5,
        r_piston=cylinder.bore / 2 - PISTON_CLEARANCE,
        piston_length=shape.piston_length,
        gland=gland,
    )
    _check_piston(found)
    _check_caps(found)
    return found


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
    thread = 2 * (place.r_outside - LEAST_WALL)
    if 2 * place.r_thread > thread:
        raise DesignError(
            f"{key}.bleed_thread must leave a wall in the cap, at most {_mm(thread)}; got {_mm(2 * place.r_thread)}."
        )
    if place.r_relief > most:
        rod = 2 * max(max(most**2 - place.r_vent**2, 0.0) ** 0.5 - ROD_CLEARANCE, 0.0)
        raise DesignError(
            f"{key}.rod_diameter must leave a wall in the spigot of the rod-end cap, at most {_mm(rod)}; "
            f"got {_mm(2 * place.r_rod)}."
        )
    hold = 2 * place.r_thread * (RELIEF + LEAST_THREAD)
    cap_end = place.tube[0] - place.z_seat + (SHANK * 2 * place.r_thread - place.r_neck) + hold
    rod_end = place.z_relief - place.tube[1] + place.r_rod
    for what, shortest in (
        ("the port, the bleed screw's seat and its thread", cap_end),
        ("the vent and a bearing of half the rod's diameter", rod_end),
    ):
        if place.flange < shortest:
            raise DesignError(f"{key}.cap_length must hold {what}, at least {_mm(shortest)}; got {_mm(place.flange)}.")


def _mm(length: float) -> str:
    return format_quantity(length, "length", 6)
