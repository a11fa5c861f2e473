"""Derivatives by the nodes of sums over points of elements, for integrals over a part of the mesh."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.mesh import Floats, Ints, Mesh


def inverse_squared_radius(mesh: Mesh, elements: Ints, values: Floats) -> Floats:
    """(m, q) 1/r² (1/m²) at points of elements with shape functions ``values`` (q, 6)."""
    return np.asarray(1 / (2 * np.einsum("qn,mn->mq", values, mesh.nodes[mesh.elements[elements], 0], optimize=True)))


def node_derivative(
    mesh: Mesh,
    elements: Ints,
    rows: Floats,
    weight: Floats,
    values: Floats,
    pairs: tuple[tuple[Floats, Floats], ...],
    density: Floats | None = None,
) -> Floats:
    """(n, 2) derivative by the nodes, in the chart, of Σ weight · f over points of elements; see `fem.adjoint`.

    rows : (m, 2 q, 6) the kernel's at these points. values : (q, 6) shape functions there. weight : (m, q).
    pairs : for each field the derivative of f by its rows and those rows, each (m, q, 2).
    density : f (m, q) where the sum is an integral, so that points carry their area with them; None where it is not.
    """
    metric = inverse_squared_radius(mesh, elements, values)
    radius = 1 / np.sqrt(metric)
    m, q = weight.shape
    # Row 1 is 1/r ∂_z: derivatives by ∂_z v carry 1/r, and ∂_z v is the row times r.
    factors = np.zeros((m, q, 2, 2))
    explicit = np.zeros((m, q))
    for by, field in pairs:
        factors[..., 0] -= by * field[:, :, :1]
        factors[..., 1] -= by * field[:, :, 1:] * radius[..., None]
        explicit -= metric * by[:, :, 1] * field[:, :, 1]
    if density is not None:
        factors[:, :, 0, 0] += density
        factors[:, :, 1, 1] += density * radius
    factors *= weight[..., None, None]
    nodal = rows.transpose(0, 2, 1) @ factors.reshape(m, 2 * q, 2)
    nodal[..., 0] += (weight * explicit) @ values
    places = mesh.elements[elements].ravel()
    count = mesh.nodes.shape[0]
    return np.stack([np.bincount(places, nodal[..., i].ravel(), count) for i in range(2)], axis=-1)
