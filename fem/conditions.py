"""Conditions on an outline's curves and points become unknowns, prescribed values and edge terms of a mesh."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fluxbore.fem.mesh import Chart, Floats, Ints, Mesh, Topology, in_space
from fluxbore.fem.outline import Outline, Pair
from fluxbore.fem.problem import EdgeTerms
from fluxbore.fem.quadratic import QuadraticNodes
from fluxbore.fem.triangulation import Triangulation

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)
_T, _W = (_POINTS + 1) / 2, _WEIGHTS / 2
# A quadratic edge: start, end, middle.
_SHAPE = np.column_stack(((1 - _T) * (1 - 2 * _T), _T * (2 * _T - 1), 4 * _T * (1 - _T)))
_SLOPE = np.column_stack((4 * _T - 3, 4 * _T - 1, 4 - 8 * _T))


@dataclass(frozen=True, slots=True)
class Prescribed:
    """potential : A (Wb/m) at positions (k, 2) in m -> (k,)."""

    potential: Callable[[Floats], Floats]


@dataclass(frozen=True, slots=True)
class Mixed:
    """H_t + c0 A + c1 = 0 with H_t the tangential field seen from inside. c0 : 1/H. c1 : A/m."""

    c0: float
    c1: float = 0.0


@dataclass(frozen=True, slots=True)
class Conditions:
    """curves : by the number that the outline's curves carry. points : prescribed A (Wb/m) by number of the point."""

    curves: Sequence[Prescribed | Mixed] = ()
    points: Mapping[int, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class ConditionedMesh:
    """prescribed : (n,) ψ where it is not unknown. edges : terms of mixed conditions, None without any.

    loose : (n,) number, from 0, of the part of the mesh in which nothing fixes ψ, so that its zero is chosen at a node;
    −1 elsewhere.
    """

    mesh: Mesh
    prescribed: Floats
    edges: EdgeTerms | None
    loose: Ints


def conditioned_mesh(
    triangulation: Triangulation, quadratic: QuadraticNodes, outline: Outline, conditions: Conditions
) -> ConditionedMesh:
    """Number the unknowns of a quadratic mesh, tie periodic nodes, and integrate mixed conditions.

    Where conditions meet, a point's comes before a curve's, and a curve's before one of a later curve. The axis of an
    axisymmetric problem has ψ = 0 whatever is written there.
    """
    chart, nodes = outline.chart, quadratic.nodes
    fixed, values = _prescribed(triangulation, quadratic, outline, conditions)
    root, sign = _tied(nodes.shape[0], _ties(triangulation, quadratic, outline.pairs))
    clash = sign == 0
    fixed |= clash
    sign[clash] = 1
    values[clash] = 0.0
    held = fixed | (sign < 0)
    mixed = np.array([_holds(outline, conditions, c) for c in range(len(outline.curves))], dtype=bool)
    held[quadratic.edges[mixed[triangulation.curve]]] = True
    loose = _loose(quadratic.elements, root, held)
    # Only differences of ψ matter in a part that nothing holds: its zero is at its first node.
    free, first = np.unique(loose, return_index=True)
    fixed[first[free >= 0]] = True
    # A prescribed node prescribes those tied to it.
    owner = np.zeros(nodes.shape[0], dtype=bool)
    shared = np.zeros(nodes.shape[0])
    given = np.flatnonzero(fixed)[::-1]
    owner[root[given]] = True
    shared[root[given]] = sign[given] * values[given]
    fixed = owner[root]
    values = np.where(fixed, sign * shared[root], 0.0)
    _, number = np.unique(root[~fixed], return_inverse=True)
    freedom = np.full(nodes.shape[0], -1)
    freedom[~fixed] = number
    topology = Topology(quadratic.elements, freedom, sign if np.any(sign[~fixed] < 0) else None, root)
    mesh = Mesh(chart, nodes, triangulation.region, topology)
    return ConditionedMesh(mesh, values, _edge_terms(mesh, triangulation, quadratic, outline, conditions), loose)


def _holds(outline: Outline, conditions: Conditions, curve: int) -> bool:
    """Whether a curve's mixed condition leaves the constant part of ψ no choice."""
    condition = outline.curves[curve].condition
    rule = None if condition is None else conditions.curves[condition]
    return isinstance(rule, Mixed) and rule.c0 != 0


def _loose(elements: Ints, root: Ints, held: np.ndarray) -> Ints:
    """(n,) number of the part of the mesh that each node is in, of the parts that nothing holds; −1 in the others."""
    count = root.size
    start, end = np.repeat(root[elements[:, 0]], 5), root[elements[:, 1:]].ravel()
    graph = coo_array((np.ones(start.size), (start, end)), shape=(count, count))
    parts, part = connected_components(graph, directed=False)
    part = part[root]
    known = np.ones(parts, dtype=bool)
    known[part] = False
    known[part[held]] = True
    return np.asarray(np.where(known, -1, np.cumsum(~known) - 1)[part])


def sides(triangulation: Triangulation) -> Ints:
    """(k,) of each curve edge: 1 where triangles lie on its left only, −1 on its right only, 0 on both."""
    count = triangulation.points.shape[0]
    corners = triangulation.triangles
    directed = np.unique((corners * count + np.roll(corners, -1, axis=1)).ravel())
    start, end = triangulation.edges.T
    left = np.isin(start * count + end, directed)
    right = np.isin(end * count + start, directed)
    return np.asarray(left.astype(int) - right.astype(int))


def _prescribed(
    triangulation: Triangulation, quadratic: QuadraticNodes, outline: Outline, conditions: Conditions
) -> tuple[np.ndarray, Floats]:
    """(n,) whether ψ is prescribed at a node by a condition or the axis, and its value."""
    space = in_space(outline.chart, quadratic.nodes)
    # A node's A counts r-fold in an axisymmetric problem: ψ = r A.
    factor = space[:, 0] if outline.chart == "axisymmetric" else np.ones(space.shape[0])
    fixed, values = np.zeros(space.shape[0], dtype=bool), np.zeros(space.shape[0])
    for number in reversed(range(len(outline.curves))):
        condition = outline.curves[number].condition
        rule = None if condition is None else conditions.curves[condition]
        if isinstance(rule, Prescribed):
            mine = np.unique(quadratic.edges[triangulation.curve == number])
            fixed[mine] = True
            values[mine] = factor[mine] * rule.potential(space[mine])
    for point, potential in conditions.points.items():
        node = quadratic.vertex[point]
        if node >= 0:
            fixed[node], values[node] = True, factor[node] * potential
    if outline.chart == "axisymmetric":
        axis = quadratic.nodes[:, 0] <= 0
        fixed[axis], values[axis] = True, 0.0
    return fixed, values


def _ties(triangulation: Triangulation, quadratic: QuadraticNodes, pairs: Sequence[Pair]) -> tuple[Ints, Ints, Ints]:
    """Nodes that share an unknown: (t,) of the first, (t,) of the second curve, and the sign between them."""
    first, second, signs = [np.zeros(0, dtype=int)], [np.zeros(0, dtype=int)], [np.zeros(0, dtype=int)]
    for pair in pairs:
        a = chain(quadratic.edges[triangulation.curve == pair.first])
        b = chain(quadratic.edges[triangulation.curve == pair.second])
        first.append(a)
        second.append(b[::-1] if pair.reverse else b)
        signs.append(np.full(a.size, pair.sign))
    return np.concatenate(first), np.concatenate(second), np.concatenate(signs)


def chain(edges: Ints) -> Ints:
    """(2 k + 1,) the nodes of one curve's edges (k, 3: start, end, middle) from its start to its end."""
    following = {int(start): (int(middle), int(end)) for start, end, middle in edges}
    first = set(following) - {end for _, end in following.values()}
    nodes = [first.pop()] if first else []
    while nodes and nodes[-1] in following:
        nodes.extend(following[nodes[-1]])
    return np.array(nodes, dtype=int)


def _tied(count: int, ties: tuple[Ints, Ints, Ints]) -> tuple[Ints, Ints]:
    """(n,) the node that stands for each node's unknown, and the sign between them; 0 where a node is minus itself."""
    root, sign = np.arange(count), np.ones(count, dtype=int)

    def find(node: int) -> tuple[int, int]:
        s = 1
        while root[node] != node:
            s *= int(sign[node])
            node = int(root[node])
        return node, s

    clash = set()
    for a, b, between in zip(*(t.tolist() for t in ties), strict=True):
        (ra, sa), (rb, sb) = find(a), find(b)
        if ra != rb:
            root[rb], sign[rb] = ra, sa * sb * between
        elif sa * sb != between:
            clash.add(ra)
    for node in {*ties[0].tolist(), *ties[1].tolist()}:
        ra, sa = find(node)
        root[node], sign[node] = ra, sa
    sign[np.isin(root, list(clash))] = 0
    return root, sign


def _edge_terms(
    mesh: Mesh, triangulation: Triangulation, quadratic: QuadraticNodes, outline: Outline, conditions: Conditions
) -> EdgeTerms | None:
    """∫ (c0 A + c1) v dl on the curves of mixed conditions; the 2π or the depth is the caller's."""
    rules = [None if c.condition is None else conditions.curves[c.condition] for c in outline.curves]
    mixed = [rule if isinstance(rule, Mixed) else None for rule in rules]
    chosen = np.flatnonzero([mixed[c] is not None for c in triangulation.curve])
    if not chosen.size:
        return None
    c0 = np.array([getattr(mixed[c], "c0", 0.0) for c in triangulation.curve[chosen]])
    c1 = np.array([getattr(mixed[c], "c1", 0.0) for c in triangulation.curve[chosen]])
    edges = quadratic.edges[chosen]
    weight, inverse = _along(mesh.chart, mesh.nodes[edges])
    matrices = np.einsum("k,kt,ti,tj->kij", c0, weight * inverse, _SHAPE, _SHAPE, optimize=True)
    load = -np.einsum("k,kt,ti->ki", c1, weight, _SHAPE, optimize=True)
    nodal = np.bincount(edges.ravel(), load.ravel(), mesh.nodes.shape[0])
    owners, locals_ = _owners(mesh.elements, edges)
    full = np.zeros((edges.shape[0], 6, 6))
    k = np.arange(edges.shape[0])[:, None, None]
    full[k, locals_[:, :, None], locals_[:, None, :]] = matrices
    return EdgeTerms(owners, full, np.asarray(nodal, dtype=float))


def _along(chart: Chart, nodes: Floats) -> tuple[Floats, Floats]:
    """(k, 4) arc length (m) of each Gauss point's share of an edge, and 1/r there (1/m), or 1 in a planar problem."""
    tangent = np.einsum("ti,kic->ktc", _SLOPE, nodes, optimize=True)
    if chart == "planar":
        length = np.hypot(tangent[..., 0], tangent[..., 1])
        return _W * length, np.ones_like(length)
    s = np.einsum("ti,ki->kt", _SHAPE, nodes[..., 0], optimize=True)
    r = np.sqrt(2 * np.maximum(s, np.finfo(float).tiny))
    length = np.hypot(tangent[..., 0] / r, tangent[..., 1])
    return _W * length, 1 / r


def _owners(elements: Ints, edges: Ints) -> tuple[Ints, Ints]:
    """(k,) an element that each edge (k, 3) belongs to, and (k, 3) where its nodes stand in it."""
    middles = elements[:, 3:]
    order = np.argsort(middles.ravel(), kind="stable")
    found = order[np.searchsorted(middles.ravel()[order], edges[:, 2])]
    owner = found // 3
    return owner, np.argmax(elements[owner][:, None, :] == edges[:, :, None], axis=2)
