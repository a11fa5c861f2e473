"""Adjoint gradients of a tubular machine's figures by all that is continuous in its cross-section.

At each position two groups of back-substitutions with the tangent of the converged field, which Newton has left
factorised, and one pass over the elements serve all figures: no matrix is factorised for a gradient.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from fluxbore.fem.adjoint import Linearisation
from fluxbore.fem.asymptotic import OpenRim
from fluxbore.fem.cell_force import shell_pull
from fluxbore.fem.coil_windows import Windows
from fluxbore.fem.functionals import Functional
from fluxbore.fem.mapped import breakpoint_derivative
from fluxbore.fem.mesh import Floats
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY
from fluxbore.fem.tubular import TubularSolution, space_vector

ACCURACY = 1e-11
"""Of adjoint fields, and so of gradients: relative residual."""

_ANGLES = 2 * np.pi / 3 * np.arange(3)
_CLARKE = np.column_stack((np.cos(_ANGLES), np.sin(_ANGLES)))
"""(3, 2) phase values of the two axes, α and β."""


class TubularAdjoint:
    """One position's solution, prepared for gradients."""

    def __init__(self, tubular: TubularSolution) -> None:
        self.tubular = tubular
        solution = tubular.solution
        self._densities = np.column_stack([circuit.density for circuit in solution.problem.circuits])
        self._pull = tubular.pull

    @cached_property
    def linearisation(self) -> Linearisation:
        return Linearisation(self.tubular.solution, self.tubular.cells)

    @cached_property
    def _windows(self) -> Windows:
        return Windows(self.tubular.grid, self.tubular.section.coils)

    @cached_property
    def _rim(self) -> OpenRim:
        return OpenRim(self.tubular.grid, self.tubular.section.ends)

    @cached_property
    def _axes(self) -> Floats:
        """(n, 2) K_T⁻¹ times the load of one ampere in either of Clarke's axes."""
        return self._solved(self._densities @ _CLARKE)

    def force_constant(self) -> Functional:
        """3/2 |K_αβ| (N/A) of the incremental thrust constants.

        With x the phases' responses weighted by ∂/∂K_ph it is, to first order, xᵀ G ψ: of the force's gradient, of the
        currents' load and, against both, of the tangent.
        """
        tubular = self.tubular
        vector = space_vector(tubular.thrust_constants())
        axes = _by_axis(np.conj(vector) / (abs(vector) or 1.0))
        response, x = tubular.response, self._axes @ axes
        derivative, by_psi = self.linearisation.tangent(x, response)
        s, z = self._stress(float(x @ self._pull))
        load = self._windows.derivative(self._by_phase(_CLARKE @ axes, response))
        rim = self._rim.derivative(x[:, None], response[:, None])
        return Functional(
            1.5 * abs(vector),
            shell_pull(tubular.cells, tubular.section.force_annulus, x) - by_psi,
            s + (load.s - derivative.s - rim.s)[:, 0],
            z + (load.z - derivative.z - rim.z)[:, 0],
            windows=load.windows[..., 0],
            turns=load.turns[:, 0],
            reluctivity=-derivative.reluctivity[:, 0],
            poles=-rim.poles[:, 0],
        )

    def force(self) -> Functional:
        """The axial force on the mover (N)."""
        tubular = self.tubular
        value = float(self._pull @ tubular.solution.psi / 2)
        return Functional(value, self._pull, *self._stress(value), adjoint=tubular.response)

    def _stress(self, value: float) -> tuple[Floats, Floats]:
        """(lines,) twice, derivatives of xᵀ G y by the grid's lines, from its value.

        Its density has one derivative along s, one along z and over ds dz no metric: lines that move leave it as it is
        (`cell_force`). Only the shell's own width is left.
        """
        grid, (inner, outer) = self.tubular.grid, self.tubular.section.force_annulus
        s = np.zeros(grid.r_lines.size)
        by_width = 2 * value / (outer**2 - inner**2)
        s[grid.line(inner)] += by_width
        s[grid.line(outer)] -= by_width
        return s, np.zeros(grid.z_lines.size)

    def linkage(self, factor: complex) -> Functional:
        """Re(factor · Λ) of the space vector Λ (Wb) of the phases' flux linkages."""
        solution = self.tubular.solution
        axes = 2 * np.pi * 2 / 3 * _by_axis(factor)
        load = self._windows.derivative(self._by_phase(_CLARKE @ axes, solution.psi))
        by_psi = self._densities @ (_CLARKE @ axes)
        return Functional(
            float(by_psi @ solution.psi),
            by_psi,
            load.s[:, 0],
            load.z[:, 0],
            windows=load.windows[..., 0],
            turns=load.turns[:, 0],
            adjoint=self._axes @ axes,
        )

    def inductance(self) -> Functional:
        """Synchronous inductance (H) of the balanced winding at the solution's state: mean of L less mean of M.

        With Clarke's currents it is ½ · 2π Σ over α, β of cᵀ K_T⁻¹ c.
        """
        grid, solution = self.tubular.grid, self.tubular.solution
        blank = np.zeros(solution.psi.size)
        total = Functional(
            0.0,
            blank,
            np.zeros(grid.r_lines.size),
            np.zeros(grid.z_lines.size),
            windows=np.zeros((len(self.tubular.section.coils), 4)),
            turns=np.zeros(len(self.tubular.section.coils)),
            reluctivity=np.zeros(len(solution.problem.materials)),
            poles=np.zeros(2),
        )
        assert total.windows is not None
        assert total.turns is not None
        assert total.reluctivity is not None
        assert total.poles is not None
        scale = np.pi * 2 / 3
        for currents, x in zip(_CLARKE.T, np.ascontiguousarray(self._axes.T), strict=True):
            derivative, by_psi = self.linearisation.tangent(x, x)
            load = self._windows.derivative(self._by_phase(2 * currents, x))
            rim = self._rim.derivative(x[:, None], x[:, None])
            total.value += scale * float((self._densities @ currents) @ x)
            total.by_psi -= scale * by_psi
            total.s += scale * (load.s - derivative.s - rim.s)[:, 0]
            total.z += scale * (load.z - derivative.z - rim.z)[:, 0]
            total.windows += scale * load.windows[..., 0]
            total.turns += scale * load.turns[:, 0]
            total.reluctivity -= scale * derivative.reluctivity[:, 0]
            total.poles -= scale * rim.poles[:, 0]
        return total

    def gradients(self, functionals: Sequence[Functional]) -> tuple[Floats, Floats, Floats]:
        """(numbers, k) derivatives of k figures by the section's `numbers`, (2, k) by their own limits in z, and
        (3, k) by the currents."""
        tubular, grid = self.tubular, self.tubular.grid
        section, problem = tubular.section, tubular.solution.problem
        adjoints = self._adjoints(functionals)
        residual = self.linearisation.residual(adjoints)
        rim = self._rim.derivative(tubular.solution.psi[:, None], adjoints)
        s, z, poles = -residual.s - rim.s, -residual.z - rim.z, -rim.poles
        windows = np.zeros((len(section.coils), 4, len(functionals)))
        turns = np.zeros((len(section.coils), len(functionals)))
        currents = np.array([circuit.current for circuit in problem.circuits])
        if currents.any():
            load = self._windows.derivative(self._by_phase(currents, adjoints))
            s, z, windows, turns = s + load.s, z + load.z, windows + load.windows, turns + load.turns
        reluctivity, coercivity = -residual.reluctivity, -residual.coercivity
        for k, item in enumerate(functionals):
            s[:, k] += item.s
            z[:, k] += item.z
            for total, part in (
                (windows, item.windows),
                (turns, item.turns),
                (reluctivity, item.reluctivity),
                (coercivity, item.coercivity),
                (poles, item.poles),
            ):
                if part is not None:
                    total[..., k] += part
        by_r, by_z = breakpoint_derivative(grid, section, s, z)
        remanence, recoil = self._magnets(reluctivity, coercivity)
        flat = np.concatenate(
            (by_r, by_z, windows.reshape(-1, len(functionals)), turns, remanence, recoil, poles), axis=0
        )
        return flat, np.column_stack([item.limits for item in functionals]), self._densities.T @ adjoints

    def _adjoints(self, functionals: Sequence[Functional]) -> Floats:
        """(n, k) K_T⁻¹ of the functionals' derivatives by ψ, those that are known left as they are."""
        found = np.zeros((self._pull.size, len(functionals)))
        unknown = [k for k, item in enumerate(functionals) if item.adjoint is None]
        if unknown:
            found[:, unknown] = self._solved(np.column_stack([functionals[k].by_psi for k in unknown]))
        for k, item in enumerate(functionals):
            if item.adjoint is not None:
                found[:, k] = item.adjoint
        return found

    def _magnets(self, reluctivity: Floats, coercivity: Floats) -> tuple[Floats, Floats]:
        """(regions, k) by remanence and by recoil permeability: ν = ν0/μ_r and H_c = ν B_r."""
        regions = self.tubular.section.regions
        mu = np.array([region.recoil_permeability for region in regions])[:, None]
        remanence = np.array([region.remanence for region in regions])[:, None]
        nu = VACUUM_RELUCTIVITY / mu
        return coercivity * nu, -(reluctivity + coercivity * remanence) * nu / mu

    def _solved(self, right: Floats) -> Floats:
        """(n, k) nodal adjoint fields of nodal right sides (n, k)."""
        return self.tubular.solution.response(right, ACCURACY)

    def _by_phase(self, weights: Floats, field: Floats) -> dict[str, Floats]:
        """A nodal field times each phase's weight, by the circuit's name."""
        circuits = self.tubular.solution.problem.circuits
        return {circuit.name: weight * field for circuit, weight in zip(circuits, weights, strict=True)}


def _by_axis(factor: complex) -> Floats:
    """(2,) α and β with Re(factor · (cos φ + j sin φ)) = α cos φ + β sin φ."""
    return np.array([np.real(factor), -np.imag(factor)])
