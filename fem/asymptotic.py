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

import numpy as np

from fluxbore.fem.mapped import MappedMesh
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.problem import EdgeTerms
from fluxbore.fem.reluctivity import VACUUM_RELUCTIVITY

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)
_T, _W = (_POINTS + 1) / 2, _WEIGHTS / 2
_SHAPE = np.column_stack(((1 - _T) * (1 - 2 * _T), _T * (2 * _T - 1), 4 * _T * (1 - _T)))
"""(4, 3) of an edge's start, end and middle."""


def across_shell(radius: float, z: Floats, poles: tuple[float, float]) -> Floats:
    """(...) −(∂ψ/∂r)/ψ (1/m) on a cylinder at z (...) in m, of dipoles spread evenly between two poles' z (m)."""
    from_first, from_second = z - poles[0], z - poles[1]
    first, second = np.hypot(radius, from_first), np.hypot(radius, from_second)
    psi = from_first / first - from_second / second
    return np.asarray(radius * (from_first / first**3 - from_second / second**3) / psi)


def across_end(r: Floats, distances: tuple[float, float]) -> Floats:
    """(...) −(∂ψ/∂n)/ψ (1/m) at r (...) in m on a plane at these distances (m) from the poles, the nearer one first."""
    near, far = distances
    to_near, to_far = np.hypot(r, near), np.hypot(r, far)
    # ψ/r², with 1 − cos θ = r²/(R (R + z)): nothing cancels on the axis.
    psi = 1 / (to_near * (to_near + near)) - 1 / (to_far * (to_far + far))
    return np.asarray((1 / to_near**3 - 1 / to_far**3) / psi)


def open_edges(grid: MappedMesh, poles: tuple[float, float]) -> EdgeTerms:
    """∫ ν0 c/r ψ v dl along the far edges of a mesh whose rim is open, c as above; per radian.

    poles : z of the machine's two ends (m); between the far edges.
    """
    rows, columns = 2 * np.arange(grid.z_lines.size - 1), 2 * np.arange(grid.r_lines.size - 1)
    last_row, last_column = 2 * rows.size, 2 * columns.size
    radius = float(grid.r_lines[-1])
    z, length = _along(grid.z_nodes, rows)
    factors = [length * across_shell(radius, z, poles) / radius]
    nodes = [np.stack([grid.node(rows + k, last_column) for k in (0, 2, 1)], axis=-1)]
    cells = [rows // 2 * columns.size + columns.size - 1]
    s, width = _along(grid.r_nodes, columns)
    for row, end in ((0, float(grid.z_lines[0])), (last_row, float(grid.z_lines[-1]))):
        near, far = sorted((abs(end - poles[0]), abs(end - poles[1])))
        # dl/r = dr/r = ds/(2 s) along an end.
        factors.append(width * across_end(np.sqrt(2 * s), (near, far)) / (2 * s))
        nodes.append(np.stack([grid.node(row, columns + k) for k in (0, 2, 1)], axis=-1))
        cells.append(min(row // 2, rows.size - 1) * columns.size + columns // 2)
    matrices = np.einsum("kt,ti,tj->kij", np.concatenate(factors), _SHAPE, _SHAPE, optimize=True)
    elements, places = _owners(grid.mesh.elements, np.concatenate(cells), np.concatenate(nodes))
    full = np.zeros((elements.size, 6, 6))
    k = np.arange(elements.size)[:, None, None]
    full[k, places[:, :, None], places[:, None, :]] = VACUUM_RELUCTIVITY * matrices
    return EdgeTerms(elements, full, np.zeros(grid.mesh.nodes.shape[0]))


def _along(nodes: Floats, starts: Ints) -> tuple[Floats, Floats]:
    """(k, 4) coordinate of each edge's Gauss points, and their weights times the edge's length."""
    length = nodes[starts + 2] - nodes[starts]
    return nodes[starts][:, None] + length[:, None] * _T, length[:, None] * _W


def _owners(elements: Ints, cells: Ints, edges: Ints) -> tuple[Ints, Ints]:
    """(k,) which of a cell's two elements has the edge (k, 3), and (k, 3) where the edge's nodes stand in it."""
    pairs = 2 * cells[:, None] + np.arange(2)
    has_middle = np.any(elements[pairs] == edges[:, 2, None, None], axis=2)
    owner = np.where(has_middle[:, 0], pairs[:, 0], pairs[:, 1])
    return owner, np.argmax(elements[owner][:, None, :] == edges[:, :, None], axis=2)
