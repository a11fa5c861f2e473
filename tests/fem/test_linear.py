"""Factorisations: each against dense algebra and against the other; the pattern; the corrected neighbour."""

import numpy as np
import pytest

from fluxbore.fem.factors import BandedCholesky, SingularMatrixError, SuperLU
from fluxbore.fem.linear import Corrected, factorise
from fluxbore.fem.magnetostatics import Settings, Solution, solve
from fluxbore.fem.pattern import Pattern


@pytest.fixture(scope="module")
def small() -> tuple[Pattern, np.ndarray, np.ndarray]:
    """A pattern of random elements of six nodes, its values, and the same matrix in full."""
    rng = np.random.default_rng(1)
    freedom = np.array([[k, k + 1, *rng.choice(np.arange(k + 2, k + 14), 4, replace=False)] for k in range(0, 40, 2)])
    unknowns = 40
    freedom[freedom >= unknowns] = -1
    pattern = Pattern.of_elements(freedom, unknowns)
    root = rng.normal(size=(freedom.shape[0], 6, 6))
    matrices = root @ root.transpose(0, 2, 1) + 0.1 * np.eye(6)
    full = np.zeros((unknowns, unknowns))
    for row, matrix in zip(freedom, matrices, strict=True):
        kept = row >= 0
        full[np.ix_(row[kept], row[kept])] += matrix[np.ix_(kept, kept)]
    assert np.all(np.diag(full) > 0)
    return pattern, matrices, full


def test_pattern_sums_elements(small: tuple[Pattern, np.ndarray, np.ndarray]) -> None:
    """Catches an entry that lands in the wrong place: against a plain loop over elements."""
    pattern, matrices, full = small
    values = pattern.assemble(matrices)
    dense = np.zeros_like(full)
    dense[pattern.rows, pattern.columns] = values
    assert dense == pytest.approx(np.tril(full))
    assert pattern.bandwidth == max(i - j for i, j in zip(*np.nonzero(full), strict=True))


def test_pattern_of_some_elements(small: tuple[Pattern, np.ndarray, np.ndarray]) -> None:
    """Catches a subset whose entries are another element's: part and rest make the whole."""
    pattern, matrices, _ = small
    total = np.zeros(pattern.nonzeros)
    for chosen in (np.array([7, 3, 11]), np.setdiff1d(np.arange(20), [3, 7, 11])):
        sources, targets = pattern.subset(chosen)
        total += np.bincount(targets, matrices[chosen].ravel()[sources], pattern.nonzeros)
    assert total == pytest.approx(pattern.assemble(matrices))


@pytest.fixture(scope="module")
def paired() -> tuple[Pattern, np.ndarray, np.ndarray]:
    """The same with signs, and with unknowns that two nodes of one element share, some with opposite signs."""
    rng = np.random.default_rng(11)
    unknowns = 30
    freedom = np.array([rng.choice(np.arange(k, k + 10), 6) for k in range(21)])
    freedom[:, 0] = np.arange(21)  # so that every unknown occurs
    freedom[-1, :] = np.arange(24, 30)
    freedom[:9, 1] = np.arange(21, 30)
    freedom[rng.uniform(size=freedom.shape) < 0.1] = -1
    sign = rng.choice([-1, 1], freedom.shape)
    assert any(np.unique(row[row >= 0]).size < np.count_nonzero(row >= 0) for row in freedom)
    root = rng.normal(size=(freedom.shape[0], 6, 6))
    matrices = root @ root.transpose(0, 2, 1)
    full = np.zeros((unknowns, unknowns))
    for row, signs, matrix in zip(freedom, sign, matrices, strict=True):
        spread = np.zeros((6, unknowns))  # node values from unknowns
        for node in range(6):
            if row[node] >= 0:
                spread[node, row[node]] = signs[node]
        full += spread.T @ matrix @ spread
    return Pattern.of_elements(freedom, unknowns, sign), matrices, full


def test_pattern_with_signs_and_shared_unknowns(paired: tuple[Pattern, np.ndarray, np.ndarray]) -> None:
    """Catches a lost sign, and a mixed entry of two nodes on one unknown that counts once: against TᵀKT."""
    pattern, matrices, full = paired
    values = pattern.assemble(matrices)
    assert pattern.matrix(values).toarray() == pytest.approx(full)
    dense = np.zeros_like(full)
    dense[pattern.rows, pattern.columns] = values
    assert dense == pytest.approx(np.tril(full))


def test_subset_with_signs(paired: tuple[Pattern, np.ndarray, np.ndarray]) -> None:
    """Catches signs that stay behind when elements are picked, in any order."""
    pattern, matrices, _ = paired
    total = np.zeros(pattern.nonzeros)
    for chosen in (np.array([7, 3, 11]), np.setdiff1d(np.arange(21), [3, 7, 11]), np.zeros(0, dtype=int)):
        total += pattern.subset_assembler(chosen).assemble(matrices[chosen])
    assert total == pytest.approx(pattern.assemble(matrices))


def test_the_full_matrix_is_in_order(small: tuple[Pattern, np.ndarray, np.ndarray]) -> None:
    """Catches compressed columns whose rows are not sorted, which scipy would sort again at every step."""
    pattern, matrices, full = small
    matrix = pattern.matrix(pattern.assemble(matrices))
    assert matrix.has_canonical_format
    assert matrix.toarray() == pytest.approx(full)
    order = np.lexsort((pattern.rows, pattern.columns))
    assert np.array_equal(order, np.arange(pattern.nonzeros))


def test_multiply(small: tuple[Pattern, np.ndarray, np.ndarray]) -> None:
    """Catches a symmetric half that is lost, or a diagonal that counts twice."""
    pattern, matrices, full = small
    x = np.random.default_rng(2).normal(size=full.shape[0])
    assert pattern.multiply(pattern.assemble(matrices), x) == pytest.approx(full @ x)


@pytest.mark.parametrize("factorisation", [BandedCholesky, SuperLU])
@pytest.mark.parametrize("columns", [None, 3])
def test_solve(
    small: tuple[Pattern, np.ndarray, np.ndarray],
    factorisation: type[BandedCholesky] | type[SuperLU],
    columns: int | None,
) -> None:
    """Catches a wrong packing: against dense algebra, for one right side and for several."""
    pattern, matrices, full = small
    shape = (full.shape[0],) if columns is None else (full.shape[0], columns)
    right = np.random.default_rng(3).normal(size=shape)
    kept = right.copy()
    assert factorisation(pattern, pattern.assemble(matrices)).solve(right) == pytest.approx(
        np.linalg.solve(full, right)
    )
    assert np.array_equal(right, kept)


@pytest.mark.parametrize("size", [1e-60, 1.0, 1e60])
def test_solve_roughly(small: tuple[Pattern, np.ndarray, np.ndarray], size: float) -> None:
    """Catches columns that single precision cannot hold, and one that is zero."""
    pattern, matrices, full = small
    right = np.random.default_rng(3).normal(size=(full.shape[0], 3)) * [size, 0.0, 1.0]
    found = BandedCholesky(pattern, pattern.assemble(matrices)).solve_roughly(right)
    exact = np.linalg.solve(full, right)
    assert np.all(np.abs(found - exact).max(axis=0) <= 1e-4 * np.abs(exact).max(axis=0))


@pytest.mark.parametrize("method", ["banded", "superlu"])
def test_values_that_are_not_finite_are_refused(small: tuple[Pattern, np.ndarray, np.ndarray], method: str) -> None:
    """Catches a NaN that goes through LAPACK and comes out as a field."""
    pattern, matrices, _ = small
    values = pattern.assemble(matrices)
    values[3] = np.nan
    with pytest.raises(SingularMatrixError, match="finite"):
        factorise(pattern, values, "banded" if method == "banded" else "superlu")


@pytest.mark.parametrize("method", ["banded", "superlu"])
def test_a_singular_matrix_is_refused(small: tuple[Pattern, np.ndarray, np.ndarray], method: str) -> None:
    """Catches a factor of a matrix that has none."""
    pattern, _, _ = small
    with pytest.raises(SingularMatrixError):
        factorise(pattern, np.zeros(pattern.nonzeros), "banded" if method == "banded" else "superlu")


def test_banded_equals_superlu_on_the_motor(in_triangles: Solution) -> None:
    """Catches a factorisation that is inexact where it matters: two methods, one field, to 1e-10."""
    problem = in_triangles.problem
    one, other = (solve(problem, Settings(1e-12, method=method)) for method in ("banded", "superlu"))
    assert one.convergence.converged
    assert other.convergence.converged
    assert np.abs(one.psi - other.psi).max() < 1e-10 * np.abs(other.psi).max()


@pytest.mark.parametrize("change", [1e-6, 1e-2, 3.0])
@pytest.mark.parametrize("columns", [None, 2])
def test_corrected_neighbour_equals_a_factor_of_its_own(
    small: tuple[Pattern, np.ndarray, np.ndarray], change: float, columns: int | None
) -> None:
    """Catches conjugate gradients that stop early, and a neighbour too far away, for one right side and for several."""
    pattern, matrices, _ = small
    neighbour = BandedCholesky(pattern, pattern.assemble(matrices))
    scale = 1 + change * np.random.default_rng(4).uniform(0, 1, matrices.shape[0])
    values = pattern.assemble(matrices * scale[:, None, None])
    shape = (pattern.unknowns,) if columns is None else (pattern.unknowns, columns)
    right = np.random.default_rng(5).normal(size=shape)
    corrected = Corrected(pattern, values, neighbour, "banded")
    exact = BandedCholesky(pattern, values).solve(right)
    for _ in range(2):
        assert corrected.solve(right) == pytest.approx(exact, rel=1e-9, abs=1e-10 * np.abs(exact).max())
    assert corrected.solve(np.zeros(shape)) == pytest.approx(np.zeros(shape))


def test_corrected_tangent_of_the_motor_equals_a_factorisation(in_triangles: Solution) -> None:
    """Catches thrust constants from a tangent that is one Newton step old."""
    solution = in_triangles
    values = solution.system.tangent_values(solution.psi[solution.system.inner])
    right = np.random.default_rng(6).normal(size=solution.system.inner.size)
    exact = factorise(solution.system.pattern, values, "superlu").solve(right)
    assert np.abs(solution.tangent.solve(right) - exact).max() < 1e-9 * np.abs(exact).max()
