"""The plain way through a mapped mesh's equations: one sparse matrix of all unknowns, factorised by SuperLU.

What the fast way (`cell_band`) is tested against.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from fluxbore.fem.asymptotic import Rim
from fluxbore.fem.factors import symmetric_superlu
from fluxbore.fem.mesh import Floats, Ints


class PlainFactor:
    """SuperLU of cells' matrices, put together without a thought; right sides and solutions are nodal."""

    def __init__(self, nodes: Ints, free: Any, matrices: Floats, rim: Rim | None) -> None:
        """nodes : (m, k) of the cells. free : (n,) whether a node's ψ is unknown. matrices : (m, k, k)."""
        from scipy.sparse import coo_array

        parts = [(nodes, matrices)] if rim is None else [(nodes, matrices), (rim.nodes, rim.matrices)]
        self._free = np.flatnonzero(free)
        rows, columns = (np.concatenate(where) for where in zip(*(_where(own) for own, _ in parts), strict=True))
        values = np.concatenate([own.ravel() for _, own in parts])
        whole = coo_array((values, (rows, columns)), shape=(free.size, free.size)).tocsr()
        self._factor = symmetric_superlu(whole[self._free][:, self._free].tocsc())

    def solve(self, right: Floats) -> Floats:
        """x (n,) or (n, k) with A x = right, zero where ψ is prescribed."""
        found = np.zeros_like(right)
        found[self._free] = self._factor.solve(right[self._free])
        return found


def _where(nodes: Ints) -> tuple[Ints, Ints]:
    """Rows and columns of matrices' entries (m, k, k), flat."""
    k = nodes.shape[1]
    return np.repeat(nodes, k, axis=1).ravel(), np.tile(nodes, (1, k)).ravel()
