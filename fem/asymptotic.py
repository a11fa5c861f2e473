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
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY
from fluxbore.fem.tensor_product import side

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_T, _W = (_POINTS + 1) / 2, _WEIGHTS / 2
"""On an edge; c is no polynomial."""

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
    """(k, t) ν0 c/r dl at the Gauss points of edges from start to end (k, 1) in z, on a cylinder."""
    length = end - start
    z = start + length * _T
    return VACUUM_RELUCTIVITY * length * _W * across_shell(radius, z, (first, second)) / radius


def _end(facing: float, start: Values, end: Values, z: Values, first: Values, second: Values) -> Values:
    """(k, t) the same of edges from start to end (k, 1) in s, on a plane at z.

    facing : +1 or −1, above or below the machine.
    """
    width = end - start
    s = start + width * _T
    # The pole that is nearer, and distances that are positive.
    near, far = (second, first) if facing > 0 else (first, second)
    # dl/r = dr/r = ds/(2 s) along an end.
    return (
        VACUUM_RELUCTIVITY
        * width
        * _W
        * across_end(np.sqrt(2 * s), (facing * (z - near), facing * (z - far)))
        / (2 * s)
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Edges:
    """Cells' edges on one side of the rim in order: their factors' arguments, and where they are.

    nodes : (k, order + 1) along each edge.
    """

    factor: Callable[..., Values]
    arguments: tuple[Any, ...]
    nodes: Ints


def _sides(grid: MappedMesh, poles: tuple[float, float]) -> list[_Edges]:
    row, column = (grid.order * np.arange(n)[:, None] + np.arange(grid.order + 1) for n in grid.shape)
    s_lines, z_lines = grid.r_nodes[:: grid.order, None], grid.z_lines[:, None]
    found = [
        _Edges(
            _shell,
            (z_lines[:-1], z_lines[1:], float(grid.r_lines[-1]), *poles),
            grid.node(row, grid.r_nodes.size - 1),
        )
    ]
    for last, end, facing in ((0, float(grid.z_lines[0]), -1.0), (grid.z_nodes.size - 1, float(grid.z_lines[-1]), 1.0)):
        found.append(
            _Edges(
                partial(_end, facing),
                (s_lines[:-1], s_lines[1:], end, *poles),
                grid.node(last, column),
            )
        )
    return found


@dataclass(frozen=True, slots=True, eq=False)
class Rim:
    """A condition of the third kind on far edges. nodes : (k, order + 1) along each. matrices : one for each."""

    nodes: Ints
    matrices: Floats

    def add_forces(self, forces: Floats, psi: Floats) -> None:
        """What it does at nodal ψ (n,), to nodal forces (n,) in place."""
        pull = np.einsum("kij,kj->ki", self.matrices, psi[self.nodes])
        forces += np.bincount(self.nodes.ravel(), pull.ravel(), forces.size)


def open_rim(grid: MappedMesh, poles: tuple[float, float]) -> Rim:
    """∫ ν0 c/r ψ v dl along the far edges of a mesh whose rim is open, c as above; per radian.

    poles : z of the machine's two ends (m); between the far edges.
    """
    values = side(grid.order).values(_T)
    sides = _sides(grid, poles)
    factors = np.concatenate([np.real(edges.factor(*edges.arguments)) for edges in sides])
    products = values[:, :, None] * values[:, None, :]
    matrices = (factors @ products.reshape(_T.size, -1)).reshape(-1, *products.shape[1:])
    return Rim(np.concatenate([edges.nodes for edges in sides]), matrices)


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
        sides = _sides(grid, poles)
        self._nodes = np.concatenate([edges.nodes for edges in sides])
        self._values = side(grid.order).values(_T)
        self._slopes = np.concatenate([_slopes(edges) for edges in sides], axis=1)
        self._parts = np.cumsum([edges.nodes.shape[0] for edges in sides])[:-1]

    def derivative(self, u: Floats, v: Floats) -> RimDerivative:
        """For pairs of nodal fields u, v (n, k), or one u (n, 1) for all."""
        at_points = (self._values @ u[self._nodes]) * (self._values @ v[self._nodes])
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


def _slopes(edges: _Edges) -> Floats:
    """(5, k, t) of the factors at the edges' Gauss points by each of their arguments."""
    count = len(edges.arguments)
    steps = 1j * _STEP * np.eye(count)[:, :, None, None]
    moved = edges.factor(*(argument + step for argument, step in zip(edges.arguments, steps, strict=True)))
    return np.asarray(np.imag(moved) / _STEP)
