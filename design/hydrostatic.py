"""An electro-hydrostatic actuator with a passive return, component by component, in the order in which power flows.

    motor -> coupling -> ball screw -> input cylinder -> port, fitting -> hose -> pressure block -> hose
          -> fitting, port -> output cylinder -> (series spring) -> return element

after the paper on the PREHydrA, Secs. II to IV and Table II. Each component holds what its data sheet gives, SI units;
which of the numbers the paper publishes and which are assumed is the specification's to mark. Volumes, areas and
reflected inertias follow from them here; nothing else in the model holds a dimension of its own.

Both cylinders push: single-acting, one piston seal each, no rod seal. Fluid inertia and leakage are left out, as the
paper does (Sec. III); `fluid_mass_at_piston` tells what the first would add.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from fluxbore.design.cylinder_friction import CylinderFriction
from fluxbore.design.errors import DesignError
from fluxbore.design.flow_resistance import Orifice
from fluxbore.design.fluid import Fluid
from fluxbore.design.return_element import ReturnElement


@dataclass(frozen=True, slots=True)
class Motor:
    """Table II, item 2 (data sheet of the servomotor).

    maximum_speed (rad/s), continuous_torque, peak_torque (N m), rated_power (W, mechanical), torque_constant (N m per
    ampere rms), resistance (ohm, line to line), inertia (kg m^2), mass (kg).
    """

    maximum_speed: float
    continuous_torque: float
    peak_torque: float
    torque_constant: float
    resistance: float
    inertia: float
    rated_power: float | None = None
    mass: float = 0.0

    def __post_init__(self) -> None:
        _check(
            "motor",
            self,
            above=("maximum_speed", "continuous_torque", "peak_torque", "torque_constant", "inertia"),
            least=("resistance", "mass"),
        )
        if self.peak_torque < self.continuous_torque:
            raise DesignError(
                f"actuator.motor.peak_torque must not be below actuator.motor.continuous_torque "
                f"{self.continuous_torque:g} N m; got {self.peak_torque:g} N m."
            )


@dataclass(frozen=True, slots=True)
class Drive:
    """Table II, item 1, and Sec. III-B: the velocity loop in the drive and the force loop around it.

    bandwidth : of the velocity loop (rad/s). integral_time : of its PI controller (s). force_gain : k_p (m/(N s)).
    force_period : of the sampled force loop (s). delay : from a force sample to the drive's velocity command (s).
    """

    bandwidth: float
    integral_time: float
    force_gain: float
    force_period: float
    delay: float = 0.0
    mass: float = 0.0

    def __post_init__(self) -> None:
        _check("drive", self, above=("bandwidth", "integral_time", "force_period"), least=("force_gain", "delay"))


@dataclass(frozen=True, slots=True)
class Coupling:
    """Table II, item 3. inertia (kg m^2), mass (kg); torsionally stiff against the fluid."""

    inertia: float = 0.0
    mass: float = 0.0

    def __post_init__(self) -> None:
        _check("coupling", self, least=("inertia", "mass"))


@dataclass(frozen=True, slots=True)
class BallScrew:
    """Table II, item 5. lead (m), efficiency (driving), inertia of the screw (kg m^2), mass (kg)."""

    lead: float
    efficiency: float = 1.0
    inertia: float = 0.0
    mass: float = 0.0

    def __post_init__(self) -> None:
        _check("ball_screw", self, above=("lead",), least=("inertia", "mass"))
        if not 0.5 < self.efficiency <= 1:
            raise DesignError(
                f"actuator.ball_screw.efficiency must be above 0.5, for a screw that can be driven back, and at most "
                f"1; got {self.efficiency:g}."
            )

    @property
    def ratio(self) -> float:
        """i (m/rad)."""
        return self.lead / math.tau


@dataclass(frozen=True, slots=True)
class HydraulicCylinder:
    """Table II, item 7.

    bore, stroke (m); wall_thickness of the tube, rod_diameter (m); dead_volume behind the piston at its end (m^3);
    rated_pressure (Pa gauge); moving_mass of piston, rod and what is fixed to them, mass of the whole (kg); friction of
    its seal.
    """

    bore: float
    stroke: float
    friction: CylinderFriction
    rated_pressure: float
    moving_mass: float
    dead_volume: float = 0.0
    wall_thickness: float | None = None
    rod_diameter: float | None = None
    mass: float = 0.0
    name: str = "output_cylinder"

    def __post_init__(self) -> None:
        _check(
            self.name,
            self,
            above=("bore", "stroke", "rated_pressure", "moving_mass"),
            least=("dead_volume", "mass"),
            optional=("wall_thickness", "rod_diameter"),
        )
        if self.rod_diameter is not None and self.rod_diameter > self.bore:
            raise DesignError(
                f"actuator.{self.name}.rod_diameter must not exceed the bore {self.bore * 1e3:.6g} mm; "
                f"got {self.rod_diameter * 1e3:.6g} mm."
            )

    @property
    def area(self) -> float:
        """A (m^2)."""
        return math.pi / 4 * self.bore**2


@dataclass(frozen=True, slots=True)
class Hose:
    """Table II, item 11.

    bore, length, roughness (m); wall_modulus : pressure over the share by which the wall gives it more volume (Pa),
    infinite for a stiff one; linear_mass (kg/m); rated_pressure, burst_pressure (Pa gauge).
    """

    bore: float
    length: float
    roughness: float = 0.0
    wall_modulus: float = math.inf
    linear_mass: float = 0.0
    rated_pressure: float | None = None
    burst_pressure: float | None = None

    def __post_init__(self) -> None:
        _check(
            "hose",
            self,
            above=("bore", "length"),
            least=("roughness", "linear_mass"),
            optional=("rated_pressure", "burst_pressure"),
        )
        if not self.wall_modulus > 0:
            raise DesignError(f"actuator.hose.wall_modulus must be above 0 Pa; got {self.wall_modulus:g} Pa.")

    @property
    def volume(self) -> float:
        """m^3, without pressure."""
        return math.pi / 4 * self.bore**2 * self.length


@dataclass(frozen=True, slots=True)
class PressureBlock:
    """Table II, items 8 and 12: the block with sensor and bleed screw half way along the hose. volume (m^3)."""

    orifice: Orifice
    volume: float = 0.0
    mass: float = 0.0

    def __post_init__(self) -> None:
        _check("pressure_block", self, least=("volume", "mass"))


@dataclass(frozen=True, slots=True)
class HydrostaticActuator:
    """SI units. `initial_pressure` : of the filled system at rest against its return element, None for what balances
    it. `distal` : the masses (kg) that are worn at the joint besides cylinder, springs and half of the hose."""

    name: str
    motor: Motor
    drive: Drive
    coupling: Coupling
    ball_screw: BallScrew
    input_cylinder: HydraulicCylinder
    port: Orifice
    fitting: Orifice
    hose: Hose
    block: PressureBlock
    output_cylinder: HydraulicCylinder
    return_element: ReturnElement
    fluid: Fluid
    temperature: float = 293.15
    series_stiffness: float | None = None
    other_distal_mass: float = 0.0
    assumed: tuple[str, ...] = field(default=())

    def __post_init__(self) -> None:
        if self.series_stiffness is not None:
            _check("series_spring", _Stiffness(self.series_stiffness), above=("stiffness",))
        if not self.temperature > 0:
            raise DesignError(f"operating_point.temperature must be above 0 K; got {self.temperature:g} K.")
        need = self.output_cylinder.area * self.output_cylinder.stroke
        have = self.input_cylinder.area * self.input_cylinder.stroke
        if have < need * (1 - 1e-9):
            raise DesignError(
                "actuator.input_cylinder.stroke must displace what the output cylinder takes over its stroke, "
                f"{need * 1e6:.4g} ml; got {have * 1e6:.4g} ml."
            )

    @property
    def maximum_velocity(self) -> float:
        """Of the input piston (m/s), by the motor's speed."""
        return self.motor.maximum_speed * self.ball_screw.ratio

    @property
    def hydraulic_ratio(self) -> float:
        """Output speed over input speed."""
        return self.input_cylinder.area / self.output_cylinder.area

    @property
    def reflected_mass(self) -> float:
        """Of rotor, coupling, screw and input piston, at the input piston (kg)."""
        inertia = self.motor.inertia + self.coupling.inertia + self.ball_screw.inertia
        return inertia / self.ball_screw.ratio**2 + self.input_cylinder.moving_mass

    @property
    def fluid_volume(self) -> float:
        """Of the filled system with the output retracted (m^3): that of the input's stroke that can be sent over, dead
        volumes, hose and block."""
        sent = self.output_cylinder.area * self.output_cylinder.stroke
        dead = self.input_cylinder.dead_volume + self.output_cylinder.dead_volume
        return sent + dead + self.hose.volume + self.block.volume


def fluid_mass_at_piston(actuator: HydrostaticActuator) -> float:
    """Of the fluid as the output piston feels it (kg): each piece of it by the square of its speed over the piston's.

    The narrow hose counts by far the most. Left out of the model.
    """
    density, area = actuator.fluid.density, actuator.output_cylinder.area
    hose = math.pi / 4 * actuator.hose.bore**2
    return density * (area**2 * actuator.hose.length / hose + area * actuator.output_cylinder.stroke)


@dataclass(frozen=True, slots=True)
class _Stiffness:
    stiffness: float


def _check(
    section: str,
    component: Any,
    *,
    above: Iterable[str] = (),
    least: Iterable[str] = (),
    optional: Iterable[str] = (),
) -> None:
    """Raise DesignError for a datum that is missing or out of range; `optional` ones may be None."""
    for name in above:
        _number(f"actuator.{section}.{name}", getattr(component, name), positive=True)
    for name in least:
        _number(f"actuator.{section}.{name}", getattr(component, name), positive=False)
    for name in optional:
        if getattr(component, name) is not None:
            _number(f"actuator.{section}.{name}", getattr(component, name), positive=True)


def _number(key: str, value: float | None, *, positive: bool) -> None:
    if value is None:
        raise DesignError(f"{key} is missing.")
    if not (math.isfinite(value) and (value > 0 if positive else value >= 0)):
        limit = "above 0" if positive else "0 or above"
        raise DesignError(f"{key} must be finite and {limit}; got {value:g}.")
