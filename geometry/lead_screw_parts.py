"""A magnetic lead screw as parts: the members' bodies, and their magnets."""

from __future__ import annotations

from fluxbore.design.lead_screw_values import LeadScrewActuator
from fluxbore.geometry.assembly import Assembly, Colour, Part, rectangle

MAGNET: Colour = (0.72, 0.16, 0.16)
IRON: Colour = (0.45, 0.47, 0.50)
BODY: Colour = (0.70, 0.55, 0.35)


def assembly(actuator: LeadScrewActuator) -> Assembly:
    """The members with their middles at z = 0, magnets as whole sleeves."""
    shape = actuator.shape
    inner, outer, bore, rim = shape.radii

    def ring(
        name: str, role: str, group: str, material: str, colour: Colour, low: float, high: float, long: float
    ) -> Part:
        return Part(name, role, group, material, colour, rectangle(low, high, -long / 2, long / 2))

    parts = [
        ring("translator magnets", "magnet", "stator", actuator.translator.magnet, MAGNET, inner, outer,
             shape.translator_length),
        ring("rotor magnets", "magnet", "mover", actuator.rotor.magnet, MAGNET, bore, rim, shape.active_length),
    ]  # fmt: skip
    return Assembly(actuator.name, tuple(parts), 0.0)
