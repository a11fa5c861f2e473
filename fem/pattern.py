"""Where element matrices land in a sparse symmetric matrix.

A `Pattern` is made once and shared by all Newton steps, positions and designs of one mesh topology.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int_]


KEPT_GATHERS = 4


@dataclass(frozen=True, eq=False)
class Gather:
    """How entries of some elements' matrices are summed into the lower triangle.

    sources : (k,) flat index into the element matrices of the entries that count. targets : (k,) index into (nnz,) for
    each source. signs : (k,) ±1, None where all are +1.
    """

    nonzeros: int
    sources: Ints
    targets: Ints
    signs: Floats | None

    def assemble(self, matrices: Floats) -> Floats:
        """(nnz,) values of the global matrix from the element matrices (m, k, k)."""
        entries = matrices.ravel()[self.sources]
        if self.signs is not None:
            entries *= self.signs
        return np.asarray(np.bincount(self.targets, entries, self.nonzeros))


@dataclass(frozen=True, eq=False)
class Pattern:
    """The lower triangle's nonzero positions, and how entries of element matrices are summed into them.

    rows, columns : (nnz,) of the lower triangle, sorted by column, then by row.
    gather : of all elements' matrices.
    freedom : (m, k) unknown of each element's node, -1 where there is none.
    sign : (m, k) ±1, the node's value being sign times the unknown; None where all are +1.
    """

    unknowns: int
    rows: Ints
    columns: Ints
    gather: Gather
    freedom: Ints
    sign: Ints | None

    @classmethod
    def of_elements(cls, freedom: Ints, unknowns: int, sign: Ints | None = None) -> Pattern:
        """freedom : (m, k) unknown of each element's node, -1 where there is none.

        sign : (m, k) ±1, the node's value being sign times the unknown (-1 on one side of an antiperiodic pair). Two
        nodes of an element may share an unknown: both of their mixed entries are then on the diagonal, and both count.
        """
        k = freedom.shape[1]
        number = freedom.astype(_index_type(freedom.size * k))
        row = np.repeat(number, k, axis=1).ravel()
        column = np.tile(number, (1, k)).ravel()
        sources = np.flatnonzero((column >= 0) & (row >= column))
        row, column = row[sources], column[sources]
        order = _counting_sort(row, unknowns)
        order = order[_counting_sort(column[order], unknowns)]
        row, column = row[order], column[order]
        first = np.ones(order.size, dtype=bool)
        first[1:] = (row[1:] != row[:-1]) | (column[1:] != column[:-1])
        rows, columns = row[first].astype(np.int_), column[first].astype(np.int_)
        targets = np.empty(order.size, dtype=np.int_)
        targets[order] = np.cumsum(first) - 1
        signs = None
        if sign is not None:
            signs = (sign[:, :, None] * sign[:, None, :]).ravel()[sources].astype(float)
        return cls(unknowns, rows, columns, Gather(rows.size, sources, targets, signs), freedom, sign)

    @property
    def nonzeros(self) -> int:
        return self.rows.size

    def assemble(self, matrices: Floats) -> Floats:
        """(nnz,) values of the global matrix from all element matrices (m, k, k)."""
        return self.gather.assemble(matrices)

    def subset_assembler(self, elements: Ints) -> Gather:
        """Sums the matrices (len(elements), k, k) of some elements only. The last few are kept: positions and designs
        of a topology ask for the same."""
        code = elements.tobytes()
        if code not in self._gathers:
            if len(self._gathers) == KEPT_GATHERS:
                del self._gathers[next(iter(self._gathers))]
            self._gathers[code] = self._gather_of(elements)
        return self._gathers[code]

    @cached_property
    def _gathers(self) -> dict[bytes, Gather]:
        return {}

    def _gather_of(self, elements: Ints) -> Gather:
        count, k = self.freedom.shape
        block = k * k
        place = np.full(count, -1)
        place[elements] = np.arange(elements.size)
        owner = place[self.gather.sources // block]
        chosen = np.flatnonzero(owner >= 0)
        sources = owner[chosen] * block + self.gather.sources[chosen] % block
        signs = None if self.gather.signs is None else self.gather.signs[chosen]
        return Gather(self.nonzeros, sources, self.gather.targets[chosen], signs)

    def subset(self, elements: Ints) -> tuple[Ints, Ints]:
        """Sources and targets of some elements only, for matrices (len(elements), k, k) of just these; no signs."""
        gather = self.subset_assembler(elements)
        return gather.sources, gather.targets

    @cached_property
    def bandwidth(self) -> int:
        return int((self.rows - self.columns).max(initial=0))

    @cached_property
    def symmetric(self) -> tuple[Ints, Ints, Ints]:
        """(indices, indptr, order): the full matrix in compressed columns; order picks its values from (nnz,).

        The pattern is symmetric, so these are its compressed rows as well.
        """
        index = _index_type(2 * self.nonzeros)
        upper = np.flatnonzero(self.rows != self.columns)
        # By row, and within a row by column: the columns of the upper triangle.
        upper = upper[_counting_sort(self.rows[upper].astype(index), self.unknowns)]
        above = np.bincount(self.rows[upper], minlength=self.unknowns)
        below = np.bincount(self.columns, minlength=self.unknowns)
        start = np.concatenate(([0], np.cumsum(above + below)))
        order = np.empty(start[-1], dtype=index)
        indices = np.empty(start[-1], dtype=index)
        # A column's entries: those above the diagonal first. The k-th of all the entries above comes after the entries
        # below in the columns before its own, and the other way round.
        at = np.arange(upper.size) + (start[:-1] - np.cumsum(above) + above)[self.rows[upper]]
        order[at], indices[at] = upper, self.columns[upper]
        at = np.arange(self.nonzeros) + (start[:-1] + above - np.cumsum(below) + below)[self.columns]
        order[at], indices[at] = np.arange(self.nonzeros), self.rows
        return indices, start.astype(index), order

    def matrix(self, values: Floats) -> Any:
        """The full symmetric matrix of these values (nnz,) in scipy's compressed columns."""
        from scipy.sparse import csc_matrix

        indices, start, order = self.symmetric
        return csc_matrix((values[order], indices, start), shape=(self.unknowns, self.unknowns))

    def multiply(self, values: Floats, vector: Floats) -> Floats:
        """A x for the symmetric matrix of these values."""
        return np.asarray(self.matrix(values) @ vector)


def _index_type(largest: int) -> type[np.signedinteger[Any]]:
    """Four bytes for an index where they do: half the memory at a million unknowns."""
    return np.int32 if largest < 2**31 else np.int64


def _counting_sort(keys: Ints, limit: int) -> Ints:
    """The permutation that sorts keys in [0, limit), equal ones in their order, in linear time.

    It is what changing from compressed rows to compressed columns does.
    """
    from scipy.sparse import csr_array

    index = _index_type(keys.size)
    ones = np.ones(keys.size, dtype=np.int8)
    matrix = csr_array((ones, keys, np.arange(keys.size + 1, dtype=index)), shape=(keys.size, limit))
    return np.asarray(matrix.tocsc().indices)


def near_numbering(elements: Ints, nodes: int) -> Ints:
    """(nodes,) new number of each node such that neighbours have near numbers (Cuthill and McKee 1969, reversed).

    elements : (m, k) node numbers. Meshers number at random, and then each of a million unknowns is fetched from
    memory far away: iterations take three times as long.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    m, k = elements.shape
    index = _index_type(2 * elements.size)
    ends = np.arange(0, elements.size + 1, k, dtype=index)
    down = csr_array((np.ones(elements.size, dtype=np.int8), elements.ravel().astype(index), ends), shape=(m, nodes))
    up = down.T.tocsr()
    # The graph of nodes and elements, each node tied to its elements, is a third of that of nodes alone.
    graph = csr_array(
        (
            np.ones(2 * elements.size, dtype=np.int8),
            np.concatenate((up.indices + index(nodes), down.indices)),
            np.concatenate((up.indptr, up.indptr[-1] + down.indptr[1:])),
        ),
        shape=(nodes + m, nodes + m),
    )
    order = reverse_cuthill_mckee(graph, symmetric_mode=True)
    place = np.empty(nodes, dtype=np.int_)
    place[order[order < nodes]] = np.arange(nodes)
    return place
