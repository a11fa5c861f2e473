"""How toleranced keys scatter, and the exact distribution of a weighted sum of them.

Every distribution is symmetric about the middle of its limits, at (minus + plus)/2 from the nominal value. With w the
distance between the limits its standard deviation is w/6 (normal: the limits stand at three standard deviations, the
0.27 % beyond them are not cut off, as nothing is inspected), w/sqrt(12) (uniform) and w/sqrt(24) (triangular); see
JCGM 100:2008, 4.3. Keys scatter independently: correlated ones are not modelled.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri

from fluxbore.design.study import Tolerance

Array = NDArray[np.float64]

_WIDTHS = {"normal": 6.0, "uniform": math.sqrt(12), "triangular": math.sqrt(24)}
"""The distance between the limits in standard deviations."""

REACH = 8.5
"""Standard deviations beyond which a normal distribution has less than a float's rounding error."""

CELLS = 2**14
"""Of the grid on which distributions are convolved; the error of a share is below 1e-5 (see the tests)."""


def centre(tolerance: Tolerance) -> float:
    """Mean of the deviation from the nominal value."""
    return (tolerance.minus + tolerance.plus) / 2


def sigma(tolerance: Tolerance) -> float:
    """Standard deviation."""
    return (tolerance.plus - tolerance.minus) / _WIDTHS[tolerance.distribution]


def deviations(tolerances: Sequence[Tolerance], samples: int, seed: int) -> Array:
    """Deviations from the nominal values, (samples, keys): the same first rows however many there are."""
    shares = np.random.default_rng(seed).random((samples, len(tolerances)))
    shares += 2.0**-54  # a share of exactly zero would be minus infinity
    for column, tolerance in enumerate(tolerances):
        half = (tolerance.plus - tolerance.minus) / 2
        shares[:, column] = centre(tolerance) + _quantile(tolerance.distribution, half, shares[:, column])
    return shares


@dataclass(frozen=True)
class LinearSum:
    """The distribution of  sum of slope_i x deviation_i,  exact to the grid's `CELLS`.

    Normal parts are one normal distribution; it is convolved with the others.
    """

    tolerances: tuple[Tolerance, ...]
    slopes: tuple[float, ...]

    @cached_property
    def mean(self) -> float:
        return math.fsum(slope * centre(item) for slope, item in self._parts)

    @cached_property
    def sigma(self) -> float:
        return math.sqrt(self.variance)

    @cached_property
    def variance(self) -> float:
        return math.fsum(self.variances)

    @cached_property
    def variances(self) -> tuple[float, ...]:
        """Of each part."""
        return tuple((slope * sigma(item)) ** 2 for slope, item in self._parts)

    @cached_property
    def worst(self) -> tuple[float, float]:
        """The lowest and the highest sum with every deviation at one of its limits."""
        ends = [(slope * item.minus, slope * item.plus) for slope, item in self._parts]
        return math.fsum(min(pair) for pair in ends), math.fsum(max(pair) for pair in ends)

    def below(self, value: float) -> float:
        """The share of sums that are at most ``value``."""
        centred = value - self.mean
        match self._symmetric:
            case []:
                return float(centred >= 0)
            case [(kind, half)]:
                return float(_below(kind, half, np.array(centred)))
            case _:
                edges, shares = self._grid
                return float(np.interp(centred, edges, shares, left=0.0, right=1.0))

    def quantile(self, share: float) -> float:
        """The value that the ``share`` of sums, between 0 and 1 and neither of them, lies below."""
        match self._symmetric:
            case []:
                return self.mean
            case [(kind, half)]:
                return self.mean + float(_quantile(kind, half, np.array(share)))
            case _:
                edges, shares = self._grid
                first = int(np.searchsorted(shares, share))  # flat stretches at the ends would be ambiguous
                return self.mean + float(np.interp(share, shares[first - 1 : first + 1], edges[first - 1 : first + 1]))

    @property
    def _parts(self) -> list[tuple[float, Tolerance]]:
        return list(zip(self.slopes, self.tolerances, strict=True))

    @cached_property
    def _symmetric(self) -> list[tuple[str, float]]:
        """The parts about their own middle: distribution and half distance of its limits, normal ones in one."""
        scaled = [
            (item.distribution, abs(slope) * (item.plus - item.minus) / 2) for slope, item in self._parts if slope
        ]
        normal = math.sqrt(math.fsum(half**2 for kind, half in scaled if kind == "normal"))
        rest = [(kind, half) for kind, half in scaled if kind != "normal" and half > 0]
        return [*([("normal", normal)] if normal > 0 else []), *rest]

    @cached_property
    def _grid(self) -> tuple[Array, Array]:
        """Cell edges about the mean and the share of sums below each."""
        reach = sum(REACH * half / 3 if kind == "normal" else half for kind, half in self._symmetric)
        size = 2 * reach / (CELLS - 2)
        middles: Array = (np.arange(CELLS) - CELLS // 2) * np.float64(size)
        spectrum = np.ones(CELLS // 2 + 1, dtype=complex)
        for kind, half in self._symmetric:
            mass = _below(kind, half, middles + size / 2) - _below(kind, half, middles - size / 2)
            spectrum *= np.fft.rfft(np.fft.ifftshift(mass))
        total: Array = np.clip(np.fft.fftshift(np.fft.irfft(spectrum, CELLS)), 0.0, None)
        shares: Array = np.cumsum(total)
        return middles + size / 2, shares / shares[-1]


def _below(kind: str, half: float, value: Array) -> Array:
    """The share of a distribution about zero, its limits at +-half, below the value."""
    x = value / half
    if kind == "normal":
        return np.asarray(ndtr(3 * x))
    x = np.clip(x, -1.0, 1.0)
    if kind == "uniform":
        return np.asarray((1 + x) / 2)
    return np.asarray(np.where(x < 0, (1 + x) ** 2 / 2, 1 - (1 - x) ** 2 / 2))


def _quantile(kind: str, half: float, share: Array) -> Array:
    """The inverse of `_below`."""
    if kind == "normal":
        return np.asarray(half / 3 * ndtri(share))
    if kind == "uniform":
        return np.asarray(half * (2 * share - 1))
    low, high = np.sqrt(2 * share) - 1, 1 - np.sqrt(2 * (1 - share))
    return np.asarray(half * np.where(share < 0.5, low, high))
