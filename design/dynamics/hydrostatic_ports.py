"""Effort and flow at every port of the electro-hydrostatic drive, and where the energy goes.

Between two ports stands one component. What enters at its first port over a run, less what leaves at its second, is
what it stores and what it loses:

    int e_1 f_1 dt - int e_2 f_2 dt = change of stored energy + lost

Stored energy is that of the state at both ends of the run, by its own formula (kinetic, that of the fluid from its
content, of springs); efforts and flows are means over each step. Nothing is left over but what the solver does wrong:
the test of formulas and solver at once. At the motor there is the electric port before it: copper loses R I^2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.dynamics.hydrostatic_drive import DriveRun
from fluxbore.design.dynamics.hydrostatic_network import LINKS, VOLUMES

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Port:
    """effort, flow : (k,) means of each step; their product is a power (W). units : of both."""

    name: str
    effort: Floats
    flow: Floats
    units: tuple[str, str]

    @property
    def power(self) -> Floats:
        """(k,) W."""
        return self.effort * self.flow


@dataclass(frozen=True, slots=True)
class Component:
    """Over a whole run (J): what entered, left, was stored and was lost in one component."""

    name: str
    entered: float
    left: float
    stored: float
    lost: float

    @property
    def imbalance(self) -> float:
        """J, zero but for the solver."""
        return self.entered - self.left - self.stored - self.lost


@dataclass(frozen=True, slots=True)
class EnergyAudit:
    """components : in the order of the chain. entered : at the motor's shaft, where power flowed in (J). imbalance :
    the largest of any component and of the whole chain, over `entered`. copper : what the winding lost beside (J)."""

    components: tuple[Component, ...]
    entered: float
    imbalance: float
    copper: float

    @property
    def lost(self) -> dict[str, float]:
        """By component (J), those that lose anything, the winding among them."""
        return {"motor winding": self.copper} | {part.name: part.lost for part in self.components if part.lost}


def ports(run: DriveRun) -> tuple[Port, ...]:
    """Of a run, from the motor's shaft to the return element."""
    chain, actuator, h = run.network, run.network.actuator, run.step
    first, second, ratio = actuator.input_cylinder, actuator.output_cylinder, actuator.ball_screw.ratio
    velocity, pressure = _middle(run.velocity), run.pressure
    v_1, v_2 = velocity[:, 0], velocity[:, 1]
    rotor = actuator.reflected_mass - first.moving_mass
    nut = run.motor_force - rotor * np.diff(run.velocity[:, 0]) / h
    enthalpy = chain.enthalpy(pressure)
    way = _middle(run.way)[:, 1]
    held = np.array([chain.return_force(float(x)) for x in way])
    found = [
        Port("motor shaft", run.motor_force * ratio, v_1 / ratio, ("N m", "rad/s")),
        Port("screw", nut * ratio, v_1 / ratio, ("N m", "rad/s")),
        Port("nut", nut - screw_friction(run), v_1, ("N", "m/s")),
        Port("input piston", first.area * pressure[:, 0], v_1, ("N", "m/s")),
    ]
    for j, name in enumerate(LINKS):
        found.append(Port(f"{name}, first", enthalpy[:, j], run.flow[:, j], ("Pa", "m^3/s")))
        found.append(Port(f"{name}, second", enthalpy[:, j + 1], run.flow[:, j], ("Pa", "m^3/s")))
    found.append(Port("output piston", second.area * pressure[:, 2], v_2, ("N", "m/s")))
    found.append(Port("return element", held, v_2, ("N", "m/s")))
    return tuple(found)


def screw_friction(run: DriveRun) -> Floats:
    """(k,) what the ball screw takes of the nut's force (N), with the sign of its speed: see `hydrostatic_network`."""
    screw, area = run.network.actuator.ball_screw, run.network.actuator.input_cylinder.area
    law = run.network.actuator.input_cylinder.friction
    speed = _middle(run.velocity)[:, 0]
    share = np.where(speed >= 0, 1 / screw.efficiency - 1, 1 - screw.efficiency)
    pressed = np.maximum(run.pressure[:, 0], 0.0)
    return share * area * pressed * np.clip(speed / law.linear_speed, -1.0, 1.0)


def energy_audit(run: DriveRun) -> EnergyAudit:
    """Of a whole run."""
    chain, actuator, h = run.network, run.network.actuator, run.step
    by_name = {port.name: float(np.sum(port.power)) * h for port in ports(run)}
    first, second = actuator.input_cylinder, actuator.output_cylinder
    speeds = _middle(run.velocity)
    screw = float(np.sum(screw_friction(run) * speeds[:, 0])) * h
    seals = np.sum(run.friction * speeds, axis=0) * h
    start, end = run.velocity[0] ** 2 / 2, run.velocity[-1] ** 2 / 2
    kinetic = end - start
    fluid = _stored(run, -1) - _stored(run, 0)
    ways = (float(run.way[0, 1]), float(run.way[-1, 1]))
    sprung = chain.return_energy(ways[1]) - chain.return_energy(ways[0])
    piston = by_name["input piston"]
    parts = [
        Component(
            "rotor, coupling and screw",
            by_name["motor shaft"],
            by_name["screw"],
            (actuator.reflected_mass - first.moving_mass) * kinetic[0],
            0.0,
        ),
        Component("ball screw", by_name["screw"], by_name["nut"], 0.0, screw),
        Component("input piston", by_name["nut"], piston, first.moving_mass * kinetic[0], float(seals[0]) - screw),
    ]
    before = piston
    for j, volume in enumerate(VOLUMES):
        after = by_name[f"{LINKS[j]}, first"] if j < len(LINKS) else by_name["output piston"]
        parts.append(Component(volume, before, after, float(fluid[j]), 0.0))
        if j < len(LINKS):
            before = by_name[f"{LINKS[j]}, second"]
            parts.append(Component(LINKS[j], after, before, 0.0, _line_loss(run, j)))
    out = by_name["return element"]
    parts.append(
        Component("output piston", by_name["output piston"], out, second.moving_mass * kinetic[1], float(seals[1]))
    )
    parts.append(Component("return element", out, 0.0, sprung, 0.0))
    power = run.motor_force * speeds[:, 0]
    entered = float(np.sum(np.maximum(power, 0.0))) * h
    whole = sum(part.imbalance for part in parts)
    worst = max(abs(whole), *(abs(part.imbalance) for part in parts))
    return EnergyAudit(tuple(parts), entered, worst / entered if entered > 0 else 0.0, copper_loss(run))


def copper_loss(run: DriveRun) -> float:
    """3/2 R_ll I^2 with the rms current of a phase, I = torque over torque constant (J)."""
    motor, ratio = run.network.actuator.motor, run.network.actuator.ball_screw.ratio
    current = run.motor_force * ratio / motor.torque_constant
    return float(np.sum(1.5 * motor.resistance * current**2)) * run.step


def fluid_loss(audit: EnergyAudit, duration: float) -> float:
    """Mean power (W) that warms the fluid and the seals in it over a duration (s): both seals and the line."""
    if not (math.isfinite(duration) and duration > 0):
        return 0.0
    names = {"input piston", "output piston", *LINKS}
    return sum(part.lost for part in audit.components if part.name in names) / duration


def _line_loss(run: DriveRun, link: int) -> float:
    """R q^2 over the run, R anew at each step's own flow (J): not what the step held it to be."""
    chain, flow = run.network, run.flow[:, link]
    return float(sum(chain.links[link].resistance(q, chain.rho, chain.mu) * q * q for q in flow.tolist())) * run.step


def _stored(run: DriveRun, at: int) -> Floats:
    """(3,) of fluid and walls (J), from contents and volumes."""
    chain = run.network
    volume = chain.volume(float(run.way[at, 0]), float(run.way[at, 1]))
    pressure = chain.filling(run.content[at], volume, run.pressure[at])
    return chain.energy(pressure, volume)


def _middle(values: Floats) -> Floats:
    return np.asarray((values[1:] + values[:-1]) / 2)
