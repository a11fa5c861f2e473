"""Spheres: in a uniform field, magnetised, and beside a coil.

Jackson, Classical Electrodynamics (3rd ed. 1999), 3.3 and 5.10 to 5.12.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import dblquad
from scipy.special import eval_legendre, lpmv

from exact.coils import Coil
from exact.loops import MU_0, Floats


def inside_uniform_field(mu_r: float) -> float:
    """B inside over the uniform B outside: 3 μr/(μr + 2)."""
    return 3 * mu_r / (mu_r + 2)


def dipole_flux_density(moment: float, r: float, z: float) -> Floats:
    """(2,) B_r and B_z (T) of a dipole (A·m²) along +z at the origin."""
    distance = np.hypot(r, z)
    return np.asarray(MU_0 * moment / (4 * np.pi * distance**5) * np.array([3 * r * z, 2 * z**2 - r**2]))


def magnetised_sphere_flux_density(remanence: float, radius: float, r: float, z: float) -> Floats:
    """(2,) B (T) of a sphere of μ_r = 1 magnetised along +z: 2/3 Br inside, a dipole of 4π a³ Br/(3 μ0) outside."""
    if np.hypot(r, z) < radius:
        return np.array([0.0, 2 / 3 * remanence])
    return dipole_flux_density(4 / 3 * np.pi * radius**3 * remanence / MU_0, r, z)


def iron_sphere_flux_density(mu_r: float, field: float, radius: float, r: float, z: float) -> Floats:
    """(2,) B (T) at (r, z) of a sphere at the origin in a uniform field (T) along +z."""
    if np.hypot(r, z) < radius:
        return np.array([0.0, inside_uniform_field(mu_r) * field])
    moment = 4 * np.pi * radius**3 * (mu_r - 1) / (mu_r + 2) * field / MU_0
    return np.array([0.0, field]) + dipole_flux_density(moment, r, z)


def multipoles(coil: Coil, count: int) -> Floats:
    """(count + 1,) c_n of the coil's potential φ = Σ c_n R^n P_n(cos θ) about the origin, H = −∇φ (A/m^n).

    A loop of radius ρ at height h, seen at angle α and distance s: −n c_n = I sin²α/(2 s^n) P'_n(cos α).
    """
    c = np.zeros(count + 1)
    for n in range(1, count + 1):

        def loop(h: float, rho: float, n: int = n) -> float:
            s = float(np.hypot(rho, h))
            sine = rho / s
            return float(-sine / (2 * s**n) * lpmv(1, n, h / s))  # lpmv(1, n) = −sin P'_n

        integral = dblquad(loop, coil.inner, coil.outer, coil.lower, coil.upper, epsrel=1e-10, epsabs=0)[0]
        c[n] = -coil.current_density * integral / n
    return c


def induced(c: Floats, mu_r: float, radius: float) -> Floats:
    """d_n of the sphere's own potential Σ d_n R^(−n−1) P_n: −c_n n (μr − 1)/(n (μr + 1) + 1) a^(2n + 1)."""
    n = np.arange(c.size)
    return np.asarray(-c * n * (mu_r - 1) / (n * (mu_r + 1) + 1) * radius ** (2.0 * n + 1))


def force_on_sphere(coil: Coil, mu_r: float, radius: float, count: int = 40) -> float:
    """F_z (N) on a sphere at the origin in the coil's field: −4π μ0 Σ (n + 1) d_n c_(n+1).

    The force on the 2^n-pole d_n in the field of the next order. Needs the coil outside the sphere's radius.
    """
    c = multipoles(coil, count)
    d = induced(c, mu_r, radius)
    n = np.arange(1, count)
    return float(-4 * np.pi * MU_0 * np.sum((n + 1) * d[1:count] * c[2 : count + 1]))


def induced_flux_density(d: Floats, r: float, z: float) -> Floats:
    """(2,) B_r and B_z (T) of the potential Σ d_n R^(−n−1) P_n outside the sphere."""
    distance = float(np.hypot(r, z))
    cosine, sine = z / distance, r / distance
    n = np.arange(1, d.size)
    radial = float(np.sum((n + 1) * d[1:] / distance ** (n + 2.0) * eval_legendre(n, cosine)))
    polar = float(np.sum(-d[1:] / distance ** (n + 2.0) * lpmv(1, n, cosine)))  # −(1/R) ∂φ/∂θ with dP/dθ = lpmv(1, n)
    return MU_0 * np.array([radial * sine + polar * cosine, radial * cosine - polar * sine])
