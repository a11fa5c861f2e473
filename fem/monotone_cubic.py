"""The monotone piecewise cubic through a table: Hermite's cubics with Fritsch and Butland's slopes.

At an inner point the slope is the harmonic mean of its neighbours' secants, weighted by the intervals' lengths
(Fritsch and Butland 1984, SIAM J. Sci. Stat. Comput. 5, 300), or zero where these differ in sign; at an end it is that
of a parabola through three points, cut where it would overshoot. This is what `scipy.interpolate` calls PCHIP; loading
that package takes a process several times as long as a solution of the field.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def monotone_cubic(x: Floats, y: Floats) -> Floats:
    """(4, k − 1) coefficients in powers of the distance from each interval's start, highest power first, of the cubic
    through points x (k,), rising, and y (k,); k is 2 at least."""
    length = np.diff(x)
    secant = np.diff(y) / length
    slope = _slopes(length, secant)
    start, end = slope[:-1], slope[1:]
    bend = (start + end - 2 * secant) / length
    return np.stack((bend / length, (secant - start) / length - bend, start, y[:-1]))


def cubic_values(x: Floats, coefficients: Floats, points: Floats) -> Floats:
    """(n,) of the cubics of `monotone_cubic` at points (n,) from the first x to the last."""
    interval = np.clip(np.searchsorted(x, points, side="right") - 1, 0, x.size - 2)
    t = points - x[interval]
    third, second, first, value = coefficients[:, interval]
    return np.asarray(value + t * (first + t * (second + t * third)))


def _slopes(length: Floats, secant: Floats) -> Floats:
    """(k,) at the points."""
    if secant.size == 1:
        return np.repeat(secant, 2)
    before, after = secant[:-1], secant[1:]
    alike = before * after > 0
    to_before, to_after = length[:-1] + 2 * length[1:], 2 * length[:-1] + length[1:]
    total = np.where(alike, to_before / np.where(alike, before, 1.0) + to_after / np.where(alike, after, 1.0), 1.0)
    inner = np.where(alike, (to_before + to_after) / total, 0.0)
    first = _end(length[0], length[1], secant[0], secant[1])
    last = _end(length[-1], length[-2], secant[-1], secant[-2])
    return np.concatenate(([first], inner, [last]))


def _end(length: float, next_length: float, secant: float, next_secant: float) -> float:
    """At the first point, or at the last one seen from the end."""
    slope = ((2 * length + next_length) * secant - length * next_secant) / (length + next_length)
    if slope * secant <= 0:
        return 0.0
    if secant * next_secant <= 0 and abs(slope) > 3 * abs(secant):
        return 3 * secant
    return float(slope)
