"""The field recovered at the nodes of a mesh of triangles, for tests that know it there."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.element import kernel
from fluxbore.fem.field import CORNERS_AND_MIDDLES
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats, Ints


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
