"""From a specification's values to an electro-hydrostatic actuator's parameters."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from fluxbore.design.cylinder_friction import CylinderFriction
from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.flow_resistance import Orifice
from fluxbore.design.fluid import Fluid
from fluxbore.design.hydrostatic import (
    BallScrew,
    Coupling,
    Drive,
    Hose,
    HydraulicCylinder,
    HydrostaticActuator,
    Motor,
    PressureBlock,
)
from fluxbore.design.hydrostatic_keys import CONSTANT, CORD, CYLINDERS, LINEAR
from fluxbore.design.keys import Value, Values
from fluxbore.design.return_element import ConstantReturn, CordReturn, LinearReturn, ReturnElement
from fluxbore.design.seal_gland import SealGland, designed_gland
from fluxbore.design.threads import PORTS, SCREWS, Thread
from fluxbore.design.units import STANDARD_ATMOSPHERE

UNWEIGHED = 1.0
"""kg, of a part that is yet to be weighed as drawn; `HydrostaticDesign.weighed` puts its mass in its place."""

_GROOVE = ("ring_inner_diameter", "groove_diameter", "groove_width")

_NEEDED = {
    LINEAR: ("rate",),
    CONSTANT: ("preload",),
    CORD: ("cord_length", "cord_area", "cord_stretch", "cord_first"),
}
"""What each return element is described by."""


@dataclass(frozen=True, slots=True)
class CylinderShape:
    """What is drawn of a cylinder beyond its bore, stroke, wall and rod: lengths (m), names of materials.

    bush_wall : of the rod's bush, 0 where the cap bears the rod. wiper_width : 0 for none. mounting : the thread of the
    tapped holes by which it is fixed; None where there are none.
    """

    piston_length: float
    cap_length: float
    bleed_thread: float
    material: str
    rod: str
    bush_wall: float = 0.0
    wiper_width: float = 0.0
    mounting: Thread | None = None


@dataclass(frozen=True, slots=True)
class HydrostaticDesign:
    """An actuator as specified. `unweighed` : the masses that follow from its parts, "output_cylinder.mass" and so on;
    in `bare` they are `UNWEIGHED`. `shapes` : by cylinder. `gland` : of the output piston's O-ring. `port_thread` : of
    the cylinders' ports, None of plain drillings."""

    bare: HydrostaticActuator
    unweighed: tuple[str, ...]
    shapes: Mapping[str, CylinderShape]
    gland: SealGland
    port_thread: Thread | None = None

    @property
    def name(self) -> str:
        return self.bare.name

    def weighed(self, masses: Mapping[str, float]) -> HydrostaticActuator:
        """The actuator with the masses (kg) of its parts, one for each of `unweighed`."""
        actuator = self.bare
        for name in CYLINDERS:
            found = {
                leaf: masses[f"{name}.{leaf}"] for leaf in ("moving_mass", "mass") if f"{name}.{leaf}" in self.unweighed
            }
            actuator = replace(actuator, **{name: replace(getattr(actuator, name), **found)})
        if "return_spring.mass" in self.unweighed:
            element: Any = actuator.return_element
            actuator = replace(actuator, return_element=replace(element, mass=masses["return_spring.mass"]))
        return actuator


def resolve(given: Values) -> dict[str, Value]:
    """Complete the given keys: the O-ring's groove by the standard's rules where none of it is given.

    Raises nothing; what cannot be built is `from_values`'s.
    """
    values = dict(given)
    if not any(f"actuator.seal.{leaf}" in values for leaf in _GROOVE):
        try:
            gland = designed_gland(
                float(values["actuator.output_cylinder.bore"]), float(values["actuator.seal.ring_section"])
            )
        except DesignError:
            return values
        values.update({f"actuator.seal.{leaf}": getattr(gland, leaf) for leaf in _GROOVE})
    return values


def check(values: Values) -> None:
    """Raise SpecError where the return element or the seal is described in part."""
    element = str(values["actuator.return_spring.element"])
    for leaf in _NEEDED[element]:
        if f"actuator.return_spring.{leaf}" not in values:
            raise SpecError(f'actuator.return_spring.{leaf} is missing: actuator.return_spring.element is "{element}".')
    for leaf in _GROOVE:
        if f"actuator.seal.{leaf}" not in values and any(f"actuator.seal.{other}" in values for other in _GROOVE):
            raise SpecError(f"actuator.seal.{leaf} is missing: the groove must be given whole, or not at all.")


def from_values(values: Values) -> HydrostaticDesign:
    """The parameters of the resolved values. Raises DesignError, one sentence, where they cannot be built."""
    check(values)
    number = _Reader(values)
    section, bore = number("seal.ring_section"), number("output_cylinder.bore")
    if "actuator.seal.groove_diameter" not in values:
        designed_gland(bore, section)  # says why there is none
    gland = SealGland(
        bore,
        number("seal.groove_diameter"),
        number("seal.groove_width"),
        number("seal.ring_inner_diameter"),
        section,
    )
    friction = CylinderFriction(
        number("friction.preload"),
        number("friction.pressure_coefficient"),
        number("friction.stribeck_force"),
        number("friction.stribeck_decay"),
        number("friction.viscous_coefficient"),
        number("friction.linear_speed"),
    )
    bare = HydrostaticActuator(
        name=str(values["actuator.name"]),
        motor=Motor(
            maximum_speed=number("motor.maximum_speed"),
            continuous_torque=number("motor.continuous_torque"),
            peak_torque=number("motor.peak_torque"),
            torque_constant=number("motor.torque_constant"),
            resistance=number("motor.resistance"),
            inertia=number("motor.inertia"),
            rated_power=number.optional("motor.rated_power"),
            mass=number("motor.mass"),
        ),
        drive=Drive(
            bandwidth=math.tau * number("drive.bandwidth"),
            integral_time=number("drive.integral_time"),
            force_gain=number("drive.force_gain"),
            force_period=number("drive.force_period"),
            delay=number("drive.delay"),
            mass=number("drive.mass"),
        ),
        coupling=Coupling(number("coupling.inertia"), number("coupling.mass")),
        ball_screw=BallScrew(
            number("ball_screw.lead"),
            number("ball_screw.efficiency"),
            number("ball_screw.inertia"),
            number("ball_screw.mass"),
        ),
        input_cylinder=_cylinder(number, "input_cylinder", friction),
        port=_orifice(number, "port"),
        fitting=_orifice(number, "fitting"),
        hose=Hose(
            bore=number("hose.bore"),
            length=number("hose.length"),
            roughness=number("hose.roughness"),
            wall_modulus=number.optional("hose.wall_modulus") or math.inf,
            linear_mass=number("hose.linear_mass"),
            rated_pressure=number.optional("hose.rated_pressure"),
            burst_pressure=number.optional("hose.burst_pressure"),
        ),
        block=PressureBlock(
            _orifice(number, "pressure_block"), number("pressure_block.volume"), number("pressure_block.mass")
        ),
        output_cylinder=_cylinder(number, "output_cylinder", friction),
        return_element=_return_element(values, number),
        fluid=_fluid(number),
        temperature=float(values["operating_point.temperature"]),
        series_stiffness=number.optional("series_spring.stiffness"),
        other_distal_mass=number("other_distal_mass"),
    )
    masses = [f"{name}.{leaf}" for name in CYLINDERS for leaf in ("moving_mass", "mass")] + ["return_spring.mass"]
    return HydrostaticDesign(
        bare,
        tuple(name for name in masses if number.optional(name) is None),
        {
            name: CylinderShape(
                number(f"{name}.piston_length"),
                number(f"{name}.cap_length"),
                number(f"{name}.bleed_thread"),
                str(values[f"actuator.{name}.material"]),
                str(values[f"actuator.{name}.rod"]),
                number(f"{name}.bush_wall"),
                number(f"{name}.wiper_width"),
                SCREWS.get(str(values.get(f"actuator.{name}.mounting_thread"))),
            )
            for name in CYLINDERS
        },
        gland,
        PORTS.get(str(values.get("actuator.port.thread"))),
    )


@dataclass(frozen=True, slots=True)
class _Reader:
    """Numbers of the section `actuator` by the rest of their keys."""

    values: Values

    def __call__(self, name: str) -> float:
        return float(self.values[f"actuator.{name}"])

    def optional(self, name: str) -> float | None:
        value = self.values.get(f"actuator.{name}")
        return None if value is None else float(value)

    def mass(self, name: str) -> float:
        found = self.optional(name)
        return UNWEIGHED if found is None else found


def _cylinder(number: _Reader, name: str, friction: CylinderFriction) -> HydraulicCylinder:
    return HydraulicCylinder(
        bore=number(f"{name}.bore"),
        stroke=number(f"{name}.stroke"),
        friction=friction,
        rated_pressure=number(f"{name}.rated_pressure"),
        moving_mass=number.mass(f"{name}.moving_mass"),
        dead_volume=number(f"{name}.dead_volume"),
        wall_thickness=number(f"{name}.wall_thickness"),
        rod_diameter=number(f"{name}.rod_diameter"),
        mass=number.mass(f"{name}.mass"),
        name=name,
    )


def _orifice(number: _Reader, name: str) -> Orifice:
    return Orifice(number(f"{name}.diameter"), number(f"{name}.discharge_coefficient"))


def _fluid(number: _Reader) -> Fluid:
    return Fluid(
        density=number("fluid.density"),
        bulk_modulus=number("fluid.bulk_modulus"),
        viscosity=number("fluid.viscosity"),
        hot_viscosity=number("fluid.hot_viscosity"),
        reference_temperature=number("fluid.reference_temperature"),
        hot_temperature=number("fluid.hot_temperature"),
        modulus_rise=number("fluid.modulus_rise"),
        air_fraction=number("fluid.air_fraction"),
        air_exponent=number("fluid.air_exponent"),
        expansion=number("fluid.expansion"),
        # Pressures are kept as gauge pressures; the fluid's own is absolute.
        vapour_pressure=number("fluid.vapour_pressure") + STANDARD_ATMOSPHERE,
        heat_capacity=number("fluid.heat_capacity"),
    )


def _return_element(values: Values, number: _Reader) -> ReturnElement:
    kind, mass = values["actuator.return_spring.element"], number.mass("return_spring.mass")
    preload = number("return_spring.preload")
    if kind == LINEAR:
        return LinearReturn(number("return_spring.rate"), preload, mass)
    if kind == CONSTANT:
        return ConstantReturn(preload, mass)
    return CordReturn(
        length=number("return_spring.cord_length"),
        area=number("return_spring.cord_area"),
        stretch=number("return_spring.cord_stretch"),
        first=number("return_spring.cord_first"),
        second=number("return_spring.cord_second"),
        mass=mass,
    )
