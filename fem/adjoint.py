"""Exact derivatives of a mapped mesh's discrete equations: what adjoint gradients are made of.

A figure Q(ψ, X) of the solution of R(ψ, X) = 0 changes with the mesh lines X, at fixed topology, by

    dQ/dX = ∂Q/∂X − μᵀ ∂R/∂X ,     K_T μ = ∂Q/∂ψ ,

with Newton's tangent K_T, which is symmetric (Céa 1986; for machines Gangl et al. 2015, SIAM J. Sci. Comput. 37). An
incremental figure Q = xᵀ K_T(ψ) y also needs the tangent's own derivatives by X and by ψ, and those by ψ are what asks
for a C2 magnetisation curve.

All terms are integrals of a density f of the fields' derivatives in the chart. Nodes that move by V take the elements'
quadrature points with them, and the derivative of ∇v at such a point is −(∇V)ᵀ∇v, so that

    δ ∫ f = ∫ f div V − Σ_v ∂f/∂(∂_j v) ∂_i v ∂_j V_i + ∂f/∂s V_s ,

which by the element's own quadrature is exact to rounding. The nodes of a mapped mesh move with its lines: between two
lines V_s is linear in s, and V_z in z. Of ∂_j V_i only ∂_s V_s and ∂_z V_z are left, one number each for a cell.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, shape
from fluxbore.fem.magnetostatics import Solution, coercive_field
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats

_SHAPE = shape(QUADRATURE_POINTS)


@dataclass(frozen=True, slots=True, eq=False)
class Derivative:
    """Derivatives of k scalars. s, z : (lines, k) by the mesh lines' s (1/m²) and z (1/m).

    reluctivity : (regions, k) by that of each linear region. coercivity : (regions, k) by H_c along z.
    """

    s: Floats
    z: Floats
    reluctivity: Floats
    coercivity: Floats


class Linearisation:
    """A solution on a mapped mesh with its field and material at every quadrature point, ready to be differentiated.

    Materials are linear, of one reluctivity and magnetised along z, or have a curve.
    """

    def __init__(self, solution: Solution, grid: MappedMesh) -> None:
        problem, kernel = solution.problem, solution.system.kernel
        mesh = problem.mesh
        self._solution, self._grid, self._elements = solution, grid, mesh.elements
        self._weight = kernel.weight
        m, q = kernel.weight.shape
        self._rows = kernel.curl.reshape(m, 2 * q, 6)
        s = np.einsum("qn,mn->mq", _SHAPE, mesh.nodes[mesh.elements, 0], optimize=True)
        self._metric = 1 / (2 * s)
        start, self._width = grid.r_nodes[:-2:2], np.diff(grid.r_nodes[::2])
        column = np.arange(m) // 2 % self._width.size
        self._share = (s - start[column][:, None]) / self._width[column][:, None]
        self._b = self._fields(solution.psi[:, None])[..., 0]
        self._materials()

    def _materials(self) -> None:
        """ν (m, q), and of the iron's elements dν/d|B|² and d²ν/d(|B|²)² (i, q); the magnets' elements by region."""
        system, mesh = self._solution.system, self._solution.problem.mesh
        squared = np.einsum("mqk,mqk->mq", self._b, self._b)
        self._iron = system.iron_elements
        self._nu = np.empty(squared.shape)
        shape = (self._iron.size, squared.shape[1])
        self._slope, self._curvature = np.empty(shape), np.empty(shape)
        parts = dict(system.iron)
        self._magnets = []
        for index, material in enumerate(self._solution.problem.materials):
            assert material.stack is None
            assert material.grade is None
            chosen = np.flatnonzero(mesh.region == index)
            if material.curve is not None:
                at = squared[chosen]
                self._nu[chosen], self._slope[parts[index]] = material.curve.reluctivity(at)
                self._curvature[parts[index]] = material.curve.curvature(at)
                continue
            assert material.components[0] == material.components[1]
            self._nu[chosen] = material.components[0]
            if material.coercivity != (0.0, 0.0):
                h_c = coercive_field(mesh, material, chosen)
                assert not h_c[..., 1].any()
                self._magnets.append((index, chosen, h_c[..., 0]))

    def _fields(self, values: Floats) -> Floats:
        """(m, q, 2, k) what is B of ψ, of k nodal fields (n, k), in the kernel's frame."""
        found = self._rows @ values[self._elements]
        return found.reshape(found.shape[0], -1, 2, values.shape[1])

    def residual(self, adjoints: Floats) -> Derivative:
        """Of μᵀR for k adjoint fields μ (n, k), circuits and edges left out.

        The density is (ν B − H_c)·B(μ), whose derivative by B(ψ) is the tangent's ν B(μ) + 2 ν' (B·B(μ)) B. It is
        linear in μ, so that all that costs anything is done once for any number of adjoints.
        """
        b, iron = self._b, self._iron
        flux = self._nu[..., None] * b
        stretch_s, stretch_z, lever = flux * (-1.0, 1.0), flux * (1.0, -1.0), flux * (0.0, -2.0)
        bent = 2 * self._slope[..., None] * b[iron]
        stretch_s[iron] -= bent * b[iron][..., :1] ** 2
        stretch_z[iron] -= bent * b[iron][..., 1:] ** 2
        lever[iron] -= bent * b[iron][..., 1:] ** 2
        for _, chosen, h_c in self._magnets:
            stretch_z[chosen, :, 0] -= h_c
        lever *= self._metric[..., None]
        factors = np.stack((stretch_s, stretch_z, lever, self._share[..., None] * lever), axis=1)
        factors *= self._weight[:, None, :, None]
        m = b.shape[0]
        of_cells = (factors.reshape(m, 4, -1) @ self._rows) @ adjoints[self._elements]
        regions = len(self._solution.problem.materials)
        reluctivity, coercivity = np.zeros((2, regions, adjoints.shape[1]))
        for index, chosen, _ in self._magnets:
            weight = self._weight[chosen]
            sums = np.stack((weight[..., None] * b[chosen], weight[..., None] * np.array([-1.0, 0.0])), axis=1)
            pulls = sums.reshape(chosen.size, 2, -1) @ self._rows[chosen]
            reluctivity[index], coercivity[index] = np.einsum(
                "ean,enk->ak", pulls, adjoints[self._elements[chosen]], optimize=True
            )
        return Derivative(*self._by_lines(of_cells), reluctivity, coercivity)

    def tangent(self, x: Floats, y: Floats) -> tuple[Derivative, Floats]:
        """Of xᵀ K_T y for two nodal fields (n,): as ever, and (n,) by the nodal ψ.

        The density is ν u·v + 2 ν' (B·u)(B·v) with u, v the fields of x and y.
        """
        fields = self._fields(np.column_stack((x, y)))
        u, v, b, iron = fields[..., 0], fields[..., 1], self._b, self._iron
        products = u * v
        along, across = (self._nu * products[..., k] for k in (0, 1))
        density = along + across
        along, across = 2 * along, 2 * across
        slope, bi, ui, vi = self._slope, b[iron], u[iron], v[iron]
        bu, bv = np.einsum("mqk,mqk->mq", bi, ui), np.einsum("mqk,mqk->mq", bi, vi)
        uv = products[iron].sum(axis=-1)
        by_b = (2 * slope * uv + 4 * self._curvature * bu * bv)[..., None] * bi
        by_b += 2 * slope[..., None] * (ui * bv[..., None] + vi * bu[..., None])
        turned = by_b * bi + 2 * slope[..., None] * bi * (ui * bv[..., None] + vi * bu[..., None])
        density[iron] += 2 * slope * bu * bv
        along[iron] += turned[..., 0]
        across[iron] += turned[..., 1]
        lever = -self._metric * across
        factors = np.stack((density - along, density - across, lever, self._share * lever), axis=1)
        of_cells = np.einsum("mfq,mq->mf", factors, self._weight)[..., None]
        pull = (by_b * self._weight[iron][..., None]).reshape(iron.size, 1, -1) @ self._rows[iron]
        by_psi = np.bincount(self._elements[iron].ravel(), pull.ravel(), self._solution.psi.size).astype(float)
        regions = len(self._solution.problem.materials)
        reluctivity = np.zeros((regions, 1))
        for index, chosen, _ in self._magnets:
            reluctivity[index] = np.sum(self._weight[chosen][..., None] * products[chosen])
        return Derivative(*self._by_lines(of_cells), reluctivity, np.zeros((regions, 1))), by_psi

    def _by_lines(self, of_cells: Floats) -> tuple[Floats, Floats]:
        """(lines, k) twice, from each element's (m, 4, k): ∫ (f − ..)∂_s, ∫ (f − ..)∂_z, ∫ ∂f/∂s, ∫ share · ∂f/∂s."""
        grid, k = self._grid, of_cells.shape[-1]
        cells = of_cells.reshape(grid.z_lines.size - 1, grid.r_lines.size - 1, 2, 4, k).sum(axis=2)
        columns = cells.sum(axis=0)
        s, z = np.zeros((grid.r_lines.size, k)), np.zeros((grid.z_lines.size, k))
        stretch = columns[:, 0] / self._width[:, None]
        s[1:] += stretch + columns[:, 3]
        s[:-1] -= stretch - columns[:, 2] + columns[:, 3]
        rise = cells[:, :, 1].sum(axis=1) / np.diff(grid.z_lines)[:, None]
        z[1:] += rise
        z[:-1] -= rise
        return s, z
