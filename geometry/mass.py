"""Masses and envelope of an assembly: the parts list's figures, which the motor's performance uses as well."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from fluxbore.design.materials import Material
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.inertia import Inertia, combined, of_mass
from fluxbore.geometry.part import Body, volume


@dataclass(frozen=True, slots=True)
class PartMass:
    """One line of the parts list: volume of the part as drawn (m³) and its mass (kg), 0 of a mere envelope."""

    part: Body
    volume: float
    mass: float

    @property
    def inertia(self) -> Inertia:
        """With the centre of gravity, where the part stands; made when it is asked for, which few are."""
        return of_mass(self.part, self.mass)


def part_masses(assembly: Assembly, materials: Mapping[str, Material]) -> tuple[PartMass, ...]:
    """Every part with its volume and mass, in the assembly's order."""
    return tuple(_weighed(part, materials) for part in assembly.parts)


def _weighed(part: Body, materials: Mapping[str, Material]) -> PartMass:
    found = volume(part)
    return PartMass(part, found, materials[part.material].density * part.fill * found if part.material else 0.0)


def total(rows: tuple[PartMass, ...], group: str | None = None) -> float:
    """Mass (kg) of all parts, or of the "mover" or the "stator" alone."""
    return sum(row.mass for row in rows if group is None or row.part.group == group)


def inertia_of(rows: tuple[PartMass, ...], group: str | None = None) -> Inertia:
    """Of all parts together, or of the "mover" or the "stator" alone; what has no mass does not count."""
    return combined(row.inertia for row in rows if group is None or row.part.group == group)


def envelope(assembly: Assembly) -> tuple[float, float]:
    """Largest diameter and length (m) of the stator; the rod sticks out of it by as much as the position says."""
    points = [point for part in assembly.parts if part.group == "stator" for point in part.profile]
    heights = [z for _, z in points]
    return 2 * max(r for r, _ in points), max(heights) - min(heights)
