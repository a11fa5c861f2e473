"""Coaxial coils of rectangular section and uniform current in free space."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad, quad_vec
from scipy.special import j0, j1, struve

from exact.cylinders import sheet_flux_density
from exact.loops import MU_0, Floats, mutual_inductance


@dataclass(frozen=True, slots=True)
class Coil:
    """turns, current (A), inner and outer radius, lower and upper end (m)."""

    turns: float
    current: float
    inner: float
    outer: float
    lower: float
    upper: float

    @property
    def area(self) -> float:
        return (self.outer - self.inner) * (self.upper - self.lower)

    @property
    def current_density(self) -> float:
        """A/m²."""
        return self.turns * self.current / self.area


def coil_flux_density(coils: tuple[Coil, ...], r: float, z: float) -> Floats:
    """(2,) B_r and B_z (T) at (r, z): ∫ over the winding's radii of the field of thin sheets, to about 1e-9."""
    total = np.zeros(2)
    for coil in coils:
        half, middle = (coil.upper - coil.lower) / 2, (coil.upper + coil.lower) / 2
        cuts = [coil.inner, *([r] if coil.inner < r < coil.outer else []), coil.outer]  # B_z jumps where a sheet passes
        for start, end in itertools.pairwise(cuts):
            value, _ = quad_vec(
                lambda a, half=half, middle=middle: sheet_flux_density(a, half, r, z - middle),
                start,
                end,
                epsrel=1e-10,
                epsabs=1e-15,
            )
            total += MU_0 * coil.current_density * value
    return total


def _radial(k: float, coil: Coil) -> float:
    """∫ r J1(kr) dr over the winding, by Struve's functions (m²)."""

    def primitive(x: float) -> float:
        return float(np.pi * x / 2 * (j1(x) * struve(0, x) - j0(x) * struve(1, x)))

    return (primitive(k * coil.outer) - primitive(k * coil.inner)) / k**2


def _over(integrand: Callable[[float], float], unit: float) -> float:
    """∫ over k from 0, in pieces; `unit` (m) is the length that sets their scale."""
    pieces = np.array([1e-9, 1, 5, 20, 60, 150, 400, 1000, 3000]) / unit
    total = 0.0
    for start, end in itertools.pairwise(pieces):
        total += quad(integrand, start, end, limit=1000, epsrel=1e-10, epsabs=1e-10 * abs(total))[0]
    return total


def inductance(one: Coil, other: Coil) -> float:
    """Mutual inductance (H), the self-inductance where both are the same.

    μ0 π N1 N2/(A1 A2) ∫ S1 S2 Z dk, with S = ∫ r J1(kr) dr and Z = ∬ e^(−k|z − z'|) dz dz' over the two windings: each
    loop of one with each of the other.
    """

    def axial(k: float) -> float:
        """Z by the second primitive 2|u|/k + e^(−k|u|)/k² of e^(−k|u|), even in u."""

        def twice(u: float) -> float:
            return float(2 * max(u, 0.0) / k + np.exp(-k * abs(u)) / k**2)

        a, b, c, d = one.lower, one.upper, other.lower, other.upper
        return float(twice(b - c) + twice(a - d) - twice(a - c) - twice(b - d))

    def integrand(k: float) -> float:
        return _radial(k, one) * _radial(k, other) * axial(k)

    scale = MU_0 * np.pi * one.turns * other.turns / (one.area * other.area)
    return float(scale * _over(integrand, max(one.outer, other.outer)))


def attraction(one: Coil, other: Coil) -> float:
    """Force (N) on `one` along +z: I1 I2 ∂M/∂(its position)."""

    def slope(k: float) -> float:
        def once(u: float) -> float:
            """Derivative of the second primitive."""
            return float((2 / k if u > 0 else 0.0) - np.sign(u) * np.exp(-k * abs(u)) / k)

        a, b, c, d = one.lower, one.upper, other.lower, other.upper
        return float(once(b - c) + once(a - d) - once(a - c) - once(b - d))

    def integrand(k: float) -> float:
        return _radial(k, one) * _radial(k, other) * slope(k)

    scale = MU_0 * np.pi * one.turns * other.turns / (one.area * other.area)
    return float(one.current * other.current * scale * _over(integrand, max(one.outer, other.outer)))


def _with_sheet(coil: Coil, remanence: float, radius: float, at: float) -> float:
    """Linkage (Wb/m) of the coil with a loop of Br/μ0 at height `at` (A/m): Gauss rule over the winding."""
    points, weights = np.polynomial.legendre.leggauss(32)
    r = (coil.inner + coil.outer) / 2 + (coil.outer - coil.inner) / 2 * points
    z = (coil.lower + coil.upper) / 2 + (coil.upper - coil.lower) / 2 * points
    table = mutual_inductance(r[:, None], radius, z[None, :] - at)
    return float(coil.turns * remanence / MU_0 * (weights @ table @ weights) / 4)


def linkage_by_magnet(coil: Coil, remanence: float, radius: float, length: float) -> float:
    """Flux (Wb) through a coil around an axially magnetised cylinder of μ_r = 1 centred at the origin."""
    return float(
        quad(lambda z: _with_sheet(coil, remanence, radius, z), -length / 2, length / 2, epsrel=1e-9, epsabs=0)[0]
    )


def force_by_magnet(coil: Coil, remanence: float, radius: float, length: float) -> float:
    """F_z (N) on the coil: I ∂λ/∂z of the coil, which leaves the linkage with the magnet's two end loops."""
    below, above = (_with_sheet(coil, remanence, radius, z) for z in (-length / 2, length / 2))
    return coil.current * (below - above)
