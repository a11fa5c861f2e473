"""A better field from the one at hand: superconvergent patch recovery, region by region.

Around each corner of the mesh, and in each region that meets there, a polynomial of second degree is fitted to the flux
density at the quadrature points of the elements around it (Zienkiewicz and Zhu 1992, Int. J. Numer. Methods Eng. 33,
1331). Blended by the corners' barycentric coordinates, the polynomials give a field that is continuous in the region
and one order better than the elements' own where the field is smooth. Their difference estimates the error.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, flux_density_squared, kernel, positions
from fluxbore.fem.mesh import Floats, Ints, Mesh

_TERMS = 6
_LEAST_SAMPLES = 14
"""Patches of one element alone carry a plane: a parabola through seven points of a triangle extrapolates wildly."""


@dataclass(frozen=True, slots=True, eq=False)
class RecoveredField:
    """A recovered vector field on a mesh, in the kernel's frame.

    patch : (m, 3) number of the patch of each element's corners. origin : (p, 2), scale : (p,) of each patch (m).
    coefficients : (p, 6, 2) of 1, x, y, x², xy, y² in the patch's scaled coordinates.
    """

    mesh: Mesh
    patch: Ints
    origin: Floats
    scale: Floats
    coefficients: Floats

    def at(self, elements: Ints, barycentric: Floats) -> Floats:
        """(k, 2) at one point of each of k elements; barycentric : (k, 3)."""
        from fluxbore.fem.element import shape
        from fluxbore.fem.mesh import in_space

        nodes = self.mesh.nodes[self.mesh.elements[elements]]
        points = in_space(self.mesh.chart, np.einsum("kn,knc->kc", shape(barycentric), nodes, optimize=True))
        return self._blend(elements, points[:, None, :], barycentric[:, None, :])[:, 0]

    def at_quadrature(self, elements: Ints | None = None) -> Floats:
        """(m, q, 2) at the quadrature points of all or of some elements."""
        chosen = np.arange(self.patch.shape[0]) if elements is None else elements
        points = positions(self.mesh, chosen)
        return self._blend(chosen, points, np.broadcast_to(QUADRATURE_POINTS, (*points.shape[:2], 3)))

    def _blend(self, elements: Ints, points: Floats, barycentric: Floats) -> Floats:
        total = np.zeros(points.shape)
        for corner in range(3):
            patch = self.patch[elements, corner]
            local = (points - self.origin[patch][:, None]) / self.scale[patch][:, None, None]
            values = np.einsum("kqt,ktc->kqc", _terms(local), self.coefficients[patch], optimize=True)
            total += barycentric[..., corner, None] * values
        return total


def recover(mesh: Mesh, psi: Floats, curl: Floats | None = None) -> RecoveredField:
    """Recover the flux density of nodal ψ.

    curl : the kernel's, if it is at hand.
    """
    curl = kernel(mesh).curl if curl is None else curl
    field, _ = flux_density_squared(curl, psi[mesh.elements])
    corners = mesh.elements[:, :3]
    count = int(mesh.nodes.shape[0])
    codes, patch = np.unique(mesh.region[:, None] * count + corners, return_inverse=True)
    patch = patch.reshape(corners.shape)
    origin = mesh.positions[codes % count]
    points = positions(mesh)

    size = np.zeros(codes.size)
    for corner in range(3):
        reach = np.abs(points - origin[patch[:, corner]][:, None]).max(axis=(1, 2))
        np.maximum.at(size, patch[:, corner], reach)
    size = np.where(size > 0, size, 1.0)

    square = np.zeros((codes.size, _TERMS, _TERMS))
    right = np.zeros((codes.size, _TERMS, 2))
    samples = np.zeros(codes.size)
    for corner in range(3):
        mine = patch[:, corner]
        terms = _terms((points - origin[mine][:, None]) / size[mine][:, None, None])
        _add(square, mine, np.einsum("mqs,mqt->mst", terms, terms, optimize=True))
        _add(right, mine, np.einsum("mqs,mqc->msc", terms, field, optimize=True))
        samples += np.bincount(mine, minlength=codes.size) * points.shape[1]
    if mesh.chart == "axisymmetric":
        _mirror(square, right, np.flatnonzero(origin[:, 0] == 0))
    few = np.flatnonzero(samples < _LEAST_SAMPLES)
    square[few, 3:], square[few, :, 3:] = 0.0, 0.0
    right[few, 3:] = 0.0
    # A whiff of regularisation keeps patches on a line, such as two flat elements, solvable.
    diagonal = np.einsum("ptt->pt", square)
    diagonal += 1e-9 * samples[:, None] + (diagonal == 0)
    return RecoveredField(mesh, patch, origin, size, np.linalg.solve(square, right))


def _mirror(square: Floats, right: Floats, patches: Ints) -> None:
    """Add to patches on the axis what lies beyond it: B_z the same, B_r turned round."""
    odd = np.array([1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
    square[patches] += square[patches] * odd[:, None] * odd
    right[patches] += right[patches] * odd[:, None] * np.array([1.0, -1.0])


def _terms(local: Floats) -> Floats:
    x, y = local[..., 0], local[..., 1]
    return np.stack((np.ones_like(x), x, y, x * x, x * y, y * y), axis=-1)


def _add(target: Floats, place: Ints, values: Floats) -> None:
    """target[place] += values, with places that repeat."""
    flat = values.reshape(values.shape[0], -1)
    order = np.argsort(place, kind="stable")
    starts = np.flatnonzero(np.diff(place[order], prepend=-1))
    sums = np.add.reduceat(flat[order], starts, axis=0)
    target[place[order][starts]] += sums.reshape(-1, *values.shape[1:])
