"""A problem on a mapped mesh, as the kernels that work on its cells need it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from fluxbore.fem.asymptotic import Rim
from fluxbore.fem.cell_band import Places, places
from fluxbore.fem.cell_matrices import Precision
from fluxbore.fem.cells import Cells
from fluxbore.fem.factors import Factor
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.problem import MagneticMaterial, Problem
from fluxbore.fem.reluctivity import ReluctivityCurve

Linear = Callable[[Precision], Any]
"""What is made of the cells without iron, once for each precision."""


class CellKernels(Protocol):
    """What is done with all cells at once; unknowns are nodal (n,), those of nodes without freedom zero."""

    def residual(self, psi: Floats) -> tuple[Floats, Floats]:
        """(n,) internal minus external load (A), and the tensor (3, iron, points) of its derivative by B in the iron's
        cells, times the quadrature weights: along z, mixed, and along r."""
        ...

    def product(self, tensor: Floats, columns: Floats) -> Floats:
        """(n, k) the residual's derivative, of this tensor, times nodal fields (n, k)."""
        ...

    def linear(self, precision: Precision) -> Any:
        """What `factor` needs of the cells without iron; raises SingularMatrixError."""
        ...

    def factor(self, tensor: Floats, precision: Precision, linear: Any) -> Factor:
        """The residual's derivative, factorised; raises SingularMatrixError."""
        ...


@dataclass(frozen=True, eq=False)
class CellModel:
    """Materials are the same all over a region: linear and magnetised along z at most, or with a curve.

    rim : a condition on the far edges, where they are open. curves : each with which of `iron` are of it.
    """

    problem: Problem
    cells: Cells
    rim: Rim | None
    iron: Ints
    curves: list[tuple[ReluctivityCurve, slice]]

    @cached_property
    def others(self) -> Ints:
        """The cells without iron."""
        is_iron = np.zeros(self.cells.region.size, dtype=bool)
        is_iron[self.iron] = True
        return np.flatnonzero(~is_iron)

    @cached_property
    def free(self) -> Any:
        """(n,) whether a node's ψ is unknown."""
        return self.cells.grid.topology.freedom >= 0

    @cached_property
    def where(self) -> Places:
        """Where the cells land in the condensed matrix."""
        return places(self.cells.grid.topology, *self.cells.shape, self.cells.grid.order)

    @cached_property
    def reluctivity(self) -> tuple[Floats, Floats]:
        """ν_r and ν_z (m/H) of each cell (m,), zero in iron."""
        components = np.array([material.components for material in self.problem.materials]).T
        nu_r, nu_z = components[:, self.cells.region]
        return nu_r, nu_z

    @cached_property
    def load(self) -> Floats:
        """(n,) of magnets, ∫ H_c ∂_s v, and of currents (A)."""
        cells = self.cells
        coercivity = np.array([_coercivity(material) for material in self.problem.materials])[cells.region]
        magnets = np.flatnonzero(coercivity)
        pull = cells.pull_across(coercivity[magnets, None] * cells.weight[magnets], magnets)
        load = np.asarray(np.bincount(cells.nodes[magnets].ravel(), pull.ravel(), self.free.size), dtype=float)
        for circuit in (*self.problem.circuits, *self.problem.sources):
            if circuit.current:
                load += circuit.current * circuit.density
        return np.where(self.free, load, 0.0)


def cell_model(problem: Problem, grid: MappedMesh, rim: Rim | None) -> CellModel:
    """The iron's cells are gathered, grouped by curve."""
    assert all(_plain(material) for material in problem.materials)
    assert problem.prescribed is None
    assert problem.edges is None
    cells = Cells(grid)
    groups, curves, start = [], [], 0
    for index, material in enumerate(problem.materials):
        if material.curve is not None:
            groups.append(np.flatnonzero(cells.region == index))
            curves.append((material.curve, slice(start, start + groups[-1].size)))
            start += groups[-1].size
    return CellModel(problem, cells, rim, np.concatenate([np.zeros(0, dtype=int), *groups]), curves)


def _plain(material: MagneticMaterial) -> bool:
    """Whether a material is the same all over, and magnetised along z at most."""
    if material.stack is not None or material.grade is not None or callable(material.coercivity):
        return False
    return material.coercivity[0] == 0.0


def _coercivity(material: MagneticMaterial) -> float:
    return 0.0 if callable(material.coercivity) else material.coercivity[1]
