"""An assembly as few shapes and many copies: what GLB and 3MF files, and the page's live view, are made of."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from fluxbore.geometry.part import Body
from fluxbore.geometry.part_surface import surface
from fluxbore.geometry.parts_list import Item
from fluxbore.geometry.placement import Placement, placement
from fluxbore.geometry.surface import Surface

VIEWED = 2e-5
"""m, between a surface and its triangles in files that are looked at."""

PRINTED = 5e-6
"""m, in files that are printed or measured."""


@dataclass(frozen=True, slots=True)
class Shape:
    """A surface, where the first piece stands, and the pieces that have it with their places against the first."""

    item: Item
    surface: Surface
    pieces: tuple[tuple[Body, Placement], ...]


def shapes(items: Iterable[Item], tolerance: float) -> tuple[Shape, ...]:
    """Every piece of the parts list, those that are copies of one another together.

    tolerance : m, between surface and triangles. A mirror image is no copy; it has a shape of its own.
    """
    found = []
    for item in items:
        left = item.parts
        while left:
            first, *others = left
            places = [(part, placement(first, part)) for part in others]
            placed = [(part, place) for part, place in places if place is not None]
            found.append(Shape(item, surface(first, tolerance), ((first, Placement()), *placed)))
            left = tuple(part for part, place in places if place is None)
    return tuple(found)
