"""The smooth weight of the force's domain form: one on a body, zero on whatever else is magnetic, harmonic between."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from fluxbore.fem.element import kernel, positions, stiffness
from fluxbore.fem.linear import Pattern, choose, factorise
from fluxbore.fem.mesh import Floats, Ints, Mesh
from fluxbore.fem.problem import Problem


@dataclass(frozen=True, slots=True, eq=False)
class Weight:
    """nodal : (n,) from 0 to 1. shell : (k,) the elements of vacuum over which it varies.

    touched : numbers of magnetic regions that the body touches; a force between bodies in contact is not defined.
    """

    nodal: Floats
    shell: Ints
    touched: tuple[int, ...]


def smooth_weight(problem: Problem, body: Collection[int]) -> Weight:
    """The weight of a body made of some regions.

    It is the potential between the body at one and all other magnetic regions and the far boundary at zero, so that it
    falls over the whole of the air between, not in one layer of elements (McFee, Webb and Lowther 1988; Henrotte et al.
    2004 call such a layer an eggshell). Where the body touches a boundary, such as a plane of symmetry, the
    weight is free on it.
    """
    mesh = problem.mesh
    inside, air, other = _parts(problem, body)
    nodal, fixed = np.zeros(mesh.nodes.shape[0]), np.ones(mesh.nodes.shape[0], dtype=bool)
    shell = np.flatnonzero(air)
    fixed[mesh.elements[shell]] = False
    rim = boundary_nodes(problem, inside)
    for group in (rim, mesh.elements[other].ravel()):
        fixed[group] = True
    on_body = np.unique(mesh.elements[inside])
    fixed[on_body], nodal[on_body] = True, 1.0
    nodal = _harmonic(problem, shell, nodal, fixed)
    varying = np.ptp(nodal[mesh.elements[shell]], axis=1) > 1e-12
    return Weight(nodal, shell[varying], _touching(problem, inside, other))


def layer_weight(problem: Problem, body: Collection[int]) -> Weight:
    """The weight of the principle of virtual work in its local form (Coulomb 1983).

    One on the body's nodes and zero on all others: only the elements that touch the body are deformed.
    """
    mesh = problem.mesh
    inside, air, other = _parts(problem, body)
    nodal = np.zeros(mesh.nodes.shape[0])
    nodal[mesh.elements[inside].ravel()] = 1.0
    # The middle of an edge follows its two ends, so that the deformed elements stay straight.
    for corner in range(3):
        ends = mesh.elements[:, [corner, (corner + 1) % 3]]
        middle = mesh.elements[:, 3 + corner]
        nodal[middle] = nodal[ends].mean(axis=1)
    shell = np.flatnonzero(air & (np.ptp(nodal[mesh.elements], axis=1) > 0))
    return Weight(nodal, shell, _touching(problem, inside, other))


def _parts(problem: Problem, body: Collection[int]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(m,) each: whether an element is in the body, in vacuum outside it, or in something else that is magnetic.

    What hangs together with the body by ties alone, such as a Kelvin exterior, is not the space that the body moves in
    and counts as something else.
    """
    mesh = problem.mesh
    mine = np.zeros(len(problem.materials), dtype=bool)
    mine[list(body)] = True
    magnetic = np.array([material.magnetic for material in problem.materials])
    inside = mine[mesh.region]
    island = _islands(mesh)
    elsewhere = ~np.isin(island, np.unique(island[inside]))
    other = ~inside & (magnetic[mesh.region] | elsewhere)
    return inside, ~inside & ~other, other


def _islands(mesh: Mesh) -> Ints:
    """(m,) number of the connected part of the mesh that each element is in, ties not counted."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    corners = mesh.elements[:, :3]
    count = mesh.nodes.shape[0]
    rows, columns = corners[:, [0, 1]].ravel(), corners[:, [1, 2]].ravel()
    graph = coo_matrix((np.ones(rows.size, dtype=np.int8), (rows, columns)), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1][corners[:, 0]])


def _touching(problem: Problem, inside: np.ndarray, other: np.ndarray) -> tuple[int, ...]:
    """The magnetic regions that share an edge with the body."""
    mesh = problem.mesh
    middles = np.unique(mesh.elements[inside, 3:])
    contact = other & np.isin(mesh.elements[:, 3:], middles).any(axis=1)
    return tuple(np.unique(mesh.region[contact]).tolist())


def boundary_nodes(problem: Problem, inside: np.ndarray) -> Ints:
    """The nodes of the domain's rim, without the axis and without straight runs of it that the body touches."""
    mesh = problem.mesh
    count = np.bincount(mesh.elements[:, 3:].ravel(), minlength=mesh.nodes.shape[0])
    lonely = count == 1
    free = mesh.topology.freedom
    if free.size:
        # Nodes of periodic boundaries lie on the rim but share their unknown with another: they are inside.
        shared = np.bincount(free[free >= 0], minlength=mesh.topology.unknowns) > 1
        lonely[np.flatnonzero(free >= 0)] &= ~shared[free[free >= 0]]
    edges = np.concatenate([mesh.elements[:, [k, (k + 1) % 3, 3 + k]] for k in range(3)])
    edges = edges[lonely[edges[:, 2]]]
    space = mesh.positions
    if mesh.chart == "axisymmetric":
        edges = edges[np.any(space[edges, 0] > 0, axis=1)]
    body = np.zeros(space.shape[0], dtype=bool)
    body[mesh.elements[inside]] = True
    direction = space[edges[:, 1]] - space[edges[:, 0]]
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    normal = np.column_stack((-direction[:, 1], direction[:, 0]))
    offset = np.sum(normal * space[edges[:, 0]], axis=1)
    scale = np.abs(space).max()
    lines = np.column_stack((normal, offset / scale))
    lines *= np.where(lines[:, :1] + 1e-7 * lines[:, 1:2] < 0, -1.0, 1.0)
    keys = np.round(lines, 7)
    touched = {tuple(key) for key in keys[np.any(body[edges], axis=1)]}
    kept = np.array([tuple(key) not in touched for key in keys], dtype=bool)
    return np.unique(edges[kept])


def _harmonic(problem: Problem, shell: Ints, nodal: Floats, fixed: np.ndarray) -> Floats:
    """Solve Laplace's equation in the shell for the nodes that are not fixed, periodic nodes tied."""
    mesh = problem.mesh
    tie = np.where(mesh.topology.freedom >= 0, mesh.topology.freedom, mesh.topology.unknowns + np.arange(fixed.size))
    held = np.zeros(tie.max() + 1, dtype=bool)
    held[tie[fixed]] = True
    free = ~held[tie]
    _, number = np.unique(tie[free], return_inverse=True)
    freedom = np.full(fixed.size, -1)
    freedom[free] = number.ravel()
    if not free.any():
        return nodal
    core = kernel(mesh, shell)
    factor = core.weight
    if mesh.chart == "axisymmetric":
        factor = factor * positions(mesh, shell)[..., 0] ** 2
    matrices = stiffness(core.curl, factor)
    pattern = Pattern.of_elements(freedom[mesh.elements[shell]], int(number.max()) + 1)
    pull = np.einsum("mnk,mk->mn", matrices, nodal[mesh.elements[shell]], optimize=True)
    load = np.bincount(mesh.elements[shell].ravel(), pull.ravel(), fixed.size)
    right = -np.bincount(freedom[free], load[free], pattern.unknowns).astype(float)
    solved = nodal.copy()
    solved[free] = factorise(pattern, pattern.assemble(matrices), choose(pattern)).solve(right)[freedom[free]]
    return solved
