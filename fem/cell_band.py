"""The band of a mapped mesh's equations, the inside of its cells condensed out, and its factor.

The nodes that are left are numbered as in the lattice, along r first: the domain is long in z, so the band is narrow.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from fluxbore.fem.cell_matrices import Condensed, Precision
from fluxbore.fem.cells import cell_nodes
from fluxbore.fem.factors import Band
from fluxbore.fem.mesh import Floats, Ints, Topology
from fluxbore.fem.tensor_product import square

KEPT_ENTRIES = 8


@dataclass(frozen=True, slots=True, eq=False)
class Entries:
    """Of cells' matrices (m, e, e) the entries in the lower triangle, their places in the flat band, each once, and
    which of these each entry is added to."""

    sources: Ints
    places: Ints
    targets: Ints

    def add(self, band: Any, edge: Any) -> None:
        """To a band in place."""
        sums = np.bincount(self.targets, edge.ravel()[self.sources], self.places.size)
        band.reshape(-1)[self.places] += sums.astype(band.dtype, copy=False)


class Places:
    """Where cells' matrices land in the band; made once for all designs and positions of a topology.

    kept : (k,) nodes that are left. number : (n,) which of them a node is, or −1. edge, inner : (m, e) and (m, i) nodes
    of each cell.
    """

    def __init__(self, topology: Topology, rows: int, columns: int, order: int) -> None:
        shape = square(order)
        nodes = cell_nodes(rows, columns, order)
        self.count = topology.freedom.size
        self.edge, self.inner = nodes[:, : shape.edge], nodes[:, shape.edge :]
        left = topology.freedom >= 0
        left[self.inner] = False
        self.kept = np.flatnonzero(left)
        self.number = np.full(self.count, -1)
        self.number[self.kept] = np.arange(self.kept.size)
        unknown = self.number[self.edge]
        self.bandwidth = int((unknown.max(axis=1) - np.where(unknown < 0, unknown.size, unknown).min(axis=1)).max())
        self._entries: dict[bytes, Entries] = {}

    def entries(self, chosen: Ints) -> Entries:
        """How some cells' matrices are added to a band."""
        return self._kept(chosen.tobytes(), lambda: self.edge[chosen])

    def entries_of(self, nodes: Ints) -> Entries:
        """How matrices of some nodes (m, e) are added to a band."""
        return self._kept(nodes.tobytes(), lambda: nodes)

    def _kept(self, code: bytes, nodes: Callable[[], Ints]) -> Entries:
        """The last few are kept: a topology's designs ask alike."""
        if code not in self._entries:
            if len(self._entries) == KEPT_ENTRIES:
                del self._entries[next(iter(self._entries))]
            self._entries[code] = self._found(nodes())
        return self._entries[code]

    def _found(self, nodes: Ints) -> Entries:
        unknown = self.number[nodes]
        row, column = np.repeat(unknown, nodes.shape[1], axis=1).ravel(), np.tile(unknown, (1, nodes.shape[1])).ravel()
        real = np.flatnonzero((column >= 0) & (row >= column))
        target = column[real] * (self.bandwidth + 1) + row[real] - column[real]
        return Entries(real, *np.unique(target, return_inverse=True))

    def empty_band(self, precision: Precision) -> Any:
        """(k, bandwidth + 1) for the lower triangle, by columns from the diagonal down."""
        return np.zeros((self.kept.size, self.bandwidth + 1), dtype=precision)


@lru_cache(maxsize=4)
def places(topology: Topology, rows: int, columns: int, order: int) -> Places:
    """Of a topology of so many rows and columns of cells."""
    return Places(topology, rows, columns, order)


class CellFactor(ABC):
    """A factorised matrix of a mapped mesh: right sides and solutions are nodal, zero where ψ is prescribed."""

    def solve(self, right: Floats) -> Floats:
        """x (n,) or (n, k) with A x = right."""
        return self._solved(right) if right.ndim == 2 else self._solved(right[:, None])[:, 0]

    @abstractmethod
    def _solved(self, columns: Floats) -> Floats:
        """(n, k) of right sides (n, k)."""


class BandFactor(CellFactor):
    """By LAPACK, in the precision of the band: with single precision, four or five digits, a solution reads half of the
    memory."""

    def __init__(self, where: Places, band: Any, parts: Sequence[tuple[Ints, Condensed]]) -> None:
        """band : overwritten. parts : which cells, and what was inside of them. Raises SingularMatrixError."""
        super().__init__()
        self._where, self.precision = where, band.dtype
        self._band = Band(band)
        self._inner = np.concatenate([where.inner[chosen] for chosen, _ in parts])
        self._edge = np.concatenate([where.edge[chosen] for chosen, _ in parts])
        self._inverse = np.concatenate([cells.inverse for _, cells in parts])
        self._coupling = np.concatenate([cells.coupling for _, cells in parts])

    def _solved(self, columns: Floats) -> Floats:
        return np.column_stack([self._one(column) for column in columns.T])

    def _one(self, right: Floats) -> Floats:
        where = self._where
        scale = float(np.abs(right).max(initial=0.0)) or 1.0  # within what single precision can hold
        scaled = (right / scale).astype(self.precision)
        inside = scaled[self._inner]
        pull = np.einsum("mi,mie->me", inside, self._coupling)
        scaled -= np.bincount(self._edge.ravel(), pull.ravel(), where.count).astype(self.precision)
        found = np.zeros_like(scaled)
        found[where.kept] = self._band.solve(scaled[where.kept])
        inside = np.einsum("mij,mj->mi", self._inverse, inside)
        found[self._inner] = inside - np.einsum("mie,me->mi", self._coupling, found[self._edge])
        return found.astype(float) * scale
