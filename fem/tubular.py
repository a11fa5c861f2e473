"""Tubular three-phase machines by finite elements: from a cross-section at each position to the machine's figures."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fluxbore.design.materials import PermanentMagnet
from fluxbore.fem.asymptotic import open_rim
from fluxbore.fem.cell_force import shell_pull
from fluxbore.fem.cell_system import CellSystem
from fluxbore.fem.cells import Cells
from fluxbore.fem.coil_windows import Windows
from fluxbore.fem.line_field import along_radius
from fluxbore.fem.linkage import flux_linkages, synchronous_inductance
from fluxbore.fem.magnetostatics import Settings, Solution, solve
from fluxbore.fem.mapped import MappedMesh, Subdivision, mapped_mesh
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.newton import Convergence
from fluxbore.fem.problem import MagneticMaterial, Problem
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY, reluctivity_curve
from fluxbore.geometry.cross_section import CrossSection, Region

ORDER = 4
"""Of the polynomials in a cell."""

R_CELLS = {
    "shaft": Subdivision(1),
    "soft shaft": Subdivision(2, 3.0, "end"),
    "magnet": Subdivision(3, 10.0),
    "clearance": Subdivision(1),
    "cylinder": Subdivision(1),
    "soft cylinder": Subdivision(2, 3.0, "start"),
    "winding": Subdivision(1),
    "back yoke": Subdivision(1),
    "near air": Subdivision(1),
    "far air": Subdivision(1),
}
"""Cells of the default mesh along r, by what lies there."""

Z_CELLS = {
    "ring": Subdivision(4, 8.0),
    "half ring": Subdivision(3, 8.0),
    "magnet": Subdivision(3, 3.0),
    "cap end": Subdivision(8, 1.4, "end"),
    "rod end": Subdivision(8, 1.4, "start"),
    "beyond cap end": Subdivision(3, 4.0, "end"),
    "beyond rod end": Subdivision(3, 4.0, "start"),
}
"""Cells of the default mesh along z, by what lies there. Where iron has a corner they are small and grow away from it
by much: inside of a cell the field is told by polynomials, which only a corner's field is not like (Babuška and Guo
1986). The ends, in which coils have a field of their own, have cells of a coil's length at most or so."""


@dataclass(frozen=True, eq=False)
class TubularSolution:
    """A machine's field at one position, with the grid it lives on."""

    position: float
    section: CrossSection
    grid: MappedMesh
    solution: Solution

    @property
    def convergence(self) -> Convergence:
        return self.solution.convergence

    @cached_property
    def cells(self) -> Cells:
        """Of the grid, with all that does not depend on the field."""
        system = self.solution.system
        return system.cells if isinstance(system, CellSystem) else Cells(self.grid)

    @cached_property
    def pull(self) -> Floats:
        """(n,) ∂F/∂ψ of the axial force F = ½ ψ·∂F/∂ψ."""
        return shell_pull(self.cells, self.section.force_annulus, self.solution.psi)

    @cached_property
    def response(self) -> Floats:
        """(n,) K_T⁻¹ ∂F/∂ψ of the axial force: what thrust constants and their gradients begin with."""
        return self.solution.response(self.pull)

    @cached_property
    def reverse(self) -> list[tuple[int, Ints, Floats]]:
        """See `reverse_fields`."""
        return _reverse_fields(self)

    def thrust_constants(self) -> Floats:
        """(3,) incremental thrust per ampere in each phase (N/A), by the stress tensor: with K_T y = ∂F/∂ψ, each
        phase's is y · (its load per ampere). No second field is needed, and cogging drops out."""
        return np.array([self.response @ circuit.density for circuit in self.solution.problem.circuits])

    def cogging_force(self) -> float:
        """Axial force on the mover at no current (N)."""
        return float(self.pull @ self.solution.psi / 2)

    def flux_linkages(self) -> Floats:
        """(3,) of the phases at no current (Wb)."""
        return flux_linkages(self.solution)

    def highest_flux_density(self) -> float:
        """Largest |B| (T) in iron."""
        curved = [material.curve is not None for material in self.solution.problem.materials]
        iron = np.flatnonzero(np.array(curved)[self.cells.region])
        return float(np.hypot(*self.cells.fields(self.solution.psi, iron)).max(initial=0.0))

    def synchronous_inductance(self) -> float:
        """Incremental, of the balanced winding (H): a phase's own less its mutual one, means over the three."""
        return synchronous_inductance(self.solution)


def magnetic_material(region: Region) -> MagneticMaterial:
    """How the solver sees a region."""
    if region.material is None:
        return MagneticMaterial()
    if isinstance(region.material, PermanentMagnet):
        return MagneticMaterial.magnet((0.0, region.remanence), VACUUM_RELUCTIVITY / region.recoil_permeability)
    if region.material.curve is not None:
        return MagneticMaterial(curve=reluctivity_curve(region.material.curve))
    return MagneticMaterial()


def solve_positions(
    section_at: Callable[[float], CrossSection],
    positions: Sequence[float],
    settings: Settings | None = None,
    refinement: int = 1,
) -> list[TubularSolution]:
    """The field at no current at each position.

    The mesh moves with the mover, so the field at its nodes changes smoothly with position: each position begins from
    the polynomial through the last three, and one Newton step is then enough. Stops at the first position that does
    not converge; the last item then says so.
    """
    solved: list[TubularSolution] = []
    for position in positions:
        section = section_at(position)
        grid = mapped_mesh(section, R_CELLS, Z_CELLS, refinement, open_rim=True, order=ORDER)
        item = _solved(section, grid, position, {}, settings, _predicted(solved[-3:], position, grid))
        solved.append(item)
        if not item.convergence.converged:
            break
    return solved


def solve_currents(
    section: CrossSection,
    position: float,
    currents: Mapping[str, float],
    settings: Settings | None = None,
    refinement: int = 1,
    near: TubularSolution | None = None,
) -> TubularSolution:
    """The field at given currents (A) by phase, the others at none; begun from a near one, or from no field."""
    grid = mapped_mesh(section, R_CELLS, Z_CELLS, refinement, open_rim=True, order=ORDER)
    return _solved(section, grid, position, currents, settings, None if near is None else near.solution.psi)


def _solved(
    section: CrossSection,
    grid: MappedMesh,
    position: float,
    currents: Mapping[str, float],
    settings: Settings | None,
    start: Floats | None,
) -> TubularSolution:
    """The problem of a meshed cross-section in open air, solved."""
    materials = tuple(magnetic_material(region) for region in section.regions)
    return TubularSolution(position, section, grid, solve_grid(section, grid, materials, currents, settings, start))


def solve_grid(
    section: CrossSection,
    grid: MappedMesh,
    materials: tuple[MagneticMaterial, ...],
    currents: Mapping[str, float] | None = None,
    settings: Settings | None = None,
    start: Floats | None = None,
) -> Solution:
    """The field of a cross-section's mesh whose rim is open. materials : by region. currents : A, by phase."""
    coils = tuple(
        replace(circuit, current=(currents or {}).get(circuit.name, 0.0))
        for circuit in Windows(grid, section.coils).circuits()
    )
    problem = Problem(grid.mesh, materials, coils)
    return solve(problem, settings, start, CellSystem(problem, grid, open_rim(grid, section.ends)))


def _predicted(before: Sequence[TubularSolution], position: float, grid: MappedMesh) -> Floats | None:
    """Nodal ψ at a position from the ones before by Lagrange's polynomial; None where there are none on this mesh."""
    known = [item for item in before if item.grid.mesh.topology is grid.mesh.topology and item.position != position]
    if not known:
        return None
    psi = np.zeros(grid.mesh.nodes.shape[0])
    for item in known:
        others = [other.position for other in known if other is not item]
        weight = np.prod([(position - z) / (item.position - z) for z in others]) if others else 1.0
        psi += weight * item.solution.psi
    return psi


def space_vector(phases: Floats) -> complex:
    """Amplitude-invariant Clarke vector α + jβ of three phase values U, V, W."""
    a = np.exp(2j * np.pi / 3)
    return complex(2 / 3 * (phases[0] + a * phases[1] + a**2 * phases[2]))


def stray_field(tubular: TubularSolution, radius: float, z_range: tuple[float, float]) -> float:
    """Largest |B| (T) on a cylinder of this radius, a mesh line, between two z (m)."""
    z, field = along_radius(tubular.grid, tubular.solution.psi, radius, outside=False)
    size = np.linalg.norm(field, axis=1)
    ends = np.interp(z_range, z, size)
    inside = size[(z > z_range[0]) & (z < z_range[1])]
    return float(max(ends.max(), inside.max(initial=0.0)))


def tube_flux_density(tubular: TubularSolution, r_range: tuple[float, float], z_range: tuple[float, float]) -> float:
    """Largest axial flux density averaged over a tube's cross-section (T), along z.

    The flux through the tube between two radii is 2π (ψ_o − ψ_i), its area 2π (s_o − s_i).
    """
    grid, psi = tubular.grid, tubular.solution.psi
    inner, outer = (grid.column(r) for r in r_range)
    rows = np.flatnonzero((grid.z_nodes > z_range[0]) & (grid.z_nodes < z_range[1]))
    flux = psi[grid.node(rows, outer)] - psi[grid.node(rows, inner)]
    return float(np.abs(flux).max() / (grid.r_nodes[outer] - grid.r_nodes[inner]))


def shell_flux_density(tubular: TubularSolution, radius: float, z_range: tuple[float, float]) -> float:
    """Mean radial flux density (T) through a cylinder of this radius, a mesh line, between two z (m).

    The flux out of the shell is 2π times the difference of ψ between its rims.
    """
    grid, psi = tubular.grid, tubular.solution.psi
    column = grid.column(radius)
    rows = np.arange(grid.z_nodes.size)
    profile = psi[grid.node(rows, column)]
    start, end = np.interp(z_range, grid.z_nodes, profile)
    return float(abs(end - start) / (radius * (z_range[1] - z_range[0])))


def reverse_fields(tubular: TubularSolution) -> list[tuple[int, Ints, Floats]]:
    """Of each magnet its region, its cells (m,) and the field against its magnetisation (A/m) at their quadrature
    points (m, q)."""
    return tubular.reverse


def _reverse_fields(tubular: TubularSolution) -> list[tuple[int, Ints, Floats]]:
    materials, cells, psi = tubular.solution.problem.materials, tubular.cells, tubular.solution.psi
    found = []
    for index, material in enumerate(materials):
        remanence = material.remanence[1]
        if not remanence:
            continue
        own = np.flatnonzero(cells.region == index)
        b_z, _ = cells.fields(psi, own)
        found.append((index, own, -material.components[1] * (b_z * np.sign(remanence) - abs(remanence))))
    return found


def demagnetised_fraction(tubular: TubularSolution, intrinsic_coercivity: float) -> float:
    """Share of the magnets' volume in which the field against the magnetisation exceeds the coercivity (A/m)."""
    weight, reverse = _magnets(tubular)
    volume, beyond = float(weight.sum()), float(weight[reverse > intrinsic_coercivity].sum())
    return beyond / volume if volume else 0.0


def _magnets(tubular: TubularSolution) -> tuple[Floats, Floats]:
    """(m, q) twice: quadrature weights (m³) and the field against the magnetisation (A/m) in all magnets."""
    fields = reverse_fields(tubular)
    if not fields:
        return np.zeros((0, 1)), np.zeros((0, 1))
    cells = np.concatenate([own for _, own, _ in fields])
    return tubular.cells.weight[cells], np.concatenate([field for _, _, field in fields])


def mean_reverse_field(tubular: TubularSolution, exponent: float) -> float:
    """(mean of h^p over the magnets' volume)^(1/p) (A/m) of the field h >= 0 against the magnetisation."""
    weight, reverse = _magnets(tubular)
    largest = float(reverse.max(initial=0.0))
    if largest == 0.0:
        return 0.0
    integral = float(np.sum(weight * (np.maximum(reverse, 0.0) / largest) ** exponent))
    return float(largest * (integral / float(weight.sum())) ** (1 / exponent))
