"""Long cylinders across their axis (planar), in complex notation B_x + i B_y. Smythe (1968), chapter 4; Halbach, Nucl.
Instrum. Methods 169 (1980) 1.
"""

from __future__ import annotations

import numpy as np

from exact.loops import MU_0


def magnetised_cylinder(remanence: complex, radius: float, at: complex) -> complex:
    """B (T) of a cylinder of μ_r = 1: Br/2 inside, (a²/2) Br*/(z*)² outside, that is (Br/2)(a/r)² (cos 2θ, sin 2θ)."""
    if abs(at) < radius:
        return remanence / 2
    return complex(radius**2 / 2 * np.conj(remanence) / np.conj(at) ** 2)


def iron_cylinder(mu_r: float, field: float, radius: float, boundary: float, at: complex) -> complex:
    """B (T) of a cylinder in A = B0 y on the circle of the given radius (exact at that finite distance).

    A = E r sin θ inside, (C r + D/r) sin θ outside, E = 2μr/(μr + 1) C, D = a² C (μr − 1)/(μr + 1), C + D/R² = B0.
    """
    k = (mu_r - 1) / (mu_r + 1)
    c = field / (1 + k * (radius / boundary) ** 2)
    if abs(at) < radius:
        return complex(2 * mu_r / (mu_r + 1) * c)
    return complex(c + k * c * radius**2 / np.conj(at) ** 2)


def halbach_cylinder(remanence: float, inner: float, outer: float) -> float:
    """B (T) in the bore of a dipole ring magnetised along 2θ: Br ln(ro/ri); no field outside the ring."""
    return float(remanence * np.log(outer / inner))


def torque(remanence: float, radius: float, field: float, angle: float) -> float:
    """N m/m on a magnetised cylinder (μ_r = 1): m × B = π a² Br B0/μ0 sin(angle from Br to B0)."""
    return float(np.pi * radius**2 * remanence * field / MU_0 * np.sin(angle))
