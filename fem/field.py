"""What a picture of a field is made of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.fem.mesh import Floats, Ints

CORNERS_AND_MIDDLES = np.array(
    [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.5, 0.5, 0], [0, 0.5, 0.5], [0.5, 0, 0.5]], dtype=float
)
"""(6, 3) barycentric coordinates of an element's six nodes."""


@dataclass(frozen=True, slots=True, eq=False)
class FluxMap:
    """A field on linear triangles, for drawing.

    r, z : (n,) m. triangles : (m, 3). flux : (n,) ψ (Wb/rad); its contours are field lines.
    flux_density : (m,) |B| (T). region : (m,) index of each triangle's region. components : (m, 2) B_r, B_z (T).
    """

    r: Floats
    z: Floats
    triangles: Ints
    flux: Floats
    flux_density: Floats
    region: Ints
    components: Floats
