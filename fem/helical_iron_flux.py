"""The flux along a lead screw's back iron."""

from __future__ import annotations

import numpy as np

from fluxbore.fem.helical import HelicalSolution
from fluxbore.fem.mesh import Floats


def layer_flux(solution: HelicalSolution, psi: Floats, layer: int) -> float:
    """The largest flux per angle (Wb/rad) along a layer, over ζ: what passes between its two radii.

    psi : the flux function at the nodes, of `helical_flux.flux_function`. Of nodes, some of which stand where bands
    meet and the flux is largest. Of a member's layer; the gap's mesh is sheared wherever the members are displaced.
    """
    r = solution.system.mesh.nodes[:, 0]
    inner, outer = solution.section.radii[layer : layer + 2]
    # Nodes stand in rows along r, so that those of one radius come in the order of their rows.
    return float(np.max(np.abs(psi[r == outer] - psi[r == inner])))
