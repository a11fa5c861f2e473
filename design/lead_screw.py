"""The magnetic lead screw as frozen parameters: two coaxial members with helical magnets, one screwing in the other.

The translator is the inner member, its magnets on its surface; the rotor surrounds it across the gap (the RotLin
actuator, a rotary-linear series elastic actuator: "Novel force estimation method for magnetic lead screw-based RotLin
actuator", Figs. 2, 3 and 5, Table I; symbols are that paper's). Along the axis the magnets of a member alternate, so
that two neighbours, one of each polarity, make up the pitch l_p. Turning the rotor once moves the field by one lead,
starts x l_p, and

    h = starts l_p / 2 pi,      x_d = h theta - x,      T_s = h F_s                          (2), (3), (6)

The keys of a specification bear the names of the fields: actuator.pitch, actuator.starts, actuator.poles,
actuator.gap, actuator.gap_tolerance, actuator.translator.outer_radius, actuator.translator.length,
actuator.translator.magnet_thickness and so on, actuator.rotor.magnet_thickness and so on; the sentences name them thus.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fluxbore.design.errors import DesignError
from fluxbore.design.units import format_quantity

ROUNDING = 1e-9
"""Relative; magnets that overlap by no more touch, and what is thinner beside its radius or pitch is not there."""


@dataclass(frozen=True, slots=True)
class Arcs:
    """Magnets cut around the axis: `per_turn` pieces of the angle (rad) each, in one turn of one helix.

    stepped : each piece lies in a plane across the axis, as a ring's sector does, so that the poles climb in steps;
        otherwise each follows the helix, and only the spaces between are missing.
    """

    angle: float
    per_turn: int
    stepped: bool

    @property
    def fill(self) -> float:
        """Share of the circumference that is magnet."""
        return self.per_turn * self.angle / (2 * math.pi)


@dataclass(frozen=True, slots=True)
class HelicalMagnets:
    """Radially magnetised magnets of one member, and what carries them. Lengths in m, densities in kg/m^3."""

    magnet_thickness: float  # l_m, radial
    magnet_width: float  # axial, of one magnet; half the pitch where neighbours touch
    remanence: float  # B_rem, T
    magnet_permeability: float = 1.0  # mu_r of the recoil line
    magnet_density: float = 7500.0
    arcs: Arcs | None = None  # None: continuous helices
    iron_thickness: float = 0.0  # of the soft iron behind the magnets; 0 where there is none
    iron_density: float = 7850.0


@dataclass(frozen=True, slots=True)
class LeadScrew:
    """All parameters of one magnetic lead screw, SI units.

    Raises DesignError, one sentence, where it cannot be built: a value that is no number or not above zero, a pitch
    shorter than two magnet widths, arcs that overlap, a gap that its tolerance closes, a back iron thicker than the
    translator, a translator or a frame shorter than the rotor's magnets, a frame within them.
    """

    pitch: float  # l_p, from one magnet to the next of the same polarity
    poles: int  # p_a, of the rotor along the axis; two fill a pitch
    translator_radius: float  # R_t, outside of its magnets
    gap: float  # l_g, between the magnets of both
    translator: HelicalMagnets
    rotor: HelicalMagnets
    translator_length: float  # of its magnets, along the axis
    frame_radius: float  # R_r, outside of the rotor's frame
    frame_length: float
    starts: int = 1
    gap_tolerance: float = 0.0  # by how much radii, bearings and a bent shaft may close the gap in all
    frame_density: float = 1400.0
    carried_mass: float = 0.0  # kg, of whatever moves with the rotor along the axis and does not turn

    def __post_init__(self) -> None:
        self._check_numbers()
        self._check_member("translator", self.translator)
        self._check_member("rotor", self.rotor)
        if self.gap <= self.gap_tolerance:
            raise DesignError(
                f"actuator.gap must exceed actuator.gap_tolerance {_mm(self.gap_tolerance)}, or the members touch; "
                f"got {_mm(self.gap)}."
            )
        self._check_thin()
        if self.translator.magnet_thickness + self.translator.iron_thickness > self.translator_radius:
            raise DesignError(
                "actuator.translator.outer_radius must hold its magnets and the iron within, at least "
                f"{_mm(self.translator.magnet_thickness + self.translator.iron_thickness)}; "
                f"got {_mm(self.translator_radius)}."
            )
        if self.translator_length < self.active_length * (1 - ROUNDING):
            raise DesignError(
                "actuator.translator.length must be at least the length of the rotor's poles, "
                f"{_mm(self.active_length)}; got {_mm(self.translator_length)}."
            )
        if self.frame_length < self.active_length * (1 - ROUNDING):
            raise DesignError(
                f"actuator.rotor.length must be at least the length of its poles, {_mm(self.active_length)}; "
                f"got {_mm(self.frame_length)}."
            )
        if self.frame_radius < self.rotor_iron_radius * (1 - ROUNDING):
            raise DesignError(
                "actuator.rotor.outer_radius must hold the rotor's magnets and iron, at least "
                f"{_mm(self.rotor_iron_radius)}; got {_mm(self.frame_radius)}."
            )

    @property
    def h(self) -> float:
        """m/rad, of the paper's (3): how far the field moves per angle of the rotor."""
        return self.starts * self.pitch / (2 * math.pi)

    @property
    def active_length(self) -> float:
        """m, of the rotor's magnets along the axis: half a pitch for each pole."""
        return self.poles * self.pitch / 2

    @property
    def bore_radius(self) -> float:
        """m, inside of the rotor's magnets."""
        return self.translator_radius + self.gap

    @property
    def rotor_magnet_radius(self) -> float:
        """m, outside of the rotor's magnets."""
        return self.bore_radius + self.rotor.magnet_thickness

    @property
    def rotor_iron_radius(self) -> float:
        """m, outside of the rotor's back iron."""
        return self.rotor_magnet_radius + self.rotor.iron_thickness

    @property
    def radii(self) -> tuple[float, float, float, float]:
        """m: inside and outside of the translator's magnets, inside and outside of the rotor's."""
        inner = self.translator_radius - self.translator.magnet_thickness
        return inner, self.translator_radius, self.bore_radius, self.rotor_magnet_radius

    def _check_numbers(self) -> None:
        lengths = (
            ("actuator.pitch", self.pitch),
            ("actuator.translator.outer_radius", self.translator_radius),
            ("actuator.gap", self.gap),
            ("actuator.translator.length", self.translator_length),
            ("actuator.rotor.outer_radius", self.frame_radius),
            ("actuator.rotor.length", self.frame_length),
        )
        for key, value in lengths:
            if not (math.isfinite(value) and value > 0):
                raise DesignError(f"{key} must be finite and above 0 mm; got {_mm(value)}.")
        for key, count in (("actuator.poles", self.poles), ("actuator.starts", self.starts)):
            if count < 1:
                raise DesignError(f"{key} must be at least 1; got {count}.")
        if not (math.isfinite(self.gap_tolerance) and self.gap_tolerance >= 0):
            raise DesignError(f"actuator.gap_tolerance must be finite and 0 mm or more; got {_mm(self.gap_tolerance)}.")
        for key, value, unit in (
            ("actuator.rotor.frame_density", self.frame_density, "kg/m^3"),
            ("actuator.carried_mass", self.carried_mass, "kg"),
        ):
            if not (math.isfinite(value) and value >= 0):
                raise DesignError(f"{key} must be finite and 0 {unit} or more; got {value:g} {unit}.")

    def _check_thin(self) -> None:
        radius = "actuator.translator.outer_radius", self.translator_radius
        for key, length, (whole, size) in (
            ("gap", self.gap, radius),
            ("translator.magnet_thickness", self.translator.magnet_thickness, radius),
            ("rotor.magnet_thickness", self.rotor.magnet_thickness, radius),
            ("translator.magnet_width", self.translator.magnet_width, ("actuator.pitch", self.pitch)),
            ("rotor.magnet_width", self.rotor.magnet_width, ("actuator.pitch", self.pitch)),
        ):
            if length < ROUNDING * size:
                raise DesignError(
                    f"actuator.{key} must be at least {_mm(ROUNDING * size)}, {ROUNDING:g} of {whole}; "
                    f"got {_mm(length)}."
                )

    def _check_member(self, name: str, member: HelicalMagnets) -> None:
        key = f"actuator.{name}."
        for field in ("magnet_thickness", "magnet_width"):
            value = getattr(member, field)
            if not (math.isfinite(value) and value > 0):
                raise DesignError(f"{key}{field} must be finite and above 0 mm; got {_mm(value)}.")
        for field, least, unit in (
            ("remanence", 0.0, " T"),
            ("magnet_permeability", 1.0, ""),
            ("magnet_density", 0.0, " kg/m^3"),
            ("iron_thickness", 0.0, " m"),
            ("iron_density", 0.0, " kg/m^3"),
        ):
            value = getattr(member, field)
            if not (math.isfinite(value) and value >= least):
                raise DesignError(f"{key}{field} must be finite and at least {least:g}{unit}; got {value:g}{unit}.")
        if self.pitch < 2 * member.magnet_width * (1 - ROUNDING):
            raise DesignError(
                f"actuator.pitch must be at least two magnet widths, {_mm(2 * member.magnet_width)} by "
                f"{key}magnet_width; got {_mm(self.pitch)}."
            )
        if member.arcs is not None:
            self._check_arcs(key, member.arcs)

    def _check_arcs(self, key: str, arcs: Arcs) -> None:
        if arcs.per_turn < 1:
            raise DesignError(f"{key}arcs_per_turn must be at least 1; got {arcs.per_turn}.")
        if not (math.isfinite(arcs.angle) and arcs.angle > 0):
            raise DesignError(f"{key}arc_angle must be finite and above 0 deg; got {math.degrees(arcs.angle):g} deg.")
        if arcs.fill > 1 + ROUNDING:
            raise DesignError(
                f"{key}arc_angle must be at most {360 / arcs.per_turn:g} deg, or the {arcs.per_turn} arcs of a turn "
                f"overlap; got {math.degrees(arcs.angle):g} deg."
            )


def _mm(length: float) -> str:
    return format_quantity(length, "length")
