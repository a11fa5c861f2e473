"""Permeability of soft iron by field strength: what a scalar potential's equations ask of a B-H curve.

The curve is the same C2 spline H(B) that vector potentials use; here it is solved for B. B(H) of a strictly monotone
spline has a continuous first derivative, the differential permeability dB/dH, which Newton's tangent needs.
"""

from __future__ import annotations

import numpy as np

from fluxbore.fem.mesh import Floats
from fluxbore.fem.reluctivity import VACUUM_PERMEABILITY, ReluctivityCurve

ITERATIONS = 50
"""Halvings at most of an interval between two knots. Newton's steps need three or four."""

NEAR = 1e-8
"""Of that interval: a last step of Newton's, shorter than this, leaves an error of rounding."""


def flux_density(curve: ReluctivityCurve, h: Floats) -> tuple[Floats, Floats]:
    """B (T) and dB/dH (H/m) at H >= 0 (A/m), any shape."""
    at_knots = curve.coefficients[0]
    k = np.clip(np.searchsorted(at_knots, h, side="right") - 1, 0, at_knots.size - 1)
    c0, c1, c2, c3 = (curve.coefficients[i][k] for i in range(4))
    last = k == at_knots.size - 1
    low = np.zeros_like(h)
    high = np.where(last, (h - c0) * VACUUM_PERMEABILITY * 2, curve.step)
    ends = np.append(at_knots[1:], at_knots[-1] + 1.0)[k]
    x = np.where(last, (h - c0) / c1, curve.step * (h - c0) / (ends - c0))
    for _ in range(ITERATIONS):
        miss = c0 + x * (c1 + x * (c2 + x * c3)) - h
        low, high = np.where(miss < 0, x, low), np.where(miss > 0, x, high)
        step = x - miss / (c1 + x * (2 * c2 + 3 * c3 * x))
        # A step out of what brackets the root is replaced by its middle.
        following = np.where((step >= low) & (step <= high), step, (low + high) / 2)
        near = bool(np.all(np.abs(following - x) <= NEAR * curve.step))
        x = following
        if near:
            break
    return np.asarray(k * curve.step + x), np.asarray(1 / (c1 + x * (2 * c2 + 3 * c3 * x)))


def permeability(curve: ReluctivityCurve, h_squared: Floats) -> tuple[Floats, Floats]:
    """μ = B/H (H/m) and dμ/d(H²) (H m/A²) at |H|² (A²/m²), any shape."""
    h = np.sqrt(h_squared)
    b, slope = flux_density(curve, h)
    still = h == 0
    size = np.where(still, 1.0, h)
    mu = np.where(still, slope, b / size)
    # Near zero B is μ H + O(H³), and the difference is one of rounding: it is divided by no less than (1 A/m)².
    return mu, (slope - mu) / (2 * np.maximum(size, 1.0) ** 2)


def coenergy_density(curve: ReluctivityCurve, h_squared: Floats) -> Floats:
    """∫B dH from zero (J/m³) at |H|² (A²/m²)."""
    h = np.sqrt(h_squared)
    b, _ = flux_density(curve, h)
    return np.asarray(b * h - curve.energy_density(b))
