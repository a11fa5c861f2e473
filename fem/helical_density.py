"""Integrals over a helical section's mesh, differentiated by all that is continuous in the section.

A density ℓ depends on the slopes ∇v of some nodal fields, on r, on the transfer ratio h and on the materials. Nodes
that move by V take the quadrature points along, ∇v at them changes by −(∇V)ᵀ∇v, and so

    d ∫ ℓ dr dζ = ∫ T : ∇V + ∂ℓ/∂r V_r ,   T_kl = ℓ δ_kl − Σ_v ∂_k v ∂ℓ/∂(∂_l v) ,

Eshelby's tensor, exact to rounding by the elements' own quadrature. A node between two radii, or between two edges of
magnets, moves linearly with both; the magnets' remanence at a point moves along.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, kernel, positions, shape
from fluxbore.fem.helical import HelicalSolution
from fluxbore.fem.mesh import Floats
from fluxbore.fem.reluctivity import VACUUM_PERMEABILITY
from fluxbore.geometry.helical_bands import SMALLEST, Bands
from fluxbore.geometry.helical_numbers import magnets


@dataclass(frozen=True, slots=True, eq=False)
class Density:
    """ℓ at the quadrature points and its derivatives, each (m, q).

    slopes : of each field that it depends on, ∇v and ∂ℓ/∂(∇v), both (m, q, 2). by_radius : by r with the slopes as they
    are. by_transfer : by h. by_permeability, by_remanence : by μ and B_rem of materials without a curve.
    """

    value: Floats
    slopes: tuple[tuple[Floats, Floats], ...]
    by_radius: Floats
    by_transfer: Floats
    by_permeability: Floats
    by_remanence: Floats

    def __sub__(self, other: Density) -> Density:
        return Density(
            self.value - other.value,
            (*self.slopes, *((slope, -by) for slope, by in other.slopes)),
            self.by_radius - other.by_radius,
            self.by_transfer - other.by_transfer,
            self.by_permeability - other.by_permeability,
            self.by_remanence - other.by_remanence,
        )


class Frame:
    """A solution's mesh, ready to integrate densities and to differentiate the integrals.

    Each member has one layer of magnets, in `Bands`. r, weight : (m, q) m and quadrature weights dr dζ (m²).
    """

    def __init__(self, solution: HelicalSolution) -> None:
        self.section, self.system = solution.section, solution.system
        assert all(isinstance(layer.magnets, Bands) for layer in self.section.layers if layer.magnets)
        found = kernel(self.system.mesh)
        self.rows, self.weight = found.curl, found.weight
        self.r = positions(self.system.mesh)[..., 0]
        nodes = self.system.mesh.nodes
        width = int(np.flatnonzero(nodes[:, 0] == nodes[0, 0])[1])
        self._columns = nodes[:width, 0]
        # The share of the outer member's displacement, and ζ but for it, of rows and columns of nodes.
        self._share = self.system.grid.weight.reshape(-1, width)
        self._still = nodes[:, 1].reshape(-1, width) - self._share * self.section.displacement

    def slopes(self, nodal: Floats) -> Floats:
        """(m, q, 2) ∂/∂r and ∂/∂ζ of a nodal field (n,)."""
        return np.asarray(np.einsum("mqkn,mn->mqk", self.rows, nodal[self.system.mesh.elements], optimize=True))

    def pull(self, by_slopes: Floats) -> Floats:
        """(n,) derivative by the field's nodal values of an integral whose density has this one by its slopes."""
        mesh = self.system.mesh
        pull = np.einsum("mqkn,mqk,mq->mn", self.rows, by_slopes, self.weight, optimize=True)
        return np.asarray(np.bincount(mesh.elements.ravel(), pull.ravel(), mesh.nodes.shape[0]))

    def by_numbers(self, density: Density) -> Floats:
        """Derivative of ∫ ℓ over the mesh by the section's `numbers`, nodal fields as they are, SI.

        Where the mesh is half a period, magnets half a period apart change together, and the first has it all. Of
        layers that are no magnets the permeability is taken for a constant, and has zero.
        """
        section = self.section
        across, along = self._by_nodes(density)
        radii = _hats(self._columns, np.array(section.radii)).T @ across.sum(axis=0)
        by_period = np.sum(along * self._still) / section.period
        by_lead = np.sum(self.weight * density.by_transfer) / (2 * np.pi)
        permeabilities = np.zeros(len(section.layers))
        bands = []
        for number, profile in magnets(section):
            outer = number > section.gap
            of_rows = section.period * (along * (self._share if outer else 1 - self._share)).sum(axis=1)
            starts = self._by_starts(profile, self._still[:, -1 if outer else 0] / section.period, of_rows)
            permeabilities[number], first, last = self._by_materials(number, profile, density)
            bands.append(np.column_stack((starts, first, last)).ravel())
        return np.concatenate((radii, [by_period, by_lead, np.sum(along * self._share)], permeabilities, *bands))

    def _by_nodes(self, density: Density) -> tuple[Floats, Floats]:
        """(rows, columns) by the nodes' r, and by their ζ."""
        tensor = -sum(slope[..., :, None] * by[..., None, :] for slope, by in density.slopes)
        tensor = tensor + density.value[..., None, None] * np.eye(2)
        by_node = np.einsum("mqkl,mqln,mq->kmn", tensor, self.rows, self.weight, optimize=True)
        by_node[0] += np.einsum("mq,mq,qn->mn", density.by_radius, self.weight, shape(QUADRATURE_POINTS), optimize=True)
        elements = self.system.mesh.elements.ravel()
        across, along = (np.bincount(elements, part.ravel(), self._share.size) for part in by_node)
        return np.asarray(across.reshape(self._share.shape), float), np.asarray(along.reshape(self._share.shape), float)

    def _by_materials(self, number: int, profile: Bands, density: Density) -> tuple[float, Floats, Floats]:
        """By a layer's relative permeability, and (segments,) by its segments' first and last remanence."""
        elements = np.flatnonzero(self.system.grid.layer == number)
        moved = self.section.displacement if number > self.section.gap else 0.0
        share = (positions(self.system.mesh, elements)[..., 1] - moved) / self.section.period
        part, along = profile.located(share)
        filled = profile.magnets(share).all(axis=1)
        weight = self.weight[elements]
        by_permeability = float(np.sum((weight * density.by_permeability[elements])[filled]))
        by_value = weight * density.by_remanence[elements]
        first, last = (
            np.bincount(part.ravel(), (by_value * at).ravel(), len(profile.segments)) for at in (1 - along, along)
        )
        return VACUUM_PERMEABILITY * by_permeability, np.asarray(first, float), np.asarray(last, float)

    def _by_starts(self, profile: Bands, rows: Floats, by_rows: Floats) -> Floats:
        """(segments,) by where the segments start, from that by the u of the mesh's rows, which are at `rows`."""
        whole = 1 / self.system.grid.copies
        places = np.mod(profile.breaks, whole)
        kept: list[int] = []
        for index in np.argsort(places, kind="stable"):
            beyond = places[index] - places[kept] if kept else np.array([whole / 2])
            if np.all((beyond > SMALLEST) & (beyond < whole - SMALLEST)):
                kept.append(int(index))
        edges = places[kept]
        hats = _hats(edges[0] + np.mod(rows - edges[0], whole), np.append(edges, edges[0] + whole))
        found = np.zeros(len(profile.segments))
        found[kept] = hats[:, :-1].T @ by_rows
        found[kept[0]] += hats[:, -1] @ by_rows
        return found


def _hats(places: Floats, edges: Floats) -> Floats:
    """(places, edges) by how much each place moves with each edge: linearly between two."""
    return np.column_stack([np.interp(places, edges, unit) for unit in np.eye(edges.size)])
