"""Where everything of a single-acting hydraulic cylinder stands: what the specification gives, what a workshop adds.

z runs along the axis from 0, where the piston rests on the cap end, to the rod's end. From there outwards:

    cap end   spigot in the tube | flange: port, radial | passage to the chamber, seat, thread of the bleed screw
    rod end   spigot in the tube | flange: vent, radial | relief around the rod to the chamber, bush of the rod, wiper

What has no key follows from one that has, or is a constant with its reason. Lengths in m.
"""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.design.errors import DesignError
from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.seal_gland import SealGland, designed_gland
from fluxbore.design.threads import Thread

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

PORT_FLOOR = 0.5e-3
"""From the passage to the bottom of the port's thread, radially; the narrower bore goes on from there."""

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

DEEPEST = 2.0
"""Thread diameters that a tapped hole for fixing goes in; more of it holds no better."""

EDGE, LARGEST_EDGE = 0.3, 0.5e-3
"""Chamfer of outer edges: of the tube's wall, and at most."""

LEAD_IN = 2.75
"""Length over depth of the tube's chamfers for the O-ring: 20 degrees."""

LAND_EDGE = 0.2e-3
"""Chamfer of the piston's lands, each of them no narrower than `LEAST_WALL`."""

ROD_EDGE = 0.15
"""Chamfer of the rod's end over its radius."""


@dataclass(frozen=True, slots=True)
class CylinderLayout:
    """Radii r_..., heights z_... and lengths of one cylinder (m); the piston's own are from its pressure face.

    gland : of its O-ring. port_thread, mounting : threads of the port and of the holes in the cap end's face, None
    where there are none. bush_wall, wiper_width : 0 without bush and wiper.
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
    port_thread: Thread | None = None
    bush_wall: float = 0.0
    wiper_width: float = 0.0
    mounting: Thread | None = None

    @property
    def edge(self) -> float:
        """Chamfer of outer edges."""
        return min(EDGE * (self.r_outside - self.r_bore), LARGEST_EDGE)

    @property
    def lead_in(self) -> float:
        """Depth of the tube's chamfers, which end half way along the spigots at the latest."""
        return min(EDGE * (self.r_outside - self.r_bore), self.spigot / (2 * LEAD_IN))

    @property
    def r_entry(self) -> float:
        """What the port takes of the flange: its thread, or its bore."""
        return self.r_port if self.port_thread is None else self.port_thread.diameter / 2

    @property
    def port_floor(self) -> float:
        """Distance of the port's thread from the axis."""
        return self.r_passage + PORT_FLOOR

    @property
    def r_cap(self) -> float:
        """Outside of the cap end: the tube's, or what a connector's stud screws into."""
        stud = 0.0 if self.port_thread is None else self.port_floor + self.port_thread.stud
        return max(self.r_outside, stud)

    @property
    def r_bush(self) -> float:
        """Outside of the rod's bush, or of its bearing where there is none."""
        return self.r_bearing + self.bush_wall

    @property
    def z_wiper(self) -> float:
        """Where the bush ends and the wiper begins, if there is one."""
        return self.ends[1] - self.wiper_width

    @property
    def r_mounting(self) -> float:
        """Pitch circle of the tapped holes, half way between the bleed screw and the cap's outside."""
        return (self.r_thread + self.r_cap) / 2

    @property
    def mounting_depth(self) -> float:
        """Of the tapped holes; below 0 where there is no room before the port."""
        free = self.z_port - self.r_entry - LEAST_WALL - self.ends[0]
        return free if self.mounting is None else min(free, DEEPEST * self.mounting.diameter)

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
        return self.tube[0] - LEAST_WALL - self.r_entry

    @property
    def z_passage(self) -> float:
        """Its blind end, a tenth of the port beyond the port's rim."""
        return self.z_port - 1.2 * self.r_port

    @property
    def r_neck(self) -> float:
        return min(2 * NECK * self.r_thread, 0.8 * self.r_passage)

    @property
    def z_seat(self) -> float:
        """Where the neck opens into the 90-degree seat of the bleed screw, which stays clear of the port's thread."""
        near = self.z_passage - LEAST_WALL
        if self.port_thread is None:
            return near
        opening = max(min(self.r_thread, self.port_floor) - self.r_neck, 0.0)
        return min(near, self.z_port - self.r_entry - LEAST_WALL + opening)

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
    """Of the "output_cylinder" or the "input_cylinder"; whether all fits is `hydrostatic_checks.checked`'s to say.

    Raises DesignError where a dimension is missing.
    """
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
    return CylinderLayout(
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
        port_thread=design.port_thread,
        bush_wall=shape.bush_wall,
        wiper_width=shape.wiper_width,
        mounting=shape.mounting,
    )
