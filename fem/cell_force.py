"""The axial force on a mapped mesh, by the stress tensor in its domain form over a cylinder shell of air."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.cells import Cells
from fluxbore.fem.mesh import Floats
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY


def shell_pull(cells: Cells, annulus: tuple[float, float], psi: Floats) -> Floats:
    """(n,) ∂F/∂ψ of the axial force F = ½ ψ·∂F/∂ψ (N) on everything inside an annulus.

    annulus : (r from, r to) in m, mesh lines, with nothing but air (μ0) between them over the domain's whole length.

    The weight falls linearly in s = r²/2 from one at the inner to zero at the outer radius, so that
    F = −(2π/μ0) ∫∫ ∂ψ/∂z ∂ψ/∂s ds dz / (s_o − s_i): Maxwell's stress averaged over the shell (Arkkio 1987), and at the
    same time the exact derivative of the discrete energy when the mesh inside is shifted (Coulomb 1983).
    """
    first, last = (cells.grid.line(radius) for radius in annulus)
    column = np.arange(cells.region.size) % cells.shape[1]
    shell = np.flatnonzero((column >= first) & (column < last))
    across, along = cells.fields(psi, shell)
    # The second field is 1/r ∂ψ/∂z: r times it and its own derivative cancel.
    scale = -2 * np.pi * VACUUM_RELUCTIVITY / ((annulus[1] ** 2 - annulus[0] ** 2) / 2)
    weight = scale * cells.weight[shell] / cells.inverse_radius[shell]
    pull = cells.pull_across(weight * along, shell) + cells.pull_along(weight * across, shell)
    return np.asarray(np.bincount(cells.nodes[shell].ravel(), pull.ravel(), psi.size), dtype=float)
