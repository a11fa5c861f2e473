"""Modified Bessel functions of real order without their exponentials, over all orders and arguments.

    I_p(x) = e^{+s} i,   K_p(x) = e^{-s} k,   and their slopes I_p'(x) and K_p'(x) with the same s
    s(p, x) = w + p ln(x/(p + w)),   w = sqrt(p^2 + x^2)

s is the exponent of Debye's expansions for large orders (DLMF 10.41.3 to 10.41.6), so that i and k stay ordinary
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
    """At orders p and arguments x, all of one shape: the functions, or their slopes by x."""

    s: Floats
    i: Floats
    k: Floats


def scaled_bessel(order: Floats, x: Floats) -> ScaledBessel:
    """I_p(x) and K_p(x) of p >= 0 and x > 0, which broadcast."""
    from scipy.special import ive, kve

    p, x, w, s = _exponent(order, x)
    i, k = _rescaled(p, x, s, np.asarray(ive(p, x)), np.asarray(kve(p, x)))
    far = np.isnan(i)
    if np.any(far):
        up, down = _debye(p[far], w[far], 0)
        i[far], k[far] = up / np.sqrt(2 * np.pi * w[far]), down * np.sqrt(np.pi / (2 * w[far]))
    return ScaledBessel(s, i, k)


def scaled_slopes(order: Floats, x: Floats) -> ScaledBessel:
    """I_p'(x) and K_p'(x) of p >= 0 and x > 0, which broadcast."""
    from scipy.special import ive, kve

    p, x, w, s = _exponent(order, x)
    # From terms of one sign each: I_{p+1} + p/x I_p, -(K_{p-1} + p/x K_p).
    with np.errstate(over="ignore"):
        first, second = ive(p + 1, x) + p / x * ive(p, x), -(kve(p - 1, x) + p / x * kve(p, x))
    i, k = _rescaled(p, x, s, np.asarray(first), np.asarray(second))
    far = np.isnan(i)
    if np.any(far):
        up, down = _debye(p[far], w[far], 1)
        i[far] = up * np.sqrt(w[far] / (2 * np.pi)) / x[far]
        k[far] = -down * np.sqrt(np.pi * w[far] / 2) / x[far]
    return ScaledBessel(s, i, k)


def _exponent(order: Floats, x: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """p, x, w and s, of one shape; of subnormal orders the library would make nan."""
    p, x = np.broadcast_arrays(np.where(order < np.finfo(float).tiny, 0.0, order), x)
    w = np.hypot(p, x)
    return p, x, w, np.asarray(w + p * np.log(x / (p + w)))


def _rescaled(p: Floats, x: Floats, s: Floats, i: Floats, k: Floats) -> tuple[Floats, Floats]:
    """From e^{-x} I and e^x K to e^{-s} I and e^s K; nan where they are too faint or too large for it."""
    held = (i > FAINTEST) & np.isfinite(k)
    change = np.where(held, x - s, 0.0)
    return np.where(held, i * np.exp(change), np.nan), np.where(held, k * np.exp(-change), np.nan)


def _debye(p: Floats, w: Floats, slopes: int) -> tuple[Floats, Floats]:
    """The expansions' sums, of I and of K, for large orders p."""
    terms = [polynomial(p / w) / p**j for j, polynomial in enumerate(_polynomials()[slopes])]
    even, odd = sum(terms[::2]), sum(terms[1::2])
    return np.asarray(even + odd), np.asarray(even - odd)


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
