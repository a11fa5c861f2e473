"""The actuator on the test stand of the contact-force benchmark (MCFC; Nakata and Noda 2023, Sec. IV) as frozen data.

Everything that the paper does not publish comes from the keys `benchmark.mcfc.*`; see docs/mcfc.md for each value's
reason.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from fluxbore.design import pneumatics
from fluxbore.design.bristle import Bristle
from fluxbore.design.dynamics.chamber import Chamber
from fluxbore.design.dynamics.disturbance import LoadActuator
from fluxbore.design.dynamics.force_map import ForceMap
from fluxbore.design.dynamics.velocity_estimate import VelocityEstimate
from fluxbore.design.errors import SpecError
from fluxbore.design.friction import SealFriction
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.keys import Values
from fluxbore.design.seal import contact_area
from fluxbore.design.units import format_quantity

ROUNDING = 1e-9
"""m; a position this far beyond the stroke's end is the end."""

OVERSHOOT = 2.0
"""Strokes that the chamber must have room for: one, and what a barely damped load actuator adds."""


@dataclass(frozen=True, slots=True)
class ContactForcePlant:
    """SI units.

    law : (6) as the controller knows it; seal : the friction as it is. chamber : at the cap end, the other end being
    open. position : of the mover before the disturbance (m, as in the force map). force_constant : the controller's.
    friction_scatter : standard deviation, from run to
    run, over the mean. step : of the simulation (s), of which a control period has `steps`.
    """

    law: SealFriction
    seal: Bristle
    chamber: Chamber
    load: LoadActuator
    estimate: VelocityEstimate
    force_map: ForceMap
    force_constant: float
    position: float
    stroke: float
    moving_mass: float
    valve_delay: float
    driver_delay: float
    driver_lag: float
    noise: float
    friction_scatter: float
    steps: int

    @property
    def step(self) -> float:
        return self.estimate.period / self.steps

    def target_pressure(self, force: float) -> float:
        """Gauge pressure (Pa) at which the cap-end chamber pushes with this force (N)."""
        return force / self.chamber.area

    @classmethod
    def from_values(
        cls,
        actuator: HybridActuator,
        values: Values,
        force_map: ForceMap,
        moving_mass: float | None = None,
        contact_force: float | None = None,
    ) -> ContactForcePlant:
        """The plant of these resolved values.

        moving_mass : of the actuator's mover (kg), which `benchmark.mcfc.moving_mass` replaces. contact_force : F_0 of
        its fins (N), which `actuator.seal.contact_force` replaces. Raises SpecError where neither of a pair is given,
        the chamber is smaller than the disturbance, or the disturbance leaves the mover's stroke.
        """

        def number(name: str) -> float:
            return float(values[f"benchmark.mcfc.{name}"])

        area, law = pneumatics.piston_area(actuator), seal_law(values, contact_force)
        share, period, stroke = number("friction_share"), number("control_period"), number("stroke")
        mass = _own("benchmark.mcfc.moving_mass", values, moving_mass)
        back, position = passed_positions(actuator, values)
        least, volume = OVERSHOOT * stroke * area, number("chamber_volume")
        if volume < least:
            raise SpecError(
                "benchmark.mcfc.chamber_volume must be at least what the piston sweeps over twice "
                f"benchmark.mcfc.stroke, {format_quantity(least, 'volume', 4)}; "
                f"got {format_quantity(volume, 'volume', 4)}."
            )
        given = values.get("benchmark.mcfc.force_constant")
        constant = force_map.within(back, position).mean_force_constant if given is None else float(given)
        if not constant > 0:
            raise SpecError(
                "benchmark.mcfc.force_constant must be given where the force map's mean is not above 0 N/A; "
                f"got a mean of {constant:.4g} N/A."
            )
        return cls(
            law=law,
            seal=scaled(
                Bristle(law, contact_area(actuator), number("bristle_stiffness"), number("bristle_damping")), share
            ),
            chamber=Chamber(volume, area, number("gas_exponent"), number("valve_lag")),
            load=LoadActuator(number("load_frequency"), number("load_damping")),
            estimate=VelocityEstimate(number("encoder_resolution"), period, number("velocity_filter")),
            force_map=force_map,
            force_constant=constant,
            position=position,
            stroke=stroke,
            moving_mass=mass,
            valve_delay=number("valve_delay"),
            driver_delay=number("driver_delay"),
            driver_lag=number("driver_lag"),
            noise=number("noise"),
            friction_scatter=number("friction_scatter"),
            steps=max(1, math.ceil(period / number("time_step") - 1e-9)),
        )


def scaled(seal: Bristle, share: float) -> Bristle:
    """The seal with its friction multiplied by a share of zero or more, its contact force being as it was."""
    law = seal.law
    return replace(
        seal,
        law=replace(
            law,
            static_coefficient=share * law.static_coefficient,
            coulomb_coefficient=share * law.coulomb_coefficient,
            viscous_coefficient=share * law.viscous_coefficient,
        ),
    )


def seal_law(values: Values, contact_force: float | None = None) -> SealFriction:
    """Equation (6) with the parameters of `actuator.seal`.

    contact_force : F_0 (N) where `actuator.seal.contact_force` is not given. Raises SpecError where neither is.
    """

    def number(name: str) -> float:
        return float(values[f"actuator.seal.{name}"])

    return SealFriction(
        number("static_coefficient"),
        number("coulomb_coefficient"),
        _own("actuator.seal.contact_force", values, contact_force),
        number("stribeck_speed"),
        number("viscous_coefficient"),
    )


def _own(key: str, values: Values, computed: float | None) -> float:
    """What the specification gives, else what was computed of the design."""
    value = values.get(key, computed)
    if value is None:
        raise SpecError(f"{key} must be given where it is not computed of the design; got none.")
    return float(value)


def passed_positions(actuator: HybridActuator, values: Values) -> tuple[float, float]:
    """z of the mover where the disturbance has pushed it back, and before it (m).

    Before it is as given, else the middle of the operating window. Raises SpecError where the way leaves the stroke.
    """
    position = values.get("benchmark.mcfc.position")
    if position is None:
        first, last = (float(values[f"operating_point.{name}_position"]) for name in ("first", "last"))
        position = (first + last) / 2
    before = float(position)
    back = before - float(values["benchmark.mcfc.stroke"])
    low, high = (actuator.mid_stroke + sign * actuator.mover.stroke / 2 for sign in (-1, 1))
    if not low - ROUNDING <= back <= before <= high + ROUNDING:
        shown = [format_quantity(value, "length", 6) for value in (low, high, back, before)]
        raise SpecError(
            "benchmark.mcfc.position, and benchmark.mcfc.stroke behind it, must lie within the mover's stroke, "
            f"{shown[0]} to {shown[1]}; got {shown[2]} to {shown[3]}."
        )
    return back, before
