"""The hybrid actuator's field for simulations: force constant and cogging over the positions that the mover passes."""

from __future__ import annotations

import numpy as np

from fluxbore.design.dynamics.contact_force_plant import passed_positions
from fluxbore.design.dynamics.force_map import ForceMap
from fluxbore.design.errors import DesignError
from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation

MAP_POSITIONS = 5
"""Over the disturbance's stroke: over 1 mm the prototype's force constant bends by 0.1 %, so that lines do."""


def map_values(spec: Spec) -> dict[str, Value]:
    """Changes to the specification whose evaluation has its window where the contact-force benchmark moves the mover.

    Raises SpecError where that leaves the mover's stroke, DesignError where the design cannot be built.
    """
    back, before = passed_positions(spec.actuator, spec.values)
    return {
        "operating_point.first_position": back,
        "operating_point.last_position": before,
        "operating_point.positions": MAP_POSITIONS,
    }


def force_map_of(evaluation: Evaluation) -> ForceMap:
    """The map through the positions of an evaluation, forces in +z: the mover's way out of the cylinder.

    By the network there are no positions: the force constant is then one number, and there is no cogging. Raises
    DesignError where the evaluation has no figures.
    """
    constant = evaluation.performance.force_constant
    if not evaluation.ok or constant is None:
        reason = " ".join(evaluation.reasons) or "it has no force constant."
        raise DesignError(f"A force map needs the design's field: {reason}")
    if not evaluation.positions:
        return ForceMap(np.zeros(1), np.array([constant]), np.zeros(1))
    ordered = sorted(evaluation.positions, key=lambda item: item.position)
    return ForceMap(
        np.array([item.position for item in ordered]),
        np.array([item.force_constant for item in ordered]),
        np.array([item.cogging_force for item in ordered]),
    )
