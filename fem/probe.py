"""The field at points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fluxbore.design.errors import SpecError
from fluxbore.fem.element import from_frame, shape, to_frame
from fluxbore.fem.locate import Locator
from fluxbore.fem.magnetostatics import Solution, in_sheets
from fluxbore.fem.mesh import Floats, Ints, Mesh, in_space
from fluxbore.fem.recovery import RecoveredField

REACH, NEAR = 1e-3, 0.05
"""A point this far outside still counts, as a share of the mesh's diagonal and of the longest side of the element that
it is next to: the elements cut arcs a little short. The side of 15 degrees of an arc, the longest there is, where it
is left straight, by 0.033 of its length."""


@dataclass(frozen=True, slots=True, eq=False)
class Probe:
    """The field at k points.

    potential : (k,) A (Wb/m), or r·A (Wb/rad) in an axisymmetric problem. flux_density : (k, 2) T in (x, y) or (r, z).
    field_strength : (k, 2) A/m. region : (k,).
    """

    potential: Floats
    flux_density: Floats
    field_strength: Floats
    region: Ints


def probe(solution: Solution, field: RecoveredField, locator: Locator, points: Floats) -> Probe:
    """The field at points (k, 2) in m; on an interface the one of the region that comes first.

    Raises SpecError for a point outside the mesh.
    """
    mesh = solution.problem.mesh
    elements, places = locate(mesh, locator, points)
    outside = np.flatnonzero(elements < 0)
    if outside.size:
        x, y = points[outside[0]]
        raise SpecError(f"A point must lie inside the model; ({x:g}, {y:g}) m does not.")
    return field_in(solution, field, elements, places, points)


def field_in(
    solution: Solution, field: RecoveredField, elements: Ints, barycentric: Floats, points: Floats | None = None
) -> Probe:
    """The field in k elements (k,), on the side of an interface that they are on; barycentric : (k, 3) place in each.

    points : (k, 2) m, where the places are, if that is known better than the elements tell.
    """
    mesh = solution.problem.mesh
    nodes = mesh.elements[elements]
    values = shape(barycentric)
    if points is None:
        points = in_space(mesh.chart, np.einsum("kn,knc->kc", values, mesh.nodes[nodes], optimize=True))
    b = field.at(elements, barycentric)
    if mesh.chart == "axisymmetric":
        b[points[:, 0] == 0, 1] = 0.0  # row 1 of the frame is the radial one
    h = np.empty_like(b)
    region = mesh.region[elements]
    for index in np.unique(region):
        mine = region == index
        h[mine] = field_strength(solution, int(index), b[mine], points[mine])
    potential = np.einsum("kn,kn->k", values, solution.psi[nodes], optimize=True)
    # Adding zero turns −0 into 0.
    return Probe(potential, from_frame(mesh.chart, b) + 0.0, from_frame(mesh.chart, h) + 0.0, region)


def locate(mesh: Mesh, locator: Locator, points: Floats) -> tuple[Ints, Floats]:
    """As `Locator.find`: element (k,) and place (k, 3) of points (k, 2) in m, those next to an arc's sides included."""
    elements, places = locator.find(points, reach=REACH)
    held = np.flatnonzero(elements >= 0)
    nodes = mesh.nodes[mesh.elements[elements[held]]]
    found = in_space(mesh.chart, np.einsum("kn,knc->kc", shape(places[held]), nodes, optimize=True))
    corners = in_space(mesh.chart, nodes[:, :3])
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    far = held[np.hypot(*(found - points[held]).T) > NEAR * longest]
    elements[far], places[far] = -1, np.nan
    return elements, places


def field_strength(solution: Solution, region: int, b: Floats, points: Floats) -> Floats:
    """H (k, 2) in A/m for B (k, 2) in T, both in the kernel's frame, in one region at points (k, 2) in m."""
    chart = solution.problem.mesh.chart
    material = solution.problem.materials[region]
    first, second = material.components
    h = b * np.array([second, first])
    if material.grade is not None:
        h *= material.grade.factor(points)[:, None]
    if material.curve is not None:
        stretch, share = np.ones(2), 1.0
        if material.stack is not None:
            stretch, share = in_sheets(material.stack), material.stack.fill
        inside = b * stretch
        nu, _ = material.curve.reluctivity(np.sum(inside**2, axis=1))
        h += share * stretch * inside * nu[:, None]
    if callable(material.coercivity):
        h -= to_frame(chart, material.coercivity(points))
    else:
        h -= to_frame(chart, np.array(material.coercivity))
    return np.asarray(h)
