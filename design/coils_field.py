"""The exact field of a winding of rectangular cross-section in free space, off and inside the winding.

Biot and Savart's integral over the winding is taken in closed form along z and along the source's radius a; what
remains is one integral over the angle phi between source and field point. With

    u = a - r cos phi,  q = r sin phi,  zeta = z - z',  rho^2 = u^2 + q^2,  R^2 = rho^2 + zeta^2

and the double difference over the winding's two radii and two ends,

    B_r = mu0 J/(2 pi) ∫ [[ cos phi (R + r cos phi t) ]] dphi,
    B_z = mu0 J/(2 pi) ∫ [[ q atan(zeta u / (q R)) - zeta t + r cos phi asinh(zeta / rho) ]] dphi

from 0 to pi, where t = asinh(u / sqrt(q^2 + zeta^2)); Urankar (1982, IEEE Trans. Magn. 18, 1860) reduces the integrals
as far and goes on to elliptic ones. Where the field point lies on the winding's skin the integrand has a logarithm at
phi = 0, and beside it a near singularity; double exponential quadrature (Takahasi and Mori 1974, Publ. RIMS 9, 721)
crowds its nodes there and meets both to 1e-11 with one fixed rule, so that the field is as smooth in the winding's
dimensions as the integral itself.

Every argument may be complex: a step of 1e-30 i gives derivatives without a difference of close numbers.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.coils import Coil

Numbers = NDArray[Any]
"""float64 or complex128."""

NODES = 64
"""Of the rule; 64 leave 1e-11 of the field, 48 leave 1e-8."""

SPREAD = 3.5
"""Where the double exponential rule is cut: its outermost weight is 1e-21."""

NEAREST = 1e-9
"""Of the winding's inner radius; nearer to the axis than that the field is the axis's, to 1e-18 of itself."""


@cache
def angles(nodes: int = NODES) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """sin(phi/2), cos(phi/2) and the weights of the rule over phi from 0 to pi, (nodes,) each.

    The half angle's sine keeps its digits where phi = 1e-20, which 1 - cos phi does not.
    """
    t = np.linspace(-SPREAD, SPREAD, nodes)
    s = np.pi / 2 * np.sinh(t)
    share, rest = 1 / (1 + np.exp(-2 * s)), 1 / (1 + np.exp(2 * s))
    weights = np.pi * (t[1] - t[0]) * np.pi * np.cosh(t) * share * rest
    return np.sin(np.pi / 2 * share), np.sin(np.pi / 2 * rest), weights


def flux_density(coil: Coil, r: Any, z: Any, nodes: int = NODES) -> tuple[Numbers, Numbers]:
    """B_r and B_z (T) at places r, z (m), of any one shape."""
    half_sine, half_cosine, weights = angles(nodes)
    cosine, sine = half_cosine**2 - half_sine**2, 2 * half_sine * half_cosine
    r = np.asarray(r)[..., None]
    z = np.asarray(z)[..., None]
    r = np.where(np.real(r) < NEAREST * np.real(coil.inner_radius), NEAREST * np.real(coil.inner_radius), r)
    q = r * sine
    radial: Any = 0.0
    axial: Any = 0.0
    for a, outwards in ((coil.inner_radius, -1.0), (coil.outer_radius, 1.0)):
        u = a - r + 2 * r * half_sine**2
        rho2 = (a - r) ** 2 + 4 * a * r * half_sine**2
        for end, upwards in ((coil.lower, 1.0), (coil.upper, -1.0)):
            zeta = z - end
            big_r = np.sqrt(rho2 + zeta**2)
            across = np.arcsinh(u / np.sqrt(q**2 + zeta**2))
            sign = outwards * upwards
            # B_r = -dA/dz: the difference of the ends has the other sign.
            radial = radial - sign * cosine * (big_r + r * cosine * across)
            axial = axial - sign * (
                q * np.arctan(zeta * u / (q * big_r)) - zeta * across + r * cosine * np.arcsinh(zeta / np.sqrt(rho2))
            )
    scale = MU_0 * coil.current_density / (2 * np.pi)
    return scale * (radial @ weights), scale * (axial @ weights)
