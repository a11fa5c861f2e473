"""Periodic planar magnets: a Halbach array in free space, and a slotless machine between smooth irons.

Halbach array: Mallinson, IEEE Trans. Magn. 9 (1973) 678; Furlani, Permanent Magnet and Electromechanical Devices
(2001).
Slotless machine: separation of variables as in Zhu, Howe, Bolte, Ackermann, IEEE Trans. Magn. 29 (1993) 124, in plane
coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from exact.loops import MU_0, Floats


def halbach_array(remanence: float, wavelength: float, thickness: float, x: float, above: float) -> Floats:
    """(2,) B (T) above the strong side of magnets of μ_r = 1 with M along (−sin kx, cos kx), k = 2π/wavelength.

    Br (1 − e^(−kh)) e^(−k y) (sin kx, cos kx), y from the surface; nothing on the other side.
    """
    k = 2 * np.pi / wavelength
    size = remanence * (1 - np.exp(-k * thickness)) * np.exp(-k * above)
    return np.asarray(size * np.array([np.sin(k * x), np.cos(k * x)]))


@dataclass(frozen=True, slots=True)
class Slotless:
    """Magnets of alternating ±y on iron at y = 0, a gap, iron at y = gap; both irons of infinite permeability.

    One magnet is centred at x = 0. remanence T, mu_r recoil permeability, pitch (half a period) m, fraction of the
    pitch that is magnet, height of the magnets m, gap from iron to iron m.
    """

    remanence: float
    mu_r: float
    pitch: float
    fraction: float
    height: float
    gap: float

    def _terms(self, count: int = 400) -> tuple[Floats, Floats]:
        """Wave numbers (1/m) and amplitudes b of φ = Σ b sinh(k (g − y))/cosh(k (g − h)) cos kx in the gap (A)."""
        n = np.arange(1, 2 * count, 2)
        k = np.asarray(np.pi * n / self.pitch)
        magnetisation = self.remanence / MU_0 * 4 / (np.pi * n) * np.sin(n * np.pi * self.fraction / 2)
        if self.fraction < 1:  # air between the magnets has their recoil permeability only where that is 1
            assert self.mu_r == 1
        clear = self.gap - self.height
        return k, np.asarray(magnetisation / k / (1 + self.mu_r * np.tanh(k * clear) / np.tanh(k * self.height)))

    def flux_density(self, x: float, y: float) -> Floats:
        """(2,) B (T) in the gap, height < y <= gap."""
        k, b = self._terms()
        up, share = self.gap - y, self.gap - self.height
        cosh = (np.exp(k * (up - share)) + np.exp(-k * (up + share))) / (1 + np.exp(-2 * k * share))
        sinh = (np.exp(k * (up - share)) - np.exp(-k * (up + share))) / (1 + np.exp(-2 * k * share))
        return MU_0 * np.array([np.sum(b * k * sinh * np.sin(k * x)), np.sum(b * k * cosh * np.cos(k * x))])

    def potential(self, x: float, y: float) -> float:
        """A (Wb/m) with A = 0 at x = 0: B_y = −∂A/∂x."""
        k, b = self._terms()
        up, share = self.gap - y, self.gap - self.height
        cosh = (np.exp(k * (up - share)) + np.exp(-k * (up + share))) / (1 + np.exp(-2 * k * share))
        return float(-MU_0 * np.sum(b * cosh * np.sin(k * x)))

    def mean_potential(self, x: tuple[float, float], y: tuple[float, float]) -> float:
        """Mean of A (Wb/m) over a rectangle in the gap."""
        points, weights = np.polynomial.legendre.leggauss(24)
        across = [np.mean(x) + np.diff(x)[0] / 2 * p for p in points]
        up = [np.mean(y) + np.diff(y)[0] / 2 * p for p in points]
        table = np.array([[self.potential(float(p), float(q)) for q in up] for p in across])
        return float(weights @ table @ weights / 4)

    def thrust(self, current: float, x: tuple[float, float], y: tuple[float, float]) -> float:
        """F_x (N/m) on a conductor of uniform current filling a rectangle in the gap: −J ∬ B_y = J ∫ [A(x2) − A(x1)].

        The conductor's own field does not push it along smooth irons.
        """
        points, weights = np.polynomial.legendre.leggauss(24)
        up = [float(np.mean(y) + np.diff(y)[0] / 2 * p) for p in points]
        step = [self.potential(x[1], value) - self.potential(x[0], value) for value in up]
        return float(current / (x[1] - x[0]) * (weights @ np.array(step)) / 2)
