"""The coarse grids of algebraic multigrid by smoothed aggregation (Vaněk, Mandel and Brezina 1996).

Unknowns that are strongly coupled,  |a_ij| ≥ θ √(a_ii a_jj) ,  are joined to one unknown of the next grid. With T
spreading a coarse unknown evenly over its aggregate, the interpolation and the next matrix are

    P = T − ω D⁻¹ A T ,   A' = Pᵀ A P ,   ω = 4/3 ,

D the sums of |a_ij| by rows, a bound of the spectral radius: estimates of it would begin with random vectors, and the
same model must give the same digits twice. pyamg finds the aggregates and runs the cycle; its own set-up takes three
times as long, in a loop over blocks of one entry.
"""

from __future__ import annotations

from typing import Any

import numpy as np

COARSEST = 200
"""Unknowns of a grid that is factorised."""

MOST_GRIDS = 12

OMEGA = 4 / 3


def v_cycle(matrix: Any, strength: float) -> Any:
    """One symmetric V-cycle as a linear operator.

    matrix : (n, n) in compressed rows, symmetric with a positive diagonal. strength : θ.

    Raises RuntimeError where the coarsest grid's matrix is singular.
    """
    from pyamg.aggregation.aggregate import standard_aggregation
    from pyamg.multilevel import MultilevelSolver
    from pyamg.relaxation.smoothing import change_smoothers
    from pyamg.strength import symmetric_strength_of_connection

    smooth = np.ones(matrix.shape[0])
    grids = []
    while True:
        grid = MultilevelSolver.Level()
        grid.A = matrix
        grids.append(grid)
        if matrix.shape[0] <= COARSEST or len(grids) == MOST_GRIDS:
            break
        members, _ = standard_aggregation(symmetric_strength_of_connection(matrix, strength))
        if not 0 < members.shape[1] < matrix.shape[0]:
            break
        spread, smooth = _tentative(members, smooth)
        grid.P = _smoothed(matrix, spread)
        grid.R = grid.P.T.tocsr()
        matrix = grid.R @ (matrix @ grid.P)
        matrix.sort_indices()
    solver = MultilevelSolver(grids, coarse_solver="splu")
    change_smoothers(solver, ("gauss_seidel", {"sweep": "forward"}), ("gauss_seidel", {"sweep": "backward"}))
    return solver.aspreconditioner(cycle="V")


def _tentative(members: Any, smooth: Any) -> tuple[Any, Any]:
    """T with orthonormal columns, and the coarse vector that it takes to the smooth one.

    members : (n, k) ones in compressed rows, at most one in each.
    """
    from scipy.sparse import csr_array

    values = smooth[np.diff(members.indptr) > 0]
    size = np.sqrt(np.bincount(members.indices, values**2, members.shape[1]))
    size[size == 0] = 1.0
    return csr_array((values / size[members.indices], members.indices, members.indptr), shape=members.shape), size


def _smoothed(matrix: Any, spread: Any) -> Any:
    row = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    bound = np.bincount(row, np.abs(matrix.data), matrix.shape[0])
    correction = matrix @ spread
    correction.data *= np.repeat(OMEGA / bound, np.diff(correction.indptr))
    return (spread - correction).tocsr()
