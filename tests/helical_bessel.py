"""The field of a helical section of linear layers, harmonic by harmonic, from modified Bessel functions.

The n-th harmonic of a helix is φ = Re f(r) exp(ikζ), k = 2πn/period, and with a radial remanence Re B exp(ikζ) that is
the same at all radii of its layer div B = 0 reads

    f'' + f'/r − (k² + ν²/r²) f = B/(μ r) ,   ν = k h ,

solved by I_ν(kr), K_ν(kr) and a particular integral by variation of parameters, whose Wronskian is −1/r. Every layer's
two constants follow from f and B_r = −μ f' + B, which are the same on both sides of a face. Nothing here is shared
with the finite elements but the section itself.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.integrate import quad
from scipy.special import ive, kve

from fluxbore.geometry.helical_section import HelicalSection

MU_0 = 4e-7 * np.pi


def exact_force(section: HelicalSection, orders: range = range(1, 30, 2)) -> float:
    """Axial force (N) on the inner member, per period."""
    return sum(harmonic_force(section, n) for n in orders)


def harmonic_force(section: HelicalSection, order: int) -> float:
    """What one harmonic contributes to it (N)."""
    k = 2 * np.pi * order / section.period
    nu = abs(k * section.lead / (2 * np.pi))
    shift = np.exp(-1j * k * section.displacement)
    layers = section.layers
    sources = [
        0j if layer.magnets is None else layer.magnets.harmonic(order) * (shift if number > section.gap else 1)
        for number, layer in enumerate(layers)
    ]
    if not any(abs(source) > 1e-14 for source in sources):
        return 0.0
    spans = list(pairwise(section.radii))
    size = 2 * len(layers)
    matrix, right = np.zeros((size, size)), np.zeros(size, dtype=complex)
    row = 0

    def put(layer: int, radius: float, flux: bool, sign: float) -> None:
        """Adds f, or B_r/μ0, of a layer at a radius to the equation of this row."""
        a, b = spans[layer]
        value, slope = _basis(k, nu, a, b, radius)
        particular, steep = _particular(k, nu, a, b, radius)
        mu = layers[layer].permeability
        density = sources[layer] / (mu * MU_0)
        if flux:
            matrix[row, 2 * layer : 2 * layer + 2] += -sign * mu * slope
            right[row] -= sign * mu * density * (1 - steep)
        else:
            matrix[row, 2 * layer : 2 * layer + 2] += sign * value
            right[row] -= sign * density * particular

    put(0, spans[0][0], section.inside == "closed", 1.0)
    row = 1
    for layer in range(len(layers) - 1):
        face = spans[layer][1]
        for flux in (False, True):
            put(layer, face, flux, 1.0)
            put(layer + 1, face, flux, -1.0)
            row += 1
    put(len(layers) - 1, spans[-1][1], section.outside == "closed", 1.0)
    if section.inner_radius == 0:  # nothing that is infinite on the axis
        matrix[0], right[0] = 0.0, 0.0
        matrix[0, 1] = 1.0
    scale = np.abs(matrix).max(axis=1)
    constants = np.linalg.solve(matrix / scale[:, None], right / scale)
    a, b = spans[section.gap]
    r = (a + b) / 2
    value, slope = _basis(k, nu, a, b, r)
    own = constants[2 * section.gap : 2 * section.gap + 2]
    f, f_r = own @ value, own @ slope
    # The mean over a period of ∂φ/∂r ∂φ/∂ζ is k/2 Im f' f*.
    return float(2 * np.pi * r * MU_0 * section.period * k / 2 * np.imag(f_r * np.conj(f)))


def _basis(k: float, nu: float, a: float, b: float, r: float) -> tuple[np.ndarray, np.ndarray]:
    """I_ν(kr), one at b, and K_ν(kr), one at a, and their derivatives by r; the scaled functions do not overflow."""
    grown, fallen = np.exp(-k * (b - r)) / ive(nu, k * b), np.exp(-k * (r - a)) / (kve(nu, k * a) if a else 1.0)
    if r == 0:
        return np.zeros(2), np.zeros(2)
    if a == 0:
        fallen = 0.0
    x = k * r
    value = np.array([ive(nu, x) * grown, kve(nu, x) * fallen])
    slope = k / 2 * np.array([(ive(nu - 1, x) + ive(nu + 1, x)) * grown, -(kve(nu - 1, x) + kve(nu + 1, x)) * fallen])
    return value, slope


def _particular(k: float, nu: float, a: float, b: float, r: float) -> tuple[float, float]:
    """f with f'' + f'/r − (k² + ν²/r²) f = 1/r, and f':  −I(kr) ∫_r^b K − K(kr) ∫_a^r I."""
    if r == 0:
        return 0.0, 0.0
    x = k * r
    outer = quad(lambda t: kve(nu, k * t) * np.exp(-k * (t - r)), r, b, epsabs=0, epsrel=1e-12)[0] if r < b else 0.0
    inner = quad(lambda t: ive(nu, k * t) * np.exp(-k * (r - t)), a, r, epsabs=0, epsrel=1e-12)[0] if r > a else 0.0
    value = -ive(nu, x) * outer - kve(nu, x) * inner
    slope = -(ive(nu - 1, x) + ive(nu + 1, x)) * outer + (kve(nu - 1, x) + kve(nu + 1, x)) * inner
    return float(value), float(k / 2 * slope)
