"""Roots of polynomials over whole grids of parameters, and the loci that they draw."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from fluxbore.design.polynomial import Polynomial

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]


def poles(polynomial: Polynomial, unit: float = 1.0) -> Complex:
    """(..., n) roots of a polynomial of degree n, those with the largest real part first.

    polynomial : the constant first; coefficients broadcast over a grid of shape (...). unit : the frequency (rad/s)
    that s is measured in meanwhile; one near the middle of the poles keeps the companion matrix well scaled.
    Raises ValueError where the leading coefficient is zero.
    """
    coefficients = np.stack(np.broadcast_arrays(*(np.asarray(c, dtype=np.float64) for c in polynomial)), axis=-1)
    degree = coefficients.shape[-1] - 1
    if not np.all(coefficients[..., -1]):
        raise ValueError("the leading coefficient of a polynomial is zero")
    monic = coefficients[..., :-1] / coefficients[..., -1:] * unit ** (np.arange(degree) - degree * 1.0)
    companion = np.zeros((*monic.shape, degree))
    companion[..., np.arange(1, degree), np.arange(degree - 1)] = 1.0
    companion[..., :, -1] = -monic
    roots = np.asarray(np.linalg.eigvals(companion) * unit, dtype=np.complex128)
    order = np.lexsort((-roots.imag, -roots.real), axis=-1)
    return np.take_along_axis(roots, order, axis=-1)


def loci(roots: Complex) -> Complex:
    """(points, n) poles along a parameter, reordered so that each column is one branch.

    Poles are matched with where the branches are bound by their last two points, so that they miss it as little as
    possible in total: branches that cross go on as they came.
    """
    ordered = np.array(roots)
    for point in range(1, len(ordered)):
        bound = ordered[point - 1] if point == 1 else 2 * ordered[point - 1] - ordered[point - 2]
        _, match = linear_sum_assignment(np.abs(bound[:, np.newaxis] - ordered[point]))
        ordered[point] = ordered[point][match]
    return ordered
