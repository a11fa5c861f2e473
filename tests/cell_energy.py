"""The energy that the field of a mapped mesh makes stationary, by its own integral."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.mesh import Floats


def energy(system: CellSystem, psi: Floats) -> float:
    """∫ w(B) ds dz − (loads · ψ) per radian (J/rad), ψ (n,) nodal; w of a magnet is ½ ν B²."""
    cells, materials = system.cells, system.problem.materials
    b_z, b_r = cells.fields(psi)
    nu_r, nu_z = np.array([material.components for material in materials]).T[:, cells.region, None]
    density = (nu_z * b_z**2 + nu_r * b_r**2) / 2
    for index, material in enumerate(materials):
        if material.curve is not None:
            own = cells.region == index
            density[own] = material.curve.energy_density(np.hypot(b_z[own], b_r[own]))
    total = float(np.sum(cells.weight * density) - system.load @ psi)
    if system.rim is not None:
        forces = np.zeros(psi.size)
        system.rim.add_forces(forces, psi)
        total += float(psi @ forces) / 2
    return total
