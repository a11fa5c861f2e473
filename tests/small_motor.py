"""A motor of one pole pair on a coarse mesh, and its cross-section as one vector that can be moved.

Its iron has a cubic law, which is smooth: differences of its discrete equations are then good to many digits, while
those of a spline through a table are not. The mesh is far too coarse for the field, and no matter: derivatives are
those of the discrete problem.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from actuators import table_ii

from fluxbore.design.materials import standard
from fluxbore.fem.magnetostatics import Settings
from fluxbore.fem.mapped import MappedMesh, lattice, mapped_mesh
from fluxbore.fem.mesh import Floats, Mesh
from fluxbore.fem.problem import MagneticMaterial
from fluxbore.fem.reluctivity import ReluctivityCurve
from fluxbore.fem.tubular import ORDER, R_CELLS, Z_CELLS, TubularSolution, magnetic_material, solve_grid
from fluxbore.geometry.cross_section import AIR, Breakpoints, CoilWindow, CrossSection, Rectangle, numbers
from fluxbore.geometry.hybrid import cross_section

MM = 1e-3
POSITION = 5.3 * MM
COARSE_R = {name: replace(cells, cells=-(-cells.cells // 6)) for name, cells in R_CELLS.items()}
COARSE_Z = {name: replace(cells, cells=-(-cells.cells // 6)) for name, cells in Z_CELLS.items()}


def cubic_iron(linear: float = 250.0, cubic: float = 4000.0) -> ReluctivityCurve:
    """H = linear · B + cubic · B³ (A/m, B in T) up to 50 T: μ_r 3183 without field, saturated above a tesla."""
    coefficients = np.zeros((4, 2))
    coefficients[[1, 3], 0] = linear, cubic
    coefficients[:2, 1] = 50 * linear + 50**3 * cubic, 1.0
    return ReluctivityCurve(50.0, coefficients, np.zeros(2))


def small_section(position: float = POSITION, shaft: str = "stainless steel 304") -> CrossSection:
    """The prototype with one pole pair and two coils for each phase."""
    actuator = table_ii()
    actuator = replace(
        actuator,
        winding=replace(actuator.winding, sets_per_phase=2, turns=146),
        mover=replace(actuator.mover, pole_pairs=1, stroke=20 * MM, ring_width=2.5 * MM),
        shaft=replace(actuator.shaft, material=shaft),
    )
    return cross_section(actuator, position, standard(), 293.15)


def solved(
    section: CrossSection,
    currents: Mapping[str, float] | None = None,
    curve: ReluctivityCurve | None = None,
) -> TubularSolution:
    """Its field, all iron being of one curve, by phase currents (A)."""
    grid = mapped_mesh(section, COARSE_R, COARSE_Z, open_rim=True, order=ORDER)
    curve = curve or cubic_iron()
    materials = tuple(
        MagneticMaterial(curve=curve) if material.curve is not None else material
        for material in map(magnetic_material, section.regions)
    )
    solution = solve_grid(section, grid, materials, currents, Settings(1e-13))
    assert solution.convergence.converged, solution.convergence
    return TubularSolution(POSITION, section, grid, solution)


def from_numbers(section: CrossSection, values: Floats) -> CrossSection:
    """The section whose `numbers` are these; the force's annulus moves with its lines."""
    rest = list(values)

    def take(count: int) -> list[float]:
        taken, rest[:] = [float(value) for value in rest[:count]], rest[count:]
        return taken

    r, z = (tuple(take(len(old.values))) for old in (section.r, section.z))
    windows = np.array(take(4 * len(section.coils))).reshape(-1, 4).tolist()
    turns = take(len(section.coils))
    remanences, recoils = take(len(section.regions)), take(len(section.regions))
    low, high = take(2)
    inner, outer = (r[section.r.values.index(radius)] for radius in section.force_annulus)
    return CrossSection(
        Breakpoints(r, section.r.intervals),
        Breakpoints(z, section.z.intervals),
        tuple(
            replace(region, remanence=remanence, recoil_permeability=recoil)
            for region, remanence, recoil in zip(section.regions, remanences, recoils, strict=True)
        ),
        section.cells,
        tuple(
            CoilWindow(coil.circuit, n, (a, b), (c, d))
            for coil, n, (a, b, c, d) in zip(section.coils, turns, windows, strict=True)
        ),
        (Rectangle(AIR, (0.0, r[1]), (low, high)),),
        (inner, outer),
    )


def number_names(section: CrossSection) -> list[str]:
    """What each of a section's `numbers` is."""
    names = [f"r {k}" for k in range(len(section.r.values))] + [f"z {k}" for k in range(len(section.z.values))]
    names += [f"coil {k} {side}" for k in range(len(section.coils)) for side in ("r from", "r to", "z from", "z to")]
    names += [f"turns {k}" for k in range(len(section.coils))]
    names += [f"remanence {k}" for k in range(len(section.regions))]
    names += [f"permeability {k}" for k in range(len(section.regions))]
    return [*names, "low end", "high end"]


def lengths(section: CrossSection) -> Floats:
    """(numbers,) whether a number is a length."""
    return np.array(
        [not name.startswith(("turns", "remanence", "permeability")) for name in number_names(section)], dtype=float
    )


def with_lines(grid: MappedMesh, s: Floats, z: Floats) -> MappedMesh:
    """The same mesh with other lines: s (m²) and z (m), (lines,)."""

    s_nodes, z_nodes = lattice(s, grid.order), lattice(z, grid.order)
    flat_s, flat_z = np.meshgrid(s_nodes, z_nodes)
    nodes = np.column_stack((flat_s.ravel(), flat_z.ravel()))
    mesh = Mesh("axisymmetric", nodes, grid.mesh.region, grid.mesh.topology)
    return MappedMesh(mesh, np.sqrt(2 * s), z, s_nodes, z_nodes, grid.region, grid.order)


def difference(function: Callable[[float], Floats], step: float) -> Floats:
    """d function(x)/dx at zero, of two central differences extrapolated: what is left is of step⁴."""
    coarse, fine = ((function(h) - function(-h)) / (2 * h) for h in (step, step / 2))
    return np.asarray((4 * fine - coarse) / 3)


def all_numbers(section: CrossSection) -> Floats:
    return np.asarray(numbers(section))
