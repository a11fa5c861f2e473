"""Smoothed aggregation: one cycle is a symmetric positive definite operator that holds for any sign of the unknowns."""

import numpy as np
import pytest
from scipy.sparse import csr_array, diags_array, eye_array, kron

from fluxbore.fem.aggregation import v_cycle


def laplacian(cells: int) -> csr_array:
    line = diags_array([-1.0, 2.0, -1.0], offsets=[-1, 0, 1], shape=(cells, cells))
    unit = eye_array(cells)
    return csr_array(kron(line, unit) + kron(unit, line))


def contraction(matrix: csr_array, signs: np.ndarray) -> float:
    """Reduction of the error's energy per cycle, after a few."""
    cycle = v_cycle(csr_array(matrix * signs[:, None] * signs[None, :]), 0.08)
    error = np.random.default_rng(1).normal(size=matrix.shape[0])
    rate = 0.0
    for _ in range(12):
        before = error @ (matrix @ error)
        error = error - signs * (cycle @ (signs * (matrix @ error)))
        rate = float((error @ (matrix @ error)) / before) ** 0.5
    return rate


def test_a_cycle_contracts_alike_on_any_mesh() -> None:
    """Catches interpolation that misses smooth errors: each refinement would take the rate nearer to one."""
    rates = [contraction(laplacian(cells), np.ones(cells**2)) for cells in (20, 40, 80)]
    assert max(rates) < 0.45, rates


def test_a_cycle_is_symmetric_and_positive() -> None:
    """Catches smoothers in the wrong order, which conjugate gradients cannot bear."""
    cycle = v_cycle(laplacian(24), 0.08)
    rng = np.random.default_rng(2)
    x, y = rng.normal(size=(2, 24**2))
    assert x @ (cycle @ y) == pytest.approx(y @ (cycle @ x), rel=1e-10)
    assert x @ (cycle @ x) > 0


def test_a_small_matrix_is_solved_exactly() -> None:
    """Catches a coarsest grid that is smoothed only."""
    matrix = laplacian(8)
    x = np.arange(64.0)
    assert v_cycle(matrix, 0.08) @ (matrix @ x) == pytest.approx(x)


def test_an_unknown_of_its_own_does_no_harm() -> None:
    """Catches a division by an aggregate without members: an unknown that is coupled to nothing."""
    matrix = laplacian(20).tolil()
    matrix[57, :] = 0
    matrix[:, 57] = 0
    matrix[57, 57] = 3.0
    assert contraction(csr_array(matrix), np.ones(400)) < 0.45


def test_signs_of_unknowns_do_little_harm() -> None:
    """Catches a cycle that diverges where signs change, as they do across an antiperiodic pair."""
    signs = np.where(np.arange(40**2) < 20 * 40, 1.0, -1.0)
    assert contraction(laplacian(40), signs) < 0.9
