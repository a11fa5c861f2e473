"""What can be seen of a magnetic lead screw: its parts."""

from __future__ import annotations

from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.design.spec import Spec
from fluxbore.geometry import lead_screw_parts
from fluxbore.geometry.assembly import Assembly


def assembly(spec: Spec) -> Assembly:
    """The parts where they stand in the middle of the stroke. Raises DesignError where they do not fit."""
    actuator: LeadScrewActuator = spec.actuator
    return lead_screw_parts.assembly(actuator)
