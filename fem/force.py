"""Axial force by the stress tensor, in its domain form over a cylinder shell of air."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, shape
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY


def axial_force_gradient(solution: Solution, annulus: tuple[float, float]) -> Floats:
    """g (n,) with  F = ½ g·ψ  and  ∂F/∂ψ = g, for the axial force F (N) on everything inside the annulus.

    annulus : (r from, r to) in m, mesh lines, with nothing but air (μ0) between them over the domain's whole length.

    The weight falls linearly in s = r²/2 from one at the inner to zero at the outer radius, so that
    F = −(2π/μ0) ∫∫ ∂ψ/∂z ∂ψ/∂s ds dz / (s_o − s_i): Maxwell's stress averaged over the shell (Arkkio 1987), and at the
    same time the exact derivative of the discrete energy when the mesh inside is shifted (Coulomb 1983).
    """
    mesh = solution.problem.mesh
    s_inner, s_outer = annulus[0] ** 2 / 2, annulus[1] ** 2 / 2
    corners = mesh.nodes[mesh.elements[:, :3], 0]
    slack = 1e-9 * s_outer
    shell = np.flatnonzero(np.all((corners > s_inner - slack) & (corners < s_outer + slack), axis=1))
    kernel = solution.system.kernel
    curl = kernel.curl[shell]
    psi = solution.psi[mesh.elements[shell]]
    field = np.einsum("mqkn,mn->mqk", curl, psi, optimize=True)
    s = np.einsum("qn,mn->mq", shape(QUADRATURE_POINTS), mesh.nodes[mesh.elements[shell], 0], optimize=True)
    # Row 1 of the kernel is ψ_z/√(2s): take the radius out again.
    factor = -2 * np.pi * VACUUM_RELUCTIVITY / (s_outer - s_inner) * kernel.weight[shell] * np.sqrt(2 * s)
    gradient = np.einsum(
        "mqn,mq->mn", curl[:, :, 0] * field[:, :, 1, None] + curl[:, :, 1] * field[:, :, 0, None], factor, optimize=True
    )
    return np.asarray(np.bincount(mesh.elements[shell].ravel(), gradient.ravel(), mesh.nodes.shape[0]))


def axial_force(solution: Solution, annulus: tuple[float, float]) -> float:
    """Axial force (N) on everything inside the annulus; see `axial_force_gradient`."""
    return float(axial_force_gradient(solution, annulus) @ solution.psi / 2)


def incremental_thrust(solution: Solution, annulus: tuple[float, float]) -> Floats:
    """(k,) change of the axial force per ampere in each of the problem's circuits (N/A), at the solution's state.

    One back-substitution serves all circuits: with K y = ∂F/∂ψ, each circuit's constant is y · (its load per ampere).
    """
    gather = solution.system.topology.gather
    y = solution.tangent.solve(gather(axial_force_gradient(solution, annulus)))
    return np.array([y @ gather(circuit.density) for circuit in solution.problem.circuits])
