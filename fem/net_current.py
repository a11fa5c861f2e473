"""Currents that have nowhere to return: where nothing fixes A they must add up to zero.

By Ampère's law a net current needs a field around all of it. Sides without a condition (H_t = 0) and periodic ones do
not have it, so the equations of such a part have no solution, and the node whose ψ is chosen there would silently carry
the current back. In an open plane there is one, with an infinite energy.
"""

from __future__ import annotations

import numpy as np

from fluxbore.design.errors import SpecError, one_line
from fluxbore.fem.femm_model import FemmModel
from fluxbore.fem.mesh import Floats, Ints
from fluxbore.fem.problem import Problem

TYPED = 1e-6
"""Of the currents, that may be left over: their numbers are rounded in files."""

MEASURED = 1e-4
"""Likewise of current densities and of c1, which count by the areas and lengths of elements that follow arcs."""


def check_net_current(model: FemmModel, problem: Problem, loose: Ints, open_plane: bool = False) -> None:
    """Refuse a part of the mesh whose currents do not add up to zero though nothing fixes A in it.

    loose : (n,) number of such a part at its nodes, −1 elsewhere. open_plane : the same for the whole of a planar model
    in open space. Raises SpecError.
    """
    file = one_line(model.path) or "The file"
    if open_plane and (net := _net(problem, np.ones(loose.shape, dtype=bool))):
        raise SpecError(
            f"{file} must have currents that add up to zero to be opened, since a net current has an infinite energy "
            f"in an unbounded plane; they add up to {net:g} A."
        )
    for part in range(int(loose.max(initial=-1)) + 1):
        if net := _net(problem, loose == part):
            mesh = problem.mesh
            label = model.labels[int(mesh.region[loose[mesh.elements[:, 0]] == part].min())]
            what = "currents" if problem.edges is None else "currents (and c1 of boundaries)"
            raise SpecError(
                f"{file}: the {what} in the part of the model around ({label.x:g}, {label.y:g}) must add up to zero, "
                f"since no condition fixes A there; they add up to {net:g} A."
            )


def _net(problem: Problem, nodes: np.ndarray) -> float:
    """A, the loads' sum over some nodes (n,); zero where it is no more than the numbers are off by."""
    loads: list[tuple[Floats, float]] = [(c.current * c.density, TYPED) for c in problem.circuits]
    loads += [(source.current * source.density, MEASURED) for source in problem.sources]
    if problem.edges is not None:
        loads.append((problem.edges.load, MEASURED))
    net = sum(float(load[nodes].sum()) for load, _ in loads)
    slack = sum(share * float(np.abs(load[nodes]).sum()) for load, share in loads)
    return net if abs(net) > slack else 0.0
