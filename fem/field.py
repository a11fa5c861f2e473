"""The field where one asks for it: at the mesh's nodes, and what a picture of it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import kernel
from fluxbore.fem.magnetostatics import Solution
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


def nodal_flux_density(solution: Solution, elements: Ints) -> tuple[Ints, Floats]:
    """B recovered at the nodes of the given elements: (k,) node numbers and (k, 2) B in (r, z), tesla.

    The mean over the elements that meet at a node, of one material only: B jumps across an iron's face, so pass
    elements of one side. On the axis B_r is zero and B_z is the mean of ∂ψ/∂s, which the chart keeps at full order.
    """
    mesh = solution.problem.mesh
    curl = kernel(mesh, elements, CORNERS_AND_MIDDLES).curl
    nodes = mesh.elements[elements]
    field = np.einsum("mqkn,mn->mqk", curl, solution.psi[nodes], optimize=True)
    unique, place = np.unique(nodes, return_inverse=True)
    place = place.ravel()
    count = np.bincount(place)
    b_z = np.bincount(place, field[..., 0].ravel()) / count
    b_r = -np.bincount(place, field[..., 1].ravel()) / count
    return unique, np.column_stack((b_r, b_z))
