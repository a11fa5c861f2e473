"""The magnetic energy of coaxial windings in free space, exactly.

The energy of two windings is pi J ∫∫ r A_phi dr dz over the first with the vector potential of the second. Both
integrals along z and the one along the source's radius are closed; the angle phi has the double exponential rule of
`fluxbore.design.coils_field`, and the first winding's radius Gauss and Legendre's. With that module's symbols the
integrand is, in double differences over radii and ends,

    cos phi [ (rho^2 (zeta s - R) + R^3/3)/2
              + r cos phi ( u (zeta s - R) + (u R + (zeta^2 - q^2) t)/2 - zeta q atan(zeta u / (q R)) ) ]

where s = asinh(zeta/rho) and t = asinh(u / sqrt(q^2 + zeta^2)). A winding's energy with itself needs no other formula:
where r meets its own skin the integrand has a weak singularity of third order, which costs no digits that count.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.bh_curve import MU_0
from fluxbore.design.coils import Coil
from fluxbore.design.coils_field import NODES, Numbers, angles

ORDER = 20
"""Gauss points across a winding; on a section of one by two, 20 leave 1e-11 of the energy and 12 leave 4e-10."""


@cache
def _gauss(order: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    points, weights = np.polynomial.legendre.leggauss(order)
    return points, weights


def mutual_energy(one: Coil, other: Coil, order: int = ORDER, nodes: int = NODES) -> Any:
    """∫ J A dV (J) over the first winding with the potential of the second: I1 I2 M12, or I^2 L of one with itself.

    Complex where the windings are.
    """
    half_sine, half_cosine, angle_weights = angles(nodes)
    cosine, sine = half_cosine**2 - half_sine**2, 2 * half_sine * half_cosine
    points, weights = _gauss(order)
    half = (one.outer_radius - one.inner_radius) / 2
    r = (one.inner_radius + half * (1 + points))[:, None]
    q = r * sine
    total: Any = 0.0
    for a, outwards in ((other.inner_radius, -1.0), (other.outer_radius, 1.0)):
        u = a - r + 2 * r * half_sine**2
        rho2 = (a - r) ** 2 + 4 * a * r * half_sine**2
        for field_end, up in ((one.lower, -1.0), (one.upper, 1.0)):
            for source_end, down in ((other.lower, 1.0), (other.upper, -1.0)):
                zeta = field_end - source_end
                if zeta == 0:
                    zeta = zeta + 1e-200  # on a common plane nothing but the constant part is left
                total = total + outwards * up * down * _twice_integrated(u, q, zeta, r * cosine, rho2) * cosine
    across = (total @ angle_weights) * r[:, 0]
    return MU_0 * one.current_density * other.current_density * half * np.sum(weights * across)


def _twice_integrated(u: Numbers, q: Numbers, zeta: Any, r_cosine: Numbers, rho2: Numbers) -> Numbers:
    """∫∫ dz dz' ∫ a da / R, as the module's docstring has it (m^4)."""
    big_r = np.sqrt(rho2 + zeta**2)
    along = zeta * np.arcsinh(zeta / np.sqrt(rho2)) - big_r
    across = np.arcsinh(u / np.sqrt(q**2 + zeta**2))
    turned = zeta * q * np.arctan(zeta * u / (q * big_r))
    straight = (rho2 * along + big_r**3 / 3) / 2
    result: Numbers = straight + r_cosine * (u * along + (u * big_r + (zeta**2 - q**2) * across) / 2 - turned)
    return result


def stored_energy(coils: Sequence[Coil], order: int = ORDER, nodes: int = NODES) -> Any:
    """1/2 ∫ J A dV (J) over all windings: half the sum of the mutual energies, each pair counted once."""
    total: Any = 0.0
    for i, one in enumerate(coils):
        total = total + mutual_energy(one, one, order, nodes) / 2
        for other in coils[i + 1 :]:
            # Over the thinner of the two: Gauss's rule has less to cover.
            thin, thick = sorted((one, other), key=lambda coil: float(np.real(coil.outer_radius - coil.inner_radius)))
            total = total + mutual_energy(thin, thick, order, nodes)
    return total
