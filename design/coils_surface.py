"""Where on its skin a winding sees the largest flux density.

A superconductor quenches first where the field is largest, and that is on the skin: inside, the field falls from it
towards the winding's middle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluxbore.design.coils import Coil
from fluxbore.design.coils_field import Numbers, flux_density

SAMPLES = 17
"""On each of the four sides, corners included; an odd number has the middle among them."""

REFINEMENTS = 7
"""Each cuts the stretch around the largest sample to a quarter: to 1e-5 of a side, and the largest value to 1e-10."""


@dataclass(frozen=True, slots=True)
class Spot:
    """A place on a winding's skin that moves along with it.

    side : 0 inside, 1 outside, 2 below, 3 above. share : of the side's length, 0 to 1.
    """

    side: int
    share: float


def place(coil: Coil, side: int, share: Any) -> tuple[Any, Any]:
    """r and z (m) of a spot; complex where the coil is."""
    if side < 2:
        r = coil.inner_radius if side == 0 else coil.outer_radius
        return r + 0 * share, coil.lower + share * (coil.upper - coil.lower)
    z = coil.lower if side == 2 else coil.upper
    return coil.inner_radius + share * (coil.outer_radius - coil.inner_radius), z + 0 * share


def magnitude(coils: Sequence[Coil], r: Any, z: Any) -> Numbers:
    """|B| (T) of all coils at places r, z (m)."""
    found: Numbers = np.sqrt(sum_of_squares(coils, r, z))
    return found


def sum_of_squares(coils: Sequence[Coil], r: Any, z: Any) -> Numbers:
    """B_r^2 + B_z^2 (T^2) of all coils; differentiable where the field vanishes, as its root is not."""
    fields = [flux_density(coil, r, z) for coil in coils]
    radial: Numbers = np.sum([field[0] for field in fields], axis=0)
    axial: Numbers = np.sum([field[1] for field in fields], axis=0)
    squares: Numbers = radial**2 + axial**2
    return squares


def hottest(coils: Sequence[Coil], index: int) -> Spot:
    """Where on the skin of ``coils[index]`` |B| is largest; of several equal places the first."""
    coil = coils[index]
    shares = np.linspace(0.0, 1.0, SAMPLES)
    best = max(range(4), key=lambda side: float(_on(coils, coil, side, shares).max()))
    centre, reach = float(shares[_on(coils, coil, best, shares).argmax()]), 1.0 / (SAMPLES - 1)
    for _ in range(REFINEMENTS):
        near = np.clip(centre + reach * np.linspace(-1.0, 1.0, 9), 0.0, 1.0)
        centre, reach = float(near[_on(coils, coil, best, near).argmax()]), reach / 4
    return Spot(best, centre)


def _on(coils: Sequence[Coil], coil: Coil, side: int, shares: NDArray[np.float64]) -> NDArray[np.float64]:
    r, z = place(coil, side, shares)
    found: NDArray[np.float64] = sum_of_squares(coils, r, z)
    return found
