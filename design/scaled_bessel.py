"""Modified Bessel functions of real order without their exponentials, over all orders and arguments.

    I_p(x) = e^{+s} i,   K_p(x) = e^{-s} k,   I_p'(x) = e^{+s} di,   K_p'(x) = e^{-s} dk
    s(p, x) = w + p ln(x/(p + w)),   w = sqrt(p^2 + x^2)

s is the exponent of Debye's expansions for large orders (DLMF 10.41.3 to 10.41.6), so that i, k, di, dk stay ordinary
numbers where I_p and K_p themselves leave the range of doubles, upwards for large x or downwards for large p. Ratios
across a layer are then differences of s. The values are `scipy.special.ive` and `kve`, to their 14 digits or so; where
these are out of range, which takes orders above 100, they are the expansions with `TERMS` terms, to 1e-12.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

Floats = NDArray[np.float64]

TERMS = 8
"""Of Debye's expansions; the first left out is below 1e-15 at p = 100."""

FAINTEST = 1e-250
"""ive below which its expansion takes over, while it and kve are whole numbers of digits still."""


@dataclass(frozen=True, slots=True, eq=False)
class ScaledBessel:
    """At orders p and arguments x, all of one shape."""

    s: Floats
    i: Floats
    k: Floats
    di: Floats  # by x
    dk: Floats


def scaled_bessel(order: Floats, x: Floats) -> ScaledBessel:
    """Of p >= 0 and x > 0, which broadcast."""
    from scipy.special import ive, kve

    p, x = np.broadcast_arrays(np.where(order < np.finfo(float).tiny, 0.0, order), x)  # of subnormal p ive makes nan
    w = np.hypot(p, x)
    s = w + p * np.log(x / (p + w))
    i0, k0 = ive(p, x), kve(p, x)
    high = ~((i0 > FAINTEST) & np.isfinite(k0) & (x - s < 500))
    with np.errstate(over="ignore", invalid="ignore"):
        up, down = np.exp(x - s), np.exp(s - x)
        # Slopes from terms of one sign each: I_{p+1} + p/x I_p, -(K_{p-1} + p/x K_p).
        values = up * i0, down * k0, up * (ive(p + 1, x) + p / x * i0), -down * (kve(p - 1, x) + p / x * k0)
    i, k, di, dk = (np.asarray(value) for value in values)
    if np.any(high):
        i, k, di, dk = (np.where(high, b, a) for a, b in zip((i, k, di, dk), _debye(p, x, w, high), strict=True))
    return ScaledBessel(np.asarray(s), i, k, di, dk)


def _debye(p: Floats, x: Floats, w: Floats, where: NDArray[np.bool_]) -> tuple[Floats, Floats, Floats, Floats]:
    """i, k, di, dk by the expansions, meant for large orders; elsewhere, where the mask is off, of an order of one."""
    p = np.where(where, p, 1.0)
    t = np.where(where, p / w, 0.5)
    u, v = _polynomials()
    value = [sum(sign**j * u[j](t) / p**j for j in range(TERMS)) for sign in (1, -1)]
    slope = [sum(sign**j * v[j](t) / p**j for j in range(TERMS)) for sign in (1, -1)]
    i, k = value[0] / np.sqrt(2 * np.pi * w), value[1] * np.sqrt(np.pi / (2 * w))
    di, dk = slope[0] * np.sqrt(w / (2 * np.pi)) / x, -slope[1] * np.sqrt(np.pi * w / 2) / x
    return i, k, di, dk


@cache
def _polynomials() -> tuple[tuple[Polynomial, ...], tuple[Polynomial, ...]]:
    """u_j and v_j of DLMF 10.41.9 to 10.41.11, by their recurrences."""
    t = Polynomial([0.0, 1.0])
    bend = t * t * (1 - t * t)
    u, v = [Polynomial([1.0])], [Polynomial([1.0])]
    for _ in range(1, TERMS):
        last = u[-1]
        u.append(bend * last.deriv() / 2 + ((1 - 5 * t * t) * last).integ() / 8)
        v.append(u[-1] - t * (1 - t * t) * last / 2 - bend * last.deriv())
    return tuple(u), tuple(v)
