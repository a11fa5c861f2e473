"""The keys of the benchmark that maintains a contact force constant (MCFC; Nakata and Noda 2023, Sec. IV).

Published are the twelve frequencies, the four target forces, ten round trips and the encoder's resolution. Whatever
else the test stand and its controllers were is a key here, for the paper does not say.
"""

from __future__ import annotations

from fluxbore.design.keys import Key

ENCODER_RESOLUTION = 5.4e-6
"""m, of the position encoder AEDR-8400 as the paper gives it."""

_LONGEST = 10.0
"""s; a lag or a delay of the test stand beyond this is a slip of the unit."""


def _time(name: str, doc: str, default: float) -> Key:
    return Key(f"benchmark.mcfc.{name}", doc, dimension="time", minimum=0.0, maximum=_LONGEST, default=default)


CONTACT_FORCE_KEYS: tuple[Key, ...] = (
    Key(
        "benchmark.mcfc.stroke",
        "peak to peak of the load actuator's triangular disturbance",
        above=0.0,
        maximum=1.0,
        default=1.05e-3,
    ),
    Key(
        "benchmark.mcfc.position",
        "of the mover before the disturbance pushes it back; without it the middle of the operating window",
        optional=True,
    ),
    Key(
        "benchmark.mcfc.load_frequency",
        "natural frequency of the load actuator's position control",
        dimension="frequency",
        minimum=5.0,
        maximum=1e4,
        default=40.0,
    ),
    Key(
        "benchmark.mcfc.load_damping",
        "damping ratio of the load actuator's position control",
        kind="number",
        minimum=0.05,
        maximum=0.99,
        default=0.7,
    ),
    Key(
        "benchmark.mcfc.moving_mass",
        "that follows the load; without it the mover's own",
        dimension="mass",
        minimum=0.0,
        maximum=1e4,
        optional=True,
    ),
    Key(
        "benchmark.mcfc.bristle_stiffness",
        "of the seal before it slides",
        dimension="stiffness",
        symbol="sigma_0",
        minimum=1.0,
        maximum=1e10,
        default=1e5,
    ),
    Key(
        "benchmark.mcfc.bristle_damping",
        "of the seal before it slides",
        dimension="viscous friction",
        symbol="sigma_1",
        minimum=0.0,
        maximum=1e6,
        default=0.0,
    ),
    Key(
        "benchmark.mcfc.friction_share",
        "the seal's friction over what the controller takes it for",
        kind="number",
        minimum=0.0,
        maximum=10.0,
        default=1.0,
    ),
    Key(
        "benchmark.mcfc.friction_scatter",
        "standard deviation, from run to run, of the seal's friction over its mean",
        kind="number",
        minimum=0.0,
        maximum=1.0,
        default=0.0,
    ),
    _time("valve_delay", "dead time of the pressure control valve", 0.02),
    Key(
        "benchmark.mcfc.valve_lag",
        "time constant of the chamber's pressure under the pressure control valve",
        dimension="time",
        above=0.0,
        maximum=_LONGEST,
        default=0.14,
    ),
    Key(
        "benchmark.mcfc.chamber_volume",
        "of the cap-end chamber, its port and its hose before the disturbance",
        dimension="volume",
        above=0.0,
        maximum=1.0,
        default=30e-6,
    ),
    Key(
        "benchmark.mcfc.gas_exponent",
        "of the chamber's air under changes of its volume: 1 isothermal, 1.4 adiabatic",
        kind="number",
        symbol="gamma",
        minimum=1.0,
        maximum=1.67,
        default=1.4,
    ),
    _time("driver_delay", "dead time of the motor driver", 0.002),
    _time("driver_lag", "time constant of the current under the motor driver", 0.001),
    Key(
        "benchmark.mcfc.force_constant",
        "that the controller divides by; without it the mean over the positions it passes",
        dimension="force constant",
        above=0.0,
        maximum=1e6,
        optional=True,
    ),
    Key(
        "benchmark.mcfc.encoder_resolution",
        "one count of the position encoder",
        minimum=1e-12,
        maximum=1e-2,
        default=ENCODER_RESOLUTION,
    ),
    Key(
        "benchmark.mcfc.control_period",
        "of the controller, the encoder's reading and the load cell's",
        dimension="time",
        minimum=1e-5,
        maximum=0.1,
        default=1e-3,
    ),
    _time("velocity_filter", "time constant of the first-order filter behind the encoder's difference", 0.031),
    Key(
        "benchmark.mcfc.noise",
        "standard deviation of one reading of the load cell",
        dimension="force",
        minimum=0.0,
        maximum=1e6,
        default=0.2,
    ),
    Key(
        "benchmark.mcfc.time_step",
        "of the simulation, at most; a control period is a whole number of steps",
        dimension="time",
        minimum=1e-5,
        maximum=1e-3,
        default=1e-4,
    ),
)
