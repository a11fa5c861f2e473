"""One run of the contact-force benchmark: a cascade over whole records, for nothing in it feeds force back to motion.

    triangle -> load actuator -> position, velocity, acceleration
    position -> counts -> velocity estimate -> friction by (6) at the target pressure        (each control period)
    P-P: target pressure + friction/S -> dead time -> valve and chamber -> P
    P-E: friction/K -> dead time -> lag -> current -> force map

Pushing in +z, the mover advances against the load with its friction missing from the force, and is pushed back with
the friction on top (Nakata and Noda 2023, Sec. III and IV-D). Everything is read once a control period.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.bristle import bristle_force, bristle_record
from fluxbore.design.dynamics.chamber import pressures, swelling
from fluxbore.design.dynamics.contact_force_plant import ContactForcePlant, scaled
from fluxbore.design.dynamics.disturbance import Motion, followed
from fluxbore.design.dynamics.lag import held, lagged
from fluxbore.design.friction import seal_friction

Floats = NDArray[np.float64]

ROUND_TRIPS = 10
"""Of the load actuator at each frequency (Nakata and Noda 2023, Sec. IV-A)."""

NO_COMPENSATION, BY_PRESSURE, BY_CURRENT = CONDITIONS = ("P-N", "P-P", "P-E")
"""Friction is left as it is, made up for by the air, or made up for by the motor (Sec. IV-D)."""


@dataclass(frozen=True, slots=True, eq=False)
class Drive:
    """What one frequency does to every run: the motion and the chamber's swelling at the steps' ends, and at the
    control periods' ends the motion again."""

    motion: Motion
    swell: Floats
    read: Motion


@dataclass(frozen=True, slots=True, eq=False)
class Air:
    """Pressure (Pa gauge) and friction (N) at the control periods' ends, the start included."""

    pressure: Floats
    friction: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """One run, read at the end of every control period, (n,) each, SI units.

    force : what the load cell reads, its noise included. velocity_estimate and compensation (N) : the controller's,
    as of the period's end.
    """

    time: Floats
    position: Floats
    velocity: Floats
    force: Floats
    friction: Floats
    pressure: Floats
    current: Floats
    velocity_estimate: Floats
    compensation: Floats


def drive(plant: ContactForcePlant, frequency: float) -> Drive:
    """The motion of ten round trips at this frequency (Hz)."""
    periods = math.floor(ROUND_TRIPS / frequency / plant.estimate.period + 1e-9)
    time = plant.step * np.arange(periods * plant.steps + 1, dtype=np.float64)
    motion = followed(plant.load, time, plant.stroke, frequency)
    read = Motion(
        *(
            np.ascontiguousarray(signal[:: plant.steps])
            for signal in (time, motion.position, motion.velocity, motion.acceleration)
        )
    )
    return Drive(motion, swelling(plant.chamber, motion.position), read)


def air(plant: ContactForcePlant, driven: Drive, wanted: Floats, start: float) -> Air:
    """Chamber and seal under the wanted gauge pressure (Pa) of each control period, from equilibrium at `start`."""
    mean = held(wanted, plant.steps, plant.valve_delay / plant.step, start)
    pressure = pressures(plant.chamber, mean, driven.swell, plant.step, start)
    moved = np.diff(driven.motion.position) / plant.step
    deflection = bristle_record(plant.seal, moved, (pressure[1:] + pressure[:-1]) / 2, plant.step).deflection
    pressure = pressure[:: plant.steps]
    return Air(pressure, bristle_force(plant.seal, deflection[:: plant.steps], driven.read.velocity, pressure))


def run(
    plant: ContactForcePlant,
    driven: Drive,
    condition: str,
    target: float,
    random: np.random.Generator,
    still: Air | None = None,
) -> Record:
    """One run of a condition at a target force (N).

    random : of the encoder's phase, the load cell's noise and the run's own friction. still : `air` at the unchanging
    target pressure, where it is known already; P-P has its own, and so has every run where friction scatters.
    """
    read, base = driven.read, plant.target_pressure(target)
    phase, noise = random.random(), plant.noise * random.standard_normal(len(read.time))
    if plant.friction_scatter > 0:
        share = max(0.0, 1.0 + plant.friction_scatter * random.standard_normal())
        plant, still = replace(plant, seal=scaled(plant.seal, share)), None
    estimate = plant.estimate(read.position, phase)
    compensation = seal_friction(plant.law, plant.seal.area, base, estimate)
    if condition == BY_PRESSURE:
        # The chamber cannot be drawn below the atmosphere.
        wanted = np.maximum(base + compensation[:-1] / plant.chamber.area, 0.0)
        still = air(plant, driven, wanted, base)
    elif still is None:
        still = air(plant, driven, np.full(len(read.time) - 1, base), base)
    current = np.zeros(len(read.time))
    if condition == BY_CURRENT:
        mean = held(compensation[:-1] / plant.force_constant, plant.steps, plant.driver_delay / plant.step, 0.0)
        current = lagged(mean, plant.driver_lag, plant.step, 0.0)[:: plant.steps]
    force = (
        plant.chamber.area * still.pressure
        + plant.force_map.force(plant.position + read.position, current)
        - still.friction
        - plant.moving_mass * read.acceleration
        + noise
    )
    return Record(
        read.time,
        read.position,
        read.velocity,
        force,
        still.friction,
        still.pressure,
        current,
        estimate,
        compensation,
    )
