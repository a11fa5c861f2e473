"""Masses and envelope of an assembly: the parts list's figures, which the motor's performance uses as well."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from fluxbore.design.hybrid import HybridActuator
from fluxbore.design.materials import Material
from fluxbore.design.winding import copper_fill
from fluxbore.geometry.assembly import Assembly, Part, volume


@dataclass(frozen=True, slots=True)
class PartMass:
    """One line of the parts list: volume of the part as drawn (m³) and its mass (kg)."""

    part: Part
    volume: float
    mass: float


def part_masses(
    assembly: Assembly, actuator: HybridActuator, materials: Mapping[str, Material]
) -> tuple[PartMass, ...]:
    """Every part with its volume and mass, in the assembly's order.

    A coil is drawn as its whole window, of which only the copper's share has mass: enamel and resin are left out.
    """
    fill = copper_fill(actuator)
    rows = []
    for part in assembly.parts:
        space = volume(part)
        solid = space * fill if part.role == "coil" else space
        rows.append(PartMass(part, space, solid * materials[part.material].density))
    return tuple(rows)


def total(rows: tuple[PartMass, ...], group: str | None = None) -> float:
    """Mass (kg) of all parts, or of the "mover" or the "stator" alone."""
    return sum(row.mass for row in rows if group is None or row.part.group == group)


def envelope(assembly: Assembly) -> tuple[float, float]:
    """Largest diameter and length (m) of the stator; the rod sticks out of it by as much as the position says."""
    points = [point for part in assembly.parts if part.group == "stator" for point in part.profile]
    heights = [z for _, z in points]
    return 2 * max(r for r, _ in points), max(heights) - min(heights)
