"""The parts list: alike parts under one number, with what a workshop needs to make or to order them.

Drawings, CAD files, the bill of materials and the report number parts by it, so that they agree.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from fluxbore.design.materials import Material
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.inertia import Inertia, of_mass
from fluxbore.geometry.mass import PartMass, part_masses
from fluxbore.geometry.part import Body


@dataclass(frozen=True, slots=True)
class Item:
    """One line. number : from 1, in the assembly's order. parts : all pieces of this shape. mass : of one (kg).

    name : the part's own, or the role of several. part_number, drawing_number : by the title block.
    """

    number: int
    name: str
    parts: tuple[Body, ...]
    volume: float
    mass: float
    part_number: str
    drawing_number: str

    @property
    def part(self) -> Body:
        """The first piece, which stands for all."""
        return self.parts[0]

    @property
    def inertia(self) -> Inertia:
        """Of the first piece where it stands, its centre of gravity with it; made when it is asked for."""
        return of_mass(self.part, self.mass)

    @property
    def count(self) -> int:
        return len(self.parts)

    @property
    def source(self) -> str:
        """ "buy" or "make"."""
        return "buy" if self.part.bought else "make"


def parts_list(assembly: Assembly, materials: Mapping[str, Material]) -> tuple[Item, ...]:
    """Every part of the assembly under its number; parts that differ by place, turn or polarity alone share one."""
    alike: dict[tuple[object, ...], list[PartMass]] = {}
    for row in part_masses(assembly, materials):
        alike.setdefault(_shape(row), []).append(row)
    title = assembly.title
    return tuple(
        Item(
            number,
            rows[0].part.name if len(rows) == 1 else rows[0].part.role,
            tuple(row.part for row in rows),
            rows[0].volume,
            rows[0].mass,
            title.number_of(number),
            title.drawing_of(number),
        )
        for number, rows in enumerate(alike.values(), 1)
    )


def _shape(row: PartMass) -> tuple[object, ...]:
    """What alike parts have in common: lengths to a nanometre, from the part's own lower end."""
    part = row.part
    low = min(z for _, z in part.profile)

    def nm(length: float) -> int:
        return round(length * 1e9)

    common = (part.role, part.group, part.material, part.bought, f"{row.volume:.9e}")
    if isinstance(part, HelicalPart):
        return (*common, nm(part.inner_radius), nm(part.outer_radius), nm(part.lead), nm(part.width))
    high = max(z for _, z in part.profile)

    def seen(height: Callable[[float], int]) -> tuple[object, ...]:
        """The shape from one end."""
        return (
            tuple(sorted((nm(r), height(z)) for r, z in part.profile)),
            tuple(sorted((height(hole.z), nm(hole.diameter), nm(hole.bottom), hole.thread) for hole in part.holes)),
            tuple(
                sorted(
                    (nm(hole.radius), nm(hole.diameter), *sorted((height(hole.start), height(hole.end))), hole.thread)
                    for hole in part.axial_holes
                )
            ),
        )

    # A piece that is turned end for end is the same piece.
    ends = sorted((seen(lambda z: nm(z - low)), seen(lambda z: nm(high - z))), key=repr)
    return (*common, part.fits, part.axis_threads, ends[0])
