"""Energy, coenergy and their densities."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.element import flux_density_squared
from fluxbore.fem.magnetostatics import Solution, System, coercive_field
from fluxbore.fem.mesh import Floats


def energy_densities(system: System, psi: Floats) -> tuple[Floats, Floats]:
    """(m,) energy and (m,) coenergy of each element, per radian (J/rad) or per depth (J/m).

    Energy density ∫H·dB from the state without field, H = 0: for iron that is B = 0, for a magnet its remanence.
    Coenergy density is |B| H_s − ∫H_s dB with the material's own H_s(B), its coercivity left out; the two add up to H·B
    and a constant of the magnet.
    """
    problem, mesh, kernel = system.problem, system.problem.mesh, system.kernel
    field, _ = flux_density_squared(kernel.curl, psi[mesh.elements])
    factor = system.linear_factor
    rows = factor[..., None] if factor.ndim == 2 else factor
    linear = np.sum(rows * field**2, axis=(1, 2)) / 2
    energy, coenergy = linear.copy(), linear
    for index, material in enumerate(problem.materials):
        elements = np.flatnonzero(mesh.region == index)
        if not elements.size:
            continue
        if material.curve is not None:
            part = next(part for number, part in system.iron if number == index)
            _, squared = flux_density_squared(system.iron_curl[part], psi[mesh.elements[elements]])
            b, weight = np.sqrt(squared), system.iron_weight[part]
            stored = np.sum(weight * material.curve.energy_density(b), axis=1)
            energy[elements] += stored
            coenergy[elements] += np.sum(weight * b * material.curve.field_strength(b), axis=1) - stored
        if material.coercivity == (0.0, 0.0):
            continue
        coercive = coercive_field(mesh, material, elements)
        work = np.sum(kernel.weight[elements] * np.sum(coercive * field[elements], axis=-1), axis=1)
        size = np.linalg.norm(coercive, axis=-1)
        if material.curve is not None:
            at_rest = material.curve.coenergy_at(size)
        else:
            first, second = material.components
            at_rest = (coercive[..., 0] ** 2 / second + coercive[..., 1] ** 2 / first) / 2
        energy[elements] += np.sum(kernel.weight[elements] * at_rest, axis=1) - work
    return energy, coenergy


def energies(solution: Solution) -> tuple[float, float]:
    """Energy and coenergy (J) of the whole problem: all the way round, or of its depth."""
    energy, coenergy = energy_densities(solution.triangles, solution.psi)
    extent = solution.problem.extent
    return float(energy.sum() * extent), float(coenergy.sum() * extent)
