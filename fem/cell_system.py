"""The discrete equations of a mapped mesh's cells: what is linear is made once, iron at each of Newton's steps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from fluxbore.fem.asymptotic import Rim
from fluxbore.fem.cell_band import CellFactor, Places, places
from fluxbore.fem.cell_matrices import Condensed, Precision, cell_matrices, condensed, linear_condensed
from fluxbore.fem.cells import Cells
from fluxbore.fem.element import Kernels
from fluxbore.fem.factors import Factor, SingularMatrixError
from fluxbore.fem.linear import Method, check_finite
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.newton import solved
from fluxbore.fem.plain_cells import PlainFactor
from fluxbore.fem.problem import MagneticMaterial, Problem
from fluxbore.fem.refined import Refined


@dataclass(frozen=True, slots=True, eq=False)
class _State:
    """At ψ (n,): B's two components in all cells (m, points), and of the iron's cells ν and 2 dν/d|B|², times the
    quadrature weights (iron, points)."""

    psi: Floats
    b_z: Floats
    b_r: Floats
    nu: Floats
    bent: Floats


Linear = Callable[[Precision], tuple[Condensed, Any]]


class CellSystem(Kernels):
    """The equations of a problem on a mapped mesh; unknowns are nodal (n,), those of nodes without freedom zero.

    Materials are the same all over a region: linear and magnetised along z at most, or with a curve.
    """

    def __init__(self, problem: Problem, grid: MappedMesh, rim: Rim | None = None) -> None:
        """rim : a condition on the far edges, where they are open."""
        super().__init__(problem.mesh)
        assert all(_plain(material) for material in problem.materials)
        assert problem.prescribed is None
        assert problem.edges is None
        self.problem, self.cells, self.rim = problem, Cells(grid), rim
        self._free = grid.topology.freedom >= 0
        self._where: Places = places(grid.topology, *grid.shape, grid.order)
        self._gather_iron()
        # Iron counts as nothing here.
        components = np.array([material.components for material in problem.materials]).T
        self._nu_r, self._nu_z = components[:, self.cells.region]
        self._linear_r, self._linear_z = (nu[:, None] * self.cells.weight for nu in (self._nu_r, self._nu_z))
        load = self._magnet_load()
        for circuit in (*problem.circuits, *problem.sources):
            if circuit.current:
                load += circuit.current * circuit.density
        self.load = np.where(self._free, load, 0.0)
        self._state: _State | None = None

    def _gather_iron(self) -> None:
        """The iron's cells, grouped by curve; all others."""
        region = self.cells.region
        groups = [
            (index, np.flatnonzero(region == index))
            for index, material in enumerate(self.problem.materials)
            if material.curve is not None
        ]
        starts = np.cumsum([0, *(group.size for _, group in groups)])
        self.iron = [(index, slice(*starts[k : k + 2])) for k, (index, _) in enumerate(groups)]
        self._iron_cells = np.concatenate([np.zeros(0, dtype=int), *(group for _, group in groups)])
        is_iron = np.zeros(region.size, dtype=bool)
        is_iron[self._iron_cells] = True
        self._other_cells = np.flatnonzero(~is_iron)

    def _magnet_load(self) -> Floats:
        """(n,) ∫ H_c ∂_s v."""
        cells = self.cells
        coercivity = np.array([_coercivity(material) for material in self.problem.materials])[cells.region]
        magnets = np.flatnonzero(coercivity)
        return self._scattered(magnets, cells.pull_across(coercivity[magnets, None] * cells.weight[magnets], magnets))

    def _scattered(self, chosen: Ints | slice, nodal: Floats) -> Floats:
        """(n,) sums at the nodes of cells' (m, nodes)."""
        found = np.bincount(self.cells.nodes[chosen].ravel(), nodal.ravel(), self._free.size)
        return np.asarray(found, dtype=float)

    def _linear(self, precision: Precision) -> tuple[Condensed, Any]:
        """The cells without iron, and the band of their edges and the rim's."""
        others = self._other_cells
        found = linear_condensed(self.cells, others, self._nu_r[others], self._nu_z[others], precision)
        band = self._where.empty_band(precision)
        self._where.entries(others).add(band, found.edge)
        if self.rim is not None:
            self._where.entries_of(self.rim.nodes).add(band, self.rim.matrices)
        return found, band

    def unknowns(self, psi: Floats | None) -> Floats:
        """Newton's from nodal ψ; all zero without."""
        return np.zeros(self._free.size) if psi is None else np.where(self._free, psi, 0.0)

    def spread(self, unknowns: Floats) -> Floats:
        """(n,) nodal ψ."""
        return unknowns

    def response(self, factor: Factor, load: Floats, accuracy: float) -> Floats:
        """(n, k) nodal, what a factorised matrix gives for nodal loads (n, k)."""
        return solved(factor, np.where(self._free[:, None], load, 0.0), accuracy)

    def _at(self, psi: Floats) -> _State:
        """The last state is kept: a residual and its tangent ask for the same."""
        if self._state is None or not np.array_equal(self._state.psi, psi):
            iron = self._iron_cells
            b_z, b_r = self.cells.fields(psi)
            squared = b_z[iron] ** 2 + b_r[iron] ** 2
            nu, slope = np.empty_like(squared), np.empty_like(squared)
            for index, part in self.iron:
                curve = self.problem.materials[index].curve
                assert curve is not None
                nu[part], slope[part] = curve.reluctivity(squared[part])
            weight = self.cells.weight[iron]
            self._state = _State(psi, b_z, b_r, nu * weight, 2 * slope * weight)
        return self._state

    def residual(self, psi: Floats) -> Floats:
        """Internal minus external load (A), by node."""
        state, iron = self._at(psi), self._iron_cells
        h_z, h_r = self._linear_z * state.b_z, self._linear_r * state.b_r
        h_z[iron], h_r[iron] = state.nu * state.b_z[iron], state.nu * state.b_r[iron]
        return np.where(self._free, self._pulled(h_z, h_r, psi) - self.load, 0.0)

    def _pulled(self, h_z: Floats, h_r: Floats, psi: Floats) -> Floats:
        """(n,) ∫ H·B(v) of H times weights (m, points), and what the rim adds."""
        forces = self._scattered(slice(None), self.cells.pull_across(h_z) + self.cells.pull_along(h_r))
        if self.rim is not None:
            self.rim.add_forces(forces, psi)
        return forces

    def _multiplied(self, state: _State, columns: Floats) -> Floats:
        """(n, k) the tangent at a state times nodal fields (n, k)."""
        iron = self._iron_cells
        b_z, b_r = state.b_z[iron], state.b_r[iron]
        found = np.empty_like(columns)
        for k in range(columns.shape[1]):
            u_z, u_r = self.cells.fields(columns[:, k])
            h_z, h_r = self._linear_z * u_z, self._linear_r * u_r
            along = state.bent * (b_z * u_z[iron] + b_r * u_r[iron])
            h_z[iron], h_r[iron] = state.nu * u_z[iron] + along * b_z, state.nu * u_r[iron] + along * b_r
            found[:, k] = self._pulled(h_z, h_r, columns[:, k])
        return np.where(self._free[:, None], found, 0.0)

    def tangent_product(self, psi: Floats, columns: Floats) -> Floats:
        """(n, k) the residual's derivative at ψ times nodal fields (n, k)."""
        return self._multiplied(self._at(psi), columns)

    def tangents(self, method: Method) -> Callable[[Floats], Factor]:
        """Factorises the residual's derivative at ψ; raises SingularMatrixError."""
        linear = self._remembered()
        return lambda psi: self._tangent(psi, None, method, linear)

    def tangent_at(self, psi: Floats, neighbour: Factor | None, method: Method) -> Factor:
        """The residual's derivative at ψ, ready to solve with, by a factor that is near where there is one."""
        return self._tangent(psi, neighbour, method, self._remembered())

    def _remembered(self) -> Linear:
        """`_linear`, made once for each precision: as long as Newton's steps need it, for it is half of the memory."""
        made: dict[Precision, tuple[Condensed, Any]] = {}

        def linear(precision: Precision) -> tuple[Condensed, Any]:
            if precision not in made:
                made[precision] = self._linear(precision)
            return made[precision]

        return linear

    def _tangent(self, psi: Floats, neighbour: Factor | None, method: Method, linear: Linear) -> Factor:
        state = self._at(psi)
        if method == "superlu":
            return self._plain_factor(state)
        rough = neighbour.factor if isinstance(neighbour, Refined) else self._factor(state, np.float32, linear)
        return Refined(
            lambda columns: self._multiplied(state, columns),
            rough,
            lambda: self._factor(state, np.float64, self._linear),
        )

    def _iron_tensor(self, state: _State) -> tuple[Floats, Floats, Floats]:
        """Of ∫ (ν + 2 dν/d|B|² B⊗B) B(v)·B(w) in the iron, the tensor's parts: along z, mixed, and along r."""
        check_finite(state.nu)
        check_finite(state.bent)
        b_z, b_r = state.b_z[self._iron_cells], state.b_r[self._iron_cells]
        return state.nu + state.bent * b_z**2, state.bent * b_z * b_r, state.nu + state.bent * b_r**2

    def _factor(self, state: _State, precision: Precision, linear: Linear) -> Factor:
        """In single precision, in double where the matrix asks for it."""
        try:
            inside, band = self._iron_and_band(state, precision, linear)
            others, _ = linear(precision)
            return CellFactor(self._where, band, ((self._other_cells, others), (self._iron_cells, inside)))
        except SingularMatrixError:
            if precision is np.float64:
                raise
            return self._factor(state, np.float64, linear)

    def _iron_and_band(self, state: _State, precision: Precision, linear: Linear) -> tuple[Condensed, Any]:
        """The iron's cells condensed, and the band of all cells' edges."""
        matrices = cell_matrices(self.cells, self._iron_cells, *self._iron_tensor(state), precision)
        inside = condensed(self.cells.square, matrices)
        band = linear(precision)[1].copy()
        self._where.entries(self._iron_cells).add(band, inside.edge)
        return inside, band

    def condensed_band(self, psi: Floats, precision: Precision) -> Any:
        """(k, bandwidth + 1) the lower triangle of the condensed tangent at ψ, by columns from the diagonal down."""
        return self._iron_and_band(self._at(psi), precision, self._linear)[1]

    def _plain_factor(self, state: _State) -> Factor:
        """The whole matrix, by general means."""
        across, along, mixed = self._linear_z.copy(), self._linear_r.copy(), np.zeros_like(self._linear_z)
        across[self._iron_cells], mixed[self._iron_cells], along[self._iron_cells] = self._iron_tensor(state)
        whole = cell_matrices(self.cells, np.arange(self.cells.region.size), across, mixed, along)
        return PlainFactor(self.cells.nodes, self._free, whole, self.rim)


def _plain(material: MagneticMaterial) -> bool:
    """Whether a material is the same all over, and magnetised along z at most."""
    if material.stack is not None or material.grade is not None or callable(material.coercivity):
        return False
    return material.coercivity[0] == 0.0


def _coercivity(material: MagneticMaterial) -> float:
    return 0.0 if callable(material.coercivity) else material.coercivity[1]
