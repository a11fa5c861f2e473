"""Exact gradients of a lead screw's figures by all that is continuous in its section: one adjoint field for each.

A figure Q(φ, X) of the field on a mesh with nodes X, where the discrete equations R(φ, X) = 0 hold, changes by

    dQ/dX = ∂/∂X (Q − λᵀR) ,     K λ = ∂Q/∂φ ,

with Newton's tangent K (Céa 1986; Gangl et al. 2015, SIAM J. Sci. Comput. 37). Of `fem.helical`'s equations λᵀR is the
integral of

    r (μ(s) p·A q − B_rem ∂λ/∂r) ,   p = ∇φ ,  q = ∇λ ,  s = p·A p = |H|² ,  A = diag(1, 1 + h²/r²) ,

and `Frame` differentiates integrals. Newton's last residual is what is left of R, so that the gradient is as exact as
the field.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from fluxbore.fem.factors import Factor
from fluxbore.fem.helical import HelicalSolution
from fluxbore.fem.helical_density import Density, Frame
from fluxbore.fem.helical_force import force
from fluxbore.fem.helical_iron import permeability
from fluxbore.fem.linear import factorise
from fluxbore.fem.mesh import Floats
from fluxbore.fem.reluctivity import VACUUM_PERMEABILITY


class HelicalAdjoint:
    """A converged solution, prepared for gradients: its tangent is factorised once for all figures.

    slopes : (m, q, 2) ∇φ (A/m) at the quadrature points. stretch : (m, q) 1 + h²/r². permeability, permeability_slope :
    (m, q) μ (H/m) and dμ/d|H|².
    """

    def __init__(self, solution: HelicalSolution) -> None:
        self.solution, self.frame = solution, Frame(solution)
        self.slopes = self.frame.slopes(solution.phi)
        self.stretch = 1 + (solution.section.transfer_ratio / self.frame.r) ** 2
        self.permeability, self.permeability_slope = self._materials()

    def force(self) -> Floats:
        """(numbers,) of the axial force (N per period), `helical_force.force`, by the section's `numbers`, SI."""
        section, grid, r = self.solution.section, self.solution.system.grid, self.frame.r
        first, last = section.gap_radii
        stress = np.zeros((grid.layer.size, 1))
        stress[grid.gap] = 2 * np.pi * grid.copies * VACUUM_PERMEABILITY / (last - first)
        product = self.slopes[..., 0] * self.slopes[..., 1]
        none = np.zeros_like(r)
        by_slopes = (stress * r)[..., None] * self.slopes[..., ::-1]
        density = Density(stress * r * product, ((self.slopes, by_slopes),), stress * product, none, none, none)
        found = self.total(density)
        # The mean over the gap divides by its width.
        found[section.gap : section.gap + 2] += np.array([1.0, -1.0]) * force(self.solution) / (last - first)
        return found

    def total(self, density: Density) -> Floats:
        """(numbers,) of the integral of a density whose first slopes are the field's, the field following."""
        topology = self.solution.system.topology
        load = topology.gather(self.frame.pull(density.slopes[0][1]))
        adjoint = topology.spread(self._factor.solve(load))
        return self.frame.by_numbers(density - self._residual(adjoint))

    def _residual(self, adjoint: Floats) -> Density:
        """That of λᵀR."""
        p, q, r = self.slopes, self.frame.slopes(adjoint), self.frame.r
        mu, mu_slope, remanence = self.permeability, self.permeability_slope, self.solution.system.remanence
        metric = np.stack((np.ones_like(r), self.stretch), axis=-1)
        product = np.sum(p * metric * q, axis=-1)
        by_p = (r[..., None] * metric) * (mu[..., None] * q + (2 * mu_slope * product)[..., None] * p)
        by_q = (r * mu)[..., None] * metric * p
        by_q[..., 0] -= r * remanence
        by_stretch = r * (mu * p[..., 1] * q[..., 1] + mu_slope * product * p[..., 1] ** 2)
        value = r * (mu * product - remanence * q[..., 0])
        transfer = self.solution.section.transfer_ratio
        return Density(
            value,
            ((p, by_p), (q, by_q)),
            value / r - 2 * transfer**2 / r**3 * by_stretch,
            2 * transfer / r**2 * by_stretch,
            r * product,
            -r * q[..., 0],
        )

    @cached_property
    def _factor(self) -> Factor:
        system = self.solution.system
        unknowns = self.solution.phi[system.topology.nodes_of_freedom]
        return factorise(system.pattern, system.tangent_values(unknowns), "auto")

    def _materials(self) -> tuple[Floats, Floats]:
        """μ (H/m) and dμ/d|H|² (m, q)."""
        system = self.solution.system
        mu = np.repeat(system.mu[:, None], self.frame.r.shape[1], axis=1)
        slope = np.zeros_like(mu)
        squared = self.slopes[..., 0] ** 2 + self.stretch * self.slopes[..., 1] ** 2
        for number, curve in system.curves.items():
            here = system.grid.layer == number
            mu[here], slope[here] = permeability(curve, squared[here])
        return mu, slope
