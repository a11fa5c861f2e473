"""The field lines of a helical field: its flux function, and the field as a map for pictures.

The field depends on r and ζ = z − h θ alone, so that div B = 0 reads ∂(r B_r)/∂r + ∂(r B_z − h B_θ)/∂ζ = 0, and

    r B_r = −∂ψ/∂ζ ,   r B_z − h B_θ = ∂ψ/∂r

has a solution ψ. A field line keeps its ψ, and 2πΔψ is the flux between two helical surfaces all the way round: the
level lines of ψ are the field lines, seen along the helix. At h = 0 it is ψ = r A_φ of rings.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fluxbore.fem.element import kernel, positions, stiffness
from fluxbore.fem.factors import Factor
from fluxbore.fem.field import CORNERS_AND_MIDDLES, FluxMap
from fluxbore.fem.helical import HelicalSolution
from fluxbore.fem.linear import factorise
from fluxbore.fem.mesh import Floats, Topology

FOUR = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])
"""A quadratic triangle as four linear ones, by its nodes."""


def flux_function(solution: HelicalSolution) -> Floats:
    """(n,) ψ (Wb/rad) at the nodes: the least squares of both equations over the mesh, by quadratic elements.

    Its mean over a period is zero where the mesh is half a period, else it is zero at one node.
    """
    topology, factor = flux_equations(solution)
    mesh, b = solution.system.mesh, solution.flux_density()
    found, r = kernel(mesh), positions(mesh)[..., 0]
    slopes = np.stack((r * b[..., 2] - solution.section.transfer_ratio * b[..., 1], -r * b[..., 0]), axis=-1)
    pull = np.einsum("mqkn,mqk,mq->mn", found.curl, slopes, found.weight, optimize=True)
    nodal = np.bincount(mesh.elements.ravel(), pull.ravel(), topology.freedom.size)
    return topology.spread(factor.solve(topology.gather(np.asarray(nodal, dtype=float))))


def flux_equations(solution: HelicalSolution) -> tuple[Topology, Factor]:
    """The unknowns of ψ and the matrix of its least squares, factorised."""
    topology, found = _free(solution.system.topology), kernel(solution.system.mesh)
    values = topology.pattern.assemble(stiffness(found.curl, found.weight))
    return topology, factorise(topology.pattern, values, "superlu")


def flux_map(solution: HelicalSolution, start: float, end: float) -> FluxMap:
    """The field from ζ = `start` to `end` (m), and a little beyond: |B| of all three components at the small triangles'
    middles, its `z` being ζ."""
    system = solution.system
    mesh, psi = system.mesh, flux_function(solution)
    density, components = _density(solution, psi)
    length = solution.section.period / system.grid.copies
    low, high = float(mesh.nodes[:, 1].min()), float(mesh.nodes[:, 1].max())
    # The mesh is sheared between the members, so that its ends overlap: whole copies cover the window.
    copies = range(int(np.floor((start - high) / length)) + 1, int(np.ceil((end - low) / length)))
    count, triangles = mesh.nodes.shape[0], mesh.elements[:, FOUR].reshape(-1, 3)
    sign = -1.0 if system.grid.copies == 2 else 1.0
    return FluxMap(
        np.tile(mesh.nodes[:, 0], len(copies)),
        np.concatenate([mesh.nodes[:, 1] + i * length for i in copies]),
        np.concatenate([triangles + k * count for k in range(len(copies))]),
        np.concatenate([psi * sign**i for i in copies]),
        np.tile(density, len(copies)),
        np.tile(np.repeat(mesh.region, 4), len(copies)),
        np.concatenate([components * sign**i for i in copies]),
    )


def _density(solution: HelicalSolution, psi: Floats) -> tuple[Floats, Floats]:
    """(4 m,) |B| and (4 m, 2) B_r, B_z (T) at the middles of the small triangles.

    B_θ = −(h/r) B_z wherever remanence is radial, so that |B|² = [(∂ψ/∂ζ)² + (∂ψ/∂r)²/(1 + h²/r²)]/r².
    """
    mesh, middles = solution.system.mesh, CORNERS_AND_MIDDLES[FOUR].mean(axis=1)
    slopes = np.einsum("mqkn,mn->mqk", kernel(mesh, None, middles).curl, psi[mesh.elements], optimize=True)
    r = positions(mesh, None, middles)[..., 0]
    along = 1 + (solution.section.transfer_ratio / r) ** 2
    density = np.sqrt(slopes[..., 1] ** 2 + slopes[..., 0] ** 2 / along) / r
    components = np.stack((-slopes[..., 1] / r, slopes[..., 0] / (r * along)), axis=-1)
    return np.asarray(density).ravel(), np.asarray(components).reshape(-1, 2)


def _free(topology: Topology) -> Topology:
    """The same ties, with an unknown wherever the potential is prescribed.

    Unless the field changes its sign after half a period ψ is known up to a number, and is zero at one node.
    """
    mates = topology.mates
    stands = np.flatnonzero(mates == np.arange(mates.size))
    number = np.full(mates.size, -1)
    kept = stands if topology.sign is not None else stands[1:]
    number[kept] = np.arange(kept.size)
    return replace(topology, freedom=number[mates])
