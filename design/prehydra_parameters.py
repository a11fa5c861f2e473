"""The PREHydrA prototype: what the paper gives (Secs. II to IV, Tables I and II), and what had to be assumed.

`ASSUMED` has the reason of every number that the paper does not publish; reports list them. None was tuned to the
paper's tracking errors: each is what a data sheet or a handbook gives for such a part.
"""

from __future__ import annotations

import math

from fluxbore.design.cylinder_friction import PUBLISHED
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
from fluxbore.design.return_element import LinearReturn

ASSUMED = {
    "motor.peak_torque": "about three times the continuous torque, usual for such servomotors",
    "motor.torque_constant": "of the maker's C winding, from general knowledge of the series",
    "motor.resistance": "of the same winding",
    "motor.inertia": "of the series' second length without a brake",
    "drive.bandwidth": "80 Hz: a velocity loop of moderate tuning",
    "drive.integral_time": "ten times the velocity loop's time constant",
    "drive.force_period": "1 kHz, a common rate of the real-time target that was used",
    "drive.delay": "none: the paper's model names none beside the sampling",
    "coupling.inertia": "aluminium, 25 mm long and wide",
    "ball_screw.efficiency": "a rolled, grease-lubricated ball screw",
    "ball_screw.inertia": "a steel bar of 14 mm by 325 mm",
    "input_cylinder.moving_mass": "0.75 kg in all (60 g of fluid are 8 % of it), less the output's and the fluid",
    "output_cylinder.moving_mass": "piston, rod and carriage",
    "cylinder.stroke": "6 in, which 433 N at 2840 N/m confirm",
    "cylinder.dead_volume": "what 56 ml of fluid leave, with hose and block",
    "cylinder.wall_thickness": "drawn brass tube of such bores",
    "cylinder.rod_diameter": "1/4 in",
    "port.diameter": "clear bore of the connectors' thread",
    "fitting.diameter": "clear bore of the connectors' thread",
    "block.diameter": "as the fittings",
    "discharge_coefficient": "0.7, between a sharp and a rounded edge",
    "hose.bore": "1/4 in",
    "hose.roughness": "smooth plastic",
    "hose.wall_modulus": "stiff: the paper's hose model has friction and the fluid's compressibility (Sec. III-A)",
    "fluid.density": "half ethylene glycol, half water at 20 degC",
    "fluid.viscosity": "half ethylene glycol, half water by volume: 2.8 mPa s at 26.7 degC, 0.95 at 71.1 degC",
    "fluid.bulk_modulus": "of water and glycol by their velocity of sound",
    "fluid.air_fraction": "0.5 %, the default of Simscape's hydraulic fluid, in which the paper's model was made",
    "return_spring.preload": "the 45 N by which the references are offset to compensate for the springs' pretension",
    "output_cylinder.mass": "the split of the published 0.5 kg between cylinder and springs",
    "mass": "of motor, coupling, screw, block and hose; the drive is left out, as Fig. 1 leaves it out",
}


def prehydra() -> HydrostaticActuator:
    """The prototype; every number that `ASSUMED` does not name is published."""
    ports = Orifice(4.5e-3)

    def cylinder(name: str, moving_mass: float) -> HydraulicCylinder:
        return HydraulicCylinder(
            bore=14.3e-3,
            stroke=0.1524,
            friction=PUBLISHED,
            rated_pressure=70e5,
            moving_mass=moving_mass,
            dead_volume=5e-6,
            wall_thickness=0.8e-3,
            rod_diameter=6.35e-3,
            mass=0.35,
            name=name,
        )

    return HydrostaticActuator(
        name="PREHydrA",
        motor=Motor(592.0, 0.84, 2.7, 0.61, 13.0, 1.6e-5, 290.0, mass=1.1),
        drive=Drive(math.tau * 80, 20e-3, 1e-3, 1e-3),
        coupling=Coupling(3e-6, 0.03),
        ball_screw=BallScrew(5e-3, 0.9, 9.6e-6, 0.5),
        input_cylinder=cylinder("input_cylinder", 0.24),
        port=ports,
        fitting=ports,
        hose=Hose(6.35e-3, 0.5, 1.5e-6, linear_mass=0.1),
        block=PressureBlock(ports, 5e-6, 0.1),
        output_cylinder=cylinder("output_cylinder", 0.45),
        return_element=LinearReturn(2840.0, 45.0, 0.15),
        fluid=Fluid(
            density=1070.0,
            bulk_modulus=2.8e9,
            viscosity=2.8e-3,
            hot_viscosity=0.95e-3,
            reference_temperature=299.85,
            hot_temperature=344.25,
            air_fraction=0.005,
            expansion=5e-4,
        ),
        temperature=299.85,
        assumed=tuple(ASSUMED),
    )
