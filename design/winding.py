"""The winding of ring coils: length, resistance, fill, copper mass and the electric loading of its currents.

A current of I amperes is the amplitude of a balanced sinusoidal three-phase current throughout.
"""

from __future__ import annotations

import math

from fluxbore.design.hybrid import PHASES, HybridActuator
from fluxbore.design.material_kinds import ROOM_TEMPERATURE, Conductor


def mean_turn_diameter(actuator: HybridActuator) -> float:
    """(D_c + D_w) / 2 (m)."""
    return (actuator.cylinder.outer_diameter + actuator.winding.outer_diameter) / 2


def wire_length(actuator: HybridActuator) -> float:
    """Wire of one phase (m): N pi (D_c + D_w)/2; the links between a phase's coils are left out."""
    return actuator.winding.turns * math.pi * mean_turn_diameter(actuator)


def wire_area(actuator: HybridActuator) -> float:
    """Copper cross-section of the wire (m^2)."""
    return math.pi / 4 * actuator.winding.wire_diameter**2


def copper_fill(actuator: HybridActuator) -> float:
    """Share of a coil's window that is copper; round wire without insulation reaches pi / (2 sqrt 3) = 0.907."""
    return actuator.turns_per_coil * wire_area(actuator) / actuator.coil_area


def resistance(actuator: HybridActuator, conductor: Conductor, temperature: float = ROOM_TEMPERATURE) -> float:
    """Direct-current resistance of one phase (ohm) at a temperature (K): rho(T) l / A.

    Skin and proximity effects are left out: below 10 kHz the skin depth of copper exceeds 0.6 mm.
    """
    return conductor.resistivity_at(temperature) * wire_length(actuator) / wire_area(actuator)


def winding_factor(actuator: HybridActuator) -> float:
    """Fundamental winding factor of one coil a pole pair: sin(a)/a with a = pi tau_w / (2 tau).

    With three phases side by side tau_w = 2 tau / 3, and it is sin 60 deg / (pi/3) = 0.827.
    """
    half_angle = math.pi * actuator.coil_width / (2 * actuator.mover.pole_pitch)
    return math.sin(half_angle) / half_angle


def electric_loading(actuator: HybridActuator, current: float) -> float:
    """K_sp (A/m): the peak of the travelling current sheet's fundamental, for a phase amplitude in amperes.

    One phase is a current sheet of n I / tau_w over a width tau_w in each period 2 tau (n turns a coil, all wound the
    same way). Its fundamental has the amplitude (2/pi) sin(pi tau_w / 2 tau) n I / tau_w, which is the winding factor
    times n I / tau, and three phases in balance make a wave of 3/2 of that. In the scheme of Bianchi et al. (2003),
    IEEE Trans. Ind. Appl. 39, 466.
    """
    sheet = actuator.turns_per_coil / actuator.coil_width * current
    return 1.5 * actuator.coil_width / actuator.mover.pole_pitch * winding_factor(actuator) * sheet


def copper_volume(actuator: HybridActuator) -> float:
    """Wire of all phases without its insulation (m^3)."""
    return len(PHASES) * wire_length(actuator) * wire_area(actuator)


def copper_mass(actuator: HybridActuator, conductor: Conductor) -> float:
    """Wire of all phases without its insulation (kg)."""
    return copper_volume(actuator) * conductor.density


def copper_loss(resistance: float, current: float) -> float:
    """3/2 I^2 R (W), for a phase resistance in ohm and an amplitude in amperes."""
    return 1.5 * current**2 * resistance


def motor_constant(force_constant: float, resistance: float) -> float:
    """Force per root of copper loss (N/sqrt(W)): K / sqrt(3/2 R), the same at any current."""
    return force_constant / math.sqrt(1.5 * resistance)
