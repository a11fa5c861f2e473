"""An open boundary for a long machine on a mapped mesh: the far field of dipoles spread evenly along its axis.

Where the computed air ends, all that is outside is told by a condition of the third kind, H_t + c0 A = 0. A dipole on
the axis at z' has ψ = r²/R³ with R² = r² + (z − z')²; spread evenly from z1 to z2, which is a rod with a pole at either
end, dipoles make

    ψ = (z − z1)/R1 − (z − z2)/R2,        Ri² = r² + (z − zi)²,

and c0 = −ν0 (∂ψ/∂n)/ψ lets that field out whole. From far away it is the dipole's, which of all fields of a machine
falls slowest. A single dipole in the middle would do the same there, but beside a machine longer than the air is wide
its c0 falls to −2 ν0/r, and the matrix is then not positive definite.

With the rod as long as the machine it always is. Between the poles −∂ψ/∂r > 0. Beyond them, where all is air, every
dipole has r ∂ψ/∂r = (2 − 3 r²/R²) ψ < 2 ψ, so that c0 > −2 ν0/r, and the air's energy from the axis to r is at least
ν0 ψ²/r² (the uniform field's) per radian and length: just what −2 ν0/r would take out.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.problem import EdgeTerms
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)
_T, _W = (_POINTS + 1) / 2, _WEIGHTS / 2
_SHAPE = np.column_stack(((1 - _T) * (1 - 2 * _T), _T * (2 * _T - 1), 4 * _T * (1 - _T)))
"""(4, 3) of an edge's start, end and middle."""

_STEP = 1e-30
"""m or m²; so small that its square vanishes."""

Values = Any
"""Numbers or arrays, real or complex."""


def across_shell(radius: Values, z: Values, poles: tuple[Values, Values]) -> Values:
    """(...) −(∂ψ/∂r)/ψ (1/m) on a cylinder at z (...) in m, of dipoles spread evenly between two poles' z (m)."""
    from_first, from_second = z - poles[0], z - poles[1]
    first, second = _distance(radius, from_first), _distance(radius, from_second)
    psi = from_first / first - from_second / second
    return radius * (from_first / first**3 - from_second / second**3) / psi


def across_end(r: Values, distances: tuple[Values, Values]) -> Values:
    """(...) −(∂ψ/∂n)/ψ (1/m) at r (...) in m on a plane at these distances (m) from the poles, the nearer one first."""
    near, far = distances
    to_near, to_far = _distance(r, near), _distance(r, far)
    # ψ/r², with 1 − cos θ = r²/(R (R + z)): nothing cancels on the axis.
    psi = 1 / (to_near * (to_near + near)) - 1 / (to_far * (to_far + far))
    return (1 / to_near**3 - 1 / to_far**3) / psi


def _distance(r: Values, z: Values) -> Values:
    """√(r² + z²), for complex steps too."""
    return np.sqrt(r * r + z * z)


def _shell(start: Values, end: Values, radius: Values, first: Values, second: Values) -> Values:
    """(k, 4) ν0 c/r dl at the Gauss points of edges from start to end (k, 1) in z, on a cylinder."""
    length = end - start
    z = start + length * _T
    return VACUUM_RELUCTIVITY * length * _W * across_shell(radius, z, (first, second)) / radius


def _end(side: float, start: Values, end: Values, z: Values, first: Values, second: Values) -> Values:
    """(k, 4) the same of edges from start to end (k, 1) in s, on a plane at z.

    side : +1 or −1, above or below the machine.
    """
    width = end - start
    s = start + width * _T
    # The pole that is nearer, and distances that are positive.
    near, far = (second, first) if side > 0 else (first, second)
    # dl/r = dr/r = ds/(2 s) along an end.
    return VACUUM_RELUCTIVITY * width * _W * across_end(np.sqrt(2 * s), (side * (z - near), side * (z - far))) / (2 * s)


@dataclass(frozen=True, slots=True, eq=False)
class _Rim:
    """Edges of one side in order: their factors' arguments, and where they are.

    nodes : (k, 3) start, end, middle. cells : (k,).
    """

    factor: Callable[..., Values]
    arguments: tuple[Any, ...]
    nodes: Ints
    cells: Ints


def _rims(grid: MappedMesh, poles: tuple[float, float]) -> list[_Rim]:
    rows, columns = 2 * np.arange(grid.z_lines.size - 1), 2 * np.arange(grid.r_lines.size - 1)
    last_row, last_column = 2 * rows.size, 2 * columns.size
    rims = [
        _Rim(
            _shell,
            (grid.z_nodes[rows][:, None], grid.z_nodes[rows + 2][:, None], float(grid.r_lines[-1]), *poles),
            np.stack([grid.node(rows + k, last_column) for k in (0, 2, 1)], axis=-1),
            rows // 2 * columns.size + columns.size - 1,
        )
    ]
    for row, end, side in ((0, float(grid.z_lines[0]), -1.0), (last_row, float(grid.z_lines[-1]), 1.0)):
        rims.append(
            _Rim(
                partial(_end, side),
                (grid.r_nodes[columns][:, None], grid.r_nodes[columns + 2][:, None], end, *poles),
                np.stack([grid.node(row, columns + k) for k in (0, 2, 1)], axis=-1),
                min(row // 2, rows.size - 1) * columns.size + columns // 2,
            )
        )
    return rims


def open_edges(grid: MappedMesh, poles: tuple[float, float]) -> EdgeTerms:
    """∫ ν0 c/r ψ v dl along the far edges of a mesh whose rim is open, c as above; per radian.

    poles : z of the machine's two ends (m); between the far edges.
    """
    rims = _rims(grid, poles)
    factors = np.concatenate([np.real(rim.factor(*rim.arguments)) for rim in rims])
    matrices = np.einsum("kt,ti,tj->kij", factors, _SHAPE, _SHAPE, optimize=True)
    elements, places = _owners(
        grid.mesh.elements, np.concatenate([rim.cells for rim in rims]), np.concatenate([rim.nodes for rim in rims])
    )
    full = np.zeros((elements.size, 6, 6))
    k = np.arange(elements.size)[:, None, None]
    full[k, places[:, :, None], places[:, None, :]] = matrices
    return EdgeTerms(elements, full, np.zeros(grid.mesh.nodes.shape[0]))


@dataclass(frozen=True, slots=True, eq=False)
class RimDerivative:
    """s, z : (lines, k) by the s and z of the grid's lines. poles : (2, k)."""

    s: Floats
    z: Floats
    poles: Floats


class OpenRim:
    """The open rim of a grid, prepared for derivatives of ∫ ν0 c/r u v dl along it.

    The factors' slopes are by complex steps (Squire and Trapp 1998), which are exact to rounding: c is made of nothing
    but roots and ratios.
    """

    def __init__(self, grid: MappedMesh, poles: tuple[float, float]) -> None:
        self._grid = grid
        rims = _rims(grid, poles)
        self._nodes = np.concatenate([rim.nodes for rim in rims])
        self._slopes = np.concatenate([_slopes(rim) for rim in rims], axis=1)
        self._parts = np.cumsum([rim.nodes.shape[0] for rim in rims])[:-1]

    def derivative(self, u: Floats, v: Floats) -> RimDerivative:
        """For pairs of nodal fields u, v (n, k), or one u (n, 1) for all."""
        at_points = (_SHAPE @ u[self._nodes]) * (_SHAPE @ v[self._nodes])
        by_arguments = np.einsum("akt,ktc->akc", self._slopes, at_points)
        shell, low, high = np.split(by_arguments, self._parts, axis=1)
        grid, columns = self._grid, by_arguments.shape[2]
        s, z = np.zeros((grid.r_lines.size, columns)), np.zeros((grid.z_lines.size, columns))
        z[:-1] += shell[0]
        z[1:] += shell[1]
        s[-1] += shell[2].sum(axis=0) / float(grid.r_lines[-1])  # ds = r dr
        for end, line in ((low, 0), (high, -1)):
            s[:-1] += end[0]
            s[1:] += end[1]
            z[line] += end[2].sum(axis=0)
        return RimDerivative(s, z, by_arguments[3:].sum(axis=1))


def _slopes(rim: _Rim) -> Floats:
    """(5, k, 4) of the factors at the edges' Gauss points by each of their arguments."""
    count = len(rim.arguments)
    steps = 1j * _STEP * np.eye(count)[:, :, None, None]
    moved = rim.factor(*(argument + step for argument, step in zip(rim.arguments, steps, strict=True)))
    return np.asarray(np.imag(moved) / _STEP)


def _owners(elements: Ints, cells: Ints, edges: Ints) -> tuple[Ints, Ints]:
    """(k,) which of a cell's two elements has the edge (k, 3), and (k, 3) where the edge's nodes stand in it."""
    pairs = 2 * cells[:, None] + np.arange(2)
    has_middle = np.any(elements[pairs] == edges[:, 2, None, None], axis=2)
    owner = np.where(has_middle[:, 0], pairs[:, 0], pairs[:, 1])
    return owner, np.argmax(elements[owner][:, None, :] == edges[:, :, None], axis=2)
