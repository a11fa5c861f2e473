"""Regions that carry current: their load, their linkage, and their current density where it is asked for."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from fluxbore.fem.element import QUADRATURE_POINTS, QUADRATURE_WEIGHTS, shape, shape_derivatives
from fluxbore.fem.mesh import Floats, Ints, Mesh
from fluxbore.fem.problem import Circuit, Conductor, Problem

_GAUSS, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(6)
_UNIT, _UNIT_WEIGHTS = (_GAUSS + 1) / 2, _GAUSS_WEIGHTS / 2


STEEP = 0.25
"""Ratio of an element's least to its greatest s below which seven points do not do for 1/√s."""


@lru_cache(maxsize=2)  # one mesh's two: many regions ask, and each alone would cost as much as all
def element_loads(mesh: Mesh, by_radius: bool = False) -> Floats:
    """(m, 6) ∫ φ_i dr dz (m²), or ∫ φ_i/r dr dz (m) by radius, over each element; dx dy in a planar problem."""
    elements = np.arange(mesh.region.size)
    if mesh.chart == "planar":
        return _integral(mesh, elements, QUADRATURE_POINTS, QUADRATURE_WEIGHTS, 0)
    power = 2 if by_radius else 1
    s = mesh.nodes[mesh.elements[:, :3], 0]
    corners = (s <= 0) @ np.array([1, 2, 4])
    # Beside those on the axis the radius still doubles within an element: any rule of many points will do there.
    corners[(corners == 0) & (s.min(axis=1) < STEEP * s.max(axis=1))] = 1
    load = _integral(mesh, elements, QUADRATURE_POINTS, QUADRATURE_WEIGHTS, power)
    for code in np.unique(corners[corners > 0]):
        touching = elements[corners == code]
        load[touching] = _integral(mesh, touching, *_collapsed(int(code)), power)
    return load


def region_load(mesh: Mesh, region: int, by_radius: bool = False) -> Floats:
    """(n,) the nodes' shares of `region_measure`, the shape functions' integrals."""
    elements = np.flatnonzero(mesh.region == region)
    return _nodal(mesh, elements, element_loads(mesh, by_radius)[elements])


def region_measure(mesh: Mesh, region: int, by_radius: bool = False) -> float:
    """Of one region its area (m²), or the integral of 1/r over it (m); 0 where it has no elements."""
    measures = _region_measures(mesh, by_radius)
    return float(measures[region]) if region < measures.size else 0.0


@lru_cache(maxsize=2)
def _region_measures(mesh: Mesh, by_radius: bool) -> Floats:
    # The shape functions add up to one.
    return np.asarray(np.bincount(mesh.region, element_loads(mesh, by_radius).sum(axis=1)), dtype=float)


def circuit(mesh: Mesh, name: str, conductors: Sequence[Conductor], current: float) -> Circuit:
    """A circuit of regions in series, or of whatever share of its ampere each conductor's density says."""
    density = np.zeros(mesh.nodes.shape[0])
    for by_radius in (False, True):
        of_region = np.zeros(int(mesh.region.max(initial=0)) + 1)
        for conductor in conductors:
            if conductor.by_radius == by_radius and conductor.region < of_region.size:
                of_region[conductor.region] += conductor.density
        elements = np.flatnonzero(of_region[mesh.region])
        if elements.size:
            share = element_loads(mesh, by_radius)[elements] * of_region[mesh.region[elements]][:, None]
            density += _nodal(mesh, elements, share)
    return Circuit(name, density, current, tuple(conductors))


def current_density(problem: Problem) -> tuple[Floats, Floats]:
    """(regions,) J (A/m²), and (regions,) what is to be divided by the radius and added to it (A/m)."""
    uniform, by_radius = np.zeros(len(problem.materials)), np.zeros(len(problem.materials))
    for item in (*problem.circuits, *problem.sources):
        for conductor in item.conductors:
            target = by_radius if conductor.by_radius else uniform
            target[conductor.region] += item.current * conductor.density
    return uniform, by_radius


def _integral(mesh: Mesh, elements: Ints, points: Floats, weights: Floats, power: int) -> Floats:
    """(k, 6) ∫ φ_i r^−power over elements (k,) in the chart's measure."""
    nodes = mesh.nodes[mesh.elements[elements]]
    values = shape(points)
    jacobian = np.einsum("mnk,qnd->mqkd", nodes, shape_derivatives(points), optimize=True)
    area = np.abs(jacobian[..., 0, 0] * jacobian[..., 1, 1] - jacobian[..., 0, 1] * jacobian[..., 1, 0]) / 2 * weights
    if power:
        s = np.maximum(np.einsum("qn,mn->mq", values, nodes[..., 0], optimize=True), np.finfo(float).tiny)
        area /= (2 * s) ** (power / 2)
    return np.asarray(np.einsum("mq,qn->mn", area, values, optimize=True))


def _nodal(mesh: Mesh, elements: Ints, share: Floats) -> Floats:
    """(n,) the elements' shares (k, 6) at their nodes."""
    return np.asarray(np.bincount(mesh.elements[elements].ravel(), share.ravel(), mesh.nodes.shape[0]), dtype=float)


def _collapsed(code: int) -> tuple[Floats, Floats]:
    """A rule for triangles that touch the axis with the corners of a bit code: barycentric (q, 3) and weights (q,).

    There the integrand goes as 1/√s. Squares collapsed to triangles (Duffy 1982) with the distance from the axis taken
    as a square, s ~ t², make it smooth.
    """
    touching = [k for k in range(3) if code >> k & 1]
    t, u = (grid.ravel() for grid in np.meshgrid(_UNIT, _UNIT, indexing="ij"))
    weight = np.outer(_UNIT_WEIGHTS, _UNIT_WEIGHTS).ravel()
    distance = t**2
    points = np.empty((t.size, 3))
    if len(touching) == 1:  # the side opposite the corner is at distance one
        a = touching[0]
        points[:, a] = 1 - distance
        points[:, (a + 1) % 3] = distance * (1 - u)
        points[:, (a + 2) % 3] = distance * u
        return points, 2 * distance * 2 * t * weight
    a = next(k for k in range(3) if k not in touching) if len(touching) == 2 else 0
    points[:, a] = distance
    points[:, (a + 1) % 3] = (1 - distance) * (1 - u)
    points[:, (a + 2) % 3] = (1 - distance) * u
    return points, 2 * (1 - distance) * 2 * t * weight
