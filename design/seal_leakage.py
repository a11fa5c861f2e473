"""Air through the dry contact of a seal: the gap that roughness holds open, and laminar flow along it.

    p_c = beta E* exp(-u/u_0),   u_0 = gamma h,   beta = q_0 h / 2,   E* = E/(1 - nu^2)
    Q   = pi D_c' u^3 (p_1^2 - p_a^2) / (24 mu p_a b)

u is the mean gap under the contact pressure p_c between a surface of rms roughness h and longest wavelength
2 pi / q_0, rigid, and a smooth elastic one (Persson, Phys. Rev. Lett. 99, 2007, 125502, for the exponential law;
gamma = 0.48 after Akarapu, Sharp and Robbins, Phys. Rev. Lett. 106, 2011, 204301; both numbers and the prefactor beta
from memory of that literature: a factor of two in beta moves u by a third of h). Solved for u with ln(1 + ...), which
closes the gap at last and never below zero; for p_c far below beta E* it is the same.

Q is isothermal, laminar, compressible flow between plates over the band's length b, at the atmosphere's state. It
follows from integrating the parallel-plate flow -u^3/(12 mu) dp/dz with density as pressure.

An order of magnitude, and an upper one: for a dry contact. Grease fills the gap; slip at gaps near the air's mean free
path (0.07 um), and channels that close before the mean gap does, are left out. Sound for comparing fins.
"""

from __future__ import annotations

import math

from fluxbore.design.units import STANDARD_ATMOSPHERE

GAMMA = 0.48
"""u_0 over the rms roughness."""

AIR_VISCOSITY = 18.2e-6
"""Pa s, of air at 20 degC; it hardly changes with pressure."""


def gap(
    roughness: float, wavelength: float, contact_pressure: float, young_modulus: float, poisson_ratio: float
) -> float:
    """The mean gap u (m) of rms roughness and longest wavelength (m) under a contact pressure above zero (Pa)."""
    effective = young_modulus / (1 - poisson_ratio**2)
    limit = math.pi * roughness / wavelength * effective
    return GAMMA * roughness * math.log1p(limit / contact_pressure)


def leakage(bore: float, band: float, opening: float, pressure: float) -> float:
    """Q (m^3/s at the atmosphere) through a gap over a band's length around a bore (m), from a gauge pressure (Pa)."""
    driving = (pressure + STANDARD_ATMOSPHERE) ** 2 - STANDARD_ATMOSPHERE**2
    return math.pi * bore * opening**3 * driving / (24 * AIR_VISCOSITY * STANDARD_ATMOSPHERE * band)


def wear_rate(specific_wear: float, contact_pressure: float) -> float:
    """Depth worn off per distance slid (m/m): Archard's law (J. Appl. Phys. 24, 1953) as k p.

    specific_wear : k (m^2/N), volume over force and distance. Steady wear after running in, one pair of materials,
    one state of lubrication.
    """
    return specific_wear * contact_pressure
