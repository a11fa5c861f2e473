"""Nonlinear magnetostatics: solve(problem) -> Solution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from fluxbore.fem.element import (
    QUADRATURE_WEIGHTS,
    Kernel,
    Kernels,
    flux_density_squared,
    positions,
    stiffness,
    to_frame,
)
from fluxbore.fem.factors import Factor
from fluxbore.fem.linear import Corrected, Method, Tangents, factorise
from fluxbore.fem.mesh import Floats, Ints, Mesh
from fluxbore.fem.newton import ROUGHEST, Convergence, newton, solved
from fluxbore.fem.problem import MagneticMaterial, Problem, Stack


@dataclass(frozen=True, slots=True)
class Settings:
    """Of the nonlinear solver. tolerance : of the residual relative to the load."""

    tolerance: float = 1e-8
    max_iterations: int = 60
    method: Method = "banded"


class Equations(Protocol):
    """The discrete equations of a problem, as Newton and all who read a solution need them.

    load : (unknowns,).
    """

    problem: Problem
    load: Floats

    @property
    def has_iron(self) -> bool: ...

    @property
    def kernel(self) -> Kernel: ...

    def kernel_of(self, elements: Ints) -> Kernel: ...

    def unknowns(self, psi: Floats | None) -> Floats: ...

    def spread(self, unknowns: Floats) -> Floats: ...

    def response(self, factor: Factor, load: Floats, accuracy: float) -> Floats: ...

    def residual(self, unknowns: Floats) -> Floats: ...

    def tangents(self, method: Method) -> Callable[[Floats], Factor]: ...

    def tangent_at(self, unknowns: Floats, neighbour: Factor | None, method: Method) -> Factor: ...


class System(Kernels):
    """The discrete equations of a problem: what is linear is assembled once, iron at each step.

    Iron is a tenth of the elements, so a Newton step touches a tenth of them.
    """

    def __init__(self, problem: Problem) -> None:
        mesh = problem.mesh
        super().__init__(mesh)
        self.problem = problem
        self.topology = mesh.topology
        self.inner = self.topology.nodes_of_freedom
        self.pattern = self.topology.pattern
        load = self._magnet_load()
        for circuit in (*problem.circuits, *problem.sources):
            if circuit.current:
                load += circuit.current * circuit.density
        if problem.edges is not None:
            load += problem.edges.load
        load -= self._assemble_linear()
        self.load = self.topology.gather(load)
        self._gather_iron()
        self._state: tuple[Floats, tuple[Floats, Floats, Floats]] | None = None

    @cached_property
    def linear_factor(self) -> Floats:
        """ν of the linear part times quadrature weight: (m, q), or (m, q, 2) where a material has a direction."""
        return self._linear_factor()

    @property
    def has_iron(self) -> bool:
        """Whether the problem is nonlinear."""
        return bool(self.iron)

    def _assemble_linear(self) -> Floats:
        """The linear part of the matrix; returns (n,) what the prescribed ψ pulls on through it."""
        problem = self.problem
        mesh = problem.mesh
        matrices = stiffness(self.kernel.curl, self.linear_factor)
        if problem.edges is not None:
            np.add.at(matrices, problem.edges.elements, problem.edges.matrices)
        self.linear = self.pattern.assemble(matrices)
        if problem.prescribed is None or not problem.prescribed.any():
            return np.zeros(mesh.nodes.shape[0])
        fixed = np.where(self.topology.freedom < 0, problem.prescribed, 0.0)
        pull = np.einsum("mnk,mk->mn", matrices, fixed[mesh.elements], optimize=True)
        return np.asarray(np.bincount(mesh.elements.ravel(), pull.ravel(), mesh.nodes.shape[0]))

    def _linear_factor(self) -> Floats:
        mesh, materials = self.problem.mesh, self.problem.materials
        first, second = np.array([material.components for material in materials]).reshape(-1, 2).T
        # Row 0 of the kernel is B_z or −B_y, row 1 is −B_r or B_x.
        factor: Floats = self.kernel.weight * second[mesh.region][:, None]
        if np.any(first != second):
            factor = np.stack((factor, self.kernel.weight * first[mesh.region][:, None]), axis=-1)
        for index, material in enumerate(materials):
            if material.grade is not None:
                elements = np.flatnonzero(mesh.region == index)
                grade = material.grade.factor(positions(mesh, elements))
                factor[elements] *= grade if factor.ndim == 2 else grade[..., None]
        return factor

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
        found = self.kernel_of(self.iron_elements)
        self.iron_curl, self.iron_weight = found.curl, found.weight
        for index, part in self.iron:
            stack = self.problem.materials[index].stack
            if stack is not None:
                self.iron_curl[part] *= in_sheets(stack)[:, None]
                self.iron_weight[part] *= stack.fill
        self.iron_gather = self.pattern.subset_assembler(self.iron_elements)

    def _magnet_load(self) -> Floats:
        """(n,)  ∫ H_c · B(v), with H_c in the kernel's frame."""
        mesh = self.problem.mesh
        load = np.zeros(mesh.nodes.shape[0])
        for index, material in enumerate(self.problem.materials):
            if material.coercivity == (0.0, 0.0):
                continue
            elements = np.flatnonzero(mesh.region == index)
            pull = np.einsum(
                "mqkn,mqk->mn",
                self.kernel.curl[elements],
                self.kernel.weight[elements][..., None] * coercive_field(mesh, material, elements),
                optimize=True,
            )
            load += np.bincount(mesh.elements[elements].ravel(), pull.ravel(), load.size)
        return load

    def unknowns(self, psi: Floats | None) -> Floats:
        """Of nodal ψ; zero without."""
        return np.zeros(self.inner.size) if psi is None else psi[self.inner]

    def spread(self, unknowns: Floats) -> Floats:
        """(n,) nodal ψ from the unknowns, with the prescribed values."""
        return self.topology.spread(unknowns, self.problem.prescribed)

    def response(self, factor: Factor, load: Floats, accuracy: float) -> Floats:
        """(n, k) nodal, what a factorised matrix gives for nodal loads (n, k)."""
        found = solved(factor, np.column_stack([self.topology.gather(column) for column in load.T]), accuracy)
        return np.column_stack([self.topology.spread(column) for column in found.T])

    def tangents(self, method: Method) -> Callable[[Floats], Factor]:
        """Makes the residual's derivative ready to solve with; raises SingularMatrixError."""
        return Tangents(self.pattern, self.tangent_values, method)

    def tangent_at(self, unknowns: Floats, neighbour: Factor | None, method: Method) -> Factor:
        """The same at one point, by a factor that is near where there is one."""
        values = self.tangent_values(unknowns)
        if neighbour is None:
            return factorise(self.pattern, values, method)
        return Corrected(self.pattern, values, neighbour, method)

    def _iron_state(self, unknowns: Floats) -> tuple[Floats, Floats, Floats]:
        """B (m, q, 2), ν and dν/d|B|² (m, q) in the iron's elements. The last one is kept: a residual and its tangent
        ask for the same."""
        if self._state is None or not np.array_equal(self._state[0], unknowns):
            self._state = unknowns, self._evaluated(unknowns)
        return self._state[1]

    def _evaluated(self, unknowns: Floats) -> tuple[Floats, Floats, Floats]:
        psi = self.spread(unknowns)[self.iron_nodes]
        m, q, _, six = self.iron_curl.shape
        field = (self.iron_curl.reshape(m, 2 * q, six) @ psi[..., None]).reshape(m, q, 2)
        squared = field[..., 0] ** 2 + field[..., 1] ** 2
        nu, slope = np.empty_like(squared), np.empty_like(squared)
        for index, part in self.iron:
            curve = self.problem.materials[index].curve
            assert curve is not None
            nu[part], slope[part] = curve.reluctivity(squared[part])
        return field, nu, slope

    @cached_property
    def _linear_matrix(self) -> Any:
        return self.pattern.matrix(self.linear)

    def residual(self, unknowns: Floats) -> Floats:
        """Internal minus external load (A), one per unknown."""
        forces = np.asarray(self._linear_matrix @ unknowns) - self.load
        if self.iron_elements.size:
            field, nu, _ = self._iron_state(unknowns)
            m, q, _, six = self.iron_curl.shape
            strength = (field * (nu * self.iron_weight)[..., None]).reshape(m, 1, 2 * q)
            pull = (strength @ self.iron_curl.reshape(m, 2 * q, six))[:, 0]
            nodal = np.bincount(self.iron_nodes.ravel(), pull.ravel(), self.topology.freedom.size)
            forces += self.topology.gather(np.asarray(nodal, dtype=float))
        return forces

    def tangent_values(self, unknowns: Floats) -> Floats:
        """(nnz,) of the residual's derivative: ∫ (ν + 2 dν/d|B|² B⊗B) B(v)·B(w)."""
        values = self.linear.copy()
        if self.iron_elements.size:
            field, nu, slope = self._iron_state(unknowns)
            m, q, _, six = self.iron_curl.shape
            along = (field[:, :, None] @ self.iron_curl)[:, :, 0]
            rows = np.concatenate((self.iron_curl.reshape(m, 2 * q, six), along), axis=1)
            factor = np.concatenate((np.repeat(nu * self.iron_weight, 2, axis=1), 2 * slope * self.iron_weight), axis=1)
            matrices = rows.transpose(0, 2, 1) @ (rows * factor[..., None])
            values += self.iron_gather.assemble(matrices)
        return values


def in_sheets(stack: Stack) -> Floats:
    """(2,) flux density inside the sheets per flux density of the stack, by row of the kernel's frame."""
    rows = np.ones(2)
    rows[1 - stack.along] = 1 / stack.fill
    return rows


def coercive_field(mesh: Mesh, material: MagneticMaterial, elements: Ints) -> Floats:
    """(m, q, 2) H_c (A/m) of a magnet's elements at the quadrature points, in the kernel's frame."""
    if callable(material.coercivity):
        return to_frame(mesh.chart, material.coercivity(positions(mesh, elements)))
    constant = to_frame(mesh.chart, np.array(material.coercivity))
    return np.broadcast_to(constant, (elements.size, QUADRATURE_WEIGHTS.size, 2))


@dataclass(frozen=True, eq=False)
class Solution:
    """The field of a problem.

    psi : (n,) r·A_φ (Wb/rad) or A (Wb/m) at the nodes. convergence : look here first; a field that did not converge
    is kept for inspection.
    """

    problem: Problem
    psi: Floats
    convergence: Convergence
    system: Equations
    method: Method
    last_factor: Factor | None

    @property
    def triangles(self) -> System:
        """The equations of a general mesh's elements."""
        assert isinstance(self.system, System)
        return self.system

    @cached_property
    def tangent(self) -> Factor:
        """The tangent at the solution, ready to solve with: one solution gives any incremental figure."""
        return self.system.tangent_at(self.system.unknowns(self.psi), self.last_factor, self.method)

    def response(self, load: Floats, accuracy: float = 0.0) -> Floats:
        """K_T⁻¹ times nodal loads (n,) or (n, k), as nodal fields: zero where ψ is prescribed.

        accuracy : of the residual relative to the load; as good as it gets without.
        """
        found = self.system.response(self.tangent, load.reshape(load.shape[0], -1), accuracy)
        return found.reshape(load.shape)

    def flux_density(self, elements: Ints | None = None) -> Floats:
        """(m, q, 2) B in the kernel's frame, at the quadrature points of all or of some elements."""
        connectivity = self.problem.mesh.elements
        if elements is None:
            field, _ = flux_density_squared(self.system.kernel.curl, self.psi[connectivity])
        else:
            field, _ = flux_density_squared(self.system.kernel_of(elements).curl, self.psi[connectivity[elements]])
        return field


def solve(
    problem: Problem, settings: Settings | None = None, start: Floats | None = None, system: Equations | None = None
) -> Solution:
    """Solve a magnetostatic problem.

    start : (n,) nodal ψ to begin from, such as a neighbouring position's on the same topology; zero without it.
    system : the problem's equations; those of its mesh's triangles without.

    A failure to converge is in the solution's ``convergence``.
    """
    settings = settings or Settings()
    system = System(problem) if system is None else system
    first = system.unknowns(start)
    unknowns, convergence, factor = newton(
        system.residual,
        system.tangents(settings.method),
        first,
        # Without a load, of a model of iron alone, the prescribed potentials are what drives it.
        float(np.linalg.norm(system.load)) or float(np.linalg.norm(system.residual(np.zeros_like(first)))),
        settings.tolerance,
        settings.max_iterations,
        ROUGHEST if system.has_iron else 0.0,
    )
    return Solution(problem, system.spread(unknowns), convergence, system, settings.method, factor)
