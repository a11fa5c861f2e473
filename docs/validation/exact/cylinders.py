"""Thin solenoids and axially magnetised cylinders, which have the same field.

Derby and Olbert, "Cylindrical magnets and ideal solenoids", Am. J. Phys. 78 (2010) 229, equations (3) to (6). Their
generalised complete elliptic integral is written in Carlson's symmetric forms.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import quad
from scipy.special import ellipe, ellipk, elliprf, elliprj, j1

from exact.loops import MU_0, Floats, mutual_inductance


def cel(k_c: ArrayLike, p: ArrayLike, c: ArrayLike, s: ArrayLike) -> Floats:
    """∫ over (0, π/2) of (c cos² + s sin²)/((cos² + p sin²) √(cos² + k_c² sin²)); p > 0."""
    square = np.square(k_c)
    p, c, s = np.asarray(p, dtype=float), np.asarray(c, dtype=float), np.asarray(s, dtype=float)
    return np.asarray(c * elliprf(0.0, square, 1.0) + (s - p * c) / 3 * elliprj(0.0, square, 1.0, p))


def sheet_flux_density(a: ArrayLike, half_length: ArrayLike, r: ArrayLike, z: ArrayLike) -> Floats:
    """(..., 2) B_r and B_z over μ0 times the current per length, of a cylindrical sheet |z| < half_length of radius a.

    Lengths in m. Not on the sheet itself, where B_z jumps.
    """
    a, b, r, z = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (a, half_length, r, z)))
    gamma = (a - r) / (a + r)
    radial, axial = np.zeros(a.shape), np.zeros(a.shape)
    for sign in (1.0, -1.0):
        end = z + sign * b
        far = np.sqrt(end**2 + (r + a) ** 2)
        k_c = np.sqrt(end**2 + (a - r) ** 2) / far
        radial = radial + sign * a / far * cel(k_c, 1.0, 1.0, -1.0)
        axial = axial + sign * end / far * cel(k_c, gamma**2, 1.0, gamma)
    return np.stack((radial, a / (a + r) * axial), axis=-1) / np.pi


def magnet_flux_density(remanence: float, radius: float, length: float, r: ArrayLike, z: ArrayLike) -> Floats:
    """(..., 2) B_r and B_z (T) of a cylinder of μ_r = 1 magnetised along +z, centred at the origin (m)."""
    return remanence * sheet_flux_density(radius, length / 2, r, z)


def magnet_flux_density_on_axis(remanence: float, radius: float, length: float, z: ArrayLike) -> Floats:
    """B_z (T) on the axis: Br/2 [(z + L/2)/√((z + L/2)² + R²) − (z − L/2)/√((z − L/2)² + R²)]."""
    above, below = np.asarray(z) + length / 2, np.asarray(z) - length / 2
    return np.asarray(remanence / 2 * (above / np.hypot(above, radius) - below / np.hypot(below, radius)))


Cylinder = tuple[float, float, float]
"""Remanence (T), radius and length (m)."""


def magnet_force(one: Cylinder, other: Cylinder, distance: float) -> float:
    """Attraction (N) of coaxial cylinders of μ_r = 1 magnetised alike, centres `distance` (m) apart.

    Each is a sheet of Br/μ0 A/m. The force of two sheets is ∫ [M(z to the near end) − M(z to the far end)] dz along one
    of them, with M of two loops.
    """
    (b_1, r_1, l_1), (b_2, r_2, l_2) = one, other

    def drop(z: float) -> float:
        near, far = distance - l_2 / 2 - z, distance + l_2 / 2 - z
        return float(mutual_inductance(r_1, r_2, near) - mutual_inductance(r_1, r_2, far))

    return b_1 * b_2 / MU_0**2 * float(quad(drop, -l_1 / 2, l_1 / 2, epsrel=1e-11, epsabs=0)[0])


def magnet_force_of_discs(one: Cylinder, other: Cylinder, distance: float) -> float:
    """The same by four pairs of charged discs: π J1 J2 R1 R2/μ0 ∫ J1(kR1) J1(kR2) e^(−kd)/k dk for each pair."""
    (b_1, r_1, l_1), (b_2, r_2, l_2) = one, other
    gaps = [distance + u * l_1 / 2 + v * l_2 / 2 for u in (1, -1) for v in (1, -1)]
    signs = [1, -1, -1, 1]
    unit = r_1 + r_2

    def integrand(x: float) -> float:
        k = x / unit
        ends = sum(sign * np.exp(-k * gap) for sign, gap in zip(signs, gaps, strict=True))
        return float(j1(k * r_1) * j1(k * r_2) / x * ends)

    last = 40 * unit / min(gaps)
    pieces = np.linspace(1e-12, last, 2 + int(last / 10))
    total = sum(quad(integrand, a, b, limit=200)[0] for a, b in itertools.pairwise(pieces))
    return float(np.pi * b_1 * b_2 * r_1 * r_2 / MU_0 * total)


def nagaoka(ratio: float) -> float:
    """Nagaoka's coefficient of a thin solenoid of diameter/length x = ratio.

    4/(3π) [√(1 + x²)/x² (K + (x² − 1) E) − x] with k² = x²/(1 + x²): Lorenz's closed form (Nagaoka 1909).
    """
    square = ratio**2 / (1 + ratio**2)
    elliptic = ellipk(square) + (ratio**2 - 1) * ellipe(square)
    return float(4 / (3 * np.pi) * (np.sqrt(1 + ratio**2) / ratio**2 * elliptic - ratio))
