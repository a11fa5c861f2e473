"""What can be seen of an electro-hydrostatic actuator: its output cylinder."""

from __future__ import annotations

from fluxbore.design.hydrostatic_values import HydrostaticDesign
from fluxbore.design.spec import Spec
from fluxbore.geometry import hydrostatic_parts
from fluxbore.geometry.assembly import Assembly


def assembly(spec: Spec) -> Assembly:
    """The parts with the piston in the middle of its stroke. Raises DesignError where they do not fit."""
    design: HydrostaticDesign = spec.actuator
    return hydrostatic_parts.assembly(design, design.bare.output_cylinder.stroke / 2)
