"""Axial force by the stress tensor, in its domain form over a cylinder shell of air."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, shape
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.moved_points import node_derivative
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY


def axial_force_gradient(solution: Solution, annulus: tuple[float, float], field: Floats | None = None) -> Floats:
    """g (n,) with  F = ½ g·ψ  and  ∂F/∂ψ = g, for the axial force F (N) on everything inside the annulus.

    annulus : (r from, r to) in m, mesh lines, with nothing but air (μ0) between them over the domain's whole length.
    field : (n,) in place of ψ, on which g depends linearly: F is ½ ψᵀ G ψ, and g is G times the field.

    The weight falls linearly in s = r²/2 from one at the inner to zero at the outer radius, so that
    F = −(2π/μ0) ∫∫ ∂ψ/∂z ∂ψ/∂s ds dz / (s_o − s_i): Maxwell's stress averaged over the shell (Arkkio 1987), and at the
    same time the exact derivative of the discrete energy when the mesh inside is shifted (Coulomb 1983).
    """
    mesh = solution.problem.mesh
    shell = _shell(solution, annulus)
    curl = solution.system.kernel.curl[shell]
    values = (solution.psi if field is None else field)[mesh.elements[shell]]
    rows = np.einsum("mqkn,mn->mqk", curl, values, optimize=True)
    # Row 1 of the kernel is ψ_z/√(2s): take the radius out again.
    factor = _scale(annulus) * solution.system.kernel.weight[shell] * _radius(solution, shell)
    gradient = np.einsum(
        "mqn,mq->mn", curl[:, :, 0] * rows[:, :, 1, None] + curl[:, :, 1] * rows[:, :, 0, None], factor, optimize=True
    )
    return np.asarray(np.bincount(mesh.elements[shell].ravel(), gradient.ravel(), mesh.nodes.shape[0]))


def stress_derivative(
    solution: Solution, annulus: tuple[float, float], x: Floats
) -> tuple[Floats, tuple[float, float]]:
    """Derivative of xᵀ G ψ (see `axial_force_gradient`) by the nodes (n, 2) and by s = r²/2 at the annulus's radii."""
    mesh = solution.problem.mesh
    shell = _shell(solution, annulus)
    kernel = solution.system.kernel
    m, q = shell.size, QUADRATURE_POINTS.shape[0]
    rows = kernel.curl[shell].reshape(m, 2 * q, 6)
    here, there = ((rows @ field[mesh.elements[shell]][..., None]).reshape(m, q, 2) for field in (solution.psi, x))
    scale = _scale(annulus) * _radius(solution, shell)
    density = scale * (here[..., 0] * there[..., 1] + here[..., 1] * there[..., 0])
    pairs = tuple((scale[..., None] * one[..., ::-1], other) for one, other in ((here, there), (there, here)))
    weight = kernel.weight[shell]
    nodes = node_derivative(mesh, shell, rows, weight, shape(QUADRATURE_POINTS), pairs, density, by_rows=False)
    s_inner, s_outer = annulus[0] ** 2 / 2, annulus[1] ** 2 / 2
    value = float(np.sum(weight * density))
    return nodes, (value / (s_outer - s_inner), -value / (s_outer - s_inner))


def _shell(solution: Solution, annulus: tuple[float, float]) -> Ints:
    """The elements within the annulus."""
    mesh = solution.problem.mesh
    s_inner, s_outer = annulus[0] ** 2 / 2, annulus[1] ** 2 / 2
    corners = mesh.nodes[mesh.elements[:, :3], 0]
    slack = 1e-9 * s_outer
    return np.flatnonzero(np.all((corners > s_inner - slack) & (corners < s_outer + slack), axis=1))


def _radius(solution: Solution, elements: Ints) -> Floats:
    """(m, q) r (m) at the quadrature points."""
    mesh = solution.problem.mesh
    s = np.einsum("qn,mn->mq", shape(QUADRATURE_POINTS), mesh.nodes[mesh.elements[elements], 0], optimize=True)
    return np.asarray(np.sqrt(2 * s))


def _scale(annulus: tuple[float, float]) -> float:
    return -2 * np.pi * VACUUM_RELUCTIVITY / (annulus[1] ** 2 / 2 - annulus[0] ** 2 / 2)


def axial_force(solution: Solution, annulus: tuple[float, float]) -> float:
    """Axial force (N) on everything inside the annulus; see `axial_force_gradient`."""
    return float(axial_force_gradient(solution, annulus) @ solution.psi / 2)


def thrust_response(solution: Solution, annulus: tuple[float, float]) -> Floats:
    """(n,) y with K_T y = ∂F/∂ψ at the solution's state: one back-substitution serves all circuits' constants."""
    found = np.zeros(solution.psi.size)
    inner = solution.system.inner
    found[inner] = solution.tangent.solve(solution.system.topology.gather(axial_force_gradient(solution, annulus)))
    return found


def incremental_thrust(solution: Solution, annulus: tuple[float, float], response: Floats | None = None) -> Floats:
    """(k,) change of the axial force per ampere in each of the problem's circuits (N/A), at the solution's state.

    With K y = ∂F/∂ψ, each circuit's constant is y · (its load per ampere). response : y, where it is known.
    """
    y = thrust_response(solution, annulus) if response is None else response
    return np.array([y @ circuit.density for circuit in solution.problem.circuits])
