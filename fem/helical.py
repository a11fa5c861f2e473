"""Magnetic lead screws, exactly, in two dimensions: solve(section) -> HelicalSolution.

Everything on a lead screw away from its ends depends on r and ζ = z − h θ alone, h = lead/2π. No current flows, so
H = −∇φ, and in cylindrical coordinates

    H_r = −∂φ/∂r ,   H_z = −∂φ/∂ζ ,   H_θ = (h/r) ∂φ/∂ζ ,   |H|² = (∂φ/∂r)² + (1 + h²/r²) (∂φ/∂ζ)² .

The three-dimensional field is that of a two-dimensional periodic problem, with the tensor μ r diag(1, 1 + h²/r²):

    ∫ μ(|H|) [ ∂φ/∂r ∂v/∂r + (1 + h²/r²) ∂φ/∂ζ ∂v/∂ζ ] r dr dζ = ∫ B_rem ∂v/∂r r dr dζ

for every v, which says that B = μ H + B_rem e_r has no sources. It minimises the coenergy ∫∫ B·dH, a convex functional.
At h = 0 it is the axisymmetric problem of rings. The 2π of revolution is in the figures, not in the equations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fluxbore.fem.element import Kernel, flux_density_squared, kernel, positions, stiffness
from fluxbore.fem.helical_iron import coenergy_density, permeability
from fluxbore.fem.helical_mesh import HelicalMesh, helical_mesh
from fluxbore.fem.linear import Tangents
from fluxbore.fem.magnetostatics import Settings
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.newton import ROUGHEST, Convergence, newton
from fluxbore.fem.reluctivity import VACUUM_PERMEABILITY, reluctivity_curve
from fluxbore.geometry.helical_section import HelicalSection

SETTINGS = Settings(tolerance=1e-8, method="auto")


class HelicalSystem:
    """The discrete equations of a section on its mesh: what is linear is assembled once, iron at each step."""

    def __init__(self, section: HelicalSection, grid: HelicalMesh) -> None:
        self.section, self.grid = section, grid
        self.mesh = grid.mesh
        self.topology = grid.mesh.topology
        self.pattern = self.topology.pattern
        self.kernel = helical_kernel(grid, section.transfer_ratio)
        self._place_materials()
        self.linear = self.pattern.assemble(stiffness(self.kernel.curl, self.kernel.weight * self.mu[:, None]))
        pull = np.einsum("mqn,mq->mn", self.kernel.curl[:, :, 0], self.kernel.weight * self.remanence, optimize=True)
        nodal = np.bincount(self.mesh.elements.ravel(), pull.ravel(), self.mesh.nodes.shape[0])
        self.load = self.topology.gather(np.asarray(nodal, dtype=float))
        chosen = [np.flatnonzero(grid.layer == number) for number in self.curves]
        self.iron = np.concatenate(chosen) if chosen else np.zeros(0, dtype=int)
        ends = np.cumsum([0, *(part.size for part in chosen)])
        self.parts = {number: slice(*ends[k : k + 2]) for k, number in enumerate(self.curves)}
        self.iron_rows, self.iron_weight = self.kernel.curl[self.iron], self.kernel.weight[self.iron]
        self.iron_nodes = self.mesh.elements[self.iron]
        self.gather = self.pattern.subset_assembler(self.iron)

    def _place_materials(self) -> None:
        """mu (m,) of the linear part (H/m), zero in iron with a curve; remanence (m, q) along r (T); the curves."""
        layers = self.section.layers
        relative = np.array([0.0 if layer.curve else layer.permeability for layer in layers])
        self.mu = VACUUM_PERMEABILITY * relative[self.grid.layer]
        self.remanence = np.zeros(self.kernel.weight.shape)
        self.curves = {k: reluctivity_curve(layer.curve) for k, layer in enumerate(layers) if layer.curve}
        for number, layer in enumerate(layers):
            if layer.magnets is None:
                continue
            elements = np.flatnonzero(self.grid.layer == number)
            moved = self.section.displacement if number > self.section.gap else 0.0
            share = (positions(self.mesh, elements)[..., 1] - moved) / self.section.period
            self.remanence[elements] = layer.magnets.remanence(share)
            between = elements[~layer.magnets.magnets(share).all(axis=1)]
            self.mu[between] = VACUUM_PERMEABILITY

    def _iron_state(self, unknowns: Floats) -> tuple[Floats, Floats, Floats]:
        """−H (m, q, 2), μ and dμ/d|H|² (m, q) in the elements of iron with a curve."""
        phi = self.topology.spread(unknowns)[self.iron_nodes]
        field, squared = flux_density_squared(self.iron_rows, phi)
        mu, slope = np.empty_like(squared), np.empty_like(squared)
        for number, part in self.parts.items():
            mu[part], slope[part] = permeability(self.curves[number], squared[part])
        return field, mu, slope

    def residual(self, unknowns: Floats) -> Floats:
        """∫ −B·∇v (Wb), one per unknown."""
        forces = self.pattern.multiply(self.linear, unknowns) - self.load
        if self.iron.size:
            field, mu, _ = self._iron_state(unknowns)
            pull = np.einsum("mqkn,mqk->mn", self.iron_rows, field * (mu * self.iron_weight)[..., None], optimize=True)
            nodal = np.bincount(self.iron_nodes.ravel(), pull.ravel(), self.topology.freedom.size)
            forces += self.topology.gather(np.asarray(nodal, dtype=float))
        return forces

    def tangent_values(self, unknowns: Floats) -> Floats:
        """(nnz,) of the residual's derivative: ∫ (μ + 2 dμ/d|H|² H⊗H) ∇v·∇w, the differential permeability."""
        if not self.iron.size:
            return self.linear
        field, mu, slope = self._iron_state(unknowns)
        m, q, _, six = self.iron_rows.shape
        along = np.einsum("mqkn,mqk->mqn", self.iron_rows, field, optimize=True)
        rows = np.concatenate((self.iron_rows.reshape(m, 2 * q, six), along), axis=1)
        factor = np.concatenate((np.repeat(mu * self.iron_weight, 2, axis=1), 2 * slope * self.iron_weight), axis=1)
        return self.linear + self.gather.assemble(rows.transpose(0, 2, 1) @ (rows * factor[..., None]))

    def coenergy(self, phi: Floats, frame: Kernel | None = None, elements: Ints | slice = slice(None)) -> float:
        """∫ ∫ B·dH from H = 0 (J per period) of nodal φ (n,), of all or of some elements, all the way round.

        frame : the elements' kernel where their nodes are elsewhere than the mesh's; for elements without a curve.
        """
        frame = frame or Kernel(self.kernel.curl[elements], self.kernel.weight[elements])
        field, squared = flux_density_squared(frame.curl, phi[self.mesh.elements[elements]])
        density = squared * self.mu[elements][:, None] / 2 - self.remanence[elements] * field[..., 0]
        total = float(np.sum(frame.weight * density))
        if isinstance(elements, slice):
            _, squared = flux_density_squared(self.iron_rows, phi[self.iron_nodes])
            for number, part in self.parts.items():
                total += float(np.sum(self.iron_weight[part] * coenergy_density(self.curves[number], squared[part])))
        return 2 * np.pi * self.grid.copies * total


def helical_kernel(
    grid: HelicalMesh, transfer_ratio: float, moved: float = 0.0, elements: Ints | None = None
) -> Kernel:
    """Rows that give −H along r and along the helix' normal in (θ, z), the sum of squares being |H|²; weights r dr dζ.

    moved : m by which the outer member lies further than in the mesh.
    """
    mesh = grid.mesh
    if moved:
        nodes = mesh.nodes + np.column_stack((np.zeros_like(grid.weight), moved * grid.weight))
        mesh = replace(mesh, nodes=nodes)
    found = kernel(mesh, elements)
    r = positions(mesh, elements)[..., 0]
    rows = found.curl
    rows[:, :, 1] *= np.sqrt(1 + (transfer_ratio / r) ** 2)[..., None]
    return Kernel(rows, found.weight * r)


@dataclass(frozen=True, eq=False)
class HelicalSolution:
    """The field of a section.

    phi : (n,) scalar potential (A) at the nodes. convergence : look here first; a field that did not converge is kept
    for inspection.
    """

    section: HelicalSection
    system: HelicalSystem
    phi: Floats
    convergence: Convergence

    def field_strength(self, elements: Ints | None = None) -> Floats:
        """(m, q, 3) H (A/m) along r, θ and z at the quadrature points of all or of some elements."""
        mesh = self.system.mesh
        slopes = kernel(mesh, elements).curl
        nodes = mesh.elements if elements is None else mesh.elements[elements]
        along_r, along_zeta = np.moveaxis(np.einsum("mqkn,mn->mqk", slopes, self.phi[nodes], optimize=True), -1, 0)
        r = positions(mesh, elements)[..., 0]
        return np.stack((-along_r, self.section.transfer_ratio / r * along_zeta, -along_zeta), axis=-1)

    def flux_density(self, elements: Ints | None = None) -> Floats:
        """(m, q, 3) B (T) along r, θ and z at the quadrature points of all or of some elements."""
        h = self.field_strength(elements)
        chosen = np.arange(self.system.mesh.region.size) if elements is None else elements
        mu = np.broadcast_to(self.system.mu[chosen][:, None], h.shape[:2]).copy()
        squared = np.sum(h**2, axis=-1)
        for number, curve in self.system.curves.items():
            here = self.system.grid.layer[chosen] == number
            mu[here] = permeability(curve, squared[here])[0]
        b = h * mu[..., None]
        b[..., 0] += self.system.remanence[chosen]
        return b


def solve(
    section: HelicalSection,
    refinement: int = 1,
    settings: Settings = SETTINGS,
    start: HelicalSolution | None = None,
    cut: int = 0,
) -> HelicalSolution:
    """The field of a section, end effects left out.

    refinement, cut : of the mesh, see `helical_mesh`. start : a neighbour on the same mesh lines, to begin from.

    A failure to converge is in the solution's ``convergence``.
    """
    system = HelicalSystem(section, helical_mesh(section, refinement, cut))
    inner = system.topology.nodes_of_freedom
    near = start is not None and start.phi.size == system.mesh.nodes.shape[0]
    first = start.phi[inner] if start is not None and near else np.zeros(inner.size)
    unknowns, convergence, _ = newton(
        system.residual,
        Tangents(system.pattern, system.tangent_values, settings.method),
        first,
        float(np.linalg.norm(system.load)),
        settings.tolerance,
        settings.max_iterations,
        ROUGHEST if system.iron.size else 0.0,
    )
    return HelicalSolution(section, system, system.topology.spread(unknowns), convergence)


def solve_displacements(
    section: HelicalSection, displacements: Sequence[float], refinement: int = 1, settings: Settings = SETTINGS
) -> list[HelicalSolution]:
    """The field at each displacement (m), each begun from the one before.

    Stops at the first that does not converge; the last item then says so.
    """
    solved: list[HelicalSolution] = []
    for displacement in displacements:
        moved = replace(section, displacement=displacement)
        solved.append(solve(moved, refinement, settings, solved[-1] if solved else None))
        if not solved[-1].convergence.converged:
            break
    return solved
