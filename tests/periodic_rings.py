"""Rings of radial magnets by the axisymmetric solver, ψ = r·A_φ, folded over one period: a lead screw without a lead.

The innermost radius carries ψ = 0, so that no flux enters there; on the outermost ψ is free, so that the field meets it
at a right angle, as infinitely permeable iron.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from stress_force import axial_force

from fluxbore.fem.magnetostatics import Settings, Solution, solve
from fluxbore.fem.mapped import Subdivision, mapped_mesh
from fluxbore.fem.mesh import Mesh, Topology
from fluxbore.fem.problem import MagneticMaterial, Problem
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY, reluctivity_curve
from fluxbore.geometry.cross_section import Breakpoints, CrossSection
from fluxbore.geometry.helical_bands import Bands
from fluxbore.geometry.helical_section import HelicalSection


def rings_force(section: HelicalSection, refinement: int = 1) -> float:
    """Axial force (N) on the inner member, per period."""
    return axial_force(solved_rings(section, refinement), section.gap_radii)


def solved_rings(section: HelicalSection, refinement: int = 1) -> Solution:
    """The section's rings, whatever its lead; of layers with bands, displaced by less than half a period."""
    assert (section.inside, section.outside) == ("closed", "iron")
    edges = {0.0, 1.0}
    for number, layer in enumerate(section.layers):
        if isinstance(layer.magnets, Bands):
            moved = section.displacement / section.period if number > section.gap else 0.0
            edges |= {(edge + moved) % 1.0 for edge in layer.magnets.breaks}
    shares = sorted(edges)
    materials, cells = [], np.zeros((len(shares) - 1, len(section.layers)), dtype=int)
    for number, layer in enumerate(section.layers):
        moved = section.displacement / section.period if number > section.gap else 0.0
        for row, (start, end) in enumerate(pairwise(shares)):
            cells[row, number] = len(materials)
            nu = VACUUM_RELUCTIVITY / layer.permeability
            if layer.curve is not None:
                materials.append(MagneticMaterial(curve=reluctivity_curve(layer.curve)))
            elif layer.magnets is not None:
                remanence = float(layer.magnets.remanence(np.array((start + end) / 2 - moved)))
                materials.append(MagneticMaterial.magnet((remanence, 0.0), nu))
            else:
                materials.append(MagneticMaterial(nu))
    r_cells = {layer.name: Subdivision(8, 1.5) for layer in section.layers}
    rows = [f"row {row}" for row in range(len(shares) - 1)]
    z_cells = {
        name: Subdivision(2 + round(24 * (b - a)), 1.25) for name, (a, b) in zip(rows, pairwise(shares), strict=True)
    }
    plan = CrossSection(
        Breakpoints(section.radii, tuple(layer.name for layer in section.layers)),
        Breakpoints(tuple(share * section.period for share in shares), tuple(rows)),
        (),
        cells,
        (),
        (),
        section.gap_radii,
    )
    grid = mapped_mesh(plan, r_cells, z_cells, refinement, open_rim=True)
    width = grid.r_nodes.size
    number = np.arange(grid.mesh.nodes.shape[0])
    mate = number % (number.size - width)  # the last row is the first
    free = (number == mate) & (number % width > 0)
    rank = np.where(free, np.cumsum(free) - 1, -1)
    topology = Topology(grid.mesh.elements, rank[mate], mate=mate)
    mesh = Mesh("axisymmetric", grid.mesh.nodes, grid.mesh.region, topology)
    return solve(Problem(mesh, tuple(materials)), Settings(method="auto"))
