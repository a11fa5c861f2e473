"""The hybrid actuator's field for simulations: force constant and cogging over the positions that the mover passes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fluxbore.design.dynamics import contact_force
from fluxbore.design.dynamics.contact_force_plant import passed_positions
from fluxbore.design.dynamics.force_map import ForceMap
from fluxbore.design.dynamics.simulation import Simulation
from fluxbore.design.errors import DesignError
from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.keys import Value
from fluxbore.design.spec import Spec
from fluxbore.optimize.evaluation import Evaluation
from fluxbore.optimize.hybrid_common import common_figures

MAP_POSITIONS = 5
"""Over the disturbance's stroke: over 1 mm the prototype's force constant bends by 0.1 %, so that lines do."""


def map_window(spec: Spec) -> dict[str, Value]:
    """Changes to the specification whose evaluation has its window where the contact-force benchmark moves the mover.

    Raises SpecError where that leaves the mover's stroke, DesignError where the design cannot be built.
    """
    back, before = passed_positions(spec.actuator, spec.values)
    return {
        "operating_point.first_position": back,
        "operating_point.last_position": before,
        "operating_point.positions": MAP_POSITIONS,
    }


def force_map_of(evaluations: Sequence[Evaluation]) -> ForceMap:
    """The map through every position of these evaluations, in +z: the mover's way out of the cylinder.

    By the network there are no positions: the force constant is then one number, and there is no cogging. Raises
    DesignError where an evaluation has no figures.
    """
    for evaluation in evaluations:
        if not evaluation.ok or evaluation.performance.force_constant is None:
            reason = " ".join(evaluation.reasons) or "it has no force constant."
            raise DesignError(f"A force map needs the design's field: {reason}")
    found = {item.position: item for evaluation in evaluations for item in evaluation.positions}
    if not found:
        constants = [evaluation.performance.force_constant for evaluation in evaluations]
        return ForceMap(np.zeros(1), np.array([np.mean(np.asarray(constants, dtype=np.float64))]), np.zeros(1))
    ordered = [found[position] for position in sorted(found)]
    return ForceMap(
        np.array([item.position for item in ordered]),
        np.array([item.force_constant for item in ordered]),
        np.array([item.cogging_force for item in ordered]),
    )


def simulate_contact_force(spec: Spec, force_map: ForceMap, seed: int, traces: bool = False) -> Simulation:
    """All runs of the contact-force benchmark for one seed, the mover's mass being the design's.

    Raises SpecError or DesignError.
    """
    actuator: HybridActuator = spec.actuator
    mass = common_figures(spec, actuator).moving_mass
    return contact_force.simulate(actuator, spec.values, force_map, seed, moving_mass=mass, traces=traces)
