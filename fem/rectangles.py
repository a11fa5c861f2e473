"""The linear part of a mapped mesh's equations, from the sides of its rectangles.

A rectangle of width w in s and height h in z has the matrix

    K = ν_z h/w A + ν_r w/h B ,   A = ∫ ∂_s φ ∂_s φᵀ ,   B = ∫ (1/2s) ∂_z φ ∂_z φᵀ   (on the unit square),

where A is the same for all and B differs by column only. The matrix of a whole mesh is therefore a fixed sparse
operator times one number for each cell; what belongs to the topology is made once, what belongs to the radii once a
design. The rule of quadrature is the triangles' own, so that both ways give the same numbers but for rounding.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from fluxbore.fem.cells import ACROSS, ALONG, SHARE, WEIGHTS, chequered
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Topology
from fluxbore.fem.problem import EdgeTerms, LinearPart, MagneticMaterial
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY

_FIRST, _SECOND = np.tril_indices(9)
_ACROSS_PAIRS = (ACROSS * WEIGHTS) @ ACROSS.T
_SHIFT = (ACROSS * WEIGHTS).sum(axis=1)
"""(9,) ∫ ∂_s φ on the unit square."""

_TOUCHED = ((ACROSS != 0) | (ALONG != 0)).astype(float)
_MEET = np.flatnonzero((_TOUCHED @ _TOUCHED.T)[_FIRST, _SECOND] > 0)
"""The pairs of a cell's nodes that meet in one of its triangles."""


class _Places:
    """Where the pairs of every cell's nodes land in the pattern of a topology."""

    def __init__(self, topology: Topology, rows: int, columns: int) -> None:
        pattern = topology.pattern
        self.nodes, mirrored = chequered(rows, columns)
        unknown = topology.freedom[self.nodes]
        first, second = (unknown[:, index[_MEET]] for index in (_FIRST, _SECOND))
        cell, pair = np.nonzero((first >= 0) & (second >= 0))
        one, other = first[cell, pair], second[cell, pair]
        codes = np.minimum(one, other) * pattern.unknowns + np.maximum(one, other)
        target = np.searchsorted(pattern.columns * pattern.unknowns + pattern.rows, codes)
        order = np.argsort(target, kind="stable")
        self.cell, self.pair = cell[order], pair[order]
        self.starts = np.searchsorted(target[order], np.arange(pattern.nonzeros + 1))
        self.kind = 2 * (np.arange(self.nodes.shape[0]) % columns) + mirrored.ravel()
        self.operator = self.sparse(_ACROSS_PAIRS[_FIRST, _SECOND][_MEET][self.pair])

    def sparse(self, values: Floats) -> Any:
        """(nnz, cells) with these values, one for each place."""
        from scipy.sparse import csr_array

        return csr_array((values, self.cell, self.starts), shape=(self.starts.size - 1, self.nodes.shape[0]))


@lru_cache(maxsize=4)
def _places(topology: Topology, rows: int, columns: int) -> _Places:
    return _Places(topology, rows, columns)


@lru_cache(maxsize=2)
def _along(places: _Places, lines: bytes) -> Any:
    """(nnz, cells) times ν_r/h, for lines in s."""
    s = np.frombuffer(lines)
    width = np.diff(s)
    table = np.empty((width.size, 2, _MEET.size))
    for mirrored, start, signed in ((0, s[:-1], width), (1, s[1:], -width)):
        at = start[:, None] + signed[:, None] * SHARE
        pairs = np.einsum("np,cp,mp->cnm", ALONG, width[:, None] * WEIGHTS / (2 * at), ALONG, optimize=True)
        table[:, mirrored] = pairs[:, _FIRST, _SECOND][:, _MEET]
    return places.sparse(table.reshape(-1, _MEET.size)[places.kind[places.cell], places.pair])


def linear_part(
    grid: MappedMesh, materials: tuple[MagneticMaterial, ...], edges: EdgeTerms | None = None
) -> LinearPart | None:
    """Of a mapped mesh with materials that are the same all over; None where one is not, or has sheets.

    Magnets along z only.
    """
    if not all(_plain(material) for material in materials):
        return None
    topology = grid.mesh.topology
    s = grid.r_nodes[::2]
    width, height = np.diff(s), np.diff(grid.z_lines)
    places = _places(topology, height.size, width.size)
    region = grid.mesh.region[::2]
    nu_r, nu_z = np.array([material.components for material in materials]).T[:, region]
    aspect = (height[:, None] / width).ravel()
    values = places.operator @ (nu_z * aspect)
    values += _along(places, s.tobytes()) @ (nu_r / np.repeat(height, width.size))
    if edges is not None:
        values += _of_edges(topology, edges)
    coercivity = np.array([_coercivity(material) for material in materials])[region]
    magnets = np.flatnonzero(coercivity)
    # Of a mirrored cell both w and the slope across it are turned round.
    sign = np.where(places.kind[magnets] % 2, -1.0, 1.0)
    pull = (coercivity[magnets] * sign * height[magnets // width.size])[:, None] * _SHIFT
    load = np.bincount(places.nodes[magnets].ravel(), pull.ravel(), grid.mesh.nodes.shape[0])
    return LinearPart(np.asarray(values), np.asarray(load, dtype=float))


def _plain(material: MagneticMaterial) -> bool:
    uniform = material.stack is None and material.grade is None and not callable(material.coercivity)
    return uniform and _radial(material) == 0.0


def _radial(material: MagneticMaterial) -> float:
    return 0.0 if callable(material.coercivity) else material.coercivity[0]


def _coercivity(material: MagneticMaterial) -> float:
    return 0.0 if callable(material.coercivity) else material.coercivity[1]


def _of_edges(topology: Topology, edges: EdgeTerms) -> Floats:
    """(nnz,); an element may own several edges."""
    elements, place = np.unique(edges.elements, return_inverse=True)
    matrices = np.zeros((elements.size, *edges.matrices.shape[1:]))
    np.add.at(matrices, place.ravel(), edges.matrices)
    return topology.pattern.subset_assembler(elements).assemble(matrices)


def shell_pull(grid: MappedMesh, annulus: tuple[float, float], psi: Floats) -> Floats:
    """(n,) ∂F/∂ψ of the axial force on all that is inside an annulus of air; see `force.ForceShell`.

    Its density has one derivative along s and one along z, so that over ds dz the sides of a rectangle cancel: the
    operator is a topology's.
    """
    inner, outer = (grid.line(radius) for radius in annulus)
    rows, columns = grid.z_lines.size - 1, grid.r_lines.size - 1
    width = (annulus[1] ** 2 - annulus[0] ** 2) / 2
    return np.asarray(_shear(rows, columns, inner, outer) @ psi) * (-2 * np.pi * VACUUM_RELUCTIVITY / width)


@lru_cache(maxsize=4)
def _shear(rows: int, columns: int, inner: int, outer: int) -> Any:
    """(n, n) of ∫ ∂_s u ∂_z v + ∂_z u ∂_s v ds dz over the columns between two lines."""
    from scipy.sparse import csr_array

    nodes, mirrored = chequered(rows, columns)
    column = np.arange(nodes.shape[0]) % columns
    chosen = np.flatnonzero((column >= inner) & (column < outer))
    pairs = (ACROSS * WEIGHTS) @ ALONG.T
    values = np.where(mirrored.ravel()[chosen], -1.0, 1.0)[:, None] * (pairs + pairs.T).ravel()
    where = (np.repeat(nodes[chosen], 9, axis=1).ravel(), np.tile(nodes[chosen], (1, 9)).ravel())
    size = (2 * rows + 1) * (2 * columns + 1)
    return csr_array((values.ravel(), where), shape=(size, size))
