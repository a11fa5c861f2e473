"""Figures that refinement can be asked to make accurate."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fluxbore.fem.adapt import Measure
from fluxbore.fem.body_force import (
    Component,
    lorentz_force,
    lorentz_gradient,
    lorentz_scale,
    stress_force,
    stress_gradient,
    stress_scale,
)
from fluxbore.fem.energy import energies
from fluxbore.fem.linkage import flux_linkages
from fluxbore.fem.locate import Locator
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Mesh
from fluxbore.fem.weight import smooth_weight

NEXT_TO_NOTHING = 0.02
"""A force or linkage below this share of what its parts add up to without their signs is held against that share."""


FORBIDDEN = 2e-3
"""A component below this share of all that pulls on the body, to whatever side, is held against that share: where
symmetry forbids it, even its parts are nothing."""

FORCE_SHARE = 0.5
"""Forces are held to half of the accuracy: the forces of a pair then add up to nothing within it."""

SISTERS = 0.1
"""A linkage below this share of the largest one is held against that share."""

FAINT = 1e-3
"""A flux density below this share of the largest one is held against that share: a field that symmetry forbids is not
chased down to nothing."""


@dataclass(frozen=True, slots=True)
class EnergyGoal:
    """The field's energy, which bounds every figure that is a scalar product with the load."""

    name: str = "energy"

    def measure(self, solution: Solution) -> Measure:
        energy, coenergy = energies(solution)
        # A magnet alone has little of the one and much of the other.
        return Measure(energy, max(abs(energy), 0.1 * abs(coenergy)), None)


@dataclass(frozen=True, slots=True)
class LinkageGoal:
    """Flux linkage of a circuit. index : of the problem's circuits."""

    name: str
    index: int

    def measure(self, solution: Solution) -> Measure:
        gradient = solution.problem.extent * solution.problem.circuits[self.index].density
        shares = gradient * solution.psi
        value, largest = float(shares.sum()), float(np.abs(flux_linkages(solution)).max())
        # A phase that links next to nothing by its position is held against its sisters.
        scale = max(abs(value), NEXT_TO_NOTHING * float(np.abs(shares).sum()), SISTERS * largest)
        return Measure(value, scale, gradient)


@dataclass(frozen=True, slots=True)
class PointGoal:
    """The flux density at a point, one component of it, as the mean over the elements that hold the point.

    point : m. across : the component across the field instead of the one along it.
    """

    name: str
    point: tuple[float, float]
    across: bool = False

    def measure(self, solution: Solution) -> Measure:
        mesh = solution.problem.mesh
        elements = np.array([element for element, _ in locator(mesh).find_all(np.array(self.point))], dtype=int)
        if not elements.size:
            return Measure(0.0, 0.0, np.zeros(mesh.nodes.shape[0]))
        weight = solution.system.kernel.weight[elements]
        weight = weight / weight.sum()
        curl = solution.system.kernel.curl[elements]
        mean = np.einsum("mq,mqkn,mn->k", weight, curl, solution.psi[mesh.elements[elements]], optimize=True)
        size = float(np.hypot(*mean))
        largest = float(np.sqrt(np.sum(solution.flux_density() ** 2, axis=-1).mean(axis=1).max(initial=0.0)))
        along = mean / size if size > 0 else np.array([1.0, 0.0])
        direction = np.array([-along[1], along[0]]) if self.across else along
        share = np.einsum("mq,mqkn,k->mn", weight, curl, direction, optimize=True)
        nodal = np.bincount(mesh.elements[elements].ravel(), share.ravel(), mesh.nodes.shape[0])
        return Measure(float(mean @ direction), max(size, FAINT * largest), np.asarray(nodal, dtype=float))


@lru_cache(maxsize=1)
def locator(mesh: Mesh) -> Locator:
    """The last mesh's: several goals ask it."""
    return Locator(mesh)


@dataclass(frozen=True, slots=True)
class ForceGoal:
    """One component of the force or torque on some regions."""

    name: str
    regions: Collection[int]
    component: Component

    def measure(self, solution: Solution) -> Measure:
        weight = smooth_weight(solution.problem, self.regions)
        by_current = lorentz_force(solution, self.regions)
        if by_current is not None and not weight.defined:
            value = by_current.component(self.component)
            gradient = lorentz_gradient(solution, self.regions, self.component)
            own = float(np.abs(gradient * solution.psi).sum())
            whole = lorentz_scale(solution, self.regions, self.component)
        else:
            value = stress_force(solution, weight).component(self.component)
            gradient = stress_gradient(solution, weight, self.component)
            own, whole = stress_scale(solution, weight, self.component)
            if by_current is not None:
                whole = max(whole, lorentz_scale(solution, self.regions, self.component))
        return Measure(value, FORCE_SHARE * max(abs(value), NEXT_TO_NOTHING * own, FORBIDDEN * whole), gradient)
