"""Unknowns inside of cells condensed out of the band: against dense algebra, on a mapped mesh's own pattern."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from fluxbore.fem.element import kernel, stiffness
from fluxbore.fem.factors import BandedCholesky, SingularMatrixError
from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.pattern import Pattern


@pytest.fixture(scope="module")
def matrix(block: Callable[..., MappedMesh]) -> tuple[Pattern, np.ndarray]:
    """The stiffness of air in five by five cells, on which every unknown has a weight of its own."""
    mesh = block(5).mesh
    found = kernel(mesh)
    uneven = 1 + np.random.default_rng(3).uniform(size=found.weight.shape)
    pattern = mesh.topology.pattern
    return pattern, pattern.assemble(stiffness(found.curl, found.weight * uneven))


def test_one_unknown_of_each_cell_is_condensed(matrix: tuple[Pattern, np.ndarray]) -> None:
    """Catches a mesh that no longer says which nodes are inside: the band would be wide again, and slow."""
    pattern, _ = matrix
    places = pattern.condensation
    assert places is not None
    assert places.inner.size == 25
    assert places.size + places.inner.size == pattern.unknowns
    assert places.bandwidth < 0.8 * pattern.bandwidth


@pytest.mark.parametrize("columns", [None, 3])
def test_condensed_factor_solves_the_whole_matrix(matrix: tuple[Pattern, np.ndarray], columns: int | None) -> None:
    """Catches a coupling that is lost or counts twice: against dense algebra, and roughly in single precision."""
    pattern, values = matrix
    right = np.random.default_rng(4).normal(size=(pattern.unknowns, *([columns] if columns else [])))
    exact = np.linalg.solve(pattern.matrix(values).toarray(), right)
    factor = BandedCholesky(pattern, values)
    assert factor.solve(right) == pytest.approx(exact, rel=1e-9, abs=1e-11 * np.abs(exact).max())
    if columns:
        assert factor.solve_roughly(right) == pytest.approx(exact, rel=1e-3, abs=1e-4 * np.abs(exact).max())


def test_condensed_and_plain_factors_agree(matrix: tuple[Pattern, np.ndarray]) -> None:
    """Catches a condensed path that is another matrix: the plain path is the same pattern without inner unknowns."""
    pattern, values = matrix
    plain = dataclasses.replace(pattern, inner=None)
    right = np.random.default_rng(5).normal(size=pattern.unknowns)
    assert BandedCholesky(pattern, values).solve(right) == pytest.approx(
        BandedCholesky(plain, values).solve(right), rel=1e-10
    )


def test_a_condensed_matrix_that_is_not_definite(matrix: tuple[Pattern, np.ndarray]) -> None:
    """Catches a negative pivot inside of a cell, which the band alone would not see."""
    pattern, values = matrix
    assert pattern.inner is not None
    spoilt = values.copy()
    spoilt[np.flatnonzero((pattern.rows == pattern.inner[7]) & (pattern.columns == pattern.inner[7]))] *= -1
    with pytest.raises(SingularMatrixError):
        BandedCholesky(pattern, spoilt)


def test_single_precision_is_refined(matrix: tuple[Pattern, np.ndarray]) -> None:
    """Catches a solution that is left at five digits: the residual is that of double precision."""
    pattern, values = matrix
    factor = BandedCholesky(pattern, values)
    right = np.random.default_rng(6).normal(size=pattern.unknowns)
    rough = pattern.multiply(values, factor.once(right)) - right
    fine = pattern.multiply(values, factor.solve(right)) - right
    assert not factor.exact
    assert np.linalg.norm(fine) < 1e-13 * np.linalg.norm(right) < np.linalg.norm(rough)


def test_double_precision_where_sweeps_do_not_gain(
    matrix: tuple[Pattern, np.ndarray], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Catches an ill-conditioned matrix that is left with a factor of five digits, by a rule that no sweep meets."""
    pattern, values = matrix
    monkeypatch.setattr("fluxbore.fem.factors.WORTH", 0.0)
    monkeypatch.setattr("fluxbore.fem.factors.ROUNDING", 0.0)
    factor = BandedCholesky(pattern, values)
    right = np.random.default_rng(7).normal(size=pattern.unknowns)
    found = factor.solve(right)
    assert factor.exact
    assert np.linalg.norm(pattern.multiply(values, found) - right) < 1e-12 * np.linalg.norm(right)
