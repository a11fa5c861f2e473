"""Figures that refinement can be asked to make accurate."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from fluxbore.fem.adapt import Measure
from fluxbore.fem.body_force import Component, stress_force, stress_gradient, stress_scale
from fluxbore.fem.energy import energies
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.weight import smooth_weight

NEXT_TO_NOTHING = 0.02
"""A force or linkage below this share of what its parts add up to without their signs is held against that share."""


@dataclass(frozen=True, slots=True)
class EnergyGoal:
    """The field's energy, which bounds every figure that is a scalar product with the load."""

    name: str = "energy"

    def measure(self, solution: Solution) -> Measure:
        energy, coenergy = energies(solution)
        return Measure(energy, max(abs(energy), abs(coenergy)), None)


@dataclass(frozen=True, slots=True)
class LinkageGoal:
    """Flux linkage of a circuit. index : of the problem's circuits."""

    name: str
    index: int

    def measure(self, solution: Solution) -> Measure:
        gradient = solution.problem.extent * solution.problem.circuits[self.index].density
        shares = gradient * solution.psi
        value = float(shares.sum())
        return Measure(value, max(abs(value), NEXT_TO_NOTHING * float(np.abs(shares).sum())), gradient)


@dataclass(frozen=True, slots=True)
class ForceGoal:
    """One component of the force or torque on some regions."""

    name: str
    regions: Collection[int]
    component: Component

    def measure(self, solution: Solution) -> Measure:
        weight = smooth_weight(solution.problem, self.regions)
        found = stress_force(solution, weight)
        value = {"x": found.force[0], "y": found.force[1], "z": found.force[1], "torque": found.torque}[self.component]
        whole = stress_scale(solution, weight, self.component)
        return Measure(
            value, max(abs(value), NEXT_TO_NOTHING * whole), stress_gradient(solution, weight, self.component)
        )
