"""Exact derivatives of the discrete equations by their nodes, materials and field: what adjoint gradients are made of.

A figure Q(ψ, X) of the solution of R(ψ, X) = 0 changes with the nodes X, at fixed topology, by

    dQ/dX = ∂Q/∂X − μᵀ ∂R/∂X ,     K_T μ = ∂Q/∂ψ ,

with Newton's tangent K_T, which is symmetric (Céa 1986; for machines: Gangl et al. 2015, SIAM J. Sci. Comput. 37). An
incremental figure Q = xᵀ K_T(ψ) y also needs the tangent's own derivatives by X and by ψ, and those by ψ are what asks
for a C2 magnetisation curve.

All terms are integrals of a density f of the fields' derivatives in the chart. A node that moves by V takes the
elements' quadrature points with it, and the derivative of ∇v at such a point is −(∇V)ᵀ∇v, so that

    δ ∫ f = ∫ f div V − Σ_v ∂f/∂(∂_j v) ∂_i v ∂_j V_i + ∂f/∂s V_s ,

which, with V a sum of shape functions and the integral the element's own quadrature, is exact to rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, shape
from fluxbore.fem.magnetostatics import Solution, coercive_field
from fluxbore.fem.mesh import Floats, Ints, Mesh, Topology

_SHAPE = shape(QUADRATURE_POINTS)


@dataclass(frozen=True, slots=True, eq=False)
class Derivative:
    """Derivatives of k scalars. nodes : (n, 2, k) by the chart's coordinates of each node.

    reluctivity : (regions, k) by that of each linear region. coercivity : (regions, k) by H_c along z or y.
    """

    nodes: Floats
    reluctivity: Floats
    coercivity: Floats


class Linearisation:
    """A solution with its field and material at every quadrature point, ready to be differentiated.

    Materials may be linear and of one reluctivity, magnetised along z, or have a curve; sheets and graded exteriors,
    which no design has, are not differentiated.
    """

    def __init__(self, solution: Solution) -> None:
        problem, kernel = solution.problem, solution.system.kernel
        mesh = problem.mesh
        self.solution, self.elements, self.region = solution, mesh.elements, mesh.region
        self.weight = kernel.weight
        m, q = kernel.weight.shape
        self._rows = kernel.curl.reshape(m, 2 * q, 6)
        self._metric = inverse_squared_radius(solution.problem.mesh) if mesh.chart == "axisymmetric" else None
        self._root = np.ones((m, q)) if self._metric is None else np.sqrt(self._metric)
        self.b = self.fields(solution.psi[:, None])[..., 0]
        squared = np.einsum("mqk,mqk->mq", self.b, self.b)
        self.nu = np.empty((m, q))
        self.iron = solution.system.iron_elements
        self.slope, self.curvature = np.zeros((self.iron.size, q)), np.zeros((self.iron.size, q))
        self.h_c = np.zeros((m, q, 2))
        place = dict(solution.system.iron)
        for index, material in enumerate(problem.materials):
            assert material.stack is None
            assert material.grade is None
            chosen = np.flatnonzero(mesh.region == index)
            if material.curve is None:
                assert material.components[0] == material.components[1]
                self.nu[chosen] = material.components[0]
            else:
                part = place[index]
                self.nu[chosen], self.slope[part] = material.curve.reluctivity(squared[chosen])
                self.curvature[part] = material.curve.curvature(squared[chosen])
            if material.coercivity != (0.0, 0.0):
                self.h_c[chosen] = coercive_field(mesh, material, chosen)

    def fields(self, values: Floats, elements: Ints | slice = slice(None)) -> Floats:
        """(m, q, 2, k) what is B of ψ, of k nodal fields (n, k), in the kernel's frame."""
        rows = self._rows[elements]
        found = rows @ values[self.elements[elements]]
        return found.reshape(rows.shape[0], -1, 2, values.shape[1])

    def residual(self, adjoints: Floats) -> Derivative:
        """Of μᵀR for k adjoint fields μ (n, k), circuits left out.

        The density is (H + ... )·B(μ) with H = ν B − H_c, and its derivative by B is what the tangent does to B(μ).
        """
        other = self.fields(adjoints)
        strength = (self.nu[..., None] * self.b - self.h_c)[..., None]
        by_field = self.nu[..., None, None] * other
        inner = np.einsum("mqc,mqck->mqk", self.b, other, optimize=True)
        by_field[self.iron] += 2 * (self.slope[..., None] * inner[self.iron])[:, :, None] * self.b[self.iron][..., None]
        density = np.einsum("mqck,mqck->mqk", np.broadcast_to(strength, other.shape), other, optimize=True)
        nodes = self._moved(density, ((by_field, self.b[..., None]), (np.broadcast_to(strength, other.shape), other)))
        return Derivative(nodes, self._by_region(inner), self._by_region(-other[:, :, 0]))

    def tangent(self, x: Floats, y: Floats) -> tuple[Derivative, Floats]:
        """Of xᵀ K_T y for two nodal fields (n,): as ever, and (n,) by the nodal ψ."""
        fields = self.fields(np.column_stack((x, y)))
        u, v = fields[..., 0], fields[..., 1]
        iron, slope = self.iron, self.slope
        inner = np.einsum("mqc,mqc->mq", u, v)
        density = self.nu * inner
        by_u, by_v = self.nu[..., None] * v, self.nu[..., None] * u
        b, ui, vi = self.b[iron], u[iron], v[iron]
        bu, bv, uv = np.einsum("mqc,mqc->mq", b, ui), np.einsum("mqc,mqc->mq", b, vi), inner[iron]
        density[iron] += 2 * slope * bu * bv
        by_u[iron] += (2 * slope * bv)[..., None] * b
        by_v[iron] += (2 * slope * bu)[..., None] * b
        by_b = np.zeros_like(self.b)
        by_b[iron] = (2 * slope * uv + 4 * self.curvature * bu * bv)[..., None] * b + 2 * slope[..., None] * (
            ui * bv[..., None] + vi * bu[..., None]
        )
        pairs = tuple((d[..., None], w[..., None]) for d, w in ((by_u, u), (by_v, v), (by_b, self.b)))
        nodes = self._moved(density[..., None], pairs)
        pull = self._rows[iron].transpose(0, 2, 1) @ (by_b[iron] * self.weight[iron][..., None]).reshape(
            iron.size, -1, 1
        )
        by_psi = np.bincount(self.elements[iron].ravel(), pull.ravel(), self.solution.psi.size)
        return Derivative(nodes, self._by_region(inner[..., None]), np.zeros((self._regions, 1))), by_psi

    @property
    def _regions(self) -> int:
        return len(self.solution.problem.materials)

    def _by_region(self, density: Floats) -> Floats:
        """(regions, k) integrals of a density (m, q, k)."""
        of_element = np.einsum("mq,mqk->mk", self.weight, density, optimize=True)
        return np.column_stack([np.bincount(self.region, column, self._regions) for column in of_element.T])

    def _moved(self, density: Floats, pairs: tuple[tuple[Floats, Floats], ...]) -> Floats:
        """(n, 2, k) the derivative of ∫ f by the nodes.

        density : f (m, q, k). pairs : for each field its rows (m, q, 2, k) and the derivative of f by them, that first.
        """
        return node_derivative(
            self.solution.problem.mesh.topology, self._rows, self.weight, self._root, self._metric, density, pairs
        )


def inverse_squared_radius(mesh: Mesh, elements: Ints | slice = slice(None), values: Floats = _SHAPE) -> Floats:
    """(m, q) 1/r² (1/m²) at points of elements with shape functions ``values`` (q, 6)."""
    return np.asarray(1 / (2 * np.einsum("qn,mn->mq", values, mesh.nodes[mesh.elements[elements], 0], optimize=True)))


def node_derivative(
    topology: Topology,
    rows: Floats,
    weight: Floats,
    root: Floats,
    metric: Floats | None,
    density: Floats | None,
    pairs: tuple[tuple[Floats, Floats], ...],
    elements: Ints | slice = slice(None),
    values: Floats = _SHAPE,
) -> Floats:
    """(n, 2, k) derivative by the nodes of Σ weight · f over points of the elements.

    rows : (m, 2 q, 6) the kernel's, at points of these elements with shape functions ``values`` (q, 6). root : 1/r at
    the points. metric : 1/(2s) where f depends on s by the kernel's rows, None where it is a polynomial of the
    derivatives in the chart. density : f (m, q, k), None for what is a sum over points rather than an integral.
    pairs : (derivative of f by the rows of a field, those rows), each (m, q, 2, k).
    """
    m, q, _, k = pairs[0][1].shape if pairs[0][1].shape[-1] >= pairs[0][0].shape[-1] else pairs[0][0].shape
    along = weight[..., None]
    # Row 1 is root ∂_z: derivatives by ∂_z v carry it, and ∂_z v is the row without it.
    factors = np.zeros((2, m, q, 2, k))
    explicit = np.zeros((m, q, k))
    for by, field in pairs:
        factors[0, :, :, 0] -= by[:, :, 0] * field[:, :, 0]
        factors[0, :, :, 1] -= by[:, :, 1] * field[:, :, 0]
        factors[1, :, :, 0] -= by[:, :, 0] * field[:, :, 1] / root[..., None]
        turned = by[:, :, 1] * field[:, :, 1]
        factors[1, :, :, 1] -= turned / root[..., None]
        if metric is not None:
            explicit -= metric[..., None] * turned
    if density is not None:
        factors[0, :, :, 0] += density
        factors[1, :, :, 1] += density / root[..., None]
    factors *= along[None, :, :, None]
    nodal = np.empty((m, 6, 2, k))
    turned_rows = rows.transpose(0, 2, 1)
    for i in range(2):
        nodal[:, :, i] = turned_rows @ factors[i].reshape(m, 2 * q, k)
    if metric is not None:
        nodal[:, :, 0] += np.einsum("qn,mqk->mnk", values, along * explicit, optimize=True)
    return topology.scatter(nodal.reshape(m, 6, 2 * k), elements).reshape(-1, 2, k)
