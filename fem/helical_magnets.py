"""How near a lead screw's magnets come to losing their magnetisation: the field against it, over their volume."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from fluxbore.fem.helical import HelicalSolution
from fluxbore.fem.mesh import Floats


def reverse_load(solution: HelicalSolution, coercivity: Mapping[int, float]) -> tuple[Floats, Floats]:
    """Weights r dr dζ and the field against the magnetisation over the intrinsic coercivity, both (k,).

    At the quadrature points of all magnets, the spaces between them left out; below zero where the field helps.
    coercivity : layer number -> H_cJ > 0 (A/m).
    """
    system = solution.system
    weights, loads = [], []
    for layer, limit in coercivity.items():
        elements = np.flatnonzero(system.grid.layer == layer)
        remanence = system.remanence[elements]
        against = -np.sign(remanence) * solution.field_strength(elements)[..., 0]
        filled = remanence != 0
        weights.append(system.kernel.weight[elements][filled])
        loads.append(against[filled] / limit)
    return np.concatenate(weights), np.concatenate(loads)


def demagnetised_fraction(weight: Floats, load: Floats) -> float:
    """Share of the magnets' volume where the load (k,) of `reverse_load` is above one."""
    return float(weight[load > 1].sum() / weight.sum())


def mean_load(weight: Floats, load: Floats, exponent: float) -> float:
    """(mean of load^p over the magnets' volume)^(1/p), where the field is against the magnetisation."""
    against = np.maximum(load, 0.0)
    largest = float(against.max())
    if largest == 0.0:
        return 0.0
    mean = float(np.sum(weight * (against / largest) ** exponent) / weight.sum())
    return float(largest * mean ** (1 / exponent))
