"""The exterior of a circle, brought inside another circle by inversion (Kelvin's transformation).

A point at distance R from the second circle's centre stands for one at distance R_i R_o/R from the first one's. The
inversion is conformal and ψ is a flux, so a planar field needs nothing but the tie between the two rims. In an
axisymmetric one the radius r in ν/r is replaced by its image, r R_i R_o/R², so the reluctivity is multiplied by
R²/(R_i R_o) (Freeman and Lowther 1989, IEEE Trans. Magn. 25, 4135). Exact: the whole of space is meshed.
"""

from __future__ import annotations

from dataclasses import dataclass

from fluxbore.fem.mesh import Floats


@dataclass(frozen=True, slots=True)
class KelvinExterior:
    """centre : z (m) of the exterior's ball on the axis. inner : R_i, the inside's radius (m). outer : R_o."""

    centre: float
    inner: float
    outer: float

    def factor(self, positions: Floats) -> Floats:
        """(...) on the reluctivity at positions (..., 2) = (r, z) in m."""
        squared = positions[..., 0] ** 2 + (positions[..., 1] - self.centre) ** 2
        return squared / (self.inner * self.outer)
