"""One-dimensional problems: a steel of known law, long solenoids, a laminated core, slabs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from exact.loops import MU_0


@dataclass(frozen=True, slots=True)
class Steel:
    """B = μ0 H + (2 Bs/π) arctan(π μ0 (μi − 1) H/(2 Bs)): saturation Bs (T), initial permeability μi."""

    saturation: float = 2.0
    initial: float = 2000.0

    @property
    def _steepness(self) -> float:
        return float(np.pi * MU_0 * (self.initial - 1) / (2 * self.saturation))

    def flux_density(self, h: float) -> float:
        """B (T) at H (A/m)."""
        return float(MU_0 * h + 2 * self.saturation / np.pi * np.arctan(self._steepness * h))

    def field(self, b: float) -> float:
        """H (A/m) at B (T)."""
        return float(brentq(lambda h: self.flux_density(h) - abs(b), 0.0, abs(b) / MU_0 + 1, xtol=1e-12) * np.sign(b))

    def coenergy(self, h: float) -> float:
        """∫ B dH (J/m³): μ0 H²/2 + (2 Bs/π)(H arctan sH − ln(1 + s²H²)/(2s))."""
        s = self._steepness
        bend = h * np.arctan(s * h) - np.log1p((s * h) ** 2) / (2 * s)
        return float(MU_0 * h**2 / 2 + 2 * self.saturation / np.pi * bend)

    def energy(self, h: float) -> float:
        """∫ H dB = B H − coenergy (J/m³)."""
        return self.flux_density(h) * h - self.coenergy(h)

    def table(self, rows: int = 120, last: float = 3e5) -> tuple[tuple[float, float], ...]:
        """(B, H) rows for a file: H from 0, then in geometric steps."""
        fields = [0.0, *np.geomspace(last * 1e-5, last, rows - 1)]
        return tuple((self.flux_density(float(h)), float(h)) for h in fields)


@dataclass(frozen=True, slots=True)
class LongSolenoid:
    """A winding of ampere-turns per metre K (A/m) between two radii (m) around a core; H = K inside, 0 outside."""

    steel: Steel
    loading: float
    core: float
    inner: float
    outer: float

    def field(self, r: float) -> float:
        """H_z (A/m) at a radius, falling along the winding."""
        return self.loading * float(np.clip((self.outer - r) / (self.outer - self.inner), 0, 1))

    def flux_per_turn(self) -> float:
        """Mean flux (Wb) through the winding's turns: ∫ B (H/K) 2π r dr, each radius linked by the turns outside it."""
        core = np.pi * self.core**2 * self.steel.flux_density(self.loading)
        air = np.pi * (self.inner**2 - self.core**2) * MU_0 * self.loading
        winding = quad(
            lambda r: 2 * np.pi * r * MU_0 * self.field(r) ** 2 / self.loading, self.inner, self.outer, epsabs=0
        )[0]
        return float(core + air + winding)

    def energies(self) -> tuple[float, float]:
        """Energy and coenergy (J/m)."""
        rest = np.pi * (self.inner**2 - self.core**2) * MU_0 * self.loading**2 / 2
        rest += quad(lambda r: np.pi * r * MU_0 * self.field(r) ** 2, self.inner, self.outer, epsabs=0)[0]
        area = np.pi * self.core**2
        return area * self.steel.energy(self.loading) + rest, area * self.steel.coenergy(self.loading) + rest


def ring(steel: Steel, current: float, inner: float, outer: float) -> tuple[float, float, float]:
    """Flux (Wb/m), energy and coenergy (J/m) of a steel ring around a wire: H = I/(2πr)."""

    def h(r: float) -> float:
        return current / (2 * np.pi * r)

    flux = quad(lambda r: steel.flux_density(h(r)), inner, outer, epsabs=0)[0]
    energy = quad(lambda r: 2 * np.pi * r * steel.energy(h(r)), inner, outer, epsabs=0)[0]
    coenergy = quad(lambda r: 2 * np.pi * r * steel.coenergy(h(r)), inner, outer, epsabs=0)[0]
    return float(flux), float(energy), float(coenergy)


def stacked(mu_r: float, fill: float, along: bool) -> float:
    """Relative permeability of sheets and gaps: f μr + (1 − f) along the sheets, μr/(f + (1 − f) μr) across."""
    return fill * mu_r + 1 - fill if along else mu_r / (fill + (1 - fill) * mu_r)


def mixed_slab(density: float, width: float, c0: float, c1: float, x: float) -> tuple[float, float]:
    """A (Wb/m) and B_y (T) in a slab of current with A(0) = 0 and (1/μ0) A' + c0 A + c1 = 0 at x = width.

    A = −μ0 J x²/2 + C x.
    """
    slope = (density * width + c0 * MU_0 * density * width**2 / 2 - c1) / (1 / MU_0 + c0 * width)
    return -MU_0 * density * x**2 / 2 + slope * x, MU_0 * density * x - slope
