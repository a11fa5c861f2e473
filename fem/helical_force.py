"""Axial force and torque of a lead screw, each in its own right, per period of its length.

Signs: force is on the inner member, positive towards larger ζ; torque on the outer one, positive about +z. With
displacement of the outer member relative to the inner one as x_d they are F_s and T_s of a screw with rotor outside.
"""

from __future__ import annotations

import numpy as np

from fluxbore.fem.element import positions
from fluxbore.fem.helical import HelicalSolution, helical_kernel
from fluxbore.fem.reluctivity import VACUUM_PERMEABILITY


def force(solution: HelicalSolution) -> float:
    """Axial force (N) on the inner member by Maxwell's stress B_r H_z, averaged over the gap.

    F = (2π μ0/g) ∫∫ ∂φ/∂r ∂φ/∂ζ r dr dζ, the domain form of the stress (Arkkio 1987) with a weight that falls linearly
    across the gap g: at the same time the derivative of the discrete coenergy as the gap's cells are sheared
    (Coulomb 1983), which `virtual_force` finds from the cells themselves.
    """
    h, weight = _gap(solution)
    return float(_mean_over_gap(solution) * np.sum(weight * h[..., 0] * h[..., 2]))


def torque(solution: HelicalSolution) -> float:
    """Torque (N m) on the outer member by Maxwell's stress B_r H_θ times r, averaged over the gap."""
    h, weight = _gap(solution)
    r = positions(solution.system.mesh, solution.system.grid.gap)[..., 0]
    return float(-_mean_over_gap(solution) * np.sum(weight * r * h[..., 0] * h[..., 1]))


def virtual_force(solution: HelicalSolution) -> float:
    """Axial force (N) on the inner member by virtual work: minus the discrete coenergy's derivative by displacement.

    The coenergy is stationary in φ, so only the mesh moves. Shearing a cell leaves its Jacobian's determinant alone,
    and the coenergy of the gap is a polynomial of degree two in the displacement: a central difference is exact, and
    is taken over the gap's width to keep clear of rounding.
    """
    system, gap = solution.system, solution.system.grid.gap
    first, last = solution.section.gap_radii
    ratio, step = solution.section.transfer_ratio, last - first
    ahead, behind = (
        system.coenergy(solution.phi, helical_kernel(system.grid, ratio, moved, gap), gap) for moved in (step, -step)
    )
    return -(ahead - behind) / (2 * step)


def coenergy(solution: HelicalSolution) -> float:
    """∫∫ B·dH (J) of a period from H = 0 all the way round: negative, for it is the least there is."""
    return solution.system.coenergy(solution.phi)


def _gap(solution: HelicalSolution) -> tuple[np.ndarray, np.ndarray]:
    """H (m, q, 3) and weights r dr dζ (m, q) in the gap."""
    gap = solution.system.grid.gap
    return solution.field_strength(gap), solution.system.kernel.weight[gap]


def _mean_over_gap(solution: HelicalSolution) -> float:
    """What sums over the mesh's gap are multiplied by: μ0 over the gap's width (H/m²), all the way round a period."""
    first, last = solution.section.gap_radii
    return 2 * np.pi * solution.system.grid.copies * VACUUM_PERMEABILITY / (last - first)
