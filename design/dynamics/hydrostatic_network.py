"""The electro-hydrostatic actuator as a chain of ports: what holds the fluid, what slows it, in the order of the spec.

    drive -> motor, coupling, screw -> input piston | chamber -> port, fitting, half the hose, block's inlet
          -> hose and block -> block's outlet, half the hose, fitting, port -> chamber | output piston -> return element

At every port power is effort times flow: torque and speed, force and speed, and in the fluid the enthalpy e and the
flow q of `design.fluid`, both per volume at the atmosphere's pressure, so that a fluid that gives loses no energy on
paper. A volume holds n, its fluid at that pressure:

    n = V (1 + p/K)/s(p),    dn_j/dt = q_{j-1} - q_j,    q_j = (e_j - e_{j+1})/R_j(q_j)

K : what its wall gives. The line's volume is one, in its middle, where the block is: between its ends and the middle
the pressure differs by less than a bar in the prototype. Resistances take e for the pressure and q for the flow, right
to 0.1 % at 30 bar of a stiff fluid.

Friction of the screw: the nut's load F costs F/eta driving and gives F eta driven back, so that (1/eta - 1) F or
(1 - eta) F are lost; F is taken as the pressure's force, the friction of the seal and the piston's inertia left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.flow_resistance import Orifice, hose_resistance, orifice_resistance
from fluxbore.design.fluid import (
    Fluid,
    check_cavitation,
    density,
    specific_enthalpy,
    state_of,
    stored_energy,
    viscosity,
    volume_ratio,
)
from fluxbore.design.hydrostatic import Hose, HydrostaticActuator
from fluxbore.design.hydrostatic_figures import stiffness

Floats = NDArray[np.float64]

VOLUMES = ("input chamber", "hose and block", "output chamber")
LINKS = ("input line", "output line")
"""Each between two neighbours of `VOLUMES`."""

LEAST_VOLUME = 1e-7
"""m^3: an output chamber without dead volume would hold nothing at the retracted end."""

SETTLED = 1e-3
"""Pa; Newton's last correction, whose square is what is left."""


@dataclass(frozen=True, slots=True)
class Link:
    """Resistances in a row that one flow goes through: orifices, and a length (m) of the hose."""

    orifices: tuple[Orifice, ...]
    hose: Hose
    length: float

    def resistance(self, flow: float, rho: float, mu: float) -> float:
        """R (Pa s/m^3) at a flow (m^3/s)."""
        own = hose_resistance(self.hose.bore, self.length, self.hose.roughness, flow, rho, mu)
        return own + sum(orifice_resistance(orifice, flow, rho, mu) for orifice in self.orifices)


@dataclass(frozen=True, slots=True, eq=False)
class Network:
    """The chain's constants. volumes : with both pistons at zero (m^3). swept : how each grows with the input and the
    output piston's way (m^2), (volumes, 2). wall : 1/K (1/Pa). links : between neighbours."""

    actuator: HydrostaticActuator
    fluid: Fluid
    volumes: Floats
    swept: Floats
    wall: Floats
    links: tuple[Link, ...]
    rho: float
    mu: float

    def volume(self, first: float, second: float) -> Floats:
        """V (m^3) at the pistons' ways (m)."""
        volume = self.volumes.copy()
        volume[0] += self.swept[0, 0] * first
        volume[-1] += self.swept[-1, 1] * second
        return volume

    def content(self, pressure: Floats, volume: Floats) -> Floats:
        """n (m^3) at gauge pressures (Pa) in volumes (m^3)."""
        return np.asarray(volume * (1 + pressure * self.wall) / volume_ratio(self.fluid, pressure))

    def filling(self, content: Floats, volume: Floats, start: Floats) -> Floats:
        """p (Pa gauge) that a content n has in a volume, by Newton's method from a pressure near it."""
        p = start
        for _ in range(30):
            state = state_of(self.fluid, p)
            wall = 1 + p * self.wall
            compliance = volume / state.ratio * (self.wall + wall / state.modulus)
            change = (content - volume * wall / state.ratio) / compliance
            p = p + change
            if abs(change).max() < SETTLED:
                break
        return np.asarray(p)

    def energy(self, pressure: Floats, volume: Floats) -> Floats:
        """What fluid and wall store (J) at gauge pressures in volumes; broadcasts over (..., volumes)."""
        fluid = self.content(pressure, volume) * stored_energy(self.fluid, pressure)
        return np.asarray(fluid + volume * self.wall * pressure**2 / 2)

    def enthalpy(self, pressure: Floats) -> Floats:
        """e (Pa) at gauge pressures (Pa)."""
        return np.asarray(specific_enthalpy(self.fluid, pressure))

    def return_force(self, way: float) -> float:
        """Of return element and series spring (N) at the output piston's way (m), the load held."""
        return self.actuator.return_element.force(way) + (self.actuator.series_stiffness or 0.0) * way

    def return_stiffness(self, way: float) -> float:
        """Its slope (N/m)."""
        return stiffness(self.actuator, way)

    def return_energy(self, way: float) -> float:
        """What they store (J)."""
        return self.actuator.return_element.energy(way) + (self.actuator.series_stiffness or 0.0) * way**2 / 2

    def resting_pressure(self) -> float:
        """Pa gauge that holds the return element at the retracted end without friction."""
        return self.return_force(0.0) / self.actuator.output_cylinder.area

    def check_pressures(self, pressure: Floats, time: float) -> None:
        """Raise DesignError for a cavity."""
        least = int(np.argmin(pressure))
        check_cavitation(self.fluid, float(pressure[least]), f"The pressure of the {VOLUMES[least]} at {time:.4g} s")


def network(actuator: HydrostaticActuator) -> Network:
    """The chain of an actuator."""
    first, second, hose = actuator.input_cylinder, actuator.output_cylinder, actuator.hose
    line = (actuator.port, actuator.fitting, actuator.block.orifice)
    swept = np.zeros((3, 2))
    swept[0, 0], swept[2, 1] = -first.area, second.area
    middle = hose.volume + actuator.block.volume
    return Network(
        actuator,
        actuator.fluid,
        np.array([first.dead_volume + second.area * second.stroke, middle, max(second.dead_volume, LEAST_VOLUME)]),
        swept,
        np.array([0.0, hose.volume / middle / hose.wall_modulus, 0.0]),
        (Link(line, hose, hose.length / 2),) * 2,
        density(actuator.fluid, actuator.temperature),
        float(viscosity(actuator.fluid, actuator.temperature)),
    )
