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

from fluxbore.fem.cells import Cells
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats, Ints


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

    def __init__(self, solution: Solution, cells: Cells) -> None:
        self._solution = solution
        self.cells = cells
        self._b = self.cells.fields(solution.psi)
        self._materials()

    def _materials(self) -> None:
        """ν times weight (m, points), and of the iron's cells dν/d|B|² and d²ν/d(|B|²)² (i, points); the magnets'
        cells by region."""
        cells, materials = self.cells, self._solution.problem.materials
        reluctivity = np.array([material.components[0] for material in materials])
        self._weighted = cells.weight * reluctivity[cells.region][:, None]
        points = cells.square.points
        parts, slopes, curvatures = [np.zeros(0, dtype=int)], [np.zeros((0, points))], [np.zeros((0, points))]
        self._magnets: list[tuple[int, Ints, float]] = []
        for index, material in enumerate(materials):
            assert material.stack is None
            assert material.grade is None
            assert not callable(material.coercivity)
            if material.curve is not None:
                chosen = np.flatnonzero(cells.region == index)
                squared = self._b[0][chosen] ** 2 + self._b[1][chosen] ** 2
                nu, slope = material.curve.reluctivity(squared)
                self._weighted[chosen] = nu * cells.weight[chosen]
                parts.append(chosen)
                slopes.append(slope)
                curvatures.append(material.curve.curvature(squared))
                continue
            assert material.components[0] == material.components[1]
            assert material.coercivity[0] == 0
            if material.coercivity[1]:
                self._magnets.append((index, np.flatnonzero(cells.region == index), material.coercivity[1]))
        self._iron = np.concatenate(parts)
        self._slope, self._curvature = np.concatenate(slopes), np.concatenate(curvatures)

    def residual(self, adjoints: Floats) -> Derivative:
        """Of μᵀR for k adjoint fields μ (n, k), circuits and edges left out.

        The density is (ν B − H_c)·B(μ), whose derivative by B(ψ) is the tangent's ν B(μ) + 2 ν' (B·B(μ)) B. It is
        linear in μ, so that all that costs anything is done once for any number of adjoints.
        """
        cells = self.cells
        across, along = (self._weighted * b for b in self._b)
        lever = -2 * cells.metric * along
        pull_across, pull_along = cells.pull_across(across), cells.pull_along(along)
        by_s = cells.start_and_end(
            pull_along - pull_across, cells.pull_along(lever), cells.pull_along(lever * cells.share)
        )
        by_z = pull_across - pull_along
        for _, chosen, h_c in self._magnets:
            by_z[chosen] -= cells.pull_across(h_c * cells.weight[chosen], chosen)
        self._add_bent(by_s, by_z)
        s, z = cells.on_lines_of(by_s, by_z, adjoints)
        return Derivative(s, z, *self._by_magnets(adjoints))

    def _add_bent(self, by_s: Floats, by_z: Floats) -> None:
        """The iron's 2 ν' (B·B(μ)) B: of B·B a stretch in s takes B_z² away, one in z B_r², which has 1/r² too."""
        cells, iron = self.cells, self._iron
        b = [field[iron] for field in self._b]
        bent = -2 * self._slope * cells.weight[iron]
        for own, pull in zip(b, (cells.pull_across, cells.pull_along), strict=True):
            stretch_s, stretch_z = bent * own * b[0] ** 2, bent * own * b[1] ** 2
            lever = cells.metric[iron] * stretch_z
            by_s[:, iron] += cells.start_and_end(
                pull(stretch_s, iron), pull(lever, iron), pull(lever * cells.share, iron), iron
            )
            by_z[iron] += pull(stretch_z, iron)

    def _by_magnets(self, adjoints: Floats) -> tuple[Floats, Floats]:
        """(regions, k) twice: of μᵀR by the magnets' reluctivity and coercivity."""
        cells = self.cells
        found = np.zeros((2, len(self._solution.problem.materials), adjoints.shape[1]))
        for index, chosen, _ in self._magnets:
            weight = cells.weight[chosen]
            across, along = (weight * b[chosen] for b in self._b)
            values = adjoints[cells.nodes[chosen]].reshape(chosen.size * cells.square.nodes, -1)
            of_field = cells.pull_across(across, chosen) + cells.pull_along(along, chosen)
            found[:, index] = of_field.ravel() @ values, -cells.pull_across(weight, chosen).ravel() @ values
        return found[0], found[1]

    def tangent(self, x: Floats, y: Floats) -> tuple[Derivative, Floats]:
        """Of xᵀ K_T y for two nodal fields (n,): as ever, and (n,) by the nodal ψ.

        The density is ν u·v + 2 ν' (B·u)(B·v) with u, v the fields of x and y.
        """
        cells, iron, slope = self.cells, self._iron, self._slope
        u = cells.fields(x)
        v = u if x is y else cells.fields(y)
        products = [a * b for a, b in zip(u, v, strict=True)]
        across = np.einsum("mq,mq->m", self._weighted, products[0])
        turned = self._weighted * products[1]
        along = turned.sum(axis=1)
        turned *= -2 * cells.metric
        stretch_s, stretch_z = along - across, across - along
        lever, share = turned.sum(axis=1), turned @ cells.share

        bi, ui, vi = ([field[iron] for field in pair] for pair in (self._b, u, v))
        weight = cells.weight[iron]
        bu, bv = (bi[0] * w[0] + bi[1] * w[1] for w in (ui, vi))
        even = 2 * slope * (products[0][iron] + products[1][iron]) + 4 * self._curvature * bu * bv
        mixed = [2 * slope * (ui[k] * bv + vi[k] * bu) for k in range(2)]
        by_b = [weight * (even * bi[k] + mixed[k]) for k in range(2)]
        bent = 2 * slope * bu * bv * weight
        lost = [(by_b[k] + weight * mixed[k]) * bi[k] for k in range(2)]
        stretch_s[iron] += (bent - lost[0]).sum(axis=1)
        stretch_z[iron] += (bent - lost[1]).sum(axis=1)
        turned = -cells.metric[iron] * lost[1]
        lever[iron] += turned.sum(axis=1)
        share[iron] += turned @ cells.share

        s, z = cells.on_lines(cells.start_and_end(stretch_s, lever, share), stretch_z)
        pull = cells.pull_across(by_b[0], iron) + cells.pull_along(by_b[1], iron)
        by_psi = np.bincount(cells.nodes[iron].ravel(), pull.ravel(), self._solution.psi.size).astype(float)
        regions = len(self._solution.problem.materials)
        reluctivity = np.zeros((regions, 1))
        for index, chosen, _ in self._magnets:
            reluctivity[index] = np.sum(cells.weight[chosen] * (products[0][chosen] + products[1][chosen]))
        return Derivative(s[:, None], z[:, None], reluctivity, np.zeros((regions, 1))), by_psi
