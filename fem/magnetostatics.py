"""Nonlinear magnetostatics: solve(problem) -> Solution."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fluxbore.fem.element import Kernel, flux_density_squared, kernel, stiffness
from fluxbore.fem.linear import Corrected, Factor, Method, factorise
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.newton import Convergence, newton
from fluxbore.fem.problem import Problem


@dataclass(frozen=True, slots=True)
class Settings:
    """Of the nonlinear solver. tolerance : of the residual relative to the load."""

    tolerance: float = 1e-8
    max_iterations: int = 60
    method: Method = "banded"


class System:
    """The discrete equations of a problem: what is linear is assembled once, iron at each step.

    Iron is a tenth of the elements, so a Newton step touches a tenth of them.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        mesh = problem.mesh
        self.freedom = mesh.topology.freedom
        self.inner = mesh.topology.nodes_of_freedom
        self.pattern = mesh.topology.pattern
        self.kernel: Kernel = kernel(mesh)
        self._assemble_linear()
        self._gather_iron()
        self.load = self._magnet_load()
        for circuit in problem.circuits:
            if circuit.current:
                self.load = self.load + circuit.current * circuit.density[self.inner]

    def _assemble_linear(self) -> None:
        region = self.problem.mesh.region
        reluctivity = np.array([0.0 if m.curve else m.reluctivity for m in self.problem.materials])[region]
        matrices = stiffness(self.kernel.curl, self.kernel.weight * reluctivity[:, None])
        self.linear = self.pattern.assemble(matrices)

    def _gather_iron(self) -> None:
        """The iron's elements, grouped by curve, and where their matrices land."""
        mesh = self.problem.mesh
        self.iron: list[tuple[int, slice]] = []
        order: list[Ints] = []
        start = 0
        for index, material in enumerate(self.problem.materials):
            if material.curve is None:
                continue
            elements = np.flatnonzero(mesh.region == index)
            order.append(elements)
            self.iron.append((index, slice(start, start + elements.size)))
            start += elements.size
        self.iron_elements = np.concatenate(order) if order else np.zeros(0, dtype=int)
        self.iron_nodes = mesh.elements[self.iron_elements]
        self.iron_curl = self.kernel.curl[self.iron_elements]
        self.iron_weight = self.kernel.weight[self.iron_elements]
        self.iron_sources, self.iron_targets = self.pattern.subset(self.iron_elements)

    def _magnet_load(self) -> Floats:
        """∫ ν B_rem · B(v), with B_rem in the kernel's frame."""
        mesh = self.problem.mesh
        frame = np.zeros((len(self.problem.materials), 2))
        for index, material in enumerate(self.problem.materials):
            first, second = material.remanence
            # Row 0 of the kernel is B_z (or −B_y), row 1 is −B_r (or B_x).
            frame[index] = (second, -first) if mesh.chart == "axisymmetric" else (-second, first)
            frame[index] *= material.reluctivity
        magnets = np.flatnonzero(np.any(frame[mesh.region] != 0, axis=1))
        pull = np.einsum(
            "mqkn,mq,mk->mn",
            self.kernel.curl[magnets],
            self.kernel.weight[magnets],
            frame[mesh.region[magnets]],
            optimize=True,
        )
        load = np.bincount(mesh.elements[magnets].ravel(), pull.ravel(), mesh.nodes.shape[0])
        return np.asarray(load[self.inner])

    def spread(self, unknowns: Floats) -> Floats:
        """(n,) nodal ψ from the unknowns; zero where it is prescribed."""
        psi = np.zeros(self.freedom.size)
        psi[self.inner] = unknowns
        return psi

    def _iron_state(self, unknowns: Floats) -> tuple[Floats, Floats, Floats]:
        """B (m, q, 2), ν and dν/d|B|² (m, q) in the iron's elements."""
        psi = self.spread(unknowns)[self.iron_nodes]
        field, squared = flux_density_squared(self.iron_curl, psi)
        nu, slope = np.empty_like(squared), np.empty_like(squared)
        for index, part in self.iron:
            curve = self.problem.materials[index].curve
            assert curve is not None
            nu[part], slope[part] = curve.reluctivity(squared[part])
        return field, nu, slope

    def residual(self, unknowns: Floats) -> Floats:
        """Internal minus external load (A), one per unknown."""
        forces = self.pattern.multiply(self.linear, unknowns) - self.load
        if self.iron_elements.size:
            field, nu, _ = self._iron_state(unknowns)
            pull = np.einsum("mqkn,mqk->mn", self.iron_curl, field * (nu * self.iron_weight)[..., None], optimize=True)
            forces += np.bincount(self.iron_nodes.ravel(), pull.ravel(), self.freedom.size)[self.inner]
        return forces

    def tangent_values(self, unknowns: Floats) -> Floats:
        """(nnz,) of the residual's derivative: ∫ (ν + 2 dν/d|B|² B⊗B) B(v)·B(w)."""
        values = self.linear.copy()
        if self.iron_elements.size:
            field, nu, slope = self._iron_state(unknowns)
            m, q, _, six = self.iron_curl.shape
            along = np.einsum("mqkn,mqk->mqn", self.iron_curl, field, optimize=True)
            rows = np.concatenate((self.iron_curl.reshape(m, 2 * q, six), along), axis=1)
            factor = np.concatenate((np.repeat(nu * self.iron_weight, 2, axis=1), 2 * slope * self.iron_weight), axis=1)
            matrices = rows.transpose(0, 2, 1) @ (rows * factor[..., None])
            values += np.bincount(self.iron_targets, matrices.ravel()[self.iron_sources], values.size)
        return values


@dataclass(frozen=True, eq=False)
class Solution:
    """The field of a problem.

    psi : (n,) r·A_φ (Wb/rad) or A (Wb/m) at the nodes. convergence : look here first; a field that did not converge
    is kept for inspection.
    """

    problem: Problem
    psi: Floats
    convergence: Convergence
    system: System
    method: Method
    last_factor: Factor | None

    @cached_property
    def tangent(self) -> Factor:
        """The tangent at the solution, ready to solve with: one solution gives any incremental figure."""
        values = self.system.tangent_values(self.psi[self.system.inner])
        if self.last_factor is None:
            return factorise(self.system.pattern, values, self.method)
        return Corrected(self.system.pattern, values, self.last_factor, self.method)

    def flux_density(self, elements: Ints | None = None) -> Floats:
        """(m, q, 2) B in the kernel's frame, at the quadrature points of all or of some elements."""
        chosen = slice(None) if elements is None else elements
        field, _ = flux_density_squared(self.system.kernel.curl[chosen], self.psi[self.problem.mesh.elements[chosen]])
        return field


def solve(problem: Problem, settings: Settings | None = None, start: Floats | None = None) -> Solution:
    """Solve a magnetostatic problem.

    start : (n,) nodal ψ to begin from, such as a neighbouring position's on the same topology; zero without it.

    A failure to converge is in the solution's ``convergence``.
    """
    settings = settings or Settings()
    system = System(problem)
    first = np.zeros(system.inner.size) if start is None else start[system.inner]
    unknowns, convergence, factor = newton(
        system.residual,
        lambda x: factorise(system.pattern, system.tangent_values(x), settings.method),
        first,
        float(np.linalg.norm(system.load)),
        settings.tolerance,
        settings.max_iterations,
    )
    return Solution(problem, system.spread(unknowns), convergence, system, settings.method, factor)
