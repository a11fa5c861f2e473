"""The smooth weight of the force's domain form: one on a body, zero on whatever else is magnetic, harmonic between."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fluxbore.fem.element import kernel, positions, stiffness
from fluxbore.fem.linear import choose, factorise
from fluxbore.fem.mesh import Floats, Ints, Mesh
from fluxbore.fem.pattern import Pattern
from fluxbore.fem.problem import Problem

Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Weight:
    """nodal : (n,) from 0 to 1. shell : (k,) the elements of vacuum over which it varies.

    touched : numbers of magnetic regions that the body touches; a force between bodies in contact is not defined.
    """

    nodal: Floats
    shell: Ints
    touched: tuple[int, ...]

    @property
    def defined(self) -> bool:
        """Whether there is air all around the body, so that its stress says what pulls on it."""
        return bool(self.shell.size) and not self.touched


def smooth_weight(problem: Problem, body: Collection[int]) -> Weight:
    """The weight of a body made of some regions.

    It is the potential between the body at one and all other magnetic regions and the far boundary at zero, so that it
    falls over the whole of the air between, not in one layer of elements (McFee, Webb and Lowther 1988; Henrotte et al.
    2004 call such a layer an eggshell). Where the body touches a boundary, such as a plane of symmetry, the
    weight is free on it.
    """
    mesh = problem.mesh
    inside, air, other = _parts(problem, body)
    on_body = _with_mates(mesh, mesh.elements[inside])
    nodal, fixed = on_body.astype(float), np.ones(mesh.nodes.shape[0], dtype=bool)
    fixed[mesh.elements[air]] = False
    fixed[boundary_nodes(problem, on_body)] = True
    fixed[mesh.elements[other]] = True
    fixed[_beside_filaments(problem, on_body)] = True
    fixed[on_body] = True
    nodal = _harmonic(problem, np.flatnonzero(air), nodal, fixed)
    return Weight(nodal, _shell(problem, air, nodal), _touching(problem, inside, other))


def layer_weight(problem: Problem, body: Collection[int]) -> Weight:
    """The weight of the principle of virtual work in its local form (Coulomb 1983).

    One on the body's nodes and zero on all others: only the elements that touch the body are deformed.
    """
    mesh = problem.mesh
    inside, air, other = _parts(problem, body)
    nodal = _with_mates(mesh, mesh.elements[inside]).astype(float)
    # The middle of an edge follows its two ends, so that the deformed elements stay straight.
    for corner in range(3):
        ends = mesh.elements[:, [corner, (corner + 1) % 3]]
        middle = mesh.elements[:, 3 + corner]
        nodal[middle] = nodal[ends].mean(axis=1)
    return Weight(nodal, _shell(problem, air, nodal), _touching(problem, inside, other))


def _with_mates(mesh: Mesh, nodes: Ints) -> Flags:
    """(n,) whether a node is one of those or tied to one."""
    mates = mesh.topology.mates
    chosen = np.zeros(mates.size, dtype=bool)
    chosen[mates[nodes]] = True
    return np.asarray(chosen[mates])


def _shell(problem: Problem, air: Flags, nodal: Floats) -> Ints:
    """The elements that count: where the weight varies, and where current flows under it, varying or not."""
    mesh = problem.mesh
    around = np.flatnonzero(air)
    values = nodal[mesh.elements[around]]
    carries = np.zeros(len(problem.materials), dtype=bool)
    for item in (*problem.circuits, *problem.sources):
        carries[[conductor.region for conductor in item.conductors]] = True
    counts = (np.ptp(values, axis=1) > 1e-12) | ((values.max(axis=1) > 1e-12) & carries[mesh.region[around]])
    return np.asarray(around[counts])


def _beside_filaments(problem: Problem, on_body: Flags) -> Ints:
    """The nodes nearer to a point current than half of its distance from the body.

    The field beside it grows without bound, and so would the stress that a weight there picks up.
    """
    mesh = problem.mesh
    loads = [source.density for source in problem.sources if not source.conductors]
    filaments = np.unique(np.concatenate([np.flatnonzero(load) for load in loads])) if loads else np.zeros(0, dtype=int)
    space, found = mesh.positions, [np.zeros(0, dtype=int)]
    body = space[on_body]
    for filament in filaments[~on_body[filaments]]:
        reach = float(np.hypot(*(body - space[filament]).T).min(initial=np.inf)) / 2
        near = np.flatnonzero(np.hypot(*(space - space[filament]).T) < reach)
        found += [near, np.unique(mesh.elements[np.any(mesh.elements == filament, axis=1)])]
    return np.concatenate(found)


def _parts(problem: Problem, body: Collection[int]) -> tuple[Flags, Flags, Flags]:
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


def _touching(problem: Problem, inside: Flags, other: Flags) -> tuple[int, ...]:
    """The magnetic regions that share an edge with the body."""
    mesh = problem.mesh
    middles = _with_mates(mesh, mesh.elements[inside, 3:])
    contact = other & middles[mesh.elements[:, 3:]].any(axis=1)
    return tuple(np.unique(mesh.region[contact]).tolist())


def boundary_nodes(problem: Problem, on_body: Flags) -> Ints:
    """The nodes of the domain's rim, without the axis and without straight runs of it that the body touches."""
    mesh = problem.mesh
    mates = mesh.topology.mates
    # The sides of a periodic boundary lie on the rim of the mesh, but there is another element beyond them.
    count = np.bincount(mates[mesh.elements[:, 3:]].ravel(), minlength=mates.size)
    edges = np.concatenate([mesh.elements[:, [k, (k + 1) % 3, 3 + k]] for k in range(3)])
    edges = edges[count[mates[edges[:, 2]]] == 1]
    space = mesh.positions
    if mesh.chart == "axisymmetric":
        edges = edges[np.any(space[edges, 0] > 0, axis=1)]
    direction = space[edges[:, 1]] - space[edges[:, 0]]
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    normal = np.column_stack((-direction[:, 1], direction[:, 0]))
    offset = np.sum(normal * space[edges[:, 0]], axis=1)
    lines = np.column_stack((normal, offset / np.abs(space).max()))
    lines *= np.where(lines[:, :1] + 1e-7 * lines[:, 1:2] < 0, -1.0, 1.0)
    _, line = np.unique(np.round(lines, 7), axis=0, return_inverse=True)
    touched = np.isin(line.ravel(), line.ravel()[np.any(on_body[edges], axis=1)])
    return np.unique(edges[~touched])


def _harmonic(problem: Problem, shell: Ints, nodal: Floats, fixed: Flags) -> Floats:
    """Solve Laplace's equation in the shell for the nodes that are not fixed, periodic nodes tied."""
    mesh = problem.mesh
    tie = mesh.topology.mates
    free = ~_with_mates(mesh, np.flatnonzero(fixed))
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
