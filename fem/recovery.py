"""A better field from the one at hand: superconvergent patch recovery, region by region.

Around each corner of the mesh, and in each region that meets there, a polynomial of second degree is fitted to the flux
density at the quadrature points of the elements around it (Zienkiewicz and Zhu 1992, Int. J. Numer. Methods Eng. 33,
1331). Blended by the corners' barycentric coordinates, the polynomials give a field that is continuous in the region
and one order better than the elements' own where the field is smooth. Their difference estimates the error.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, positions, shape
from fluxbore.fem.mesh import Floats, Ints, Mesh, in_space

_TERMS = 6
_ODD = np.array([1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
"""Signs of the terms at the mirror image across the axis."""

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


class Patches:
    """The patches of a mesh, ready to recover any number of fields on it."""

    def __init__(self, mesh: Mesh) -> None:
        self._mesh = mesh
        corners = mesh.elements[:, :3]
        count = int(mesh.nodes.shape[0])
        codes, patch = np.unique(mesh.region[:, None] * count + corners, return_inverse=True)
        self._patch = patch.reshape(corners.shape)
        self._origin = mesh.positions[codes % count]
        points = positions(mesh)
        size = np.zeros(codes.size)
        for corner in range(3):
            reach = np.abs(points - self._origin[self._patch[:, corner]][:, None]).max(axis=(1, 2))
            np.maximum.at(size, self._patch[:, corner], reach)
        self._size = np.where(size > 0, size, 1.0)
        self._sorted = [_sorted(self._patch[:, corner]) for corner in range(3)]
        self._samples = [
            _terms((points - self._origin[mine][:, None]) / self._size[mine][:, None, None]) for mine in self._patch.T
        ]
        square = np.zeros((codes.size, _TERMS, _TERMS))
        samples = np.zeros(codes.size)
        for corner, terms in enumerate(self._samples):
            self._add(square, corner, terms.transpose(0, 2, 1) @ terms)
            samples += np.bincount(self._patch[:, corner], minlength=codes.size) * points.shape[1]
        self._on_axis = np.flatnonzero(self._origin[:, 0] == 0) if mesh.chart == "axisymmetric" else np.zeros(0, int)
        # What lies beyond the axis: B_z the same, B_r turned round.
        square[self._on_axis] += square[self._on_axis] * _ODD[:, None] * _ODD
        self._few = np.flatnonzero(samples < _LEAST_SAMPLES)
        square[self._few, 3:], square[self._few, :, 3:] = 0.0, 0.0
        # A whiff of regularisation keeps patches on a line, such as two flat elements, solvable.
        diagonal = np.einsum("ptt->pt", square)
        diagonal += 1e-9 * samples[:, None] + (diagonal == 0)
        self._inverse = np.linalg.inv(square)

    def recover(self, field: Floats) -> RecoveredField:
        """The field recovered from its values (m, q, 2) at the quadrature points, in the kernel's frame."""
        right = np.zeros((self._origin.shape[0], _TERMS, 2))
        for corner, terms in enumerate(self._samples):
            self._add(right, corner, terms.transpose(0, 2, 1) @ field)
        right[self._on_axis] += right[self._on_axis] * _ODD[:, None] * np.array([1.0, -1.0])
        right[self._few, 3:] = 0.0
        return RecoveredField(self._mesh, self._patch, self._origin, self._size, self._inverse @ right)

    def _add(self, target: Floats, corner: int, values: Floats) -> None:
        """target[patch of the corner] += values, with patches that repeat."""
        order, starts, places = self._sorted[corner]
        flat = values.reshape(values.shape[0], -1)
        sums = np.add.reduceat(flat[order], starts, axis=0)
        target[places] += sums.reshape(-1, *values.shape[1:])


def _sorted(patch: Ints) -> tuple[Ints, Ints, Ints]:
    """The elements ordered by patch, where each patch's run begins, and which patch it is."""
    order = np.argsort(patch, kind="stable")
    starts = np.flatnonzero(np.diff(patch[order], prepend=-1))
    return order, starts, patch[order][starts]


def _terms(local: Floats) -> Floats:
    x, y = local[..., 0], local[..., 1]
    return np.stack((np.ones_like(x), x, y, x * x, x * y, y * y), axis=-1)
