"""The pneumatic-electromagnetic hybrid actuator (iPEHLA) as frozen parameters.

An air cylinder inside a slotless tubular linear permanent-magnet motor: magnets, soft-magnetic rings, shaft and two
pistons move together; back yoke, winding, cylinder and end caps stand still (Nakata and Noda 2023, IEEE/ASME Trans.
Mechatronics, Fig. 5 and Table II). Symbols in the docstrings are that paper's.

Axial coordinate: z = 0 is the mid-plane of the first U coil at the cap end, +z points to the rod end. The mover's
position is the z of the cap-side end face of its magnet array.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity

BORE_DIFFERENCE = 0.05
"""Relative; a catalogue's bore and the drawn one are the same bore but for a fit."""

DENSEST_FILL = math.pi / math.sqrt(12)
"""Of a window by round wire without insulation, in hexagonal layers; wound coils reach 0.5 to 0.7."""

PHASES = ("U", "V", "W")

THINNEST = 1e-6
"""m; a thinner wall or gap is a slip of the unit, and the field's mesh would fold it away."""


@dataclass(frozen=True, slots=True)
class BackYoke:
    """Soft-magnetic tube around the winding. Lengths in metres."""

    outer_diameter: float  # D
    inner_diameter: float  # D_i
    front_overhang: float  # L_f, beyond the winding at the rod end
    back_overhang: float  # L_b, beyond the winding at the cap end
    material: str
    lead_hole: float = 4e-3  # in the back overhang, for the winding's leads

    @property
    def thickness(self) -> float:
        return (self.outer_diameter - self.inner_diameter) / 2


@dataclass(frozen=True, slots=True)
class Winding:
    """Ring coils side by side in the order U V W U V W ..., all wound the same way, on the cylinder's outside."""

    outer_diameter: float  # D_w
    sets_per_phase: int  # n_w
    turns: float  # N, of a phase; fractional where a density of turns is held in a study
    wire_diameter: float  # bare, m
    material: str


@dataclass(frozen=True, slots=True)
class Cylinder:
    """The air cylinder's tube. Two bores: the catalogue's serves the pneumatics, the drawing's serves the field."""

    outer_diameter: float  # D_c
    inner_diameter: float  # D_c'
    catalogue_bore: float
    length: float
    material: str


@dataclass(frozen=True, slots=True)
class Mover:
    """Axially magnetised ring magnets of alternating direction with soft-magnetic rings between and at both ends."""

    pole_pitch: float  # tau
    ring_width: float  # tau_f
    pole_pairs: int  # p
    outer_diameter: float  # D_m
    magnet: str
    remanence: float | None  # B_r at 20 degC; None takes the grade's
    magnet_permeability: float | None  # mu_r of the recoil line; None takes the grade's
    ring_material: str
    stroke: float  # L_mr
    longest_magnet: float | None = None  # that can be made and magnetised in one piece; None takes any


@dataclass(frozen=True, slots=True)
class Shaft:
    """The rod that carries the magnet array; it leaves the actuator at the rod end only."""

    outer_diameter: float  # D_s
    length: float  # L_s
    material: str


@dataclass(frozen=True, slots=True)
class Piston:
    """One at each end of the magnet array, with one conical sealing fin (Fig. 9, Table III)."""

    length: float
    fin_outer_diameter: float  # D_f
    fin_inner_diameter: float  # d
    fin_length: float  # l
    fin_thickness: float
    material: str


@dataclass(frozen=True, slots=True)
class EndCaps:
    """Cap-end and rod-end covers: a spigot in the tube, a flange outside, one radial port each. Lengths in metres.

    Threads are names of `fluxbore.design.screw_thread`; without a port's the port is drilled plain.
    """

    flange_diameter: float
    flange_length: float
    port_diameter: float  # of the bore that the air flows through
    rod_clearance: float  # radial, around the shaft at the rod end
    material: str
    port_thread: str | None = None
    nose_length: float = 0.0  # of the rod-end cap beyond its flange
    ring_section: float = 1.5e-3  # of the O-rings on both spigots and around the rod
    screw_thread: str = "M3"  # of the screws through the tube into a spigot
    screws: int = 4  # in each spigot; 0 where caps are bonded
    mounting_thread: str = "M3"  # of the holes in the cap end's flange
    mounting_holes: int = 4


@dataclass(frozen=True, slots=True)
class HybridActuator:
    """All parameters of one hybrid actuator, SI units."""

    name: str
    back_yoke: BackYoke
    winding: Winding
    cylinder: Cylinder
    mover: Mover
    shaft: Shaft
    piston: Piston
    end_caps: EndCaps

    @property
    def magnet_thickness(self) -> float:
        """tau_m = tau - tau_f (m)."""
        return self.mover.pole_pitch - self.mover.ring_width

    @property
    def magnets(self) -> int:
        return 2 * self.mover.pole_pairs

    @property
    def array_length(self) -> float:
        """Magnets, inner rings and the two half rings at the ends (m): 2 p tau."""
        return self.magnets * self.mover.pole_pitch

    @property
    def coil_width(self) -> float:
        """tau_w = 2 tau / 3 (m): three phases side by side fill a period of 2 tau."""
        return 2 * self.mover.pole_pitch / 3

    @property
    def coils(self) -> int:
        return len(PHASES) * self.winding.sets_per_phase

    @property
    def turns_per_coil(self) -> float:
        return self.winding.turns / self.winding.sets_per_phase

    @property
    def coil_area(self) -> float:
        """Cross-section of one coil's window (m^2)."""
        return self.coil_width * (self.winding.outer_diameter - self.cylinder.outer_diameter) / 2

    @property
    def winding_start(self) -> float:
        """z of the winding's cap-side face (m)."""
        return -self.coil_width / 2

    @property
    def winding_end(self) -> float:
        """z of the winding's rod-side face (m)."""
        return self.winding_start + self.coils * self.coil_width

    @property
    def yoke_start(self) -> float:
        return self.winding_start - self.back_yoke.back_overhang

    @property
    def yoke_end(self) -> float:
        return self.winding_end + self.back_yoke.front_overhang

    @property
    def middle(self) -> float:
        """z of the winding's middle (m), where the magnet array's middle stands at mid-stroke."""
        return (self.winding_start + self.winding_end) / 2

    @property
    def mid_stroke(self) -> float:
        """The position, as defined above, at the middle of the stroke (m)."""
        return self.middle - self.array_length / 2

    @property
    def chamber(self) -> tuple[float, float]:
        """z of the two end caps' inner faces (m): array, two pistons and the stroke between them."""
        half = (self.array_length + self.mover.stroke) / 2 + self.piston.length
        return self.middle - half, self.middle + half

    @property
    def rod_face(self) -> float:
        """z of the outer face of the rod-end cap, from which the rod is free (m)."""
        return self.middle + self.cylinder.length / 2 + self.end_caps.flange_length + self.end_caps.nose_length

    @property
    def air_gap(self) -> float:
        """g_ac (m): from the magnets' outside to the winding's inside."""
        return (self.cylinder.outer_diameter - self.mover.outer_diameter) / 2

    def check(self) -> None:
        """Raise DesignError with one sentence where parts overlap or a thickness vanishes."""
        steps = (
            ("actuator.shaft.outer_diameter", self.shaft.outer_diameter),
            ("actuator.mover.outer_diameter", self.mover.outer_diameter),
            ("actuator.cylinder.inner_diameter", self.cylinder.inner_diameter),
            ("actuator.cylinder.outer_diameter", self.cylinder.outer_diameter),
            ("actuator.winding.outer_diameter", self.winding.outer_diameter),
            ("actuator.back_yoke.inner_diameter", self.back_yoke.inner_diameter),
            ("actuator.back_yoke.outer_diameter", self.back_yoke.outer_diameter),
        )
        for (inner, small), (outer, large) in pairwise(steps):
            touching = inner == "actuator.winding.outer_diameter"
            if large < small or (large - small < 2 * THINNEST and not touching):
                verb = "must not be below" if touching else "must exceed"
                raise DesignError(f"{outer} {verb} {inner} {_mm(small)}; got {_mm(large)}.")
        if self.mover.ring_width < 0:
            raise DesignError(
                "actuator.mover.magnet_thickness must be at most actuator.mover.pole_pitch "
                f"{_mm(self.mover.pole_pitch)}; got {_mm(self.magnet_thickness)}."
            )
        yoke = self.back_yoke
        for key, overhang in (("front_overhang", yoke.front_overhang), ("back_overhang", yoke.back_overhang)):
            if overhang < 0:
                raise DesignError(
                    "actuator.back_yoke.length must cover the winding and the other overhang, at least "
                    f"{_mm(self.yoke_end - self.yoke_start - overhang)}; got {_mm(self.yoke_end - self.yoke_start)}, "
                    f"which leaves actuator.back_yoke.{key} {_mm(overhang)}."
                )
        if self.mover.ring_width >= self.mover.pole_pitch * (1 - 1e-9):
            raise DesignError(
                "actuator.mover.ring_width must be below actuator.mover.pole_pitch "
                f"{_mm(self.mover.pole_pitch)}; got {_mm(self.mover.ring_width)}."
            )
        wires = 2 * self.winding.wire_diameter
        if self.winding.outer_diameter - self.cylinder.outer_diameter < wires:
            raise DesignError(
                "actuator.winding.outer_diameter must leave room for one layer of wire above "
                f"actuator.cylinder.outer_diameter, {_mm(self.cylinder.outer_diameter + wires)}; "
                f"got {_mm(self.winding.outer_diameter)}."
            )
        copper = self.turns_per_coil * math.pi / 4 * self.winding.wire_diameter**2
        if copper > DENSEST_FILL * self.coil_area:
            raise DesignError(
                "actuator.winding.turns must fit the winding window: round wire fills at most "
                f"{DENSEST_FILL:.1%} of a coil, {DENSEST_FILL * self.coil_area * 1e6:.4g} mm^2; "
                f"got {copper * 1e6:.4g} mm^2."
            )
        winding = self.winding_end - self.winding_start
        if self.array_length >= winding:
            raise DesignError(
                "actuator.mover.pole_pairs must leave the magnet array shorter than the winding "
                f"{_mm(winding)}; got an array of {_mm(self.array_length)}."
            )
        self._check_bore()

    def _check_bore(self) -> None:
        piston, cylinder = self.piston, self.cylinder
        chamber = self.chamber[1] - self.chamber[0]
        if cylinder.length <= chamber:
            raise DesignError(
                f"actuator.cylinder.length must exceed the chamber {_mm(chamber)} (magnet array, two pistons and the "
                f"stroke); got {_mm(cylinder.length)}."
            )
        if not abs(cylinder.catalogue_bore / cylinder.inner_diameter - 1) <= BORE_DIFFERENCE:
            low, high = ((1 + sign * BORE_DIFFERENCE) * cylinder.inner_diameter for sign in (-1, 1))
            raise DesignError(
                f"actuator.cylinder.catalogue_bore must be within {BORE_DIFFERENCE:.0%} of "
                f"actuator.cylinder.inner_diameter, {_mm(low)} to {_mm(high)}; got {_mm(cylinder.catalogue_bore)}."
            )
        if piston.fin_outer_diameter <= cylinder.inner_diameter:
            raise DesignError(
                "actuator.piston.fin_outer_diameter must exceed actuator.cylinder.inner_diameter "
                f"{_mm(cylinder.inner_diameter)}, or the fin does not seal; got {_mm(piston.fin_outer_diameter)}."
            )
        if piston.fin_inner_diameter >= piston.fin_outer_diameter:
            raise DesignError(
                "actuator.piston.fin_inner_diameter must be below actuator.piston.fin_outer_diameter "
                f"{_mm(piston.fin_outer_diameter)}; got {_mm(piston.fin_inner_diameter)}."
            )
        if piston.fin_inner_diameter >= cylinder.inner_diameter:
            raise DesignError(
                "actuator.piston.fin_inner_diameter must be below actuator.cylinder.inner_diameter "
                f"{_mm(cylinder.inner_diameter)}; got {_mm(piston.fin_inner_diameter)}."
            )
        if piston.fin_length >= piston.length:
            raise DesignError(
                "actuator.piston.fin_length must be below actuator.piston.length "
                f"{_mm(piston.length)}; got {_mm(piston.fin_length)}."
            )
        if self.shaft.length <= self.array_length + 2 * piston.length:
            raise DesignError(
                "actuator.shaft.length must exceed the magnet array with its two pistons, "
                f"{_mm(self.array_length + 2 * piston.length)}; got {_mm(self.shaft.length)}."
            )
        if self.end_caps.flange_diameter <= cylinder.outer_diameter:
            raise DesignError(
                "actuator.end_caps.flange_diameter must exceed actuator.cylinder.outer_diameter "
                f"{_mm(cylinder.outer_diameter)}; got {_mm(self.end_caps.flange_diameter)}."
            )


def _mm(length: float) -> str:
    return format_quantity(length, "length", 6)
