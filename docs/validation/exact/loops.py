"""Coaxial current loops by complete elliptic integrals.

Maxwell, A Treatise on Electricity and Magnetism (1873), art. 701; Smythe, Static and Dynamic Electricity (3rd ed.
1968), 7.10. k² = 4ab/((a + b)² + z²).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipe, ellipkm1

Floats = NDArray[np.float64]
MU_0 = 4e-7 * np.pi


def mutual_inductance(a: ArrayLike, b: ArrayLike, z: ArrayLike) -> Floats:
    """M = μ0 √(ab) [(2/k − k) K − (2/k) E] (H) of loops of radii a, b at distance z (m), any shapes alike."""
    a, b, z = (np.asarray(value, dtype=float) for value in (a, b, z))
    far = (a + b) ** 2 + z**2
    k = np.sqrt(4 * a * b / far)
    first, second = ellipkm1(((a - b) ** 2 + z**2) / far), ellipe(k**2)
    return np.asarray(MU_0 * np.sqrt(a * b) * ((2 / k - k) * first - 2 / k * second))


def force(a: ArrayLike, b: ArrayLike, z: ArrayLike) -> Floats:
    """F = μ0 z k/(4√(ab)) [(2 − k²)/(1 − k²) E − 2K] (N/A²), attraction of equal currents; its sign is that of z."""
    a, b, z = (np.asarray(value, dtype=float) for value in (a, b, z))
    far = (a + b) ** 2 + z**2
    square, rest = 4 * a * b / far, ((a - b) ** 2 + z**2) / far
    first, second = ellipkm1(rest), ellipe(square)
    return np.asarray(MU_0 * z * np.sqrt(square) / (4 * np.sqrt(a * b)) * ((2 - square) / rest * second - 2 * first))


def flux_density(a: ArrayLike, r: ArrayLike, z: ArrayLike) -> Floats:
    """(..., 2) B_r and B_z (T/A) at (r, z) (m) of a loop of radius a at z = 0. Not on the wire."""
    a, r, z = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (a, r, z)))
    far, near = (a + r) ** 2 + z**2, (a - r) ** 2 + z**2
    first, second = ellipkm1(near / far), ellipe(4 * a * r / far)
    scale = MU_0 / (2 * np.pi * np.sqrt(far))
    axial = scale * (first + (a**2 - r**2 - z**2) / near * second)
    off_axis = np.where(r > 0, r, 1.0)
    radial = np.where(r > 0, scale * z / off_axis * (-first + (a**2 + r**2 + z**2) / near * second), 0.0)
    return np.stack((radial, axial), axis=-1)
