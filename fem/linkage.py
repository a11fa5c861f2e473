"""Flux linkages and inductances of a solution's circuits."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats


def flux_linkages(solution: Solution) -> Floats:
    """(k,) flux linkage (Wb) of each circuit: ∫ (turns/area) ψ dr dz, all the way round or for the depth."""
    return np.array([solution.problem.extent * circuit.density @ solution.psi for circuit in solution.problem.circuits])


def synchronous_inductance(solution: Solution) -> float:
    """Of three phases under balanced current (H), incremental at the solution's state: 2π/3 Σ cᵀ K_T⁻¹ c over Clarke's
    two current distributions, which is the mean of the self less the mean of the mutual inductances."""
    phases = np.column_stack([circuit.density for circuit in solution.problem.circuits])
    angles = 2 * np.pi / 3 * np.arange(phases.shape[1])
    loads = phases @ np.column_stack((np.cos(angles), np.sin(angles)))
    return float(solution.problem.extent / 3 * np.sum(loads * solution.response(loads)))
