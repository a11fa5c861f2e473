"""The field at places in elements that are known already: A, B and H on the side of an interface that is asked for."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.element import from_frame, shape
from fluxbore.fem.magnetostatics import Solution
from fluxbore.fem.mesh import Floats, Ints, in_space
from fluxbore.fem.probe import Probe, field_strength
from fluxbore.fem.recovery import RecoveredField


def field_in(
    solution: Solution, field: RecoveredField, elements: Ints, barycentric: Floats, points: Floats | None = None
) -> Probe:
    """The field in k elements (k,), each at one place in it; barycentric : (k, 3).

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
    return Probe(potential, from_frame(mesh.chart, b), from_frame(mesh.chart, h), region)
