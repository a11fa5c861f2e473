"""A mapped mesh's equations by numpy's arrays and LAPACK's band, in either precision.

What `fem.native` is tested against, and what steps in where it is not compiled or has too few digits.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from fluxbore.fem.cell_band import BandFactor
from fluxbore.fem.cell_matrices import Condensed, Precision, cell_matrices, condensed
from fluxbore.fem.cell_model import CellModel
from fluxbore.fem.linear import check_finite
from fluxbore.fem.mesh import Floats
from fluxbore.fem.plain_cells import PlainFactor


class CellArrays:
    """See `CellKernels`."""

    def __init__(self, model: CellModel) -> None:
        self._model, self._cells = model, model.cells

    @cached_property
    def _linear_r(self) -> Floats:
        """(m, points) ν_r times the quadrature weight, zero in iron."""
        return np.asarray(self._model.reluctivity[0][:, None] * self._cells.weight)

    @cached_property
    def _linear_z(self) -> Floats:
        return np.asarray(self._model.reluctivity[1][:, None] * self._cells.weight)

    def residual(self, psi: Floats) -> tuple[Floats, Floats]:
        """Of nodal ψ, with the tensor."""
        model, iron = self._model, self._model.iron
        b_z, b_r = self._cells.fields(psi)
        h_z, h_r = self._linear_z * b_z, self._linear_r * b_r
        b_z, b_r = b_z[iron], b_r[iron]
        squared, weight = b_z**2 + b_r**2, self._cells.weight[iron]
        nu, slope = np.empty_like(squared), np.empty_like(squared)
        for curve, part in model.curves:
            nu[part], slope[part] = curve.reluctivity(squared[part])
        nu, bent = nu * weight, 2 * slope * weight
        h_z[iron], h_r[iron] = nu * b_z, nu * b_r
        tensor = np.stack((nu + bent * b_z**2, bent * b_z * b_r, nu + bent * b_r**2))
        return np.where(model.free, self._pulled(h_z, h_r, psi) - model.load, 0.0), tensor

    def _pulled(self, h_z: Floats, h_r: Floats, psi: Floats) -> Floats:
        """(n,) ∫ H·B(v) of H times weights (m, points), and what the rim adds."""
        nodal = self._cells.pull_across(h_z) + self._cells.pull_along(h_r)
        forces = np.asarray(np.bincount(self._cells.nodes.ravel(), nodal.ravel(), psi.size), dtype=float)
        if self._model.rim is not None:
            self._model.rim.add_forces(forces, psi)
        return forces

    def product(self, tensor: Floats, columns: Floats) -> Floats:
        """With nodal fields (n, k)."""
        iron, (along_z, mixed, along_r) = self._model.iron, tensor
        found = np.empty_like(columns)
        for k in range(columns.shape[1]):
            u_z, u_r = self._cells.fields(columns[:, k])
            h_z, h_r = self._linear_z * u_z, self._linear_r * u_r
            u_z, u_r = u_z[iron], u_r[iron]
            h_z[iron], h_r[iron] = along_z * u_z + mixed * u_r, mixed * u_z + along_r * u_r
            found[:, k] = self._pulled(h_z, h_r, columns[:, k])
        return np.where(self._model.free[:, None], found, 0.0)

    def linear(self, precision: Precision) -> tuple[Condensed, Any]:
        """The cells without iron, and the band of their edges and the rim's."""
        where, others, rim = self._model.where, self._model.others, self._model.rim
        none = np.zeros((others.size, self._cells.square.points))
        whole = cell_matrices(self._cells, others, self._linear_z[others], none, self._linear_r[others])
        # Rounded at the end only: digits lost on the way would cost a sweep of refinement more.
        found = condensed(self._cells.square, whole).rounded(precision)
        band = where.empty_band(precision)
        where.entries(others).add(band, found.edge)
        if rim is not None:
            where.entries_of(rim.nodes).add(band, rim.matrices)
        return found, band

    def factor(self, tensor: Floats, precision: Precision, linear: tuple[Condensed, Any]) -> BandFactor:
        """Of the band of all cells' edges."""
        inside, band = self.condensed(tensor, precision, linear)
        return BandFactor(self._model.where, band, ((self._model.others, linear[0]), (self._model.iron, inside)))

    def condensed(self, tensor: Floats, precision: Precision, linear: tuple[Condensed, Any]) -> tuple[Condensed, Any]:
        """The iron's cells, and of all cells the band (k, bandwidth + 1): the lower triangle of the condensed tangent,
        by columns from the diagonal down."""
        check_finite(tensor)
        along_z, mixed, along_r = tensor
        whole = cell_matrices(self._cells, self._model.iron, along_z, mixed, along_r, precision)
        inside, band = condensed(self._cells.square, whole), linear[1].copy()
        self._model.where.entries(self._model.iron).add(band, inside.edge)
        return inside, band

    def plain_factor(self, tensor: Floats) -> PlainFactor:
        """The whole matrix, by general means."""
        check_finite(tensor)
        cells, model = self._cells, self._model
        across, along, mixed = self._linear_z.copy(), self._linear_r.copy(), np.zeros_like(self._linear_z)
        across[model.iron], mixed[model.iron], along[model.iron] = tensor
        whole = cell_matrices(cells, np.arange(cells.region.size), across, mixed, along)
        return PlainFactor(cells.nodes, model.free, whole, model.rim)
