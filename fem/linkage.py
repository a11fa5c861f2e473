"""Coils as windows over the mesh, integrated exactly whether or not their ends are mesh lines.

Mover and coils slide past one another, so coil ends cannot be mesh lines without the topology changing on the way.
Magnetically a coil is air; only its load and its linkage, one and the same integral, need its outline.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats, Ints, Mesh
from fluxbore.fem.problem import Circuit
from fluxbore.geometry.cross_section import CoilWindow

_GAUSS_POINTS, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(4)
_UNIT_POINTS, _UNIT_WEIGHTS = (_GAUSS_POINTS + 1) / 2, _GAUSS_WEIGHTS / 2


@dataclass(frozen=True, slots=True, eq=False)
class Clip:
    """Gauss points in what windows cut out of triangles.

    element, window : (p,). triangle : (p, 3, 2) corners in the chart. r, z : (p, 32) m. weight : (p, 32) m².
    shares : (p, 32) three times, the barycentric coordinates.
    """

    element: Ints
    window: Ints
    triangle: Floats
    r: Floats
    z: Floats
    weight: Floats
    shares: tuple[Floats, Floats, Floats]

    @property
    def barycentric(self) -> Floats:
        """(p, 32, 3)."""
        return np.stack(self.shares, axis=-1)

    def integral(self) -> Floats:
        """(p, 6) ∫ φ_i dr dz (m²) of the shape functions, from the moments of the barycentric coordinates."""
        a, b, c = self.shares
        wa, wb, wc = (self.weight * share for share in self.shares)
        corners = [2 * _sums(w, x) - w.sum(axis=1) for w, x in ((wa, a), (wb, b), (wc, c))]
        return np.column_stack((*corners, 4 * _sums(wa, b), 4 * _sums(wb, c), 4 * _sums(wc, a)))


def _sums(x: Floats, y: Floats) -> Floats:
    """(p,) Σ over points."""
    return np.asarray(np.einsum("pk,pk->p", x, y))


@dataclass(frozen=True, slots=True, eq=False)
class Cut:
    """What coils of equal radii cut out of a mesh.

    coil : (p,) whose window it is. integral : (p, 6) ∫ φ_i dr dz (m²) of the elements' shape functions.
    """

    coil: Ints
    clip: Clip
    integral: Floats


def cuts(mesh: Mesh, coils: Sequence[CoilWindow]) -> tuple[Cut, ...]:
    """One for each pair of radii among the coils."""
    found = []
    for radii in dict.fromkeys(coil.r for coil in coils):
        alike = np.array([k for k, coil in enumerate(coils) if coil.r == radii])
        clip = clipped(mesh, radii, np.array([coils[k].z for k in alike]))
        found.append(Cut(alike[clip.window], clip, clip.integral()))
    return tuple(found)


def circuits(mesh: Mesh, coils: Sequence[CoilWindow], made: Sequence[Cut] | None = None) -> tuple[Circuit, ...]:
    """One circuit for each name among the coils, in order of appearance. made : the coils' `cuts`, where known."""
    names = list(dict.fromkeys(coil.circuit for coil in coils))
    circuit = np.array([names.index(coil.circuit) for coil in coils])
    per_area = np.array([coil.turns / coil.area for coil in coils])
    nodes = mesh.nodes.shape[0]
    density = np.zeros(len(names) * nodes)
    for cut in cuts(mesh, coils) if made is None else made:
        place = circuit[cut.coil][:, None] * nodes + mesh.elements[cut.clip.element]
        share = cut.integral * per_area[cut.coil][:, None]
        density += np.bincount(place.ravel(), share.ravel(), density.size)
    return tuple(Circuit(name, values) for name, values in zip(names, density.reshape(-1, nodes), strict=True))


def flux_linkages(solution: Solution) -> Floats:
    """(k,) flux linkage (Wb) of each circuit: ∫ (turns/area) ψ dr dz, all the way round or for the depth."""
    return np.array([solution.problem.extent * circuit.density @ solution.psi for circuit in solution.problem.circuits])


def synchronous_inductance(solution: Solution) -> float:
    """Of three phases under balanced current (H), incremental at the solution's state: 2π/3 Σ cᵀ K_T⁻¹ c over Clarke's
    two current distributions, which is the mean of the self less the mean of the mutual inductances."""
    phases = np.column_stack([circuit.density for circuit in solution.problem.circuits])
    angles = 2 * np.pi / 3 * np.arange(phases.shape[1])
    loads = (phases @ np.column_stack((np.cos(angles), np.sin(angles))))[solution.system.inner]
    return float(solution.problem.extent / 3 * np.sum(loads * solution.tangent.solve(loads)))


def coil_density(mesh: Mesh, coil: CoilWindow) -> Floats:
    """(n,) ∫ φ_i (turns/area) dr dz over one window (turns times shape function, dimensionless)."""
    return circuits(mesh, (coil,))[0].density


def clipped(mesh: Mesh, radii: tuple[float, float], windows: Floats) -> Clip:
    """The part of each triangle that lies in each window of one shell.

    radii : of the shell, mesh lines (m). windows : (k, 2) z from and to, anywhere (m). Straight-sided elements only.

    Each triangle is cut at its middle corner into two slabs in z, each slab is clipped to the window, and a Gauss rule
    of four by four points in (r, z) integrates the shape functions: on rectangles cut in two, any quadratic function
    of (s, z) exactly.
    """
    shell = _within(mesh, radii)
    heights = mesh.nodes[mesh.elements[shell, :3], 1]
    overlap = (heights.min(axis=1)[:, None] < windows[:, 1]) & (heights.max(axis=1)[:, None] > windows[:, 0])
    pair, which = np.nonzero(overlap)
    element, (lower, upper) = shell[pair], windows[which].T
    triangle = mesh.nodes[mesh.elements[element, :3]]
    order = np.argsort(triangle[..., 1], axis=1, kind="stable")
    low, middle, high = (np.take_along_axis(triangle, order[:, [k], None], axis=1)[:, 0] for k in range(3))
    count = element.size
    r, all_z, weight = np.empty((3, count, 2, 4, 4))
    for k, (start, end) in enumerate(((low, middle), (middle, high))):
        bottom = np.maximum(start[:, 1], lower)
        top = np.minimum(end[:, 1], upper)
        height = np.maximum(top - bottom, 0.0)
        z = bottom[:, None] + height[:, None] * _UNIT_POINTS
        # Along r, where the shape functions are polynomials and dr carries no 1/r: the two triangles of a rectangle
        # then share out the window's turns to rounding.
        left = np.sqrt(2 * np.maximum(_on_edge(low, high, z), 0.0))
        right = np.sqrt(2 * np.maximum(_on_edge(start, end, z), 0.0))
        r[:, k] = left[..., None] + (right - left)[..., None] * _UNIT_POINTS
        weight[:, k] = (height[:, None] * np.abs(right - left) * _UNIT_WEIGHTS)[..., None] * _UNIT_WEIGHTS
        all_z[:, k] = z[..., None]
    r, all_z, weight = (values.reshape(count, 32) for values in (r, all_z, weight))
    return Clip(element, which, triangle, r, all_z, weight, _shares(triangle, r**2 / 2, all_z))


def _within(mesh: Mesh, radii: tuple[float, float]) -> Ints:
    """The elements between two radii (m) that are mesh lines."""
    inner, outer = radii[0] ** 2 / 2, radii[1] ** 2 / 2
    s = mesh.nodes[mesh.elements[:, :3], 0]
    slack = 1e-9 * outer
    return np.flatnonzero((s.min(axis=1) > inner - slack) & (s.max(axis=1) < outer + slack))


def _on_edge(a: Floats, b: Floats, z: Floats) -> Floats:
    """s (m, k) on the edge from a to b at heights z (m, k); the edge's start where it is level."""
    rise = b[:, 1] - a[:, 1]
    slope = np.divide(b[:, 0] - a[:, 0], rise, out=np.zeros_like(rise), where=rise > 0)
    return np.asarray(a[:, [0]] + slope[:, None] * (z - a[:, [1]]))


def _shares(triangle: Floats, s: Floats, z: Floats) -> tuple[Floats, Floats, Floats]:
    """Barycentric coordinates (m, ...) of points in triangles (m, 3, 2)."""
    expand = (slice(None),) + (None,) * (s.ndim - 1)
    a, b, c = (triangle[:, k] for k in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])

    def share(p: Floats, q: Floats) -> Floats:
        cross = (p[:, 0][expand] - s) * (q[:, 1][expand] - z) - (q[:, 0][expand] - s) * (p[:, 1][expand] - z)
        return np.asarray(cross / area[expand])

    first, second = share(b, c), share(c, a)
    return first, second, 1 - first - second
