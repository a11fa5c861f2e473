"""The discrete equations of a mapped mesh's cells, for Newton and all who read a solution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from fluxbore.fem.asymptotic import Rim
from fluxbore.fem.cell_arrays import CellArrays
from fluxbore.fem.cell_matrices import Precision
from fluxbore.fem.cell_model import CellKernels, CellModel, Linear, cell_model
from fluxbore.fem.cell_native import ORDER, CellNative
from fluxbore.fem.element import Kernels
from fluxbore.fem.factors import Factor, SingularMatrixError
from fluxbore.fem.linear import Method
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats
from fluxbore.fem.native import functions
from fluxbore.fem.newton import solved
from fluxbore.fem.problem import Problem
from fluxbore.fem.refined import Refined


@dataclass(frozen=True, slots=True, eq=False)
class _State:
    """The residual (n,) at ψ (n,), and the tensor of its derivative in the iron."""

    psi: Floats
    residual: Floats
    tensor: Floats


class CellSystem(Kernels):
    """The equations of a problem on a mapped mesh; unknowns are nodal (n,), those of nodes without freedom zero.

    Materials are the same all over a region: linear and magnetised along z at most, or with a curve.
    """

    def __init__(self, problem: Problem, grid: MappedMesh, rim: Rim | None = None) -> None:
        """rim : a condition on the far edges, where they are open."""
        super().__init__(problem.mesh)
        self.problem, self.rim = problem, rim
        self._model = cell_model(problem, grid, rim)
        self.cells, self.load, self.has_iron = self._model.cells, self._model.load, self._model.iron.size > 0
        self._arrays = CellArrays(self._model)
        self._single = _in_single_precision(self._model) or self._arrays
        self._state: _State | None = None

    def unknowns(self, psi: Floats | None) -> Floats:
        """Newton's from nodal ψ; all zero without."""
        return np.zeros(self.load.size) if psi is None else np.where(self._model.free, psi, 0.0)

    def spread(self, unknowns: Floats) -> Floats:
        """(n,) nodal ψ."""
        return unknowns

    def response(self, factor: Factor, load: Floats, accuracy: float) -> Floats:
        """(n, k) nodal, what a factorised matrix gives for nodal loads (n, k)."""
        return solved(factor, np.where(self._model.free[:, None], load, 0.0), accuracy)

    def _at(self, psi: Floats) -> _State:
        """The last state is kept: a residual and its tangent ask for the same."""
        state = self._state
        if state is None or not (psi is state.psi or np.array_equal(state.psi, psi)):
            state = self._state = _State(psi, *self._single.residual(psi))
        return state

    def residual(self, psi: Floats) -> Floats:
        """Internal minus external load (A), by node."""
        return self._at(psi).residual

    def tangent_product(self, psi: Floats, columns: Floats) -> Floats:
        """(n, k) the residual's derivative at ψ times nodal fields (n, k)."""
        return self._single.product(self._at(psi).tensor, columns)

    def tangents(self, method: Method) -> Callable[[Floats], Factor]:
        """Factorises the residual's derivative at ψ; raises SingularMatrixError."""
        linear = self._remembered()
        return lambda psi: self._tangent(psi, None, method, linear)

    def tangent_at(self, psi: Floats, neighbour: Factor | None, method: Method) -> Factor:
        """The residual's derivative at ψ, ready to solve with, by a factor that is near where there is one."""
        return self._tangent(psi, neighbour, method, self._remembered())

    def _by(self, precision: Precision) -> CellKernels:
        return self._single if precision is np.float32 else self._arrays

    def _remembered(self) -> Linear:
        """What is linear, made once for each precision: as long as Newton's steps need it, for it is half of the
        memory."""
        made: dict[Precision, Any] = {}

        def linear(precision: Precision) -> Any:
            if precision not in made:
                made[precision] = self._by(precision).linear(precision)
            return made[precision]

        return linear

    def _tangent(self, psi: Floats, neighbour: Factor | None, method: Method, linear: Linear) -> Factor:
        tensor = self._at(psi).tensor
        if method == "superlu":
            return self._arrays.plain_factor(tensor)
        rough = neighbour.factor if isinstance(neighbour, Refined) else self._factor(tensor, np.float32, linear)
        return Refined(
            lambda columns: self._single.product(tensor, columns),
            rough,
            lambda: self._factor(tensor, np.float64, self._remembered()),
        )

    def _factor(self, tensor: Floats, precision: Precision, linear: Linear) -> Factor:
        """In single precision, in double where the matrix asks for it."""
        try:
            return self._by(precision).factor(tensor, precision, linear(precision))
        except SingularMatrixError:
            if precision is np.float64:
                raise
            return self._factor(tensor, np.float64, linear)


def _in_single_precision(model: CellModel) -> CellKernels | None:
    """Compiled, where they are and know the cells."""
    compiled = functions()
    return CellNative(model, compiled) if compiled is not None and model.cells.square.order == ORDER else None
