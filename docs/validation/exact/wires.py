"""Long straight conductors, per metre of length. Complex notation: B_x + i B_y at x + i y.

Smythe, Static and Dynamic Electricity (3rd ed. 1968), chapters 4 and 7: images of line currents in circles. A round
conductor of uniform current acts as a line current outside itself, and a field without sources in it averages over its
section to the value at its centre, so that forces and mean potentials of round conductors are those of lines.
"""

from __future__ import annotations

import numpy as np

from exact.loops import MU_0, Floats

Wire = tuple[float, complex]
"""Current out of the page (A) and place (m)."""


def flux_density(wires: tuple[Wire, ...], at: complex) -> complex:
    """B_x + i B_y (T) of line currents: i μ0 I/(2π (z − z0)*)."""
    return complex(sum(1j * MU_0 * current / (2 * np.pi * np.conj(at - place)) for current, place in wires))


def force(wires: tuple[Wire, ...], on: tuple[Wire, ...]) -> complex:
    """F_x + i F_y (N/m) on some wires in the field of others: I × B = i I B."""
    return complex(sum(1j * current * flux_density(wires, place) for current, place in on))


def pair_force(one: float, other: float, distance: float) -> float:
    """Attraction (N/m) μ0 I1 I2/(2π d)."""
    return MU_0 * one * other / (2 * np.pi * distance)


def pair_inductance(radius: float, distance: float) -> float:
    """H/m of two round conductors, out and back: μ0/π [ln(d/a) + 1/4]."""
    return float(MU_0 / np.pi * (np.log(distance / radius) + 0.25))


def confined_images(current: float, offset: float, radius: float) -> tuple[Wire, ...]:
    """The image of a wire at (offset, 0) in a circle A = 0: −I at R²/offset."""
    return ((-current, complex(radius**2 / offset)),)


def confined_potential(current: float, offset: float, radius: float, at: complex) -> float:
    """A (Wb/m) at a point within the circle A = 0 of a wire at (offset, 0): μ0 I/(2π) ln(d |P − P'|/(R |P − P0|))."""
    image = radius**2 / offset
    return float(MU_0 * current / (2 * np.pi) * np.log(offset * abs(at - image) / (radius * abs(at - offset))))


def confined_inductance(conductor: float, offset: float, radius: float) -> float:
    """H/m of a round conductor at an offset in the circle A = 0: μ0/(2π) [ln((R² − d²)/(R a)) + 1/4]."""
    return float(MU_0 / (2 * np.pi) * (np.log((radius**2 - offset**2) / (radius * conductor)) + 0.25))


def iron_images(wires: tuple[Wire, ...], mu_r: float, radius: float) -> tuple[Wire, ...]:
    """What an iron cylinder at the origin adds outside: k I at a²/z0* and −k I at the centre, k = (μr − 1)/(μr + 1)."""
    k = (mu_r - 1) / (mu_r + 1)
    return tuple(
        image for current, place in wires for image in ((k * current, radius**2 / np.conj(place)), (-k * current, 0j))
    )


def iron_inside(mu_r: float) -> float:
    """B within the iron cylinder over that of the wires alone, their total current being zero: 2 μr/(μr + 1)."""
    return 2 * mu_r / (mu_r + 1)


def coaxial_flux_density(current: float, core: float, inner: float, outer: float, r: float) -> float:
    """B_θ (T) of a coaxial cable at radius r (m)."""
    if r < core:
        share = (r / core) ** 2
    elif r < inner:
        share = 1.0
    else:
        share = max(0.0, (outer**2 - r**2) / (outer**2 - inner**2))
    return MU_0 * current * share / (2 * np.pi * r)


def coaxial_inductance(core: float, inner: float, outer: float) -> float:
    """H/m of core and shell: μ0/(2π) {1/4 + ln(b/a) + c⁴ ln(c/b)/(c² − b²)² − (3c² − b²)/(4 (c² − b²))}."""
    wall = outer**2 - inner**2
    shell = outer**4 * np.log(outer / inner) / wall**2 - (3 * outer**2 - inner**2) / (4 * wall)
    return float(MU_0 / (2 * np.pi) * (0.25 + np.log(inner / core) + shell))


def unwrap(field: complex) -> Floats:
    """(2,) the complex field as a vector."""
    return np.array([field.real, field.imag])
