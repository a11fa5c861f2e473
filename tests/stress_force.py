"""Axial force by the stress tensor on any mesh of triangles, in its domain form over a cylinder shell of air."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, shape
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY


class ForceShell:
    """The annulus of air in which the force F = ½ ψᵀ G ψ on everything inside it is measured.

    annulus : (r from, r to) in m, mesh lines, with nothing but air (μ0) between them over the domain's whole length.

    The weight falls linearly in s = r²/2 from one at the inner to zero at the outer radius, so that
    F = −(2π/μ0) ∫∫ ∂ψ/∂z ∂ψ/∂s ds dz / (s_o − s_i): Maxwell's stress averaged over the shell (Arkkio 1987), and at the
    same time the exact derivative of the discrete energy when the mesh inside is shifted (Coulomb 1983).
    """

    def __init__(self, solution: Solution, annulus: tuple[float, float]) -> None:
        mesh = solution.problem.mesh
        s_inner, s_outer = annulus[0] ** 2 / 2, annulus[1] ** 2 / 2
        corners = mesh.nodes[mesh.elements[:, :3], 0]
        slack = 1e-9 * s_outer
        shell = np.flatnonzero(np.all((corners > s_inner - slack) & (corners < s_outer + slack), axis=1))
        s = np.einsum("qn,mn->mq", shape(QUADRATURE_POINTS), mesh.nodes[mesh.elements[shell], 0], optimize=True)
        self._mesh, self._shell, self._width = mesh, shell, s_outer - s_inner
        self._nodes = mesh.elements[shell]
        found = solution.system.kernel_of(shell)
        self._rows, self._weight = found.curl.reshape(shell.size, -1, 6), found.weight
        # Row 1 of the kernel is ∂_z/√(2s): take the radius out again.
        self._scale = -2 * np.pi * VACUUM_RELUCTIVITY / self._width * np.sqrt(2 * s)

    def gradient(self, field: Floats) -> Floats:
        """(n,) G times a nodal field (n,): of ψ itself it is ∂F/∂ψ."""
        turned = self._fields(field)[..., ::-1] * (self._scale * self._weight)[..., None]
        share = (turned.reshape(self._shell.size, 1, -1) @ self._rows)[:, 0]
        return np.asarray(np.bincount(self._nodes.ravel(), share.ravel(), self._mesh.nodes.shape[0]))

    def _fields(self, field: Floats) -> Floats:
        """(m, q, 2) what is B of ψ, of a nodal field, in the kernel's frame."""
        return (self._rows @ field[self._nodes][..., None]).reshape(self._shell.size, -1, 2)


def axial_force_gradient(solution: Solution, annulus: tuple[float, float]) -> Floats:
    """g (n,) with  F = ½ g·ψ  and  ∂F/∂ψ = g, for the axial force F (N) on everything inside the annulus; see
    `ForceShell`."""
    return ForceShell(solution, annulus).gradient(solution.psi)


def axial_force(solution: Solution, annulus: tuple[float, float]) -> float:
    """Axial force (N) on everything inside the annulus; see `axial_force_gradient`."""
    return float(axial_force_gradient(solution, annulus) @ solution.psi / 2)
