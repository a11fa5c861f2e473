"""A solution as FEMM's own `.ans` file: the model's text, then a solution on straight triangles.

FEMM's post-processor and the scripts that read these files know first-order elements only: each of ours becomes four,
so that all nodes are there with their potential. Around an axis the file has the flux 2π r A (Wb) in A's place. After
the elements comes how each block's current spreads, then which nodes periodic boundaries tie together.
"""

from __future__ import annotations

import numpy as np

from fluxbore.fem.conductors import current_density
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.femm_solution import FemmSolution
from fluxbore.fem.femm_writer import write_text
from fluxbore.fem.mesh import Floats, Ints, Topology
from fluxbore.fem.problem import Problem

FOUR = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])
"""(4, 3) the corners of the parts of an element, by its nodes."""


def ans_text(solution: FemmSolution) -> str:
    """The file's text, lines ending in a line feed."""
    model, problem = solution.model, solution.solution.problem
    mesh = problem.mesh
    triangles = mesh.elements[:, FOUR].reshape(-1, 3)
    potential = _potential(model, problem, solution.solution.psi)
    places = mesh.positions / model.metres
    nodes = [
        f"{x:.17g}\t{y:.17g}\t{a:.17g}\t{prop}\t"
        for (x, y), a, prop in zip(places.tolist(), potential.tolist(), _node_properties(solution), strict=True)
    ]
    density = _mean_density(problem)
    rows = np.column_stack((triangles, np.repeat(mesh.region, 4), _edge_properties(solution, triangles))).tolist()
    elements = [
        "\t".join(map(str, row)) + f"\t{j:.17g}" for row, j in zip(rows, np.repeat(density, 4).tolist(), strict=True)
    ]
    blocks = _blocks(model, problem)
    ties = _ties(mesh.topology)
    return "\n".join(
        [
            write_text(model) + "[Solution]",
            *(str(len(nodes)), *nodes),
            *(str(len(elements)), *elements),
            *(str(len(blocks)), *blocks),
            *(str(len(ties)), *(f"{a}\t{b}\t{kind}" for a, b, kind in ties)),
            "0\n",  # air gap elements
        ]
    )


def _potential(model: FemmModel, problem: Problem, psi: Floats) -> Floats:
    """(n,) A (Wb/m), or 2π r A (Wb).

    FEMM ties A on the rims of a Kelvin exterior where we tie r A, so that its flux there is R_o/R_i times ours.
    """
    if not model.axisymmetric:
        return psi
    flux = 2 * np.pi * psi
    outside = [number for number, label in enumerate(model.labels) if label.external]
    if outside and model.exterior is not None:
        mesh = problem.mesh
        nodes = np.unique(mesh.elements[np.isin(mesh.region, outside)])
        flux[nodes] *= model.exterior.outer_radius / model.exterior.inner_radius
    return np.asarray(flux)


def _node_properties(solution: FemmSolution) -> list[int]:
    """Of each node the number of its point property, −1 for none."""
    found = np.full(solution.solution.problem.mesh.nodes.shape[0], -1)
    corners = _corners(solution)
    for node, vertex in zip(solution.model.nodes, solution.adapted.triangulation.vertex, strict=True):
        if node.prop is not None and vertex >= 0:
            found[corners[vertex]] = node.prop
    return [int(number) for number in found]


def _corners(solution: FemmSolution) -> Ints:
    """(n,) the mesh's number of each of the triangulation's points; the elements are the same, in the same order."""
    triangulation = solution.adapted.triangulation
    found = np.zeros(triangulation.points.shape[0], dtype=int)
    found[triangulation.triangles] = solution.solution.problem.mesh.elements[:, :3]
    return found


def _edge_properties(solution: FemmSolution, triangles: Ints) -> Ints:
    """(m, 3) the number of the boundary property on the sides 12, 23, 31 of each triangle, −1 for none."""
    model, triangulation = solution.model, solution.adapted.triangulation
    mesh = solution.solution.problem.mesh
    carried = [*(segment.boundary for segment in model.segments), *(arc.boundary for arc in model.arcs)]
    prop = np.array([-1 if number is None else number for number in carried] + [-1])[triangulation.curve]
    edges, prop = _corners(solution)[triangulation.edges[prop >= 0]], prop[prop >= 0]
    count = mesh.nodes.shape[0]
    sides = np.stack([mesh.elements[:, [k, (k + 1) % 3]] for k in range(3)], axis=1).reshape(-1, 2)
    middles = mesh.elements[:, 3:].ravel()
    known = dict(zip(_codes(sides, count).tolist(), middles.tolist(), strict=True))
    halves = {}
    for (a, b), number in zip(edges.tolist(), prop.tolist(), strict=True):
        middle = known[min(a, b) * count + max(a, b)]
        for end in (a, b):
            halves[min(end, middle) * count + max(end, middle)] = number
    ours = np.stack([_codes(triangles[:, [k, (k + 1) % 3]], count) for k in range(3)], axis=1)
    found = np.full(ours.shape, -1)
    if halves:
        codes = np.array(sorted(halves))
        place = np.minimum(np.searchsorted(codes, ours), codes.size - 1)
        hit = codes[place] == ours
        found[hit] = np.array([halves[code] for code in codes.tolist()])[place[hit]]
    return found


def _codes(pairs: Ints, count: int) -> Ints:
    """(k,) a number for each pair of nodes, whichever comes first."""
    return np.asarray(pairs.min(axis=1) * count + pairs.max(axis=1))


def _mean_density(problem: Problem) -> Floats:
    """(m,) MA/m² in each element."""
    uniform, by_radius = current_density(problem)
    region = problem.mesh.region
    density = uniform[region]
    if np.any(by_radius):
        radius = problem.mesh.positions[problem.mesh.elements[:, :3], 0].mean(axis=1)
        density = density + by_radius[region] / radius
    return np.asarray(density * 1e-6)


def _blocks(model: FemmModel, problem: Problem) -> list[str]:
    """Of each label what its circuit drives through it: `1` and MA/m² of a wound block, `0` and the voltage gradient of
    a solid one, J = −σ dV in a plane and −σ dV/r about an axis, σ in MS/m; `1 0` without circuit."""
    wound, solid = np.zeros(len(model.labels)), np.zeros(len(model.labels))
    for circuit in problem.circuits:
        for conductor in circuit.conductors:
            target = solid if conductor.by_radius else wound
            target[conductor.region] += circuit.current * conductor.density
    lines = []
    for number, label in enumerate(model.labels):
        material = None if label.material is None else model.materials[label.material]
        whole = material is not None and material.lamination != "wire" and abs(label.turns) <= 1
        if material is not None and whole and material.conductivity > 0 and label.circuit is not None:
            # On the axis ours is even, for which the file has no word: the density is given instead.
            drop = -(solid[number] if model.axisymmetric else wound[number]) / material.conductivity
            if not (model.axisymmetric and wound[number]):
                lines.append(f"0\t{drop:.17g}")
                continue
        lines.append(f"1\t{wound[number] * 1e-6:.17g}")
    return lines


def _ties(topology: Topology) -> list[tuple[int, int, int]]:
    """Pairs of nodes of one unknown, and 0 where they are equal or 1 where they are opposite."""
    free = np.flatnonzero(topology.freedom >= 0)
    order = free[np.argsort(topology.freedom[free], kind="stable")]
    tied = np.flatnonzero(np.diff(topology.freedom[order]) == 0)
    first, second = order[tied], order[tied + 1]
    sign = np.ones(topology.freedom.size) if topology.sign is None else topology.sign
    return list(zip(first.tolist(), second.tolist(), (sign[first] != sign[second]).astype(int).tolist(), strict=True))
