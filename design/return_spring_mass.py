"""What the return element weighs at the least, where no data sheet tells: the mass of its elastic material alone.

    helical spring   m = 4 rho G U K_s^2/tau^2,   U = F_max^2/(2 k),   K_s = 1 + 1/(2 C)
    spring motor     m = 6 rho E U/sigma^2,       U = F_0 x_max
    cord             m = rho A L

The energy in a volume V of round wire twisted to tau at its surface is V tau^2/(4 G), whatever the wire, the coil and
the number of springs (Wahl 1963, Mechanical Springs, 2nd ed., chapter on the spring's use of its material); a strip
bent to sigma holds V sigma^2/(6 E). K_s, the direct shear's share, is Shigley's (Mechanical Engineering Design, 10-1)
at the index C = D/d. Stresses are those of quasi-static service: 0.45 of the tensile strength for extension springs
(EN 13906-2) of patented wire of 2.5 mm, 1,900 MPa (EN 10270-1, grade SH). Hooks, dead coils, drums and seats are left
out, so that a catalogue's spring is heavier.
"""

from __future__ import annotations

from fluxbore.design.return_element import ConstantReturn, CordReturn, LinearReturn, ReturnElement

STEEL_DENSITY = 7850.0
"""kg/m^3, of spring steel (EN 10270-1)."""

SHEAR_MODULUS, YOUNG_MODULUS = 81.5e9, 206e9
"""Pa, of spring steel (EN 13906)."""

SHEAR_STRESS = 0.45 * 1900e6
"""Pa; of the wire of a helical spring, largest."""

BENDING_STRESS = 1200e6
"""Pa; of the strip of a spring motor, largest: hardened carbon steel strip for some ten thousand strokes."""

SPRING_INDEX = 10.0
"""C, coil's mean diameter over the wire's, in the middle of what is wound."""

RUBBER_DENSITY = 930.0
"""kg/m^3, of natural rubber without fillers."""


def least_mass(element: ReturnElement, stroke: float, shear_stress: float = SHEAR_STRESS) -> float:
    """kg of the elastic material that takes the element to an extension of `stroke` (m) at the stress (Pa)."""
    if isinstance(element, LinearReturn):
        energy = element.force(stroke) ** 2 / (2 * element.rate)  # with that of its preload
        direct = 1 + 1 / (2 * SPRING_INDEX)
        return 4 * STEEL_DENSITY * SHEAR_MODULUS * energy * direct**2 / shear_stress**2
    if isinstance(element, ConstantReturn):
        return 6 * STEEL_DENSITY * YOUNG_MODULUS * element.energy(stroke) / BENDING_STRESS**2
    assert isinstance(element, CordReturn)
    return RUBBER_DENSITY * element.area * element.length
