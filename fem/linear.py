"""Sparse symmetric positive definite systems behind one small interface.

A `Pattern` knows where element matrices land and is shared by all Newton steps, positions and designs of one mesh
topology. Three methods take its values: banded Cholesky (LAPACK), which suits meshes numbered across a long thin
domain, SuperLU in its symmetric mode, which suits any mesh, and `multigrid` for the largest ones.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from fluxbore.fem.conjugate_gradients import conjugate_gradients

Floats = NDArray[np.float64]
Ints = NDArray[np.int_]
Method = Literal["auto", "banded", "superlu", "multigrid"]

LARGE = 100_000
"""Unknowns from which multigrid is the default: from no field to saturation it takes 10 s at 179,000 unknowns, where
SuperLU takes 9 s at 83,000 (docs/validation/scaling.md). Below, SuperLU's many right sides are worth more than that."""

LARGEST_FACTOR = 400_000
"""Unknowns up to which SuperLU steps in where multigrid fails; there a factor takes 14 s, by the law in `choose`."""


MOST_REFINEMENTS = 6
"""A neighbour that is worth refining with gains two digits or more each time."""


class SingularMatrixError(ArithmeticError):
    """The matrix has no factorisation: it is not positive definite, or a value in it is not finite."""


class Factor(Protocol):
    """A factorised matrix."""

    def solve(self, right: Floats) -> Floats:
        """x with A x = right; right is (n,) or (n, k)."""
        ...


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
        """Sums the matrices (len(elements), k, k) of some elements only."""
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


def choose(pattern: Pattern) -> Method:
    """The fastest method for a pattern.

    A band of half width b costs n·b² operations at some 2e10 a second, SuperLU 5.5e-8 s times n^1.5 on a square of
    triangles (both measured): they meet at b = 33 n^0.25.
    """
    if pattern.bandwidth < 33 * pattern.unknowns**0.25:
        return "banded"
    return "superlu" if pattern.unknowns < LARGE else "multigrid"


def check_finite(values: Floats) -> None:
    """Raises SingularMatrixError."""
    if not np.all(np.isfinite(values)):
        raise SingularMatrixError("a value of the matrix is not finite")


def factorise(pattern: Pattern, values: Floats, method: Method = "banded") -> Factor:
    """Factorise the symmetric positive definite matrix with these values.

    values : (nnz,) in the pattern's order.

    Raises SingularMatrixError where there is no factorisation.
    """
    check_finite(values)
    chosen = choose(pattern) if method == "auto" else method
    if chosen == "banded":
        return BandedCholesky(pattern, values)
    if chosen == "superlu":
        return SuperLU(pattern, values)
    from fluxbore.fem.multigrid import Multigrid

    return Multigrid(pattern, values, rescue=method == "auto" and pattern.unknowns <= LARGEST_FACTOR)


class Corrected:
    """A matrix solved with the factor of a neighbour: conjugate gradients preconditioned by that factor.

    After Newton's last step the factor at hand belongs to a field that differs by next to nothing, so two or three
    iterations give full accuracy for a tenth of a factorisation.
    """

    TOLERANCE = 1e-13

    def __init__(self, pattern: Pattern, values: Floats, neighbour: Factor, method: Method) -> None:
        from fluxbore.fem.multigrid import Multigrid

        self._pattern, self._values, self._method = pattern, values, method
        # A factor takes as long as 15 iterations at 10,000 unknowns and 40 at 200,000; for all right sides together.
        self._affordable = max(12, round(0.1 * pattern.unknowns**0.5))
        self._own = False
        nearest = neighbour.nearest if isinstance(neighbour, Corrected) else neighbour
        self.nearest: Factor = nearest.renewed(values) if isinstance(nearest, Multigrid) else nearest
        """The neighbour's factor, or this matrix's own once the neighbour has turned out to be too far away."""

    @cached_property
    def _matrix(self) -> Any:
        return self._pattern.matrix(self._values)

    def solve(self, right: Floats) -> Floats:
        """x with A x = right; right is (n,) or (n, k). Raises SingularMatrixError."""
        return self.within(right, 0.0)

    def within(self, right: Floats, tolerance: float) -> Floats:
        """x with |right − A x| <= tolerance |right|, or as well as `solve`; right is (n,) or (n, k)."""
        from fluxbore.fem.multigrid import Multigrid

        if isinstance(self.nearest, Multigrid):
            return self.nearest.within(right, tolerance)
        if self._own:
            return self.nearest.solve(right)
        if right.ndim == 2:
            refined = self._refined(right, max(tolerance, self.TOLERANCE))
            if refined is not None:
                return refined
            return np.column_stack([self.within(column, tolerance) for column in right.T])
        found = conjugate_gradients(
            lambda x: np.asarray(self._matrix @ x),
            self.nearest.solve,
            right,
            max(tolerance, self.TOLERANCE),
            self._affordable,
            prospects=True,
        )
        self._affordable -= found.iterations
        if found.reached:
            return found.x
        self.nearest, self._own = factorise(self._pattern, self._values, self._method), True
        return self.nearest.solve(right)

    def _refined(self, right: Floats, tolerance: float) -> Floats | None:
        """Iterative refinement of many right sides (n, k) at once; None where the neighbour is too far for it.

        What corrects a first solution needs few digits of its own, so that single precision does, unless the matrix
        is so ill-conditioned that it gains less than a digit.
        """
        size = _lengths(right)
        goal = tolerance * size
        x = self.nearest.solve(right)
        correct = self.nearest.solve_roughly if isinstance(self.nearest, BandedCholesky) else self.nearest.solve
        for sweep in range(1, MOST_REFINEMENTS + 1):
            rest = right - self._matrix @ x
            before, size = size, _lengths(rest)
            far = np.flatnonzero(size > goal)
            if not far.size:
                return x
            if np.any(size[far] > 0.1 * before[far]):
                correct = self.nearest.solve
            if sweep < MOST_REFINEMENTS:
                x[:, far] += correct(rest[:, far])
        return None


def _lengths(columns: Floats) -> Floats:
    """(k,) Euclidean, of columns (n, k)."""
    return np.asarray(np.sqrt(np.einsum("nk,nk->k", columns, columns)))


class Tangents:
    """Factors of matrices of one pattern, each near to the last: Newton's.

    A narrow band is factorised faster than neighbours are corrected, so there each matrix gets a factor of its own.
    """

    def __init__(self, pattern: Pattern, values: Callable[[Floats], Floats], method: Method) -> None:
        """values : the matrix (nnz,) at a point (n,)."""
        self._pattern, self._values, self._method = pattern, values, method
        self._banded = (choose(pattern) if method == "auto" else method) == "banded"
        self._last: Factor | None = None

    def __call__(self, x: Floats) -> Factor:
        """The matrix at x, ready to solve with. Raises SingularMatrixError where there is no factorisation."""
        values = self._values(x)
        if self._last is None or self._banded:
            self._last = factorise(self._pattern, values, self._method)
        else:
            check_finite(values)
            self._last = Corrected(self._pattern, values, self._last, self._method)
        return self._last


class BandedCholesky:
    """LAPACK's banded Cholesky: time n·b², memory n·b for n unknowns of half bandwidth b."""

    def __init__(self, pattern: Pattern, values: Floats) -> None:
        from scipy.linalg import get_lapack_funcs

        band = np.zeros((pattern.unknowns, pattern.bandwidth + 1))
        band[pattern.columns, pattern.rows - pattern.columns] = values
        # The transpose is Fortran-ordered, so LAPACK overwrites it without a copy.
        factor, self._solver = get_lapack_funcs(("pbtrf", "pbtrs"), (band,))
        self._band, status = factor(band.T, lower=1, overwrite_ab=1)
        if status != 0:
            raise SingularMatrixError(f"the matrix is not positive definite at unknown {status}")

    def solve(self, right: Floats) -> Floats:
        solution, status = self._solver(self._band, right, lower=1)
        if status != 0:
            raise SingularMatrixError(f"LAPACK pbtrs refused argument {-status}")
        return np.asarray(solution)

    @cached_property
    def _single(self) -> tuple[Any, Any]:
        """The factor in single precision, and its solver."""
        from scipy.linalg import get_lapack_funcs

        band = self._band.astype(np.float32)
        return band, *get_lapack_funcs(("pbtrs",), (band,))

    def solve_roughly(self, right: Floats) -> Floats:
        """`solve` to some five digits, in two thirds of the time; right is (n, k)."""
        band, solver = self._single
        scale = np.abs(right).max(axis=0, initial=1e-300)  # within what single precision can hold
        solution, status = solver(band, right / scale, lower=1)
        if status != 0:
            raise SingularMatrixError(f"LAPACK pbtrs refused argument {-status}")
        return np.asarray(solution * scale)


class SuperLU:
    """SuperLU with symmetric ordering and no pivoting, three times faster than its defaults on these matrices."""

    def __init__(self, pattern: Pattern, values: Floats) -> None:
        from scipy.sparse.linalg import splu

        try:
            self._factor = splu(
                pattern.matrix(values),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise SingularMatrixError(str(error)) from error

    def solve(self, right: Floats) -> Floats:
        return np.asarray(self._factor.solve(right))
